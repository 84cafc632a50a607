"""Jacobians of functions of a vector."""

from __future__ import annotations

from collections.abc import Callable

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float


def value_and_jacobian(
    function: Callable[[Float[Array, " P"]], Float[Array, " ..."]],
    at: Float[Array, " P"],
    axis: int,
) -> tuple[Float[Array, " ..."], Float[Array, " ..."]]:
    """A function's value and Jacobian, in forward mode; ``axis`` of the Jacobian belongs to the arguments."""

    def push(direction: Float[Array, " P"]) -> tuple[Float[Array, " ..."], Float[Array, " ..."]]:
        return jax.jvp(function, (at,), (direction,))

    return jax.vmap(push, out_axes=(None, axis))(jnp.eye(len(at), dtype=at.dtype))
