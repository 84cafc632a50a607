"""The one way to train a model on its records, from one start or several: `prepare`, then `run`.

`fit`, `ensemble` and `cross_validate` differ only in what they ask for: one training, one for each seed, or one
for each part of the samples that is left out.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import jax
import numpy as np

from acausal.errors import DataError, TrainingError, warn
from acausal.training.auto.noise_scale import noise_scale
from acausal.training.auto.sensitive import HALF, QUARTER, in_pieces, is_sensitive, length_of_pieces
from acausal.training.auto.step_choice import finer_steps
from acausal.training.auto.verdict import explains, step_error
from acausal.training.concerns import concerns
from acausal.training.member import Trained
from acausal.training.objective.down_to_noise import is_down_to_noise
from acausal.training.objective.losses import noise_loss
from acausal.training.objective.problem import Problem
from acausal.training.options import FitOptions
from acausal.training.preparation import Training, prepare
from acausal.training.result import Fit, result
from acausal.training.starts import halving, starts_of
from acausal.training.strategy import StageResult, segments, stage_results
from acausal.training.train import begins, train_here, train_on_workers, train_together

Change = Callable[[Problem], Problem]
"""To another problem of the same records and the same things to train."""

LOGGER = logging.getLogger(__name__)


def run(
    training: Training,
    judged: Problem | None = None,
    prefix: str = "",
    trained: tuple[Trained, ...] | None = None,
) -> tuple[Fit, ...]:
    """Train, from one start or several; the result of each.

    Arguments:
        training: from `prepare`.
        judged: samples that the results tell of although they choose nothing; by default those held out.
        prefix: what warnings begin with.
        trained: what workers have trained already; by default, this trains.

    Raises:
        DataError, TrainingError: as `acausal.fit` does.
    """
    problem, options, from_data = training.problem, training.options, training.automatic
    plan, seeds = training.segments, training.seeds
    problems, starts = begins(training)
    what = ", ".join((*problem.networks, *problem.modifiers.names))
    LOGGER.info(
        "training %s of %s by %s", what, problem.system.flat.name, " and ".join(options.parts)
    )
    if trained is None and options.executor is not None:
        (trained,) = train_on_workers(training)
    elif trained is None:
        trained = train_together(training, starts)
    spread = None
    if options.starts > 1:
        spread = starts_of(problem, starts, trained)
        starts, trained = [starts[spread.best]], (trained[spread.best],)
    problems = [replace(own, mesh=None) for own in problems]
    with suppress(DataError, TrainingError):  # what was found over whole records stays
        pieces = None if judged is not None else _in_pieces(training, problems, trained)
        if pieces is not None:
            shorter = run(pieces, prefix=prefix)
            if max(fit.loss for fit in shorter) < max(one.best.loss for one in trained):
                return shorter
    for one in trained:
        if one.failed is not None and not np.isfinite(one.best.loss):
            raise TrainingError(one.failed)
    errors = _step_errors(problems, trained)
    misread = [() if from_data is None else from_data.concerns(t.best.loss) for t in trained]
    further = (_finer, "finer steps"), (_by_noise, "targets by their noise")
    if any(misread):  # no steps are fine enough for laws that follow what is wrong
        further = ()
    for choose, title in further:
        if (change := choose(training, problems, trained, errors)) is None:
            continue
        changed = _last_part(training, change, f"whole record, {title}")
        keys = [jax.random.key(seed) for seed in seeds]
        onward = [one.best.trainable for one in trained]
        none = halving(1, 0)
        later = train_here(changed, onward, keys, lambda *_: None, None, none, trained[0])
        if _stays_explained(problems, trained, later, change):
            trained = tuple(a.then(b, len(plan)) for a, b in zip(trained, later, strict=True))
            training, plan = changed, (*plan, *changed.segments)
            judged = None if judged is None else change(judged)
            problems = [change(own) for own in problems]
            errors = _step_errors(problems, trained)
    for own, start, one, said in zip(problems, starts, trained, misread, strict=True):
        LOGGER.info(
            "trained in %.3g s: loss %.4g at epoch %d", one.seconds, one.best.loss, one.best.epoch
        )
        limited = one.interrupted or options.epochs is not None
        whole = options.automatic and options.sample_weights is None and not limited
        for sentence in (*concerns(own, start, one, whole=whole), *said):
            warn(f"{prefix}{sentence}")
    described = options.described()
    linear = None if from_data is None else from_data.linear
    loose = () if linear is None else linear.loose
    first = None if linear is None else StageResult(linear.title, linear.loss, 0)
    return tuple(
        result(
            own,
            one,
            training.seconds,
            judged or training.held,
            starts=spread,
            settings={"seed": str(seed), **described},
            stages=stage_results(one.history, plan, first),
            step_error=error,
            without_constant=loose,
            not_laws=() if from_data is None else from_data.not_laws,
            pieces=0 if from_data is None else from_data.pieces,
            misread=said,
        )
        for own, one, seed, error, said in zip(
            problems, trained, seeds, errors, misread, strict=True
        )
    )


def _in_pieces(
    training: Training, problems: Sequence[Problem], trained: Sequence[Trained]
) -> Training | None:
    """The training on pieces of the records, if it is sensitive to its starts and has not explained the whole ones.

    It begins again from its arguments, and pieces that were too long are cut once more. ``None`` where the options say
    more of records or of their starts than pieces would keep.
    """
    options: FitOptions = training.arguments["options"]
    told = (options.validation, options.sample_weights, options.per_record, options.delays)
    plain = options.x0 in ("auto", "fit") and options.record_weights == "samples"
    if (
        training.automatic is None
        or not plain
        or any((*told, options.lags, training.problem.system.remembered))
        or any(one.interrupted for one in trained)
    ):
        return None
    cut = training.automatic.pieces > 0
    lengths = [
        length_of_pieces(own, one.best.trainable, one.simulated, QUARTER if cut else HALF)
        for own, one in zip(problems, trained, strict=True)
        if _needs_pieces(own, one, cut=cut)
    ]
    if not lengths:
        return None
    measured = set.intersection(*(set(data.signals) for data in training.records.values()))
    begin = tuple(n for n in problems[0].system.states if n in measured)
    pieces = in_pieces(training.records, min(lengths), begin, again=cut)
    if pieces is None:
        return None
    LOGGER.info("too sensitive for whole records: training on %d pieces of them", len(pieces))
    found = options.x0 == "fit" or len(begin) < len(problems[0].system.states)
    own = replace(options, checkpoint=None, resume=False, x0="fit" if found else "auto")
    arguments: dict[str, Any] = {**training.arguments, "data": pieces, "options": own}
    prepared = prepare(**arguments)
    seconds = training.seconds + trained[0].seconds + prepared.seconds
    assert prepared.automatic is not None
    chosen = replace(prepared.automatic, pieces=len(pieces))
    return replace(prepared, seconds=seconds, automatic=chosen)


def _needs_pieces(problem: Problem, trained: Trained, *, cut: bool) -> bool:
    """Whether whole records were not explained, or pieces of them, as the model is sensitive or has run away."""
    best = trained.best
    if _explained(problem, trained):
        return False
    lost = trained.failed is not None or not np.isfinite(best.loss)
    return cut or lost or is_sensitive(problem, best.trainable, trained.simulated)


def _step_errors(problems: Sequence[Problem], trained: Sequence[Trained]) -> list[float | None]:
    """The errors of the steps at the end of each training; ``None`` for records that are streamed."""
    return [
        None if own.streamed else step_error(own, one.best.trainable, one.simulated)
        for own, one in zip(problems, trained, strict=True)
    ]


def _finer(
    training: Training,
    problems: Sequence[Problem],
    trained: Sequence[Trained],
    errors: Sequence[float | None],
) -> Change | None:
    """To finer steps, if the chosen ones err by more than they may and the model is not too sensitive for any."""
    step = None if training.automatic is None else training.automatic.step
    if step is None or any(one.interrupted for one in trained):
        return None
    error, loss = max((e or 0.0, one.best.loss) for e, one in zip(errors, trained, strict=True))
    finer = finer_steps(step, error, loss)
    if finer is None or any(
        is_sensitive(own, one.best.trainable, one.simulated)
        for own, one in zip(problems, trained, strict=True)
    ):
        return None
    return finer.over


def _by_noise(
    training: Training,
    problems: Sequence[Problem],
    trained: Sequence[Trained],
    errors: Sequence[float | None],
) -> Change | None:
    """To a loss that counts targets by their noise, if they are explained and it differs much among them."""
    options, problem = training.options, problems[0]
    told = options.sample_weights is not None or options.epochs is not None
    if training.automatic is None or told or any(one.interrupted for one in trained):
        return None
    for own, one in zip(problems, trained, strict=True):
        if not is_down_to_noise(own.records, one.best.loss, _noise_loss(own, one)):
            return None
    error = max(e or 0.0 for e in errors)
    scale = noise_scale(problem, [one.simulated.y for one in trained], error)
    return None if scale is None else lambda of: of.scaled(scale)


def _stays_explained(
    problems: Sequence[Problem],
    trained: Sequence[Trained],
    later: Sequence[Trained],
    change: Change,
) -> bool:
    """Whether what was explained before is so after a change, and nothing has diverged."""
    return all(
        np.isfinite(b.best.loss) and (_explained(change(own), b) or not _explained(own, a))
        for own, a, b in zip(problems, trained, later, strict=True)
    )


def _explained(problem: Problem, trained: Trained) -> bool:
    """Whether the best of a training explains its records."""
    return explains(problem, trained.best.loss, _noise_loss(problem, trained))


def _noise_loss(problem: Problem, trained: Trained) -> float:
    """The loss of the noise, as the best of a training leaves it."""
    return noise_loss(problem.records, trained.simulated.y)


def _last_part(training: Training, change: Change, title: str) -> Training:
    """The last part of a training once more, over a changed problem."""
    assert training.automatic is not None
    stage = training.automatic.stages[-1]._replace(title=title, above=0.0)
    problem, held = change(training.problem), training.held
    return replace(
        training,
        problem=problem,
        held=None if held is None else change(held),
        segments=segments(problem, (stage,), training.options),
    )
