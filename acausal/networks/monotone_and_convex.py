"""Networks of layers that are monotone or convex in their first inputs, for any weights and any further inputs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import equinox as eqx
import jax
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal._jax import as_key
from acausal.errors import DeclarationError
from acausal.networks.activations import ACTIVATIONS, INCREASING, SMOOTH_AND_CONVEX, checked
from acausal.networks.mlp import SPREAD, Key, Layered, Product, layers, uniform


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


class WithSecondary(Layered):
    """Base of networks that promise something of their first inputs; the others, if there are any, shift the biases."""

    if TYPE_CHECKING:  # subclasses have these as fields, each in an order of its own
        weights: tuple[Array, ...]
        biases: tuple[Array, ...]
        secondary: Secondary | None

    @property
    def in_size(self) -> int:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Number of all inputs."""
        further = 0 if self.secondary is None else self.secondary.weights.shape[-1]
        return self.weights[0].shape[-1] + further

    def shifted(self, inputs: Sequence[ArrayLike], product: Product) -> list[Array]:
        """The biases of the hidden layers, shifted by the secondary inputs if there are any."""
        biases = list(self.biases[:-1])
        if self.secondary is None:
            return biases
        shifts = self.secondary.shifts(inputs[self.weights[0].shape[-1] :], product)
        return [b + s for b, s in zip(biases, shifts, strict=True)]


class Monotone(WithSecondary):
    """A network with ``∂F/∂x ≥ 0`` in its first input ``x``, for any weights and any secondary inputs.

    Proof: every layer uses the magnitudes of its weights, ``h' = ρ(|W| h + b)``, and every activation ρ is increasing;
    so is their composition. Secondary inputs only shift the biases (`Secondary`). Every other
    neuron has the activation rotated by 180°, ``−ρ(−z)``: with ReLUs alone a network of positive weights would be
    convex (D. Runje, S. M. Shankaranarayana: Constrained monotonic neural networks, ICML 2023).

    Arguments:
        secondary: number of further inputs.
        width, depth: neurons in each hidden layer, and hidden layers.
        activation: one that is increasing, see `INCREASING`.
        last_layer: factor on the initial weights of the last layer.
        key: a JAX key, or a seed.

    Raises:
        DeclarationError: for an activation that decreases somewhere.
    """

    weights: tuple[Array, ...]
    biases: tuple[Array, ...]
    secondary: Secondary | None
    activation: str = eqx.field(static=True)

    def __init__(
        self,
        secondary: int = 0,
        width: int = 16,
        depth: int = 2,
        activation: str = "relu",
        *,
        last_layer: float = 0.1,
        key: Key | None = None,
    ) -> None:
        self.activation = checked(activation, INCREASING, "a monotone network")
        own, others = jax.random.split(as_key(key))
        self.weights, self.biases = layers(1, width, depth, last_layer, own)
        self.secondary = Secondary(secondary, width, depth, key=others) if secondary else None

    def evaluate(self, inputs: Sequence[ArrayLike], product: Product) -> Float[Array, ""]:
        """The output, given a function for the product of a matrix and a vector."""
        activation = ACTIVATIONS[self.activation]
        h = jnp.stack([jnp.asarray(inputs[0])])
        for weight, bias in zip(self.weights[:-1], self.shifted(inputs, product), strict=True):
            h = _turned(activation, product(jnp.abs(weight), h) + bias)
        return (product(jnp.abs(self.weights[-1]), h) + self.biases[-1])[0]


def _turned(activation: Callable[[Array], Array], z: Array) -> Array:
    """``ρ(z)`` and, of every other neuron, ``−ρ(−z)``."""
    sign = 1 - 2 * (jnp.arange(z.shape[-1]) % 2).astype(z.dtype)
    return sign * activation(sign * z)


class Convex(WithSecondary):
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

    def evaluate(self, inputs: Sequence[ArrayLike], product: Product) -> Float[Array, ""]:
        """The output, given a function for the product of a matrix and a vector."""
        activation = ACTIVATIONS[self.activation]
        n = self.weights[0].shape[1]
        x = jnp.stack([jnp.asarray(i) for i in inputs[:n]])
        first, *biases = self.shifted(inputs, product)
        h = activation(product(self.weights[0], x) + first)
        *hidden, last = zip(self.weights[1:], self.skips, strict=True)
        for (weight, skip), bias in zip(hidden, biases, strict=True):
            h = activation(product(jnp.abs(weight), h) + product(skip, x) + bias)
        weight, skip = last
        return (product(jnp.abs(weight), h) + product(skip, x) + self.biases[-1])[0]
