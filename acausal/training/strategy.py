"""Strategies: the segments of a training, one after the other, by name."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
import optax

from acausal._jax import DescentMethod, levenberg_marquardt
from acausal.errors import TrainingError
from acausal.training.history import History
from acausal.training.objective.equation_error import equation_error
from acausal.training.objective.problem import Problem
from acausal.training.objective.whole_record import (
    gauss_newton,
    over_beginnings,
    over_whole_record,
    over_windows,
)
from acausal.training.optimizers.gradients import (
    Evaluate,
    with_gauss_newton_hessian,
    with_gradient,
)
from acausal.training.optimizers.lbfgs import lbfgs
from acausal.training.optimizers.trainer import Trainer
from acausal.training.options import FitOptions

DIVERGED = 1e3
"""A sequence whose normalised error is larger has diverged."""

EVALUATIONS = 10
"""Evaluations over the whole record in each segment, by default."""


class Stage(NamedTuple):
    """What a part of a training does, before there is a problem.

    Attributes:
        kind: one of the `UPDATES` of the options.
        epochs: updates at most.
        title: what to call it.
        rows: of windows that lie side by side and start from measured states; of whole records, the first ones;
            ``None`` for what the options say, or for all.
        descent: whether windows are trained by L-BFGS, all at once.
        above: it is left out where the loss over the whole record is not above so many times that of the noise.
        onward: whether the next part goes on from its end, and not from the best over the whole record.
        gain: it ends when an evaluation is not better by this part than the one before.
        every: updates between two evaluations, where the options do not say; ``None`` for a tenth of its updates.
        may_fail: whether updates that are rejected over and over end it, and not the whole training.
    """

    kind: str
    epochs: int
    title: str = ""
    rows: int | None = None
    descent: bool = False
    above: float = 0.0
    onward: bool = False
    gain: float = 0.0
    every: int | None = None
    may_fail: bool = False


class Segment(NamedTuple):
    """A part of a training.

    Attributes:
        stage: what it does.
        objective: what it minimises.
        trainer: how.
        epochs: updates at most; fewer where the optimizer finds nothing better.
        evaluate_every: updates between two evaluations over the whole record.
        patience: evaluations without a better one after which it ends; ``None`` for never.
    """

    stage: Stage
    objective: Problem
    trainer: Trainer
    epochs: int
    evaluate_every: int
    patience: int | None

    @property
    def name(self) -> str:
        """Of its kind."""
        return self.stage.kind

    def over(self, problem: Problem) -> Segment:
        """The same part with the same trainer, and so the same program, for a problem of the same shapes."""
        return self._replace(objective=_objective(self.stage, problem))


class _Kind(NamedTuple):
    """A kind of segment.

    Attributes:
        objective: from the problem.
        optimizer: ``None`` where the user chooses it.
        evaluate: computes the derivatives that the optimizer needs.
    """

    objective: Callable[[Problem], Problem]
    optimizer: Callable[[], optax.GradientTransformation] | None
    evaluate: Evaluate = with_gradient


KINDS = {
    "sequences": _Kind(lambda problem: problem, None),
    "equation_error": _Kind(equation_error, lbfgs),
    "whole_record": _Kind(over_whole_record, lbfgs),
    "gauss_newton": _Kind(gauss_newton, levenberg_marquardt, with_gauss_newton_hessian),
}
"""The kinds of segments; their names and numbers of updates are in `UPDATES` of the options."""


def stages(options: FitOptions) -> tuple[Stage, ...]:
    """The stages of a strategy that the user has named."""
    parts = zip(options.parts, options.updates, strict=True)
    return tuple(Stage(name, count, name.replace("_", " ")) for name, count in parts)


def segments(
    problem: Problem, planned: Sequence[Stage], options: FitOptions
) -> tuple[Segment, ...]:
    """The segments of a training.

    Raises:
        TrainingError: for an optimizer or a problem that a segment cannot have.
    """
    return tuple(_segment(problem, stage, options) for stage in planned)


def _objective(stage: Stage, problem: Problem) -> Problem:
    if stage.rows is None:
        return KINDS[stage.kind].objective(problem)
    cut = over_windows if stage.kind == "sequences" else over_beginnings
    return cut(problem, stage.rows)


def _segment(problem: Problem, stage: Stage, options: FitOptions) -> Segment:
    epochs, kind = stage.epochs, KINDS[stage.kind]
    if stage.descent:
        chosen = lbfgs()
    elif kind.optimizer is not None:
        chosen = kind.optimizer()
    else:
        chosen = default_optimizer(epochs) if options.optimizer is None else options.optimizer
        if isinstance(chosen, DescentMethod) and not problem.sequences.always_alike:
            raise TrainingError(
                "L-BFGS compares losses of the same data, and every batch holds others: take the whole "
                "record (sequence_length=None), or strategy=('sequences', 'whole_record') with another optimizer."
            )
    limit = DIVERGED if options.loss == "nrmse" else math.inf  # of a user's loss nothing is known
    trainer = Trainer(optax.with_extra_args_support(chosen), limit, Problem.changes, kind.evaluate)
    every = options.evaluate_every
    if every is None:
        every = stage.every or max(1, epochs // EVALUATIONS)
    return Segment(stage, _objective(stage, problem), trainer, epochs, every, options.patience)


@cache
def default_optimizer(epochs: int) -> optax.GradientTransformation:
    """Adam, its rate falling from 0.01 to 0.0001 as a cosine over the epochs."""
    return optax.adam(optax.cosine_decay_schedule(1e-2, epochs, 1e-2))


class StageResult(NamedTuple):
    """What a stage reached.

    Attributes:
        title: what it did.
        loss: the lowest over the whole record among its evaluations.
        updates: that it made.
    """

    title: str
    loss: float
    updates: int


def stage_results(
    history: History, segments: Sequence[Segment], linear: StageResult | None
) -> tuple[StageResult, ...]:
    """The stages that a training has gone through, behind the linear laws that it started from, if there are any."""
    found = [] if linear is None else [linear]
    epochs, losses = history.full_loss.T
    for i, segment in enumerate(segments):
        own = np.flatnonzero(history.part == i)
        if len(own):
            inside = (epochs > own[0]) & (epochs <= own[-1] + 1)
            loss = float(np.min(losses[inside], initial=np.inf))
            found.append(StageResult(segment.stage.title, loss, len(own)))
    return tuple(found)
