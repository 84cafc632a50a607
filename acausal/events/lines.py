"""Walk through a formula of time: what is a line until the next edge, and where the edges are.

Between two edges, what a source computes is often a line ``at_zero + rate * t``: of its comparisons, whole numbers and
tables the next change is then known. A sine gives no edge, but bounds the steps. A smooth bump or step of a line has an
edge in its middle, lest a step of the solver leaps over it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce
from operator import mul
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import sympy as sp
from jax.typing import ArrayLike
from sympy.core.relational import Relational

from acausal.codegen import ModuleValue, evaluate
from acausal.flattening import BENT, CHOOSING, EXTREMES, SIGNS, STEPS, WAVES, compared
from acausal.modeling import ModuleCall, time

PART_OF_PERIOD = 0.125
"""The longest step, as a part of the period of a sine."""

ROUNDING = 4.0
"""So many rounding errors is the argument of a table uncertain."""

STEEP = (sp.tanh, sp.cosh, sp.atan)
"""What rises, or has its least value, around an argument of zero."""

EDGED = (*BENT, *WAVES, ModuleCall)
"""What gives an edge or a bound where its arguments depend on time."""


class Ahead(NamedTuple):
    """What is known of the time to come.

    Attributes:
        jump: the next time at which the right-hand side may jump, in seconds. bend: at which its slope may.
        longest: how long a step may be until then.
    """

    jump: Any
    bend: Any
    longest: Any

    def joined(self, other: Ahead) -> Ahead:
        """The earlier and shorter of two."""
        return Ahead(*(jnp.minimum(a, b) for a, b in zip(self, other, strict=True)))

    def where(self, holds: Any) -> Ahead:
        """This if something holds, else nothing."""
        return Ahead(*(jnp.where(holds, a, jnp.inf) for a in self))

    def bent(self) -> Ahead:
        """The same with bends in place of jumps."""
        return Ahead(jnp.inf, jnp.minimum(self.jump, self.bend), self.longest)


NOTHING = Ahead(jnp.inf, jnp.inf, jnp.inf)
"""Nothing is known."""


class Line(NamedTuple):
    """A value until the next edge: ``at_zero + rate * t``, or, with a wave about it, ``at_zero + size * wave(phase)``.

    The rate is the float 0.0 where it is constant; it is with a wave.
    """

    at_zero: Any
    rate: Any = 0.0
    wave: Wave | None = None

    @property
    def level(self) -> bool:
        """Whether it is constant but for its wave, for any parameters."""
        return isinstance(self.rate, float) and self.rate == 0.0

    @property
    def constant(self) -> bool:
        """Whether it is constant, for any parameters."""
        return self.level and self.wave is None

    def times(self, factor: Any) -> Line:
        """The line times a constant."""
        wave = self.wave and self.wave._replace(size=factor * self.wave.size)
        return Line(factor * self.at_zero, 0.0 if self.level else factor * self.rate, wave)

    def at(self, t: ArrayLike) -> Any:
        """The value at a time, of a line without a wave."""
        return self.at_zero if self.level else self.at_zero + self.rate * t


class Wave(NamedTuple):
    """A sine, cosine or tangent of a line, times a constant."""

    kind: Any
    size: Any
    phase: Line


def merged(lines: Sequence[Line | None], merge: Callable[[Sequence[Any]], Any]) -> Line | None:
    """The line whose numbers are merged from those of several lines; None if there is none for one of them, or for all.

    Arguments:
        merge: what chooses, or puts together, one number from those of the lines, in their order.
    """
    some = [line for line in lines if line is not None]
    waves = {line.wave.kind: line.wave for line in some if line.wave is not None}
    if len(some) < len(lines) or len(waves) > 1 or (waves and not all(line.level for line in some)):
        return None
    wave = None
    for kind in waves:
        still = Wave(kind, 0.0, Line(0.0))
        each = [still if line.wave is None else line.wave for line in some]
        phase = merged([w.phase for w in each], merge)
        assert phase is not None
        wave = Wave(kind, merge([w.size for w in each]), phase)
    rate = 0.0 if all(line.level for line in some) else merge([line.rate for line in some])
    return Line(merge([line.at_zero for line in some]), rate, wave)


def has_edges(node: Any) -> bool:
    """Whether an expression gives an edge or a bound itself, where its arguments depend on time."""
    return isinstance(node, EDGED) or bool(_middles(node))


def _middles(node: Any) -> list[Any]:
    """What is zero in the middle of a smooth bump or step: exp(-x²), 1/(1 + x²), tanh(x)."""
    if isinstance(node, STEEP):
        return [node.args[0]]
    if isinstance(node, sp.exp) or (isinstance(node, sp.Pow) and node.exp.is_negative):
        powers = node.args[0].atoms(sp.Pow)
        return [p.base for p in powers if p.exp.is_even and p.exp.is_positive]
    return []


class Walk:
    """Through a formula, just behind a time.

    Arguments:
        now: the values that fill its slots, as far as they are known. lines: their lines, as far as they have some.
        t: the time. later: just behind.
    """

    def __init__(
        self, now: dict[sp.Symbol, Any], lines: dict[Any, Line | None], t: Any, later: Any
    ) -> None:
        self.now, self.t, self.later = now, t, later
        self.lines = lines
        self.found: dict[sp.Basic, Ahead] = {}

    def known(self, node: sp.Basic) -> bool:
        """Whether the value is."""
        return node.free_symbols <= self.now.keys()

    def value(self, node: Any) -> Any:
        """It, just behind the time."""
        return jnp.asarray(evaluate(node, self.now))

    # -- edges ---------------------------------------------------------------------------------------

    def visit(self, node: Any) -> Ahead:
        """What lies ahead in an expression."""
        if node not in self.found:
            self.found[node] = self._visit(node)
        return self.found[node]

    def _visit(self, node: Any) -> Ahead:
        if not node.args:
            return NOTHING
        if isinstance(node, sp.Piecewise):
            return self._cases(node)
        found = NOTHING
        for argument in node.args:
            found = found.joined(self.visit(argument))
        for kinds, rule in _EDGES:
            if isinstance(node, kinds):
                found = found.joined(rule(self, node))
        for middle in _middles(node):
            found = found.joined(self._zero(middle).bent())
        return found

    def _cases(self, node: Any) -> Ahead:
        """The conditions in order, and the case that holds just behind the time; all where that is not known."""
        found, open_ = NOTHING, jnp.array(True)
        for value, condition in node.args:
            found = found.joined(self.visit(condition).where(open_))
            if self.known(condition):
                holds = jnp.asarray(evaluate(condition, self.now))
                found = found.joined(self.visit(value).where(open_ & holds))
                open_ = open_ & ~holds
            else:
                found = found.joined(self.visit(value).where(open_))
        return found

    def _zero(self, number: Any) -> Ahead:
        """Where a number is zero: a line, or a wave about a level."""
        line = self.line(number)
        if line is None or line.constant:
            return NOTHING
        return self._at(line.at_zero, line.rate) if line.wave is None else self._passing(line)

    def _passing(self, line: Line) -> Ahead:
        """Where a wave passes zero."""
        assert line.wave is not None
        kind, size, phase = line.wave
        angles, period = _ANGLES[kind](-line.at_zero / jnp.where(size == 0, jnp.nan, size))
        forward, moves = phase.rate > 0, phase.rate != 0
        rate = jnp.where(moves, phase.rate, 1.0)
        here, turn = phase.at(self.later), jnp.where(forward, period, -period)
        ahead = NOTHING
        for angle in angles:
            passes = angle + turn * (jnp.floor((here - angle) / turn) + 1)
            t = (passes - phase.at_zero) / rate
            t = jnp.where(t > self.later, t, t + jnp.abs(period / rate))
            jump = jnp.where(moves & jnp.isfinite(t), t, jnp.inf)
            ahead = ahead.joined(Ahead(jump, jnp.inf, jnp.inf))
        return ahead

    def _at(self, at_zero: Any, rate: Any) -> Ahead:
        """Where a line is zero."""
        root = -at_zero / jnp.where(rate == 0, 1.0, rate)
        ahead = (rate != 0) & (root > self.later)
        return Ahead(jnp.where(ahead, root, jnp.inf), jnp.inf, jnp.inf)

    def _choice(self, node: Any) -> Ahead:
        found = NOTHING
        for number in compared(node):
            found = found.joined(self._zero(number))
        return found if isinstance(node, CHOOSING) else found.bent()

    def _whole(self, node: Any) -> Ahead:
        number = node.args[0]
        if isinstance(node, sp.Mod):
            number = number / node.args[1]
        line = self.straight(number)
        if line is None or line.constant:
            return NOTHING
        below = jnp.floor(self.value(number))
        following = jnp.where(line.rate > 0, below + 1, jnp.ceil(self.value(number)) - 1)
        return self._at(line.at_zero - following, line.rate)

    def _wave(self, node: Any) -> Ahead:
        phase = node.args[0]
        line = self.straight(phase)
        if line is not None:
            rate: Any = line.rate
        elif self.known(phase):
            one = jnp.ones_like(self.later)
            at = lambda t: jnp.asarray(evaluate(phase, {**self.now, time: t}))  # noqa: E731
            rate = jax.jvp(at, (self.later,), (one,))[1]
        else:
            return NOTHING
        moves = jnp.abs(rate) > 0
        period = 2 * jnp.pi / jnp.where(moves, jnp.abs(rate), 1.0)
        return Ahead(jnp.inf, jnp.inf, jnp.where(moves, PART_OF_PERIOD * period, jnp.inf))

    def _table(self, node: Any) -> Ahead:
        called = self._called(node)
        if called is None:
            return NOTHING
        module, line = called
        if line.constant:
            return NOTHING

        def following(m: Any, argument: Any, forward: Any) -> tuple[Any, Any, Any]:
            jump, bend, beyond = (jnp.where(forward, v, jnp.inf) for v in m.ahead(argument))
            return (
                jump,
                bend,
                beyond,
            )  # of a table that is read backwards, samples are not looked for

        forward = line.rate > 0
        rounding = ROUNDING * jnp.finfo(jnp.result_type(self.later)).eps
        behind = line.at(self.later) + rounding * jnp.abs(line.at_zero)
        found = module.mapped(following, behind, forward)
        jump, bend, beyond = (
            jnp.where(jnp.isfinite(v), self._at(line.at_zero - v, line.rate).jump, jnp.inf)
            for v in found
        )
        return Ahead(jump, bend, beyond - self.t)

    def _called(self, node: Any) -> tuple[ModuleValue, Line] | None:
        """The table that is read at a line, and the line."""
        module, orders, *arguments = node.args
        value = self.now[module]
        modules = value.module if isinstance(value.module, tuple) else (value.module,)
        if len(arguments) != 1 or not all(hasattr(m, "ahead") for m in modules):
            return None
        line = self.straight(arguments[0])
        return None if line is None else (_differentiated(value, int(orders[0])), line)

    # -- lines ---------------------------------------------------------------------------------------

    def line(self, node: Any) -> Line | None:
        """An expression as a line until the next edge; None if it is none, or not known."""
        if node not in self.lines:
            self.lines[node] = self._line(node)
        return self.lines[node]

    def _line(self, node: Any) -> Line | None:
        if not self.known(node):
            return None
        if node.is_Number or node.is_NumberSymbol:
            return Line(float(node))
        if isinstance(node, sp.Piecewise):
            values = [case.args[0] for case in node.args]
            return merged(list(map(self.line, values)), self._chosen(node))
        if isinstance(node, STEPS[:2]) and self.straight(node.args[0]) is not None:
            return Line(self.value(node))
        if isinstance(node, CHOOSING[1:]) and self.line(node.args[0]) is not None:
            return Line(self.value(node))
        if isinstance(node, ModuleCall):
            return self._line_of_table(node)
        lines = [self.line(a) for a in node.args]
        some = [line for line in lines if line is not None]
        if len(some) < len(lines):
            return None
        moving = [line for line in some if not line.constant]
        if not moving:
            return Line(self.value(node))
        waves = [line.wave for line in moving if line.wave is not None]
        if waves and len(moving) > 1:
            return None
        if isinstance(node, sp.Add):
            rate = 0.0 if waves else sum(line.rate for line in some)
            return Line(sum(line.at_zero for line in some), rate, *waves)
        if isinstance(node, sp.Mul):
            if len(moving) > 1:
                return None
            factor = reduce(mul, (line.at_zero for line in some if line.constant), 1.0)
            return moving[0].times(factor)
        if waves:
            return None
        if isinstance(node, WAVES):
            return Line(0.0, 0.0, Wave(type(node), 1.0, moving[0]))
        if isinstance(node, EXTREMES):
            return self._line_of_extreme(node, some)
        if isinstance(node, sp.Abs):
            sign = jnp.where(some[0].at(self.later) < 0, -1.0, 1.0)
            return Line(sign * some[0].at_zero, sign * some[0].rate)
        if isinstance(node, sp.Mod) and some[1].constant:
            whole = some[1].at_zero * jnp.floor(some[0].at(self.later) / some[1].at_zero)
            return Line(some[0].at_zero - whole, some[0].rate)
        return None

    def straight(self, node: Any) -> Line | None:
        """The same for a line without a wave alone."""
        line = self.line(node)
        return None if line is None or line.wave is not None else line

    def _chosen(self, node: Any) -> Callable[[Sequence[Any]], Any]:
        """Choose the case that holds just behind the time."""
        conditions = [evaluate(case.args[1], self.now) for case in node.args[:-1]]

        def choose(values: Sequence[Any]) -> Any:
            found = values[-1]
            for value, holds in zip(reversed(values[:-1]), reversed(conditions), strict=True):
                found = jnp.where(holds, value, found)
            return found

        return choose

    def _line_of_extreme(self, node: Any, lines: list[Line]) -> Line | None:
        found: Line | None = lines[0]
        for line in lines[1:]:
            assert found is not None
            one, other = found.at(self.later), line.at(self.later)
            takes = other > one if isinstance(node, sp.Max) else other < one
            found = merged([found, line], lambda both, takes=takes: jnp.where(takes, *both[::-1]))
        return found

    def _line_of_table(self, node: Any) -> Line | None:
        called = self._called(node)
        if called is None:
            return None
        module, line = called
        modules = module.module if isinstance(module.module, tuple) else (module.module,)
        if line.constant:
            return Line(self.value(node))
        if not all(m.is_line for m in modules):
            return None

        def tangent(m: Any, argument: Any) -> tuple[Any, Any]:
            return jax.jvp(m, (argument,), (jnp.ones_like(argument),))

        value, rate = module.mapped(tangent, line.at(self.later))
        rate = rate * line.rate
        return Line(value - rate * self.later, rate)


def _differentiated(value: ModuleValue, times: int) -> ModuleValue:
    if not times:
        return value
    if isinstance(value.module, tuple):
        return ModuleValue(tuple(m.differentiated(times) for m in value.module))
    return ModuleValue(value.module.differentiated(times), value.stacked)


def _of_circle(level: Any, angle: Callable[[Any], Any]) -> Any:
    """An angle of a level that a point on the unit circle passes; NaN for one that it does not pass."""
    inside = jnp.abs(level) < 1
    return jnp.where(inside, angle(jnp.where(inside, level, 0.0)), jnp.nan)


def _of_sine(level: Any) -> tuple[tuple[Any, ...], float]:
    angle = _of_circle(level, jnp.arcsin)
    return (angle, jnp.pi - angle), 2 * jnp.pi


def _of_cosine(level: Any) -> tuple[tuple[Any, ...], float]:
    angle = _of_circle(level, jnp.arccos)
    return (angle, -angle), 2 * jnp.pi


def _of_tangent(level: Any) -> tuple[tuple[Any, ...], float]:
    return (jnp.arctan(level), 0 * level + jnp.pi / 2), jnp.pi  # at the other it jumps


_ANGLES: dict[Any, Callable[[Any], tuple[tuple[Any, ...], float]]] = {
    sp.sin: _of_sine,
    sp.cos: _of_cosine,
    sp.tan: _of_tangent,
}
"""By wave, at what angles it passes a level, and its period."""

_EDGES: tuple[tuple[Any, Callable[[Walk, Any], Ahead]], ...] = (
    ((Relational, *SIGNS, *EXTREMES), Walk._choice),
    (STEPS, Walk._whole),
    (WAVES, Walk._wave),
    (ModuleCall, Walk._table),
)
"""By kind of expression, its own edges."""
