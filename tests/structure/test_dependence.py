"""Dependences of a computation: all of them, each once, and none of what is not wanted."""

from __future__ import annotations

import numpy as np
import pytest

from acausal.structure.dependence import Computation, dependence


def table(results, reads):
    """Rows that compute ``results[i]`` from ``reads[i]``."""
    return Computation(len(results), *_pairs(results), *_pairs(reads))


def _pairs(lists):
    """Two arrays: row and member."""
    found = [(i, member) for i, members in enumerate(lists) for member in members]
    return np.asarray(found, dtype=int).reshape(-1, 2).T


def pairs(*args, **options):
    return list(zip(*(a.tolist() for a in dependence(*args, **options)), strict=True))


@pytest.mark.parametrize("seed", range(20))
def test_like_products_of_boolean_matrices(seed):
    generator = np.random.default_rng(seed)
    n_sources, n_nodes = 6, 40
    expected = np.zeros((n_nodes, n_sources), dtype=bool)
    sources = generator.permutation(n_sources)
    expected[sources, np.arange(n_sources)] = True
    computations, known = [], n_sources
    while known < n_nodes - 6:
        results = [list(range(known + 2 * i, known + 2 * i + 1 + i % 2)) for i in range(3)]
        reads = [generator.integers(0, known, generator.integers(0, 4)) for _ in results]
        for own, read in zip(results, reads, strict=True):
            expected[own] = expected[read].any(axis=0)
        computations.append(table(results, reads))
        known += 6
    wanted = generator.integers(0, n_nodes, 10)
    found = pairs(computations, sources, wanted, n_nodes, most=10_000)
    assert found == list(zip(*(a.tolist() for a in np.nonzero(expected[wanted])), strict=True))


def test_what_is_not_wanted_costs_nothing():
    n = 100
    sources = np.arange(n)
    total = table([[n]], [range(n)])
    copies = table([[n + 1 + i] for i in range(n)], [[n, i] for i in range(n)])
    assert pairs([total, copies], sources, sources, 2 * n + 1, most=n) == [(i, i) for i in range(n)]
    assert dependence([total, copies], sources, n + 1 + np.arange(n), 2 * n + 1, most=n) is None


def test_without_sources_there_are_no_dependences():
    nothing = np.zeros(0, dtype=int)
    assert pairs([table([[0]], [[]])], nothing, nothing, 1, 10) == []
    assert pairs([table([[0]], [[]])], nothing, np.asarray([0]), 1, 10) == []
