"""Several starting points of the trained parameters: where they are, which go on, and what each of them reached."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.stats import qmc

from acausal.errors import TrainingError
from acausal.reporting import aligned
from acausal.training.member import Trained
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable

EDGE = 1e-3
"""No starting point is nearer to the end of a parameter's range than this part of it."""

ALIKE = 0.01
"""Losses that differ by less than this part belong to the same minimum,"""

SMALL = 1e-4
"""or by less than this part of the lowest loss before training."""

FIRST, SECOND = 0.3, 0.6
"""The part of all updates after which a quarter of the starts goes on, and then a quarter of these."""

QUARTER = 4
FEWEST = 2
"""At least so many go on to the end, as long as there are so many."""


@dataclass(frozen=True)
class Minimum:
    """A loss that some starts reached.

    Attributes:
        loss: the lowest of them.
        count: how many starts reached it.
        values: of the parameters there, by name.
    """

    loss: float
    count: int
    values: dict[str, float]


@dataclass(frozen=True, eq=False)
class Starts:
    """The starting points of a training, and what each reached. The first one is the given start.

    Attributes:
        names: the parameters.
        values: where each start began.
        reached: where it was best.
        loss_before: where it began; infinite if the model diverges there.
        loss: the best that it reached, over what is held out if anything is; likewise.
        updates: how many it made; the best starts made most.
        finished: whether it made all updates, or converged; the others were ended while better ones went on.
    """

    names: tuple[str, ...]
    values: Float[np.ndarray, "n_starts n_names"]
    reached: Float[np.ndarray, "n_starts n_names"]
    loss_before: Float[np.ndarray, " n_starts"]
    loss: Float[np.ndarray, " n_starts"]
    updates: Int[np.ndarray, " n_starts"]
    finished: Bool[np.ndarray, " n_starts"]

    def __len__(self) -> int:
        """How many starts there were."""
        return len(self.loss)

    @property
    def best(self) -> int:
        """The start that reached the lowest loss."""
        return int(np.argmin(self.loss))

    @cached_property
    def minima(self) -> tuple[Minimum, ...]:
        """The different losses that were reached, the lowest first.

        A start that was ended early counts where it had come as low as one that was not, and nowhere else.
        """
        groups: list[list[int]] = []
        for k in np.argsort(self.loss, kind="stable").tolist():
            if not math.isfinite(self.loss[k]):
                break
            if groups and self.loss[k] <= self._as_low_as(self.loss[groups[-1][0]]):
                groups[-1].append(k)
            elif self.finished[k] or not groups:
                groups.append([k])
        return tuple(
            Minimum(
                float(self.loss[group[0]]),
                len(group),
                dict(zip(self.names, self.reached[group[0]].tolist(), strict=True)),
            )
            for group in groups
        )

    def _as_low_as(self, loss: float) -> float:
        return loss * (1 + ALIKE) + SMALL * float(np.min(self.loss_before))

    def summary(self) -> str:
        """One sentence: how many starts reached the lowest loss, and what became of the others."""
        diverged = int(np.sum(~np.isfinite(self.loss)))
        if not self.minima:
            return f"All of {len(self)} starts diverged."
        lowest, *others = self.minima
        parts = [f"{lowest.count} of {len(self)} starts reach the loss {lowest.loss:.4g}"]
        if others:
            parts.append(f"the next minimum is {others[0].loss:.4g}")
        stopped = len(self) - diverged - sum(m.count for m in self.minima)
        if stopped:
            parts.append(f"{stopped} ended early at higher losses")
        if diverged:
            parts.append(f"{diverged} diverged")
        return f"{'; '.join(parts)}."

    def rows(self) -> list[tuple[str, ...]]:
        """A table, the best first: start, values there, loss reached, updates, whether it finished."""
        order = np.argsort(self.loss, kind="stable")
        return [
            (
                str(k),
                *(f"{value:.4g}" for value in self.values[k]),
                f"{self.loss[k]:.4g}",
                str(self.updates[k]),
                "yes" if self.finished[k] else "no",
            )
            for k in order
        ]

    @property
    def header(self) -> tuple[str, ...]:
        """The titles of the table's columns."""
        return ("start", *(f"{n} there" for n in self.names), "loss reached", "updates", "finished")

    def __repr__(self) -> str:
        return f"{self.summary()}\n{aligned([self.header, *self.rows()], right=True)}"


def spread_starts(problem: Problem, count: int, seed: int) -> list[Trainable]:
    """Where a training starts, and other values of its parameters: a scrambled Sobol sequence over their ranges.

    I. M. Sobol: On the distribution of points in a cube, USSR Computational Mathematics 7, 1967; A. B. Owen: Scrambling
    Sobol and Niederreiter-Xing points, Journal of Complexity 14, 1998.

    Raises:
        TrainingError: if no parameter is trained.
    """
    given, changed = problem.start(), problem.modifiers
    if count == 1:
        return [given]
    if not changed.names:
        raise TrainingError(
            f"starts={count} spreads trained parameters, and there are none: name them by modifiers=..., "
            "or train networks from several seeds with ac.ensemble."
        )
    cube = qmc.Sobol(len(changed.names), rng=np.random.default_rng(seed))
    shares = np.clip(cube.random_base2(max(1, (count - 1).bit_length())), EDGE, 1 - EDGE)
    rows = list(zip(changed.names, changed.kinds, changed.values, strict=True))

    def at(point: Float[np.ndarray, " n_names"]) -> Trainable:
        free = {
            name: jnp.asarray(kind.free(float(value), float(share)))
            for (name, kind, value), share in zip(rows, point, strict=True)
        }
        return replace(given, modifiers=free)

    return [given, *map(at, shares[: count - 1])]


def starts_of(problem: Problem, starts: Sequence[Trainable], trained: Sequence[Trained]) -> Starts:
    """What became of several starts."""
    names = problem.modifiers.names

    def values(of: Trainable) -> list[float]:
        params = problem.assemble(of)
        return [float(params[name]) for name in names]

    deciding = [
        t.history.full_loss if t.best.validation is None else t.history.validation_loss
        for t in trained
    ]
    return Starts(
        names=names,
        values=np.array([values(start) for start in starts]),
        reached=np.array([values(t.best.trainable) for t in trained]),
        loss_before=np.array([rows[0, 1] for rows in deciding]),
        loss=np.array([t.best.score for t in trained]),
        updates=np.array([t.history.epochs for t in trained]),
        finished=np.array([t.finished for t in trained]),
    )


class Rung(NamedTuple):
    """So many planned updates, after which only the best go on, and how many."""

    at: int
    keep: int


class Halving(NamedTuple):
    """Successive halving: all trainings make a few updates, the best go on, and the best of these to the end.

    K. Jamieson, A. Talwalkar: Non-stochastic Best Arm Identification and Hyperparameter Optimization, AISTATS 2016.
    Here a quarter goes on in place of a half, since good starts differ from others by more than the noise of a score.
    Without rungs, all go on.

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
