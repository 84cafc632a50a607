"""Learn the friction from a record of the moving arm, and lead it along a course with what was learned, and without."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

import acausal as ac
from acausal.components import rotational as rot
from examples.following_arm.model import ANGLE, LIMIT, MOTOR, SPEED, Arm, true

BEGUN = 1.0
"""From when on errors count [s]: the arm starts at rest, the course does not."""


class Outcome(NamedTuple):
    """How a controller leads the arm.

    Attributes:
        record: of the closed loop.
        rms, largest: what the angle is off the course [rad].
    """

    record: ac.Data
    rms: float
    largest: float


def course(t: float) -> float:
    """The angle where the arm should be [rad]."""
    return 1.2 * float(np.sin(2 * np.pi * 0.25 * t))


def measured(plant: ac.System, seconds: float = 10.0, seed: int = 0) -> ac.Data:
    """A record of angle and speed with noise, while the motor swings the arm."""
    t = np.linspace(0.0, seconds, round(50 * seconds) + 1)
    torque = 0.35 * np.sin(2 * np.pi * 0.55 * t) + 0.2 * np.sin(2 * np.pi * 0.21 * t + 1)
    run = ac.simulate(plant, (0.0, seconds), saveat=t, inputs={MOTOR: (t, torque)})
    noise = np.random.default_rng(seed)
    return ac.Data(
        t,
        {
            MOTOR: torque,
            ANGLE: np.asarray(run[ANGLE]) + 0.003 * noise.standard_normal(len(t)),
            SPEED: np.asarray(run[SPEED]) + 0.02 * noise.standard_normal(len(t)),
        },
    )


def learned(data: ac.Data) -> ac.Fit:
    """The friction as a network."""
    return ac.fit(ac.compile(Arm()), data, [ANGLE, SPEED], progress=False)


def viscous(data: ac.Data) -> ac.Fit:
    """The friction as ``d w``, as a linear model has it."""
    model = ac.compile(Arm(rot.Damper(d=0.05)))
    return ac.fit(model, data, [ANGLE, SPEED], modifiers=["bearing.d"], progress=False)


def controller(system: ac.System, params: Mapping[str, Any]) -> ac.control.MPC:
    """One second ahead, every 0.1 s: along the course, with the torque that there is."""
    return ac.control.mpc(
        system,
        dt=0.1,
        steps=10,
        track={ANGLE: 1.0},
        effort={MOTOR: 1e-4},
        limits={MOTOR: (-LIMIT, LIMIT)},
        params=params,
    )


def follow(plant: ac.System, fit: ac.Fit, seconds: float = 5.0) -> Outcome:
    """The closed loop of the plant with a controller that knows a fit."""
    record = controller(fit.system, fit.params).run(plant, seconds, reference={ANGLE: course})
    t = np.asarray(record.time)
    off = np.asarray(record[ANGLE]) - np.array([course(float(s)) for s in t])
    off = off[t >= BEGUN]
    return Outcome(record, float(np.sqrt(np.mean(off**2))), float(np.abs(off).max()))


def compared() -> dict[str, Outcome]:
    """By what the controller knows of the friction, how it leads the arm."""
    plant = true()
    data = measured(plant)
    return {n: follow(plant, fit(data)) for n, fit in (("learned", learned), ("viscous", viscous))}
