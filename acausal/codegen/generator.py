"""Generate: a reduced model becomes a program of array operations, a few per distinct formula."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

import numpy as np
import sympy as sp

from acausal.codegen.gather import Gather, One, gather
from acausal.codegen.instructions import (
    Accumulate,
    Arguments,
    ArrayFormula,
    Balances,
    Instruction,
    SolveSparseLoop,
    SolveTornLoop,
    SparseFormula,
)
from acausal.codegen.parameters import ParameterLayout
from acausal.codegen.program import STATES, Program
from acausal.codegen.unlike_formulas import join_formulas, joinable
from acausal.flattening import Integers
from acausal.structure import (
    Accumulation,
    Assignment,
    BlockEquation,
    ReducedModel,
    SolvingStep,
    SparseGroup,
    SparseLoop,
    TornLoop,
    may_repeat_itself,
)


class _Generator:
    """Lays out values array by array, and finds how instructions read them."""

    def __init__(self, reduced: ReducedModel, parameters: ParameterLayout) -> None:
        self.reduced = reduced
        self.parameters = parameters
        self.source = np.full(len(reduced.derivative), -1, dtype=np.int64)
        self.index = np.full(len(reduced.derivative), -1, dtype=np.int64)
        self.guess = np.full(len(reduced.derivative), -1, dtype=np.int64)
        self.guess[reduced.guessed] = reduced.guesses
        self.nodes: list[Integers] = []
        self.sizes: list[int] = []
        self.instructions: list[Instruction] = []
        self.first: list[int] = []
        self.moving: set[int] = {STATES}
        self.waiting: list[tuple[ArrayFormula, Integers]] = []

    def write(self, step: SolvingStep) -> None:
        """Write the instruction of a step, or let it wait for others that are computed together with it."""
        instruction = _INSTRUCTION[type(step)](self, step)
        if isinstance(instruction, ArrayFormula) and self._may_wait(instruction):
            self.waiting.append((instruction, step.results[0]))
        else:
            self._append(instruction, *step.results)

    def _may_wait(self, formula: ArrayFormula) -> bool:
        """Whether a formula may be computed with others: not one of time alone, whose array may have known edges."""
        return bool(self.moving & formula.sources) and joinable(formula)

    def write_waiting(self) -> None:
        """Write the formulas that wait: together if they are many."""
        waiting, self.waiting = self.waiting, []
        instructions = join_formulas(
            [formula for formula, _ in waiting], self.sizes, self.parameters.size
        )
        results = [nodes for _, nodes in waiting]
        if len(instructions) < len(results):
            results = [np.concatenate(results)]
        for instruction, nodes in zip(instructions, results, strict=True):
            self._append(instruction, nodes)

    def _append(self, instruction: Instruction, *results: Integers) -> None:
        if self.moving & instruction.sources:
            self.moving.update(range(len(self.nodes), len(self.nodes) + len(results)))
        self.instructions.append(instruction)
        self.first.append(len(self.nodes))
        for nodes in results:
            self.place(nodes)

    def place(self, nodes: Integers) -> None:
        """Lay the nodes' values out in the next array."""
        self.source[nodes] = len(self.nodes)
        self.index[nodes] = np.arange(len(nodes))
        self.nodes.append(nodes)
        self.sizes.append(len(nodes))

    def values(self, nodes: Integers) -> Gather:
        """How to read values, which are laid out or wait for it."""
        if self.waiting and (self.source[nodes] < 0).any():
            self.write_waiting()
        return gather(self.source[nodes], self.index[nodes], self.sizes)

    def _arguments(
        self,
        variables: Iterable[tuple[sp.Symbol, Integers]],
        parameters: Iterable[tuple[sp.Symbol, Integers]],
        modules: Iterable[tuple[sp.Symbol, Integers]],
    ) -> Arguments:
        """How slots are filled, each given with its column of nodes, parameters or modules."""
        return Arguments(
            tuple((s, self.values(v)) for s, v in variables),
            tuple((s, self.parameters.gather(p)) for s, p in parameters),
            tuple((s, self.parameters.chosen(m)) for s, m in modules),
        )

    def formula(self, step: Assignment) -> ArrayFormula:
        """One expression for all instances."""
        expression = step.template.solved(step.column)
        assert expression is not None
        present = expression.free_symbols
        tables = (
            (step.template.variables, step.variables),
            (step.template.parameters, step.parameters),
            (step.template.modules, step.modules),
        )
        columns = ([(s, v) for s, v in _columns(*table) if s in present] for table in tables)
        return ArrayFormula(expression, self._arguments(*columns), len(step.variables))

    def accumulate(self, step: Accumulation) -> Accumulate:
        """Sums of equally many terms."""
        terms = self.values(step.terms.T.ravel())
        weights, signs = step.weights.T, np.unique(step.weights)
        return Accumulate(terms, weights if len(signs) > 1 else signs, *step.terms.T.shape)

    def solve_torn_loop(self, loop: TornLoop) -> SolveTornLoop:
        """Torn loops of one shape."""
        shape, torn = loop.shape, loop.shape.torn
        arguments = self._arguments(
            ((sp.Symbol(f"e{i}"), v) for i, v in enumerate(loop.externals.T)),
            ((sp.Symbol(f"p{i}"), p) for i, p in enumerate(loop.parameters.T)),
            ((sp.Symbol(f"m{i}"), m) for i, m in enumerate(loop.modules.T)),
        )
        tears = loop.unknowns[:, list(torn.tears)]
        stated = [shape.equations[e] for e, _ in torn.assigned]
        solved = [
            (unknown, one.template.solved(one.variables.index(unknown)), one)
            for (_, unknown), one in zip(torn.assigned, stated, strict=True)
        ]
        first = (len(shape.equations), len(arguments.variables), len(arguments.parameters))
        own = partial(_of_block, first)
        return SolveTornLoop(
            tuple(own(e.template.residual, e) for e in shape.equations),
            tuple(torn.residuals),
            tuple((unknown, own(formula, e)) for unknown, formula, e in solved),
            tuple(torn.tears),
            shape.matched,
            shape.is_linear,
            may_repeat_itself(shape),
            arguments,
            self.reduced.start_guess(tears),
            tuple(map(self._guess, tears.T)),
            self.reduced.nominal(tears),
            len(loop.unknowns),
            tuple(tuple(each[e] for e in torn.residuals) for each in loop.origins),
        )

    def _guess(self, unknowns: Integers) -> Gather | None:
        """The states that are guesses of unknowns; None if they have none."""
        states = self.guess[unknowns]
        return self.values(states) if (states >= 0).all() else None

    def solve_sparse_loop(self, loop: SparseLoop) -> SolveSparseLoop:
        """A large loop."""
        places = loop.places(loop.sums.nodes)
        inside, outside = loop.sums.chosen(places >= 0), loop.sums.chosen(places < 0)
        balances = Balances(
            inside.rows,
            places[places >= 0],
            inside.factors,
            outside.rows,
            self.values(outside.nodes),
            outside.factors,
            loop.sums.origins,
        )
        return SolveSparseLoop(
            tuple(self._sparse_formula(loop, g) for g in loop.groups),
            balances,
            loop.pattern,
            loop.matched,
            loop.is_linear,
            self.reduced.start_guess(loop.unknowns),
            self.reduced.nominal(loop.unknowns),
        )

    def _sparse_formula(self, loop: SparseLoop, group: SparseGroup) -> SparseFormula:
        template = group.template
        slots = list(enumerate(_columns(template.variables, group.variables)))
        arguments = self._arguments(
            (filled for c, filled in slots if c not in group.inner),
            _columns(template.parameters, group.parameters),
            _columns(template.modules, group.modules),
        )
        return SparseFormula(
            template.residual,
            tuple(template.partial(c) for c in group.inner),
            arguments,
            tuple((s, loop.places(v)) for c, (s, v) in slots if c in group.inner),
            len(group.variables),
            group.origins,
        )


_INSTRUCTION: dict[type, Callable[[_Generator, Any], Instruction]] = {
    Assignment: _Generator.formula,
    Accumulation: _Generator.accumulate,
    TornLoop: _Generator.solve_torn_loop,
    SparseLoop: _Generator.solve_sparse_loop,
}
"""By kind of step, the method that makes its instruction."""


def generate(reduced: ReducedModel, parameters: ParameterLayout) -> Program:
    """Lay out values by step and turn every step into array operations."""
    generator = _Generator(reduced, parameters)
    zero = np.asarray([reduced.aliases.zero])
    for nodes in (reduced.states, reduced.inputs, zero, reduced.discrete):
        generator.place(nodes)
    for step in reduced.steps:
        generator.write(step)
    generator.write_waiting()
    return Program(
        tuple(generator.nodes),
        tuple(generator.instructions),
        tuple(generator.first),
        generator.values(reduced.rates) if len(reduced.rates) else None,
        reduced.rate_signs,
        reduced.input_signs,
        reduced.start_values(reduced.discrete),
    )


def _of_block(
    counts: tuple[int, int, int], expression: sp.Expr | None, stated: BlockEquation
) -> ArrayFormula:
    """An equation of a block; ``counts`` are those of its unknowns, of other variables and of parameters."""
    assert expression is not None
    template, (unknowns, others, numbers) = stated.template, counts
    places = [v if v >= 0 else unknowns - 1 - v for v in stated.variables]
    places += [unknowns + others + p for p in stated.parameters]
    symbols, present = (*template.variables, *template.parameters), expression.free_symbols
    modules = zip(template.modules, stated.modules, strict=True)
    arguments = Arguments(
        tuple((s, One(place, 0)) for s, place in zip(symbols, places, strict=True) if s in present),
        modules=tuple((s, (others + numbers + m,)) for s, m in modules if s in present),
    )
    return ArrayFormula(expression, arguments, 1)


def _columns(
    symbols: tuple[sp.Symbol, ...], table: Integers
) -> Iterable[tuple[sp.Symbol, Integers]]:
    """Slots, each with what fills it, instance by instance."""
    return zip(symbols, table.T, strict=True)
