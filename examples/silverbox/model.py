"""A mass on a progressive spring: as physics has it, and with networks for what the circuit does besides.

The circuit computes ``m s'' + d s' + c s + b s^3 = f`` with amplifiers and a multiplier; a volt stands for a newton and
for a metre. Its amplifiers have offsets: the wall is not quite at zero, and some force is always there.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import neural
from acausal.components import translational as tl

INPUT, OUTPUT = "drive.f", "mass.s"
REACH, SPEED = 0.22, 80.0
"""What the training record reaches [m, m/s]."""
UNCERTAIN = ("mass.m", "wall.s0", "offset.f_constant")
"""Parameters that are trained in all models but the linear one, whose wall may as well stay at zero."""


class CubicSpring(tl.PartialCompliant):
    """``f = b s_rel^3``."""

    b = ac.Parameter(unit="N/m3")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, self.b * self.s_rel**3)


class Silverbox(ac.Component):
    """A mass that is driven by a force and held by elements between it and the wall."""

    def __init__(self, **elements: ac.Component) -> None:
        super().__init__()
        self.wall = tl.Fixed(s0=3e-3)
        self.mass = tl.Mass(m=5e-6)
        self.drive = tl.Force()
        self.offset = tl.ConstantForce(f_constant=-8e-3)
        for name, element in elements.items():
            setattr(self, name, element)
            self.connect(self.wall.flange, element.flange_a)
            self.connect(element.flange_b, self.mass.flange_a)
        self.connect(self.mass.flange_b, self.drive.flange, self.offset.flange)


def _linear() -> tl.SpringDamper:
    return tl.SpringDamper(c=1.0, d=2e-4)


def linear() -> tuple[Silverbox, tuple[str, ...]]:
    """Without any nonlinearity; with the parameters that are trained."""
    return Silverbox(linear=_linear()), ("mass.m", "offset.f_constant", "linear.c", "linear.d")


def white_box() -> tuple[Silverbox, tuple[str, ...]]:
    """What the circuit is meant to be: Duffing's oscillator."""
    box = Silverbox(linear=_linear(), cubic=CubicSpring(b=4.0))
    return box, (*UNCERTAIN, "linear.c", "linear.d", "cubic.b")


def enhanced() -> tuple[Silverbox, tuple[str, ...]]:
    """Duffing's oscillator, and networks for what it lacks: odd, and tame beyond what they saw."""
    box = Silverbox(
        linear=_linear(),
        cubic=CubicSpring(b=4.0),
        spring_nn=neural.Compliance(
            **_sizes(REACH, 1e-3), odd=True, extrapolation="saturating", limits=REACH
        ),
        damper_nn=neural.Resistance(
            **_sizes(SPEED, 1e-3), odd=True, extrapolation="linear", limits=SPEED
        ),
    )
    return box, (*UNCERTAIN, "linear.c", "linear.d", "cubic.b")


def promising() -> tuple[Silverbox, tuple[str, ...]]:
    """Networks beside a linear spring and damper, both odd, that only ever add to them, in the end linearly."""
    spring = neural.Compliance(
        **_sizes(REACH, 0.05),
        monotone=True,
        odd=True,
        extrapolation="linear",
        limits=REACH,
    )
    damper = neural.Resistance(
        **_sizes(SPEED, 1e-3),
        monotone=True,
        odd=True,
        extrapolation="linear",
        limits=SPEED,
    )
    box = Silverbox(linear=_linear(), spring_nn=spring, damper_nn=damper)
    return box, (*UNCERTAIN, "linear.c", "linear.d")


def free() -> tuple[Silverbox, tuple[str, ...]]:
    """Networks beside a linear spring and damper that promise nothing."""
    box = Silverbox(
        linear=_linear(),
        spring_nn=neural.Compliance(**_sizes(REACH, 0.05)),
        damper_nn=neural.Resistance(**_sizes(SPEED, 1e-3)),
    )
    return box, (*UNCERTAIN, "linear.c", "linear.d")


def _sizes(reach: float, output_scale: float) -> dict[str, Any]:
    return {"width": 8, "depth": 1, "input_scale": reach / 2, "output_scale": output_scale}
