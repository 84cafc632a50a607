"""Solvers by name, and the choice between explicit and implicit ones."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import diffrax as dfx
import equinox as eqx
import numpy as np

from acausal.errors import DataError, nearest, shown


class BDF(eqx.Module):
    """Backward differentiation formulas of order 1 to 5, for stiff models, in adaptive steps."""


Scheme = dfx.AbstractSolver[Any]
"""A diffrax solver."""

Solver = Scheme | BDF
"""A diffrax solver, or one of our own."""

EXPLICIT = (dfx.AbstractERK, dfx.Euler)
"""Explicit Runge–Kutta schemes; diffrax has no tableau of Euler's method."""

STABILITY_LIMIT = 2.0
"""About where the stability regions of all explicit schemes end, in units of 1/step."""


class RK4(dfx.AbstractERK):
    """The classical Runge–Kutta method of order 4, for fixed steps (it has no error estimate)."""

    tableau: ClassVar[dfx.ButcherTableau | dfx.MultiButcherTableau] = dfx.ButcherTableau(
        a_lower=(np.array([0.5]), np.array([0.0, 0.5]), np.array([0.0, 0.0, 1.0])),
        b_sol=np.array([1 / 6, 1 / 3, 1 / 3, 1 / 6]),
        b_error=np.zeros(4),
        c=np.array([0.5, 0.5, 1.0]),
    )
    interpolation_cls: ClassVar[Callable[..., dfx.AbstractLocalInterpolation]] = (
        dfx.LocalLinearInterpolation
    )

    def order(self, terms: object) -> int:
        """The order of convergence."""
        return 4


SOLVERS: dict[str, Callable[[], Solver]] = {
    "euler": dfx.Euler,
    "heun": dfx.Heun,
    "midpoint": dfx.Midpoint,
    "ralston": dfx.Ralston,
    "bosh3": dfx.Bosh3,
    "rk4": RK4,
    "tsit5": dfx.Tsit5,
    "dopri5": dfx.Dopri5,
    "dopri8": dfx.Dopri8,
    "implicit_euler": dfx.ImplicitEuler,
    "kvaerno3": dfx.Kvaerno3,
    "kvaerno4": dfx.Kvaerno4,
    "kvaerno5": dfx.Kvaerno5,
    "bdf": BDF,
}
"""Solvers by name; any other diffrax solver for ordinary differential equations can be passed itself.

Of a Runge–Kutta scheme the coefficients are used: how equations of implicit stages are solved is decided here.
"""


def solver_named(solver: str | Solver, *, fixed: bool = False, events: bool = False) -> Solver:
    """A solver from its name, or as it is.

    Arguments:
        solver: a name of `SOLVERS`, or ``"stiff"``: the best of them for stiff models with such steps.
        fixed: whether the steps are fixed.
        events: whether the model has events, which end the steps.

    Raises:
        DataError: for an unknown name, or anything that is not a solver of ordinary differential equations.
    """
    if isinstance(solver, str) and solver == "stiff":
        solver = "kvaerno3" if fixed else "kvaerno5" if events else "bdf"
    if isinstance(solver, str):
        if solver not in SOLVERS:
            known = (*SOLVERS, "auto", "stiff")
            raise DataError(f"No solver '{solver}': {nearest(solver, known)}")
        return SOLVERS[solver]()
    if isinstance(solver, type) and issubclass(solver, dfx.AbstractSolver | BDF):
        raise DataError(f"solver={solver.__name__} is a class: call it, {solver.__name__}().")
    if isinstance(solver, BDF):
        return solver
    if not isinstance(solver, dfx.AbstractSolver):
        raise DataError(
            f"solver={shown(solver)} is not a solver; choose one of {', '.join(SOLVERS)}, "
            "or a diffrax solver such as diffrax.Tsit5()."
        )
    if solver.term_structure is not dfx.AbstractTerm:
        name = type(solver).__name__
        raise DataError(
            f"{name} is not for ordinary differential equations as a whole; choose one of {', '.join(SOLVERS)}."
        )
    return solver


def is_bdf(solver: object) -> bool:
    """Whether a solver that is asked for goes on from steps before, so that it knows no events."""
    return isinstance(solver, BDF) or (isinstance(solver, str) and solver == "bdf")


def for_adaptive_steps(solver: Solver) -> Solver:
    """The solver, if it can choose its steps.

    Raises:
        DataError: for a solver without an error estimate.
    """
    if isinstance(solver, BDF):
        return solver
    if isinstance(solver, RK4) or not isinstance(solver, dfx.AbstractAdaptiveSolver):
        name = type(solver).__name__
        raise DataError(
            f"{name} has no error estimate: give dt for fixed steps, or choose solver='tsit5'."
        )
    return solver


def for_fixed_steps(solver: Solver) -> Scheme:
    """The solver, if it can make fixed steps.

    Raises:
        DataError: for a solver that is not a Runge–Kutta scheme.
    """
    if isinstance(solver, dfx.Euler | dfx.ImplicitEuler | dfx.AbstractRungeKutta):
        return solver
    name = type(solver).__name__
    raise DataError(
        f"{name} is not a one-step scheme for fixed steps; choose one of {', '.join(SOLVERS)}."
    )
