"""Cross-validation: train without a part of the samples, judge on it, and so for each part in turn."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Unpack

import jax
import numpy as np

from acausal._jax import need_double_precision
from acausal.by_name import names_in
from acausal.data import Data, RecordsLike, records_of
from acausal.errors import TrainingError, need_compiled, shown, user_level
from acausal.training.build_problem import build_problem
from acausal.training.cross_validation import CrossValidation, Fold
from acausal.training.halving import halving
from acausal.training.loop import train
from acausal.training.objective.folds import Folds, LeftOut, judged_on, left_out, without
from acausal.training.objective.initial_state import check_records
from acausal.training.objective.problem import Problem
from acausal.training.options import FitKeywords, FitOptions, documented
from acausal.training.progress import display
from acausal.training.result import result
from acausal.training.starts import spread_starts, starts_of
from acausal.training.strategy import Leg, legs
from acausal.training.train_from_starts import concerns, limit_of

if TYPE_CHECKING:
    from acausal.system import System

REFUSED = {
    "validation": "it holds out each part in turn itself",
    "checkpoint": "a fold is trained at once",
    "devices": "folds are trained on one device",
}
"""Options that a cross-validation does not have."""


@documented
def cross_validate(
    system: System,
    data: RecordsLike,
    targets: str | Sequence[str],
    *,
    folds: Folds = "records",
    params: Mapping[str, Any] | None = None,
    seed: int = 0,
    **options: Unpack[FitKeywords],
) -> CrossValidation:
    """Train without a part of the samples and judge the model on it, for each part in turn.

    All folds share one compiled program. What is left out decides nothing: the best state of a fold is the one with the
    lowest loss over what it is trained on. A record that is left out is predicted from the state at its start, with the
    parameters that are expected of other records where they differ (``per_record``).

    Arguments:
        system, data, targets: as of `acausal.fit`.
        folds: ``"records"`` leaves out each record in turn; a number leaves out each of so many blocks of time of every
            record. The model is simulated through a block, but compared only outside of it.
        params, seed: as of `acausal.fit`, the same for all folds.
        options: see `acausal.training.FitOptions`, each by its name. Not ``validation``, ``checkpoint`` and
            ``devices``.

    Returns:
        The folds with their losses and errors. After Ctrl-C those that are complete, if there are two.

    Raises:
        DataError, TrainingError: as `acausal.fit` does; for folds without samples to train on or to be judged on.
        TypeError: for a keyword that is not an option.
    """
    need_compiled(system, "cross_validate")
    chosen = FitOptions.of("cross_validate", options)
    for name, reason in REFUSED.items():
        if getattr(chosen, name) is not None:
            raise TrainingError(f"cross_validate has no {name}=: {reason}; leave it out.")
    if not isinstance(seed, int | np.integer):
        raise TrainingError(f"seed={shown(seed)}; give a whole number.")
    need_double_precision()
    given = {n: record.for_system(system) for n, record in records_of(data).items()}
    check_records(chosen.x0, given)
    start = {**system.parameters(seed), **(params or {})}
    problem = build_problem(system, given, names_in(targets, "targets"), start, chosen)
    parts = left_out(problem.records, folds)
    plan = legs(problem, chosen, limit_of(chosen))
    found: list[Fold] = []
    for part in parts:
        fold = _fold(problem, plan, part, given, chosen, int(seed))
        if fold.fit.interrupted:
            break
        found.append(fold)
    if len(found) < 2:
        raise KeyboardInterrupt
    return CrossValidation(tuple(found))


def _fold(
    problem: Problem,
    plan: Sequence[Leg],
    part: LeftOut,
    data: Mapping[str, Data],
    options: FitOptions,
    seed: int,
) -> Fold:
    """One fold; its program is that of the others, because its trainers are."""
    own = without(problem, part)
    judged = judged_on(problem, part, data, options.x0)
    own_plan = [
        leg._replace(trainer=common.trainer)
        for leg, common in zip(legs(own, options, limit_of(options)), plan, strict=True)
    ]
    starts = spread_starts(own, options.starts, seed)
    keys = [jax.random.key(seed)] * len(starts)
    epochs = sum(leg.epochs for leg in plan)
    with display(options.progress and jax.process_index() == 0, epochs) as show:
        observers = (show, *options.all_observers)
        chosen = halving(options.starts, epochs)
        trained = train(own, starts, own_plan, keys, observers, halving=chosen)
    table = starts_of(own, starts, trained) if len(starts) > 1 else None
    best = 0 if table is None else table.best
    for sentence in concerns(own, starts[best], trained[best]):
        warnings.warn(f"Without '{part.name}': {sentence}", stacklevel=user_level())
    fit = result(own, trained[best], judged, table)
    counted = [
        {n: r for n, r in records.items() if np.isfinite(r.measured).any()}
        for records in (fit.records, fit.held_out)
    ]
    fit = replace(fit, records=counted[0], held_out=counted[1])
    loss = float(judged.loss(fit.trained))
    return Fold(part.name, fit, loss if np.isfinite(loss) else np.inf)
