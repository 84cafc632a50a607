"""Secondary inputs, such as a temperature, of networks that keep a promise about their first inputs."""

from __future__ import annotations

from collections.abc import Sequence

import equinox as eqx
import jax
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array

from acausal._jax import as_key
from acausal.networks.mlp import SPREAD, Key, Product, uniform


class Secondary(eqx.Module):
    """Shifts of the layers of another network by the inputs ``T``: ``M_i tanh(A T + a)``.

    For any weights, each layer of the other network is only shifted. So a promise that holds for any biases
    holds for any secondary inputs.
    """

    weights: Array
    biases: Array
    mixing: tuple[Array, ...]

    def __init__(self, in_size: int, width: int, depth: int, *, key: Key) -> None:
        first, second, *others = jax.random.split(as_key(key), depth + 2)
        self.weights = uniform(first, (width, in_size), SPREAD / max(in_size, 1) ** 0.5)
        self.biases = uniform(second, (width,), SPREAD)
        limit = (3 / width) ** 0.5
        self.mixing = tuple(uniform(k, (width, width), limit) for k in others)

    def shifts(self, inputs: Sequence[ArrayLike], product: Product) -> list[Array]:
        """One shift for each hidden layer, shape (width,)."""
        h = jnp.stack([jnp.asarray(x) for x in inputs])
        features = jnp.tanh(product(self.weights, h) + self.biases)
        return [product(m, features) for m in self.mixing]


def number_of(secondary: Secondary | None) -> int:
    """How many secondary inputs there are."""
    return 0 if secondary is None else secondary.weights.shape[1]


def shifted(
    biases: Sequence[Array],
    secondary: Secondary | None,
    inputs: Sequence[ArrayLike],
    product: Product,
) -> list[Array]:
    """The biases of the hidden layers, shifted by the secondary inputs if there are any."""
    if secondary is None:
        return list(biases)
    shifts = secondary.shifts(inputs, product)
    return [b + s for b, s in zip(biases, shifts, strict=True)]
