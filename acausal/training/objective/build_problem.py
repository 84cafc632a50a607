"""Pose a training problem: a user's wishes and data, checked, become a `Problem`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from numbers import Real
from typing import TYPE_CHECKING, Any, Literal

import jax
import jax.numpy as jnp
import numpy as np
from jax import Array
from jax.typing import DTypeLike

from acausal._jax import precision
from acausal.data import Data
from acausal.errors import DataError, TrainingError, listing, nearest
from acausal.networks import networks
from acausal.simulation import Solver, for_fixed_steps, solver_named
from acausal.training.objective import (
    losses,
    modifiers as parameter_modifiers,
    parameter_spread as parameter_tolerances,
)
from acausal.training.objective.modifiers import Modifier
from acausal.training.objective.multiple_shooting import Nodes
from acausal.training.objective.problem import Problem
from acausal.training.objective.record import Record, Sequences, lay_out, sequences
from acausal.training.objective.regularizers import Context, Regularizer, Trajectory, label
from acausal.training.objective.sharding import Device, mesh

if TYPE_CHECKING:
    from acausal.system import System

REFERENCE_POINTS = 1000
"""Points of the record at which regularizers look at networks."""

CONTINUITY = 10.0
"""Weight of the gaps between sequences whose initial states are trained."""

SLOPES = 2**30
"""Bytes that the slopes of predictions may take; all in all a few times as much is needed."""

Start = Literal["data", "model", "fit"]


def pose(
    system: System,
    data: Data,
    targets: tuple[str, ...],
    params: dict[str, Any],
    *,
    train: Iterable[str] | None,
    modifiers: Mapping[str, float | Modifier] | Iterable[str] | None,
    gamma: float,
    tolerances: Mapping[str, float] | None = None,
    loss: str | losses.Loss,
    regularizers: tuple[Regularizer, ...],
    sequence_length: float | None,
    batch_size: int,
    subsample: float | None,
    dt: float | None,
    solver: str | Solver,
    x0: Start | Mapping[str, float],
    dtype: DTypeLike = np.float64,
    devices: Sequence[Device] | None = None,
) -> Problem:
    """The problem of a training; arguments as those of `acausal.fit`, data in the model's units.

    Raises:
        DataError: if the data do not serve the training.
        TrainingError: if there is nothing to train, or a wish cannot be met.
    """
    chosen = _networks(train, params)
    changed = parameter_modifiers.modifiers(modifiers, gamma, params)
    if not chosen and not changed.names:
        raise TrainingError(
            "There is nothing to train: no network is in the model or chosen by train=[...]. "
            "Give modifiers=[...] to train parameters."
        )
    if not targets:
        raise TrainingError("There are no targets: name the variables to fit.")
    if len(set(targets)) < len(targets):
        raise TrainingError(f"A target is named twice in {listing(targets)}.")
    if driven := [n for n in targets if n in system.inputs]:
        raise TrainingError(
            f"{listing(driven)}: a target is what the model computes, not its input."
        )
    if len(data) < 2:
        raise DataError("The record has less than two samples.")
    cut = sequences(data, sequence_length, batch_size, subsample)
    missing = [n for n in system.states if n not in data.signals]
    if x0 == "fit":
        cut = cut.tile()
    elif missing and not cut.whole:
        raise DataError(
            f"The data lack {listing(missing)}: sequences start from measured states. "
            "Let the training find where they start (x0='fit'), or train on the whole record "
            "(sequence_length=None) with x0='model' or x0={...}."
        )
    record = lay_out(data, system.inputs, targets, None if missing else system.states)
    _refuse_constant(record, targets)
    problem = Problem(
        system=system,
        params={
            n: leaf if callable(leaf) else jnp.asarray(leaf, float) for n, leaf in params.items()
        },
        networks=chosen,
        modifiers=changed,
        tolerances=parameter_tolerances.tolerances(tolerances, params),
        targets=targets,
        record=record,
        sequences=cut,
        x0=None if x0 == "fit" else first_state(system, data, x0),
        nodes=None,
        loss=losses.named(loss),
        regularizers=_labelled(regularizers),
        context=Context((), {}),
        solver=for_fixed_steps(solver_named(solver), precision(dtype)),
        substeps=_substeps(data, dt),
        dtype=precision(dtype),
        mesh=mesh(devices, cut.batch_size),
    )
    if x0 == "fit":
        problem = replace(problem, nodes=_nodes(problem, data))
    return replace(problem, context=_context(problem)) if regularizers else problem


def over_whole_record(problem: Problem) -> Problem:
    """The same problem with the whole record as one sequence, every point of it."""
    count, nodes = len(problem.record), problem.nodes
    whole = Sequences(count, count, 1, None)
    if nodes is not None:
        nodes = Nodes(nodes.start[:1], nodes.scale, nodes.continuity, count)
    return replace(problem, sequences=whole, nodes=nodes, mesh=None)


def gauss_newton(problem: Problem) -> Problem:
    """The whole record, if the slopes of its predictions by all that is trained can be held in memory.

    Raises:
        TrainingError: if not.
    """
    whole = over_whole_record(problem)
    trained = sum(leaf.size for leaf in jax.tree.leaves(whole.start()))
    models = len(problem.tolerances.shifts)
    if (size := 8 * trained * models * problem.record.y.size) > SLOPES:
        raise TrainingError(
            f"The slopes of all predictions by {trained} weights and parameters take {size / 2**30:.1f} GB: "
            "take strategy='whole_record' in place of 'gauss_newton', smaller networks, or a coarser record."
        )
    return whole


def _refuse_constant(record: Record, targets: tuple[str, ...]) -> None:
    largest = jnp.abs(record.y).max(axis=0)
    for name, varies in zip(targets, record.sigma > 1e-12 * largest, strict=True):
        if not varies:
            raise DataError(
                f"Target '{name}' is constant in the data; it gives nothing to learn from."
            )


def _networks(train: Iterable[str] | None, params: Mapping[str, Any]) -> tuple[str, ...]:
    found = networks(params)
    if train is None:
        return tuple(found)
    chosen = (train,) if isinstance(train, str) else tuple(train)
    for name in chosen:
        if name not in found:
            raise TrainingError(f"There is no network '{name}' to train: {nearest(name, found)}")
    return chosen


def first_state(system: System, data: Data, x0: Start | Mapping[str, float]) -> Array | None:
    """The state at a record's start as ``x0`` says, shape (number of states,); ``None`` as the model starts.

    Raises:
        DataError: for another word, a name that is no state, a value that is no number, or a state that neither the
            data nor ``x0`` have.
    """
    if x0 == "model":
        return None
    if isinstance(x0, str) and x0 != "data":
        raise DataError(f"x0='{x0}' is no way to start here: {nearest(x0, ('data', 'model'))}")
    given: Mapping[str, float] = {} if isinstance(x0, str) else x0
    for name, value in given.items():
        if name not in system.states:
            raise DataError(
                f"x0: '{name}' is no state of the model: {nearest(name, system.states)}"
            )
        if not isinstance(value, Real | np.ndarray | Array) or not np.isfinite(value).all():
            raise DataError(f"x0: '{name}' is {value!r}; give a finite number.")
    unknown = [n for n in system.states if n not in data.signals and n not in given]
    if unknown:
        raise DataError(
            f"The data lack {listing(unknown)}, with which the record starts: "
            f"give x0={{'{unknown[0]}': ...}}, or x0='model' for the model's start values."
        )
    return jnp.asarray([given[n] if n in given else data[n][0] for n in system.states], float)


def _nodes(problem: Problem, data: Data) -> Nodes:
    """Initial states of all parts: as measured, else as the model passes through them before training."""
    states, cut = problem.system.states, problem.sequences
    passed = np.array(_trajectory(problem))
    for i, name in enumerate(states):
        if name in data.signals:
            passed[:, i] = data[name]
    spread = passed.std(axis=0)
    largest = np.abs(passed).max(axis=0)
    scale = np.where(spread > 1e-9 * largest, spread, np.where(largest > 0, largest, 1.0))
    starts = passed[: cut.parts * cut.length : cut.length]
    return Nodes(jnp.asarray(starts), jnp.asarray(scale), jnp.asarray(CONTINUITY), cut.length)


def _labelled(regularizers: tuple[Regularizer, ...]) -> dict[str, Regularizer]:
    named: dict[str, Regularizer] = {}
    for regularizer in regularizers:
        name = label(regularizer)
        count = sum(n.split(" ")[0] == name for n in named)
        named[f"{name} {count + 1}" if count else name] = regularizer
    return named


def _substeps(data: Data, dt: float | None) -> int:
    if dt is None:
        return 1
    longest = data.sample_time if data.uniform else float(np.max(np.diff(data.time)))
    if not (isinstance(dt, float | int | np.number) and np.isfinite(dt) and dt > 0):
        raise TrainingError(f"dt={dt!r} is no step; give a positive time in seconds.")
    n = max(1, round(longest / dt)) if data.uniform else int(np.ceil(longest / dt - 1e-6))
    if data.uniform and abs(longest / dt - n) > 1e-6 * n:
        raise TrainingError(
            f"dt={dt:g} s is no whole part of the data's sample time, {longest:g} s: "
            f"choose {longest / n:g} s, or resample the data."
        )
    return n


def _context(problem: Problem) -> Context:
    """Where the model is over the record, and what networks are called with there."""
    rows = np.unique(np.linspace(0, len(problem.record) - 1, REFERENCE_POINTS).astype(int))
    x = _trajectory(problem)
    steps = problem.record.steps
    passed = Trajectory(problem.system, steps.t[rows], x[rows], steps.inputs.start[rows])
    return Context(problem.networks, problem.seen(problem.start(), x, jnp.asarray(rows)), passed)


def _trajectory(problem: Problem) -> Array:
    """The states at every sample: as measured, else as the model has them before training.

    Raises:
        TrainingError: if the model diverges.
    """
    if problem.record.x is not None:
        return problem.record.x
    x = problem.simulate(problem.start()).x
    if not bool(jnp.isfinite(x).all()):
        raise TrainingError(
            "The model diverges over the record before training; start from better parameters."
        )
    return x
