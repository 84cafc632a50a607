"""Steps far outside the region of stability of an explicit solver: states may stay finite, derivatives are garbage."""

from __future__ import annotations

from typing import TYPE_CHECKING

import jax
import numpy as np
from jaxtyping import Array, Float
from numpy.typing import NDArray

from acausal._jax import compiled
from acausal.codegen import Values

if TYPE_CHECKING:
    from acausal.system import System

POINTS = 16
"""Points of a trajectory at which modes are computed."""

LARGEST = 50
"""Models with more states are not examined: eigenvalues would take too long."""

FAR = 10.0
"""Steps times the rate of a damped mode that are far outside the region of stability of every explicit solver."""

BLOCK = 64
"""Rows of each of `POINTS` blocks in which a trajectory's steps are compared, so that long ones cost no more."""

ROUGH = 0.3
"""Part of its steps by which a state's steps change, where these may be too long: it is resolved by few of them."""


def long_steps(system: System, values: Values, h: float, limit: float = FAR) -> str | None:
    """A sentence on steps of an explicit solver that are too long somewhere along a trajectory, or None.

    Its n points are not traced; ``limit`` is steps times the rate of a damped mode that are too long.
    """
    damping, t = fastest_mode(system, values)
    if damping * h <= limit:
        return None
    size, what = "far too", "even where states look right, derivatives are wrong"
    if limit < FAR:
        size, what = "too", "states that stay within bounds are wrong"
    return (
        f"Steps of {h:g} s are {size} long for the model's fastest mode, {damping:.3g} 1/s at t = {t:g} s: {what}. "
        f"Choose dt below {1 / damping:.1g} s, an implicit solver, or leave dt out."
    )


def is_rough(x: Float[np.ndarray, "n n_states"]) -> bool:
    """Whether a state's steps change by much of their size, on average."""
    if len(x) < POINTS:
        return False
    length = min(BLOCK, len(x))
    first = np.unique(np.linspace(0, len(x) - length, POINTS).astype(int))
    steps = np.diff(x[first[:, None] + np.arange(length)], axis=1)
    changes = np.abs(np.diff(steps, axis=1)).mean(axis=(0, 1))
    return bool((changes > ROUGH * np.abs(steps).mean(axis=(0, 1))).any())


def fastest_mode(system: System, values: Values) -> tuple[float, float]:
    """The rate of the fastest damped mode along a trajectory [1/s], and when [s]; 0 for what is not examined.

    Discrete variables are the same at all of its n points, none of which is traced.
    """
    if not 0 < len(system.states) <= LARGEST:
        return 0.0, 0.0
    rows = np.unique(np.linspace(0, len(values.x) - 1, POINTS).astype(int))
    t = np.asarray(values.t)[rows]
    points = values._replace(t=t, x=np.asarray(values.x)[rows], u=np.asarray(values.u)[rows])
    rates = modes(system, points)
    if rates is None:
        return 0.0, 0.0
    damping = np.where(-rates.real >= np.abs(rates.imag), -rates.real, 0.0).max(axis=1)
    worst = int(np.argmax(damping))
    return float(damping[worst]), float(t[worst])


def modes(system: System, points: Values) -> NDArray[np.complex128] | None:
    """Eigenvalues of the model linearized at n points, (n, n_states) [1/s]; None where it has no finite derivatives."""
    jacobians = np.asarray(_jacobians(system, points))
    return np.linalg.eigvals(jacobians).astype(complex) if np.isfinite(jacobians).all() else None


@compiled
def _jacobians(system: System, points: Values) -> Float[Array, "n n_states n_states"]:
    def jacobian(at: Values) -> Float[Array, "n_states n_states"]:
        return jax.jacfwd(lambda x: system.rates(at._replace(x=x)))(at.x)

    return jax.vmap(jacobian, (Values(0, 0, 0, None),))(points)  # pyright: ignore[reportArgumentType]
