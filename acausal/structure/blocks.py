"""Steps: what is computed at one level by one formula, side by side; in solving order."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal.errors import StructureError, listing
from acausal.flattening import Integers, Template, Total, balance
from acausal.structure import graph, symbolic as derive
from acausal.structure.algebraic_loops import Loop, block_of, loop_of, matrix
from acausal.structure.equations import Equations
from acausal.structure.jacobian import parameter_values
from acausal.structure.sparse_loops import LARGE, Mesh, mesh_of


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


@dataclass(frozen=True)
class Accumulation:
    """Sums of equally many terms, side by side: ``unknowns[i] = sum(weights[i] * terms[i])``."""

    unknowns: Integers
    terms: Integers
    weights: np.ndarray


Step = Assignment | Accumulation | Loop | Mesh


def order_steps(
    system: Equations, incidence: list[list[int]], variable_of: list[int], blocks: graph.Blocks
) -> tuple[Step, ...]:
    """Group what can be computed at the same level by the same formula.

    Of a loop's equations that are totals, what lies outside of the loop becomes one variable, summed before.

    Raises:
        StructureError: for an equation that is to be divided by zero, or a loop that is singular.
    """
    order = np.lexsort((np.arange(len(incidence)), blocks.block, blocks.level[blocks.block]))
    bounds = np.flatnonzero(np.diff(blocks.block[order], prepend=-1, append=-1))
    values = parameter_values(system.model)
    vanishing = system.vanishing(values)
    sums: dict[tuple[int, int], list[_Sum]] = {}
    found: dict[Any, list[Any]] = {}
    meshes: dict[int, list[int]] = {}
    for a, b in itertools.pairwise(bounds):
        equations = order[a:b].tolist()
        level = int(blocks.level[blocks.block[equations[0]]])
        e, unknown = equations[0], variable_of[equations[0]]
        template, column = system.template[e], system.variables[e].index(unknown)
        if len(equations) > LARGE:
            meshes.setdefault(level, []).extend(equations)
        elif len(equations) > 1 or not derive.is_solvable(template, column):
            for outside in _close(system, equations, [variable_of[e] for e in equations]):
                sums.setdefault((level, len(outside.terms)), []).append(outside)
            block = block_of(system, equations, [variable_of[e] for e in equations], vanishing)
            found.setdefault((level, block.equations, len(equations)), []).append(block)
        elif isinstance(template, Total):
            total = _solved(template, system.variables[e], column)
            sums.setdefault((level, len(total.terms)), []).append(total)
        elif (e, column) in vanishing:
            raise StructureError(_no_divisor(system, e, column))
        else:
            found.setdefault((level, template, column), []).append(e)
    steps: list[tuple[int, Step]] = [(key[0], _accumulation(rows)) for key, rows in sums.items()]
    steps += [
        (key[0], _assignment(system, key[1], key[2], members))
        if isinstance(key[1], Template)
        else (key[0], loop_of(system, members, values))
        for key, members in found.items()
    ]
    steps += [
        (level, mesh_of(system, members, [variable_of[e] for e in members], values))
        for level, members in meshes.items()
    ]
    return tuple(step for _, step in sorted(steps, key=lambda s: s[0]))


@dataclass(frozen=True)
class _Sum:
    """``unknown = sum(weights * terms)``."""

    unknown: int
    terms: list[int]
    weights: list[float]


def _solved(total: Total, variables: list[int], column: int) -> _Sum:
    divisor = -total.coefficients[column]
    rest = [i for i in range(len(variables)) if i != column]
    weights = [total.coefficients[i] / divisor for i in rest]
    return _Sum(variables[column], [variables[i] for i in rest], weights)


def _close(system: Equations, equations: list[int], unknowns: list[int]) -> list[_Sum]:
    """Let the totals of a loop read one variable for all that they sum outside of the loop."""
    inside = set(unknowns)
    sums: list[_Sum] = []
    for e in equations:
        total, variables = system.template[e], system.variables[e]
        if not isinstance(total, Total):
            continue
        pairs = list(zip(variables, total.coefficients, strict=True))
        outside = [(v, c) for v, c in pairs if v not in inside]
        if len(outside) > 1:
            kept = [(v, c) for v, c in pairs if v in inside]
            rest = system.new_node()
            sums.append(_Sum(rest, [v for v, _ in outside], [float(c) for _, c in outside]))
            system.template[e] = balance((*(c for _, c in kept), 1), total.origin)
            system.variables[e] = [*(v for v, _ in kept), rest]
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
        f"'{unknown}' cannot be computed from {system.describe(equation)}: its factor there is zero "
        f"because of {listing(names)}; give another value"
    )


def _assignment(
    system: Equations, template: Template, column: int, members: list[int]
) -> Assignment:
    return Assignment(
        template,
        column,
        matrix([system.variables[e] for e in members]),
        matrix([system.parameters[e] for e in members]),
        matrix([system.modules[e] for e in members]),
    )
