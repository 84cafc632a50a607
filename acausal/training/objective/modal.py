"""Regularizers of a model's modes: the eigenvalues of its linearizations along the record.

Each linearizes the model about states of the record and penalises eigenvalues in the wrong place, so that a law cannot
gain accuracy at an instant by instability. The eigenvalues of frozen linearizations prove nothing about large motions,
but where they are bad, simulations drift or diverge.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal.codegen import Values
from acausal.errors import TrainingError, need_whole
from acausal.training.objective.regularizers import (
    Context,
    Trajectory,
    Weighted,
    chosen_names,
    named,
)

TINY = 1e-12
"""The smallest eigenvalue [1/s], or scalar product of eigenvectors, that is used as a divisor."""


class Modal(Weighted):
    """``weight · mean over points of Σ excess²``.

    Attributes:
        weight: of the penalty.
        points: of the record, evenly spread, at which the model is linearized.
        reach: how far out: 1 as in the record, 2 twice as far from its mean state.
        states: those whose modes count; ``None`` for all. Leave out one that only integrates an input, as a road's
            height does: its eigenvalue is 0 whatever is learned.
    """

    weight: float = 1.0
    points: int = eqx.field(static=True, default=20)
    reach: float = 1.0
    states: tuple[str, ...] | None = eqx.field(static=True, default=None, converter=chosen_names)

    def __check_init__(self) -> None:
        need_whole(self.points, f"{type(self).__name__}: points", TrainingError, 1)

    def excess(self, re: Float[Array, " n"], im: Float[Array, " n"]) -> Float[Array, " n"]:
        """How far eigenvalues ``re + j im`` [1/s] are outside of the allowed region; 0 within it."""
        raise NotImplementedError

    def __call__(self, params: Mapping[str, Any], context: Context) -> Float[Array, ""]:
        """The penalty."""
        assert context.trajectory is not None
        states = context.trajectory.system.states
        kept = np.array([states.index(n) for n in named("state", self.states, states)])
        A = jacobians(params, context.trajectory, self.points, self.reach)
        re, im = jax.vmap(eigenvalues)(A[:, kept][:, :, kept])
        return self.weight * jnp.mean(jnp.sum(self.excess(re, im) ** 2, axis=-1))


class Stability(Modal):
    """Modes should die out: real parts at most ``−margin``.

    Attributes:
        margin: in 1/s; the penalty grows with the square of what is missing, so ``weight`` is in s².
    """

    margin: float = 0.0

    def excess(self, re: Float[Array, " n"], im: Float[Array, " n"]) -> Float[Array, " n"]:
        """What is missing of the margin."""
        return jnp.maximum(re + self.margin, 0.0)


class DampingRatio(Modal):
    """Modes should not ring: damping ratios ``−Re λ/|λ|`` of at least ``ratio``.

    Attributes:
        ratio: between 0 and 1.
    """

    ratio: float = 0.1

    def excess(self, re: Float[Array, " n"], im: Float[Array, " n"]) -> Float[Array, " n"]:
        """What is missing of the ratio."""
        return jnp.maximum(self.ratio + re / _size(re, im), 0.0)


class FrequencyRange(Modal):
    """Modes should be neither slower than ``low`` nor faster than ``high``, by their ``|λ|``.

    Attributes:
        low, high: in rad/s.
    """

    low: float = 0.0
    high: float = float("inf")

    def excess(self, re: Float[Array, " n"], im: Float[Array, " n"]) -> Float[Array, " n"]:
        """How far a frequency is outside, relative to the bound."""
        size = _size(re, im)
        slow = 1 - size / self.low if self.low > 0 else 0.0
        return jnp.maximum(jnp.maximum(size / self.high - 1, slow), 0.0)


def jacobians(
    params: Mapping[str, Any], trajectory: Trajectory, points: int, reach: float
) -> Float[Array, "points n n"]:
    """``∂(dx/dt)/∂x`` at points of a trajectory; see `Modal` for the arguments."""
    rows = np.unique(np.linspace(0, len(trajectory.t) - 1, points).astype(int))
    t, x, u, d = jax.tree.map(
        lambda a: a[rows], (trajectory.t, trajectory.x, trajectory.u, trajectory.d)
    )
    centre = trajectory.x.mean(axis=0)
    system, packed = trajectory.system, trajectory.system.pack(params)

    def jacobian(t: Array, x: Array, u: Array, d: Array | None) -> Float[Array, "n n"]:
        return jax.jacfwd(lambda x: system.rates(Values(t, x, u, packed, d)))(x)

    return jax.vmap(jacobian)(t, centre + reach * (x - centre), u, d)


@jax.custom_jvp
def eigenvalues(A: Float[Array, "n n"]) -> tuple[Float[Array, " n"], Float[Array, " n"]]:
    """Real and imaginary parts of a real matrix's eigenvalues; only on a CPU.

    Derivatives are ``dλ = wᴴ dA v / wᴴ v`` with left and right eigenvectors (J. Magnus: On differentiating eigenvalues
    and eigenvectors, Econometric Theory 1, 1985). Where an eigenvalue is defective there are none: 0 is taken.
    """
    values, _, _ = _eig(A)
    return values.real, values.imag


@eigenvalues.defjvp
def _(
    primals: tuple[Float[Array, "n n"]], tangents: tuple[Float[Array, "n n"]]
) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    values, left, right = _eig(primals[0])
    product = jnp.sum(left.conj() * right, axis=0)
    defective = jnp.abs(product) < TINY
    moved = jnp.einsum("ki,kl,li->i", left.conj(), tangents[0], right)
    change = jnp.where(defective, 0.0, moved / jnp.where(defective, 1.0, product))
    return (values.real, values.imag), (change.real, change.imag)


def _eig(A: Float[Array, "n n"]) -> tuple[Array, Array, Array]:
    values, left, right = jax.lax.linalg.eig(
        A, compute_left_eigenvectors=True, compute_right_eigenvectors=True
    )
    return values, left, right


def _size(re: Array, im: Array) -> Array:
    return jnp.sqrt(re**2 + im**2 + TINY**2)
