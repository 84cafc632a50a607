"""Gradients of one number of a simulation: which parameters move, and what differences say."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

import acausal as ac

WIDTH = 2e-2
"""Relative width of differences; those of fourth order are right to its fourth power."""


def places(system: ac.System, suffix: str) -> tuple[int, ...]:
    """Where the free parameters of a name lie among the packed values."""
    layout = system.layout
    return tuple(k for k, i in enumerate(layout.order) if layout.names[int(i)].endswith(suffix))


def by_largest_entries(
    value: Callable[..., Any], gradients: Sequence[Any], arguments: Sequence[Float[Array, " n"]]
) -> float:
    """The largest relative error of the largest entry of each gradient, beside central differences of fourth order."""
    errors: list[float] = []
    for k, (slope, argument) in enumerate(zip(gradients, arguments, strict=True)):
        i = int(jnp.argmax(jnp.abs(slope)))
        h = WIDTH * float(argument[i])

        def moved(by: float, k: int = k, i: int = i) -> float:
            own = [a.at[i].add(by) if j == k else a for j, a in enumerate(arguments)]
            return float(value(*own))

        near, far = moved(h) - moved(-h), moved(2 * h) - moved(-2 * h)
        slope_by_differences = (8 * near - far) / (12 * h)
        errors.append(abs(float(slope[i]) / slope_by_differences - 1))
    return float(np.max(errors))
