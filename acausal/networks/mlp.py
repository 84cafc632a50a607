"""The plain network: a multilayer perceptron from scalars to a scalar; and checks of inputs and sizes."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from functools import partial

import equinox as eqx
import jax
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal._jax import as_key, is_number, is_real, traced
from acausal.errors import DeclarationError, need_whole, shown
from acausal.modeling import charge
from acausal.networks.activations import ACTIVATIONS, checked

LARGEST = 10_000
"""Neurons in a layer, or layers: more are a mistake, and fill the memory."""

MOST = 10_000_000
"""Weights of a network: their first values take up to half a gigabyte."""

SPREAD = 2.0
"""Bound of the first layer's weights and biases."""

Product = Callable[[Array, Array], Array]
Scale = float | tuple[float, ...]
Key = Array | int


class Layered(eqx.Module):
    """Base of networks that are made of layers, so that their products can be computed in several ways.

    Attributes:
        in_size: number of all inputs.
    """

    in_size: eqx.AbstractVar[int]

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output, a scalar, for scalar inputs."""
        check_inputs(self, inputs, self.in_size)
        return self.evaluate(inputs, jnp.matmul)

    @abstractmethod
    def evaluate(self, inputs: Sequence[ArrayLike], product: Product) -> Float[Array, ""]:
        """The output, given a function for the product of a matrix and a vector."""


class MLP(Layered):
    """A multilayer perceptron from scalars to a scalar, ``F(x) = output_scale · net(x / input_scale)``.

    With one input and the defaults it is the paper's 1-16-16-1 network: 321 parameters.

    Arguments:
        in_size: number of scalar inputs.
        width: neurons in each hidden layer.
        depth: number of hidden layers.
        activation: of the hidden layers, by name (`ACTIVATIONS`); the last layer is linear. ReLU by default.
        input_scale: typical magnitude of each input, in its unit (one number for all, or a tuple).
        output_scale: typical magnitude of the output, in its unit. Scales that are not given are 1, until
            `acausal.fit` chooses them from the data (`with_scales`).
        last_layer: factor on the initial weights of the last layer; with a small one training starts near F = 0,
            that is with the model without the network.
        key: a JAX key, or a seed.

    The first layer's weights and biases start uniform in ±2, so that the kinks of its neurons spread over a few input
    scales; hidden weights in ±√(6/width); other biases at zero.

    Raises:
        DeclarationError: for an unknown activation, a size below one or scales that do not fit.
    """

    weights: tuple[Array, ...]
    biases: tuple[Array, ...]
    in_size: int = eqx.field(static=True)
    activation: str = eqx.field(static=True)
    input_scale: Scale = eqx.field(static=True)
    output_scale: float = eqx.field(static=True)
    left_open: tuple[str, ...] = eqx.field(static=True)

    def __init__(
        self,
        in_size: int = 1,
        width: int = 16,
        depth: int = 2,
        activation: str | None = None,
        *,
        input_scale: Scale | None = None,
        output_scale: float | None = None,
        last_layer: float = 0.1,
        key: Key | None = None,
    ) -> None:
        given = {"activation": activation, "input_scale": input_scale, "output_scale": output_scale}
        self.left_open = tuple(name for name, value in given.items() if value is None)
        self.activation = checked("relu" if activation is None else activation)
        self.input_scale = 1.0 if input_scale is None else input_scale
        self.output_scale = 1.0 if output_scale is None else output_scale
        check_sizes(in_size, width, depth, self.input_scale, self.output_scale)
        if not is_number(last_layer):
            raise DeclarationError(
                f"last_layer={shown(last_layer)} is not a factor; give a number."
            )
        self.weights, self.biases = layers(in_size, width, depth, last_layer, key)
        self.in_size = in_size

    def evaluate(self, inputs: Sequence[ArrayLike], product: Product) -> Float[Array, ""]:
        """The output, given a function for the product of a matrix and a vector."""
        activation = ACTIVATIONS[self.activation]
        h = scaled(inputs, self.input_scale)
        for weight, bias in zip(self.weights[:-1], self.biases[:-1], strict=True):
            h = activation(product(weight, h) + bias)
        return self.output_scale * (product(self.weights[-1], h) + self.biases[-1])[0]

    def __repr__(self) -> str:
        sizes = [self.in_size, *(len(b) for b in self.biases)]
        return f"MLP({'-'.join(map(str, sizes))}, {self.activation})"


def layers(
    in_size: int, width: int, depth: int, last_layer: float, key: Key | None
) -> tuple[tuple[Array, ...], tuple[Array, ...]]:
    """Fresh weights, of shape (rows, columns), and biases of ``depth`` hidden layers and the last one."""
    return _layers(in_size, width, depth, last_layer, as_key(key))


@partial(jax.jit, static_argnums=(0, 1, 2, 3))  # one program to compile, not one for every draw
def _layers(
    in_size: int, width: int, depth: int, last_layer: float, key: Array
) -> tuple[tuple[Array, ...], tuple[Array, ...]]:
    sizes = [in_size, *[width] * depth, 1]
    shapes = list(zip(sizes[1:], sizes, strict=False))
    limits = [
        SPREAD / in_size**0.5,
        *[(6 / width) ** 0.5] * (depth - 1),
        last_layer * width**-0.5,
    ][-depth - 1 :]
    largest = max(rows * columns for rows, columns in shapes)
    keys = jax.random.split(key, 2 * len(shapes))
    drawn = jax.vmap(lambda k: uniform(k, (largest,), 1.0))(keys)
    weights = tuple(
        limit * numbers[: rows * columns].reshape(rows, columns)
        for numbers, (rows, columns), limit in zip(drawn[::2], shapes, limits, strict=True)
    )
    first, *others = sizes[1:]
    bias = (SPREAD if depth else 0.0) * drawn[1, :first]
    return weights, (bias, *(jnp.zeros(n) for n in others))


def check_sizes(
    in_size: int, width: int, depth: int, input_scale: Scale = 1.0, output_scale: float = 1.0
) -> None:
    """Check the sizes and scales of a network, and charge its weights to the budget of a file.

    Raises:
        DeclarationError: if no network has them.
        BudgetError: for more weights than the budget has elements.
    """
    sizes = ("in_size", in_size, 1), ("width", width, 1), ("depth", depth, 0)
    for name, size, least in sizes:
        if need_whole(size, f"a network's {name}", DeclarationError, least) > LARGEST:
            raise DeclarationError(f"a network's {name}={size}; give {LARGEST} or less.")
    weights = width * (in_size + width * depth)
    charge("elements", weights, f"a network of width {width}, depth {depth}")
    if weights > MOST:
        raise DeclarationError(
            f"a network of width={width} and depth={depth} has {weights:,} weights; give {MOST:,} or less."
        )
    if isinstance(input_scale, tuple) and len(input_scale) != in_size:
        raise DeclarationError(f"{len(input_scale)} input scales for {in_size} inputs")
    scales = *(input_scale if isinstance(input_scale, tuple) else (input_scale,)), output_scale
    if not all(is_number(s) and (traced(s) or s > 0) for s in scales):
        raise DeclarationError("input_scale and output_scale are magnitudes; give positive numbers")


def uniform(key: Array, shape: tuple[int, ...], limit: float) -> Array:
    """Numbers between ±limit."""
    return jax.random.uniform(key, shape, minval=-limit, maxval=limit, dtype=float)


def scaled(inputs: Sequence[ArrayLike], scale: Scale) -> Array:
    """Inputs over their scales, side by side; in the inputs' own precision, integers in the default one."""
    stacked = jnp.stack([jnp.asarray(x) for x in inputs])
    stacked = stacked.astype(jnp.result_type(stacked, float))
    return stacked / (jnp.asarray(scale, stacked.dtype) if isinstance(scale, tuple) else scale)


def check_inputs(network: object, inputs: Sequence[ArrayLike], expected: int) -> None:
    """Check that a network is called with as many scalars as it has inputs.

    Raises:
        DeclarationError: if it is not.
    """
    name, wanted = type(network).__name__, f"{expected} input{'s' * (expected != 1)}"
    if len(inputs) != expected:
        more = f"use one with as many, Law(secondary={len(inputs) - 1}) or MLP({len(inputs)})"
        few = len(inputs) < expected
        remedy = "give the others, too" if few else f"leave out the others, or {more}"
        raise DeclarationError(
            f"{name}: a network of {wanted} is called with {len(inputs)}; {remedy}"
        )
    for x in inputs:
        if not is_real(x):
            raise DeclarationError(f"{name}: a network takes real numbers, not {shown(x)}.")
    shapes = [shape for x in inputs if (shape := jnp.shape(x))]
    if shapes:
        raise DeclarationError(
            f"{name}: a network takes scalars, not an array of shape {shapes[0]}; use jax.vmap(network)"
        )
