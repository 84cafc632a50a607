"""Networks for use inside equations: small, called with scalars, returning a scalar."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import Array
from jax.typing import ArrayLike

from acausal.errors import DeclarationError, nearest
from acausal.signals import Signal

ACTIVATIONS: dict[str, Callable[[Array], Array]] = {
    "relu": jax.nn.relu,
    "tanh": jnp.tanh,
    "softplus": jax.nn.softplus,
    "silu": jax.nn.silu,
    "gelu": jax.nn.gelu,
    "elu": jax.nn.elu,
    "sin": jnp.sin,
    "identity": lambda x: x,
}
"""Activations by name."""

SPREAD = 2.0
"""Bound of the first layer's weights and biases."""

FEW = 4
"""Sequences side by side up to which products are better fused than left to a library."""

Product = Callable[[Array, Array], Array]
Scale = float | tuple[float, ...]
Key = Array | int


class MLP(eqx.Module):
    """A multilayer perceptron from scalars to a scalar, ``F(x) = output_scale · net(x / input_scale)``.

    With one input and the defaults it is the paper's 1-16-16-1 network: 321 parameters.

    Arguments:
        in_size: number of scalar inputs.
        width: neurons in each hidden layer.
        depth: number of hidden layers.
        activation: of the hidden layers, by name (`ACTIVATIONS`); the last layer is linear.
        input_scale: typical magnitude of each input, in its unit (one number for all, or a tuple).
        output_scale: typical magnitude of the output, in its unit.
        last_layer: factor on the initial weights of the last layer; a small one starts near F = 0, that is with
            the model as physics alone gives it.
        key: a JAX key, or a seed.

    The first layer's weights and biases start uniform in ±2, so that the kinks of its neurons are spread over inputs
    of a few input scales; hidden weights in ±√(6/width); other biases at zero.

    Raises:
        DeclarationError: for an unknown activation, a size below one or scales that do not fit.
    """

    weights: tuple[Array, ...]
    biases: tuple[Array, ...]
    in_size: int = eqx.field(static=True)
    activation: str = eqx.field(static=True)
    input_scale: Scale = eqx.field(static=True)
    output_scale: float = eqx.field(static=True)

    def __init__(
        self,
        in_size: int = 1,
        width: int = 16,
        depth: int = 2,
        activation: str = "relu",
        *,
        input_scale: Scale = 1.0,
        output_scale: float = 1.0,
        last_layer: float = 0.1,
        key: Key,
    ) -> None:
        if activation not in ACTIVATIONS:
            raise DeclarationError(
                f"no activation '{activation}': {nearest(activation, ACTIVATIONS)}"
            )
        if min(in_size, width) < 1 or depth < 0:
            raise DeclarationError(f"a network of in_size={in_size}, width={width}, depth={depth}")
        if isinstance(input_scale, tuple) and len(input_scale) != in_size:
            raise DeclarationError(f"{len(input_scale)} input scales for {in_size} inputs")
        sizes = [in_size, *[width] * depth, 1]
        keys = jax.random.split(
            jax.random.key(key) if isinstance(key, int) else key, 2 * (depth + 1)
        )
        limits = [
            SPREAD / in_size**0.5,
            *[(6 / width) ** 0.5] * (depth - 1),
            last_layer * width**-0.5,
        ][-depth - 1 :]
        self.weights = tuple(
            _uniform(k, (rows, columns), limit)
            for k, columns, rows, limit in zip(keys[::2], sizes, sizes[1:], limits, strict=False)
        )
        first, *others = sizes[1:]
        spread = SPREAD if depth else 0.0
        self.biases = (_uniform(keys[1], (first,), spread), *(jnp.zeros(n) for n in others))
        self.in_size, self.activation = in_size, activation
        self.input_scale, self.output_scale = input_scale, output_scale

    def __call__(self, *inputs: ArrayLike) -> Array:
        """The output for ``in_size`` scalar inputs."""
        return self.evaluate(inputs, jnp.matmul)

    def evaluate(self, inputs: tuple[ArrayLike, ...], product: Product) -> Array:
        """The output, with a way to spell the product of a matrix and a vector."""
        if len(inputs) != self.in_size:
            raise DeclarationError(
                f"a network of {self.in_size} inputs is called with {len(inputs)}"
            )
        activation = ACTIVATIONS[self.activation]
        h = jnp.stack([jnp.asarray(x) for x in inputs]) / jnp.asarray(self.input_scale)
        for weight, bias in zip(self.weights[:-1], self.biases[:-1], strict=True):
            h = activation(product(weight, h) + bias)
        return self.output_scale * (product(self.weights[-1], h) + self.biases[-1])[0]

    def __repr__(self) -> str:
        sizes = [self.in_size, *(len(b) for b in self.biases)]
        return f"MLP({'-'.join(map(str, sizes))}, {self.activation})"


class Fused(eqx.Module):
    """A network whose products are spelled as sums, which XLA fuses into the step around them.

    On a CPU the gradient of the quarter vehicle takes 0.8 × the time of matrix products for up to
    `FEW` sequences side by side, and 2 × for twelve and more.
    """

    net: MLP

    def __call__(self, *inputs: ArrayLike) -> Array:
        """The network's output."""
        return self.net.evaluate(inputs, lambda matrix, vector: jnp.sum(matrix * vector, axis=-1))


def arranged(params: Mapping[str, Any], side_by_side: int) -> dict[str, Any]:
    """The parameters with networks spelled for so many evaluations side by side; they compute the same."""

    def fuse(leaf: Any) -> Any:
        return Fused(leaf) if isinstance(leaf, MLP) and 1 < side_by_side <= FEW else leaf

    return {
        name: jax.tree.map(fuse, leaf, is_leaf=lambda node: isinstance(node, MLP))
        for name, leaf in params.items()
    }


def _uniform(key: Array, shape: tuple[int, ...], limit: float) -> Array:
    return jax.random.uniform(key, shape, minval=-limit, maxval=limit, dtype=float)


class OffsetCorrected(eqx.Module):
    """A network less its value at zero: ``F̃(x) = F(x) − F(0)``, the paper's (5).

    With secondary inputs only the first is set to zero: ``F̃(x, T) = F(x, T) − F(0, T)``.
    """

    net: Callable[..., Array]

    def __call__(self, *inputs: ArrayLike) -> Array:
        """The corrected output for scalar inputs."""
        return self.net(*inputs) - self.net(jnp.zeros_like(inputs[0]), *inputs[1:])


def modules(params: Mapping[str, Any]) -> dict[str, eqx.Module]:
    """The modules (networks, tables) among a model's parameters, by name."""
    return {name: leaf for name, leaf in params.items() if isinstance(leaf, eqx.Module)}


def networks(params: Mapping[str, Any]) -> dict[str, eqx.Module]:
    """The modules that hold something to train: floating-point arrays that are no time base or table."""
    return {name: module for name, module in modules(params).items() if _trainable(module)}


def _trainable(module: eqx.Module) -> bool:
    arrays = jax.tree.leaves(eqx.filter(module, eqx.is_inexact_array))
    return bool(arrays) and not isinstance(module, Signal)


def remove_offset(
    params: Mapping[str, Any], names: tuple[str, ...] | None = None
) -> dict[str, Any]:
    """The parameters with networks wrapped in `OffsetCorrected` (all networks, or those named)."""
    chosen = networks(params) if names is None else names
    return {n: OffsetCorrected(leaf) if n in chosen else leaf for n, leaf in params.items()}


def output_scale(module: Any) -> float:
    """A network's typical output: its ``output_scale`` if it has one, else 1."""
    if isinstance(module, OffsetCorrected):
        return output_scale(module.net)
    return float(getattr(module, "output_scale", 1.0))
