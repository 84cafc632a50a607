"""Solve algebraic loops with JAX: torn blocks of one shape, side by side."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array

from acausal.codegen.dense import nearest, solve_linear, solve_nonlinear
from acausal.codegen.instructions import ArrayFormula, SolveTornLoop
from acausal.codegen.lower import ModuleValue
from acausal.codegen.reading import Arrays, compute, fill, read_elements
from acausal.codegen.values import Packed, Values
from acausal.modeling import time

Known = Sequence[Any]
"""What the loops read: the values of their arguments, in order."""

NOTHING: Any = np.zeros(0)


def solve_torn_loops(loop: SolveTornLoop, values: Values, arrays: Arrays) -> list[Array]:
    """The unknowns, one array each over the loops."""
    solve = solve_linear if loop.is_linear else solve_nonlinear

    def one(t: Any, known: Known, guess: Array, scale: Array) -> Array:
        return solve(lambda tears: _torn(loop, tears, t, known), guess, scale)

    scale = jnp.asarray(loop.scale, values.x.dtype)
    return _for_each(loop, values, arrays, one, _guess(loop, values, arrays), scale)


def _guess(loop: SolveTornLoop, values: Values, arrays: Arrays) -> Array:
    """Where the search for the tearing variables starts, (size, n_tears)."""
    guess = jnp.asarray(loop.guess, values.x.dtype)
    if not any(loop.guessed):
        return guess
    pairs = zip(guess.T, loop.guessed, strict=True)
    columns = [start if state is None else read_elements(state, arrays) for start, state in pairs]
    return jnp.stack([jnp.broadcast_to(column, loop.size) for column in columns], axis=1)


def matched_residuals_of_torn_loops(
    loop: SolveTornLoop, values: Values, arrays: Arrays, unknowns: list[Array]
) -> list[Array]:
    """For given unknowns the residuals of the equations matched to them, one array each over the loops."""

    def one(t: Any, known: Known, own: Array) -> Array:
        return jnp.stack([_value(loop.equations[e], list(own), t, known) for e in loop.matched])

    rows = jnp.stack(unknowns, axis=-1).reshape(loop.size, loop.outputs)
    return _for_each(loop, values, arrays, one, rows)


def _for_each(
    loop: SolveTornLoop,
    values: Values,
    arrays: Arrays,
    function: Callable[..., Array],
    *rows: Array,
) -> list[Array]:
    """What a function of time, arguments and rows gives for each of the loops; an array over them for each result."""
    filled = fill(loop.arguments, values.packed, arrays, values.t)
    t = filled.pop(time)

    def one(known: dict[int, Any], *own: Array) -> Array:
        return function(t, list(known.values()), *own)

    named = dict(enumerate(filled.values()))
    if loop.size == 1:
        return list(one(named, *(r[0] for r in rows)))
    if any(isinstance(v, ModuleValue) and isinstance(v.module, tuple) for v in named.values()):
        each = [{k: _row(v, i) for k, v in named.items()} for i in range(loop.size)]
        return list(jnp.stack([one(*own) for own in zip(each, *rows, strict=True)]).T)
    shared = {k: v for k, v in named.items() if isinstance(v, ModuleValue) and not v.stacked}
    parts = {
        k: eqx.partition(v.module if isinstance(v, ModuleValue) else v, eqx.is_array)
        for k, v in named.items()
        if k not in shared
    }
    batched = {
        k: jnp.broadcast_to(v, (loop.size, *jnp.shape(v)[1:])) if eqx.is_array(v) else v
        for k, (v, _) in parts.items()
    }

    def row(arrays: dict[int, Any], *own: Array) -> Array:
        combined = {k: eqx.combine(v, parts[k][1]) for k, v in arrays.items()}
        both = {**shared, **combined}
        return one({k: both[k] for k in named}, *own)

    return list(jax.vmap(row)(batched, *rows).T)


def nearest_of_torn_loop(
    loop: SolveTornLoop, row: int, values: Values, arrays: Arrays
) -> tuple[Array, Array]:
    """Unknowns and residuals of one of the loops, where the search for its solution stopped."""
    filled = fill(loop.arguments, values.packed, arrays, values.t)
    t = filled.pop(time)
    known = [_row(value, row) for value in filled.values()]

    def block(tears: Array) -> tuple[Array, Array]:
        return _torn(loop, tears, t, known)

    guess = _guess(loop, values, arrays)[row]
    return block(nearest(block, guess, jnp.asarray(loop.scale[row])))


def _row(value: Any, i: int) -> Any:
    """The value for one of several instances."""
    if not isinstance(value, ModuleValue):
        return value[i] if jnp.ndim(value) else value
    if isinstance(value.module, tuple):
        return value.module[i]
    if not value.stacked:
        return value
    return jax.tree.map(lambda leaf: leaf[i] if eqx.is_array(leaf) else leaf, value.module)


def _torn(loop: SolveTornLoop, tears: Array, t: Any, known: Known) -> tuple[Array, Array]:
    """All unknowns of a torn block, and its residuals, for given tearing variables."""
    unknowns: list[Any] = [None] * loop.outputs
    for i, variable in enumerate(loop.tears):
        unknowns[variable] = tears[i]
    for unknown, formula in loop.assigned:
        unknowns[unknown] = _value(formula, unknowns, t, known)
    residuals = [_value(f, unknowns, t, known) for f in loop.residuals]
    return jnp.stack(unknowns), jnp.stack(residuals)


def _value(formula: ArrayFormula, unknowns: Sequence[Any], t: Any, known: Known) -> Array:
    """The value of a formula of the block."""
    return compute(formula, Packed(NOTHING, tuple(known)), [*unknowns, *known], t)
