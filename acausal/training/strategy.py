"""Strategies: the legs of a training, one after the other, by name."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any, NamedTuple

import optax

from acausal.errors import TrainingError, nearest
from acausal.training.objective.build_problem import gauss_newton, over_whole_record
from acausal.training.objective.equation_error import equation_error
from acausal.training.objective.problem import Problem, modified
from acausal.training.optimizers.descent import DescentMethod
from acausal.training.optimizers.gradients import Slopes, curvatures, gradients
from acausal.training.optimizers.lbfgs import lbfgs
from acausal.training.optimizers.levenberg_marquardt import levenberg_marquardt
from acausal.training.optimizers.trainer import Trainer

EVALUATIONS = 10
"""Evaluations over the whole record in each leg, where the user does not say how often."""


class Leg(NamedTuple):
    """A part of a training.

    Attributes:
        name: of its kind.
        objective: what it minimises.
        trainer: how.
        epochs: updates at most; fewer where the optimizer finds nothing better.
        evaluate_every: updates between two evaluations over the whole record.
        patience: evaluations without a better one after which it ends; ``None`` for never.
    """

    name: str
    objective: Any
    trainer: Trainer
    epochs: int
    evaluate_every: int
    patience: int | None


class _Kind(NamedTuple):
    """How a kind of leg is made.

    Attributes:
        objective: from the problem.
        optimizer: for a number of updates, where it is not the user's to choose.
        epochs: by default.
        slopes: what its optimizer is told of a point.
    """

    objective: Callable[[Problem], Any]
    optimizer: Callable[[int], optax.GradientTransformation] | None
    epochs: int
    slopes: Slopes = gradients


KINDS = {
    "sequences": _Kind(lambda problem: problem, None, 1000),
    "equation_error": _Kind(equation_error, lambda epochs: lbfgs(), 300),
    "whole_record": _Kind(over_whole_record, lambda epochs: lbfgs(), 200),
    "gauss_newton": _Kind(
        gauss_newton, lambda epochs: levenberg_marquardt(), 50, slopes=curvatures
    ),
}
"""What a training can be made of."""


def legs(
    problem: Problem,
    strategy: str | Sequence[str],
    epochs: int | Sequence[int] | None,
    evaluate_every: int | None,
    patience: int | None,
    optimizer: optax.GradientTransformation | None,
    limit: float,
) -> tuple[Leg, ...]:
    """The legs of a training; arguments as those of `acausal.fit`.

    Raises:
        TrainingError: for a name that is not known, numbers that do not fit, or an optimizer that does not serve.
    """
    names = (strategy,) if isinstance(strategy, str) else tuple(strategy)
    for name in names:
        if name not in KINDS:
            raise TrainingError(f"No strategy '{name}': {nearest(name, KINDS)}")
    if patience is not None and patience < 1:
        raise TrainingError(f"patience={patience}; at least one evaluation is needed.")
    if evaluate_every is not None and evaluate_every < 1:
        raise TrainingError(f"evaluate_every={evaluate_every}; give one update or more.")
    if optimizer is not None and not hasattr(optimizer, "update"):
        raise TrainingError(
            f"optimizer={optimizer!r:.80} is none of optax; give one such as optax.adam(0.01)."
        )
    return tuple(
        _leg(problem, name, count, evaluate_every, patience, optimizer, limit)
        for name, count in zip(names, _epochs(names, epochs), strict=True)
    )


def _epochs(names: tuple[str, ...], given: int | Sequence[int] | None) -> tuple[int, ...]:
    if given is None:
        counts = tuple(KINDS[n].epochs for n in names)
    else:
        counts = (given,) * len(names) if isinstance(given, int | float) else tuple(given)
    if not names or len(counts) != len(names):
        raise TrainingError(
            f"epochs={given} for the strategy {names}: give one number, or one for each leg."
        )
    for count in counts:
        if count != int(count):
            raise TrainingError(f"epochs={given}; give a whole number of updates.")
        if count < 1:
            raise TrainingError(f"epochs={given}; at least one is needed.")
    return counts


def _leg(
    problem: Problem,
    name: str,
    epochs: int,
    evaluate_every: int | None,
    patience: int | None,
    optimizer: optax.GradientTransformation | None,
    limit: float,
) -> Leg:
    kind = KINDS[name]
    if kind.optimizer is not None:
        chosen = kind.optimizer(epochs)
    else:
        chosen = default_optimizer(epochs) if optimizer is None else optimizer
        if isinstance(chosen, DescentMethod) and not problem.sequences.always_alike:
            raise TrainingError(
                "L-BFGS compares losses of the same data, and every batch holds others: take the whole "
                "record (sequence_length=None), or strategy=('sequences', 'whole_record') with another optimizer."
            )
    trainer = Trainer(optax.with_extra_args_support(chosen), limit, modified, kind.slopes)
    every = max(1, epochs // EVALUATIONS) if evaluate_every is None else evaluate_every
    return Leg(name, kind.objective(problem), trainer, epochs, every, patience)


@cache
def default_optimizer(epochs: int) -> optax.GradientTransformation:
    """Adam, its rate falling from 0.01 to 0.0001 as a cosine over the epochs."""
    return optax.adam(optax.cosine_decay_schedule(1e-2, epochs, 1e-2))
