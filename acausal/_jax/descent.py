"""Descent: the common part of optimizers that compare losses of the same data."""

from __future__ import annotations

import equinox as eqx
import optax
from jaxtyping import Array, Bool, Float


class DescentMethod(optax.GradientTransformationExtraArgs):
    """An optimizer that compares losses of the same data, and goes back from a worse point by itself.

    Its state is a `Descent`.
    """


class Descent(eqx.Module):
    """State of a descent.

    Attributes:
        point, value: the best point up to now, and its loss (infinite before the first update).
        converged: whether no lower loss can be found.
    """

    point: Float[Array, " n"]
    value: Float[Array, ""]
    converged: Bool[Array, ""]
