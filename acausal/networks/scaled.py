"""Laws and energies in physical units, around networks of pure numbers."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal._jax import compiled
from acausal.networks.law_parts import WithFactor
from acausal.networks.mlp import Scale, check_inputs, scaled

REACH = 1e6
"""A law is constant further than this from zero, in input scales, so that no input makes it overflow."""


class Scaled(eqx.Module):
    """A law ``F(x) = output_scale · net((x − centre) / input_scale)`` of physical quantities.

    Attributes:
        left_open: names of the arguments of its specification that were not given, and that a training may choose.
    """

    net: Callable[..., Array]
    input_scale: Scale = eqx.field(static=True, default=1.0)
    output_scale: float = eqx.field(static=True, default=1.0)
    centre: Scale = eqx.field(static=True, default=0.0)
    left_open: tuple[str, ...] = eqx.field(static=True, default=())

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        _check_scales(self, inputs)
        if self.centre != 0.0:
            middle = self.centre if isinstance(self.centre, tuple) else (self.centre,) * len(inputs)
            inputs = tuple(jnp.asarray(x) - c for x, c in zip(inputs, middle, strict=True))
        numbers = jnp.clip(scaled(inputs, self.input_scale), -REACH, REACH)
        return self.output_scale * self.net(*numbers)


class WithLaw(eqx.Module):
    """A network whose law is not the network itself, such as the derivative of an energy."""

    @abstractmethod
    def law(self, *inputs: ArrayLike) -> Array:
        """The law."""


class EnergyLaw(WithLaw):
    """An energy ``W(x) = energy_scale · net(x / input_scale)``, whose derivative is a law, `law`.

    Attributes:
        energy_scale: magnitude of the energy; that of the law is ``energy_scale / input_scale``.
        inputs: how many of the first inputs the law is the derivative by.
        left_open: as of `Scaled`.
    """

    net: Callable[..., Array]
    input_scale: Scale = eqx.field(static=True, default=1.0)
    energy_scale: float = eqx.field(static=True, default=1.0)
    inputs: int = eqx.field(static=True, default=1)
    left_open: tuple[str, ...] = eqx.field(static=True, default=())

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The energy for scalar inputs."""
        _check_scales(self, inputs)
        return self.energy_scale * self.net(*scaled(inputs, self.input_scale))

    def law(self, *inputs: ArrayLike) -> Array:
        """The law ``∂W/∂x``: a scalar, or of shape (inputs,) where there are several."""
        moved = tuple(jnp.asarray(x) + 0.0 for x in inputs[: self.inputs])
        others = inputs[self.inputs :]
        forces = jax.grad(lambda point: self(*point, *others))(moved)
        return forces[0] if self.inputs == 1 else jnp.stack(forces)

    @property
    def output_scale(self) -> float:
        """Magnitude of the law of the first input."""
        scale = self.input_scale
        return self.energy_scale / (scale[0] if isinstance(scale, tuple) else scale)


def _check_scales(network: Scaled | EnergyLaw, inputs: Sequence[ArrayLike]) -> None:
    """Check the number of inputs, where there is a scale for each; the network inside checks it, too."""
    scale = network.input_scale
    check_inputs(network, inputs, len(scale) if isinstance(scale, tuple) else len(inputs))


def law_of(network: Callable[..., Array]) -> Callable[..., Array]:
    """The law of a network: itself, or the derivative of an energy."""
    return network.law if isinstance(network, WithLaw) else network


def over_points(
    law: Callable[..., Array],
    points: Float[Array | np.ndarray, " points"],
    rest: Float[Array | np.ndarray, "*points n"],
) -> Array:
    """A function over values of its first argument; the others are ``rest``, held or by point."""
    x, others = jnp.asarray(points), jnp.asarray(rest)
    others = jnp.broadcast_to(others, (len(x), others.shape[-1]))
    return jax.vmap(lambda x, others: law(x, *others))(x, others)


@compiled
def law_at(
    network: Callable[..., Array],
    points: Float[Array | np.ndarray, " points"],
    rest: Float[Array | np.ndarray, "*points n"],
) -> Float[Array, " points"]:
    """The law of a network over its first input, the first of several; others are ``rest``, held or by point."""
    found = over_points(law_of(network), points, rest)
    return found if found.ndim == 1 else found[:, 0]


def inputs_of(network: Callable[..., Array]) -> int:
    """How many inputs a network's law has; the others are secondary."""
    return network.inputs if isinstance(network, EnergyLaw) else 1


def rise_of(network: object) -> Float[Array, ""]:
    """Within what distance of zero a law may rise as dry friction does, in units of its first input; else infinite."""
    scale, part = 1.0, network
    while part is not None and not isinstance(part, WithFactor):
        if isinstance(part, Scaled):
            own = part.input_scale
            scale *= own[0] if isinstance(own, tuple) else own
        part = getattr(part, "net", None)
    return jnp.asarray(jnp.inf) if part is None else scale / part.factor.k
