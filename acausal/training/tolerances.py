"""Tolerances: parameters that are not the same in every run, such as the level of a friction or an offset.

A model that fits one run exactly may drift away in the next. With tolerances the loss is a mean over models: the one
that is trained, and those with one of the parameters a deviation more or less.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array

from acausal.errors import TrainingError, nearest


class Tolerances(eqx.Module):
    """By how much parameters differ from run to run.

    Attributes:
        names: the parameters.
        shifts: of each model from the one that is trained, shape (number of models, number of parameters).
    """

    names: tuple[str, ...] = eqx.field(static=True)
    shifts: Array

    def mean(self, loss: Callable[[dict[str, Any]], Array], params: dict[str, Any]) -> Array:
        """The mean loss of the models with the parameters about given ones."""
        if not self.names:
            return loss(params)

        def shifted(shift: Array) -> Array:
            return loss({**params, **{n: params[n] + shift[i] for i, n in enumerate(self.names)}})

        return jnp.mean(jax.vmap(shifted)(self.shifts), axis=0)


def tolerances(given: Mapping[str, float] | None, params: Mapping[str, Any]) -> Tolerances:
    """Check a user's deviations, in the units of the parameters.

    Raises:
        TrainingError: for a name that is no numeric parameter, or a deviation that is not positive.
    """
    chosen = dict(given or {})
    numbers = [n for n, leaf in params.items() if not callable(leaf)]
    for name, deviation in chosen.items():
        if name not in numbers:
            raise TrainingError(f"tolerances: no parameter '{name}': {nearest(name, numbers)}")
        if np.ndim(params[name]) or not (np.isfinite(deviation) and deviation > 0):
            raise TrainingError(
                f"The tolerance of '{name}' is {deviation}; give a positive deviation of a number."
            )
    each = np.diag([float(d) for d in chosen.values()])
    alone = np.zeros((1, len(chosen)))
    return Tolerances(tuple(chosen), jnp.asarray(np.concatenate([alone, each, -each])))
