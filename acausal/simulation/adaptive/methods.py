"""The method of adaptive steps for a solver."""

from __future__ import annotations

from typing import Any, TypeAlias

import diffrax as dfx
import equinox as eqx
import optimistix as optx

from acausal.codegen import StateJacobian
from acausal.simulation import solvers
from acausal.simulation.adaptive.bdf import BDF
from acausal.simulation.adaptive.newton_matrix import NewtonMatrix
from acausal.simulation.adaptive.one_step import Explicit, Foreign
from acausal.simulation.adaptive.problem import Problem

Method: TypeAlias = Explicit | Foreign | BDF


def explicit() -> Explicit:
    """The method that is tried first."""
    return Explicit(dfx.Tsit5())


def stiff(jacobian: StateJacobian) -> BDF:
    """The method for stiff models."""
    return BDF(NewtonMatrix(jacobian))


def method_of(solver: solvers.Solver, problem: Problem, jacobian: StateJacobian) -> Method:
    """The method by which a solver's steps are made.

    Raises:
        SimulationError: for a solver without an error estimate.
    """
    solver = solvers.for_adaptive_steps(solver)
    if isinstance(solver, solvers.BDF):
        return stiff(jacobian)
    if isinstance(solver, dfx.AbstractERK):
        return Explicit(solver)
    return Foreign(_with_tolerances(solver, problem))


def _with_tolerances(solver: dfx.AbstractSolver[Any], problem: Problem) -> dfx.AbstractSolver[Any]:
    """The solver with the tolerances of the steps, where its equations are to be solved with these."""
    if not isinstance(solver, dfx.AbstractImplicitSolver):
        return solver
    example: Any = dfx.with_stepsize_controller_tols(optx.Newton)()
    own = {"rtol": problem.rtol, "atol": problem.atol, "norm": optx.rms_norm}
    finder: Any = solver.root_finder
    for name, value in own.items():
        if getattr(finder, name, None) is getattr(example, name):
            finder = eqx.tree_at(lambda f, n=name: getattr(f, n), finder, value, is_leaf=_anything)
    return eqx.tree_at(lambda s: s.root_finder, solver, finder)


def _anything(node: object) -> bool:
    return node is dfx.with_stepsize_controller_tols(optx.Newton)().rtol
