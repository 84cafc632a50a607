"""Absolute tolerances of states that stay small: currents of nanoamperes need finer ones than currents of amperes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from jaxtyping import Float

from acausal._jax import known
from acausal.errors import SimulationError, listing, warn
from acausal.simulation.solution import Solution

ATOL = 1e-8
"""The usual absolute tolerance, in the states' units."""

SMALL, NOISE = 1e-4, 1e-13
"""States of a unit are small if all stay below the first; below the second they are rounding."""

AGAIN = 2
"""So often a simulation is repeated, at most: with better tolerances states may turn out to be larger or smaller."""

Simulated = Callable[[Float[np.ndarray, " n_states"]], Solution]
"""A simulation, by the absolute tolerances of its states."""


def with_small_states(simulated: Simulated, n_states: int) -> Solution:
    """One simulation, or several, with the usual tolerances; where all states of a unit stay small, with finer ones."""
    atol = np.full(n_states, ATOL)
    solution = simulated(atol)
    for _ in range(AGAIN):
        finer = _finer(solution)
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


def _finer(solution: Solution) -> Float[np.ndarray, " n_states"]:
    """The tolerances of the states of a result, relative to the largest one of their unit; the usual in a trace."""
    x, states = known(solution.x), solution.system.states
    usual = np.full(len(states), ATOL)
    if x is None or not x.size:
        return usual
    rows = np.asarray(x, float).reshape(-1, len(states))
    # without NaN, and without a copy of all rows
    largest = np.maximum(np.fmax.reduce(rows), -np.fmin.reduce(rows))
    largest = np.nan_to_num(largest, posinf=np.inf)
    if (largest >= SMALL).all():
        return usual
    _, unit = np.unique([solution.unit(name) for name in states], return_inverse=True)
    of_unit = np.zeros(len(states))
    np.maximum.at(of_unit, unit, largest)
    size = of_unit[unit]
    return np.where((size > NOISE) & (size < SMALL), size * ATOL, ATOL)
