"""Train from several starts: in one program of this process, or each alone on the workers of an executor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import equinox as eqx
import jax
from jaxtyping import PRNGKeyArray, PyTree

from acausal.errors import TrainingError
from acausal.jobs import on_workers
from acausal.training import checkpoint as checkpoints
from acausal.training.fingerprint import fingerprint
from acausal.training.logs import log_progress
from acausal.training.member import Trained
from acausal.training.objective.folds import LeftOut
from acausal.training.objective.problem import Problem
from acausal.training.objective.sharding import on_default_device
from acausal.training.objective.trainable import Trainable
from acausal.training.options import FitOptions
from acausal.training.preparation import Training
from acausal.training.progress import Observer, after, display
from acausal.training.starts import Halving, halving, spread_starts
from acausal.training.training_run import TrainingRun


class Alone(NamedTuple):
    """One of several trainings, as a worker does it.

    Attributes:
        start: where it begins.
        seed: of its batches.
        part: what it leaves out, as a fold.
        checkpoint: its own file, from which it goes on if there is one: its worker may have been lost.
    """

    start: Trainable
    seed: int
    part: LeftOut | None = None
    checkpoint: Path | None = None


def train_here(
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


def begins(training: Training) -> tuple[list[Problem], list[Trainable]]:
    """The problem of each seed, and where its trainings start: one after the other, `starts` of each.

    Raises:
        TrainingError: if the networks of seeds differ in kind, or several starts have nothing to differ in.
    """
    problem, options, automatic = training.problem, training.options, training.automatic
    problems = [_from(problem, own) for own in training.params]
    starts = [s for p in problems for s in spread_starts(p, options.starts, training.seeds[0])]
    if automatic is not None and options.starts == 1:
        starts = [automatic.begin(problem, start) for start in starts]
    return problems, starts


def train_together(training: Training, starts: Sequence[Trainable]) -> tuple[Trained, ...]:
    """Train from all starts in one program here, with checkpoints."""
    options, updates = training.options, sum(segment.epochs for segment in training.segments)
    (path,) = _checkpoint_files(options, 1)
    ends, seeds = halving(options.starts, updates), _seeds(training)
    return _kept(training, starts, seeds, path, ends, (training.seeds, starts[1:]))


def _kept(
    training: Training,
    starts: Sequence[Trainable],
    seeds: Sequence[int],
    path: Path | None,
    ends: Halving,
    differs: tuple[Sequence[int], Sequence[Trainable]],
) -> tuple[Trained, ...]:
    """Train here with a checkpoint, from which this goes on if there is one.

    The checkpoint knows its training by the seeds and starts in which this ``differs`` from others.
    """
    identity: dict[str, str] = {}
    if path is not None:
        problem, plan = training.problem, training.segments
        identity = fingerprint(problem, plan, *differs, training.held, training.records)
    stored = None if path is None or not path.exists() else checkpoints.read(path, identity)
    path = path if jax.process_index() == 0 else None
    with checkpoints.keeping(path, training.options.checkpoint_every, identity) as keep:
        keys = [jax.random.key(seed) for seed in seeds]
        return train_here(training, starts, keys, keep, stored, ends)


def train_on_workers(
    training: Training, parts: Sequence[LeftOut | None] = (None,)
) -> list[tuple[Trained, ...]]:
    """By part that is left out, train from all starts, each alone to its own end.

    Raises:
        DataError, TrainingError: as trainings do, and for lost workers as `acausal.jobs.on_workers`.
    """
    options, tasks = training.options, list[Alone]()
    assert options.executor is not None
    files, seeds = _checkpoint_files(options, len(_seeds(training))), _seeds(training)
    for part in parts:
        _, starts = begins(training if part is None else training.without(part))
        rows = zip(starts, seeds, files, strict=True)
        tasks += [Alone(start, seed, part, file) for start, seed, file in rows]
    shown = options.progress
    found = on_workers(options.executor, _alone, training, tasks, "training", progress=shown)
    size = len(seeds)
    return [tuple(found[k : k + size]) for k in range(0, len(found), size)]


def _seeds(training: Training) -> list[int]:
    return [seed for seed in training.seeds for _ in range(training.options.starts)]


def _alone(training: Training, task: Alone) -> Trained:
    own = training if task.part is None else training.without(task.part)
    starts, seeds = (task.start,), (task.seed,)
    (found,) = _kept(own, starts, seeds, task.checkpoint, halving(1, 0), (seeds, starts))
    return found


def _checkpoint_files(options: FitOptions, count: int) -> list[Path | None]:
    """Where each of some trainings writes its checkpoints: ``name-0.safetensors`` and so on, if there are several.

    Raises:
        TrainingError: for a file that exists, unless the training resumes, and for resuming without a file.
    """
    if options.checkpoint is None:
        if options.resume:
            raise TrainingError("resume=True needs a checkpoint to go on from: checkpoint='...'.")
        return [None] * count
    file = checkpoints.place(options.checkpoint)
    own = [file] if count == 1 else [file.with_stem(f"{file.stem}-{k}") for k in range(count)]
    for path in own:
        if path.exists() and not options.resume:
            raise TrainingError(
                f"There is a checkpoint '{path}' already: resume=True goes on from it; "
                "to start again, remove it or name another file."
            )
    return [*own]


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
