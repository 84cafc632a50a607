"""Explain where a model's equations have no finite values: the loop or the formula, and what stands in it."""

from __future__ import annotations

from functools import partial
from typing import Any

import jax.numpy as jnp
import numpy as np

from acausal.codegen.dense_loop import SolveLoop
from acausal.codegen.instructions import Accumulate, Evaluate
from acausal.codegen.program import Program
from acausal.codegen.sparse_loop import SolveMesh
from acausal.codegen.values import Values
from acausal.errors import listing
from acausal.structure import ReducedModel


def explain_breakdown(reduced: ReducedModel, program: Program, values: Values) -> str | None:
    """A sentence on the first step of the model that has no finite value at a point, or None."""
    t, x, u, packed = values
    arrays: list[Any] = [x, u, jnp.zeros(())]
    for first, instruction in zip(program.first, program.instructions, strict=True):
        results = instruction.run(t, arrays, packed)
        for offset, result in enumerate(results):
            found = np.atleast_1d(np.asarray(result))
            bad = np.flatnonzero(~np.isfinite(found))
            if not len(bad):
                continue
            row = int(bad[0])
            match instruction:
                case SolveLoop():
                    names = [_name(reduced, program, first + i, row) for i in range(len(results))]
                    nearest = partial(instruction.nearest, row)
                case SolveMesh():
                    names = [_name(reduced, program, first, i) for i in range(len(found))]
                    nearest = instruction.nearest
                case _:
                    name = _name(reduced, program, first + offset, row)
                    return _formula(name, instruction, found[row])
            if instruction.is_linear:
                return _singular(names)
            return _stopped(names, instruction.origins, *nearest(t, arrays, packed))
        arrays += results
    return None


def _formula(name: str, instruction: Evaluate | Accumulate, value: float) -> str:
    formula = f" = {instruction.expression}" if isinstance(instruction, Evaluate) else ", a sum,"
    return (
        f"'{name}'{formula} is {value}: a division by zero, or a function outside its domain? "
        "Look at the parameters and values that stand in it."
    )


def _singular(names: list[str]) -> str:
    return (
        f"the linear equations for {listing(names)} are singular there; "
        "does a parameter make two of them alike, or one of them empty?"
    )


def _stopped(names: list[str], origins: list[str], values: Any, residuals: Any) -> str:
    """What is said of nonlinear equations, from where the search for their solution ended."""
    off = np.abs(np.asarray(residuals))
    told = [f"{origins[i]} (off by {off[i]:.3g})" for i in np.argsort(-off, kind="stable")]
    at = ", ".join(f"{n} = {float(v):.6g}" for n, v in list(zip(names, values, strict=True))[:6])
    return (
        f"the equations for {listing(names)} have no solution that Newton's method finds; "
        f"nearest is {at}, which leaves {listing(told, 6)}. "
        "Give start values nearer to the solution (ac.Start), or look at the parameters."
    )


def _name(reduced: ReducedModel, program: Program, array: int, row: int) -> str:
    found = np.flatnonzero((program.source == array) & (program.index == row))
    return reduced.name(int(found[0]))
