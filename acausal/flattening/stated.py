"""What a component states: equations that hold at all times, and those of discrete variables, which hold at events.

Conditions that are watched become hidden discrete variables, 1 or 0; between events they are known.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field
from itertools import islice
from typing import Any

import sympy as sp
from sympy.core.relational import Relational

from acausal.errors import DeclarationError
from acausal.flattening.origin import HIDDEN, dotted
from acausal.flattening.silent import (
    Silent,
    discrete_side,
    has_jumps,
    in_halves,
    in_steps,
    is_continuous,
    is_unknown,
)
from acausal.modeling import (
    HALF,
    INITIAL,
    Assert,
    Component,
    Discrete,
    Eq,
    Floored,
    ModuleCall,
    Previous,
    Reference,
    Reinit,
    Tick,
    Variable,
    Watched,
    When,
    literal,
    number_or_truth,
    references,
    time,
)

TINY = sp.Float(1e-60)
"""No period is shorter [s]."""

ROUNDING = sp.Float(1e-9)
"""Of a period: an instant that is so near has come."""


@dataclass(frozen=True)
class UpdateStatement:
    """``target = value`` at every event; of a state, what it jumps to.

    Attributes:
        text: says so in messages.
        always: whether it is an equation that must hold between events, too: nothing in it belongs to an instant.
    """

    target: Reference
    value: sp.Expr
    text: str
    always: bool = False


@dataclass(frozen=True)
class GuardStatement(UpdateStatement):
    """``target`` is 1 where ``value > 0`` (or ``>= 0`` unless ``strict``), else 0; steps end where that changes.

    Attributes:
        ticks: whether it is a clock's: not true while initial values are found.
    """

    strict: bool = field(kw_only=True)
    ticks: bool = field(default=False, kw_only=True)


@dataclass(frozen=True)
class Stated:
    """What a component states.

    Attributes:
        equations: hold at all times; without hidden conditions yet where the model has no events.
        guards, updates, jumps: what holds at events.
        hidden: local names and declarations of the hidden variables.
        silent: parameters that act through conditions alone that are not events.
        assertions: what must hold.
    """

    equations: tuple[Eq, ...]
    guards: tuple[GuardStatement, ...] = ()
    updates: tuple[UpdateStatement, ...] = ()
    jumps: tuple[UpdateStatement, ...] = ()
    hidden: tuple[tuple[str, Discrete], ...] = ()
    silent: tuple[Silent, ...] = ()
    assertions: tuple[Assert, ...] = ()


def asks_for_events(declared: Iterable[Variable], stated: Iterable[Any]) -> bool:
    """Whether a component has discrete variables or events of its own, whatever the rest of the model has."""
    if any(isinstance(v, Discrete) for v in declared):
        return True
    return any(isinstance(s, When) or _always_watched(s) for s in stated)


def _always_watched(stated: Any) -> bool:
    if not isinstance(stated, Eq):
        return False
    sides = (stated.lhs, stated.rhs)
    if any(side.has(Previous, Tick) for side in sides):
        return True
    return any(w.args[-1] == 1 for side in sides for w in side.atoms(Watched, Floored))


def without_events(equation: Eq) -> Eq:
    """The equation as it stands, its conditions not watched."""
    sides = (number_or_truth(equation.lhs), number_or_truth(equation.rhs))
    if any(s.has(Watched, Floored) for s in sides):
        sides = (literal(sides[0]), literal(sides[1]))
    return Eq(*sides).stated_in(equation.place)


def with_events(component: Component, stated: Sequence[Any], decide: Collection[int]) -> Stated:
    """Sort what a component states, and watch its conditions.

    Arguments:
        decide: equations by identity, in which values that jump are events, see `deciding`.

    Raises:
        DeclarationError: for a discrete variable that is not given explicitly, or twice.
    """
    return _Sorting(component, decide).sorted(stated)


@dataclass
class _Sorting:
    component: Component
    decide: Collection[int]
    guards: list[GuardStatement] = field(default_factory=list[GuardStatement])
    updates: dict[Reference, UpdateStatement] = field(
        default_factory=dict[Reference, UpdateStatement]
    )
    jumps: dict[Reference, UpdateStatement] = field(
        default_factory=dict[Reference, UpdateStatement]
    )
    hidden: list[tuple[str, Discrete]] = field(default_factory=list[tuple[str, Discrete]])
    known: dict[Any, Reference] = field(default_factory=dict[Any, Reference])

    def sorted(self, stated: Sequence[Any]) -> Stated:
        """All of it, each where it belongs."""
        equations: list[Eq] = []
        whens = [one for one in stated if isinstance(one, When)]
        for one in stated:
            if isinstance(one, When):
                continue  # after all others, whose comparisons it may repeat
            if not isinstance(one, Eq):
                equations.append(one)  # refused where templates are made
            elif (target := discrete_side(one)) is not None:
                value = number_or_truth(one.rhs if target is one.lhs else one.lhs)
                always = not value.has(ModuleCall, Previous, Tick, INITIAL)
                self._update(target, self._watched(value), _written(one, target), always=always)
            else:
                equations.append(self._continuous(one))
        for one in whens:
            self._when(one)
        return Stated(
            tuple(equations),
            tuple(self.guards),
            tuple(self.updates.values()),
            tuple(self.jumps.values()),
            tuple(self.hidden),
        )

    # -- equations ---------------------------------------------------------------------------------

    def _continuous(self, equation: Eq) -> Eq:
        sides = [number_or_truth(s) for s in (equation.lhs, equation.rhs)]
        if id(equation) in self.decide:
            sides = [self._watched(s) if has_jumps(s) else s for s in sides]
        if any(s.has(Watched, Floored, Previous, Tick) for s in sides):
            sides = [self._held(self._cases(side)) for side in sides]
        return Eq(*sides).stated_in(equation.place)

    def _held(self, expression: Any) -> Any:
        """What holds between events: values before an event, and clocks, become variables."""
        replaced: dict[Any, Any] = {}
        for symbol in _in_order(expression.atoms(Previous, Tick)):
            replaced[symbol] = self._variable(symbol, self._ticking(symbol), "real")
        return expression.xreplace(replaced)

    def _variable(self, key: Any, value: Any, kind: Any) -> Reference:
        """A hidden variable for an expression; the same for the same."""
        if key not in self.known:
            reference = self.known[key] = self._new(kind)
            text = str(key[-1] if isinstance(key, tuple) else key)
            self.updates[reference] = UpdateStatement(reference, value, text)
        return self.known[key]

    def _update(
        self, target: Reference, value: sp.Expr, text: str, *, always: bool = False
    ) -> None:
        if target in self.updates:
            raise DeclarationError(
                f"{self.component._node.label}: two equations give the discrete variable '{target.path}': "
                f"{self.updates[target].text}, and {text}; join them: When(..., otherwise=When(...)), in Modelica "
                "when and elsewhen"
            )
        self.updates[target] = UpdateStatement(target, value, text, always)

    # -- when --------------------------------------------------------------------------------------

    def _when(self, when: When) -> None:
        """Its statements, each where its condition has just come true and none before it in the chain."""
        cases: dict[Reference, list[tuple[sp.Expr, Any]]] = {}
        jumps: dict[Reference, list[tuple[sp.Expr, Any]]] = {}
        earlier: list[Any] = []
        for link in when.chain():
            happens = sp.And(self._comes_true(link), *(sp.Not(e) for e in earlier))
            earlier.append(happens)
            for statement in link.statements:
                if isinstance(statement, Reinit):
                    value = self._at_event(statement.value)
                    jumps.setdefault(statement.state, []).append((value, happens))
                    continue
                target = discrete_side(statement)
                if target is None:
                    raise DeclarationError(
                        f"{self.component._node.label}: {statement} stands in When(...), but neither side is a "
                        "discrete variable; declare it as ac.Discrete, or let a state jump by ac.Reinit"
                    )
                value = statement.rhs if target is statement.lhs else statement.lhs
                value = self._at_event(number_or_truth(value))
                cases.setdefault(target, []).append((value, happens))
        for target, some in cases.items():
            self._update(target, sp.Piecewise(*some, (Previous(target), True)), str(when))
        for state, some in jumps.items():
            if state in self.jumps:
                own = self.component._node
                name = ".".join((*(state.owner.route_from(own) or ()), state.path))
                raise DeclarationError(
                    f"{own.label}: two When(...) make '{name}' jump; join them by otherwise="
                )
            value = sp.Piecewise(*some, (state, True))
            self.jumps[state] = UpdateStatement(state, value, str(when))

    def _comes_true(self, when: When) -> Any:
        """The condition under which it happens, in terms of hidden variables."""
        initial = sp.Gt(INITIAL, HALF)
        happens: list[Any] = []
        for condition in when.conditions:
            later = condition.xreplace({initial: sp.false})
            if condition.xreplace({initial: sp.true}) is sp.true:
                happens.append(initial)
            if later is not sp.false:
                c = self._condition(later)
                rises = sp.And(sp.Gt(c, HALF), sp.Le(Previous(c), HALF))
                happens.append(sp.And(sp.Le(INITIAL, HALF), rises))
        return sp.Or(*happens)

    def _condition(self, condition: Any) -> Reference:
        """A hidden variable that is 1 where a condition holds."""
        truth = self._truth(condition)
        guards = {sp.Gt(g.target, HALF): g.target for g in self.guards}
        value = sp.Piecewise((1, truth), (0, True))
        return guards.get(truth) or self._variable(("condition", condition), value, "bool")

    # -- conditions --------------------------------------------------------------------------------

    def _watched(self, expression: Any) -> Any:
        """The value of a discrete equation, all its conditions watched."""
        pieces = literal(in_steps(expression).replace(Floored, self._floor))
        conditions = {c for p in pieces.atoms(sp.Piecewise) for _, c in p.args}
        replaced = {c: self._truth(c) for c in _in_order(conditions) if c is not sp.true}
        return self._ticking(pieces.xreplace(replaced))

    def _cases(self, expression: Any) -> Any:
        """The value of an equation that holds at all times, its watched conditions frozen."""
        return expression.replace(Floored, self._floor).replace(Watched, self._frozen)

    def _at_event(self, expression: Any) -> Any:
        """The value of a statement: a comparison that is watched has just changed, whatever rounding makes of it."""
        pieces = in_halves(literal(expression))
        replaced: dict[Any, Any] = {}
        for relation in pieces.atoms(Relational):
            for same in (relation, relation.reversed):
                opposite = same.negated
                if same in self.known:
                    replaced[relation] = sp.Gt(self.known[same], HALF)
                elif opposite in self.known:
                    replaced[relation] = sp.Le(self.known[opposite], HALF)
        return self._ticking(pieces.xreplace(replaced))

    def _frozen(self, condition: Any, value: Any, otherwise: Any, _: Any) -> Any:
        return sp.Piecewise((value, self._truth(condition)), (otherwise, True))

    def _truth(self, condition: Any) -> Any:
        """A condition whose comparisons of what changes continuously are hidden variables."""
        condition = in_halves(condition)
        replaced = {
            r: sp.Gt(self._guard(r), HALF)
            for r in _in_order(condition.atoms(Relational))
            if is_continuous(r)
        }
        return self._ticking(condition.xreplace(replaced))

    def _guard(self, relation: Any) -> Reference:
        if relation not in self.known:
            if not isinstance(relation, sp.Gt | sp.Ge | sp.Lt | sp.Le):
                raise DeclarationError(
                    f"{self.component._node.label}: {relation} cannot be watched, as two numbers are hardly ever "
                    "equal; compare by > or <"
                )
            above = isinstance(relation, sp.Gt | sp.Ge)
            lhs, rhs = self._compared(relation.lhs), self._compared(relation.rhs)
            value: Any = lhs - rhs if above else rhs - lhs
            strict = isinstance(relation, sp.Gt | sp.Lt)
            target = self.known[relation] = self._new("bool", relation)
            text = str(relation.xreplace(dotted(references(relation), self.component)))
            self.guards.append(GuardStatement(target, self._ticking(value), text, strict=strict))
        return self.known[relation]

    def _compared(self, expression: Any) -> Any:
        """A side of a comparison: what makes it jump is an event of its own, if it is one or follows from time.

        Else a search would leap over two jumps, and the instant of one would move with the rest of the comparison.
        """
        held = self._cases(expression)
        replaced: dict[Any, Any] = {}
        for node in _in_order(held.atoms(sp.floor, Relational)):
            if time in node.free_symbols and not any(map(is_unknown, node.free_symbols)):
                is_floor = isinstance(node, sp.floor)
                replaced[node] = self._floor(node.args[0], 1) if is_floor else self._truth(node)
        return held.xreplace(replaced)

    def _floor(self, number: Any, _: Any) -> Reference:
        """The greatest integer not above a number, as a hidden variable.

        Of the integers at both ends of where the number now lies, one is even and one is odd. Each has a condition of
        its own, so that the one that has just been passed stays what it has become, whatever rounding makes of it.
        """
        key = Floored(number, sp.S.Zero)
        if key not in self.known:
            n = self.known[key] = self._new("int", literal(key))
            before, number = Previous(n), self._ticking(literal(number))
            ends = 2 * sp.floor((before + 1) / 2), 2 * sp.floor(before / 2) + 1
            passed = [(end, self._new("bool")) for end in ends]
            for end, r in passed:
                self.guards.append(
                    GuardStatement(r, number - end, f"floor({number})", strict=False)
                )
            up = sp.Or(*(sp.And(sp.Gt(e, before), sp.Gt(r, HALF)) for e, r in passed))
            down = sp.Or(*(sp.And(sp.Le(e, before), sp.Le(r, HALF)) for e, r in passed))
            value = sp.Piecewise(
                (sp.floor(number + ROUNDING), sp.Gt(INITIAL, HALF)),
                (sp.Max(before + 1, sp.floor(number)), up),
                (sp.Min(before - 1, sp.floor(number)), down),
                (before, True),
            )
            self.updates[n] = UpdateStatement(n, value, f"floor({number})")
        return self.known[key]

    def _ticking(self, expression: Any) -> Any:
        """Clocks become hidden variables: how often each has ticked, and whether it just does."""
        ticks = expression.atoms(Tick) if isinstance(expression, sp.Basic) else ()
        replaced = {tick: self._tick(tick) for tick in _in_order(ticks)}
        if not replaced:
            return expression
        return expression.xreplace(replaced)

    def _tick(self, tick: Tick) -> Any:
        if tick not in self.known:
            unit = "" if tick.period.is_number else "1"  # a number is one of seconds
            r, count = self._new("bool"), self._new("int", unit=unit)
            now = self.known[tick] = self._new("bool")
            due = time - (tick.start + Previous(count) * tick.period)
            self.guards.append(GuardStatement(r, due, str(tick), strict=False, ticks=True))
            just = sp.And(sp.Gt(r, HALF), sp.Le(Previous(r), HALF))
            passed = sp.Max(0, sp.ceiling((time - tick.start) / tick.period - ROUNDING))
            if (
                not tick.period.is_number
            ):  # not finite for a period that is not positive; else nothing
                passed += sp.floor(TINY / sp.Max(tick.period, 0))
            counted = sp.Piecewise(
                (passed, sp.Gt(INITIAL, HALF)), (Previous(count) + 1, just), (Previous(count), True)
            )
            self.updates[count] = UpdateStatement(count, counted, str(tick))
            self.updates[now] = UpdateStatement(now, sp.Piecewise((1, just), (0, True)), str(tick))
        return self.known[tick]

    def _new(self, kind: Any, meaning: Any = None, unit: str = "") -> Reference:
        """A hidden variable; what it means is for messages."""
        declaration = Discrete(0, kind=kind, unit=unit)
        declaration.meaning = meaning
        path = f"{HIDDEN}[{len(self.hidden) + 1}]"
        declaration.name = path
        self.hidden.append((path, declaration))
        return Reference(self.component._node, path, declaration)


def _written(equation: Eq, target: Reference) -> str:
    """An equation as a text; of one of a thousand parts, as tables of logic have, only what it gives."""
    parts = islice(sp.preorder_traversal(sp.Tuple(equation.lhs, equation.rhs)), 1000)
    return str(equation) if sum(1 for _ in parts) < 1000 else f"{target} = ..."


def _in_order(expressions: Iterable[Any]) -> list[Any]:
    """Expressions in an order that does not depend on the hash seed, though some may read alike."""

    def key(expression: Any) -> tuple[str, list[int]]:
        symbols = set(expression.free_symbols)
        for tick in expression.atoms(Tick):
            symbols |= tick.start.free_symbols | tick.period.free_symbols
        return str(expression), sorted(map(_serial, symbols))

    return sorted(expressions, key=key)


def _serial(symbol: Any) -> int:
    reference = symbol.reference if isinstance(symbol, Previous) else symbol
    return reference.serial if isinstance(reference, Reference) else -1
