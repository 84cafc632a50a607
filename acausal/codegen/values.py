"""Where a model is evaluated: all that a program reads, in one record."""

from __future__ import annotations

from typing import Any, NamedTuple

from jax import Array
from jax.typing import ArrayLike


class Values(NamedTuple):
    """A point at which a model is evaluated; a pytree.

    Attributes:
        t: time [s].
        x: states, shape (n_states,).
        u: inputs, shape (n_inputs,).
        packed: parameters, from `ParameterLayout.pack`.
    """

    t: ArrayLike
    x: Array
    u: Array
    packed: Any
