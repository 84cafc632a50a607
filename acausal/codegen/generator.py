"""Generate: a reduced model becomes a program of array operations, a few per distinct formula."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import sympy as sp

from acausal.codegen.dense_loop import SolveLoop, external, module, parameter
from acausal.codegen.gather import Gather, gather
from acausal.codegen.instructions import Accumulate, Arguments, Evaluate
from acausal.codegen.parameters import ParameterLayout
from acausal.codegen.program import Instruction, Program
from acausal.codegen.sparse import SparseMatrix
from acausal.codegen.sparse_loop import Balances, Formula, SolveMesh
from acausal.flattening import Integers
from acausal.structure import (
    Accumulation,
    Assignment,
    Loop,
    Mesh,
    MeshGroup,
    ReducedModel,
    Step,
    symbolic as derive,
)


class _Generator:
    """Lays out values array by array, and says how instructions read what lies there."""

    def __init__(self, reduced: ReducedModel, parameters: ParameterLayout) -> None:
        self.reduced = reduced
        self.parameters = parameters
        self.source = np.full(len(reduced.derivative), -1, dtype=np.int64)
        self.index = np.full(len(reduced.derivative), -1, dtype=np.int64)
        self.sizes: list[int] = []

    def place(self, nodes: Integers) -> None:
        """Lay the nodes' values out in the next array."""
        self.source[nodes] = len(self.sizes)
        self.index[nodes] = np.arange(len(nodes))
        self.sizes.append(len(nodes))

    def values(self, nodes: Integers) -> Gather:
        """How to read values that are laid out."""
        return gather(self.source[nodes], self.index[nodes], self.sizes)

    def instruction(self, step: Step) -> Instruction:
        """What computes a step."""
        match step:
            case Assignment():
                return self._evaluate(step)
            case Accumulation():
                return self._accumulate(step)
            case Loop():
                return self._solve_loop(step)
            case Mesh():
                return self._solve_mesh(step)

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

    def _evaluate(self, step: Assignment) -> Evaluate:
        expression = derive.solve(step.template, step.column)
        assert expression is not None
        present = expression.free_symbols
        tables = (
            (step.template.variables, step.variables),
            (step.template.parameters, step.parameters),
            (step.template.modules, step.modules),
        )
        columns = ([(s, v) for s, v in _columns(*table) if s in present] for table in tables)
        return Evaluate(expression, self._arguments(*columns), len(step.variables))

    def _accumulate(self, step: Accumulation) -> Accumulate:
        terms = self.values(step.terms.T.ravel())
        weights, signs = step.weights.T, np.unique(step.weights)
        return Accumulate(terms, weights if len(signs) > 1 else signs, *step.terms.T.shape)

    def _solve_loop(self, loop: Loop) -> SolveLoop:
        arguments = self._arguments(
            ((external(i), v) for i, v in enumerate(loop.externals.T)),
            ((parameter(i), p) for i, p in enumerate(loop.parameters.T)),
            ((module(i), m) for i, m in enumerate(loop.modules.T)),
        )
        tears = loop.unknowns[:, list(loop.shape.torn.tears)]
        guess, scale = self.reduced.start_guess(tears), self.reduced.nominal(tears)
        return SolveLoop(loop.shape, arguments, guess, scale, len(loop.unknowns))

    def _solve_mesh(self, mesh: Mesh) -> SolveMesh:
        formulas = tuple(self._formula(mesh, g) for g in mesh.groups)
        places = mesh.places(mesh.sums.nodes)
        inside, outside = mesh.sums.chosen(places >= 0), mesh.sums.chosen(places < 0)
        balances = Balances(
            inside.rows,
            places[places >= 0],
            inside.factors,
            outside.rows,
            self.values(outside.nodes),
            outside.factors,
            mesh.sums.origins,
        )
        guess, scale = self.reduced.start_guess(mesh.unknowns), self.reduced.nominal(mesh.unknowns)
        matrix = SparseMatrix(mesh.pattern)
        return SolveMesh(formulas, balances, matrix, mesh.is_linear, guess, scale)

    def _formula(self, mesh: Mesh, group: MeshGroup) -> Formula:
        template = group.template
        slots = list(enumerate(_columns(template.variables, group.variables)))
        arguments = self._arguments(
            (filled for c, filled in slots if c not in group.inner),
            _columns(template.parameters, group.parameters),
            _columns(template.modules, group.modules),
        )
        return Formula(
            template,
            tuple(derive.slope(template, c) for c in group.inner),
            arguments,
            tuple((s, mesh.places(v)) for c, (s, v) in slots if c in group.inner),
            len(group.variables),
        )


def generate(reduced: ReducedModel, parameters: ParameterLayout) -> Program:
    """Lay out values by step and turn every step into array operations."""
    generator = _Generator(reduced, parameters)
    for nodes in (reduced.states, reduced.inputs, np.asarray([reduced.aliases.zero])):
        generator.place(nodes)
    instructions: list[Instruction] = []
    first: list[int] = []
    for step in reduced.steps:
        first.append(len(generator.sizes))
        instructions.append(generator.instruction(step))
        for nodes in step.unknowns.T if isinstance(step, Loop) else step.unknowns[None]:
            generator.place(nodes)
    return Program(
        generator.source,
        generator.index,
        tuple(instructions),
        tuple(first),
        tuple(generator.sizes),
        generator.values(reduced.rates) if len(reduced.rates) else None,
        reduced.rate_signs,
        reduced.input_signs,
    )


def _columns(
    symbols: tuple[sp.Symbol, ...], table: Integers
) -> Iterable[tuple[sp.Symbol, Integers]]:
    """Slots, each with what fills it, instance by instance."""
    return zip(symbols, table.T, strict=True)
