"""Explain where a model slides: which formula jumps between two states that are next to each other."""

from __future__ import annotations

from collections.abc import Callable

import jax
import numpy as np

from acausal.codegen.instructions import ExplicitInstruction
from acausal.codegen.interpreter import rates, steps
from acausal.codegen.program import Program
from acausal.codegen.values import Values

HALVINGS = 40
"""Of the way between two states: what is continuous hardly changes over what is left of it."""

STAYS, LEAST = 0.5, 1e-6
"""The part of a change that is left where a value jumps, and the least change that counts, relative to the value."""


def explain_jump(
    program: Program, values: Values, other: Values, name: Callable[[int], str]
) -> str | None:
    """A clause on the first formula that jumps on the way between two states, or None.

    Arguments:
        values, other: points that differ in their states alone. name: of a node, for messages.
    """
    near = _near(program, values, other)
    runs = (steps(program, v, program.rate_sources) for v in (values, other, *near))
    for (i, instruction, *first), *others in zip(*runs, strict=True):
        results = [first[0], *(found[2] for found in others)]
        for array, found in enumerate(zip(*results, strict=True)):
            nodes = program.nodes[program.first[i] + array]
            a, b, before, after = (np.broadcast_to(np.asarray(v), nodes.shape) for v in found)
            rows = np.flatnonzero((_share(a, b, before, after) > STAYS) & (nodes >= 0))
            for row in rows[:1].tolist():
                explicit = isinstance(instruction, ExplicitInstruction)
                what = f"'{name(int(nodes[row]))}'{instruction.text_at(row) if explicit else ''}"
                return f"{what} jumps from {before[row]:.3g} to {after[row]:.3g}"
    return None


def _near(program: Program, values: Values, other: Values) -> tuple[Values, Values]:
    """The part of the way on which the derivatives change most, by bisection."""
    at = jax.jit(lambda x: rates(program, values._replace(x=x)))
    ends = [(v, np.asarray(at(v.x))) for v in (values, other)]
    begin, end = (rate for _, rate in ends)
    for _ in range(HALVINGS):
        (low, f), (high, g) = ends
        middle = values._replace(x=(low.x + high.x) / 2)
        h = np.asarray(at(middle.x))
        of_low, of_high = (_share(begin, end, *part).max(initial=0) for part in ((f, h), (h, g)))
        between = middle, h
        ends = [ends[0], between] if of_low >= of_high else [between, ends[1]]
    return ends[0][0], ends[1][0]


def _share(a: np.ndarray, b: np.ndarray, before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """How large changes are beside those of the whole way; zero where these are roundoff."""
    whole = np.abs(b - a)
    counts = whole > LEAST * (np.abs(a) + np.abs(b))
    return np.where(counts, np.abs(after - before) / np.where(counts, whole, 1.0), 0.0)
