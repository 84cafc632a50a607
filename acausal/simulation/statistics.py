"""What a simulation has cost, and which method made its steps."""

from __future__ import annotations

import equinox as eqx
from jaxtyping import Array, Float, Int


class Statistics(eqx.Module):
    """What a simulation has cost; numbers are arrays, and have an axis for each `jax.vmap`.

    Attributes:
        solver: the method: "Tsit5", or "Tsit5, then BDF" where a model may turn out to be stiff on its way.
        steps: those that count.
        rejected: those that were repeated with a shorter length.
        rates: evaluations of the right-hand side, as far as they are counted (a diffrax solver's own are not).
        factorizations: of the matrix of implicit steps, each with a Jacobian.
        corrections: Newton steps.
        stiff_from: the time from which on stability would have limited explicit steps, in seconds; infinite where it
            has not, NaN where no such thing was asked.
    """

    solver: str = eqx.field(static=True)
    steps: Int[Array, ""]
    rejected: Int[Array, ""]
    rates: Int[Array, ""]
    factorizations: Int[Array, ""]
    corrections: Int[Array, ""]
    stiff_from: Float[Array, ""]

    def __str__(self) -> str:
        """One line."""
        parts = [f"{self.solver}: {self.steps} steps, {self.rejected} rejected"]
        parts += [f"{self.rates} right-hand sides"] if self.rates else []
        parts += [f"{self.factorizations} factorizations"] if self.factorizations else []
        return ", ".join(parts)
