"""The axis: a motor turns a screw, the screw moves a carriage on its guide; and the controller that makes it follow.

Voltage and position tell the inertia of motor, screw and carriage only as the mass that a force at the carriage feels.
Here the motor has all of it but 10 kg. The screw's lead is taken as 5 mm; it cancels, too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from math import pi

import acausal as ac
from acausal.components import blocks, neural, rotational as rot, translational as tl

INPUT, OUTPUT = "voltage.u", "carriage.s"
REFERENCE, PULSES = "position.u1", "pulses.u2"
GAIN = 35.15065188248547
"""Force at the carriage per volt [N/V], as the data say."""
SPEED = 0.13
"""What the records reach [m/s]."""
RATIO = 2 * pi / 5e-3
"""Angle of the screw per position [rad/m]."""
CARRIAGE = 10.0
"""[kg]"""
TRAINED = ("motor.J", "offset.f_constant")
"""Parameters that are trained in all models."""


class Coulomb(tl.PartialCompliantWithRelativeStates):
    """Friction as published: ``f = Fv v_rel + Fc sign(v_rel)``, the sign smoothed below ``v_small``."""

    Fv = ac.Parameter(203.5034, unit="N.s/m")
    Fc = ac.Parameter(20.3935, unit="N")
    v_small = ac.Parameter(1e-3, unit="m/s")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        dry = self.Fc * ac.tanh(self.v_rel / self.v_small)
        yield ac.Eq(self.f, self.Fv * self.v_rel + dry)


class Axis(ac.Component):
    """Motor, screw and carriage, with some friction between guide and carriage.

    Arguments:
        friction: an element with flanges; one with a secondary input ``s`` gets the carriage's position.
        ripple: whether the motor's torque has a part that repeats with its turns.
    """

    def __init__(
        self, friction: ac.Component, *, ripple: bool = False, **others: ac.Component
    ) -> None:
        super().__init__()
        self.voltage = blocks.Gain(k=GAIN / RATIO)
        self.torque, self.motor = rot.Torque(), rot.Inertia(J=(95.1089 - CARRIAGE) / RATIO**2)
        self.screw = rot.IdealGearR2T(ratio=RATIO)
        self.carriage = tl.Mass(m=CARRIAGE, stateSelect="always")
        self.offset = tl.ConstantForce(f_constant=3.1648)
        self.guide, self.friction, self.encoder = tl.Fixed(), friction, tl.PositionSensor()
        self.connect(self.voltage.y, self.torque.tau)
        self.connect(self.torque.flange, self.motor.flange_a)
        self.connect(self.motor.flange_b, self.screw.flangeR)
        self.connect(self.screw.flangeT, self.carriage.flange_a)
        self.connect(self.guide.flange, friction.flange_a)
        self.connect(
            self.carriage.flange_b, friction.flange_b, self.offset.flange, self.encoder.flange
        )
        if "s" in getattr(friction, "secondary", ()):
            self.connect(self.encoder.s, friction.s)
        for name, element in others.items():
            setattr(self, name, element)
            self.connect(self.guide.flange, element.flange_a)
            self.connect(element.flange_b, self.carriage.flange_b)
        if ripple:
            net = ac.networks.Fourier(2 * pi, harmonics=4, output_scale=1 / RATIO)
            self.stator, self.ripple = rot.Fixed(), neural.Compliance(rot.Flange, net=net)
            self.connect(self.stator.flange, self.ripple.flange_a)
            self.connect(self.ripple.flange_b, self.motor.flange_b)


class Controlled(Axis):
    """The axis in its controller, a speed loop in a position loop, and pulses on top of its voltage.

    ``v = kv (kp (q_ref - q) - dq)``. The speed ``dq`` is the backward difference of the mean of two positions, which
    is a sample late; the voltage is held over a sample, which makes it half of one late on average.
    """

    def __init__(
        self, friction: ac.Component, *, ripple: bool = False, **others: ac.Component
    ) -> None:
        super().__init__(friction, ripple=ripple, **others)
        self.position, self.speed, self.tacho = (
            blocks.Feedback(),
            blocks.Feedback(),
            tl.SpeedSensor(),
        )
        self.kp, self.kv = blocks.Gain(k=160.18), blocks.Gain(k=243.45)
        self.late, self.held = blocks.PadeDelay(delayTime=1e-3), blocks.PadeDelay(delayTime=5e-4)
        self.pulses, self.limit = blocks.Add(), blocks.Limiter(uMax=10.0)
        self.connect(self.carriage.flange_b, self.tacho.flange)
        self.connect(self.encoder.s, self.position.u2)
        self.connect(self.position.y, self.kp.u)
        self.connect(self.kp.y, self.speed.u1)
        self.connect(self.tacho.v, self.late.u)
        self.connect(self.late.y, self.speed.u2)
        self.connect(self.speed.y, self.kv.u)
        self.connect(self.kv.y, self.pulses.u1)
        self.connect(self.pulses.y, self.limit.u)
        self.connect(self.limit.y, self.held.u)
        self.connect(self.held.y, self.voltage.u)


def network(*, passive: bool = True) -> neural.Resistance:
    """What friction has beside a dry one: a law of the speed, and of the position."""
    return neural.Resistance(
        secondary=("s",),
        passive=passive,
        activation="tanh",
        input_scale=(0.05, 0.05),
        output_scale=20.0,
        extrapolation="linear",
        limits=1.2 * SPEED,
    )


def cable() -> neural.Compliance:
    """What pulls at the carriage wherever it stands, such as its cables."""
    return neural.Compliance(
        activation="tanh", input_scale=0.05, output_scale=5.0, zero_crossing="exact"
    )


@dataclass(frozen=True)
class Kind:
    """A kind of model.

    Attributes:
        friction: makes the element between guide and carriage.
        trained: parameters that are trained beside networks.
        learned: whether there are a dry friction and a neural spring beside ``friction``.
        ripple: whether the motor's torque has a part that repeats with its turns.
        parameter_spread: of parameters that are not the same in every run.
    """

    friction: Callable[[], ac.Component]
    trained: tuple[str, ...] = TRAINED
    learned: bool = False
    ripple: bool = False
    parameter_spread: Mapping[str, float] | None = None

    def build(self, whole: type[Axis]) -> ac.System:
        """The axis alone or controlled, compiled."""
        others = {"dry": Coulomb(Fv=0.0, Fc=12.0), "cable": cable()} if self.learned else {}
        return ac.compile(whole(self.friction(), ripple=self.ripple, **others))

    def instead(self, friction: Callable[[], ac.Component]) -> Kind:
        """The same with another friction."""
        return replace(self, friction=friction)


def learning(*, passive: bool = True, ripple: bool = False, **parameter_spread: float) -> Kind:
    """A network beside a dry friction, a neural spring for the cables; the spread in N."""
    names = {"friction": "dry.Fc", "offset": "offset.f_constant"}
    return Kind(
        lambda: network(passive=passive),
        (*TRAINED, "dry.Fc"),
        learned=True,
        ripple=ripple,
        parameter_spread={names[n]: d for n, d in parameter_spread.items()} or None,
    )


OURS = "passive network, with tolerances"
KINDS = {
    "linear": Kind(lambda: Coulomb(Fc=0.0), (*TRAINED, "friction.Fv")),
    "white box, published parameters": Kind(Coulomb, ()),
    "white box, trained": Kind(Coulomb, (*TRAINED, "friction.Fv", "friction.Fc")),
    "network without promises": learning(passive=False),
    "passive network": learning(),
    "passive network, and a ripple of the motor": learning(ripple=True),
    "passive network, with a tolerance of the offset alone": learning(offset=0.2),
    OURS: learning(friction=1.0, offset=0.2),
}
"""Kinds of models by name. The training record tells that the offset moves, but not that friction is another one in
another run: that is knowledge of machines.
"""
