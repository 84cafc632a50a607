"""Solvers by name, and the choice between explicit and implicit ones."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import diffrax as dfx
import equinox as eqx
import numpy as np
from jax.typing import DTypeLike

from acausal.errors import SimulationError, nearest, shown
from acausal.simulation.stages import StageNewton, stage_newton


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

STAGE_TOLERANCE = {"float64": 1e-9, "float32": 1e-5}
"""Tolerance of the state in the equations of implicit fixed steps, relative and absolute, by precision."""

STAGE_STEPS = 100
"""Newton steps allowed in each implicit fixed step: there is no shorter step to try instead."""


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
    "implicit_euler": lambda: dfx.ImplicitEuler(root_finder=stage_newton()),
    "kvaerno3": lambda: dfx.Kvaerno3(root_finder=stage_newton()),
    "kvaerno4": lambda: dfx.Kvaerno4(root_finder=stage_newton()),
    "kvaerno5": lambda: dfx.Kvaerno5(root_finder=stage_newton()),
    "bdf": BDF,
}
"""Solvers by name; any other diffrax solver for ordinary differential equations can be passed itself."""


def solver_named(solver: str | Solver, *, fixed: bool = False, events: bool = False) -> Solver:
    """A solver from its name, or as it is.

    Arguments:
        solver: a name of `SOLVERS`, or ``"stiff"``: the best of them for stiff models with such steps.
        fixed: whether the steps are fixed.
        events: whether the model has events, which end the steps.

    Raises:
        SimulationError: for an unknown name, or anything that is not a solver of ordinary differential equations.
    """
    if isinstance(solver, str) and solver == "stiff":
        solver = "kvaerno3" if fixed else "kvaerno5" if events else "bdf"
    if isinstance(solver, str):
        if solver not in SOLVERS:
            known = (*SOLVERS, "auto", "stiff")
            raise SimulationError(f"No solver '{solver}': {nearest(solver, known)}")
        return SOLVERS[solver]()
    if isinstance(solver, type) and issubclass(solver, dfx.AbstractSolver | BDF):
        raise SimulationError(f"solver={solver.__name__} is a class: call it, {solver.__name__}().")
    if isinstance(solver, BDF):
        return solver
    if not isinstance(solver, dfx.AbstractSolver):
        raise SimulationError(
            f"solver={shown(solver)} is not a solver; choose one of {', '.join(SOLVERS)}, "
            "or a diffrax solver such as diffrax.Tsit5()."
        )
    if solver.term_structure is not dfx.AbstractTerm:
        name = type(solver).__name__
        raise SimulationError(
            f"{name} is not for ordinary differential equations as a whole; choose one of {', '.join(SOLVERS)}."
        )
    return solver


def for_adaptive_steps(solver: Solver) -> Solver:
    """The solver, if it can choose its steps.

    Raises:
        SimulationError: for a solver without an error estimate.
    """
    if isinstance(solver, BDF):
        return solver
    if isinstance(solver, RK4) or not isinstance(solver, dfx.AbstractAdaptiveSolver):
        name = type(solver).__name__
        raise SimulationError(
            f"{name} has no error estimate: give dt for fixed steps, or choose solver='tsit5'."
        )
    return solver


def for_fixed_steps(
    solver: Solver, dtype: DTypeLike = np.float64, *, direct: bool = False
) -> Scheme:
    """The solver for fixed steps: an implicit one gets its own tolerances, as there is no step-size controller.

    Arguments:
        solver: as the user chose it.
        dtype: precision of the steps.
        direct: whether derivatives in forward mode must work, too.

    Raises:
        SimulationError: for a solver that is not a Runge–Kutta scheme.
    """
    if isinstance(solver, EXPLICIT):
        return solver
    if not isinstance(solver, dfx.ImplicitEuler | dfx.AbstractRungeKutta):
        name = type(solver).__name__
        raise SimulationError(
            f"{name} is not a one-step scheme for fixed steps; choose one of {', '.join(SOLVERS)}."
        )
    tolerance = STAGE_TOLERANCE[np.dtype(dtype).name]
    newton = StageNewton(rtol=tolerance, atol=tolerance, diverges=np.inf)
    if direct and isinstance(solver, dfx.AbstractRungeKutta):
        # diffrax's own loop over the stages takes derivatives in reverse mode only
        solver = eqx.tree_at(lambda s: s.scan_kind, solver, "bounded", is_leaf=lambda a: a is None)
    return eqx.tree_at(
        lambda s: (s.root_finder, s.root_find_max_steps), solver, (newton, STAGE_STEPS)
    )
