"""Whether JAX is tracing: values are then unknown, and their checks are skipped."""

from __future__ import annotations

import jax
import jax.numpy as jnp
from jax import Array
from jax.core import Tracer
from jax.typing import ArrayLike as JaxArrayLike
from numpy.typing import ArrayLike


def traced(*trees: object) -> bool:
    """Whether any leaf stands for a value that is not known yet."""
    return any(isinstance(leaf, Tracer) for leaf in jax.tree.leaves(trees))


def array(value: ArrayLike | JaxArrayLike) -> Array:
    """A value as an array of floats; where it is known, it stays so within what JAX traces."""
    if traced(value):
        return jnp.asarray(value, float)
    with jax.ensure_compile_time_eval():
        return jnp.asarray(value, float)
