"""Solve algebraic loops with JAX: torn blocks of one shape, side by side."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import sympy as sp
from jax import Array

from acausal.codegen.dense import nearest, solve_linear, solve_nonlinear
from acausal.codegen.instructions import BlockFormula, SolveTornLoop, external, module, parameter
from acausal.codegen.lower import ModuleValue, evaluate
from acausal.codegen.reading import Arrays, read_arguments
from acausal.codegen.values import Values
from acausal.modeling import time

SlotValues = dict[sp.Symbol, Any]


def solve_torn_loops(loop: SolveTornLoop, values: Values, arrays: Arrays) -> list[Array]:
    """The unknowns, one array each over the loops."""
    filled = read_arguments(loop.arguments, values, arrays)
    t = filled.pop(time)
    solve = solve_linear if loop.is_linear else solve_nonlinear

    def one(guess: Array, scale: Array, named: dict[str, Any]) -> Array:
        known = {sp.Symbol(name): value for name, value in named.items()}
        return solve(lambda tears: _torn(loop, tears, t, known), guess, scale)

    named = {s.name: v for s, v in filled.items()}
    dtype = values.x.dtype
    guess, scale = jnp.asarray(loop.guess, dtype), jnp.asarray(loop.scale, dtype)
    if loop.size == 1:
        return list(one(guess[0], scale[0], named))
    if any(isinstance(v, ModuleValue) and isinstance(v.module, tuple) for v in named.values()):
        rows = [{k: _row(v, i) for k, v in named.items()} for i in range(loop.size)]
        each = [one(*row) for row in zip(guess, scale, rows, strict=True)]
        return list(jnp.stack(each).T)
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

    def row(guess: Array, scale: Array, arrays: dict[str, Any]) -> Array:
        own = {k: eqx.combine(v, parts[k][1]) for k, v in arrays.items()}
        return one(guess, scale, {**shared, **own})

    return list(jax.vmap(row)(guess, scale, batched).T)


def nearest_of_torn_loop(
    loop: SolveTornLoop, row: int, values: Values, arrays: Arrays
) -> tuple[Array, Array]:
    """Unknowns and residuals of one of the loops, where the search for its solution stopped."""
    filled = read_arguments(loop.arguments, values, arrays)
    t = filled.pop(time)
    known = {symbol: _row(value, row) for symbol, value in filled.items()}

    def block(tears: Array) -> tuple[Array, Array]:
        return _torn(loop, tears, t, known)

    return block(nearest(block, jnp.asarray(loop.guess[row]), jnp.asarray(loop.scale[row])))


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
