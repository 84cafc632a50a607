"""The drive train: a motor, an elastic shaft and a load; what is known of it, and what it is in truth."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi
from typing import Any

import acausal as ac
from acausal.components import neural, rotational as rot

INPUT, SPEED, GAUGE, OFFSET = "drive.tau", "motor.w", "gauge.y", "gauge.offset"
TEETH = 6
"""Cogging repeats so often in a turn."""
TRAINED = ("load.J", "shaft.c", "shaft.d")
"""Parameters that are known to a third or so."""


class Friction(rot.PartialCompliantWithRelativeStates):
    """The true friction of the bearings: dry, larger at low speeds, and viscous.

    ``tau = (dry + stick exp(-(w_rel/w_stick)^2)) tanh(w_rel/w_small) + viscous w_rel``.
    """

    dry = ac.Parameter(0.2, unit="N.m")
    stick = ac.Parameter(0.12, unit="N.m")
    viscous = ac.Parameter(0.04, unit="N.m.s/rad")
    w_stick = ac.Parameter(4.0, unit="rad/s")
    w_small = ac.Parameter(0.5, unit="rad/s")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        falling = self.stick * ac.exp(-((self.w_rel / self.w_stick) ** 2))
        dry = (self.dry + falling) * ac.tanh(self.w_rel / self.w_small)
        yield ac.Eq(self.tau, dry + self.viscous * self.w_rel)


class Cogging(rot.PartialCompliant):
    """The true cogging of the motor: its teeth hold it, ``first sin(6 phi) + second sin(12 phi + 0.5)``."""

    first = ac.Parameter(0.15, unit="N.m")
    second = ac.Parameter(0.05, unit="N.m")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        angle = TEETH * self.phi_rel
        yield ac.Eq(self.tau, self.first * ac.sin(angle) + self.second * ac.sin(2 * angle + 0.5))


class Gauge(ac.Component):
    """What shows a torque: ``y = tau + offset``, and no two runs have the same offset."""

    offset = ac.Parameter(0.0, unit="N.m")
    tau = ac.Input(unit="N.m")
    y = ac.Output(unit="N.m")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.tau + self.offset)


class DriveTrain(ac.Component):
    """A motor turns a load through an elastic shaft; a gauge measures the shaft's torque, with an offset.

    Arguments:
        friction: between housing and load.
        cogging: between housing and motor.
        load, stiffness, damping: of the load's inertia and the shaft.
    """

    def __init__(
        self,
        friction: ac.Component,
        cogging: ac.Component,
        *,
        load: float = 8e-3,
        stiffness: float = 30.0,
        damping: float = 0.02,
    ) -> None:
        super().__init__()
        at_rest: dict[str, Any] = {"phi": ac.Start(0.0, fixed=True), "w": ac.Start(0.0, fixed=True)}
        self.housing, self.drive = rot.Fixed(), rot.Torque()
        self.motor = rot.Inertia(J=2e-3, **at_rest)
        self.shaft = rot.SpringDamper(c=stiffness, d=damping)
        self.torque, self.gauge = rot.TorqueSensor(), Gauge(offset=0.0)
        self.load = rot.Inertia(J=load, **at_rest)
        self.friction, self.cogging = friction, cogging
        self.connect(self.drive.flange, self.motor.flange_a)
        self.connect(self.motor.flange_b, self.shaft.flange_a)
        self.connect(self.shaft.flange_b, self.torque.flange_a)
        self.connect(self.torque.flange_b, self.load.flange_a)
        self.connect(self.torque.tau, self.gauge.tau)
        self.connect(self.housing.flange, friction.flange_a, cogging.flange_a)
        self.connect(friction.flange_b, self.load.flange_b)
        self.connect(cogging.flange_b, self.motor.flange_a)


def truth() -> ac.System:
    """What is measured."""
    return ac.compile(DriveTrain(Friction(), Cogging()))


def unknown() -> DriveTrain:
    """What is known before: a law of the speed that never drives, a periodic law of the angle, and rough parameters."""
    friction = neural.Resistance(
        rot.Flange,
        passive=True,
        odd=True,
        width=8,
        depth=1,
        activation="tanh",
        input_scale=5.0,
        output_scale=0.3,
        extrapolation="linear",
        limits=20.0,
    )
    net = ac.networks.Fourier(2 * pi / TEETH, harmonics=3, output_scale=0.1)
    cogging = neural.Compliance(rot.Flange, net=net)
    return DriveTrain(friction, cogging, load=6.5e-3, stiffness=36.0, damping=0.03)


def learning() -> ac.System:
    """The same, compiled."""
    return ac.compile(unknown())
