"""Explain where a model's equations have no finite values: the loop or the formula, and what stands in it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import jax.numpy as jnp
import numpy as np

from acausal.errors import listing
from acausal.generate import Program, SolveLoop
from acausal.instructions import Accumulate, Evaluate
from acausal.parameters import Packed
from acausal.reduce import ReducedModel


def explain_breakdown(
    reduced: ReducedModel, program: Program, t: Any, x: Any, u: Any, packed: Packed
) -> str | None:
    """A sentence on the first step of the model that has no finite value at a point, or None.

    Arguments:
        t: time [s]. x: states, shape (n_states,). u: inputs, shape (n_inputs,).
    """
    arrays: list[Any] = [x, u, jnp.zeros(())]
    for first, instruction in zip(program.first, program.instructions, strict=True):
        results = instruction.run(t, arrays, packed)
        for offset, result in enumerate(results):
            values = np.atleast_1d(np.asarray(result))
            bad = np.flatnonzero(~np.isfinite(values))
            if not len(bad):
                continue
            row = int(bad[0])
            if isinstance(instruction, SolveLoop):
                return _loop(reduced, program, instruction, first, row, t, arrays, packed)
            return _formula(reduced, program, instruction, first + offset, row, values[row])
        arrays += results
    return None


def _formula(
    reduced: ReducedModel,
    program: Program,
    instruction: Evaluate | Accumulate,
    array: int,
    row: int,
    value: float,
) -> str:
    name = reduced.name(_node(program, array, row))
    formula = f" = {instruction.expression}" if isinstance(instruction, Evaluate) else ", a sum,"
    return (
        f"'{name}'{formula} is {value}: a division by zero, or a function outside its domain? "
        "Look at the parameters and values that stand in it."
    )


def _loop(
    reduced: ReducedModel,
    program: Program,
    instruction: SolveLoop,
    first: int,
    row: int,
    t: Any,
    arrays: Sequence[Any],
    packed: Packed,
) -> str:
    names = [
        reduced.name(_node(program, first + i, row)) for i in range(instruction.shape.n_unknowns)
    ]
    if instruction.shape.is_linear:
        return (
            f"the linear equations for {listing(names)} are singular there; "
            "does a parameter make two of them alike, or one of them empty?"
        )
    values, rest = instruction.nearest(row, t, arrays, packed)
    shape = instruction.shape
    told = [
        f"{shape.equations[e].template.origin} (off by {abs(float(r)):.3g})"
        for e, r in zip(shape.torn.residuals, rest, strict=True)
    ]
    at = ", ".join(f"{n} = {float(v):.6g}" for n, v in list(zip(names, values, strict=True))[:6])
    return (
        f"the equations for {listing(names)} have no solution that Newton's method finds; "
        f"nearest is {at}, which leaves {listing(told, 6)}. "
        "Give start values nearer to the solution (ac.Start), or look at the parameters."
    )


def _node(program: Program, array: int, row: int) -> int:
    return int(np.flatnonzero((program.source == array) & (program.index == row))[0])
