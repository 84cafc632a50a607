"""One simulation of a model, whatever its steps: where it starts, its inputs, and its modes at the start."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, cast

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Float
from numpy.typing import NDArray

from acausal._jax import traced
from acausal.codegen import Values
from acausal.errors import SimulationError
from acausal.simulation.inputs import TimeFunction, evaluate

if TYPE_CHECKING:
    from acausal.system import System

AHEAD = np.geomspace(1e-6, 1.0, 7)
"""Where to look for a value that is not finite, as fractions of the time ahead."""

DIVERGED = 1e30
"""States larger than this have diverged."""

EIGENVALUES = 300
"""Models with more states are not examined: dense Jacobians and implicit steps would not pay."""


class Run(NamedTuple):
    """The task of one simulation.

    Attributes:
        system: the model.
        start: the values of the model at the start; its time is a number.
        inputs: the model's inputs as functions of time.
        end: the last time, in seconds.
    """

    system: System
    start: Values
    inputs: tuple[TimeFunction, ...]
    end: float

    @property
    def begin(self) -> float:
        """The first time, in seconds."""
        return cast(float, self.start.t)

    def at(self, t: ArrayLike, x: Float[Array | np.ndarray, " n_states"]) -> Values:
        """The values of the model at a time and a state."""
        return self.start._replace(t=t, x=jnp.asarray(x), u=evaluate(self.inputs, t))

    def check_start(self) -> None:
        """Refuse an initial state that is not finite."""
        x = self.start.x
        if traced(x):
            return
        bad = np.flatnonzero(~np.isfinite(np.asarray(x)))
        if len(bad):
            name = self.system.states[int(bad[0])]
            raise SimulationError(f"The initial value of '{name}' is {float(x[bad[0]])}.")

    def modes(self) -> NDArray[np.complex128]:
        """Eigenvalues of the Jacobian at the start, shape (n,), in 1/s.

        There are none while JAX traces, nor for models with more than `EIGENVALUES` states.
        """
        nothing = np.zeros(0, complex)
        if traced(self.start, self.inputs) or not 0 < len(self.start.x) <= EIGENVALUES:
            return nothing
        jacobian = np.asarray(_jacobian(self.system, self.start))
        if not np.isfinite(jacobian).all():
            return nothing
        return np.linalg.eigvals(jacobian).astype(complex)

    def explain(self, at: Values, ahead: float) -> str:
        """Find the equation without a finite value at a point, or within some seconds along its derivative.

        Arguments:
            at: the point, from `at`.
            ahead: how far to look [s].

        Returns:
            A sentence; an empty text where nothing is found, or where the state itself has diverged.
        """
        if not (np.abs(at.x) < DIVERGED).all():
            return ""
        system, derivative = self.system, jnp.zeros_like(at.x)
        for h in (0.0, *(ahead * AHEAD)):
            values = self.at(at.t + h, at.x + h * derivative)
            reason = system.explain_nonfinite(values)
            if reason is not None:
                return f" There {reason}"
            if h == 0.0:
                derivative = system.rates(values)
        return ""


@eqx.filter_jit
def _jacobian(system: System, at: Values) -> Float[Array, "n_states n_states"]:
    return jax.jacfwd(lambda x: system.rates(at._replace(x=x)))(at.x)
