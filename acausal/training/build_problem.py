"""Validate the options against a model and data; build the problem."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np

from acausal._jax import precision
from acausal.by_name import names_in
from acausal.data import Data, check_resolution
from acausal.errors import DataError, TrainingError, listing, nearest, shown
from acausal.networks import networks
from acausal.simulation import announce_derivatives, for_fixed_steps, solver_named
from acausal.training.objective.context import context, states_before_training
from acausal.training.objective.initial_state import first_state
from acausal.training.objective.losses import named
from acausal.training.objective.modifiers import modifiers
from acausal.training.objective.multiple_shooting import ShootingStates, shooting_states
from acausal.training.objective.parameter_spread import parameter_spread
from acausal.training.objective.problem import Problem
from acausal.training.objective.record import lay_out, sequences
from acausal.training.objective.regularizers import Context, Regularizer, label
from acausal.training.objective.sharding import device_mesh
from acausal.training.options import FitOptions

if TYPE_CHECKING:
    from acausal.system import System

VARIES = 1e-12
"""A target that varies by less than this, relative to its size, counts as constant."""


def build_problem(
    system: System,
    data: Data,
    targets: tuple[str, ...],
    params: dict[str, Any],
    options: FitOptions,
) -> Problem:
    """The problem of a training.

    Arguments:
        system: the model.
        data: a record in the model's units.
        targets: names of the variables to fit.
        params: all parameters where training starts.
        options: how to train.

    Raises:
        DataError: if the data are not sufficient for the training.
        TrainingError: if there is nothing to train, or an option does not fit the model or the data.
    """
    system.pack(params)  # refuses what does not fit
    chosen = _networks(options.train, params)
    changed = modifiers(options.modifiers, options.gamma, params, system.layout.why_not_free)
    if not chosen and not changed.names:
        raise TrainingError(
            "There is nothing to train: no network is in the model or chosen by train=[...]. "
            "Give modifiers=[...] to train parameters."
        )
    _check_targets(system, targets)
    if len(data) < 2:
        raise DataError("The record has fewer than two samples.")
    cut = sequences(data, options.sequence_length, options.batch_size, options.subsample)
    missing = [n for n in system.states if n not in data.signals]
    shooting = options.x0 == "fit"
    if shooting:
        cut = cut.tile()
    elif missing and not cut.whole:
        raise DataError(
            f"The data lack {listing(missing)}: sequences start from measured states. "
            "Let the training find where they start (x0='fit'), or train on the whole record "
            "(sequence_length=None) with x0='model' or x0={...}."
        )
    record = lay_out(data, system.inputs, targets, None if missing else system.states)
    announce_derivatives(system.inputs, data)
    dtype = precision(options.dtype)
    check_resolution(data.time, dtype, "The record")
    problem = Problem(
        system=system,
        params={
            n: leaf if callable(leaf) else jnp.asarray(leaf, float) for n, leaf in params.items()
        },
        networks=chosen,
        modifiers=changed,
        parameter_spread=parameter_spread(options.parameter_spread, params),
        targets=targets,
        records=(record,),
        sequences=cut,
        x0=None if shooting else first_state(system, data, options.x0),
        shooting=None,
        loss=named(options.loss),
        regularizers=_labelled(options.penalties),
        context=Context((), {}),
        solver=for_fixed_steps(solver_named(options.solver), dtype),
        substeps=_substeps(data, options.dt),
        dtype=dtype,
        mesh=device_mesh(options.devices, cut.batch_size),
    )
    _refuse_constant(problem)
    if shooting:
        problem = replace(problem, shooting=_shooting_states(problem, data))
    return replace(problem, context=context(problem)) if options.penalties else problem


def _networks(train: Iterable[str] | None, params: Mapping[str, Any]) -> tuple[str, ...]:
    found = networks(params)
    if train is None:
        return tuple(found)
    chosen = names_in(train, "train")
    for name in chosen:
        if name not in found:
            raise TrainingError(f"There is no network '{name}' to train: {nearest(name, found)}")
    return chosen


def _check_targets(system: System, targets: tuple[str, ...]) -> None:
    if not targets:
        raise TrainingError("There are no targets: name the variables to fit.")
    if len(set(targets)) < len(targets):
        raise TrainingError(f"A target is named twice in {listing(targets)}.")
    if driven := [n for n in targets if n in system.inputs]:
        raise TrainingError(
            f"{listing(driven)}: a target is what the model computes, not its input."
        )


def _refuse_constant(problem: Problem) -> None:
    largest = jnp.abs(problem.measured).max(axis=0)
    for name, varies in zip(problem.targets, problem.sigma > VARIES * largest, strict=True):
        if not varies:
            raise DataError(
                f"Target '{name}' is constant in the data; it gives nothing to learn from."
            )


def _labelled(regularizers: tuple[Regularizer, ...]) -> dict[str, Regularizer]:
    labelled: dict[str, Regularizer] = {}
    for regularizer in regularizers:
        name = label(regularizer)
        count = sum(n.split(" ")[0] == name for n in labelled)
        labelled[f"{name} {count + 1}" if count else name] = regularizer
    return labelled


def _substeps(data: Data, dt: float | None) -> int:
    """Steps of the integration from sample to sample."""
    if dt is None:
        return 1
    longest = data.sample_time if data.uniform else float(np.max(np.diff(data.time)))
    if not (isinstance(dt, float | int | np.number) and np.isfinite(dt) and dt > 0):
        raise TrainingError(f"dt={shown(dt)} is not a step; give a positive time in seconds.")
    n = max(1, round(longest / dt)) if data.uniform else int(np.ceil(longest / dt - 1e-6))
    if data.uniform and abs(longest / dt - n) > 1e-6 * n:
        raise TrainingError(
            f"dt={dt:g} s does not divide the data's sample time, {longest:g} s: "
            f"choose {longest / n:g} s, or resample the data."
        )
    return n


def _shooting_states(problem: Problem, data: Data) -> ShootingStates:
    """Initial states of all parts: as measured, else on the model's trajectory before training."""
    passed = np.array(states_before_training(problem))
    for i, name in enumerate(problem.system.states):
        if name in data.signals:
            passed[:, i] = data[name]
    return shooting_states(passed, problem.sequences.parts, problem.sequences.length)
