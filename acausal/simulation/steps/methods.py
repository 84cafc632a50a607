"""The method of adaptive steps for a solver."""

from __future__ import annotations

import operator
from typing import Any, TypeAlias

import diffrax as dfx
import equinox as eqx
import optimistix as optx

from acausal.codegen import StateJacobian
from acausal.simulation import solvers
from acausal.simulation.steps.bdf import BDF
from acausal.simulation.steps.newton_matrix import NewtonMatrix
from acausal.simulation.steps.one_step import Foreign
from acausal.simulation.steps.paced import Paced
from acausal.simulation.steps.problem import Problem
from acausal.simulation.steps.runge_kutta import Explicit

Method: TypeAlias = Explicit | Foreign | BDF


def explicit() -> Explicit:
    """The method that is tried first."""
    return Explicit(dfx.Tsit5())


def stiff(problem: Problem, jacobian: StateJacobian) -> Method:
    """The method for stiff models; with events, which end all that a multistep method knows, a one-step method."""
    solver = solvers.solver_named("stiff", events=problem.events is not None)
    return method_of(solver, problem, jacobian)


def method_of(solver: solvers.Solver, problem: Problem, jacobian: StateJacobian) -> Method:
    """The method by which a solver's steps are made.

    Raises:
        SimulationError: for a solver without an error estimate.
    """
    solver = solvers.for_adaptive_steps(solver)
    if isinstance(solver, solvers.BDF):
        return BDF(NewtonMatrix(jacobian))
    if isinstance(solver, dfx.AbstractERK):
        return Explicit(solver)
    return Foreign(_with_tolerances(solver, problem))


def paced(scheme: solvers.Scheme) -> Paced:
    """Steps of given length by a scheme."""
    return Paced(Explicit(scheme) if isinstance(scheme, dfx.AbstractERK) else Foreign(scheme))


def _with_tolerances(solver: dfx.AbstractSolver[Any], problem: Problem) -> dfx.AbstractSolver[Any]:
    """The solver with the tolerances of the steps, where its equations are to be solved with these."""
    if not isinstance(solver, dfx.AbstractImplicitSolver):
        return solver
    own = {"rtol": problem.rtol, "atol": problem.atol, "norm": optx.rms_norm}
    finder: Any = solver.root_finder
    for name, value in own.items():
        if _is_of_steps(getattr(finder, name, None)):
            place = operator.attrgetter(name)
            finder = eqx.tree_at(place, finder, value, is_leaf=_is_of_steps)
    return eqx.tree_at(lambda s: s.root_finder, solver, finder)


def _is_of_steps(node: object) -> bool:
    """Whether this is what diffrax puts where a tolerance is to be that of the steps."""
    example: Any = dfx.with_stepsize_controller_tols(optx.Newton)()
    return node is example.rtol
