"""Descent: what optimizers have in common that compare losses of one and the same data."""

from __future__ import annotations

import equinox as eqx
import optax
from jax import Array


class DescentMethod(optax.GradientTransformationExtraArgs):
    """An optimizer that compares losses of one and the same data, and takes back itself what is worse.

    Its state is a `Descent`.
    """


class Descent(eqx.Module):
    """Where a descent is.

    Attributes:
        point, value, gradient: the best point up to now, its loss (infinite before the first update) and gradient.
        converged: whether nothing leads to a lower loss.
    """

    point: Array
    value: Array
    gradient: Array
    converged: Array
