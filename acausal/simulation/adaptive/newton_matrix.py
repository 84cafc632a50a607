"""The matrix of Newton's method, ``I - c J``: made, factorized, and solved with."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from acausal.simulation.adaptive.problem import Field

State = Float[Array, " n_states"]


class NewtonMatrix(eqx.Module):
    """A dense one."""

    def empty(self, x: State) -> Any:
        """Room for the factors."""
        n = len(x)
        return jnp.eye(n, dtype=x.dtype), jnp.arange(n, dtype=jnp.int32)

    def renewed(self, field: Field, t: Array, x: State, c: Array) -> Any:
        """The factors at a point."""
        jacobian = jax.jacfwd(lambda x: field(t, x))(x)
        return jax.scipy.linalg.lu_factor(jnp.eye(len(x), dtype=x.dtype) - c * jacobian)

    def solve(self, factors: Any, b: State) -> State:
        """``x`` with ``(I - c J) x = b``."""
        return jax.scipy.linalg.lu_solve(factors, b)

    def solve_transposed(self, factors: Any, b: State) -> State:
        """The same with the transposed matrix."""
        return jax.scipy.linalg.lu_solve(factors, b, trans=1)
