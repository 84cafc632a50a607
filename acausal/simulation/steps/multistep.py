"""The numbers of multistep formulas on uneven times: all from Lagrange's polynomials through the latest points.

Times are given as ``s``: how far back they lie from the end of the step, in steps; the start of the step has ``s = 1``.
"""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

MOST = 5
"""The highest order of backward differentiation formulas that is used; from 7 on they are unstable."""

POINTS = MOST + 1
"""Points before the end of a step that a formula of the highest order reads."""

HARMONIC = np.concatenate([[0.0], np.cumsum(1 / np.arange(1, MOST + 1))])
"""By order, 1 + 1/2 + ... + 1/order."""


def weights(s: Float[Array, " n"], count: Int[Array, ""], at: Float[Array, ""]) -> Array:
    """What the first ``count`` of some points weigh in the value, at a point, of the polynomial through them."""
    used = jnp.arange(len(s)) < count
    others = used[:, None] & used & ~np.eye(len(s), dtype=bool)
    apart = s - s[:, None]  # [i, l]: s_l - s_i
    ratios = jnp.where(others, (s - at) / jnp.where(others, apart, 1.0), 1.0)
    return jnp.where(used, jnp.prod(ratios, axis=1), 0.0)


def slopes(s: Float[Array, " n"], count: Int[Array, ""]) -> Array:
    """What they weigh in its derivative at s = 0, by the time in steps."""
    used = jnp.arange(len(s)) < count
    inverse = jnp.where(used, 1 / jnp.where(used, s, 1.0), 0.0)
    return weights(s, count, jnp.zeros((), s.dtype)) * (jnp.sum(inverse) - inverse)


def differences(s: Float[Array, " n"], order: Int[Array, ""]) -> Array:
    """What the first ``order + 1`` points weigh in the derivative of this order, times steps to the same power."""
    used = jnp.arange(len(s)) < order + 1
    others = used[:, None] & used & ~np.eye(len(s), dtype=bool)
    apart = jnp.where(others, s - s[:, None], 1.0)
    factorial = jnp.asarray(np.cumprod([1, *range(1, len(s))]), s.dtype)[order]
    return jnp.where(used, factorial / jnp.prod(apart, axis=1), 0.0)


def error_constant(s: Float[Array, " n"], order: Int[Array, ""]) -> Array:
    """The local error over the difference between a step's result and its prediction (Brenan et al. 1996, 5.2)."""
    numbers = jnp.arange(len(s))
    inverse = 1 / s
    total = jnp.sum(jnp.where(numbers < order, inverse, 0.0))
    last = inverse[order]
    return jnp.maximum(last, jnp.abs(last + total - jnp.asarray(HARMONIC, s.dtype)[order]))
