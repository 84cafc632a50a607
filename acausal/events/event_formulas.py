"""Events as formulas: conditions that are watched, discrete variables in order, and states that jump.

`acausal.events.zero_crossings` computes them with JAX.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
import sympy as sp

from acausal.codegen import DISCRETE, ArrayFormula, ParameterLayout, Program, formula_of
from acausal.flattening import GuardGroup, Integers, LeavesCaches, UpdateGroup
from acausal.modeling import time
from acausal.structure import ReducedModel, dependence_pattern

MOST_DEPENDENCES = 1_000_000
"""So many dependences of conditions on states are listed at most; of more, only what they read itself."""


@dataclass(frozen=True)
class Update:
    """A formula, and where its values go; it reads what was before the event in a second copy of the program's arrays.

    Attributes:
        places: in the discrete variables, or the states. signs: what they are multiplied by before.
        components: (n,) by number, which component states each. text: how.
    """

    formula: ArrayFormula
    places: Integers
    signs: Integers
    components: Integers
    text: str


@dataclass(frozen=True)
class Guard(Update):
    """Conditions ``formula > 0``, or ``>= 0`` unless ``strict``.

    Attributes:
        ticks: whether they are clocks'.
        timed: whether their time is known from parameters and discrete variables.
    """

    strict: bool
    ticks: bool
    timed: bool


@dataclass(frozen=True, eq=False)
class Events(LeavesCaches):
    """What holds at events of a model.

    The discrete variables begin with the conditions, in order of the guards.

    Attributes:
        program: of the model. layout: of its parameters.
        guards: the conditions. updates: the discrete variables, those that others read first. jumps: of states.
        exact: which discrete variables are whole numbers or truth values, shape (n_discrete,).
        resets: places of conditions that depend on a state, and of what makes it jump when both come true, in pairs of
            shape (n, 2).
    """

    program: Program
    layout: ParameterLayout
    guards: tuple[Guard, ...]
    updates: tuple[Update, ...]
    jumps: tuple[Update, ...]
    exact: np.ndarray
    resets: np.ndarray

    @cached_property
    def n_guards(self) -> int:
        """How many conditions are watched."""
        return sum(g.formula.size for g in self.guards)

    @cached_property
    def timed(self) -> np.ndarray:
        """Which conditions have a known time, shape (n_guards,)."""
        return self._each([g.timed for g in self.guards])

    @cached_property
    def strict(self) -> np.ndarray:
        """Which conditions are false at zero, shape (n_guards,)."""
        return self._each([g.strict for g in self.guards])

    @cached_property
    def ticks(self) -> np.ndarray:
        """Which conditions are clocks', shape (n_guards,)."""
        return self._each([g.ticks for g in self.guards])

    @cached_property
    def n_through(self) -> int:
        """How many discrete variables may read others, of the same event, by way of variables that are computed."""

        def reads(update: Update) -> bool:
            needed = self.program.needed(self.program.in_copy(update.formula.sources, 0))
            return any(DISCRETE in self.program.instructions[i].sources for i in needed)

        return sum(int((~self.exact[u.places]).sum()) for u in self.updates if reads(u))

    @cached_property
    def sampled(self) -> tuple[int, ...]:
        """Places of discrete variables that take what varies at the instants of clocks, as sampled controllers do."""
        takes: set[int] = set()
        reads: list[tuple[int, int]] = []
        for update in self.updates:
            now = self.program.in_copy(update.formula.sources, 0)
            if any(source != DISCRETE for source in now):
                takes |= set(update.places.tolist())
            reads += _reads(update, DISCRETE, self.program)
        ticking = set(np.flatnonzero(self.ticks).tolist())
        while more := {place for place, read in reads if read in ticking} - ticking:
            ticking |= more
        return tuple(sorted(takes & ticking))

    def _each(self, flags: Sequence[bool]) -> np.ndarray:
        return np.repeat(np.asarray(flags, bool), [g.formula.size for g in self.guards])

    @cached_property
    def clocks(self) -> Events:
        """These with the conditions of clocks alone."""
        return replace(self, guards=tuple(guard for guard in self.guards if guard.ticks))

    def describe(self, place: int) -> str:
        """A condition, or what gives a discrete variable, and the component that states it; empty if nothing does."""
        component, text = self._stated.get(place, ("", ""))
        return f"{component}: {text}" if component else text

    def component(self, place: int) -> str:
        """The dotted path of the component that states it; empty for the model itself."""
        return self._stated[place][0]

    @cached_property
    def _stated(self) -> dict[int, tuple[str, str]]:
        """By place of a discrete variable, the component and the text."""
        paths = self.layout.model.layout.paths
        return {
            place: (paths[component], each.text)
            for each in (*self.updates, *self.guards)
            for place, component in zip(each.places.tolist(), each.components.tolist(), strict=True)
        }


def generate_events(
    reduced: ReducedModel, program: Program, layout: ParameterLayout
) -> Events | None:
    """The events of a model; None if it has none."""
    if not len(reduced.discrete):
        return None
    stated, update = reduced.model.events, partial(_update, reduced, program, layout)
    guards = tuple(_guard(group, update(group), program) for group in stated.guards)
    jumps = tuple(map(update, stated.jumps))
    order = _in_order(list(map(update, stated.updates)), len(reduced.discrete), program)
    updates = tuple(update(stated.updates[i], rows) for i, rows in order)
    exact = np.zeros(len(reduced.discrete), dtype=bool)
    for variable in reduced.model.discrete.tolist():
        kind = getattr(reduced.model.layout.variable_declaration(variable), "kind", "real")
        exact[program.positions[1][reduced.resolve(variable)[0]]] |= kind != "real"
    resets = _resets(reduced, jumps, updates, program)
    return Events(program, layout, guards, updates, jumps, exact, resets)


def _update(
    reduced: ReducedModel,
    program: Program,
    layout: ParameterLayout,
    group: UpdateGroup,
    rows: Integers | None = None,
) -> Update:
    rows = np.arange(len(group.targets)) if rows is None else rows
    own = group.group.rows(rows)
    nodes, signs = zip(*(reduced.resolve(int(v)) for v in group.targets[rows]), strict=True)
    formula = formula_of(own, reduced, program, layout, copies=group.previous)
    places = program.positions[1][np.asarray(nodes)]
    return Update(formula, places, np.asarray(signs), own.components, own.origins[0].text)


def _guard(group: GuardGroup, own: Update, program: Program) -> Guard:
    arguments, expression = own.formula.arguments, own.formula.expression
    fixed = all(s % len(program.nodes) == DISCRETE for s in arguments.sources)
    rate = expression.diff(time) if fixed and not arguments.modules else sp.S.Zero
    timed = rate != 0 and rate.free_symbols <= {s for s, _ in arguments.parameters}
    return Guard(**vars(own), strict=group.strict, ticks=group.ticks, timed=timed)


def _in_order(updates: list[Update], n: int, program: Program) -> list[tuple[int, Integers]]:
    """Rows of updates in order: one of n discrete variables that others read, at the same event, comes before them."""
    level = np.zeros(n, dtype=np.int64)
    reads = [pair for u in updates for pair in _reads(u, DISCRETE, program)]
    for _ in range(n):
        before = level.copy()
        for own, other in reads:
            if own != other:
                level[own] = min(max(level[own], level[other] + 1), n)
        if (level == before).all():
            break
    parts = [(number, i) for i, u in enumerate(updates) for number in np.unique(level[u.places])]
    return [(i, np.flatnonzero(level[updates[i].places] == number)) for number, i in sorted(parts)]


def _resets(
    reduced: ReducedModel,
    jumps: Sequence[Update],
    updates: Sequence[Update],
    program: Program,
) -> np.ndarray:
    """See `Events.resets`; the edge of a discrete variable reads what it was before."""
    parts: dict[int, list[int]] = {}
    for update in updates:
        for place, part in _reads(update, DISCRETE, program):
            parts.setdefault(place, []).append(part)

    def conditions(place: int) -> set[int]:
        """All places that a discrete variable is computed from, and its own."""
        found, left = {place}, [place]
        while left:
            new = set(parts.get(left.pop(), ())) - found
            found |= new
            left += new
        return found

    before = len(program.nodes) + DISCRETE
    edges = {pair for jump in jumps for pair in _reads(jump, before, program)}
    caused: dict[tuple[int, int], list[int]] = {}
    for state, edge in edges:
        for place in conditions(edge):
            caused.setdefault((state, place), []).append(edge)
    none = np.zeros((0, 2), dtype=np.int64)
    read: list[tuple[int, int]] = []
    for group in reduced.model.events.guards:
        for target, row in zip(group.targets.tolist(), group.group.variables.tolist(), strict=True):
            place = int(program.positions[1][reduced.resolve(target)[0]])
            nodes = map(reduced.resolve_derivative, row, group.group.template.orders)
            read += [(place, node[0]) for node in nodes if node is not None]
    jumping = reduced.states[sorted({state for state, _ in caused})]
    if not len(jumping) or not read:
        return none
    places, wanted = np.asarray(read).T
    depends = dependence_pattern(reduced, wanted, jumping, MOST_DEPENDENCES)
    found: set[tuple[int, int]] = set()
    for i, j in zip(*(depends or np.nonzero(wanted[:, None] == jumping)), strict=True):
        pair = int(program.positions[1][jumping[j]]), int(places[i])
        found |= {(pair[1], edge) for edge in caused.get(pair, ())}
    return np.asarray(sorted(found), dtype=np.int64) if found else none


def _reads(update: Update, array: int, program: Program) -> Iterator[tuple[int, int]]:
    """The places that values go to, each with a place in an array that it is computed from; row by row."""
    size = update.formula.size
    gathers = [g.positions(program.sizes * 2) for _, g in update.formula.arguments.variables]
    columns = [[np.broadcast_to(side, size).tolist() for side in sides] for sides in gathers]
    for row, place in enumerate(update.places.tolist()):
        for source, index in columns:
            if source[row] == array:
                yield place, index[row]
