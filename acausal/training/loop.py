"""The loop of a training: chunks of updates, evaluations in between, an end by plan or by Ctrl-C."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jax import Array

from acausal.errors import TrainingError
from acausal.training.history import History, Log
from acausal.training.problem import Problem, Trainable
from acausal.training.progress import Observer, Progress
from acausal.training.trainer import CHUNK, State, Trainer, advance

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
    problem: Problem,
    trainer: Trainer,
    state: State,
    epochs: int,
    evaluate_every: int,
    observers: Sequence[Observer],
) -> Trained:
    """Train until ``epochs`` updates are done, or until the user interrupts.

    Arguments:
        problem: what to minimise.
        trainer: how.
        state: where to begin.
        epochs: updates.
        evaluate_every: updates between two evaluations over the whole record, among which the best is chosen.
        observers: called about twice a second. A `KeyboardInterrupt` in one ends the training as Ctrl-C does.

    Raises:
        TrainingError: if `PATIENCE` updates in a row had to be rejected.
    """
    began = time.perf_counter()
    times = np.asarray(problem.record.steps.t)
    log = Log(times, tuple(problem.regularizers), problem.modifiers.names)
    best = _evaluate(problem, state, log, None)
    compiling = updating = 0.0
    interrupted, evaluated, size = False, 0, 1
    try:
        clock = time.perf_counter()
        jax.block_until_ready(
            advance(problem, trainer, state, state.epoch)
        )  # compiles, and does nothing
        compiling = time.perf_counter() - clock
        while log.epochs < epochs:
            due = min(evaluated + evaluate_every, epochs)
            count = min(size, due - log.epochs, CHUNK)
            clock = time.perf_counter()
            state, entry = jax.block_until_ready(
                advance(problem, trainer, state, jnp.asarray(log.epochs + count, int))
            )
            ended = time.perf_counter()
            new = log.add(entry, count, clock - began, ended - began)
            per_epoch = (ended - clock) / count
            updating += ended - clock
            size = max(1, min(CHUNK, int(LOOK / per_epoch)))
            _check_rejections(log, int(state.rejected))
            if log.epochs == due:
                evaluated = due
                best = _evaluate(problem, state, log, best)
            progress = Progress(
                log.epochs, epochs, log.loss, best.loss, ended - began, per_epoch, tuple(new)
            )
            for observe in observers:
                observe(progress)
    except KeyboardInterrupt:
        interrupted = True
    if evaluated != log.epochs:
        best = _evaluate(problem, state, log, best)
    return Trained(
        best, log.history(), time.perf_counter() - began, compiling, updating, interrupted
    )


def _evaluate(problem: Problem, state: State, log: Log, best: Best | None) -> Best:
    """Simulate the whole record, and keep the better of the state and the best so far."""
    value, x = problem.simulate(state.trainable)
    loss = float(value) if math.isfinite(float(value)) else math.inf
    log.evaluated(loss)
    if best is None or loss < best.loss or math.isinf(best.loss):
        return Best(loss, log.epochs, state.trainable, x)
    return best


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
