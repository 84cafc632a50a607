"""Parameter spread: parameters that differ from run to run, such as the level of a friction or an offset.

A model that fits one run exactly may drift away in the next. With a parameter spread the loss is a mean over models:
the one that is trained, and those with one of the parameters a deviation higher or lower.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal._jax import is_number
from acausal.errors import TrainingError, known_name, shown


class ParameterSpread(eqx.Module):
    """How much parameters differ from run to run.

    Attributes:
        names: the parameters.
        shifts: of each model from the one that is trained.
        limits: the bounds that each parameter declares; no model leaves them.
    """

    names: tuple[str, ...] = eqx.field(static=True)
    shifts: Float[Array, "n_models n_parameters"]
    limits: tuple[tuple[float, float], ...] = eqx.field(static=True)

    def over_models(
        self, function: Callable[[dict[str, Any]], Float[Array, " ..."]], params: dict[str, Any]
    ) -> Float[Array, "n_models ..."]:
        """A function evaluated for every model; their parameters lie about the given ones."""
        if not self.names:
            return function(params)[None]

        def shifted(shift: Float[Array, " n_parameters"]) -> Float[Array, " ..."]:
            rows = zip(self.names, shift, self.limits, strict=True)
            return function(
                {**params, **{n: jnp.clip(params[n] + s, *ends) for n, s, ends in rows}}
            )

        return jax.vmap(shifted)(self.shifts)

    def mean(
        self, loss: Callable[[dict[str, Any]], Float[Array, " ..."]], params: dict[str, Any]
    ) -> Float[Array, " ..."]:
        """The mean loss of these models."""
        return jnp.mean(self.over_models(loss, params), axis=0)


def parameter_spread(
    given: Mapping[str, float] | None,
    params: Mapping[str, Any],
    declared: Callable[[str], tuple[float, float]],
) -> ParameterSpread:
    """Check a user's deviations, in the units of the parameters, against the bounds that these declare.

    Raises:
        TrainingError: for a name that is not a numeric parameter, or a deviation that is not positive or leads out of
            the parameter's bounds.
    """
    chosen = {str(name): deviation for name, deviation in (given or {}).items()}
    numbers = [n for n, leaf in params.items() if not callable(leaf)]
    for name, deviation in chosen.items():
        known_name(name, numbers, "parameter_spread: no parameter", TrainingError)
        if np.ndim(params[name]) or not (is_number(deviation) and deviation > 0):
            raise TrainingError(
                f"The spread of '{name}' is {shown(deviation)}; give a positive deviation of a number."
            )
        (low, high), value = declared(name), float(params[name])
        if not low <= value - deviation < value + deviation <= high:
            raise TrainingError(
                f"The spread of '{name}' is {deviation:g} about {value:g}, which leaves its bounds, {low:g} to "
                f"{high:g}: give a smaller one."
            )
    deviations = np.diag([float(d) for d in chosen.values()])
    alone = np.zeros((1, len(chosen)))
    return ParameterSpread(
        tuple(chosen),
        jnp.asarray(np.concatenate([alone, deviations, -deviations])),
        tuple(map(declared, chosen)),
    )
