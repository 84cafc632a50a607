"""Matching, index reduction, blocks and diagnosis on integers."""

import itertools
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.sparse.csgraph import connected_components

from acausal.structure import graph
from acausal.structure.graph import (
    DifferentialStructure,
    Matching,
    choose_variables,
    match,
    order_blocks,
    pantelides,
    singularity,
)

incidences = st.integers(1, 6).flatmap(
    lambda n: st.lists(
        st.lists(st.integers(0, n - 1), max_size=n, unique=True).map(sorted), min_size=n, max_size=n
    )
)


def largest_matching(incidence, n):
    """By trying all assignments."""
    choices = [[*row, None] for row in incidence]
    fits = ([v for v in chosen if v is not None] for chosen in itertools.product(*choices))
    return max((len(v) for v in fits if len(set(v)) == len(v)), default=0)


# -- matching ---------------------------------------------------------------------------------------------


@given(incidences)
def test_match_is_a_maximum_matching(incidence):
    n = len(incidence)
    found = match(incidence, n)
    used = [v for v in found if v >= 0]
    assert len(set(used)) == len(used)
    assert all(v < 0 or v in row for v, row in zip(found, incidence, strict=True))
    assert len(used) == largest_matching(incidence, n)


@given(incidences)
def test_augmenting_finds_as_many_and_colours_what_is_too_narrow(incidence):
    n = len(incidence)
    matching = Matching(n)
    count = 0
    for equation in range(n):
        if matching.augment(equation, incidence):
            count += 1
            continue
        coloured = set(matching.colored_equations)
        reached = {v for e in coloured for v in incidence[e]}
        assert equation in coloured
        assert reached == set(matching.colored_variables)
        assert len(reached) == len(coloured) - 1
    assert count == largest_matching(incidence, n)


def test_augmenting_respects_what_is_usable():
    matching = Matching(3)
    assert matching.augment(0, [[0, 1], [0]], lambda v: v != 0)
    assert matching.equation_of == [-1, 0, -1]
    assert not matching.augment(1, [[0, 1], [0]], lambda v: v != 0)


def test_nothing_to_match():
    assert match([], 3) == []


def test_a_long_augmenting_path_needs_no_recursion():
    n = 20_000
    matching = Matching(n + 1)
    incidence = [[i, i + 1] for i in range(n)] + [[0]]
    for equation in range(n + 1):
        assert matching.augment(equation, incidence)
    assert matching.equation_of[0] == n


# -- index reduction ----------------------------------------------------------------------------------------


class Dae:
    """Equations as lists of (variable, order); derivatives are numbered as they are needed."""

    def __init__(self, n_variables, equations):
        self.of = {}
        self.structure = DifferentialStructure(
            incidence=[],
            derivative=[-1] * n_variables,
            successor=[],
            differentiate=self.differentiate,
        )
        for equation in equations:
            self.structure.incidence.append([self.number(v, n) for v, n in equation])
            self.structure.successor.append(-1)

    def number(self, variable, order):
        for _ in range(order):
            variable = self.structure.derivative_of(variable)
        return variable

    def differentiate(self, equation, structure):
        row = structure.incidence[equation]
        return sorted({*row, *(structure.derivative_of(v) for v in row)})

    def orders(self):
        """How often each of the given equations was differentiated."""
        n = len(self.structure.incidence)
        successor = self.structure.successor
        derived = set(successor)
        found = []
        for e in [e for e in range(n) if e not in derived]:
            order = 0
            while (e := successor[e]) >= 0:
                order += 1
            found.append(order)
        return found


def test_pantelides_on_the_pendulum():
    # x'' = -lx, y'' = -ly - g, x^2 + y^2 = 1 (Pantelides 1988): the constraint twice
    x, y, lam = 0, 1, 2
    dae = Dae(3, [[(x, 0), (x, 2), (lam, 0)], [(y, 0), (y, 2), (lam, 0)], [(x, 0), (y, 0)]])
    assigned = pantelides(dae.structure)
    assert dae.orders() == [0, 0, 2]
    highest = [v for v, d in enumerate(dae.structure.derivative) if d < 0]
    assert sorted(assigned[v] for v in highest) == [
        0,
        1,
        dae.structure.successor[dae.structure.successor[2]],
    ]


def test_pantelides_in_first_order_form_differentiates_the_kinematics_too():
    # x' = u, y' = v, u' = -lx, v' = -ly, x^2 + y^2 = 1
    x, y, u, v, lam = range(5)
    dae = Dae(
        5,
        [
            [(x, 1), (u, 0)],
            [(y, 1), (v, 0)],
            [(u, 1), (lam, 0), (x, 0)],
            [(v, 1), (lam, 0), (y, 0)],
            [(x, 0), (y, 0)],
        ],
    )
    pantelides(dae.structure)
    assert dae.orders() == [1, 1, 0, 0, 2]


def test_pantelides_leaves_an_ordinary_system_alone():
    dae = Dae(2, [[(0, 1), (1, 0)], [(1, 1), (0, 0)]])
    pantelides(dae.structure)
    assert dae.orders() == [0, 0]


@pytest.mark.parametrize("n", [2, 3, 6])
def test_a_chain_of_integrators_behind_a_given_signal(n):
    # x1 given, x1' = x2, x2' = x3, ...: the last needs n - 1 derivatives of the first
    equations = [[(0, 0)]] + [[(i, 1), (i + 1, 0)] for i in range(n - 1)]
    dae = Dae(n, equations)
    pantelides(dae.structure)
    assert dae.orders() == [n - 1, *range(n - 2, -1, -1)]


def test_pantelides_gives_up_on_what_does_not_end():
    dae = Dae(
        2,
        [
            [(0, 0), (0, 1)],
            [(0, 0)],
        ],
    )
    with pytest.raises(RecursionError):
        pantelides(dae.structure)


# -- choosing -------------------------------------------------------------------------------------------------


@given(incidences, st.permutations(range(6)))
def test_chosen_variables_are_the_earliest_that_can_be_matched(incidence, preference):
    n = len(incidence)
    candidates = [v for v in preference if v < n]
    chosen = choose_variables(incidence, candidates, n)
    possible = [
        c
        for c in itertools.combinations(candidates, largest_matching(incidence, n))
        if largest_matching([[v for v in row if v in c] for row in incidence], n) == len(c)
    ]
    rank = {v: i for i, v in enumerate(candidates)}
    assert [rank[v] for v in chosen] == min([rank[v] for v in c] for c in possible)


# -- blocks ---------------------------------------------------------------------------------------------------


def test_blocks_and_levels():
    # 0: a; 1: b(a, c); 2: c(b); 3: d(c); 4: e
    incidence = [[0], [0, 1, 2], [1, 2], [2, 3], [4]]
    blocks = order_blocks(incidence, [0, 1, 2, 3, 4], 5)
    block, level = blocks.block, blocks.level
    assert block[1] == block[2]
    assert len(set(block.tolist())) == 4
    assert level[block].tolist() == [0, 1, 1, 2, 0]


@given(incidences)
def test_blocks_depend_on_lower_levels_only(incidence):
    incidence = [sorted({*row, i}) for i, row in enumerate(incidence)]
    n = len(incidence)
    blocks = order_blocks(incidence, list(range(n)), n)
    reach = np.eye(n, dtype=bool)
    for e, row in enumerate(incidence):
        reach[e, row] = True
    for _ in range(n):
        reach = reach @ reach
    same = reach & reach.T
    np.testing.assert_array_equal(blocks.block[:, None] == blocks.block, same)
    level = blocks.level[blocks.block]
    for e, row in enumerate(incidence):
        assert all(level[v] < level[e] or same[e, v] for v in row)


def test_the_order_does_not_depend_on_scipys_numbers(monkeypatch):
    """Versions of scipy number the components that they find in different orders."""
    incidence = [[0], [0, 1, 2], [1, 2], [2, 3], [4]]
    blocks = order_blocks(incidence, [0, 1, 2, 3, 4], 5)

    def backwards(edges, **how):
        count, label = connected_components(edges, **how)
        return count, count - 1 - label

    monkeypatch.setattr(graph, "connected_components", backwards)
    again = order_blocks(incidence, [0, 1, 2, 3, 4], 5)
    assert again.block.tolist() == blocks.block.tolist() == [0, 1, 1, 2, 3]
    assert again.level.tolist() == blocks.level.tolist()


# -- diagnosis ------------------------------------------------------------------------------------------------


def test_a_sound_structure_has_no_singularity():
    assert singularity([[0, 1], [0]], 2, range(2)) is None


def test_over_and_underdetermined_parts():
    # 0, 1 both say a; 2 relates b, c; 3: d
    found = singularity([[0], [0], [1, 2], [3]], 4, range(4))
    assert found is not None
    assert found.equations == (0, 1)
    assert len(found.unmatched_equations) == 1
    assert found.variables == (1, 2)
    assert len(found.unmatched_variables) == 1


def test_an_equation_without_unknowns_is_too_much():
    found = singularity([[], [0]], 1, range(1))
    assert found is not None
    assert found.unmatched_equations == (0,)


@pytest.mark.slow
def test_the_graph_needs_neither_sympy_nor_jax():
    # the files themselves: front doors import everything
    code = """
import sys, types
for name in ("acausal", "acausal.structure"):
    package = sys.modules[name] = types.ModuleType(name)
    package.__path__ = [name.replace(".", "/")]
import acausal.structure.elimination_order, acausal.structure.graph, acausal.structure.rank, acausal.structure.tearing
print([m for m in ("sympy", "jax") if m in sys.modules])
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
