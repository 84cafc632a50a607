"""A vehicle on a level road: what is known of it, what it is in truth, and the records of a fleet."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import jax
import numpy as np

import acausal as ac
from acausal.components import neural, translational as tl

INPUT, SPEED, MASS = "drive.f", "body.v", "body.m"
SAMPLE_TIME, SECONDS = 0.5, 30.0
"""Of a record [s]."""
TYPICAL, SPREAD, NOISE = 1500.0, 200.0, 0.02
"""Masses [kg], and the noise of the measured speed [m/s]."""


class Resistance(tl.PartialCompliantWithRelativeStates):
    """The true resistance: of rolling and of the air, ``f = roll tanh(v_rel/v_small) + air v_rel |v_rel|``."""

    roll = ac.Parameter(180.0, unit="N")
    air = ac.Parameter(0.6, unit="N.s2/m2")
    v_small = ac.Parameter(1.0, unit="m/s")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        v = self.v_rel
        yield ac.Eq(self.f, self.roll * ac.tanh(v / self.v_small) + self.air * v * ac.Abs(v))


class Vehicle(ac.Component):
    """A mass that is driven against a resistance."""

    def __init__(self, resistance: ac.Component) -> None:
        super().__init__()
        self.road = tl.Fixed()
        self.body = tl.Mass(m=TYPICAL)
        self.drive = tl.Force()
        self.resistance = resistance
        self.connect(self.road.flange, self.resistance.flange_a)
        self.connect(self.resistance.flange_b, self.body.flange_a)
        self.connect(self.drive.flange, self.body.flange_b)


def truth() -> ac.System:
    """The vehicle that makes the records."""
    return ac.compile(Vehicle(Resistance()))


def learned() -> ac.System:
    """The vehicle whose resistance is a network."""
    net = neural.Resistance(input_scale=10.0, output_scale=300.0, width=8, odd=True)
    return ac.compile(Vehicle(net))


def fleet(count: int, seed: int = 0, seconds: float = SECONDS) -> dict[str, ac.Data]:
    """Records of some vehicles by name: a driving force in steps, and the speed with noise; masses as of `masses`."""
    random = np.random.default_rng(seed + 1)
    system, steps = truth(), round(seconds / SAMPLE_TIME)
    force = np.repeat(random.uniform(-500.0, 2000.0, (count, steps // 6 + 1)), 6, axis=1)
    force = force[:, : steps + 1]
    common = system.parameters()

    @jax.jit
    @jax.vmap
    def speed(mass: Any, driven: Any, first: Any) -> Any:
        given = {INPUT: driven}, {**common, MASS: mass}, {SPEED: first}
        inputs, params, x0 = given
        span = (0.0, SAMPLE_TIME * steps)
        run = ac.simulate(
            system, span, dt=SAMPLE_TIME, inputs=inputs, params=params, x0=x0, solver="rk4"
        )
        return run[SPEED]

    true = np.asarray(speed(masses(count, seed), force, random.uniform(5.0, 20.0, count)))
    measured = true + NOISE * random.standard_normal(true.shape)
    time = SAMPLE_TIME * np.arange(steps + 1)
    return {
        f"vehicle {k}": ac.Data(time, {INPUT: force[k], SPEED: measured[k]}) for k in range(count)
    }


def masses(count: int, seed: int = 0) -> np.ndarray:
    """The true masses of the same vehicles [kg]."""
    return np.random.default_rng(seed).normal(TYPICAL, SPREAD, count)
