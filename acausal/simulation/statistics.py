"""What a simulation has cost, and which method made its steps."""

from __future__ import annotations

import equinox as eqx
import numpy as np
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
        edges: steps that end where a source or table is known to jump or bend.
        by_wave: steps that are as long as a sine of time allows. by_span: as ``max_step`` allows.
        looks: steps that were repeated for what a look at two more points has shown.
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
    edges: Int[Array, ""]
    by_wave: Int[Array, ""]
    by_span: Int[Array, ""]
    looks: Int[Array, ""]

    def __str__(self) -> str:
        """One line."""
        parts = [f"{self.solver}: {self.steps} steps, {self.rejected} rejected"]
        parts += [f"{self.rates} right-hand sides"] if self.rates else []
        parts += [f"{self.factorizations} factorizations"] if self.factorizations else []
        bounds = ("end at edges", self.edges), ("by a sine", self.by_wave)
        bounds = (
            *bounds,
            ("by max_step", self.by_span),
            ("repeated for a look inside", self.looks),
        )
        parts += [f"{n} {what}" for what, n in bounds if np.any(np.asarray(n))]
        return ", ".join(parts)
