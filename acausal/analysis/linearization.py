"""Linearization of a model: its modes and frequency response."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import jax
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Complex, Float, Inexact

from acausal._jax import check_time, is_real
from acausal.by_name import names_in
from acausal.errors import DataError, need_compiled, shown

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

    A: Float[Array, "n_states n_states"]
    B: Float[Array, "n_states n_inputs"]
    C: Float[Array, "n_outputs n_states"]
    D: Float[Array, "n_outputs n_inputs"]
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    x: Float[Array, " n_states"]
    u: Float[Array, " n_inputs"]

    def __iter__(self) -> Iterator[Float[Array, "rows columns"]]:
        """The four matrices, so that ``A, B, C, D = linearize(...)`` works."""
        return iter((self.A, self.B, self.C, self.D))

    def eigenvalues(self) -> Inexact[np.ndarray, " n_states"]:
        """Eigenvalues of A (the poles), in 1/s, slowest first."""
        values = np.linalg.eigvals(np.asarray(self.A))
        return values[np.lexsort((np.imag(values), np.abs(values)))]

    def damping(self) -> Float[np.ndarray, " n_states"]:
        """Damping ratio of every eigenvalue, ``-Re / |.|``; 1 for an integrator."""
        values = self.eigenvalues()
        size = np.abs(values)
        return np.divide(-np.real(values), size, out=np.ones_like(size), where=size > 0)

    def frequency_response(
        self, omega: Float[ArrayLike, " n"]
    ) -> Complex[np.ndarray, "n n_outputs n_inputs"]:
        """``C (jw - A)^-1 B + D`` at angular frequencies [rad/s], shape (len(omega), p, m).

        Raises:
            DataError: for what is not frequencies, or one at which the model has an undamped pole.
        """
        if (
            not is_real(omega)
            or np.ndim(omega) > 1
            or not np.size(omega)
            or not np.isfinite(omega).all()
        ):
            raise DataError(f"omega={shown(omega)} are not frequencies; give numbers, in rad/s.")
        A, B, C, D = (np.asarray(m) for m in (self.A, self.B, self.C, self.D))
        identity = np.eye(len(A))

        def response(w: float) -> Complex[np.ndarray, "n_outputs n_inputs"]:
            try:
                return C @ np.linalg.solve(1j * w * identity - A, B) + D
            except np.linalg.LinAlgError:
                raise DataError(
                    f"omega={w:g} rad/s is an undamped pole of the model, where there is no response; leave it out."
                ) from None

        return np.stack([response(w) for w in np.atleast_1d(omega)])

    def __repr__(self) -> str:
        shape = f"{len(self.states)} states, {len(self.inputs)} inputs, {len(self.outputs)} outputs"
        modes = ", ".join(f"{v:.4g}" for v in self.eigenvalues()[:8])
        return f"Linearization({shape}; eigenvalues {modes})"


def linearize(
    system: System,
    x: Mapping[str, ArrayLike] | Float[ArrayLike, " n_states"] | None = None,
    u: Mapping[str, ArrayLike] | Float[ArrayLike, " n_inputs"] | None = None,
    *,
    outputs: str | Sequence[str] = (),
    params: Mapping[str, Any] | None = None,
    t: float = 0.0,
) -> Linearization:
    """Linearize a model at a point.

    Arguments:
        system: a compiled model.
        x: states by name (the rest from the model's starts) or all as an array; by default the model's initial state.
        u: inputs by name (the rest zero) or all as an array; by default zero.
        outputs: variables to take as outputs. params: parameters, by default the model's own. t: time [s].

    Raises:
        DataError: if ``x`` or ``u`` do not fit the model.
        ModelError: for an output that the model does not have, and for a model that is not compiled.
    """
    need_compiled(system, "linearize")
    outputs = names_in(outputs, "outputs")
    check_time(t)
    packed = system.pack(params)
    point = system.input_values(u)
    state = system.initial_state(packed, x, point, t)

    at = system.values(t, state, point, packed)

    def rates_and_outputs(x: Array, u: Array) -> tuple[Array, Array]:
        values = at._replace(x=x, u=u)
        observed = system.read(outputs, values) if outputs else jnp.zeros(0)
        return system.rates(values), observed

    (A, B), (C, D) = jax.jacfwd(rates_and_outputs, argnums=(0, 1))(at.x, at.u)
    return Linearization(A, B, C, D, system.states, system.inputs, outputs, at.x, at.u)
