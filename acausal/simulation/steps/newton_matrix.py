"""The matrix of Newton's method in implicit steps, ``I - c J``: made at a point, factorized, and solved with."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from acausal.codegen import StateJacobian
from acausal.simulation.steps.problem import RightHandSide

State = Float[Array, " n_states"]


class NewtonMatrix(eqx.Module):
    """How the matrix is made and factorized; by the pattern of the model's Jacobian.

    Attributes:
        jacobian: of the model.
    """

    jacobian: StateJacobian = eqx.field(static=True)

    def empty(self, x: State) -> Any:
        """Factors of the identity, in place of those that are not known yet."""
        return self._factorized(jnp.zeros(self.jacobian.n_entries, x.dtype), jnp.zeros((), x.dtype))

    def renewed(self, field: RightHandSide, t: Array, x: State, c: Array) -> Any:
        """The factors at a point."""
        return self._factorized(self.jacobian.entries(field.at(t), x), c)

    def solve(self, factors: Any, b: State) -> State:
        """``x`` with ``(I - c J) x = b``."""
        return self.jacobian.iteration_matrix.solve(factors, b)

    def solve_transposed(self, factors: Any, b: State) -> State:
        """The same with the transposed matrix."""
        return self.jacobian.iteration_matrix.solve_transposed(factors, b)

    def _factorized(self, entries: Array, c: Array) -> Any:
        return self.jacobian.iteration_matrix.factorize(entries, c)
