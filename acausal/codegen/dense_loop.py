"""Solve algebraic loops: torn blocks of one shape, side by side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import sympy as sp

from acausal.codegen.dense import nearest, solve_linear, solve_nonlinear
from acausal.codegen.instructions import STATE, Arguments
from acausal.codegen.lower import ModuleValue, evaluate
from acausal.codegen.parameters import Packed
from acausal.modeling import time
from acausal.structure import BlockShape, symbolic as derive


@dataclass(frozen=True)
class SolveLoop:
    """Solve ``size`` algebraic loops of one shape, linear or not."""

    shape: BlockShape
    arguments: Arguments
    guess: np.ndarray
    scale: np.ndarray
    size: int

    @property
    def sources(self) -> set[int]:
        """The arrays that are read."""
        return self.arguments.sources

    @property
    def outputs(self) -> int:
        """How many arrays the step fills."""
        return self.shape.n_unknowns

    @property
    def is_linear(self) -> bool:
        """Whether the loops are linear in their unknowns."""
        return self.shape.is_linear

    @property
    def origins(self) -> list[str]:
        """The equations that leave residuals, as they were written."""
        return [self.shape.equations[e].template.origin for e in self.shape.torn.residuals]

    def run(self, t: Any, arrays: Sequence[Any], packed: Packed) -> list[Any]:
        """The step's results, one array each."""
        values = self.arguments.read(t, arrays, packed)
        values.pop(time)
        solve = solve_linear if self.shape.is_linear else solve_nonlinear

        def one(guess: Any, scale: Any, filled: dict[str, Any]) -> Any:
            known = {sp.Symbol(name): value for name, value in filled.items()}
            return solve(lambda tears: _torn(self.shape, tears, t, known), guess, scale)

        named = {s.name: v for s, v in values.items()}
        dtype = arrays[STATE].dtype
        guess, scale = jnp.asarray(self.guess, dtype), jnp.asarray(self.scale, dtype)
        if self.size == 1:
            return list(one(guess[0], scale[0], named))
        if any(isinstance(v, ModuleValue) and isinstance(v.module, tuple) for v in named.values()):
            rows = [{k: _row(v, i) for k, v in named.items()} for i in range(self.size)]
            each = [one(*row) for row in zip(guess, scale, rows, strict=True)]
            return list(jnp.stack(each).T)
        shared = {k: v for k, v in named.items() if isinstance(v, ModuleValue) and not v.stacked}
        parts = {
            k: eqx.partition(v.module if isinstance(v, ModuleValue) else v, eqx.is_array)
            for k, v in named.items()
            if k not in shared
        }
        batched = {
            k: jnp.broadcast_to(v, (self.size, *jnp.shape(v)[1:])) if eqx.is_array(v) else v
            for k, (v, _) in parts.items()
        }

        def row(guess: Any, scale: Any, arrays: dict[str, Any]) -> Any:
            own = {k: eqx.combine(v, parts[k][1]) for k, v in arrays.items()}
            return one(guess, scale, {**shared, **own})

        return list(jax.vmap(row)(guess, scale, batched).T)

    def nearest(self, row: int, t: Any, arrays: Sequence[Any], packed: Packed) -> tuple[Any, Any]:
        """Unknowns and residuals of one of the loops, where its solution stopped."""
        values = self.arguments.read(t, arrays, packed)
        values.pop(time)
        known = {symbol: _row(value, row) for symbol, value in values.items()}

        def block(tears: Any) -> tuple[Any, Any]:
            return _torn(self.shape, tears, t, known)

        return block(nearest(block, jnp.asarray(self.guess[row]), jnp.asarray(self.scale[row])))


def _row(value: Any, i: int) -> Any:
    """What one of several instances sees."""
    if not isinstance(value, ModuleValue):
        return value[i] if jnp.ndim(value) else value
    if isinstance(value.module, tuple):
        return value.module[i]
    if not value.stacked:
        return value
    return jax.tree.map(lambda leaf: leaf[i] if eqx.is_array(leaf) else leaf, value.module)


def _torn(shape: BlockShape, tears: Any, t: Any, known: dict[sp.Symbol, Any]) -> tuple[Any, Any]:
    """All unknowns of a torn block, and its residuals, for given tearing variables."""
    unknowns: list[Any] = [None] * shape.n_unknowns
    for i, variable in enumerate(shape.torn.tears):
        unknowns[variable] = tears[i]

    def fill(equation: int) -> dict[sp.Symbol, Any]:
        stated = shape.equations[equation]
        values: dict[sp.Symbol, Any] = {time: t}
        for symbol, code in zip(stated.template.variables, stated.variables, strict=True):
            values[symbol] = unknowns[code] if code >= 0 else known[external(-1 - code)]
        for symbol, i in zip(stated.template.parameters, stated.parameters, strict=True):
            values[symbol] = known[parameter(i)]
        for symbol, i in zip(stated.template.modules, stated.modules, strict=True):
            value = known[module(i)]
            values[symbol] = value if isinstance(value, ModuleValue) else ModuleValue(value)
        return values

    for equation, variable in shape.torn.assigned:
        stated = shape.equations[equation]
        explicit = derive.solve(stated.template, stated.variables.index(variable))
        assert explicit is not None
        unknowns[variable] = evaluate(explicit, fill(equation))
    residuals = [
        evaluate(shape.equations[e].template.residual, fill(e)) for e in shape.torn.residuals
    ]
    return jnp.stack(unknowns), jnp.stack(residuals)


def external(i: int) -> sp.Symbol:
    """Slot of a variable that the loop's equations read besides its unknowns."""
    return sp.Symbol(f"e{i}")


def parameter(i: int) -> sp.Symbol:
    """Slot of a parameter of the loop."""
    return sp.Symbol(f"p{i}")


def module(i: int) -> sp.Symbol:
    """Slot of a callable parameter of the loop."""
    return sp.Symbol(f"m{i}")
