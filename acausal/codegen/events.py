"""What holds at events, as data: conditions that are watched, discrete variables in order, and states that jump.

`acausal.codegen.event_values` computes it with JAX.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import sympy as sp

from acausal.codegen.equation_formula import formula_of
from acausal.codegen.instructions import Formula
from acausal.codegen.parameters import ParameterLayout
from acausal.codegen.program import DISCRETE, Program
from acausal.flattening import EquationGroup, GuardGroup, Integers, LeavesCaches, UpdateGroup
from acausal.modeling import time
from acausal.structure import ReducedModel


@dataclass(frozen=True)
class Update:
    """A formula, and where its values go.

    Attributes:
        places: in the discrete variables, or the states. signs: what they are multiplied by before.
    """

    formula: Formula
    places: Integers
    signs: Integers


@dataclass(frozen=True)
class Guard:
    """Conditions ``formula > 0``, or ``>= 0`` unless ``strict``.

    Attributes:
        ticks: whether they are clocks'.
        timed: whether their time is known from parameters and discrete variables.
    """

    formula: Formula
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
        resets: which conditions read a state that jumps when they come true, shape (n_guards,).
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

    def _each(self, flags: Sequence[bool]) -> np.ndarray:
        return np.repeat(np.asarray(flags, bool), [g.formula.size for g in self.guards])

    @cached_property
    def clocks(self) -> Events:
        """These with the conditions of clocks alone."""
        return replace(self, guards=tuple(guard for guard in self.guards if guard.ticks))

    def describe(self, guard: int) -> str:
        """A condition, and the component that watches it."""
        component, text = self._stated[guard]
        return f"{component}: {text}" if component else text

    def component(self, guard: int) -> str:
        """The dotted path of the component that states a condition; empty for the model itself."""
        return self._stated[guard][0]

    @cached_property
    def _stated(self) -> list[tuple[str, str]]:
        """Of every condition, the component and the text."""
        model = self.layout.model
        found: list[tuple[str, str]] = []
        for group in model.events.guards:
            text = group.group.origins[0].text
            found += [(model.layout.paths[c], text) for c in group.group.components]
        return found


def generate_events(
    reduced: ReducedModel, program: Program, layout: ParameterLayout
) -> Events | None:
    """The events of a model; None if it has none."""
    if not len(reduced.discrete):
        return None
    return _Generator(reduced, program, layout).events()


class _Generator:
    def __init__(self, reduced: ReducedModel, program: Program, layout: ParameterLayout) -> None:
        self.reduced, self.program, self.layout = reduced, program, layout
        n = len(reduced.derivative)
        self.place = np.full(n, -1, dtype=np.int64)
        self.place[reduced.discrete] = np.arange(len(reduced.discrete))
        self.state = np.full(n, -1, dtype=np.int64)
        self.state[reduced.states] = np.arange(len(reduced.states))

    def events(self) -> Events:
        """All of them."""
        model = self.reduced.model
        guards = [self._guard(g) for g in model.events.guards]
        updates = [f for level in self._levels() for f in level]
        jumps = [self._update(g, np.arange(len(g.targets)), self.state) for g in model.events.jumps]
        return Events(
            self.program,
            self.layout,
            tuple(guards),
            tuple(updates),
            tuple(jumps),
            self._exact(),
            self._resets(),
        )

    def _resets(self) -> np.ndarray:
        """Which conditions read a state that jumps when they come true."""
        model = self.reduced.model
        jumps: set[tuple[int, int]] = set()
        for group in model.events.jumps:
            before = np.asarray(group.previous, bool)  # an edge reads what the condition was
            for target, row in zip(group.targets, group.group.variables[:, before], strict=True):
                state = int(self.state[self.reduced.resolve(int(target))[0]])
                jumps |= {
                    (state, int(self.place[self.reduced.resolve(v)[0]])) for v in row.tolist()
                }
        reads: list[list[int]] = []
        for group in model.events.guards:
            now = np.equal(group.group.template.orders, 0) & ~np.asarray(group.previous, bool)
            reads += group.group.variables[:, now].tolist()
        places = [[int(self.state[self.reduced.resolve(v)[0]]) for v in row] for row in reads]
        found = [any((p, i) in jumps for p in row) for i, row in enumerate(places)]
        return np.array(found, dtype=bool)

    def _exact(self) -> np.ndarray:
        model = self.reduced.model
        exact = np.zeros(len(self.reduced.discrete), dtype=bool)
        for variable in model.discrete.tolist():
            declared = model.layout.variable_declaration(variable)
            kind = getattr(declared, "kind", "real")
            exact[self.place[self.reduced.resolve(variable)[0]]] |= kind != "real"
        return exact

    def _guard(self, group: GuardGroup) -> Guard:
        formula = self._formula(group.group, group.previous)
        fixed = all(s % len(self.program.nodes) == DISCRETE for s in formula.sources)
        rate = (
            formula.expression.diff(time) if fixed and not formula.arguments.modules else sp.S.Zero
        )
        timed = rate != 0 and rate.free_symbols <= {s for s, _ in formula.arguments.parameters}
        return Guard(formula, group.strict, group.ticks, timed)

    def _update(self, group: UpdateGroup, rows: Integers, places: Integers) -> Update:
        formula = self._formula(group.group.rows(rows), group.previous)
        targets = [self.reduced.resolve(int(v)) for v in group.targets[rows]]
        nodes, signs = (np.asarray(side) for side in zip(*targets, strict=True))
        return Update(formula, places[nodes], signs)

    def _formula(self, group: EquationGroup, previous: Sequence[bool]) -> Formula:
        """A formula; what was before the event is read in the second copy of the program's arrays."""
        return formula_of(group, self.reduced, self.program, self.layout, copies=previous)

    def _levels(self) -> list[list[Update]]:
        """The discrete variables in order: one that others read, at the same event, comes before them."""
        groups = self.reduced.model.events.updates
        level = np.zeros(len(self.reduced.discrete), dtype=np.int64)
        reads: list[tuple[int, list[int]]] = []
        for group in groups:
            now = [i for i, previous in enumerate(group.previous) if not previous]
            for target, row in zip(group.targets, group.group.variables[:, now], strict=True):
                nodes = [self.reduced.resolve(int(v))[0] for v in row]
                own = int(self.place[self.reduced.resolve(int(target))[0]])
                reads.append((own, [int(p) for n in nodes if (p := self.place[n]) >= 0]))
        for _ in range(len(level)):
            before = level.copy()
            for own, others in reads:
                level[own] = min(
                    max([level[own], *(level[o] + 1 for o in others if o != own)]), len(level)
                )
            if (level == before).all():
                break
        found: dict[int, list[Update]] = {}
        for group in groups:
            own = level[[self.place[self.reduced.resolve(int(v))[0]] for v in group.targets]]
            for number in np.unique(own):
                rows = np.flatnonzero(own == number)
                found.setdefault(int(number), []).append(self._update(group, rows, self.place))
        return [found[number] for number in sorted(found)]
