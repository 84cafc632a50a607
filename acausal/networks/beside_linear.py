"""Networks beside a linear law."""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float


class BesideLinear(eqx.Module):
    """``F(x) + Σ slope_i x_i + offset``: a law beside a linear one.

    Where the network saturates, the law goes on along the linear one.

    Attributes:
        slope: of the first inputs.
        offset: ``None`` where the law vanishes at zero.
    """

    net: Callable[..., Array]
    slope: Float[Array, " n"]
    offset: Float[Array, ""] | None = None

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        linear = sum(s * jnp.asarray(x) for s, x in zip(self.slope, inputs, strict=False))
        return self.net(*inputs) + linear + (0.0 if self.offset is None else self.offset)


class BesideQuadratic(eqx.Module):
    """``W(x) + Σ ½ slope_i x_i² + offset x_1``: an energy beside that of a linear law; attributes as there."""

    net: Callable[..., Array]
    slope: Float[Array, " n"]
    offset: Float[Array, ""] | None = None

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        squares = sum(
            0.5 * s * jnp.asarray(x) ** 2 for s, x in zip(self.slope, inputs, strict=False)
        )
        ahead = 0.0 if self.offset is None else self.offset * jnp.asarray(inputs[0])
        return self.net(*inputs) + squares + ahead
