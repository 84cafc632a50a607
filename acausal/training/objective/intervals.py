"""Which interval of a time base holds a time, for many time bases end to end."""

from __future__ import annotations

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float, Int


def interval(
    ts: Float[Array, " M"],
    low: Int[Array, "*n"],
    high: Int[Array, "*n"],
    t: Float[Array, "*n"],
    step: Float[Array, "*n"] | None = None,
) -> Int[Array, "*n"]:
    """The largest i from ``low`` to ``high`` with ``ts[i] <= t``; ``low`` where there is none.

    Arguments:
        ts: times that increase from ``low`` to ``high``.
        low, high: where a time base begins and ends in ``ts``.
        t: times to look for.
        step: the distance of equally spaced times, which need no search.
    """
    ts, t = jax.lax.stop_gradient((ts, t))
    if step is not None:
        steps = jnp.floor((t - ts[low]) / jax.lax.stop_gradient(step))
        return jnp.clip(low + steps.astype(low.dtype), low, high)

    def halve(
        _: Int[Array, ""], ends: tuple[Int[Array, "*n"], Int[Array, "*n"]]
    ) -> tuple[Int[Array, "*n"], Int[Array, "*n"]]:
        low, high = ends
        middle = (low + high + 1) // 2
        beyond = ts[middle] > t
        return jnp.where(beyond, low, middle), jnp.where(beyond, middle - 1, high)

    low, high = (jnp.broadcast_to(end, t.shape) for end in (low, high))
    low, high = (jnp.minimum(low, high), high)
    return jax.lax.fori_loop(0, len(ts).bit_length(), halve, (low, high))[0]
