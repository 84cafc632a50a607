"""Sparse loops: algebraic loops with too many unknowns for expressions, stored as arrays and sparse matrices."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from acausal.flattening import Integers, Origin, Statement
from acausal.structure.elimination_order import Pattern, analyse, match_rows
from acausal.structure.equations import Equations
from acausal.structure.jacobian import Point, partials, random_values


@dataclass(frozen=True)
class SparseGroup:
    """Equations of one template in which the same slots (``inner``) hold unknowns of the loop."""

    template: Statement
    inner: tuple[int, ...]
    variables: Integers
    parameters: Integers
    modules: Integers
    origins: tuple[Origin, ...]


@dataclass(frozen=True)
class LinearRows:
    """Equations ``sum(factors * nodes) = 0``, all in one list: ``rows`` is the equation that each term belongs to.

    Attributes:
        origins: where every equation is stated.
    """

    rows: Integers
    nodes: Integers
    factors: np.ndarray
    origins: tuple[Origin, ...]

    def chosen(self, which: np.ndarray) -> LinearRows:
        """Some of the terms."""
        return LinearRows(self.rows[which], self.nodes[which], self.factors[which], self.origins)


@dataclass(frozen=True)
class SparseLoop:
    """Large algebraic loops of one level, solved as one: their unknowns, and as many equations.

    Attributes:
        groups: equations in order of rows; ``sums``: those that come after, by row among them.
        pattern: positions of the Jacobian's entries: group by group and slot by slot, then those of the sums.
        matched: for every unknown an equation in which its factor is large.
    """

    unknowns: Integers
    groups: tuple[SparseGroup, ...]
    sums: LinearRows
    pattern: Pattern
    matched: Integers

    @property
    def results(self) -> tuple[Integers, ...]:
        """The unknowns, array by array as they are computed."""
        return (self.unknowns,)

    @property
    def is_linear(self) -> bool:
        """Whether the equations are linear in the unknowns."""
        return all(g.template.is_linear(g.inner) for g in self.groups)

    @property
    def externals(self) -> Integers:
        """The variables that the equations read besides the unknowns."""
        read = [*(g.variables.ravel() for g in self.groups), self.sums.nodes]
        nodes = np.unique(np.concatenate(read))
        return nodes[self.places(nodes) < 0]

    def places(self, nodes: Integers) -> Integers:
        """The positions of nodes among the unknowns (-1: not an unknown)."""
        return _places(self.unknowns, nodes)


def sparse_loop(
    system: Equations, members: Sequence[tuple[int, int]], parameters: np.ndarray
) -> SparseLoop:
    """Group equations, each with an unknown, of large loops; find an order of elimination for ``parameters``.

    Raises:
        StructureError: if the equations depend on each other.
    """
    equations, unknowns = [e for e, _ in members], [v for _, v in members]
    nodes = np.asarray(unknowns, dtype=np.int64)
    summing = [e for e in equations if system.template[e].coefficients() is not None]
    groups = _groups(system, equations, set(unknowns))
    sums = _sums(system, summing)
    offset = sum(len(g.variables) for g in groups)
    point = Point(random_values(len(system.structure.derivative)), parameters)
    rows: list[Integers] = []
    columns: list[Integers] = []
    values: list[np.ndarray] = []
    first = 0
    for g in groups:
        for column in g.inner:
            rows.append(first + np.arange(len(g.variables)))
            columns.append(_places(nodes, g.variables[:, column]))
            values.append(partials(g.template, column, g.variables, g.parameters, point))
        first += len(g.variables)
    inside = _places(nodes, sums.nodes)
    rows.append(offset + sums.rows[inside >= 0])
    columns.append(inside[inside >= 0])
    values.append(sums.factors[inside >= 0])
    entries = np.concatenate(rows), np.concatenate(columns), np.concatenate(values)
    try:
        pattern, matched = analyse(*entries, len(nodes)), match_rows(*entries, len(nodes))
    except np.linalg.LinAlgError:
        raise system.singular_loop(equations, unknowns) from None
    return SparseLoop(nodes, groups, sums, pattern, matched)


def _places(unknowns: Integers, nodes: Integers) -> Integers:
    order = np.argsort(unknowns)
    found = np.searchsorted(unknowns[order], nodes).clip(max=len(unknowns) - 1)
    return np.where(unknowns[order][found] == nodes, order[found], -1)


def _groups(system: Equations, equations: list[int], unknowns: set[int]) -> tuple[SparseGroup, ...]:
    """The equations that are not sums, by template and by the slots that are unknown."""
    found: dict[tuple[Statement, tuple[int, ...], str | None], list[int]] = {}
    for e in equations:
        template = system.template[e]
        if template.coefficients() is None:
            inner = tuple(c for c, v in enumerate(system.variables[e]) if v in unknowns)
            found.setdefault((template, inner, system.apart[e]), []).append(e)
    return tuple(
        SparseGroup(
            template,
            inner,
            *system.slots(members),
            tuple(system.origin[e] for e in members),
        )
        for (template, inner, _), members in found.items()
    )


def _sums(system: Equations, equations: list[int]) -> LinearRows:
    lengths = [len(system.variables[e]) for e in equations]
    factors = [c for e in equations for c in system.template[e].coefficients() or ()]
    return LinearRows(
        np.repeat(np.arange(len(equations)), lengths),
        np.asarray([v for e in equations for v in system.variables[e]], dtype=np.int64),
        np.asarray(factors, dtype=float),
        tuple(system.origin[e] for e in equations),
    )
