"""Keys of random numbers, as users give them."""

from __future__ import annotations

import operator
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jax import Array

from acausal.errors import DataError, is_whole, shown


def as_key(key: Any) -> Array:
    """A JAX key, from a key of the new kind or the old one, or a seed.

    Raises:
        DataError: for anything else.
    """
    if is_whole(key):
        return jax.random.key(operator.index(key))
    dtype, shape = getattr(key, "dtype", None), getattr(key, "shape", None)
    is_new = dtype is not None and jnp.issubdtype(dtype, jax.dtypes.prng_key)
    if not ((is_new and shape == ()) or (dtype == np.uint32 and shape == (2,))):
        raise DataError(
            f"key={shown(key)} is not a key; give a whole number, or jax.random.key(0)."
        )
    return key
