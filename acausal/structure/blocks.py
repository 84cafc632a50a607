"""Blocks: strongly connected components in solving order become steps, equal ones side by side.

A block of one equation that can be solved for its unknown is an assignment, or a sum; any other is an algebraic loop.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from acausal.errors import StructureError, listing
from acausal.flattening import Integers, Template
from acausal.structure import graph
from acausal.structure.algebraic_loops import TornLoop, block_of, torn_loop
from acausal.structure.equations import Equations, matrix
from acausal.structure.sparse_loops import SparseLoop, sparse_loop
from acausal.structure.tearing_pays import tearing_pays

LARGE, WRITTEN, TERMS = 100, 200, 600
"""A loop of more unknowns is torn only where that pays, or not at all: XLA compiles a torn one equation by equation.
The same holds for one whose equations read more variables."""


@dataclass(frozen=True)
class Assignment:
    """Instances of one template, all solved for the same slot: ``variables[:, column]`` follow from the rest."""

    template: Template
    column: int
    variables: Integers
    parameters: Integers
    modules: Integers

    @property
    def unknowns(self) -> Integers:
        """The unknown that each instance is solved for."""
        return self.variables[:, self.column]

    @property
    def results(self) -> tuple[Integers, ...]:
        """The unknowns, array by array as they are computed."""
        return (self.unknowns,)


@dataclass(frozen=True)
class Accumulation:
    """Sums of equally many terms, side by side: ``unknowns[i] = sum(weights[i] * terms[i])``."""

    unknowns: Integers
    terms: Integers
    weights: np.ndarray

    @property
    def results(self) -> tuple[Integers, ...]:
        """The unknowns, array by array as they are computed."""
        return (self.unknowns,)


SolvingStep = Assignment | Accumulation | TornLoop | SparseLoop


@dataclass(frozen=True)
class _Pending:
    """Equal blocks of one level, and the function that makes one step of them."""

    level: int
    make: Callable[[list[Any]], SolvingStep]
    members: list[Any] = field(default_factory=list[Any])


_Groups = dict[Hashable, _Pending]


def order_steps(
    system: Equations, incidence: list[list[int]], variable_of: list[int], blocks: graph.Blocks
) -> tuple[SolvingStep, ...]:
    """Group the blocks of one level that have the same formula and are stated by one class, or by many.

    The terms of a loop's sums that lie outside of the loop are added up first, as one variable.

    Raises:
        StructureError: for an equation that would be divided by zero, or a loop that is singular.
    """
    order = np.lexsort((np.arange(len(incidence)), blocks.block, blocks.level[blocks.block]))
    bounds = np.flatnonzero(np.diff(blocks.block[order], prepend=-1, append=-1))
    values = system.parameter_values
    vanishing = system.vanishing(values)
    sums: _Groups = {}
    formulas: _Groups = {}
    large: _Groups = {}

    for a, b in itertools.pairwise(bounds):
        equations = order[a:b].tolist()
        level = int(blocks.level[blocks.block[equations[0]]])
        unknowns = [variable_of[e] for e in equations]
        e = equations[0]
        template, column = system.template[e], system.variables[e].index(unknowns[0])
        n_terms = sum(len(system.variables[e]) for e in equations)
        is_large = len(equations) > LARGE or n_terms > TERMS
        if is_large and not (
            len(equations) <= WRITTEN
            and tearing_pays(system, equations, unknowns, vanishing, values)
        ):
            pairs = zip(equations, unknowns, strict=True)
            make = partial(sparse_loop, system, parameters=values)
            _collect(large, level, None, make, *pairs)
        elif len(equations) > 1 or not template.is_solvable(column):
            for outside in _add_up_outside(system, equations, unknowns):
                _collect(sums, level, len(outside.terms), _accumulation, outside)
            block = block_of(system, equations, unknowns, vanishing)
            make = partial(torn_loop, system, parameters=values)
            apart = tuple(system.apart[e] for e in equations)
            _collect(formulas, level, (block.equations, block.ranks, apart), make, block)
        elif (weights := template.weights(column)) is not None:
            terms = [v for i, v in enumerate(system.variables[e]) if i != column]
            _collect(sums, level, len(terms), _accumulation, _Sum(unknowns[0], terms, weights))
        elif (e, column) in vanishing:
            raise StructureError(_no_divisor(system, e, column))
        else:
            make = partial(_assignment, system, template, column)
            _collect(formulas, level, (template, column, system.apart[e]), make, e)
    groups = [*sums.values(), *formulas.values(), *large.values()]
    steps = [(g.level, g.make(g.members)) for g in groups]
    return tuple(step for _, step in sorted(steps, key=lambda s: s[0]))


def _collect(
    groups: _Groups,
    level: int,
    key: Hashable,
    make: Callable[[list[Any]], SolvingStep],
    *members: Any,
) -> None:
    """Put blocks beside those of the same level and key."""
    groups.setdefault((level, key), _Pending(level, make)).members.extend(members)


@dataclass(frozen=True)
class _Sum:
    """``unknown = sum(weights * terms)``."""

    unknown: int
    terms: list[int]
    weights: tuple[float, ...]


def _add_up_outside(system: Equations, equations: list[int], unknowns: list[int]) -> list[_Sum]:
    """Replace the terms of a loop's sums that lie outside of the loop by one variable."""
    inside = set(unknowns)
    sums: list[_Sum] = []
    for e in equations:
        template, variables = system.template[e], system.variables[e]
        is_inside = tuple(v in inside for v in variables)
        closed = template.split(is_inside)
        if closed is None:
            continue
        pairs = list(zip(variables, template.coefficients() or (), is_inside, strict=True))
        outside = [(v, c) for v, c, own in pairs if not own]
        rest = system.new_node()
        sums.append(_Sum(rest, [v for v, _ in outside], tuple(float(c) for _, c in outside)))
        system.template[e] = closed
        system.variables[e] = [*(v for v, _, own in pairs if own), rest]
    return sums


def _accumulation(sums: list[_Sum]) -> Accumulation:
    return Accumulation(
        np.asarray([s.unknown for s in sums], dtype=np.int64),
        matrix([s.terms for s in sums]),
        np.asarray([s.weights for s in sums]),
    )


def _no_divisor(system: Equations, equation: int, column: int) -> str:
    names = [system.model.layout.parameter(p) for p in system.divisors(equation, column)]
    unknown = system.name(system.variables[equation][column])
    return (
        f"'{unknown}' cannot be computed from {system.describe(equation)}: its factor there is zero, or no number, "
        f"because of {listing(names)}; give another value"
    )


def _assignment(
    system: Equations, template: Template, column: int, members: list[int]
) -> Assignment:
    return Assignment(template, column, *system.slots(members))
