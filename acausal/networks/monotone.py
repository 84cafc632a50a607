"""A network that increases with its first input."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import equinox as eqx
import jax
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal._jax import as_key
from acausal.networks.activations import ACTIVATIONS, INCREASING, checked
from acausal.networks.mlp import Key, Layered, Product, layers
from acausal.networks.secondary import Secondary, number_of, shifted


class Monotone(Layered):
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

    @property
    def in_size(self) -> int:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Number of all inputs."""
        return 1 + number_of(self.secondary)

    def evaluate(self, inputs: Sequence[ArrayLike], product: Product) -> Float[Array, ""]:
        """The output, given a function for the product of a matrix and a vector."""
        activation = ACTIVATIONS[self.activation]
        h = jnp.stack([jnp.asarray(inputs[0])])
        biases = shifted(self.biases[:-1], self.secondary, inputs[1:], product)
        for weight, bias in zip(self.weights[:-1], biases, strict=True):
            h = _turned(activation, product(jnp.abs(weight), h) + bias)
        return (product(jnp.abs(self.weights[-1]), h) + self.biases[-1])[0]


def _turned(activation: Callable[[Array], Array], z: Array) -> Array:
    """``ρ(z)`` and, of every other neuron, ``−ρ(−z)``."""
    sign = 1 - 2 * (jnp.arange(z.shape[-1]) % 2).astype(z.dtype)
    return sign * activation(sign * z)
