"""Solve algebraic loops with JAX: torn blocks of one shape, side by side."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import sympy as sp
from jax import Array

from acausal.codegen.dense import nearest, solve_linear, solve_nonlinear
from acausal.codegen.instructions import BlockFormula, SolveTornLoop, external, module, parameter
from acausal.codegen.lower import ModuleValue, evaluate
from acausal.codegen.reading import Arrays, fill, read_elements
from acausal.codegen.values import Values
from acausal.modeling import time

SlotValues = dict[sp.Symbol, Any]


def solve_torn_loops(loop: SolveTornLoop, values: Values, arrays: Arrays) -> list[Array]:
    """The unknowns, one array each over the loops."""
    solve = solve_linear if loop.is_linear else solve_nonlinear

    def one(t: Any, known: SlotValues, guess: Array, scale: Array) -> Array:
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

    def one(t: Any, known: SlotValues, own: Array) -> Array:
        equations = [loop.equations[e] for e in loop.matched]
        filled = [_filled(f, list(own), t, known) for f in equations]
        return jnp.stack(
            [evaluate(f.expression, v) for f, v in zip(equations, filled, strict=True)]
        )

    rows = jnp.stack(unknowns, axis=-1).reshape(loop.size, loop.outputs)
    return _for_each(loop, values, arrays, one, rows)


def _for_each(
    loop: SolveTornLoop,
    values: Values,
    arrays: Arrays,
    function: Callable[..., Array],
    *rows: Array,
) -> list[Array]:
    """What a function of time, slots and rows gives for each of the loops; one array over the loops for each result."""
    filled = fill(loop.arguments, values.packed, arrays, values.t)
    t = filled.pop(time)

    def one(named: dict[str, Any], *own: Array) -> Array:
        return function(t, {sp.Symbol(name): value for name, value in named.items()}, *own)

    named = {s.name: v for s, v in filled.items()}
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

    def row(arrays: dict[str, Any], *own: Array) -> Array:
        combined = {k: eqx.combine(v, parts[k][1]) for k, v in arrays.items()}
        return one({**shared, **combined}, *own)

    return list(jax.vmap(row)(batched, *rows).T)


def nearest_of_torn_loop(
    loop: SolveTornLoop, row: int, values: Values, arrays: Arrays
) -> tuple[Array, Array]:
    """Unknowns and residuals of one of the loops, where the search for its solution stopped."""
    filled = fill(loop.arguments, values.packed, arrays, values.t)
    t = filled.pop(time)
    known = {symbol: _row(value, row) for symbol, value in filled.items()}

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


def _torn(loop: SolveTornLoop, tears: Array, t: Any, known: SlotValues) -> tuple[Array, Array]:
    """All unknowns of a torn block, and its residuals, for given tearing variables."""
    unknowns: list[Any] = [None] * loop.outputs
    for i, variable in enumerate(loop.tears):
        unknowns[variable] = tears[i]
    for unknown, formula in loop.assigned:
        unknowns[unknown] = evaluate(formula.expression, _filled(formula, unknowns, t, known))
    residuals = [evaluate(f.expression, _filled(f, unknowns, t, known)) for f in loop.residuals]
    return jnp.stack(unknowns), jnp.stack(residuals)


def _filled(formula: BlockFormula, unknowns: list[Any], t: Any, known: SlotValues) -> SlotValues:
    """The values in the slots of a formula of the block."""
    values: SlotValues = {time: t}
    for symbol, code in formula.variables:
        values[symbol] = unknowns[code] if code >= 0 else known[external(-1 - code)]
    for symbol, i in formula.parameters:
        values[symbol] = known[parameter(i)]
    for symbol, i in formula.modules:
        value = known[module(i)]
        values[symbol] = value if isinstance(value, ModuleValue) else ModuleValue(value)
    return values
