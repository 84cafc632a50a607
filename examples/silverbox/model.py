"""A mass on a progressive spring: as physics has it, and with networks for what is not known or not meant of it.

The circuit computes ``m s'' + d s' + c s + b s^3 = f`` with amplifiers and a multiplier; a volt stands for a newton and
for a metre. Its amplifiers have offsets: the wall is not quite at zero, and some force is always there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import acausal as ac
from acausal.components import neural, translational as tl

INPUT, OUTPUT = "drive.f", "mass.s"
REACH, SPEED = 0.22, 80.0
"""What the training record reaches [m, m/s]."""
CUBE = 0.15
"""From where a spring goes on along a cube [m]: data beyond tell how steep it is."""
TRAINED = ("mass.m", "offset.f_constant", "linear.c", "linear.d")
"""Parameters that are trained in all models; but for the linear one the wall's place counts, too."""


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


@dataclass(frozen=True)
class Kind:
    """A kind of model.

    Attributes:
        elements: makes what is between wall and mass beside a linear spring and damper.
        trained: parameters that are trained beside networks.
        seeds: from how many random starts it is trained at most.
        epochs: how long.
    """

    elements: Callable[[], dict[str, ac.Component]]
    trained: tuple[str, ...] = (*TRAINED, "wall.s0")
    seeds: int = 1
    epochs: int = 200

    def build(self) -> Silverbox:
        """The model."""
        return Silverbox(linear=tl.SpringDamper(c=1.0, d=2e-4), **self.elements())


def networks(force: float, **promises: Any) -> dict[str, ac.Component]:
    """A spring that promises what is given, of a magnitude in N, and a damper that is odd and goes on linearly."""
    return {
        "spring_nn": neural.Compliance(**_sizes(REACH, force), **promises),
        "damper_nn": neural.Resistance(
            **_sizes(SPEED, 1e-3), odd=True, extrapolation="linear", limits=SPEED
        ),
    }


def _sizes(reach: float, output_scale: float) -> dict[str, Any]:
    return {
        "width": 8,
        "depth": 1,
        "input_scale": reach / 2,
        "output_scale": output_scale,
    }


def learned(activation: str = "softplus", **promises: Any) -> Kind:
    """All that a linear spring lacks is left to a network, which promises this much."""
    return Kind(lambda: networks(0.05, activation=activation, **promises), seeds=3)


OURS = "Duffing and networks"
KINDS = {
    "linear": Kind(dict, TRAINED, epochs=60),
    "white box (Duffing)": Kind(
        lambda: {"cubic": CubicSpring(b=4.0)}, (*TRAINED, "wall.s0", "cubic.b"), epochs=100
    ),
    "spring: a free network": learned(),
    "spring: odd": learned(odd=True),
    "spring: odd, of a convex energy": learned(
        "elu", odd=True, energy=True, convex=True
    ),  # of softplus it would begin as one that flattens, and end as none
    "spring: odd, rising, linear beyond": learned(
        odd=True, monotone=True, extrapolation="linear", limits=REACH
    ),
    "spring: odd, rising, cubic beyond": learned(
        odd=True, monotone=True, extrapolation="cubic", limits=CUBE
    ),
    OURS: Kind(
        lambda: {
            "cubic": CubicSpring(b=4.0),
            **networks(1e-3, odd=True, extrapolation="saturating", limits=REACH),
        },
        (*TRAINED, "wall.s0", "cubic.b"),
        seeds=5,
    ),
}
"""Kinds of models by name. A cubic spring is known physics, and so is how it goes on; networks beside it, odd and tame
beyond what they saw, mend what it lacks. Without it promises decide how a spring goes on."""
