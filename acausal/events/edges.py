"""Edges: the times, known ahead, at which a right-hand side jumps or bends, and how long a step may be meanwhile.

They are read from the formulas of a program; `acausal.events.lines` walks each of them. Lines are followed from one
formula to the next, so a threshold behind a ramp is found, too. Nothing is listed ahead: the next edge is computed from
the present time, with traced parameters, and it can be differentiated by them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import sympy as sp
from jax import Array
from jax.typing import ArrayLike

from acausal.codegen import (
    DISCRETE,
    ZERO,
    Accumulate,
    Arguments,
    ArrayFormula,
    Gather,
    Instruction,
    Packed,
    Program,
    SolveTornLoop,
    UnlikeFormulas,
    Values,
    add_up,
    compute,
    fill,
    read_elements,
)
from acausal.events.lines import (
    NOTHING,
    PART_OF_PERIOD,
    Ahead,
    Line,
    Walk,
    has_edges,
    merged,
)
from acausal.events.zero_crossings import arrays_for
from acausal.flattening import BENT, WAVES, LeavesCaches, is_foreseen, is_straight
from acausal.modeling import time


@dataclass(frozen=True, eq=False)
class _Part:
    """A formula or a sum, and the array that it fills; its other symbols are unknown.

    Attributes:
        is_condition: whether it gives the numbers of a condition, so that its jumps are events.
    """

    formula: ArrayFormula | Accumulate
    fills: int | None = None
    is_condition: bool = False

    @property
    def sources(self) -> set[int]:
        """The arrays that are read."""
        return self.formula.sources

    @property
    def expression(self) -> sp.Expr:
        """That of a formula; nothing for a sum, which has no edges of its own."""
        return self.formula.expression if isinstance(self.formula, ArrayFormula) else sp.S.Zero

    @property
    def arguments(self) -> Arguments:
        """Those of a formula."""
        return self.formula.arguments if isinstance(self.formula, ArrayFormula) else Arguments()

    def is_known(self, known: set[int]) -> bool:
        """Whether the value follows from time, parameters and known arrays."""
        free = self.expression.free_symbols
        return self.sources <= known and free <= {time, *self.arguments.symbols}


@dataclass(frozen=True, eq=False)
class Edges(LeavesCaches):
    """Those of the derivatives of the states, and of the numbers of conditions: true if there are any.

    Attributes:
        conditions: the formulas of events, without those whose time is known.
    """

    program: Program
    conditions: tuple[ArrayFormula, ...] = ()

    def __bool__(self) -> bool:
        return bool(self._watched)

    def ahead(
        self, packed: Packed, t: ArrayLike, apart: ArrayLike, d: Array | None = None
    ) -> Ahead:
        """What lies beyond a time by more than ``apart``, all in seconds.

        Arguments:
            packed: parameters. t: the time.
            apart: how far two times must be apart to count as two; derivatives by the time itself are zero.
            d: discrete variables, which are held; None: those at the start.
        """
        t = jax.lax.stop_gradient(t)
        point = _Point(packed, t, t + apart, self.program, d)
        found = NOTHING
        for part in self._plan:
            if isinstance(part.formula, Accumulate):
                point.add(part, part.formula)
                continue
            walk = point.walk(part.arguments)
            if part in self._watched:
                own = Ahead(*map(jnp.min, walk.visit(part.expression)))
                found = found.joined(own._replace(jump=jnp.inf) if part.is_condition else own)
            if part.fills is not None and part.is_known(self._known):
                value, line = walk.value(part.expression), walk.line(part.expression)
                point.fill(part, value, line)
        return found

    def turn(self, now: Values, rates: Array) -> Array:
        """How long a step may be, in seconds, by the sines of states that conditions depend on: a part of a period.

        Arguments:
            now: the values at its start. rates: the derivatives of the states.
        """

        def phases(t: Array, x: Array) -> Array:
            at = now._replace(t=t, x=x)
            arrays = arrays_for(self.program, self.phases, at, at)
            found = [compute(phase, now.packed, arrays, t) for phase in self.phases]
            return jnp.concatenate([jnp.ravel(value) for value in found])

        point = (jnp.asarray(now.t, rates.dtype), now.x)
        _, speeds = jax.jvp(phases, point, (jnp.ones_like(point[0]), rates))
        speed = jnp.max(jnp.where(jnp.isfinite(speeds), jnp.abs(speeds), 0.0))
        period = 2 * jnp.pi / jnp.where(speed > 0, speed, 1.0)
        return jnp.where(speed > 0, PART_OF_PERIOD * period, jnp.inf)

    @cached_property
    def phases(self) -> tuple[ArrayFormula, ...]:
        """Those of the sines that conditions depend on, as far as they do not follow from time alone."""
        found: list[ArrayFormula] = []
        for part in self._with_conditions():
            formula = part.formula
            if isinstance(formula, Accumulate):
                continue
            own = formula.arguments
            known = {s for s, g in own.variables if set(g.sources) <= self._known}
            known |= {time, *(s for s, _ in own.parameters), *(s for s, _ in own.modules)}
            for wave in sorted(part.expression.atoms(*WAVES), key=str):
                if not wave.free_symbols <= known and wave.free_symbols <= {time, *own.symbols}:
                    found.append(replace(formula, expression=wave.args[0]))
        return tuple(found)

    @cached_property
    def bends(self) -> bool:
        """Whether the right-hand side jumps or bends at times that are not known ahead.

        That is where states or inputs make it, or a curve of time, such as a sum of sines that is clipped.
        """
        for part in self._needed(self.program.rate_sources):
            straight = self._known - self._curved
            bent = {s for s, g in part.arguments.variables if not set(g.sources) <= straight}
            known = {time, *part.arguments.symbols} - bent
            timed = self._symbols(part, self._timed)
            for node in part.expression.atoms(*BENT):
                if node.free_symbols - known or not is_foreseen(node, timed):
                    return True
        return False

    @cached_property
    def _parts(self) -> tuple[_Part, ...]:
        """All formulas that the derivatives of the states and the conditions need, in order."""
        return self._with_conditions(self.program.rate_sources)

    def _with_conditions(self, sources: Iterable[int] = ()) -> tuple[_Part, ...]:
        """The conditions, and before them the formulas that they, and some arrays, need."""
        read = self.program.in_copy((s for c in self.conditions for s in c.sources), 0)
        conditions = (_Part(c, is_condition=True) for c in self.conditions)
        return *self._needed({*sources, *read}), *conditions

    def _needed(self, sources: Iterable[int]) -> Iterator[_Part]:
        """The formulas of the program that some arrays need, in order."""
        for i in self.program.needed(sources):
            yield from _parts(self.program.instructions[i], self.program.first[i])

    @cached_property
    def _known(self) -> set[int]:
        """The arrays that follow from time, parameters and discrete variables alone."""
        known = {ZERO, DISCRETE}
        for part in self._parts:
            if part.fills is not None and part.is_known(known):
                known.add(part.fills)
        return known

    @cached_property
    def _timed(self) -> set[int]:
        """Those that depend on time, too."""
        timed: set[int] = set()
        for part in self._parts:
            if part.fills is not None and (part.expression.has(time) or part.sources & timed):
                timed |= {part.fills} & self._known
        return timed

    @cached_property
    def _curved(self) -> set[int]:
        """Those of the known that do not consist of lines over time."""
        curved: set[int] = set()
        for part in self._parts:
            if part.fills is None or part.fills not in self._timed:
                continue
            bent = not is_straight(part.expression, self._symbols(part, self._timed))
            curved |= {part.fills} if bent or part.sources & curved else set()
        return curved

    def _symbols(self, part: _Part, arrays: set[int]) -> set[sp.Symbol]:
        """Time, and the symbols of a formula that some arrays fill."""
        return {time, *(s for s, g in part.arguments.variables if arrays & set(g.sources))}

    @cached_property
    def _watched(self) -> tuple[_Part, ...]:
        """The formulas that may have edges."""
        found: list[_Part] = []
        for part in self._parts:
            timed = self._symbols(part, self._timed)
            nodes = sp.preorder_traversal(part.expression)
            if any(has_edges(n) and n.free_symbols & timed for n in nodes):
                found.append(part)
        return tuple(found)

    @cached_property
    def _plan(self) -> tuple[_Part, ...]:
        """These, and those that give what they read, in order."""
        wanted: set[int] = set()
        plan: list[_Part] = []
        for part in reversed(self._parts):
            gives = part.fills is not None and part.fills in wanted & self._known
            if gives or part in self._watched:
                plan.append(part)
                wanted |= part.sources
        return tuple(reversed(plan))


def _parts(instruction: Instruction, first: int) -> Iterator[_Part]:
    """The formulas of an instruction; unknowns of loops stay unknown."""
    if isinstance(instruction, ArrayFormula | Accumulate):
        yield _Part(instruction, first)
    elif isinstance(instruction, UnlikeFormulas):
        yield from map(_Part, instruction.formulas)
    elif isinstance(instruction, SolveTornLoop):
        outer, n = instruction.arguments, instruction.outputs
        own = (*outer.variables, *outer.parameters, *outer.modules)
        ends = np.cumsum([0, *map(len, (outer.variables, outer.parameters, outer.modules))])
        for f in instruction.equations:
            places = {s: g.sources[0] - n for s, g in f.arguments.variables}
            places |= {s: m for s, (m,) in f.arguments.modules}
            parts: list[Any] = [
                tuple((s, own[p][1]) for s, p in places.items() if begin <= p < end)
                for begin, end in pairwise(ends)
            ]
            yield _Part(ArrayFormula(f.expression, Arguments(*parts), instruction.size))
    else:
        for f in instruction.formulas:
            yield _Part(ArrayFormula(f.residual, f.arguments, f.size))


class _Point:
    """A time, and what is known of a program's arrays there."""

    def __init__(
        self, packed: Packed, t: Any, later: Any, program: Program, d: Array | None
    ) -> None:
        self.packed, self.t, self.later = packed, t, later
        n = 2 * len(program.nodes)  # conditions may read values before an event, which stay unknown
        self.values: list[Any] = [None] * n
        self.lines: list[Line | None] = [None] * n
        held = program.discrete_start if d is None else d
        for array, value in ((ZERO, jnp.zeros(())), (DISCRETE, jnp.asarray(held))):
            self.values[array], self.lines[array] = value, Line(value)

    def walk(self, arguments: Arguments) -> Walk:
        """A walk through a formula."""
        known = {
            s: g
            for s, g in arguments.variables
            if all(self.values[i] is not None for i in g.sources)
        }
        arguments = replace(arguments, variables=tuple(known.items()))
        now = fill(arguments, self.packed, self.values, self.later)
        lines: dict[Any, Line | None] = {s: Line(now[s]) for s, _ in arguments.parameters}
        lines |= {time: Line(0.0, 1.0), **{s: self._line(g) for s, g in known.items()}}
        return Walk(now, lines, self.t, self.later)

    def add(self, part: _Part, one: Accumulate) -> None:
        """Compute a sum."""
        line, terms = self._line(one.values), read_elements(one.values, self.values)
        if line is not None and line.wave is not None:
            line = None  # waves, added up, are none
        line = merged([line], lambda values: add_up(one, jnp.broadcast_to(values[0], terms.shape)))
        self.fill(part, add_up(one, terms), line)

    def fill(self, part: _Part, value: Any, line: Line | None) -> None:
        """Keep a value, and its line."""
        assert part.fills is not None
        shape = () if part.formula.size == 1 else (part.formula.size,)
        line = merged([line], lambda values: jnp.broadcast_to(values[0], shape))
        self.values[part.fills], self.lines[part.fills] = jnp.broadcast_to(value, shape), line

    def _line(self, gather: Gather) -> Line | None:
        """The line of what is read."""
        sources = list(dict.fromkeys(gather.sources))

        def read(values: Sequence[Any]) -> Any:
            arrays: list[Any] = [None] * len(self.values)
            for s, value in zip(sources, values, strict=True):
                arrays[s] = jnp.broadcast_to(value, jnp.shape(self.values[s]))
            return read_elements(gather, arrays)

        return merged([self.lines[s] for s in sources], read)
