"""Plates of heat capacities: simulation and gradient."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

import acausal as ac
from benchmarks.stiff.compare import TIGHT, TOLERANCE, Task, against_cvode, gradient_cost
from benchmarks.stiff.gradients import by_largest_entries, places
from benchmarks.stiff.plate import Plate

SIZES = (10, 30, 50, 100)
GRADIENT_SIZES = (10, 30, 100)
END = 100.0


def task(n: int) -> Task:
    """A plate over 100 s."""
    return Task(f"plate_{n}", ac.compile(Plate(n)), np.linspace(0.0, END, 11))


def plates(sizes: Sequence[int] = SIZES) -> dict[str, Any]:
    """Simulations, beside CVODE's."""
    found: dict[str, Any] = {}
    for n in sizes:
        found |= against_cvode(task(n))
    return found


def gradients(sizes: Sequence[int] = GRADIENT_SIZES) -> dict[str, Any]:
    """Gradients of a final temperature by all conductances and initial temperatures."""
    found: dict[str, Any] = {}
    for n in sizes:
        found |= _gradient(task(n), n)
    return found


def _gradient(task: Task, n: int) -> dict[str, Any]:
    system = task.system
    packed, moved = system.pack(), places(system, ".G")
    start = jnp.asarray(system.initial_state(system.parameters()))

    def final(G: Float[Array, " n"], T: Float[Array, " m"], rtol: float = TOLERANCE) -> Any:
        sol = task.simulate(rtol, params=packed.replaced(moved, G), x0=T, saveat=[END])
        return sol.x[-1, n // 2]

    def tight(G: Any, T: Any) -> Any:
        return final(G, T, TIGHT)

    def error() -> float:
        slopes = jax.grad(tight, (0, 1))(*arguments)
        return by_largest_entries(tight, slopes, arguments)

    arguments = packed.values[np.asarray(moved)], start
    return gradient_cost(task.name, final, arguments, error)
