"""Instructions: what a program is made of, each one array operation over all instances of a formula."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import jax.numpy as jnp
import numpy as np
import sympy as sp

from acausal.codegen.gather import Gather
from acausal.codegen.lower import ModuleValue, collect, evaluate
from acausal.codegen.parameters import Packed
from acausal.modeling import time

STATE = 0
"""Where the states lie among a program's arrays."""


@dataclass(frozen=True)
class Arguments:
    """What fills the slots of a step's formula, by symbol."""

    variables: tuple[tuple[sp.Symbol, Gather], ...]
    parameters: tuple[tuple[sp.Symbol, Gather], ...]
    modules: tuple[tuple[sp.Symbol, tuple[int, ...]], ...]

    @property
    def sources(self) -> set[int]:
        """The arrays that are read."""
        return {s for _, g in self.variables for s in g.sources}

    def read(self, t: Any, arrays: Sequence[Any], packed: Packed) -> dict[sp.Symbol, Any]:
        """Values of the slots."""
        values: dict[sp.Symbol, Any] = {time: t}
        values |= {symbol: g.read(arrays) for symbol, g in self.variables}
        values |= {symbol: g.read([packed.values]) for symbol, g in self.parameters}
        values |= {symbol: chosen_module(packed, chosen) for symbol, chosen in self.modules}
        return values


@dataclass(frozen=True)
class Evaluate:
    """Compute one expression for ``size`` instances."""

    expression: sp.Expr
    arguments: Arguments
    size: int

    outputs = 1

    @property
    def sources(self) -> set[int]:
        """The arrays that are read."""
        return self.arguments.sources

    def run(self, t: Any, arrays: Sequence[Any], packed: Packed) -> list[Any]:
        """The step's results, one array each."""
        value = jnp.asarray(evaluate(self.expression, self.arguments.read(t, arrays, packed)))
        return [value if self.size == 1 else jnp.broadcast_to(value, (self.size,))]


@dataclass(frozen=True)
class Accumulate:
    """Add up ``terms`` values each for ``size`` instances: ``sum(weights * value)``.

    Attributes:
        values: the terms, the first of all instances before the second of all.
        weights: (terms, size), or the one number that all of them are.
    """

    values: Gather
    weights: np.ndarray
    terms: int
    size: int

    outputs = 1

    @property
    def sources(self) -> set[int]:
        """The arrays that are read."""
        return set(self.values.sources)

    def run(self, t: Any, arrays: Sequence[Any], packed: Packed) -> list[Any]:
        """The sums, as one array."""
        values = jnp.broadcast_to(self.values.read(arrays), (self.terms * self.size,))
        weights = jnp.asarray(self.weights, values.dtype)
        total = (values.reshape(self.terms, self.size) * weights).sum(axis=0)
        return [total[0] if self.size == 1 else total]


def chosen_module(packed: Packed, chosen: Sequence[int]) -> ModuleValue:
    """The module of one instance or of all; those of several instances side by side."""
    if len(set(chosen)) == 1:
        return ModuleValue(packed.modules[chosen[0]])
    return collect([packed.modules[i] for i in chosen])
