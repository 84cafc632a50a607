"""Fixed steps in C, by the tableaus that `acausal.simulate` uses."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from acausal.errors import ExportError
from acausal.export.c_text.expressions import literal
from acausal.simulation import BDF, Tableau, solver_named, tableau_of


def scheme_named(name: str) -> Tableau:
    """A scheme by its name.

    Raises:
        ExportError: for a solver that is no Runge–Kutta scheme.
    """
    solver = solver_named(name)
    if isinstance(solver, BDF):
        raise ExportError(
            f"export: solver='{name}' has no steps in C; choose 'euler', 'heun', 'rk4', 'tsit5', or for stiff models "
            "'implicit_euler', 'kvaerno3' or 'kvaerno5'."
        )
    return tableau_of(solver).without_estimate()


def step_lines(scheme: Tableau, name: str) -> Iterator[str]:
    """The body of a step: ``m->x`` and ``m->time`` move on by ``h``; inputs run from ``m->u`` to ``u_end``."""
    yield "    const real t = m->time;"
    yield "    const real *const begin = m->u;"
    yield "    const real *const end = u_end ? u_end : m->u;"
    yield from _stages(scheme, name)
    yield f"    for (int i = 0; i < STATES; i++) m->x[i] += {_combination(scheme.weights)[3:]};"
    yield "    for (int i = 0; i < INPUTS; i++) m->u[i] = end[i];"
    yield "    m->time = t + h;"
    yield "    return within_limits(m, m->x);"


def attempt_lines(scheme: Tableau, name: str) -> Iterator[str]:
    """The body of a step that may be made again: from ``m->x`` to ``m->e.x_end``, with the rates at both ends.

    Inputs run from ``m->e.u_from`` to ``m->e.u_to``.
    """
    yield "    const real *const begin = m->e.u_from;"
    yield "    const real *const end = m->e.u_to;"
    yield from _stages(scheme, name)
    yield f"    for (int i = 0; i < STATES; i++) m->e.x_end[i] = m->x[i]{_combination(scheme.weights)};"
    yield "    rates(m, SIDED(t), m->x, begin, m->e.dx_begin);"
    yield "    rates(m, SIDED(t + h), m->e.x_end, end, m->e.dx_end);"
    yield "    return within_limits(m, m->e.x_end);"


def _stages(scheme: Tableau, name: str) -> Iterator[str]:
    """The rates at the stages, from ``t`` on by ``h``; inputs run from ``begin`` to ``end``."""
    upper = name.upper()
    for s in range(len(scheme.rows)):
        yield f"    real *const k{s} = m->stages + {s} * STATES;"
    if scheme.is_implicit or any(map(any, scheme.rows)):
        yield "    real *const x = m->stage;"
    yield "    real u[INPUTS + 1] = {0};"
    if scheme.is_implicit:
        part = literal(scheme.diagonal[-1], "real")
        yield f"    if (!factor(m, SIDED(t), m->x, begin, h * {part})) return {upper}_SINGULAR;"
    for s in range(len(scheme.rows)):
        part = literal(scheme.fractions[s], "real")
        time = "t" if scheme.fractions[s] == 0 else f"t + {part} * h"
        if s == 0 or scheme.fractions[s] != scheme.fractions[s - 1]:
            yield f"    for (int i = 0; i < INPUTS; i++) u[i] = begin[i] + {part} * (end[i] - begin[i]);"
        moved = _combination(scheme.rows[s])
        if scheme.diagonal[s]:
            yield f"    for (int i = 0; i < STATES; i++) m->from[i] = m->x[i]{moved};"
            guess = f"k{s - 1}[i]" if s else "0"
            yield f"    for (int i = 0; i < STATES; i++) k{s}[i] = {guess};"
            gamma = literal(scheme.diagonal[s], "real")
            solved = f"solve_stage(m, {time}, u, {gamma} * h, m->from, k{s}, x)"
            yield f"    if (!{solved}) return {upper}_NO_CONVERGENCE;"
        elif moved:
            yield f"    for (int i = 0; i < STATES; i++) x[i] = m->x[i]{moved};"
            yield f"    rates(m, SIDED({time}), x, u, k{s});"
        else:
            yield f"    rates(m, SIDED({time}), m->x, u, k{s});"


def _combination(row: Sequence[float]) -> str:
    """What is added to a state: the step times a weighted sum of stages."""
    terms = [
        f"k{s}[i]" if w == 1 else f"{literal(w, 'real')} * k{s}[i]"
        for s, w in enumerate(row)
        if w != 0
    ]
    if not terms:
        return ""
    return f" + h * ({' + '.join(terms)})" if len(terms) > 1 else f" + h * {terms[0]}"
