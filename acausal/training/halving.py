"""Successive halving: of several starts all make a few updates, the best go on, and the best of these to the end.

K. Jamieson, A. Talwalkar: Non-stochastic Best Arm Identification and Hyperparameter Optimization, AISTATS 2016. Here a
quarter goes on in place of a half, since good starts differ from others by more than the noise of a score.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

FIRST, SECOND = 0.3, 0.6
"""The part of all updates after which a quarter of the starts goes on, and then a quarter of these."""

QUARTER = 4
FEWEST = 2
"""At least so many go on to the end, as long as there are so many."""


class Rung(NamedTuple):
    """A moment at which only the best go on.

    Attributes:
        at: planned updates until then.
        keep: how many go on.
    """

    at: int
    keep: int


class Halving(NamedTuple):
    """When and how many of several trainings end; without rungs, all go on.

    Because a training that goes on can only get better, those that go on are always the best of all.
    """

    rungs: tuple[Rung, ...] = ()

    def survivors(self, scores: Sequence[float], done: int) -> list[int]:
        """The trainings that go on after so many planned updates, in order."""
        keep = min((r.keep for r in self.rungs if r.at <= done), default=len(scores))
        return sorted(sorted(range(len(scores)), key=scores.__getitem__)[:keep])

    def until_next(self, done: int) -> float:
        """How many updates there are until the next moment; infinite after the last."""
        return min((r.at - done for r in self.rungs if r.at > done), default=math.inf)


def halving(starts: int, updates: int) -> Halving:
    """The plan for some starts and updates; for one start there is nothing to choose."""
    rungs: list[Rung] = []
    keep = starts
    for part in (FIRST, SECOND):
        keep = max(FEWEST, math.ceil(keep / QUARTER))
        if keep < (rungs[-1].keep if rungs else starts):
            rungs.append(Rung(max(1, math.ceil(part * updates)), keep))
    return Halving(tuple(rungs))
