"""Fixed steps in C, by the tableaus that `acausal.simulate` uses."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import diffrax as dfx
import numpy as np

from acausal.errors import ExportError
from acausal.export.c_text.expressions import literal
from acausal.simulation import solver_named


@dataclass(frozen=True)
class Scheme:
    """A Runge–Kutta scheme.

    Attributes:
        name: of the solver. a: rows of coefficients of the earlier stages. diagonal: those of the stages themselves.
        b: of the result. c: times of the stages, as parts of the step.
    """

    name: str
    a: tuple[np.ndarray, ...]
    diagonal: np.ndarray
    b: np.ndarray
    c: np.ndarray

    @property
    def stages(self) -> int:
        """How many times the derivatives are needed."""
        return len(self.b)

    @property
    def implicit(self) -> bool:
        """Whether a stage is the solution of equations."""
        return bool(self.diagonal.any())


def scheme_named(name: str) -> Scheme:
    """A scheme by its name.

    Raises:
        ExportError: for a solver that is no Runge–Kutta scheme.
    """
    solver = solver_named(name)
    if isinstance(solver, dfx.Euler):
        return Scheme(name, (np.zeros(0),), np.zeros(1), np.ones(1), np.zeros(1))
    if isinstance(solver, dfx.ImplicitEuler):
        return Scheme(name, (np.zeros(0),), np.ones(1), np.ones(1), np.ones(1))
    tableau = getattr(solver, "tableau", None)
    if not isinstance(tableau, dfx.ButcherTableau):
        raise ExportError(
            f"export: solver='{name}' has no steps in C; choose 'euler', 'heun', 'rk4', 'tsit5', or for stiff models "
            "'implicit_euler', 'kvaerno3' or 'kvaerno5'."
        )
    stages = len(tableau.b_sol)
    diagonal = tableau.a_diagonal if tableau.a_diagonal is not None else np.zeros(stages)
    a = (np.zeros(0), *map(np.asarray, tableau.a_lower))
    c = np.array([tableau.c1, *tableau.c])
    b = np.asarray(tableau.b_sol)
    if (
        not diagonal.any() and b[-1] == 0 and tableau.fsal
    ):  # the last stage serves the error estimate only
        a, diagonal, b, c = a[:-1], diagonal[:-1], b[:-1], c[:-1]
    return Scheme(name, a, np.asarray(diagonal), b, c)


def step_lines(scheme: Scheme, name: str) -> Iterator[str]:
    """The body of a step: ``m->x`` and ``m->time`` move on by ``h``; inputs run from ``m->u`` to ``u_end``.

    Arguments:
        name: of the model.
    """
    yield "    const real t = m->time;"
    yield "    const real *const begin = m->u;"
    yield "    const real *const end = u_end ? u_end : m->u;"
    yield from _stages(scheme, name)
    yield f"    for (int i = 0; i < STATES; i++) m->x[i] += {_combination(scheme.b)[3:]};"
    yield "    for (int i = 0; i < INPUTS; i++) m->u[i] = end[i];"
    yield "    m->time = t + h;"
    yield f"    return all_finite(m->x, STATES) ? {name.upper()}_OK : {name.upper()}_NOT_FINITE;"


def attempt_lines(scheme: Scheme, name: str) -> Iterator[str]:
    """The body of a step that may be made again: from ``m->x`` to ``m->e.x_end``, with the rates at both ends.

    Inputs run from ``m->e.u_from`` to ``m->e.u_to``.

    Arguments:
        name: of the model.
    """
    yield "    const real *const begin = m->e.u_from;"
    yield "    const real *const end = m->e.u_to;"
    yield from _stages(scheme, name)
    yield f"    for (int i = 0; i < STATES; i++) m->e.x_end[i] = m->x[i]{_combination(scheme.b)};"
    yield "    rates(m, SIDED(t), m->x, begin, m->e.dx_begin);"
    yield "    rates(m, SIDED(t + h), m->e.x_end, end, m->e.dx_end);"
    yield f"    return all_finite(m->e.x_end, STATES) ? {name.upper()}_OK : {name.upper()}_NOT_FINITE;"


def _stages(scheme: Scheme, name: str) -> Iterator[str]:
    """The rates at the stages, from ``t`` on by ``h``; inputs run from ``begin`` to ``end``."""
    upper = name.upper()
    for s in range(scheme.stages):
        yield f"    real *const k{s} = m->stages + {s} * STATES;"
    if scheme.implicit or any(row.any() for row in scheme.a):
        yield "    real *const x = m->stage;"
    yield "    real u[INPUTS + 1] = {0};"
    if scheme.implicit:
        part = literal(float(scheme.diagonal[-1]), "real")
        yield f"    if (!factor(m, SIDED(t), m->x, begin, h * {part})) return {upper}_SINGULAR;"
    for s in range(scheme.stages):
        part = literal(float(scheme.c[s]), "real")
        time = "t" if scheme.c[s] == 0 else f"t + {part} * h"
        if s == 0 or scheme.c[s] != scheme.c[s - 1]:
            yield f"    for (int i = 0; i < INPUTS; i++) u[i] = begin[i] + {part} * (end[i] - begin[i]);"
        moved = _combination(scheme.a[s]) if s < len(scheme.a) else ""
        if scheme.diagonal[s]:
            yield f"    for (int i = 0; i < STATES; i++) m->from[i] = m->x[i]{moved};"
            guess = f"k{s - 1}[i]" if s else "0"
            yield f"    for (int i = 0; i < STATES; i++) k{s}[i] = {guess};"
            gamma = literal(float(scheme.diagonal[s]), "real")
            solved = f"solve_stage(m, {time}, u, {gamma} * h, m->from, k{s}, x)"
            yield f"    if (!{solved}) return {upper}_NO_CONVERGENCE;"
        elif moved:
            yield f"    for (int i = 0; i < STATES; i++) x[i] = m->x[i]{moved};"
            yield f"    rates(m, SIDED({time}), x, u, k{s});"
        else:
            yield f"    rates(m, SIDED({time}), m->x, u, k{s});"


def _combination(row: np.ndarray) -> str:
    """What is added to a state: the step times a weighted sum of stages."""
    terms = [
        f"k{s}[i]" if w == 1 else f"{literal(float(w), 'real')} * k{s}[i]"
        for s, w in enumerate(row)
        if w != 0
    ]
    if not terms:
        return ""
    return f" + h * ({' + '.join(terms)})" if len(terms) > 1 else f" + h * {terms[0]}"
