"""Stiff test problems as components.

E. Hairer, G. Wanner: Solving Ordinary Differential Equations II, Springer 1996, sections IV.1 and IV.10.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import acausal as ac


class StiffProblem(ac.Component):
    """States ``y`` with their derivatives, which start at ``start``.

    Attributes:
        end: of the time.
        scale: absolute tolerance over the relative one: below this, a state does not count.
    """

    start: ClassVar[Sequence[float]]
    end: ClassVar[float]
    scale: ClassVar[float] = 1.0

    def __init__(self) -> None:
        self.y = [ac.Variable(start=value, fixed=True) for value in self.start]
        super().__init__()

    def rates(self) -> Sequence[Any]:
        """The derivatives."""
        raise NotImplementedError

    def equations(self) -> Iterator[ac.Eq]:
        for y, rate in zip(self.y, self.rates(), strict=True):
            yield ac.Eq(ac.der(y), rate)


class VanDerPol(StiffProblem):
    """A relaxation oscillation with µ = 1000."""

    start, end = (2.0, 0.0), 2000.0

    def rates(self) -> Sequence[Any]:
        y, v = self.y
        return v, 1000 * (1 - y**2) * v - y


class Robertson(StiffProblem):
    """Three reactions whose rates lie nine powers of ten apart."""

    start, end, scale = (1.0, 0.0, 0.0), 1e11, 1e-8

    def rates(self) -> Sequence[Any]:
        a, b, c = self.y
        first, second, third = 0.04 * a, 3e7 * b**2, 1e4 * b * c
        return third - first, first - third - second, second


class Orego(StiffProblem):
    """The Oregonator: an oscillating reaction."""

    start, end = (1.0, 2.0, 3.0), 360.0

    def rates(self) -> Sequence[Any]:
        a, b, c = self.y
        return (
            77.27 * (b + a * (1 - 8.375e-6 * a - b)),
            (c - (1 + a) * b) / 77.27,
            0.161 * (a - c),
        )


class Hires(StiffProblem):
    """How light makes a plant's cells differ: eight reactions."""

    start, end, scale = (1.0, *[0.0] * 6, 0.0057), 321.8122, 1e-4

    def rates(self) -> Sequence[Any]:
        a, b, c, d, e, f, g, h = self.y
        bound = 280 * f * h
        return (
            -1.71 * a + 0.43 * b + 8.32 * c + 0.0007,
            1.71 * a - 8.75 * b,
            -10.03 * c + 0.43 * d + 0.035 * e,
            8.32 * b + 1.71 * c - 1.12 * d,
            -1.745 * e + 0.43 * f + 0.43 * g,
            -bound + 0.69 * d + 1.71 * e - 0.43 * f + 0.69 * g,
            bound - 1.81 * g,
            -bound + 1.81 * g,
        )


class E5(StiffProblem):
    """A pyrolysis, whose concentrations reach down to 1e-20."""

    start, end, scale = (1.76e-3, 0.0, 0.0, 0.0), 1e6, 1e-17

    def rates(self) -> Sequence[Any]:
        a, b, c, d = self.y
        first, second, third, fourth = 7.89e-10 * a, 1.1e7 * a * c, 1.13e9 * b * c, 1.13e3 * d
        return (
            -first - second,
            first - third,
            first - second - third + fourth,
            second - fourth,
        )


@dataclass(frozen=True)
class Reaction:
    """A rate constant, what reacts, and what comes out; species are numbered from 1."""

    k: float
    before: tuple[int, ...]
    after: tuple[int, ...]


POLLUTION = tuple(
    Reaction(*terms)
    for terms in (
        (0.35, (1,), (2, 3)),
        (26.6, (2, 4), (1,)),
        (1.23e4, (5, 2), (6, 1)),
        (8.6e-4, (7,), (5, 5, 8)),
        (8.2e-4, (7,), (8,)),
        (1.5e4, (7, 6), (8, 5)),
        (1.3e-4, (9,), (5, 8, 10)),
        (2.4e4, (9, 6), (11,)),
        (1.65e4, (11, 2), (10, 12, 1)),
        (9e3, (11, 1), (13,)),
        (0.022, (13,), (11, 1)),
        (1.2e4, (10, 2), (14, 1)),
        (1.88, (14,), (7, 5)),
        (1.63e4, (1, 6), (15,)),
        (4.8e6, (3,), (4,)),
        (3.5e-4, (4,), (16,)),
        (0.0175, (4,), (3,)),
        (1e8, (16,), (6, 6)),
        (4.44e11, (16,), (3,)),
        (1.24e3, (17, 6), (18, 5)),
        (2.1, (19,), (2,)),
        (5.78, (19,), (1, 3)),
        (0.0474, (1, 4), (19,)),
        (1.78e3, (19, 1), (20,)),
        (3.12, (20,), (19, 1)),
    )
)
"""The reactions by which the air is polluted."""


class Pollution(StiffProblem):
    """Twenty species in the air and 25 reactions."""

    start: ClassVar[Sequence[float]] = tuple(
        {2: 0.2, 4: 0.04, 7: 0.1, 8: 0.3, 9: 0.01, 17: 0.007}.get(i, 0.0) for i in range(1, 21)
    )
    end, scale = 60.0, 1e-4

    def rates(self) -> Sequence[Any]:
        total: list[Any] = [0.0] * len(self.y)
        for reaction in POLLUTION:
            speed: Any = reaction.k
            for species in reaction.before:
                speed = speed * self.y[species - 1]
            for species in reaction.before:
                total[species - 1] -= speed
            for species in reaction.after:
                total[species - 1] += speed
        return total


PROBLEMS: tuple[type[StiffProblem], ...] = (VanDerPol, Robertson, Orego, Hires, E5, Pollution)
