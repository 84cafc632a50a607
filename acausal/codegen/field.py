"""The derivatives of the states as a function of the states alone, with its algebraic loops closed or open."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal.codegen.interpreter import rates, rates_and_residuals, results
from acausal.codegen.program import Program
from acausal.codegen.values import Packed, Values


@dataclass(frozen=True, eq=False)
class Field:
    """``dx/dt`` as a function of ``x``, at a time and for inputs and parameters.

    Attributes:
        t: time [s]. u: inputs, shape (n_inputs,). packed: parameters.
        d: discrete variables, shape (n_discrete,), or None.
    """

    program: Program
    t: ArrayLike
    u: Array
    packed: Packed
    d: Array | None = None

    def __call__(self, x: Float[Array, " n"]) -> Float[Array, " n"]:
        """Derivatives of the states."""
        return rates(self.program, self.values(x))

    def loop_unknowns(self, loops: Sequence[int], x: Float[Array, " n"]) -> Float[Array, " m"]:
        """The unknowns of some loops, by their instructions' numbers, at the solution: one behind the other."""
        return jnp.concatenate(
            [jnp.atleast_1d(a) for a in results(self.program, self.values(x), loops)]
        )

    def with_open_loops(
        self, loops: Sequence[int], x: Float[Array, " n"], unknowns: Float[Array, " m"]
    ) -> Float[Array, " n_plus_m"]:
        """Derivatives of the states for given unknowns of some loops, and the residuals of the loops' equations.

        The residuals are in the order of the unknowns that they are matched to.
        """
        given: dict[int, list[Array]] = {}
        for i in loops:
            outputs, size = (getattr(self.program.instructions[i], a) for a in ("outputs", "size"))
            own, unknowns = unknowns[: outputs * size], unknowns[outputs * size :]
            given[i] = list(own.reshape((outputs, size) if size > 1 else (outputs,)))
        dx, residuals = rates_and_residuals(self.program, self.values(x), given)
        return jnp.concatenate([dx, *map(jnp.atleast_1d, residuals)])

    def values(self, x: Float[Array, " n"]) -> Values:
        """The values at some states."""
        return Values(self.t, x, self.u, self.packed, self.d)
