"""Whether JAX is tracing: then values cannot be looked at, and checks of them are left out."""

from typing import Any

import jax
import jax.numpy as jnp
from jax import Array
from jax.core import Tracer


def traced(*trees: Any) -> bool:
    """Whether any leaf stands for a value that is not known yet."""
    return any(isinstance(leaf, Tracer) for leaf in jax.tree.leaves(trees))


def array(value: Any) -> Array:
    """A value as an array of floats; where it is known, it stays so within what JAX traces."""
    if traced(value):
        return jnp.asarray(value, float)
    with jax.ensure_compile_time_eval():
        return jnp.asarray(value, float)
