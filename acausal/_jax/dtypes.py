"""Precision: a model computes in the precision of its state and parameters."""

from __future__ import annotations

import math
from typing import Any, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array
from jax.typing import ArrayLike, DTypeLike

from acausal._jax.tracing import traced
from acausal.errors import DataError, shown

PRECISIONS = ("float64", "float32")

Tree = TypeVar("Tree")


def precision(dtype: DTypeLike) -> np.dtype[np.floating[Any]]:
    """A data type, if it is one of `PRECISIONS`.

    Raises:
        DataError: for another.
    """
    try:
        chosen = np.dtype(dtype)
    except (TypeError, ValueError):
        chosen = None
    if chosen is None or chosen.name not in PRECISIONS:
        name = shown(dtype) if chosen is None else chosen.name
        raise DataError(f"dtype={name}: models compute in {' or '.join(PRECISIONS)}.")
    return chosen


def above_rounding(least: float, roundings: float, dtype: DTypeLike) -> float:
    """A small number relative to 1, or so many roundings of a precision where that is more."""
    return max(least, roundings * float(jnp.finfo(dtype).eps))


def cast(tree: Tree, dtype: DTypeLike) -> Tree:
    """The tree with its floating-point arrays in a precision."""
    return jax.tree.map(lambda a: a.astype(dtype) if eqx.is_inexact_array(a) else a, tree)


def floating(value: ArrayLike) -> Array:
    """An array of floating-point numbers in its own precision; integers become double precision."""
    array = jnp.asarray(value)
    return array if jnp.issubdtype(array.dtype, jnp.floating) else jnp.asarray(array, float)


def is_real(value: object) -> bool:
    """Whether a value is a real number (or a truth value), or an array of them."""
    if isinstance(value, float):
        return True
    leaves = jax.tree.leaves(value) if traced(value) else [value]
    return all(_real_dtype(leaf) for leaf in leaves)


def is_number(value: object) -> bool:
    """Whether a value is one real number, and finite where it is known."""
    if isinstance(value, float):
        return math.isfinite(value)
    if not is_real(value):
        return False
    number: Any = value
    return np.ndim(number) == 0 and (traced(number) or bool(np.isfinite(number)))


def check_time(t: object, argument: str = "t") -> None:
    """Refuse what is not one time.

    Raises:
        DataError: for it; it names the argument.
    """
    if not is_number(t):
        raise DataError(f"{argument}={shown(t)} is not a time; give seconds, such as 0.0.")


def _real_dtype(value: Any) -> bool:
    try:
        dtype = value.dtype if isinstance(value, Array) else np.asarray(value).dtype
    except ValueError:  # rows of different lengths
        return False
    if getattr(dtype, "kind", "") == "m":  # NumPy counts durations among the integers
        return False
    return any(jnp.issubdtype(dtype, kind) for kind in (np.bool_, np.integer, np.floating))
