"""The loop of a training: chunks of updates, evaluations in between, an end by plan or by Ctrl-C."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jax import Array

from acausal.errors import TrainingError
from acausal.training.history import History, Log
from acausal.training.lbfgs import Search
from acausal.training.problem import Problem, Trainable
from acausal.training.progress import Observer, Progress
from acausal.training.spread import agreed, local, shared
from acausal.training.strategy import Leg
from acausal.training.trainer import CHUNK, State, advance, begin

LOOK = 0.5
"""Seconds between two looks at the training, about."""

PATIENCE = 50
"""So many updates rejected in a row end a training."""


class Best(NamedTuple):
    """The best state of a training.

    Attributes:
        loss: over the whole record; infinite if the model diverges there.
        epoch: updates done.
        trainable: what was trained.
        x: the states at every sample of the record, in one simulation of it.
    """

    loss: float
    epoch: int
    trainable: Trainable
    x: Array


@dataclass(frozen=True, eq=False)
class Trained:
    """How a training ended.

    Attributes:
        best: its best state.
        history: what happened.
        seconds: all of it; ``compiling``: of which in XLA's compiler; ``updating``: of which in updates.
        interrupted: whether the user ended it.
    """

    best: Best
    history: History
    seconds: float
    compiling: float
    updating: float
    interrupted: bool


def train(
    problem: Problem, legs: Sequence[Leg], key: Array, observers: Sequence[Observer]
) -> Trained:
    """Train leg by leg, each from where the one before was best, or until the user interrupts.

    Arguments:
        problem: what every leg serves: evaluations over the whole record, among which the best is chosen.
        legs: what to minimise and how.
        key: source of all batches.
        observers: called about twice a second. A `KeyboardInterrupt` in one ends the training as Ctrl-C does.

    Raises:
        TrainingError: if `PATIENCE` updates in a row had to be rejected.
    """
    began = time.perf_counter()
    times = np.asarray(problem.record.steps.t)
    log = Log(times, tuple(problem.regularizers), problem.modifiers.names)
    run = _Run(problem, observers, log, began, sum(leg.epochs for leg in legs))
    run.evaluate(shared(problem.start(), problem.mesh))
    interrupted = False
    try:
        for i, leg in enumerate(legs):
            run.follow(leg, jax.random.fold_in(key, i) if i else key)
    except KeyboardInterrupt:
        interrupted = True
        run.evaluate(run.last)
    return Trained(
        run.best,
        log.history(),
        time.perf_counter() - began,
        run.compiling,
        run.updating,
        interrupted,
    )


class _Run:
    """A training on its way."""

    best: Best
    last: Trainable

    def __init__(
        self,
        problem: Problem,
        observers: Sequence[Observer],
        log: Log,
        began: float,
        epochs: int,
    ) -> None:
        self.mesh, self.problem = problem.mesh, shared(problem, problem.mesh)
        self.observers, self.log = observers, log
        self.began, self.epochs = began, epochs
        self.compiling = self.updating = 0.0
        self.evaluated = -1

    def follow(self, leg: Leg, key: Array) -> None:
        """Make all updates of a leg."""
        log, first = self.log, self.log.epochs
        entry = local(self._entry(leg), self.mesh)
        objective, state = shared((leg.objective, begin(leg.trainer, entry, key)), self.mesh)
        clock = time.perf_counter()
        jax.block_until_ready(
            advance(objective, leg.trainer, state, state.epoch)
        )  # compiles, and does nothing
        self.compiling += time.perf_counter() - clock
        size = 1
        while (done := log.epochs - first) < leg.epochs and not _is_converged(state):
            due = min((done // leg.evaluate_every + 1) * leg.evaluate_every, leg.epochs)
            count = min(size, due - done, CHUNK)
            clock = time.perf_counter()
            until = shared(jnp.asarray(done + count, int), self.mesh)
            state, told = jax.block_until_ready(advance(objective, leg.trainer, state, until))
            ended = time.perf_counter()
            new = log.add(told, count, clock - self.began, ended - self.began)
            self.last = state.trainable
            per_epoch = agreed((ended - clock) / count, self.mesh)
            self.updating += ended - clock
            size = max(1, min(CHUNK, int(LOOK / per_epoch)))
            _check_rejections(log, int(state.rejected))
            if done + count == due:
                self.evaluate(state.trainable)
            progress = Progress(
                log.epochs,
                self.epochs,
                log.loss,
                self.best.loss,
                ended - self.began,
                per_epoch,
                tuple(new),
            )
            for observe in self.observers:
                observe(progress)
        self.evaluate(state.trainable)

    def _entry(self, leg: Leg) -> Trainable:
        """Where a leg begins: at the best up to now, with as many initial states as it has sequences."""
        best, needed = self.best.trainable, leg.objective.start().states
        if needed is None or best.states is None:
            return best
        return replace(best, states=best.states[: len(needed)])

    def evaluate(self, trainable: Trainable) -> None:
        """Simulate the whole record, and keep the better of the trainable and the best so far."""
        if self.evaluated == self.log.epochs:
            return
        self.evaluated = self.log.epochs
        value, x = self.problem.simulate(trainable)
        loss = float(value) if math.isfinite(float(value)) else math.inf
        self.log.evaluated(loss)
        first = self.log.epochs == 0
        if first or loss < self.best.loss or math.isinf(self.best.loss):
            self.best = Best(loss, self.log.epochs, trainable, x)
        self.last = trainable


def _is_converged(state: State) -> bool:
    return isinstance(state.optimizer, Search) and bool(state.optimizer.converged)


def _check_rejections(log: Log, rejected: int) -> None:
    if rejected < PATIENCE:
        return
    first = log.epochs - rejected
    sequences = [d for d in log.divergences if d.epoch >= first and d.count]
    if sequences:
        what = f"the sequence from t = {sequences[0].time:g} s diverges"
        mend = "Start from smaller networks or better parameters, take shorter sequences, or a smaller dt."
    else:
        what = "the gradient is not finite"
        mend = "Lower the optimizer's rate, or clip the gradient."
    raise TrainingError(
        f"{rejected} updates in a row were rejected from epoch {first} on: {what}. {mend}"
    )
