"""The pattern of ``d(dx/dt)/dx``: which states the derivative of each state depends on, from templates and integers."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from acausal.flattening import Integers
from acausal.structure.algebraic_loops import TornLoop
from acausal.structure.blocks import Accumulation, Assignment
from acausal.structure.dependence import Computation, dependence
from acausal.structure.reduced_model import ReducedModel
from acausal.structure.sparse_loops import SparseLoop


def jacobian_pattern(
    reduced: ReducedModel, most: int, opened: Collection[int] = ()
) -> tuple[int, Integers, Integers] | None:
    """Number of rows, and rows and columns of the entries that may differ from zero; None if there are too many.

    Every unknown of an algebraic loop depends on all that the equations of its loop read. Where loops are opened, their
    unknowns are columns behind the states, and the equations matched to them are rows.

    Arguments:
        most: how many dependences may be listed, also of variables that are not states.
        opened: numbers of steps that are algebraic loops.
    """
    computations: list[Computation] = []
    sources, wanted = [reduced.states], [reduced.rates]
    n_nodes = len(reduced.derivative)
    for i, step in enumerate(reduced.steps):
        if i in opened:
            assert isinstance(step, SparseLoop | TornLoop)
            sources.append(np.concatenate(step.results))
            wanted.append(n_nodes + np.arange(len(sources[-1])))
            rows = _matched_torn(step) if isinstance(step, TornLoop) else _matched_sparse(step)
            computations.append(
                Computation(len(wanted[-1]), wanted[-1] - n_nodes, wanted[-1], *rows)
            )
            n_nodes += len(wanted[-1])
        else:
            computations.append(_COMPUTATION[type(step)](step))
    columns = np.concatenate(sources)
    found = dependence(computations, columns, np.concatenate(wanted), n_nodes, most)
    return None if found is None else (len(columns), *found)


def dependence_pattern(
    reduced: ReducedModel, wanted: Integers, sources: Integers, most: int
) -> tuple[Integers, Integers] | None:
    """The pairs (i, j) for which node ``wanted[i]`` depends on node ``sources[j]``; None for more than ``most``."""
    computations = [_COMPUTATION[type(step)](step) for step in reduced.steps]
    return dependence(computations, sources, wanted, len(reduced.derivative), most)


def _pairs(table: Integers, first: int = 0) -> tuple[Integers, Integers]:
    """The number of a row, counted from ``first``, with each entry of it."""
    rows, columns = table.shape
    return np.repeat(np.arange(first, first + rows), columns), table.ravel()


def _table(results: Integers, reads: Integers) -> Computation:
    """Rows that compute ``results[i]`` from ``reads[i]``."""
    return Computation(len(results), *_pairs(results), *_pairs(reads))


def _assignment(step: Assignment) -> Computation:
    solved = step.template.solved(step.column)
    assert solved is not None
    present = solved.free_symbols
    read = [i for i, s in enumerate(step.template.variables) if s in present]
    return _table(step.unknowns[:, None], step.variables[:, read])


def _accumulation(step: Accumulation) -> Computation:
    return _table(step.unknowns[:, None], step.terms)


def _sparse_loop(loop: SparseLoop) -> Computation:
    """Loops of one level are solved together, but each depends on its own equations only."""
    rows, nodes = _reads(loop)
    n = len(loop.unknowns)
    shape = (2 * n, 2 * n)  # unknowns, then equations
    edges = loop.pattern.columns, n + loop.pattern.rows
    n_loops, member = connected_components(coo_array((np.ones(len(edges[0])), edges), shape=shape))
    outside = loop.places(nodes) < 0
    reading = member[n:][rows[outside]]
    return Computation(n_loops, member[:n], loop.unknowns, reading, nodes[outside])


def _matched_sparse(loop: SparseLoop) -> tuple[Integers, Integers]:
    """Pairs of an unknown and a node that the equation matched to it reads."""
    rows, nodes = _reads(loop)
    return np.argsort(loop.matched)[rows], nodes


def _matched_torn(loop: TornLoop) -> tuple[Integers, Integers]:
    """The same; loops of one shape lie side by side, the first unknown of all before the second of all."""
    size = len(loop.unknowns)
    known = np.concatenate(
        [loop.unknowns, loop.externals[:, ::-1]], axis=1
    )  # by code, also negative
    read = [known[:, list(loop.shape.equations[e].variables)] for e in loop.shape.matched]
    rows, nodes = zip(*(_pairs(r, k * size) for k, r in enumerate(read)), strict=True)
    return np.concatenate(rows), np.concatenate(nodes)


def _reads(loop: SparseLoop) -> tuple[Integers, Integers]:
    """Pairs of an equation and a node that it reads."""
    offset, pairs = 0, list[tuple[Integers, Integers]]()
    for group in loop.groups:
        pairs.append(_pairs(group.variables, offset))
        offset += len(group.variables)
    pairs.append((offset + loop.sums.rows, loop.sums.nodes))
    rows, nodes = zip(*pairs, strict=True)
    return np.concatenate(rows), np.concatenate(nodes)


_COMPUTATION: dict[type, Callable[[Any], Computation]] = {
    Assignment: _assignment,
    Accumulation: _accumulation,
    TornLoop: lambda loop: _table(loop.unknowns, loop.externals),
    SparseLoop: _sparse_loop,
}
"""By kind of step, what it computes from what."""
