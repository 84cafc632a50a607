"""The one way to train a model on its records, from one start or several: `prepare`, then `run`.

`fit`, `ensemble` and `cross_validate` differ only in what they ask for: one training, one for each seed, or one
for each part of the samples that is left out.
"""

from __future__ import annotations

import logging
import warnings
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax
import numpy as np
from jaxtyping import PyTree

from acausal._jax import need_double_precision, need_known
from acausal.analysis import in_switches
from acausal.codegen import Values
from acausal.data import Data, RecordsLike, records_of
from acausal.errors import DataError, TrainingError, listing, need_whole, shown, user_level
from acausal.modeling import names_in
from acausal.simulation import EXPLICIT, long_steps
from acausal.training import checkpoint as checkpoints
from acausal.training.auto.automatic import Automatic, automatic
from acausal.training.auto.step_choice import finer_steps
from acausal.training.build_problem import build_problem
from acausal.training.fingerprint import fingerprint
from acausal.training.happened import grazing
from acausal.training.logs import log_progress
from acausal.training.member import Best, Trained
from acausal.training.objective.held_out import HeldOut, hold_out, split
from acausal.training.objective.initial_state import check_records
from acausal.training.objective.losses import noise_loss, nrmse
from acausal.training.objective.prior import entry
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable
from acausal.training.options import FitOptions
from acausal.training.progress import display
from acausal.training.rejections import SHORTER_STEPS
from acausal.training.result import Fit, result
from acausal.training.starts import halving, spread_starts, starts_of
from acausal.training.strategy import Leg, legs, stage_results, stages
from acausal.training.training_run import TrainingRun

if TYPE_CHECKING:
    from acausal.system import System

LOGGER = logging.getLogger(__name__)

EXACT = 1e-100
"""A loss at which a model follows its record to roundoff, so that nothing needs to change."""


@dataclass(frozen=True, eq=False)
class Training:
    """Trainings of one model on its records that are ready to run, in one program.

    Attributes:
        problem: what is trained; parameters that are not trained are those of the first start.
        records: to train on, by name, in the model's units.
        held: what is held out and chooses the best state, if anything is.
        legs: what to do, one part after the other.
        options: how to train.
        seeds: one for each training; ``params``: the parameters where each starts.
        automatic: what was chosen from the data, with ``strategy="auto"``.
    """

    problem: Problem
    records: dict[str, Data]
    held: HeldOut | None
    legs: tuple[Leg, ...]
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
    plan = legs(problem, planned, options)
    return Training(problem, kept.training, held, plan, options, seeds, starts, from_data)


def train(
    system: System,
    data: RecordsLike,
    targets: str | Sequence[str],
    options: FitOptions,
    *,
    seeds: Sequence[int],
    params: Sequence[Mapping[str, Any] | None],
) -> tuple[Fit, ...]:
    """`prepare` and `run`; and once more from there, where steps that were chosen err by more than they may.

    Only networks go on: what parameters may change by counts from where they began.
    """
    training = prepare(system, data, targets, options, seeds=seeds, params=params)
    fits = run(training)
    problem, from_data = training.problem, training.automatic
    given = (options.solver, options.rtol, options.atol, options.dt)
    moving = (*problem.modifiers.names, *problem.per_record.names)
    if from_data is None or moving or any(value is not None for value in given):
        return fits
    worst = max(fits, key=lambda fit: fit.step_error or 0.0)
    if any(fit.interrupted for fit in fits) or worst.step_error is None:
        return fits
    finer = finer_steps(training.options, training.records, worst.step_error, worst.loss)
    if finer is None:
        return fits
    kind = from_data.stages[-1].kind
    LOGGER.info(
        "steps err by %.2g: on with %s, dt = %.3g s", worst.step_error, finer.solver, finer.dt
    )
    again = replace(finer, strategy=kind, epochs=None, checkpoint=None, resume=False)
    starts = [fit.params for fit in fits]
    ends = run(prepare(system, data, targets, again, seeds=seeds, params=starts))
    return tuple(
        replace(
            new,
            stages=(
                *old.stages,
                *(s._replace(title=f"{s.title}, finer steps") for s in new.stages),
            ),
        )
        if np.isfinite(new.loss)
        else old
        for old, new in zip(fits, ends, strict=True)
    )


def run(training: Training, judged: HeldOut | None = None, prefix: str = "") -> tuple[Fit, ...]:
    """Train, from one start or several; the result of each.

    Arguments:
        training: from `prepare`.
        judged: samples that the results tell of although they choose nothing; by default those held out.
        prefix: what warnings begin with.

    Raises:
        DataError, TrainingError: as `acausal.fit` does.
    """
    problem, held, options = training.problem, training.held, training.options
    plan, seeds, epochs = training.legs, training.seeds, sum(leg.epochs for leg in training.legs)
    problems = [_from(problem, own) for own in training.params]
    starts = [start for p in problems for start in spread_starts(p, options.starts, seeds[0])]
    if training.automatic is not None and options.starts == 1:
        starts = [training.automatic.begin(problem, start) for start in starts]
    keys = [jax.random.key(seed) for seed in seeds for _ in range(options.starts)]
    identity: dict[str, str] = {}
    if options.checkpoint is not None:
        identity = fingerprint(problem, plan, seeds, starts[1:], held, training.records)
    path, stored = _checkpoint(options, identity)
    what = ", ".join((*problem.networks, *problem.modifiers.names))
    LOGGER.info(
        "training %s of %s by %s", what, problem.system.flat.name, " and ".join(options.parts)
    )
    first = jax.process_index() == 0
    with (
        display(options.progress and first, epochs) as show,
        checkpoints.keeping(path if first else None, options.checkpoint_every, identity) as keep,
    ):
        observers = (show, log_progress, *options.all_observers)
        ends = halving(options.starts, epochs)
        trained = TrainingRun(problem, plan, keys, observers, keep, held, ends).train(
            starts, stored
        )
    for one in trained:
        LOGGER.info(
            "trained in %.3g s: loss %.4g at epoch %d", one.seconds, one.best.loss, one.best.epoch
        )
    spread = None
    if options.starts > 1:
        spread = starts_of(problem, starts, trained)
        starts, trained = [starts[spread.best]], (trained[spread.best],)
    for own, start, one in zip(problems, starts, trained, strict=True):
        for sentence in concerns(own, start, one):
            warnings.warn(f"{prefix}{sentence}", stacklevel=user_level())
    from_data, described = training.automatic, options.described()
    linear = None if from_data is None or from_data.linear is None else from_data.linear.loss
    return tuple(
        result(
            own,
            one,
            judged or held,
            spread,
            {"seed": str(seed), **described},
            stage_results(one.history, plan, linear),
            None if from_data is None else from_data.not_laws,
        )
        for own, one, seed in zip(problems, trained, seeds, strict=True)
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


def concerns(problem: Problem, start: Trainable, trained: Trained) -> Iterator[str]:
    """Warnings about a training, one sentence each."""
    diverged, epochs = trained.history.divergences, trained.history.epochs
    if diverged:
        yield (
            f"Something diverged in {len(diverged)} of {epochs} epochs and was left out "
            f"(fit.history.divergences); first, {diverged[0]}."
            + (f" {SHORTER_STEPS}" if any(d.exploded for d in diverged) else "")
        )
    if not np.isfinite(trained.best.loss):
        yield "The trained model diverges over the whole record: its loss is infinite."
    elif trained.best.epoch == 0 and (sentence := _long_steps(problem, trained.best)):
        yield f"Training found nothing better than its start. {sentence}"
    elif sentence := _no_better_than_the_mean(problem, trained.best):
        yield sentence
    if not problem.sequences.whole and (remembered := problem.system.remembered):
        yield (
            f"Sequences begin with the start values of {listing(remembered)}, whatever they are in the record: "
            "take whole records (sequence_length=None), or give them as inputs: "
            f"ac.compile(model, inputs={[remembered[0]]})."
        )
    if clause := grazing(problem.system, problem.records, trained.best.simulated.log):
        yield (
            f"The condition {clause}: there the gradient does not exist, or is huge, and training may not get past it. "
            "Leave this part of the record out, or start from other values."
        )
    unmoved = _unmoved(start, trained.last)
    exact = 0 <= trained.history.full_loss[0, 1] <= EXACT
    if unmoved and len(diverged) < epochs and not exact:
        has_events = problem.system.events is not None
        yield from _reasons(unmoved, in_switches(problem.system), has_events)
    if clause := _out_of_range(problem, trained.best.trainable):
        yield (
            f"After training, {clause}. Keep it in its range: modifiers={{...: ac.Bounded(low, high)}}."
        )
    changes = problem.changes(trained.best.trainable)
    yield from problem.modifiers.at_limit(changes, problem.unit).values()


def _long_steps(problem: Problem, best: Best) -> str | None:
    """A sentence on steps that are too long for gradients, or None."""
    if not isinstance(problem.solver, EXPLICIT):
        return None
    packed = problem.system.pack(problem.model_params(best.trainable))
    values = Values(problem.records.steps.t, best.simulated.x, problem.inputs, packed)
    return long_steps(problem.system, values, problem.longest_step)


def _no_better_than_the_mean(problem: Problem, best: Best) -> str | None:
    """A sentence on a model that follows its records no better than a constant does, or None."""
    records = problem.records
    level = np.sqrt(len(problem.targets))
    error = float(jax.jit(nrmse)(best.simulated.y, records.y, records.sigma, records.weight))
    if error < level:
        return None
    return (
        f"The trained model is no better than the targets' mean: its error is {error:.3g}, that of the mean "
        f"{level:.3g}, that of the noise about {noise_loss(records):.2g} (in standard deviations, added up "
        "over targets). Do not use it: train longer, by another strategy, or from better parameters (params=...) and "
        "scales (input_scale=, output_scale=)."
    )


def _reasons(unmoved: Sequence[str], in_switches: Set[str], has_events: bool) -> Iterator[str]:
    """Why training did not move some networks and parameters."""
    switching = [n for n in unmoved if n in in_switches]
    others = [n for n in unmoved if n not in in_switches]
    if switching:
        yield (
            f"Training did not move {listing(switching)}: a switch (where, if, sign, floor) depends on it, and has "
            "no gradient. Smooth it (tanh in the place of sign), make it an event (ac.where(..., events=True), or for "
            "the library's ac.compile(model, events=True)), or leave it out (train=..., modifiers=...)."
        )
    if others and has_events:
        yield (
            f"Training did not move {listing(others)}: no target depends on it with the events that happen at the "
            "values where training began. Begin where the model switches as the data do (params=..., starts=...), fit "
            "a target that depends on it, or leave it out (train=..., modifiers=...)."
        )
    elif others:
        yield (
            f"Training did not move {listing(others)}: no target depends on it. "
            "Fit a target that does, or leave it out (train=..., modifiers=...)."
        )


def _out_of_range(problem: Problem, trained: Trainable) -> str | None:
    """A clause on trained parameters outside of their declared ranges."""
    params, moved = problem.assemble(trained), problem.modifiers.names
    layout = problem.system.layout
    return layout.out_of_range(
        np.asarray([float(params[n]) if n in moved else np.nan for n in layout.names])
    )


def _unmoved(start: Trainable, end: Trainable) -> list[str]:
    """The networks and parameters that have not changed by a single bit."""
    before, after = ({**t.networks, **t.modifiers} for t in (start, end))
    return [
        name
        for name, tree in before.items()
        if all(map(np.array_equal, jax.tree.leaves(tree), jax.tree.leaves(after[name])))
    ]
