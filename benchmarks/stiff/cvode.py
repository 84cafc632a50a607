"""SUNDIALS' CVODE, by scikit-sundae, on the compiled right-hand side of a model."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import scipy.sparse as sp
from jaxtyping import Float

import acausal as ac

Function = Callable[[float, Any], Any]


def right_hand_side(system: ac.System, inputs: Mapping[str, Any]) -> Function:
    """A model's right-hand side with its default parameters as one compiled program: (time, state) -> derivative."""
    packed = system.pack()

    def value(given: Any, t: Any) -> Any:
        return given(t) if callable(given) else jnp.asarray(given, float)

    def rates(t: Any, x: Any) -> Any:
        u = jnp.stack([value(inputs[name], t) for name in system.inputs]) if inputs else None
        return system.vector_field(t, x, u, packed)

    return jax.jit(rates)


def pattern(system: ac.System) -> sp.csc_matrix:
    """Where the Jacobian of a model's right-hand side has entries."""
    jacobian = system.state_jacobian
    ones = np.ones(jacobian.n_entries)
    return sp.csc_matrix((ones, (jacobian.rows, jacobian.columns)), shape=(jacobian.n,) * 2)


class Cvode:
    """The backward differentiation formulas of CVODE for a right-hand side.

    Arguments:
        function: the right-hand side, compiled.
        sparsity: of its Jacobian, for SuperLU; ``None``: a dense matrix.
        options: of `sksundae.cvode.CVODE`.
    """

    def __init__(
        self, function: Function, sparsity: sp.csc_matrix | None = None, **options: Any
    ) -> None:
        import sksundae  # of the extra `bench`; other parts of the benchmark do without

        def rhs(t: float, x: Any, rates: Any) -> None:
            rates[:] = function(t, x)

        if sparsity is not None:
            options |= {"linsolver": "sparse", "sparsity": sparsity}
        self.solver = sksundae.cvode.CVODE(rhs, method="BDF", max_num_steps=10_000_000, **options)

    def __call__(
        self, ts: Float[np.ndarray, " n_ts"], x0: Float[np.ndarray, " n"]
    ) -> tuple[Float[np.ndarray, "n_ts n"], int]:
        """The states at the times, and how often the right-hand side was evaluated."""
        found = self.solver.solve(ts, x0)
        if not found.success:
            raise RuntimeError(f"CVODE failed: {found.message}")
        return found.y, int(found.nfev)
