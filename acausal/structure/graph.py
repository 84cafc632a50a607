"""Graph algorithms of the compiler, on integers alone: matching, index reduction, blocks, diagnosis.

Equations and variables are numbers; ``incidence[e]`` lists the unknowns of equation ``e``. These algorithms do not
depend on the content of an equation.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components, maximum_bipartite_matching

Incidence = Sequence[Sequence[int]]


class Matching:
    """A matching of equations to variables, grown by augmenting paths.

    ``equation_of[v]`` is the equation that variable ``v`` is assigned to, or -1. After a failed
    `augment`, ``colored_equations`` and ``colored_variables`` hold all that the search has reached: the
    smallest set of equations that has too few variables (Pantelides 1988, Duff 1981).
    """

    def __init__(self, n_variables: int) -> None:
        self.equation_of = [-1] * n_variables
        self.colored_equations: list[int] = []
        self.colored_variables: list[int] = []

    def augment(
        self, equation: int, incidence: Incidence, usable: Callable[[int], bool] | None = None
    ) -> bool:
        """Assign ``equation``, re-assigning others along a shortest path; False if there is no path."""
        equation_of = self.equation_of
        reached, through, before = [equation], [-1], [-1]
        seen: set[int] = set()
        for i, current in enumerate(reached):  # which grows: breadth first
            variable = self._free(incidence[current], usable)
            if variable >= 0:
                while i >= 0:
                    equation_of[variable] = reached[i]
                    variable, i = through[i], before[i]
                return True
            for variable in incidence[current]:
                if variable not in seen and (usable is None or usable(variable)):
                    seen.add(variable)
                    reached.append(equation_of[variable])
                    through.append(variable)
                    before.append(i)
        self.colored_equations, self.colored_variables = reached, through[1:]
        return False

    def _free(self, variables: Sequence[int], usable: Callable[[int], bool] | None) -> int:
        for variable in variables:
            if self.equation_of[variable] < 0 and (usable is None or usable(variable)):
                return variable
        return -1


def match(incidence: Incidence, n_variables: int) -> list[int]:
    """A maximum matching: for every equation its variable, or -1 (Hopcroft & Karp 1973)."""
    if not len(incidence):
        return []
    lengths = np.fromiter((len(row) for row in incidence), dtype=np.int32, count=len(incidence))
    pointers = np.concatenate([[0], np.cumsum(lengths)]).astype(np.int32)
    columns = np.fromiter(
        (v for row in incidence for v in row), dtype=np.int32, count=int(pointers[-1])
    )
    ones = np.ones(len(columns), dtype=np.int8)
    graph = csr_array((ones, columns, pointers), shape=(len(incidence), n_variables))
    return maximum_bipartite_matching(graph, perm_type="column").tolist()


@dataclass
class DifferentialStructure:
    """The structure that index reduction extends: equations, and which variable is another's derivative.

    ``derivative[v]`` is the derivative of variable ``v`` or -1; ``successor[e]`` the differentiated equation.
    ``differentiate(e, structure)`` returns the unknowns of the derivative of equation ``e``; it calls
    `derivative_of` for the variables' derivatives.
    """

    incidence: list[list[int]]
    derivative: list[int]
    successor: list[int]
    differentiate: Callable[[int, DifferentialStructure], list[int]]

    def derivative_of(self, variable: int) -> int:
        """The derivative of a variable; a new variable if there was none."""
        if self.derivative[variable] < 0:
            self.derivative[variable] = len(self.derivative)
            self.derivative.append(-1)
        return self.derivative[variable]

    def successor_of(self, equation: int) -> int:
        """The derivative of an equation; a new equation if there was none."""
        if self.successor[equation] < 0:
            row = self.differentiate(equation, self)
            self.successor[equation] = len(self.incidence)
            self.incidence.append(row)
            self.successor.append(-1)
        return self.successor[equation]


def pantelides(structure: DifferentialStructure, max_order: int = 12) -> list[int]:
    """Differentiate equations until the highest derivatives can be matched (Pantelides 1988).

    ``structure`` is extended in place; the return value assigns an equation to every variable (-1: none).
    The caller has made sure that the structure is not singular. As a safeguard, a RecursionError is raised if one
    equation is differentiated more than ``max_order`` times.
    """
    s = structure
    highest = [[v for v in row if s.derivative[v] < 0] for row in s.incidence]
    variable_of = match(highest, len(s.derivative))
    matching = Matching(len(s.derivative))
    for equation, variable in enumerate(variable_of):
        if variable >= 0:
            matching.equation_of[variable] = equation
    for equation in [e for e, v in enumerate(variable_of) if v < 0]:
        current, order = equation, 0
        while not matching.augment(current, s.incidence, lambda v: s.derivative[v] < 0):
            order += 1
            if order > max_order:
                raise RecursionError(equation)
            variables = sorted(set(matching.colored_variables))
            raised = [(v, s.derivative_of(v)) for v in variables]
            equations = sorted(set(matching.colored_equations))
            for e in equations:
                s.successor_of(e)
            matching.equation_of += [-1] * (len(s.derivative) - len(matching.equation_of))
            for variable, derivative in raised:
                matching.equation_of[derivative] = s.successor[matching.equation_of[variable]]
            current = s.successor[current]
    return matching.equation_of


def equations_of(incidence: Incidence, n_variables: int) -> list[list[int]]:
    """The equations that have each variable."""
    found: list[list[int]] = [[] for _ in range(n_variables)]
    for equation, row in enumerate(incidence):
        for variable in row:
            found[variable].append(equation)
    return found


def choose_variables(
    incidence: Incidence, candidates: Sequence[int], n_variables: int
) -> list[int]:
    """Pick one variable for every equation, as early as possible in ``candidates``.

    The sets of variables that can be matched are independent (a transversal matroid), so taking them
    greedily in order of preference is optimal.
    """
    columns = equations_of(incidence, n_variables)
    matching = Matching(len(incidence))
    chosen: list[int] = []
    for variable in candidates:
        if len(chosen) == len(incidence):
            break
        if columns[variable] and matching.augment(variable, columns):
            chosen.append(variable)
    return chosen


@dataclass(frozen=True)
class Blocks:
    """Equations in solving order: ``block[e]`` numbers an equation's block, ``level[b]`` orders the blocks.

    A block depends on blocks of lower level only.
    """

    block: np.ndarray
    level: np.ndarray


def order_blocks(incidence: Incidence, variable_of: Sequence[int], n_variables: int) -> Blocks:
    """Strongly connected blocks of matched equations and their levels (block triangular form, Tarjan 1972)."""
    n = len(incidence)
    owner = np.full(n_variables, -1, dtype=np.int64)
    owner[np.asarray(variable_of, dtype=np.int64)] = np.arange(n)
    lengths = np.fromiter((len(row) for row in incidence), dtype=np.int64, count=n)
    equation = np.repeat(np.arange(n), lengths)
    needs = owner[
        np.fromiter((v for row in incidence for v in row), dtype=np.int64, count=int(lengths.sum()))
    ]
    real = (needs >= 0) & (needs != equation)
    equation, needs = equation[real], needs[real]
    graph = csr_array((np.ones(len(needs), dtype=np.int8), (equation, needs)), shape=(n, n))
    count, label = connected_components(graph, directed=True, connection="strong")
    label = _numbered_as_met(label, count)
    a, b = label[equation], label[needs]
    outside = a != b
    return Blocks(label, _levels(count, a[outside], b[outside]))


def _numbered_as_met(label: np.ndarray, count: int) -> np.ndarray:
    """Labels in the order of their first members: scipy's own order differs between its versions."""
    _, first = np.unique(label, return_index=True)
    number = np.empty(count, dtype=np.int64)
    number[np.argsort(first)] = np.arange(count)
    return number[label]


def _levels(n: int, later: np.ndarray, earlier: np.ndarray) -> np.ndarray:
    """Longest distance of every node from the sources of an acyclic graph."""
    level = np.zeros(n, dtype=np.int64)
    waiting = np.bincount(later, minlength=n)
    order = np.argsort(earlier, kind="stable")
    targets = later[order]
    start = np.searchsorted(earlier[order], np.arange(n + 1))
    ready = np.flatnonzero(waiting == 0)
    depth = 0
    while len(ready):
        level[ready] = depth
        spans = [targets[start[i] : start[i + 1]] for i in ready]
        reached = np.concatenate(spans) if spans else targets[:0]
        touched, times = np.unique(reached, return_counts=True)
        waiting[touched] -= times
        ready = touched[waiting[touched] == 0]
        depth += 1
    return level


@dataclass(frozen=True)
class Singularity:
    """The overdetermined and underdetermined parts of a structure (Dulmage & Mendelsohn 1958)."""

    equations: tuple[int, ...]
    """Equations of the overdetermined part."""
    unmatched_equations: tuple[int, ...]
    variables: tuple[int, ...]
    """Variables of the underdetermined part."""
    unmatched_variables: tuple[int, ...]


def singularity(
    incidence: Incidence, n_variables: int, unknowns: Sequence[int]
) -> Singularity | None:
    """The singular parts of a structure, or None if every unknown can be matched to an equation."""
    variable_of = match(incidence, n_variables)
    equation_of = [-1] * n_variables
    for e, v in enumerate(variable_of):
        if v >= 0:
            equation_of[v] = e
    surplus = [e for e, v in enumerate(variable_of) if v < 0]
    missing = [v for v in unknowns if equation_of[v] < 0]
    if not surplus and not missing:
        return None
    equations = equations_of(incidence, n_variables)
    over = _reach(surplus, lambda e: [equation_of[v] for v in incidence[e] if equation_of[v] >= 0])
    under = _reach(missing, lambda v: [variable_of[e] for e in equations[v] if variable_of[e] >= 0])
    return Singularity(tuple(over), tuple(surplus), tuple(under), tuple(missing))


def _reach(start: Sequence[int], following: Callable[[int], Sequence[int]]) -> list[int]:
    found = dict.fromkeys(start)
    queue = list(start)
    while queue:
        for node in following(queue.pop()):
            if node not in found:
                found[node] = None
                queue.append(node)
    return sorted(found)
