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
    if key is None:
        raise DataError(
            "A network's weights are drawn with a key: give key=0, or any other seed; in a component, make it where "
            "its parameters are: net = ac.Module(lambda key: ac.MLP(key=key))."
        )
    dtype, shape = getattr(key, "dtype", None), getattr(key, "shape", None)
    is_new = dtype is not None and jnp.issubdtype(dtype, jax.dtypes.prng_key)
    if not ((is_new and shape == ()) or (dtype == np.uint32 and shape == (2,))):
        raise DataError(
            f"key={shown(key)} is not a key; give a whole number, or jax.random.key(0)."
        )
    return key
