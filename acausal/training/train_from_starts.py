"""Trainings of one model on one record, from one start or from several, in one program."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax
import numpy as np
import optax
from jax.typing import DTypeLike
from numpy.typing import ArrayLike

from acausal.data import Data
from acausal.errors import TrainingError, listing
from acausal.simulation import Solver
from acausal.training import checkpoint as checkpoints
from acausal.training.fingerprint import fingerprint
from acausal.training.loop import Trained, train as run
from acausal.training.objective.build_problem import Start, pose
from acausal.training.objective.held_out import Validation, hold_out, split
from acausal.training.objective.losses import Loss
from acausal.training.objective.modifiers import Modifier
from acausal.training.objective.problem import Problem, Trainable, modified
from acausal.training.objective.regularizers import Regularizer
from acausal.training.objective.sharding import Device
from acausal.training.progress import Observer, display
from acausal.training.result import Fit, result
from acausal.training.strategy import legs

if TYPE_CHECKING:
    from acausal.system import System

DIVERGED = 1e3
"""A sequence whose normalised error is larger has diverged."""

EXACT = 1e-100
"""A loss at which a model follows its record to the last bit, and nothing moves."""


def together(
    system: System,
    data: Data | Mapping[str, ArrayLike],
    targets: str | Sequence[str],
    *,
    seeds: Sequence[int],
    params: Sequence[Mapping[str, Any]],
    train: Iterable[str] | None,
    modifiers: Mapping[str, float | Modifier] | Iterable[str] | None,
    gamma: float,
    tolerances: Mapping[str, float] | None,
    loss: str | Loss,
    regularizers: Iterable[Regularizer],
    sequence_length: float | None,
    batch_size: int,
    subsample: float | None,
    strategy: str | Sequence[str],
    epochs: int | Sequence[int] | None,
    optimizer: optax.GradientTransformation | None,
    dt: float | None,
    solver: str | Solver,
    x0: Start | Mapping[str, float],
    dtype: DTypeLike,
    devices: Sequence[Device] | None,
    validation: Validation,
    evaluate_every: int | None,
    patience: int | None,
    progress: bool,
    observers: Sequence[Observer],
    checkpoint: str | Path | None,
    checkpoint_every: float,
    resume: bool,
) -> tuple[Fit, ...]:
    """Train from several starts; arguments as those of `acausal.fit`, but a seed and parameters for each.

    What is not trained is as the first parameters have it.

    Raises:
        DataError, TrainingError: as `acausal.fit` does.
    """
    penalties = (regularizers,) if callable(regularizers) else tuple(regularizers)
    for function in (*penalties, *observers):
        if not callable(function):
            raise TrainingError(f"{function!r:.80} is called in the training, and is no function.")
    for seed in seeds:
        if not isinstance(seed, int | np.integer):
            raise TrainingError(f"seed={seed!r}; give a whole number.")
    training, kept = split(Data.of(data).for_system(system), validation)
    problem = pose(
        system,
        training,
        (targets,) if isinstance(targets, str) else tuple(targets),
        dict(params[0]),
        train=train,
        modifiers=modifiers,
        gamma=gamma,
        tolerances=tolerances,
        loss=loss,
        regularizers=penalties,
        sequence_length=sequence_length,
        batch_size=batch_size,
        subsample=subsample,
        dt=dt,
        solver=solver,
        x0=x0,
        dtype=dtype,
        devices=devices,
    )
    limit = DIVERGED if loss == "nrmse" else np.inf
    held = hold_out(problem, kept, x0)
    plan = legs(problem, strategy, epochs, evaluate_every, patience, optimizer, limit)
    problems = [_from(problem, own) for own in params]
    starts = [p.start() for p in problems]
    keys = [jax.random.key(seed) for seed in seeds]
    first = jax.process_index() == 0
    parts = (problem, plan, seeds, starts[1:], held, training.signals)
    identity = {} if checkpoint is None else fingerprint(*parts)
    path, stored = _checkpoint(checkpoint, resume, identity)
    with (
        display(progress and first, sum(leg.epochs for leg in plan)) as show,
        checkpoints.keeping(path if first else None, checkpoint_every, identity) as keep,
    ):
        trained = run(problem, starts, plan, keys, (show, *observers), keep, stored, held)
    for posed, start, one in zip(problems, starts, trained, strict=True):
        for sentence in _warnings(posed, start, one):
            warnings.warn(sentence, stacklevel=3)
    return tuple(map(result, problems, trained))


def _from(problem: Problem, params: Mapping[str, Any]) -> Problem:
    """The problem whose training starts from the networks of other parameters.

    Raises:
        TrainingError: if they are of another kind.
    """
    for name in problem.networks:
        if _shape(params[name]) != _shape(problem.params[name]):
            raise TrainingError(
                f"The networks '{name}' that are trained together are not alike: give all of them one architecture."
            )
    networks = {name: params[name] for name in problem.networks}
    return replace(problem, params={**problem.params, **networks})


def _shape(network: Any) -> Any:
    arrays, rest = eqx.partition(network, eqx.is_inexact_array)
    return jax.tree.map(lambda a: (a.shape, a.dtype), arrays), jax.tree.structure(rest)


def _checkpoint(
    path: str | Path | None, resume: bool, identity: Mapping[str, str]
) -> tuple[Path | None, checkpoints.Stored | None]:
    """Where to write checkpoints, and the one to go on from."""
    if path is None:
        if resume:
            raise TrainingError("resume=True needs a checkpoint to go on from: checkpoint='...'.")
        return None, None
    file = checkpoints.place(path)
    if not file.exists():
        return file, None
    if not resume:
        raise TrainingError(
            f"There is a checkpoint '{file}' already: resume=True goes on from it; "
            "to begin anew, remove it or name another file."
        )
    return file, checkpoints.read(file, identity)


def _warnings(problem: Problem, start: Trainable, trained: Trained) -> Iterator[str]:
    """What a user should know of a training, a sentence each."""
    diverged, epochs = trained.history.divergences, trained.history.epochs
    if diverged:
        yield (
            f"Something diverged in {len(diverged)} of {epochs} epochs and was left out "
            f"(fit.history.divergences); first, {diverged[0]}."
        )
    if not np.isfinite(trained.best.loss):
        yield "The trained model diverges over the whole record: its loss is infinite."
    unmoved = _unmoved(start, trained.last)
    if unmoved and len(diverged) < epochs and trained.history.full_loss[0, 1] > EXACT:
        yield (
            f"Training did not move {listing(unmoved)}: no target depends on it. "
            "Fit a target that does, or leave it out (train=..., modifiers=...)."
        )
    changes = modified(problem, trained.best.trainable)
    yield from problem.modifiers.at_limit(changes, problem.system.unit).values()


def _unmoved(start: Trainable, end: Trainable) -> list[str]:
    """The networks and parameters that are as they were, to the last bit."""
    before, after = ({**t.networks, **t.modifiers} for t in (start, end))
    return [
        name
        for name, tree in before.items()
        if all(map(np.array_equal, jax.tree.leaves(tree), jax.tree.leaves(after[name])))
    ]
