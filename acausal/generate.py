"""Generate: a reduced model becomes a program of array operations, a few per distinct formula.

A `Program` runs while JAX traces; its size depends on the number of distinct formulas, not of components.
Values live in a list of arrays: the state, the input, then one array per step.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import sympy as sp

from acausal import derive
from acausal.gather import Gather, gather
from acausal.instructions import Accumulate, Arguments, Evaluate
from acausal.lower import ModuleValue, evaluate
from acausal.parameters import Packed, ParameterLayout
from acausal.reduce import Accumulation, Assignment, BlockShape, Loop, ReducedModel
from acausal.solve import nearest, solve_linear, solve_nonlinear
from acausal.symbols import time
from acausal.template import Integers

STATE, INPUT, ZERO = 0, 1, 2


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
            values[symbol] = unknowns[code] if code >= 0 else known[_external(-1 - code)]
        for symbol, i in zip(stated.template.parameters, stated.parameters, strict=True):
            values[symbol] = known[_parameter(i)]
        for symbol, i in zip(stated.template.modules, stated.modules, strict=True):
            module = known[_callable(i)]
            values[symbol] = module if isinstance(module, ModuleValue) else ModuleValue(module)
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


def _external(i: int) -> sp.Symbol:
    return sp.Symbol(f"e{i}")


def _parameter(i: int) -> sp.Symbol:
    return sp.Symbol(f"p{i}")


def _callable(i: int) -> sp.Symbol:
    return sp.Symbol(f"m{i}")


Instruction = Evaluate | Accumulate | SolveLoop


@dataclass(frozen=True)
class Program:
    """Array code of a model.

    Attributes:
        source, index: (n_nodes,) in which array, and where in it, a node's value lies (-1: nowhere).
        instructions: in order; ``first[i]`` is the array that instruction i fills first.
        sizes: lengths of all arrays.
        rates: where the derivatives of the states are read, and their signs; ``input_signs`` those of the inputs.
    """

    source: Integers
    index: Integers
    instructions: tuple[Instruction, ...]
    first: tuple[int, ...]
    sizes: tuple[int, ...]
    rates: Gather | None
    rate_signs: np.ndarray
    input_signs: np.ndarray

    def vector_field(self, t: Any, x: Any, u: Any, packed: Packed) -> Any:
        """Derivatives of the states, shape (n_states,)."""
        if self.rates is None:
            return jnp.zeros_like(x)
        arrays = self._run(self.rates.sources, t, x, u, packed)
        rates = jnp.broadcast_to(self.rates.read(arrays), x.shape)
        return rates if (self.rate_signs == 1).all() else rates * self.rate_signs

    def values(self, nodes: Sequence[int], t: Any, x: Any, u: Any, packed: Packed) -> Any:
        """Values of some nodes, shape (len(nodes),)."""
        chosen = np.asarray(nodes, dtype=np.int64)
        wanted = gather(self.source[chosen], self.index[chosen], self.sizes)
        arrays = self._run(wanted.sources, t, x, u, packed)
        return jnp.broadcast_to(wanted.read(arrays), (len(nodes),))

    def both(self, nodes: Sequence[int], t: Any, x: Any, u: Any, packed: Packed) -> tuple[Any, Any]:
        """Derivatives of the states and values of some nodes, what they share computed once."""
        chosen = np.asarray(nodes, dtype=np.int64)
        wanted = gather(self.source[chosen], self.index[chosen], self.sizes)
        rates = self.rates
        arrays = self._run({*wanted.sources, *(rates.sources if rates else ())}, t, x, u, packed)
        dx = jnp.broadcast_to(rates.read(arrays), x.shape) if rates else jnp.zeros_like(x)
        dx = dx if (self.rate_signs == 1).all() else dx * self.rate_signs
        return dx, jnp.broadcast_to(wanted.read(arrays), (len(nodes),))

    def _run(self, wanted: Iterable[int], t: Any, x: Any, u: Any, packed: Packed) -> list[Any]:
        """Run the instructions that the wanted arrays depend on."""
        u = u if (self.input_signs == 1).all() else u * self.input_signs
        arrays: list[Any] = [x, u, jnp.zeros((), x.dtype), *[None] * (len(self.sizes) - 3)]
        needed = set(wanted)
        active: list[int] = []
        for i in range(len(self.instructions) - 1, -1, -1):
            filled = range(self.first[i], self.first[i] + self.instructions[i].outputs)
            if needed.intersection(filled):
                active.append(i)
                needed.update(self.instructions[i].sources)
        for i in reversed(active):
            results = self.instructions[i].run(t, arrays, packed)
            arrays[self.first[i] : self.first[i] + len(results)] = results
        return arrays


def generate(reduced: ReducedModel, parameters: ParameterLayout) -> Program:
    """Lay out values by step and turn every step into array operations."""
    n_nodes = len(reduced.derivative)
    source = np.full(n_nodes, -1, dtype=np.int64)
    index = np.full(n_nodes, -1, dtype=np.int64)
    sizes = [len(reduced.states), len(reduced.inputs), 1]

    def place(nodes: Integers, array: int) -> None:
        source[nodes] = array
        index[nodes] = np.arange(len(nodes))

    place(reduced.states, STATE)
    place(reduced.inputs, INPUT)
    place(np.asarray([reduced.aliases.zero]), ZERO)
    instructions: list[Instruction] = []
    first: list[int] = []
    for step in reduced.steps:
        first.append(len(sizes))
        match step:
            case Assignment():
                instruction = _evaluate(step, source, index, sizes, parameters)
            case Accumulation():
                instruction = _accumulate(step, source, index, sizes)
            case Loop():
                instruction = _solve_loop(reduced, step, source, index, sizes, parameters)
        instructions.append(instruction)
        filled = step.unknowns.T if isinstance(step, Loop) else step.unknowns[None]
        for nodes in filled:
            place(nodes, len(sizes))
            sizes.append(len(nodes))
    rates = (
        gather(source[reduced.rates], index[reduced.rates], sizes) if len(reduced.rates) else None
    )
    return Program(
        source,
        index,
        tuple(instructions),
        tuple(first),
        tuple(sizes),
        rates,
        reduced.rate_signs,
        reduced.input_signs,
    )


def _evaluate(
    step: Assignment,
    source: Integers,
    index: Integers,
    sizes: Sequence[int],
    layout: ParameterLayout,
) -> Evaluate:
    expression = derive.solve(step.template, step.column)
    assert expression is not None
    present = expression.free_symbols
    template = step.template

    def columns(
        symbols: tuple[sp.Symbol, ...], table: Integers
    ) -> list[tuple[sp.Symbol, Integers]]:
        return [(s, table[:, i]) for i, s in enumerate(symbols) if s in present]

    arguments = Arguments(
        tuple(
            (s, gather(source[v], index[v], sizes))
            for s, v in columns(template.variables, step.variables)
        ),
        tuple((s, layout.gather(p)) for s, p in columns(template.parameters, step.parameters)),
        tuple((s, layout.chosen(m)) for s, m in columns(template.modules, step.modules)),
    )
    return Evaluate(expression, arguments, len(step.variables))


def _accumulate(
    step: Accumulation, source: Integers, index: Integers, sizes: Sequence[int]
) -> Accumulate:
    nodes = step.terms.T.ravel()
    terms = gather(source[nodes], index[nodes], sizes)
    weights, signs = step.weights.T, np.unique(step.weights)
    return Accumulate(terms, weights if len(signs) > 1 else signs, *step.terms.T.shape)


def _solve_loop(
    reduced: ReducedModel,
    loop: Loop,
    source: Integers,
    index: Integers,
    sizes: Sequence[int],
    layout: ParameterLayout,
) -> SolveLoop:
    arguments = Arguments(
        tuple(
            (_external(i), gather(source[v], index[v], sizes))
            for i, v in enumerate(loop.externals.T)
        ),
        tuple((_parameter(i), layout.gather(p)) for i, p in enumerate(loop.parameters.T)),
        tuple((_callable(i), layout.chosen(m)) for i, m in enumerate(loop.modules.T)),
    )
    tears = loop.unknowns[:, list(loop.shape.torn.tears)]
    guess = reduced.start_guess(tears)
    scale = reduced.nominal(tears)
    return SolveLoop(loop.shape, arguments, guess, scale, len(loop.unknowns))
