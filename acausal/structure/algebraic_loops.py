"""Algebraic loops: blocks of equations in local numbers, equal ones side by side, and how they are torn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import sympy as sp

from acausal.errors import listing
from acausal.flattening import Integers, Origin, Statement
from acausal.modeling import TEAR_SELECT
from acausal.structure import graph
from acausal.structure.equations import Equations, matrix
from acausal.structure.jacobian import Point, is_constant, partials
from acausal.structure.rank import singular
from acausal.structure.tearing import Preference, Torn, tear

ALWAYS = TEAR_SELECT.index("always") - TEAR_SELECT.index("default")


@dataclass(frozen=True)
class BlockEquation:
    """An equation of an algebraic block: its slots name the block's unknowns (>= 0) or externals (-1 - i).

    Slots in ``vanishing`` have a factor that is zero for the model's own parameter values.
    """

    template: Statement
    variables: tuple[int, ...]
    parameters: tuple[int, ...]
    modules: tuple[int, ...]
    vanishing: tuple[int, ...] = ()


@dataclass(frozen=True)
class BlockShape:
    """The shared part of equal algebraic loops: equations over local numbers, and how they are torn."""

    equations: tuple[BlockEquation, ...]
    n_unknowns: int
    torn: Torn

    @property
    def matched(self) -> tuple[int, ...]:
        """For every unknown an equation of its own that contains it."""
        contained = [[(c, v) for c, v in enumerate(e.variables) if v >= 0] for e in self.equations]
        certain = [
            [v for c, v in own if c not in e.vanishing]
            for own, e in zip(contained, self.equations, strict=True)
        ]
        variable_of = graph.match(certain, self.n_unknowns)
        if min(variable_of) < 0:
            variable_of = graph.match([[v for _, v in own] for own in contained], self.n_unknowns)
        return tuple(np.argsort(variable_of).tolist())

    @property
    def is_linear(self) -> bool:
        """Whether the loop is linear in its unknowns."""
        return all(
            e.template.is_linear(tuple(c for c, v in enumerate(e.variables) if v >= 0))
            for e in self.equations
        )

    @property
    def is_periodic(self) -> bool:
        """Whether a sine or a cosine of an unknown is in the loop, as in a linkage, so that solutions repeat."""
        slots = [
            {s for s, v in zip(e.template.variables, e.variables, strict=True) if v >= 0}
            for e in self.equations
        ]
        waves = [e.template.residual.atoms(sp.sin, sp.cos, sp.tan) for e in self.equations]
        return any(
            own & w.free_symbols for own, some in zip(slots, waves, strict=True) for w in some
        )


@dataclass(frozen=True)
class TornLoop:
    """Algebraic loops of one shape, side by side: (n, m) unknowns, solved from externals.

    ``origins`` says of each loop where its equations are stated.
    """

    shape: BlockShape
    unknowns: Integers
    externals: Integers
    parameters: Integers
    modules: Integers
    origins: tuple[tuple[Origin, ...], ...]

    @property
    def results(self) -> tuple[Integers, ...]:
        """The unknowns, array by array as they are computed."""
        return tuple(self.unknowns.T)


@dataclass(frozen=True)
class Block:
    """One algebraic loop: its equations in local numbers, its unknowns' ranks for tearing, and what fills them."""

    stated: tuple[int, ...]
    equations: tuple[BlockEquation, ...]
    ranks: tuple[int, ...]
    unknowns: list[int]
    externals: list[int]
    parameters: list[int]
    modules: list[int]


def block_of(
    system: Equations, equations: list[int], unknowns: list[int], vanishing: set[tuple[int, int]]
) -> Block:
    """A block in local numbers; equal blocks get equal equations."""
    local = {v: i for i, v in enumerate(unknowns)}
    externals: dict[int, int] = {}
    parameters: list[int] = []
    modules: list[int] = []
    stated: list[BlockEquation] = []
    for e in equations:
        codes = tuple(
            local[v] if v in local else -1 - externals.setdefault(v, len(externals))
            for v in system.variables[e]
        )
        first, first_module = len(parameters), len(modules)
        parameters += system.parameters[e]
        modules += system.modules[e]
        stated.append(
            BlockEquation(
                system.template[e],
                codes,
                tuple(range(first, len(parameters))),
                tuple(range(first_module, len(modules))),
                tuple(c for c, v in enumerate(codes) if v >= 0 and (e, c) in vanishing),
            )
        )
    ranks = tuple(system.tear_ranks.get(v, 0) for v in unknowns)
    own = list(externals), parameters, modules
    return Block(tuple(equations), tuple(stated), ranks, unknowns, *own)


def torn_loop(system: Equations, blocks: Sequence[Block], parameters: np.ndarray) -> TornLoop:
    """Equal blocks side by side, torn.

    Raises:
        StructureError: if a loop is singular for the model's own ``parameters``.
    """
    equations, n_unknowns = blocks[0].equations, len(blocks[0].unknowns)
    loop = TornLoop(
        BlockShape(equations, n_unknowns, torn_block(system, blocks)),
        matrix([b.unknowns for b in blocks]),
        matrix([b.externals for b in blocks]),
        matrix([b.parameters for b in blocks]),
        matrix([b.modules for b in blocks]),
        tuple(tuple(system.origin[e] for e in b.stated) for b in blocks),
    )
    wrong = _singular(loop, parameters)
    if wrong is not None:
        block = blocks[wrong]
        raise system.singular_loop(block.stated, block.unknowns, _hint(system, block))
    return loop


def torn_block(system: Equations, blocks: Sequence[Block]) -> Torn:
    """How equal blocks are torn."""
    equations, ranks = blocks[0].equations, blocks[0].ranks
    incidence = [[v for v in e.variables if v >= 0] for e in equations]

    def solvable(equation: int, unknown: int) -> bool:
        stated = equations[equation]
        column = stated.variables.index(unknown)
        return column not in stated.vanishing and stated.template.is_safely_solvable(column)

    nonlinear = {
        code
        for e in equations
        for column, code in enumerate(e.variables)
        if code >= 0 and not e.template.is_solvable(column)
    }  # Newton's method finds these best where it moves them itself

    def preference(unknown: int) -> Preference:
        rank = ranks[unknown]
        guessed = bool(nonlinear) and any(b.unknowns[unknown] in system.started for b in blocks)
        return Preference(rank, rank == ALWAYS, guessed, unknown in nonlinear)

    return tear(incidence, solvable, len(ranks), preference)


def _hint(system: Equations, block: Block) -> str:
    """What to say of parameters of a singular loop that are zero."""
    zeros = [
        system.model.layout.parameter(p)
        for e, stated in zip(block.stated, block.equations, strict=True)
        for column in stated.vanishing
        for p in system.divisors(e, column)
    ]
    return f"; {listing(dict.fromkeys(zeros))} being zero may be why" if zeros else ""


def _singular(loop: TornLoop, parameters: np.ndarray) -> int | None:
    """The first of the loops whose equations depend on each other, as far as their Jacobians are constant."""
    shape, n = loop.shape, len(loop.unknowns)
    if not shape.is_linear:
        return None
    nowhere = Point(np.ones(1), parameters)
    rows: list[int] = []
    columns: list[int] = []
    values: list[np.ndarray] = []
    for i, e in enumerate(shape.equations):
        for column, code in enumerate(e.variables):
            if code < 0:
                continue
            if not is_constant(e.template, column):
                return None
            variables = np.zeros((n, len(e.variables)), dtype=np.int64)
            own = loop.parameters[:, list(e.parameters)]
            rows.append(i)
            columns.append(code)
            values.append(partials(e.template, column, variables, own, nowhere))
    each = np.stack(values, axis=1).tolist()
    size = shape.n_unknowns
    return next((i for i, own in enumerate(each) if singular(rows, columns, own, size)), None)
