"""Explain why a model's equations have no finite values: which loop or formula fails, and at which values."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from typing import Any

import numpy as np
from jax import Array

from acausal.codegen.dense_loop import nearest_of_torn_loop
from acausal.codegen.instructions import (
    ArrayFormula,
    ExplicitInstruction,
    Place,
    SolveSparseLoop,
    SolveTornLoop,
)
from acausal.codegen.interpreter import steps
from acausal.codegen.program import Program
from acausal.codegen.reading import Arrays
from acausal.codegen.sparse_loop import nearest_of_sparse_loop
from acausal.codegen.values import Values
from acausal.errors import listing
from acausal.flattening import Origin

_NEAREST: dict[type, Callable[[Any, int, Values, Arrays], tuple[Array, Array]]] = {
    SolveTornLoop: nearest_of_torn_loop,
    SolveSparseLoop: nearest_of_sparse_loop,
}
"""Where the search for a loop's solution stopped."""


def explain_nonfinite(
    program: Program,
    values: Values,
    name: Callable[[int], str],
    nodes: Sequence[int] | None = None,
    further: Collection[int] = (),
) -> str | None:
    """A sentence on the first instruction that has no finite value at a point, or None.

    Arguments:
        name: of a node, for messages.
        nodes: those whose values are asked for; by default the derivatives of the states, and ``further`` arrays.
    """
    own = program.rate_sources if nodes is None else program.gather(nodes).sources
    wanted = {*own, *further}
    for i, instruction, results, arrays in steps(program, values, wanted):
        bad = _nonfinite(results)
        if not bad:
            continue
        first = program.first[i]
        asked = [p for p in bad if nodes and int(program.nodes[first + p[0]][p[1]]) in nodes]
        place = (asked or bad)[0]
        together = instruction.found_with(place)
        names = [name(int(program.nodes[first + array][row])) for array, row in together]
        if isinstance(instruction, ExplicitInstruction):
            if reason := said_by_modules(_called(instruction, values)):
                return f"'{names[0]}' cannot be computed. {reason}"
            value = np.atleast_1d(np.asarray(results[place[0]]))[place[1]]
            return _formula(names[0], instruction.text_at(place[1]), value)
        if instruction.is_linear:
            return _singular(names)
        nearest = _NEAREST[type(instruction)](instruction, place[1], values, arrays)
        return _stopped(names, instruction.origins_of(place), *nearest)
    return None


def _nonfinite(results: Sequence[Array]) -> list[Place]:
    return [
        (array, int(row))
        for array, result in enumerate(results)
        for row in np.flatnonzero(~np.isfinite(np.atleast_1d(np.asarray(result))))
    ]


def said_by_modules(modules: Iterable[Any]) -> str | None:
    """What modules say of numbers that are not finite: one that computes outside of JAX may know why it fails."""
    asked = (getattr(module, "why_nonfinite", None) for module in modules)
    return next((reason for why in asked if why and (reason := why())), None)


def _called(instruction: ExplicitInstruction, values: Values) -> list[Any]:
    """The modules that a formula calls."""
    slots = instruction.arguments.modules if isinstance(instruction, ArrayFormula) else ()
    return [values.packed.modules[m] for _, modules in slots for m in modules]


def _formula(name: str, formula: str, value: float) -> str:
    return (
        f"'{name}'{formula} is {value}: a division by zero, or a function outside its domain? "
        "Check its parameters and values."
    )


def _singular(names: list[str]) -> str:
    return (
        f"the linear equations for {listing(names)} are singular; "
        "does a parameter make two of them the same, or one of them void, or do two parts lock the same motion? "
        "Of two frictions that do, one may creep instead (smooth=True)."
    )


def _stopped(names: list[str], origins: Sequence[Origin], values: Array, residuals: Array) -> str:
    """A sentence on nonlinear equations, from where the search for their solution ended."""
    off = np.abs(np.asarray(residuals))
    left = [f"{origins[i]} (off by {off[i]:.3g})" for i in np.argsort(-off, kind="stable")]
    at = ", ".join(f"{n} = {float(v):.6g}" for n, v in list(zip(names, values, strict=True))[:6])
    return (
        f"Newton's method finds no solution of the equations for {listing(names)}; "
        f"the nearest point is {at}, which leaves {listing(left, 6)}. "
        "Give start values nearer to the solution (ac.Start), check the parameters, or, where a mechanism passes a "
        "dead point of its states, prefer no one of them (stateSelect): then all are states."
    )
