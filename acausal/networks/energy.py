"""Energies: functions whose derivative is a force, with a minimum at rest."""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal.networks.passive import START


class Bowl(eqx.Module):
    """``½ |x|² softplus(F(x, T))``: positive except at zero, for any network ``F``."""

    net: Callable[..., Array]
    inputs: int = eqx.field(static=True, default=1)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        squares = sum(jnp.asarray(x) ** 2 for x in inputs[: self.inputs])
        return 0.5 * squares * jax.nn.softplus(self.net(*inputs) + START)


class FromRest(eqx.Module):
    """``W(x, T) − W(0, T)``: an energy less its value at rest."""

    net: Callable[..., Array]
    inputs: int = eqx.field(static=True, default=1)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        rest = [jnp.zeros_like(x) for x in inputs[: self.inputs]]
        return self.net(*inputs) - self.net(*rest, *inputs[self.inputs :])


class Levelled(eqx.Module):
    """``W(x, T) − W(0, T) − ∂W(0, T)/∂x · x``: no energy and no force at rest.

    A convex ``W`` lies above its tangents, so that the rest is nowhere negative.
    """

    net: Callable[..., Array]
    inputs: int = eqx.field(static=True, default=1)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        moved, others = inputs[: self.inputs], inputs[self.inputs :]
        point = tuple(jnp.asarray(x) for x in moved)
        rest = tuple(jnp.zeros_like(x) for x in point)
        value, change = jax.jvp(lambda *x: self.net(*x, *others), rest, point)
        return self.net(*inputs) - value - change
