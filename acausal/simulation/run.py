"""One run of a model, whatever the steps: where it starts, what drives it, and how fast its modes are there."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array
from jax.typing import ArrayLike

from acausal._jax import traced
from acausal.errors import SimulationError
from acausal.simulation import inputs

if TYPE_CHECKING:
    from acausal.system import System

AHEAD = np.geomspace(1e-6, 1.0, 7)
"""Where to look for a breakdown, as fractions of the time ahead."""

RUN_AWAY = 1e30
"""States beyond this have run away."""

EIGENVALUES = 300
"""Models with more states are not examined: dense Jacobians and implicit steps would not pay."""


class Run(NamedTuple):
    """What is simulated.

    Attributes:
        system: the model. ``packed``: its parameters.
        x0: the initial state, shape (number of states,).
        drive: its inputs.
        start: time in seconds. ``end``: likewise.
    """

    system: System
    packed: Any
    x0: Array
    drive: tuple[inputs.Drive, ...]
    start: float
    end: float

    def check_start(self) -> None:
        """Refuse an initial state that is not finite."""
        if traced(self.x0):
            return
        bad = np.flatnonzero(~np.isfinite(np.asarray(self.x0)))
        if len(bad):
            name = self.system.states[int(bad[0])]
            raise SimulationError(f"The initial value of '{name}' is {float(self.x0[bad[0]])}.")

    def modes(self) -> Any:
        """Eigenvalues of the Jacobian at the start, in 1/s; none where they are not to be had.

        They are not while JAX traces, nor for models with more than `EIGENVALUES` states.
        """
        if traced(self.packed, self.x0, self.drive) or not 0 < len(self.x0) <= EIGENVALUES:
            return np.zeros(0)
        u0 = inputs.evaluate(self.drive, self.start)
        jacobian = np.asarray(_jacobian(self.system, self.packed, self.start, self.x0, u0))
        return np.linalg.eigvals(jacobian) if np.isfinite(jacobian).all() else np.zeros(0)

    def explain(self, t: float, x: np.ndarray, ahead: float) -> str:
        """Which equation has no finite value at a state, or within some seconds along its derivative.

        Arguments:
            t: time [s]. x: a state, shape (number of states,). ahead: how far to look [s].

        Returns:
            A sentence; an empty text where nothing is found, or the state itself ran away.
        """
        if not (np.abs(x) < RUN_AWAY).all():
            return ""
        system = self.system
        slope = jnp.zeros_like(x)
        for h in (0.0, *(ahead * AHEAD)):
            point = t + h, x + h * slope, inputs.evaluate(self.drive, t + h), self.packed
            reason = system.explain_nonfinite(system.values(*point))
            if reason is not None:
                return f" There {reason}"
            if h == 0.0:
                slope = system.vector_field(*point)
        return ""


@eqx.filter_jit
def _jacobian(system: System, packed: Any, t: ArrayLike, x: Array, u: Array) -> Array:
    return jax.jacfwd(lambda x: system.vector_field(t, x, u, packed))(x)
