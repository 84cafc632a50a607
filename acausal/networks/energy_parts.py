"""Parts of energies: functions whose derivative is a law, with a minimum at rest."""

from __future__ import annotations

import equinox as eqx
import jax
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal.networks.law_parts import START, Wrapper, least_and_more


class Bowl(Wrapper):
    """``½ |x|² softplus(F(x, T))``: positive except at zero, for any network ``F``."""

    inputs: int = eqx.field(static=True, default=1)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        squares = sum(jnp.asarray(x) ** 2 for x in inputs[: self.inputs])
        return 0.5 * squares * jax.nn.softplus(self.net(*inputs) + START)


class Levelled(Wrapper):
    """``W(x, T) − W(0, T) − ∂W(0, T)/∂x · x``: no energy and no force at rest.

    A convex ``W`` lies above its tangents, so that the rest is nowhere negative.
    """

    inputs: int = eqx.field(static=True, default=1)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        moved, others = inputs[: self.inputs], inputs[self.inputs :]
        point = tuple(jnp.asarray(x) for x in moved)
        rest = tuple(jnp.zeros_like(x) for x in point)
        value, change = jax.jvp(lambda *x: self.net(*x, *others), rest, point)
        return self.net(*inputs) - value - change


class BesideQuadratic(Wrapper):
    """``W(x) + Σ ½ slope_i x_i² + offset x_1``: an energy beside that of a linear law; attributes as there."""

    slope: Float[Array, " n"]
    offset: Float[Array, ""] | None = None

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        squares = sum(
            0.5 * s * jnp.asarray(x) ** 2 for s, x in zip(self.slope, inputs, strict=False)
        )
        ahead = 0.0 if self.offset is None else self.offset * jnp.asarray(inputs[0])
        return self.net(*inputs) + squares + ahead


class WithMinCurvature(Wrapper):
    """``W(x, T) + ½ (least + softplus(more)) |x|²``: a convex energy whose curvature is at least ``least``.

    Attributes:
        more: trained; ``None`` omits that term. See `start_at`.
        inputs: how many of the first inputs ``x`` has.
    """

    least: float = eqx.field(static=True)
    more: Array | None = None
    inputs: int = eqx.field(static=True, default=1)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        squares = sum(jnp.asarray(x) ** 2 for x in inputs[: self.inputs])
        return self.net(*inputs) + 0.5 * least_and_more(self.least, self.more) * squares
