"""Cross-validation: train without a part of the samples, judge on it, and so for each part in turn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np

from acausal.data import RecordsLike
from acausal.errors import TrainingError, need_compiled
from acausal.training.cross_validation import CrossValidation, Fold
from acausal.training.objective.folds import Folds, LeftOut, judged_on, left_out, without
from acausal.training.options import FitKeywords, FitOptions, documented
from acausal.training.record_fit import RecordFit
from acausal.training.train_from_starts import Training, prepare, run

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
    training = prepare(system, data, targets, chosen, seeds=(seed,), params=(params,))
    found: list[Fold] = []
    for part in left_out(training.problem.records, folds):
        fold = _fold(training, part)
        if fold.fit.interrupted:
            break
        found.append(fold)
    if len(found) < 2:
        raise KeyboardInterrupt
    return CrossValidation(tuple(found))


def _fold(training: Training, part: LeftOut) -> Fold:
    """One fold; its program is that of the others, because its trainers are."""
    own = without(training.problem, part)
    judged = judged_on(training.problem, part, training.records, training.options.x0)
    plan = tuple(leg.over(own) for leg in training.legs)
    (fit,) = run(replace(training, problem=own, legs=plan), judged, f"Without '{part.name}': ")
    fit = replace(fit, records=_counting(fit.records), held_out=_counting(fit.held_out))
    loss = float(judged.loss(fit.trained))
    return Fold(part.name, fit, loss if np.isfinite(loss) else np.inf)


def _counting(records: Mapping[str, RecordFit]) -> dict[str, RecordFit]:
    """The records of which something counts as measured."""
    return {n: r for n, r in records.items() if np.isfinite(r.measured).any()}
