"""Steps of diagonally implicit Runge–Kutta schemes."""

from __future__ import annotations

from typing import Any

import diffrax as dfx
import jax.numpy as jnp
from jaxtyping import Array

from acausal.simulation.newton import Fields, Rates
from acausal.simulation.stages import ImplicitScheme, stages
from acausal.simulation.steps.one_step import Made, OneStep, State
from acausal.simulation.steps.problem import Counts, RightHandSide


class Diagonal(OneStep):
    """A diagonally implicit Runge–Kutta scheme, each stage of which is solved by itself.

    Attributes:
        scheme: how stages are found.
    """

    scheme: ImplicitScheme

    def make(self, field: RightHandSide, t: Array, h: Array, x: State, first: State) -> Made:
        """One step."""
        tableau = self.scheme.tableau
        found = stages(self.scheme, Fields(_within, (field, t, h)), h, x, first)
        k = found.increments
        end = x + jnp.asarray(tableau.weights, x.dtype) @ k
        error = jnp.asarray(tableau.errors, x.dtype) @ k if tableau.errors else jnp.zeros_like(x)
        none = h == 0  # as events leave behind
        last = jnp.where(none, first, k[-1] / jnp.where(none, 1.0, h)).astype(x.dtype)
        counts = Counts.of(
            rates=found.corrections, jacobians=found.jacobians, corrections=found.corrections
        )
        dense = {"y0": x, "y1": end}
        if self.solver.interpolation_cls is not dfx.LocalLinearInterpolation:
            dense["k"] = k
        return Made(end, error, dense, last, found.done, jnp.zeros_like(h), counts)


def _within(fraction: Any, args: tuple[RightHandSide, Array, Array]) -> Rates:
    field, t, h = args
    return field.at(t + fraction * h)
