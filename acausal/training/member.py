"""A member: one of the trainings in one program; usually there is only one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, TypeVar

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float, PRNGKeyArray, PyTree

from acausal.training.happened import events_in
from acausal.training.history import History, TrainingLog
from acausal.training.objective.losses import noise_loss
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Simulated, Trainable

Tree = TypeVar("Tree")


class Best(NamedTuple):
    """The best state of a training.

    Attributes:
        loss: over the whole record; infinite if the model diverges there.
        validation: loss over the held-out samples, likewise; ``None`` without validation.
        epoch: updates done.
        trainable: what was trained.
    """

    loss: float
    validation: float | None
    epoch: int
    trainable: Trainable

    @property
    def score(self) -> float:
        """The loss that decides which is best."""
        return self.loss if self.validation is None else self.validation


@dataclass(frozen=True, eq=False)
class Trained:
    """The end of a training.

    Attributes:
        best: its best state. simulated: one simulation of the whole record with it.
        last: what was trained, after the last update or evaluation.
        history: the training, update by update.
        seconds: total time; ``compiling``: the part in XLA's compiler; ``updating``: the part in updates.
        interrupted: whether the user ended it.
        failed: why its last part ended early, where its updates were rejected over and over.
        finished: whether it has converged in the last part, or has made all of its updates.
    """

    best: Best
    simulated: Simulated
    last: Trainable
    history: History
    seconds: float
    compiling: float
    updating: float
    interrupted: bool
    failed: str | None
    finished: bool

    def then(self, later: Trained, parts: int) -> Trained:
        """This training, of so many parts, and another one that went on from its best state."""
        best = later.best._replace(epoch=self.history.epochs + later.best.epoch)
        return replace(
            later,
            best=best,
            history=self.history.then(later.history, parts),
            seconds=self.seconds + later.seconds,
            compiling=self.compiling + later.compiling,
            updating=self.updating + later.updating,
        )


class Member:
    """One training while it runs: its log, and its best state.

    Arguments:
        problem: what is evaluated over the whole record.
        held: what is held out, if anything is.
        key: source of all batches.

    Attributes:
        best: its best state. simulated: one simulation of the whole record with it.
        before: its updates before the present part of the strategy.
        failed: why that part has ended, as of `Trained`.
    """

    best: Best
    simulated: Simulated
    before: int = 0
    failed: str | None = None

    def __init__(self, problem: Problem, held: Problem | None, key: PRNGKeyArray) -> None:
        self.problem, self.held, self.key = problem, held, key
        self.log = TrainingLog(problem.places, tuple(problem.regularizers), problem.modifiers.names)

    def evaluate(self, candidates: Sequence[Trainable]) -> None:
        """Evaluate some trainables, log the best of them, and keep it if it is better than the best so far."""
        evaluated = map(self._evaluated, candidates)
        new, simulated = min(evaluated, key=lambda one: self._deciding(one[0]))
        events = events_in(self.problem.records, simulated.log)
        validation = math.nan if new.validation is None else new.validation
        self.log.evaluated(new.loss, validation, events)
        if (
            self.log.epochs == 0
            or self._deciding(new) < self._deciding(self.best)
            or math.isinf(self.best.score)
        ):
            self.best, self.simulated = new, simulated

    def _evaluated(self, trainable: Trainable) -> tuple[Best, Simulated]:
        simulated = self.problem.simulate(trainable)
        validation = (
            None if self.held is None else _finite_or_inf(self.held.held_out_loss(trainable))
        )
        loss = _finite_or_inf(simulated.loss)
        return Best(loss, validation, self.log.epochs, trainable), simulated

    def _deciding(self, best: Best) -> float:
        """The score, weighed by what an earlier training knew where nothing is held out."""
        if best.validation is not None or self.problem.prior is None:
            return best.score
        return float(self.problem.weighed(jnp.asarray(best.loss), best.trainable))

    def noise(self) -> float:
        """The loss that the noise alone leaves, as the best state has it."""
        return noise_loss(self.problem.records, self.simulated.y)

    def evaluations_without_improvement(self) -> int:
        """How many evaluations there were in this part of the strategy since the best one."""
        begin = max(self.before, self.best.epoch)
        return sum(evaluation.epoch > begin for evaluation in self.log.evaluations)

    def gained_less(self, part: float) -> bool:
        """Whether the last of some evaluations in this segment lowered the loss by less than a part of it."""
        losses = [e.loss for e in self.log.evaluations if e.epoch >= self.before]
        if part == 0.0 or len(losses) < 3 or not math.isfinite(losses[-2]):
            return False
        return min(losses) > (1 - part) * min(losses[:-1])


def stacked(trees: Sequence[Tree]) -> Tree:
    """Trees of all members with their arrays stacked; the tree of a single member stays as it is."""
    return trees[0] if len(trees) == 1 else jax.tree.map(lambda *rows: jnp.stack(rows), *trees)


def unstacked(tree: PyTree, count: int, axis: int = 0) -> list[PyTree]:
    """The tree of each member, without the members' axis in its arrays; the inverse of `stacked`."""
    if count == 1:
        return [tree]
    index = (slice(None),) * axis
    return [jax.tree.map(lambda a, k=k: a[(*index, k)], tree) for k in range(count)]


def _finite_or_inf(loss: Float[Array, ""]) -> float:
    return float(loss) if math.isfinite(float(loss)) else math.inf
