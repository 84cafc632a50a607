"""The one way to train a model on its records, from one start or several: `prepare`, then `run`.

`fit`, `ensemble` and `cross_validate` differ only in what they ask for: one training, one for each seed, or one
for each part of the samples that is left out.
"""

from __future__ import annotations

import logging
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax
import numpy as np
from jaxtyping import PRNGKeyArray, PyTree

from acausal._jax import need_double_precision, need_known
from acausal.data import Data, RecordsLike, records_of
from acausal.errors import DataError, TrainingError, need_whole, shown, user_level
from acausal.modeling import names_in
from acausal.training import checkpoint as checkpoints
from acausal.training.auto.automatic import Automatic, automatic
from acausal.training.auto.step_choice import StepChoice, finer_steps
from acausal.training.auto.verdict import step_error
from acausal.training.build_problem import build_problem
from acausal.training.concerns import concerns
from acausal.training.fingerprint import fingerprint
from acausal.training.logs import log_progress
from acausal.training.member import Trained
from acausal.training.objective.held_out import HeldOut, hold_out, split
from acausal.training.objective.initial_state import check_records
from acausal.training.objective.prior import entry
from acausal.training.objective.problem import Problem
from acausal.training.objective.sharding import on_default_device
from acausal.training.objective.trainable import Trainable
from acausal.training.options import FitOptions
from acausal.training.progress import Observer, after, display
from acausal.training.result import Fit, result
from acausal.training.starts import Halving, halving, spread_starts, starts_of
from acausal.training.strategy import Segment, segments, stage_results, stages
from acausal.training.training_run import TrainingRun

if TYPE_CHECKING:
    from acausal.system import System

LOGGER = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class Training:
    """Trainings of one model on its records that are ready to run, in one program.

    Attributes:
        problem: what is trained; parameters that are not trained are those of the first start.
        records: to train on, by name, in the model's units.
        held: what is held out and chooses the best state, if anything is.
        segments: what to do, one part after the other.
        options: how to train.
        seeds: one for each training; ``params``: the parameters where each starts.
        automatic: what was chosen from the data, with ``strategy="auto"``.
    """

    problem: Problem
    records: dict[str, Data]
    held: HeldOut | None
    segments: tuple[Segment, ...]
    options: FitOptions
    seeds: Sequence[int]
    params: Sequence[Mapping[str, Any]]
    automatic: Automatic | None = None


def prepare(
    system: System,
    data: RecordsLike,
    targets: str | Sequence[str],
    options: FitOptions,
    *,
    seeds: Sequence[int],
    params: Sequence[Mapping[str, Any] | None],
) -> Training:
    """Check what is to be trained, and build the problem.

    Arguments:
        system, data, targets: as of `acausal.fit`.
        options: the same for all.
        seeds: one for each training.
        params: by training, what differs from the parameters that the model has for its seed, or its prior knows.

    Raises:
        DataError, TrainingError: as `acausal.fit` does.
    """
    by_name = [v for v in vars(options).values() if isinstance(v, Mapping)]
    need_known("A training", params, by_name, error=TrainingError)
    for given in params:
        if not isinstance(given, Mapping | None):
            raise DataError(f"params={shown(given)} are not parameters; give a mapping by name.")
    for seed in seeds:
        need_whole(seed, "seed", TrainingError)
    need_double_precision()
    starts = [
        {**entry(system.parameters(seed), options.prior), **(given or {})}
        for seed, given in zip(seeds, params, strict=True)
    ]
    system = system.watching(_trained_numbers(options))
    records = {n: record.for_system(system) for n, record in records_of(data).items()}
    kept = split(records, options.validation)
    names = names_in(targets, "targets")
    check_records(options.x0, (*records, *(kept.held or {})))
    from_data = None
    if options.automatic:
        with warnings.catch_warnings():  # the problem of the training warns again
            warnings.simplefilter("ignore")
            from_data = automatic(system, kept.training, names, starts, options)
        options, starts = from_data.options, list(from_data.params)
    problem = build_problem(system, kept.training, names, dict(starts[0]), options)
    held = hold_out(problem, kept, options.x0)
    planned = stages(options) if from_data is None else from_data.stages
    plan = segments(problem, planned, options)
    return Training(problem, kept.training, held, plan, options, seeds, starts, from_data)


def run(training: Training, judged: HeldOut | None = None, prefix: str = "") -> tuple[Fit, ...]:
    """Train, from one start or several; the result of each.

    Arguments:
        training: from `prepare`.
        judged: samples that the results tell of although they choose nothing; by default those held out.
        prefix: what warnings begin with.

    Raises:
        DataError, TrainingError: as `acausal.fit` does.
    """
    problem, options, from_data = training.problem, training.options, training.automatic
    plan, seeds = training.segments, training.seeds
    problems = [_from(problem, own) for own in training.params]
    starts = [start for p in problems for start in spread_starts(p, options.starts, seeds[0])]
    if from_data is not None and options.starts == 1:
        starts = [from_data.begin(problem, start) for start in starts]
    identity: dict[str, str] = {}
    if options.checkpoint is not None:
        identity = fingerprint(problem, plan, seeds, starts[1:], training.held, training.records)
    path, stored = _checkpoint(options, identity)
    what = ", ".join((*problem.networks, *problem.modifiers.names))
    LOGGER.info(
        "training %s of %s by %s", what, problem.system.flat.name, " and ".join(options.parts)
    )
    path = path if jax.process_index() == 0 else None
    with checkpoints.keeping(path, options.checkpoint_every, identity) as keep:
        keys = [jax.random.key(seed) for seed in seeds for _ in range(options.starts)]
        ends = halving(options.starts, sum(segment.epochs for segment in plan))
        trained = _trained(training, starts, keys, keep, stored, ends)
    spread = None
    if options.starts > 1:
        spread = starts_of(problem, starts, trained)
        starts, trained = [starts[spread.best]], (trained[spread.best],)
    problems = [replace(own, mesh=None) for own in problems]
    errors = _step_errors(training, problems, trained)
    if (step := _finer(training, trained, errors)) is not None:
        finer = _in_steps(training, step)
        keys = [jax.random.key(seed) for seed in seeds]
        begins = [one.best.trainable for one in trained]
        none = halving(1, 0)
        later = _trained(finer, begins, keys, lambda *_: None, None, none, trained[0])
        if all(np.isfinite(one.best.loss) for one in later):
            trained = tuple(a.then(b, len(plan)) for a, b in zip(trained, later, strict=True))
            training, plan = finer, (*plan, *finer.segments)
            judged = None if judged is None else HeldOut(step.over(judged.problem))
            problems = [step.over(own) for own in problems]
            errors = _step_errors(training, problems, trained)
    for own, start, one in zip(problems, starts, trained, strict=True):
        LOGGER.info(
            "trained in %.3g s: loss %.4g at epoch %d", one.seconds, one.best.loss, one.best.epoch
        )
        for sentence in concerns(own, start, one):
            warnings.warn(f"{prefix}{sentence}", stacklevel=user_level())
    described = options.described()
    linear = None if from_data is None or from_data.linear is None else from_data.linear.loss
    return tuple(
        result(
            own,
            one,
            judged or training.held,
            spread,
            {"seed": str(seed), **described},
            stage_results(one.history, plan, linear),
            error,
            () if from_data is None else from_data.not_laws,
        )
        for own, one, seed, error in zip(problems, trained, seeds, errors, strict=True)
    )


def _trained(
    training: Training,
    starts: Sequence[Trainable],
    keys: Sequence[PRNGKeyArray],
    keep: checkpoints.Keep,
    stored: checkpoints.Stored | None,
    ends: Halving,
    before: Trained | None = None,
) -> tuple[Trained, ...]:
    """Train, and display it; after another training, observers are told of the updates and the time of both."""
    options, epochs = training.options, sum(segment.epochs for segment in training.segments)
    observers: tuple[Observer, ...] = (log_progress, *options.all_observers)
    if before is not None:
        observers = tuple(after(one, before.history.epochs, before.seconds) for one in observers)
    with display(options.progress and jax.process_index() == 0, epochs) as show:
        found = TrainingRun(
            training.problem, training.segments, keys, (show, *observers), keep, training.held, ends
        ).train(starts, stored)
    mesh = training.problem.mesh
    return tuple(replace(one, best=on_default_device(one.best, mesh)) for one in found)


def _step_errors(
    training: Training, problems: Sequence[Problem], trained: Sequence[Trained]
) -> list[float | None]:
    """The errors of the steps at the end of each training; ``None`` where the user has chosen all."""
    if training.automatic is None:
        return [None] * len(trained)
    bests = [one.best for one in trained]
    return [
        step_error(own, best.trainable, best.simulated)
        for own, best in zip(problems, bests, strict=True)
    ]


def _finer(
    training: Training, trained: Sequence[Trained], errors: Sequence[float | None]
) -> StepChoice | None:
    """Finer steps, if those that were chosen err by more than they may."""
    step = None if training.automatic is None else training.automatic.step
    if step is None or any(one.interrupted for one in trained):
        return None
    error, loss = max((e or 0.0, one.best.loss) for e, one in zip(errors, trained, strict=True))
    return finer_steps(step, error, loss)


def _in_steps(training: Training, step: StepChoice) -> Training:
    """The last part of a training once more, in other steps."""
    assert training.automatic is not None
    last = training.automatic.stages[-1]
    stage = last._replace(title=f"{last.title}, finer steps", above=-np.inf)
    problem, held = step.over(training.problem), training.held
    return replace(
        training,
        problem=problem,
        held=None if held is None else HeldOut(step.over(held.problem)),
        segments=segments(problem, (stage,), training.options),
    )


def _trained_numbers(options: FitOptions) -> tuple[str, ...]:
    """The parameters that are trained beside networks."""
    moved = options.modifiers
    named = () if moved is None or isinstance(moved, Iterator) else tuple(moved)
    return (*named, *(options.per_record or ()))


def _from(problem: Problem, params: Mapping[str, Any]) -> Problem:
    """The problem whose training starts from the networks of other parameters.

    Raises:
        TrainingError: if they are of another kind.
    """
    for name in problem.networks:
        if _shape(params[name]) != _shape(problem.params[name]):
            raise TrainingError(
                f"The networks '{name}' of the members differ in architecture: give all of them the same."
            )
    networks = {name: params[name] for name in problem.networks}
    return replace(problem, params={**problem.params, **networks})


def _shape(network: PyTree) -> PyTree:
    arrays, rest = eqx.partition(network, eqx.is_inexact_array)
    return jax.tree.map(lambda a: (a.shape, a.dtype), arrays), jax.tree.structure(rest)


def _checkpoint(
    options: FitOptions, identity: Mapping[str, str]
) -> tuple[Path | None, checkpoints.Stored | None]:
    """Where to write checkpoints, and the one to continue from."""
    if options.checkpoint is None:
        if options.resume:
            raise TrainingError("resume=True needs a checkpoint to go on from: checkpoint='...'.")
        return None, None
    file = checkpoints.place(options.checkpoint)
    if not file.exists():
        return file, None
    if not options.resume:
        raise TrainingError(
            f"There is a checkpoint '{file}' already: resume=True goes on from it; "
            "to start again, remove it or name another file."
        )
    return file, checkpoints.read(file, identity)
