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
from acausal.training.checkpoint import Keep, Snapshot, Stored
from acausal.training.held_out import HeldOut
from acausal.training.history import History, Log
from acausal.training.lbfgs import Search
from acausal.training.problem import Problem, Simulated, Trainable
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
    problem: Problem,
    legs: Sequence[Leg],
    key: Array,
    observers: Sequence[Observer],
    keep: Keep = lambda snapshot, rows: None,
    stored: Stored | None = None,
    held: HeldOut | None = None,
) -> Trained:
    """Train leg by leg, each from where the one before was best, or until the user interrupts.

    Arguments:
        problem: what every leg serves: evaluations over the whole record, among which the best is chosen where
            nothing is held out.
        legs: what to minimise and how.
        key: source of all batches.
        observers: called about twice a second. A `KeyboardInterrupt` in one ends the training as Ctrl-C does.
        keep: called with all that is needed to go on from there, before the first update and after every few.
        stored: where to go on from; by default from the start.
        held: what is held out; the best is the one with the lowest loss over it.

    Raises:
        TrainingError: if `PATIENCE` updates in a row had to be rejected.
        DataError: if what was stored is of another training.
    """
    run = _Run(problem, legs, key, observers, keep, held)
    interrupted = False
    if stored is None:
        run.evaluate(shared(problem.start(), problem.mesh))
        first, state = 0, None
    else:
        first, state = run.resume(stored)
    try:
        for i in range(first, len(legs)):
            run.follow(i, run.enter(i) if state is None else state)
            state = None
    except KeyboardInterrupt:
        interrupted = True
        run.evaluate(run.last)
    return Trained(
        run.best,
        run.log.history(),
        time.perf_counter() - run.began,
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
        legs: Sequence[Leg],
        key: Array,
        observers: Sequence[Observer],
        keep: Keep,
        held: HeldOut | None,
    ) -> None:
        self.began = time.perf_counter()
        self.mesh, self.problem = problem.mesh, shared(problem, problem.mesh)
        self.held = shared(held, problem.mesh)
        self.legs, self.observers, self.keep = legs, observers, keep
        self.keys = [jax.random.fold_in(key, i) if i else key for i in range(len(legs))]
        times = np.asarray(problem.record.steps.t)
        self.log = Log(times, tuple(problem.regularizers), problem.modifiers.names)
        self.epochs = sum(leg.epochs for leg in legs)
        self.compiling = self.updating = 0.0
        self.evaluated = -1
        self.before = 0

    def resume(self, stored: Stored) -> tuple[int, State]:
        """Be where a training was when it was stored; returns its leg and the trainer's state."""
        start, leg = self.problem.start(), self.legs[stored.leg]
        state = begin(leg.trainer, local(_entry(leg, start), self.mesh), self.keys[stored.leg])
        validation = None if self.held is None else 0.0
        like = Snapshot(stored.leg, 0, state, 0.0, 0, start, validation, 0, 0.0, 0.0, 0.0)
        snapshot = shared(stored.snapshot(like), self.mesh)
        self.log.go_on(stored.columns)
        simulated = self.problem.simulate(snapshot.best)
        self.best = Best(
            snapshot.best_loss, snapshot.best_validation, snapshot.best_epoch, snapshot.best, simulated
        )  # fmt: skip
        self.last = snapshot.state.trainable
        self.before, self.evaluated = snapshot.before, snapshot.evaluated
        self.began -= snapshot.seconds
        self.compiling, self.updating = snapshot.compiling, snapshot.updating
        return stored.leg, snapshot.state

    def enter(self, i: int) -> State:
        """The trainer's state at the start of a leg."""
        leg, self.before = self.legs[i], self.log.epochs
        entry = local(_entry(leg, self.best.trainable), self.mesh)
        return shared(begin(leg.trainer, entry, self.keys[i]), self.mesh)

    def follow(self, i: int, state: State) -> None:
        """Make all updates of a leg that are not done yet."""
        leg, log = self.legs[i], self.log
        objective = shared(leg.objective, self.mesh)
        self._keep(i, state)
        if log.epochs - self.before < leg.epochs:
            clock = time.perf_counter()
            jax.block_until_ready(
                advance(objective, leg.trainer, state, state.epoch)
            )  # compiles, and does nothing
            self.compiling += time.perf_counter() - clock
        size = 1
        while (done := log.epochs - self.before) < leg.epochs and not self._is_over(leg, state):
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
            self._keep(i, state)
            progress = Progress(
                log.epochs,
                self.epochs,
                log.loss,
                self.best.score,
                ended - self.began,
                per_epoch,
                tuple(new),
            )
            for observe in self.observers:
                observe(progress)
        self.evaluate(state.trainable)
        self._keep(i, state)

    def _keep(self, leg: int, state: State) -> None:
        """Hand out all that is needed to go on from here."""
        best, seconds = self.best, time.perf_counter() - self.began
        snapshot = Snapshot(
            leg, self.before, state, best.loss, best.epoch, best.trainable, best.validation,
            self.evaluated, seconds, self.compiling, self.updating,
        )  # fmt: skip
        self.keep(snapshot, self.log.rows())

    def evaluate(self, trainable: Trainable) -> None:
        """Simulate what decides, and keep the better of the trainable and the best so far."""
        if self.evaluated == self.log.epochs:
            return
        self.evaluated = self.log.epochs
        simulated = self.problem.simulate(trainable)
        validation = None if self.held is None else _told(self.held.loss(trainable))
        new = Best(_told(simulated.loss), validation, self.log.epochs, trainable, simulated)
        self.log.evaluated(new.loss, math.nan if validation is None else validation)
        if self.log.epochs == 0 or new.score < self.best.score or math.isinf(self.best.score):
            self.best = new
        self.last = trainable

    def _is_over(self, leg: Leg, state: State) -> bool:
        """Whether a leg has nothing more to find, or found nothing better for too long."""
        since = max(self.before, self.best.epoch)
        vain = sum(evaluation.epoch > since for evaluation in self.log.evaluations)
        return _is_converged(state) or (leg.patience is not None and vain >= leg.patience)


def _entry(leg: Leg, best: Trainable) -> Trainable:
    """Where a leg begins: at the best up to now, with as many initial states as it has sequences."""
    needed = leg.objective.start().states
    if needed is None or best.states is None:
        return best
    return replace(best, states=best.states[: len(needed)])


def _told(loss: Array) -> float:
    return float(loss) if math.isfinite(float(loss)) else math.inf


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
