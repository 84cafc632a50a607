"""Analyse: linearize a model and look at its modes and frequency response."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import jax
import jax.numpy as jnp
import numpy as np

from acausal.errors import need_compiled

if TYPE_CHECKING:
    from acausal.system import System


@dataclass(frozen=True, eq=False)
class Linearization:
    """A model near a point: ``d(dx)/dt = A dx + B du``, ``dy = C dx + D du``.

    Attributes:
        A, B, C, D: arrays of shapes (n, n), (n, m), (p, n), (p, m).
        states, inputs, outputs: names of rows and columns.
        x, u: the point, shapes (n,) and (m,).
    """

    A: Any
    B: Any
    C: Any
    D: Any
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    x: Any
    u: Any

    def __iter__(self) -> Iterator[Any]:
        """The four matrices, so that ``A, B, C, D = linearize(...)`` works."""
        return iter((self.A, self.B, self.C, self.D))

    def eigenvalues(self) -> np.ndarray:
        """Eigenvalues of A (the poles), in 1/s, slowest first."""
        values = np.linalg.eigvals(np.asarray(self.A))
        return values[np.lexsort((values.imag, np.abs(values)))]

    def damping(self) -> np.ndarray:
        """Damping ratio of every eigenvalue, ``-Re / |.|``; 1 for an integrator."""
        values: Any = self.eigenvalues()
        size = np.abs(values)
        return np.divide(-values.real, size, out=np.ones_like(size), where=size > 0)

    def frequency_response(self, omega: Any) -> np.ndarray:
        """``C (jw - A)^-1 B + D`` at angular frequencies [rad/s], shape (len(omega), p, m)."""
        A, B, C, D = (np.asarray(m) for m in (self.A, self.B, self.C, self.D))
        identity = np.eye(len(A))
        return np.stack(
            [C @ np.linalg.solve(1j * w * identity - A, B) + D for w in np.atleast_1d(omega)]
        )

    def __repr__(self) -> str:
        shape = f"{len(self.states)} states, {len(self.inputs)} inputs, {len(self.outputs)} outputs"
        modes = ", ".join(f"{v:.4g}" for v in self.eigenvalues()[:8])
        return f"Linearization({shape}; eigenvalues {modes})"


def linearize(
    system: System,
    x: Mapping[str, Any] | Any = None,
    u: Mapping[str, Any] | Any = None,
    *,
    outputs: Sequence[str] = (),
    params: Mapping[str, Any] | None = None,
    t: float = 0.0,
) -> Linearization:
    """Linearize a model at a point.

    Arguments:
        x: states by name (the rest from the model's starts) or all as an array; the model's initial state by default.
        u: inputs by name (the rest zero) or all as an array; zero by default.
        outputs: variables to take as outputs. params: parameters, the model's own by default. t: time [s].

    Raises:
        DataError: if ``x`` or ``u`` do not fit the model.
        ModelError: for an output that the model does not have, and for a model that is not compiled.
    """
    need_compiled(system, "linearize")
    packed = system.pack(params)
    point = system.input_values(u)
    state = system.initial_state(packed, x, point, t)

    def behaviour(state: Any, point: Any) -> tuple[Any, Any]:
        rates = system.vector_field(t, state, point, packed)
        seen = system.observe(tuple(outputs), t, state, point, packed) if outputs else jnp.zeros(0)
        return rates, seen

    (A, B), (C, D) = jax.jacfwd(behaviour, argnums=(0, 1))(state, point)
    return Linearization(A, B, C, D, system.states, system.inputs, tuple(outputs), state, point)
