"""Validate the options against a model and data; build the problem."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np
from jax import lax
from jaxtyping import Array, Float

from acausal._jax import precision
from acausal.codegen import Packed, Values
from acausal.data import Data, check_resolution
from acausal.errors import DataError, TrainingError, known_name, listing, shown
from acausal.modeling import names_in
from acausal.networks import networks
from acausal.simulation import (
    BDF,
    Adaptive,
    Scheme,
    announce_inputs,
    check_clocks,
    check_tolerances,
    for_adaptive_steps,
    for_fixed_steps,
    solver_named,
)
from acausal.training.objective.initial_state import by_record, first_states
from acausal.training.objective.lay_out import check_step, lay_out, sample_time
from acausal.training.objective.losses import named
from acausal.training.objective.modifiers import Modifiers, modifiers
from acausal.training.objective.multiple_shooting import ShootingStates, shooting_states
from acausal.training.objective.parameter_spread import parameter_spread
from acausal.training.objective.per_record import per_record
from acausal.training.objective.prior import prior_of
from acausal.training.objective.problem import Problem
from acausal.training.objective.records import Records
from acausal.training.objective.regularizers import Context, Regularizer, Trajectory, label
from acausal.training.objective.sequences import cut
from acausal.training.objective.sharding import device_mesh
from acausal.training.objective.start_modes import with_start_modes
from acausal.training.objective.start_prior import start_prior
from acausal.training.objective.start_sizes import with_sizes
from acausal.training.objective.streamed import Streamed
from acausal.training.objective.timing import Timing, timing
from acausal.training.objective.weighting import Weighting, weighting
from acausal.training.options import FitOptions

if TYPE_CHECKING:
    from acausal.system import System

VARIES = 1e-12
"""A target that varies by less than this, relative to its size, counts as constant."""


DIVERGES = "The model diverges over its records before training; start from better parameters."

PASSED = 1000
"""The most samples of the records in the context of regularizers; they are evenly spread."""


def build_problem(
    system: System,
    data: dict[str, Data],
    targets: tuple[str, ...],
    params: dict[str, Any],
    options: FitOptions,
    streamed: Streamed | None = None,
) -> Problem:
    """The problem of a training, from all parameters where it starts and records by name, in the model's units.

    Of a stream these are only the beginnings of the records; ``streamed`` has all of them.

    Raises:
        DataError: if the data are not sufficient for the training.
        TrainingError: if there is nothing to train, or an option does not fit the model or the data.
    """
    packed = system.pack(params)  # refuses what does not fit
    names, parameters, times = _what_is_trained(system, data, targets, params, options)
    _check_targets(system, targets)
    dtype = precision(options.dtype)
    _check_records(system, data, packed, dtype)
    even = sample_time(data.values()) if streamed is None else streamed.even
    check_step(even, options.dt)
    shooting = "fit" in by_record(data, options.x0)
    solver = _solver(options, dtype)
    records, substeps = lay_out(
        system,
        data,
        targets,
        options.dt,
        solver,
        times,
        differentiated=options.automatic,
        even=even,
    )
    records = _with_guesses(system, records, params)
    for record in data.values():
        announce_inputs(system, record)
    loss = named(options.loss, targets)
    weights = weighting(options.record_weights, options.sample_weights, tuple(data), targets, loss)
    records = _weighted(records, weights, targets)
    how = options.sequence_length, options.batch_size, options.subsample
    states = system.states[: system.reduced.n_independent]
    lacking = [n for n in states if any(n not in d.signals for d in data.values())]
    if streamed is None:
        sequences = cut(records, *how, tiled=shooting, lacking=lacking)
    else:
        sigma = jnp.asarray(streamed.sigma)
        records = replace(records, sigma=sigma, scale=sigma)
        sequences = streamed.cut(*how, lacking)
    problem = Problem(
        system=system,
        params={
            n: leaf if callable(leaf) else jnp.asarray(leaf, float) for n, leaf in params.items()
        },
        networks=names,
        modifiers=parameters,
        parameter_spread=parameter_spread(options.parameter_spread, params, system.layout.range_of),
        per_record=per_record(system, options.per_record, params, records.count),
        timing=times,
        targets=targets,
        records=records,
        weighting=weights,
        sequences=sequences if weights.alike else sequences.weighted(records),
        first_states=first_states(system, data, options.x0),
        start_prior=start_prior(system, data, options.x0),
        shooting=None,
        loss=loss,
        prior=prior_of(options.prior, params),
        regularizers=_labelled(options.penalties),
        context=Context((), {}),
        solver=solver,
        substeps=substeps,
        dtype=dtype,
        mesh=device_mesh(options.devices, sequences.batch_size),
        streamed=streamed,
    )
    problem.check_rest()
    _refuse_constant(problem)
    problem = with_sizes(with_start_modes(problem, problem.start(), data, options.x0))
    if shooting:
        problem = replace(problem, shooting=_shooting_states(problem, data))
    return replace(problem, context=_context(problem)) if options.penalties else problem


def _what_is_trained(
    system: System,
    data: Mapping[str, Data],
    targets: tuple[str, ...],
    params: dict[str, Any],
    options: FitOptions,
) -> tuple[tuple[str, ...], Modifiers, Timing]:
    """The networks and the parameters to train, and the delays and lags, of which some may be among these."""
    layout, names = system.layout, trained_networks(system, options.train, params)
    parameters = modifiers(
        options.modifiers, options.gamma, params, layout.why_not_free, layout.range_of
    )
    times, moving = timing(options.delays, options.lags, data.values(), system.inputs, targets)
    parameters = parameters.joined(moving)
    if not names and not parameters.names and not options.per_record:
        raise TrainingError(
            "There is nothing to train: no network is in the model or chosen by train=[...]. "
            "Give modifiers=[...] to train parameters."
        )
    return names, parameters, times


def _check_records(
    system: System, data: Mapping[str, Data], packed: Packed, dtype: np.dtype[Any]
) -> None:
    for name, record in data.items():
        where = "The record" if len(data) == 1 else f"The record '{name}'"
        if len(record) < 2:
            raise DataError(f"{where} has fewer than two samples.")
        check_resolution(record.time, dtype, where)
        check_clocks(system, system.blank(packed, record.time[0]), record.time[-1])


def _solver(options: FitOptions, dtype: np.dtype[Any]) -> Scheme | Adaptive:
    """The steps of the integration: adaptive ones where tolerances or a solver ask for them."""
    fixed = options.dt is not None
    solver = "heun" if options.solver is None else options.solver
    chosen = (
        None if isinstance(solver, str) and solver == "auto" else solver_named(solver, fixed=fixed)
    )
    by_tolerance = options.rtol is not None or options.atol is not None
    if chosen is not None and not isinstance(chosen, BDF) and not by_tolerance:
        return for_fixed_steps(chosen)
    if options.dt is not None:
        raise TrainingError(
            f"dt={options.dt:g} is for fixed steps, but solver={shown(solver)}"
            f"{' with rtol or atol' if by_tolerance else ''} chooses its own: leave one of them out."
        )
    rtol = Adaptive.rtol if options.rtol is None else options.rtol
    atol = Adaptive.atol if options.atol is None else options.atol
    check_tolerances(rtol, atol, 0)
    return Adaptive(None if chosen is None else for_adaptive_steps(chosen), rtol, atol)


def trained_networks(
    system: System, train: Iterable[str] | None, params: Mapping[str, Any]
) -> tuple[str, ...]:
    """The networks to train: by default all that an equation calls; options of components may leave some out."""
    layout, called = system.layout, set[int]()
    for group in system.flat.equations():
        called.update(layout.module_of[group.modules].ravel().tolist())
    module = dict(zip(layout.module_names, layout.own_modules, strict=True))
    trainable = [name for name in networks(params) if module[name] in called]
    if train is None:
        return tuple(trainable)
    chosen = names_in(train, "train")
    for name in chosen:
        if name in layout.names:
            raise TrainingError(
                f"'{name}' is a parameter, no network: give modifiers=['{name}'] to train it."
            )
        known_name(name, trainable, "There is no network", TrainingError, " to train:")
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
    modes = [n for n in targets if system.is_mode(n)]
    if len(modes) == len(targets):
        raise TrainingError(
            f"{listing(modes)}: what changes at events only, by whole numbers, has no gradient; fit what changes "
            f"continuously, and give measured modes: ac.compile(model, inputs={modes})."
        )


def _weighted(records: Records, weights: Weighting, targets: tuple[str, ...]) -> Records:
    """The records with their weights.

    Raises:
        TrainingError: if nothing of a target counts.
    """
    weighted = weights.apply(records)
    for name, total in zip(targets, np.asarray(weighted.weight).sum(axis=0), strict=True):
        if not total > 0:
            raise TrainingError(
                f"sample_weights: all weights of '{name}' are 0; leave the target out."
            )
    return weighted


def _refuse_constant(problem: Problem) -> None:
    largest = np.abs(np.asarray(problem.records.y)).max(axis=0)
    varied = np.asarray(problem.records.sigma) > VARIES * largest
    for name, varies in zip(problem.targets, varied, strict=True):
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


def _with_guesses(system: System, records: Records, params: dict[str, Any]) -> Records:
    """The measured states with the angles that closed loops compute, each next to that of the row before."""
    if records.x is None or not len(system.reduced.guessed):
        return records
    packed, n = system.pack(params), system.reduced.n_independent
    unknown = jnp.full(len(system.reduced.guessed), jnp.nan)

    def row(guess: Array, now: tuple[Array, ...]) -> tuple[Array, Array]:
        t, x, u, begins = now
        near = jnp.concatenate([x, jnp.where(begins, unknown, guess)])
        closed = system.closed(Values(t, near, u, packed))
        return closed[n:], closed

    rows = records.steps.t, records.x, records.steps.inputs.start, records.begins
    return replace(records, x=lax.scan(row, unknown, rows)[1])


def _shooting_states(problem: Problem, data: dict[str, Data]) -> ShootingStates:
    """Initial states of all parts: as measured, else on the model's trajectory before training."""
    records = problem.records
    sequences = problem.sequences
    untrained = replace(problem, first_states=problem.first_states.from_model())
    passed = np.array(_states_before_training(untrained))
    for i, name in enumerate(problem.system.states):
        for k, record in enumerate(data.values()):
            if name in record.signals:
                measured = record.signals[name]
                rows = records.rows_of(k)
                passed[rows, i] = np.where(np.isnan(measured), passed[rows, i], measured)
    rows = records.first if sequences.whole else sequences.starts
    return shooting_states(passed, np.asarray(rows), np.asarray(records.of))


def _context(problem: Problem) -> Context:
    """The arguments of regularizers besides the parameters.

    Raises:
        TrainingError: if states are not measured, and the model diverges.
    """
    rows = np.unique(np.linspace(0, len(problem.records) - 1, PASSED).astype(int))
    x, d = _states_before_training(problem), None
    if problem.system.events is not None:
        d = problem.simulate(problem.start()).d
    if not all(bool(jnp.isfinite(a).all()) for a in (x, d) if a is not None):
        raise TrainingError(DIVERGES)
    t = problem.records.steps.t
    discrete = None if d is None else d[rows]
    passed = Trajectory(problem.system, t[rows], x[rows], problem.inputs[rows], discrete)
    return Context(problem.networks, problem.seen(problem.start(), x, d, jnp.asarray(rows)), passed)


def _states_before_training(problem: Problem) -> Float[Array, "N n_states"]:
    """The states at every row: as measured, else as the model has them before training.

    Raises:
        TrainingError: if the model diverges.
    """
    measured = problem.records.x
    if measured is not None and not bool(jnp.isnan(measured).any()):
        return measured
    x = problem.simulate(problem.start()).x
    if not bool(jnp.isfinite(x).all()):
        raise TrainingError(DIVERGES)
    return x
