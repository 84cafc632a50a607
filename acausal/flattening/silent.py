"""Parameters without a gradient: they act through conditions alone that are not events, but make values jump.

Conditions whose times are known ahead are none of these: steps end there, and the times have derivatives.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Collection, Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.core.relational import Relational

from acausal.flattening.foreseen import is_foreseen
from acausal.flattening.reading import read_statements
from acausal.modeling import (
    Component,
    Discrete,
    Eq,
    Floored,
    Parameter,
    Reference,
    Tick,
    Variable,
    Watched,
    When,
    der,
    literal,
    number_or_truth,
    time,
)

POINTS = 3
"""So many random points on the surface where a condition changes are looked at."""

LIBRARY = "acausal.components."
"""Where classes come from whose conditions users cannot change."""

CLOSE = 1e-9
"""Two values that differ by less, are equal."""


@dataclass(frozen=True)
class Silent:
    """A parameter of a component that acts through a condition alone; or a condition at which values jump.

    Attributes:
        parameter: its local name; empty for a condition, whose instant derivatives do not see. condition: in words.
        asked: whether this is as the class means it: the condition would be an event if the model had others
            (``events=None``), or the library keeps it literal.
    """

    parameter: str
    condition: str
    asked: bool

    def sentence(self, name: str) -> str:
        """What to say of it, by the dotted name of the parameter, or of the condition's component."""
        remedy = (
            "compile the model by ac.compile(model, events=True)"
            if self.asked
            else "write ac.where(..., events=True)"
        )
        if not self.parameter:
            whose = f" of '{name}'" if name else ""
            return (
                f"Values jump at the condition {self.condition}{whose}, which is no event: if its "
                f"instant moves, derivatives do not see it; {remedy}."
            )
        return (
            f"The gradient by '{name}' is zero, as it acts through the condition {self.condition} alone, which is no "
            f"event; {remedy}."
        )


def silent_parameters(
    component: Component, stated: Sequence[Any], watched: Collection[int], *, with_events: bool
) -> tuple[Silent, ...]:
    """What derivatives do not see: conditions of a component at which values jump; parameters that act by them alone.

    Arguments:
        component: whose equations are looked at. stated: all that it states. watched: see `deciding`.
        with_events: whether the model has events, so that conditions with ``events=None`` are watched.
    """
    literals = [one for one in stated if _is_literal(one) and id(one) not in watched]
    sides = [s for one in literals for s in (one.lhs, one.rhs)]
    cased = [number_or_truth(s) for s in sides if s.has(sp.Piecewise, Watched)]
    relations = {r for s in cased for r in s.atoms(Relational)}
    if not any(map(_changes, relations)):
        return ()
    ours = type(component).__module__.startswith(LIBRARY)
    found: dict[Any, Silent] = {}
    visible: set[Any] | None = None
    for asked, condition, value, otherwise in _cases(cased, with_events):
        for relation in sorted(condition.atoms(Relational), key=str):
            if not _changes(relation) or not _jumps(relation, value - otherwise):
                continue
            if asked or not ours:
                found.setdefault(asked, Silent("", str(relation), asked))
            some = _parameters(relation, component)
            if some and visible is None:
                visible = _visible(component, stated, with_events)
            unseen = [p for p in some if p not in found and p not in (visible or ())]
            found |= {p: Silent(p.path, str(relation), asked or ours) for p in unseen}
    return tuple(found.values())


def _is_literal(stated: Any) -> bool:
    """Whether this is an equation that holds at all times; in those of discrete variables, conditions are events."""
    return isinstance(stated, Eq) and discrete_side(stated) is None


def discrete_side(equation: Eq) -> Reference | None:
    """The discrete variable that an equation gives, if a side is one.

    The right side only if the left one is not a variable: ``y = n`` with a discrete n gives y, ``der(x) = n`` gives x.
    """
    if any(s.has(der) for s in (equation.lhs, equation.rhs) if isinstance(s, sp.Basic)):
        return None
    for side in (equation.lhs, equation.rhs):
        if isinstance(side, Reference) and isinstance(side.declaration, Variable):
            return side if isinstance(side.declaration, Discrete) else None
    return None


def deciding(
    stated: Iterable[Any],
    key: Callable[[Any], Hashable] = lambda symbol: symbol,
    joined: Iterable[tuple[Hashable, Hashable]] = (),
) -> set[int]:
    """The equations, by identity, of variables that conditions of events, and discrete variables, follow from.

    Arguments:
        stated: equations and `When`, of one component or of several.
        key: by which symbols of several components are the same variable. joined: keys of connected signals.
    """
    given: dict[Hashable, list[Eq]] = {}
    left: list[Any] = []
    for one in stated:
        if isinstance(one, When):
            left += [s for link in one.chain() for c in link.conditions for s in c.free_symbols]
        elif isinstance(one, Eq):
            sides = [number_or_truth(s) for s in (one.lhs, one.rhs)]
            if discrete_side(one) is None:
                for side in sides:
                    given.setdefault(key(side), []).append(one)
                sides = [w.args[0] for s in sides for w in s.atoms(Watched)]
            left += [symbol for side in sides for symbol in side.free_symbols]
    same: dict[Hashable, list[Hashable]] = {}
    for a, b in joined:
        same.setdefault(a, []).append(b)
        same.setdefault(b, []).append(a)
    found: dict[int, Eq] = {}
    wanted, keys = set[Hashable](), [key(symbol) for symbol in left]
    while keys:
        if (name := keys.pop()) in wanted:
            continue
        wanted.add(name)
        keys += same.get(name, ())
        for equation in given.get(name, ()):
            if id(equation) not in found:
                found[id(equation)] = equation
                sides = (number_or_truth(s) for s in (equation.lhs, equation.rhs))
                keys += [key(symbol) for side in sides for symbol in side.free_symbols]
    return set(found)


def _cases(sides: Sequence[Any], with_events: bool) -> Iterator[tuple[bool, Any, Any, Any]]:
    """Case distinctions that are evaluated as they stand: a condition, the value where it holds, and the other."""
    for side in sides:
        for watched in sorted(side.atoms(Watched), key=str):
            condition, value, otherwise, always = watched.args
            if not (with_events or always == 1):
                yield True, condition, literal(value), literal(otherwise)
        for pieces in sorted(side.atoms(sp.Piecewise), key=str):
            args = [(literal(v), c) for v, c in pieces.args]
            for k, (value, condition) in enumerate(args[:-1]):
                yield False, condition, value, sp.Piecewise(*args[k + 1 :])


def _parameters(relation: Any, component: Component) -> list[Reference]:
    """The component's own parameters in a relation, in order of declaration."""
    own = [
        s
        for s in relation.free_symbols
        if isinstance(s, Reference)
        and isinstance(s.declaration, Parameter)
        and s.owner is component._node
    ]
    return sorted(own, key=lambda s: s.serial)


def _changes(relation: Any) -> bool:
    """Whether a relation can change in a run, at a time that is not known ahead."""
    return any(map(is_unknown, relation.free_symbols)) or not is_foreseen(literal(relation), {time})


def has_jumps(side: Any) -> bool:
    """Whether a case distinction of an expression jumps between events."""
    return any(map(is_continuous, side.atoms(sp.floor, sp.ceiling, sp.sign))) or any(
        is_continuous(relation) and _jumps(relation, value - otherwise)
        for _, condition, value, otherwise in _cases([side], with_events=True)
        for relation in condition.atoms(Relational)
    )


def is_continuous(expression: Any) -> bool:
    """Whether a comparison, or a number, can change between events."""
    symbols = expression.free_symbols
    if time in symbols or any(map(is_unknown, symbols)):
        return True
    return bool(expression.has(sp.Function) and not symbols)


def is_unknown(symbol: Any) -> bool:
    """Whether it is a variable that changes between events."""
    declared = symbol.declaration if isinstance(symbol, Reference) else None
    return isinstance(declared, Variable) and not isinstance(declared, Discrete)


def in_steps(expression: Any) -> Any:
    """The same with signs, ceilings and floors as case distinctions and integers that can be watched."""

    def steps(jumps: Any) -> Any:
        (number,) = jumps.args
        if isinstance(jumps, sp.sign):
            return sp.Piecewise((1, sp.Gt(number, 0)), (-1, sp.Lt(number, 0)), (0, True))
        turn = sp.Integer(-1 if isinstance(jumps, sp.ceiling) else 1)
        whole: Any = Floored(turn * number, sp.S.Zero)
        return turn * whole

    def can_jump(part: Any) -> bool:
        return isinstance(part, sp.sign | sp.ceiling | sp.floor) and is_continuous(part)

    return expression.replace(can_jump, steps)


def in_halves(expression: Any) -> Any:
    """The same with comparisons of ``|x|`` as two of ``x``: a short time within them is then passed, not touched."""

    def halves(relation: Any) -> Any:
        number, level = relation.lhs - relation.rhs, sp.Dummy()
        (size,) = relation.atoms(sp.Abs)
        whole = number.xreplace({size: level})
        slope = whole.diff(level)
        if not (slope.is_positive or slope.is_negative):
            return relation
        bound = -whole.xreplace({level: sp.S.Zero}) / slope
        order = relation.func if slope.is_positive else relation.reversed.func
        both = sp.And if order in (sp.Lt, sp.Le) else sp.Or
        return both(order(size.args[0], bound), order(-size.args[0], bound))

    def is_of_size(part: Any) -> bool:
        is_order = isinstance(part, sp.Gt | sp.Ge | sp.Lt | sp.Le)
        return is_order and len(part.atoms(sp.Abs)) == 1

    return expression.replace(is_of_size, halves) if expression.has(sp.Abs) else expression


def _jumps(relation: Any, difference: Any) -> bool:
    """Whether a difference is not zero where a relation changes, as far as some points can tell."""
    if difference.is_number:
        return difference != 0
    number = relation.lhs - relation.rhs
    symbols = sorted(number.free_symbols, key=str)
    for symbol in symbols:
        slope = number.diff(symbol)
        if slope != 0 and symbol not in slope.free_symbols:
            on_surface = difference.xreplace({symbol: symbol - number / slope})
            return _differs_from_zero(on_surface)
    return False


def _differs_from_zero(expression: Any) -> bool:
    others = sorted(expression.free_symbols, key=str)
    numbers = random.Random(0)
    for _ in range(POINTS):
        values = {s: sp.Float(numbers.uniform(0.5, 2.0)) for s in others}
        try:
            if abs(float(expression.xreplace(values))) > CLOSE:
                return True
        except (TypeError, ValueError):
            return False  # it holds a network, or has no value there
    return False


def _visible(component: Component, stated: Sequence[Any], with_events: bool) -> set[Any]:
    """The symbols that act in another way than through conditions as they stand."""
    found: set[Any] = set()
    for one in stated:
        if _is_literal(one):
            for side in (one.lhs, one.rhs):
                found |= _acting(number_or_truth(side), with_events).free_symbols
        elif isinstance(one, Eq):
            found |= one.lhs.free_symbols | one.rhs.free_symbols
        elif isinstance(one, When):
            for link in one.chain():
                parts = [p for s in link.statements for p in vars(s).values()]
                found |= {s for part in (*link.conditions, *parts) for s in part.free_symbols}
    for tick in [s for s in found if isinstance(s, Tick)]:
        found |= tick.start.free_symbols | tick.period.free_symbols
    node = component._node
    given = [*node.modifiers.values(), *(node.class_declarations.values())]
    for child in node.children.values():
        given += child._node.modifiers.values()
    for value in given:
        for inner in (value, *(getattr(value, n, None) for n in ("value", "default", "start"))):
            if isinstance(inner, sp.Basic):
                found |= inner.free_symbols
    for equation in read_statements(component, component.initial_equations, 0):
        if isinstance(equation, Eq):
            found |= equation.lhs.free_symbols | equation.rhs.free_symbols
    return found


def _acting(expression: Any, with_events: bool) -> sp.Basic:
    """What acts in an expression: its arguments as tuples, without the conditions that are not events."""
    if isinstance(expression, sp.Piecewise):
        return sp.Tuple(*(_acting(piece.args[0], with_events) for piece in expression.args))
    if isinstance(expression, Watched):
        condition, value, otherwise, always = iter(expression.args)
        kept = [condition] if with_events or always == 1 else []
        return sp.Tuple(_acting(value, with_events), _acting(otherwise, with_events), *kept)
    if not expression.args:
        return expression
    return sp.Tuple(*(_acting(a, with_events) for a in expression.args))
