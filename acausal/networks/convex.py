"""A network that is convex in its first inputs."""

from __future__ import annotations

from collections.abc import Sequence

import equinox as eqx
import jax
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal._jax import as_key
from acausal.errors import DeclarationError
from acausal.networks.activations import ACTIVATIONS, SMOOTH_AND_CONVEX, checked
from acausal.networks.mlp import SPREAD, Key, Layered, Product, layers, uniform
from acausal.networks.secondary import Secondary, number_of, shifted


class Convex(Layered):
    """A network ``W(x)`` that is convex in its first inputs, for any weights and any secondary inputs.

    Proof: ``h' = ρ(|U| h + V x + b)`` with a convex, increasing ρ. A sum of convex functions with positive weights is
    convex, so is one with an affine function added, and so is a convex increasing function of it. Secondary inputs only
    shift the biases (`Secondary`). After B. Amos, L. Xu, J. Z. Kolter: Input convex neural networks, ICML 2017.

    Arguments:
        in_size: number of inputs in which the network is convex. secondary: number of further ones.
        width, depth: neurons in each hidden layer, and hidden layers.
        activation: one that is convex and increasing, with a continuous derivative, see `SMOOTH_AND_CONVEX`.
        last_layer: factor on the initial weights of the last layer.
        key: a JAX key, or a seed.

    Raises:
        DeclarationError: for any other activation, or without a hidden layer.
    """

    weights: tuple[Array, ...]
    biases: tuple[Array, ...]
    skips: tuple[Array, ...]
    secondary: Secondary | None
    activation: str = eqx.field(static=True)

    def __init__(
        self,
        in_size: int = 1,
        secondary: int = 0,
        width: int = 16,
        depth: int = 2,
        activation: str = "softplus",
        *,
        last_layer: float = 0.1,
        key: Key | None = None,
    ) -> None:
        self.activation = checked(activation, SMOOTH_AND_CONVEX, "a convex network")
        if depth < 1:
            raise DeclarationError("a convex network needs a hidden layer; give depth=1 or more")
        own, ahead, others = jax.random.split(as_key(key), 3)
        self.weights, self.biases = layers(in_size, width, depth, last_layer, own)
        limit = SPREAD / in_size**0.5
        keys = jax.random.split(ahead, depth)
        sizes = [*[width] * (depth - 1), 1]
        limits = [*[limit] * (depth - 1), last_layer * limit]
        self.skips = tuple(
            uniform(k, (rows, in_size), bound)
            for k, rows, bound in zip(keys, sizes, limits, strict=True)
        )
        self.secondary = Secondary(secondary, width, depth, key=others) if secondary else None

    @property
    def in_size(self) -> int:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Number of all inputs."""
        return self.weights[0].shape[1] + number_of(self.secondary)

    def evaluate(self, inputs: Sequence[ArrayLike], product: Product) -> Float[Array, ""]:
        """The output, given a function for the product of a matrix and a vector."""
        activation = ACTIVATIONS[self.activation]
        n = self.weights[0].shape[1]
        x = jnp.stack([jnp.asarray(i) for i in inputs[:n]])
        first, *biases = shifted(self.biases[:-1], self.secondary, inputs[n:], product)
        h = activation(product(self.weights[0], x) + first)
        *hidden, last = zip(self.weights[1:], self.skips, strict=True)
        for (weight, skip), bias in zip(hidden, biases, strict=True):
            h = activation(product(jnp.abs(weight), h) + product(skip, x) + bias)
        weight, skip = last
        return (product(jnp.abs(weight), h) + product(skip, x) + self.biases[-1])[0]
