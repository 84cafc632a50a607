"""The method of adaptive steps for a solver."""

from __future__ import annotations

from typing import TypeAlias

import diffrax as dfx
from jax.typing import DTypeLike

from acausal.codegen import StateJacobian
from acausal.simulation import solvers
from acausal.simulation.newton import (
    ADAPTIVE,
    FIXED,
    Patience,
    Tolerances,
    fixed_tolerances,
)
from acausal.simulation.stages import ImplicitScheme
from acausal.simulation.steps.bdf import Multistep
from acausal.simulation.steps.one_step import Foreign
from acausal.simulation.steps.problem import Integration
from acausal.simulation.steps.runge_kutta import Diagonal, Explicit, Paced
from acausal.simulation.tableau import Tableau, tableau_of

Method: TypeAlias = Explicit | Diagonal | Foreign | Multistep


def explicit() -> Explicit:
    """The method that is tried first."""
    return Explicit(dfx.Tsit5())


def stiff(problem: Integration) -> Method:
    """The method for stiff models; with events, which end all that a multistep method knows, a one-step method."""
    solver = solvers.solver_named("stiff", events=problem.events is not None)
    return method_of(solver, problem)


def method_of(solver: solvers.Solver, problem: Integration) -> Method:
    """The method by which a solver's steps are made.

    Raises:
        DataError: for a solver without an error estimate.
    """
    solver, jacobian = solvers.for_adaptive_steps(solver), problem.field.system.state_jacobian
    if isinstance(solver, solvers.BDF):
        return Multistep(jacobian, problem.field.bends)
    if isinstance(solver, dfx.AbstractRungeKutta | dfx.ImplicitEuler):
        return _one_step(solver, tableau_of(solver), jacobian, problem.tolerances, ADAPTIVE)
    return Foreign(solver)


def paced(scheme: solvers.Scheme, jacobian: StateJacobian, dtype: DTypeLike) -> Paced:
    """Steps of given length by a scheme."""
    tableau = tableau_of(scheme).without_estimate()
    return Paced(scheme, _one_step(scheme, tableau, jacobian, fixed_tolerances(dtype), FIXED))


def _one_step(
    solver: solvers.Scheme,
    tableau: Tableau,
    jacobian: StateJacobian,
    tolerances: Tolerances,
    patience: Patience,
) -> Explicit | Diagonal:
    if not tableau.is_implicit:
        return Explicit(solver)
    scheme = ImplicitScheme(tableau, jacobian, tolerances, patience)
    return Diagonal(solver, scheme)
