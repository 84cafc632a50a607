"""Absolute tolerances of states that stay small: currents of nanoamperes need finer ones than currents of amperes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from jaxtyping import Array, Float

from acausal._jax import known
from acausal.codegen import Packed
from acausal.errors import SimulationError, listing, warn
from acausal.simulation.solution import Solution

if TYPE_CHECKING:
    from acausal.system import System

ATOL = 1e-8
"""The usual absolute tolerance, in the states' units."""

SMALL, NOISE = 1e-4, 1e-13
"""States of a unit are small if all stay below the first; below the second they are rounding."""

AGAIN = 2
"""So often a simulation is repeated, at most: with better tolerances states may turn out to be larger or smaller."""

Simulated = Callable[[Float[np.ndarray, " n_states"]], Solution]
"""A simulation, by the absolute tolerances of its states."""


def with_small_states(
    simulated: Simulated, n_states: int, begun: Callable[[Solution], Float[np.ndarray, " n_states"]]
) -> Solution:
    """One simulation, or several, with the usual tolerances; where states stay small or begin so, with finer ones.

    All states of a unit stay small together: beside a large one of their unit, what is small may be rounding. ``begun``
    gives the sizes of states that were said to begin small, as of `sizes_at_start`.
    """
    atol = np.full(n_states, ATOL)
    solution = simulated(atol)
    for _ in range(AGAIN):
        finer = _finer(solution, begun(solution))
        if (finer > 0.1 * atol).all():
            break
        small = [n for n, f, a in zip(solution.system.states, finer, atol, strict=True) if f < a]
        try:
            solution, atol = simulated(finer), finer
        except SimulationError as error:
            warn(
                f"{listing(small, 4)}: these states stay so small that atol={ATOL:g} does not control their errors, "
                f"and finer steps do not succeed: {error} Give atol= of the size of their errors, one for each state."
            )
            break
    return solution


def sizes_at_start(
    system: System,
    packed: Packed,
    named: Mapping[str, Any],
    x: Float[Array, "*variants n_states"] | None,
) -> Float[np.ndarray, " n_states"]:
    """The sizes of states that begin small where the model or a user says; 1 for others, and in a trace.

    A start that was found by equations, or at the end of another simulation, may be small by rounding.

    Arguments:
        named: start values by name.
        x: where the states begin, if that is known.
    """
    none = np.ones(len(system.states))
    begun = None if x is None else known(x)
    if not system.states or (x is not None and (begun is None or not _small(begun).any())):
        return none
    declared = known(system.initializer.conditions.starts(packed))
    if declared is None:
        return none
    size = np.abs(np.asarray(declared if begun is None else begun, float)).reshape(-1, len(none))
    same = np.isclose(size, np.abs(np.asarray(declared, float)), rtol=1e-6, atol=0.0)
    size = np.where(same | np.asarray(system.initializer.conditions.fixed), size, 1.0)
    for name, value in system.initializer.by_state(named).items():
        if (given := known(value)) is not None:
            size[:, system.states.index(name)] = abs(float(given))
    return np.where(_small(size), size, 1.0).min(axis=0)


def _small(values: Array | np.ndarray) -> np.ndarray:
    """Which values are small, and larger than rounding."""
    size = np.abs(np.asarray(values, float))
    return (size > NOISE) & (size < SMALL)


def _finer(
    solution: Solution, begun: Float[np.ndarray, " n_states"]
) -> Float[np.ndarray, " n_states"]:
    """The tolerances of the states of a result, relative to the largest one of their unit; the usual in a trace.

    Relative to where they have ``begun``, if they were said to begin small.
    """
    x, states = known(solution.x), solution.system.states
    usual = np.full(len(states), ATOL)
    if x is None or not x.size:
        return usual
    rows = np.asarray(x, float).reshape(-1, len(states))
    # without NaN, and without a copy of all rows
    largest = np.maximum(np.fmax.reduce(rows), -np.fmin.reduce(rows))
    largest = np.nan_to_num(largest, posinf=np.inf)
    if (largest >= SMALL).all() and (begun == 1).all():
        return usual
    _, unit = np.unique([solution.unit(name) for name in states], return_inverse=True)
    of_unit = np.zeros(len(states))
    np.maximum.at(of_unit, unit, largest)
    size = of_unit[unit]
    finer = np.where(_small(size), size * ATOL, ATOL)
    rounding = np.finfo(float).eps * size  # of what has that unit
    return np.minimum(finer, np.maximum(begun * ATOL, np.minimum(rounding, ATOL)))
