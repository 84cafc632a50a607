"""The quarter vehicle: the physical model, the same with neural forces, and the truth that makes the data.

Parameters: M11_NeuralQVM of the eFMI project; the damping of the tyre is ours. The paper states none.
"""

from __future__ import annotations

from collections.abc import Iterator

import acausal as ac
from acausal.components import neural, translational as tl

BODY, WHEEL = 350.0, 90.0
"""Masses [kg]."""
SUSPENSION_STIFFNESS, SUSPENSION_DAMPING = 10e3, 800.0
"""Of the suspension [N/m, N.s/m]."""
TYRE_STIFFNESS, TYRE_DAMPING = 300e3, 100.0
"""Of the tyre [N/m, N.s/m]."""

UNCERTAIN = {"body.m": -0.1, "wheel.m": 0.1, "tyre.c": 0.1, "tyre.d": -0.1}
"""Parameters that the noisy experiments start wrong, and the modifiers that would mend them."""

FORCE_SCALE, TRAVEL_SCALE, SPEED_SCALE = 200.0, 0.01, 0.1
"""Magnitudes that the networks are scaled by [N, m, m/s]."""


class ProgressiveSpring(tl.PartialCompliant):
    """Quadratic spring through the origin: ``f = (c1 (s_rel + su))^2 - (c1 su)^2``."""

    c1 = ac.Parameter(607.0, unit="N^0.5/m")
    su = ac.Parameter(0.0078, unit="m")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, (self.c1 * (self.s_rel + self.su)) ** 2 - (self.c1 * self.su) ** 2)


class StribeckFriction(tl.PartialCompliantWithRelativeStates):
    """Smooth friction: Stribeck, Coulomb and viscous, the "Translational Friction" of Simscape."""

    F_C = ac.Parameter(30.0, unit="N", doc="Coulomb friction")
    F_brk = ac.Parameter(40.0, unit="N", doc="breakaway friction")
    v_brk = ac.Parameter(0.02, unit="m/s", doc="breakaway speed")
    d = ac.Parameter(150.0, unit="N.s/m", doc="viscous friction")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        stribeck = self.v_rel / (ac.sqrt(2) * self.v_brk)
        yield ac.Eq(
            self.f,
            ac.sqrt(2 * ac.exp(1)) * (self.F_brk - self.F_C) * ac.exp(-(stribeck**2)) * stribeck
            + self.F_C * ac.tanh(10 * self.v_rel / self.v_brk)
            + self.d * self.v_rel,
        )


class QuarterVehicle(ac.Component):
    """A body on a suspension on a wheel on a tyre on the road; ``extra`` elements lie beside the suspension."""

    def __init__(self, *, wrong: bool = False, **extra: ac.Component) -> None:
        super().__init__()
        off = {name: 1 / (1 + modifier) if wrong else 1.0 for name, modifier in UNCERTAIN.items()}
        self.body = tl.Mass(m=BODY * off["body.m"])
        self.suspension = tl.SpringDamper(c=SUSPENSION_STIFFNESS, d=SUSPENSION_DAMPING)
        for name, element in extra.items():
            setattr(self, name, element)
        self.wheel = tl.Mass(m=WHEEL * off["wheel.m"])
        self.tyre = tl.SpringDamper(
            c=TYRE_STIFFNESS * off["tyre.c"], d=TYRE_DAMPING * off["tyre.d"]
        )
        self.road = tl.Speed(exact=True)
        for element in (self.suspension, *extra.values()):
            self.connect(self.body.flange_b, element.flange_a)
            self.connect(element.flange_b, self.wheel.flange_a)
        self.connect(self.wheel.flange_b, self.tyre.flange_a)
        self.connect(self.tyre.flange_b, self.road.flange)


def linear() -> QuarterVehicle:
    """What physics alone gives: no friction, a linear spring."""
    return QuarterVehicle()


def truth() -> QuarterVehicle:
    """The vehicle that is measured: with a progressive spring and friction."""
    return QuarterVehicle(progressive=ProgressiveSpring(), friction=StribeckFriction())


def with_networks(*, wrong: bool = False) -> QuarterVehicle:
    """The physics-enhanced neural ODE: networks in the places of the missing spring and friction.

    Arguments:
        wrong: start with `UNCERTAIN` parameters off by ten percent.
    """
    return QuarterVehicle(
        wrong=wrong,
        spring_nn=neural.Compliance(input_scale=TRAVEL_SCALE, output_scale=FORCE_SCALE),
        damper_nn=neural.Resistance(input_scale=SPEED_SCALE, output_scale=FORCE_SCALE),
    )
