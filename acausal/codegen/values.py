"""The point at which a model is evaluated: everything that a program reads, in one record."""

from __future__ import annotations

from typing import Any, NamedTuple

import equinox as eqx
import numpy as np
from jax import Array
from jax.typing import ArrayLike


class Packed(eqx.Module):
    """All parameters of a model, bound ones computed: a pytree with few leaves.

    Attributes:
        values: numbers, shape (n_parameters,), in the program's order.
        modules: the callable parameters.
    """

    values: Array
    modules: tuple[Any, ...]

    @property
    def last(self) -> Packed:
        """The same at the last of several points, where numbers differ between them."""
        return self if self.values.ndim == 1 else Packed(self.values[-1], self.modules)

    def replaced(self, places: tuple[int, ...], numbers: Array) -> Packed:
        """The same with other numbers in some places."""
        return Packed(self.values.at[np.asarray(places)].set(numbers), self.modules)


class Values(NamedTuple):
    """A point at which a model is evaluated; a pytree.

    Attributes:
        t: time [s].
        x: states, shape (n_states,).
        u: inputs, shape (n_inputs,).
        packed: parameters.
        d: discrete variables, shape (n_discrete,); None: those at the start, or none.
    """

    t: ArrayLike
    x: Array
    u: Array
    packed: Packed
    d: Array | None = None
