"""A member: one of the trainings that one program makes; mostly there is but one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jax import Array

from acausal.training.history import Log
from acausal.training.objective.held_out import HeldOut
from acausal.training.objective.problem import Problem, Simulated, Trainable


class Best(NamedTuple):
    """The best state of a training.

    Attributes:
        loss: over the whole record; infinite if the model diverges there.
        validation: loss over what is held out, likewise; ``None`` where nothing is.
        epoch: updates done.
        trainable: what was trained.
        simulated: one simulation of the whole record.
    """

    loss: float
    validation: float | None
    epoch: int
    trainable: Trainable
    simulated: Simulated

    @property
    def score(self) -> float:
        """The loss that decides which is best."""
        return self.loss if self.validation is None else self.validation


class Member:
    """One training on its way: what happened to it, and the best of it.

    Arguments:
        problem: what is evaluated over the whole record.
        held: what is held out, if anything is.
        key: source of all batches.
    """

    best: Best

    def __init__(self, problem: Problem, held: HeldOut | None, key: Array) -> None:
        times = np.asarray(problem.record.steps.t)
        self.problem, self.held, self.key = problem, held, key
        self.log = Log(times, tuple(problem.regularizers), problem.modifiers.names)

    def evaluate(self, trainable: Trainable) -> None:
        """Simulate what decides, and keep the better of the trainable and the best so far."""
        simulated = self.problem.simulate(trainable)
        validation = None if self.held is None else _told(self.held.loss(trainable))
        new = Best(_told(simulated.loss), validation, self.log.epochs, trainable, simulated)
        self.log.evaluated(new.loss, math.nan if validation is None else validation)
        if self.log.epochs == 0 or new.score < self.best.score or math.isinf(self.best.score):
            self.best = new

    def vain(self, since: int) -> int:
        """Evaluations after some updates that found nothing better."""
        begin = max(since, self.best.epoch)
        return sum(evaluation.epoch > begin for evaluation in self.log.evaluations)


def joined(trees: Sequence[Any]) -> Any:
    """Trees of all members with their arrays stacked; that of one alone as it is."""
    return trees[0] if len(trees) == 1 else jax.tree.map(lambda *rows: jnp.stack(rows), *trees)


def parted(tree: Any, count: int, axis: int = 0) -> list[Any]:
    """The tree of each member, with their axis in the arrays taken away; the inverse of `joined`."""
    if count == 1:
        return [tree]
    index = (slice(None),) * axis
    return [jax.tree.map(lambda a, k=k: a[(*index, k)], tree) for k in range(count)]


def _told(loss: Array) -> float:
    return float(loss) if math.isfinite(float(loss)) else math.inf
