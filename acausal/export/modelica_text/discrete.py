"""Discrete variables as Modelica has them: whole numbers by equations, reals within when-clauses only.

An equation of an Integer needs a right side that changes at events only, so conditions in it are events there
(Modelica 3.6, section 3.8.4), and a real number in it is rounded. A real variable is discrete because a when-clause
assigns it (section 4.5). Discrete variables must not depend on each other in a circle but through ``pre``
(appendix B); where acausal iterates over such a circle, the event iteration of Modelica does so instead.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import sympy as sp

from acausal.errors import ModelError
from acausal.flattening import discrete_side
from acausal.modeling import (
    HALF,
    INITIAL,
    Discrete,
    Eq,
    Previous,
    Reference,
    Watched,
    When,
    change,
    references,
)

ARITHMETIC = (sp.Add, sp.Mul, sp.Max, sp.Min, sp.Abs, sp.sign, sp.Mod)
"""Operations whose results are whole where their arguments are."""


def is_discrete(expression: Any, *kinds: str) -> bool:
    """Whether this is a discrete variable, of one of some kinds."""
    declared = getattr(expression, "declaration", None)
    return isinstance(declared, Discrete) and (not kinds or declared.kind in kinds)


def is_whole(expression: Any) -> bool:
    """Whether an expression has the type Integer in Modelica, or that of a condition."""
    arguments: Any = expression.args
    match expression:
        case Previous():
            return is_discrete(expression.reference, "int", "bool")
        case Reference():
            return is_discrete(expression, "int", "bool")
        case sp.Piecewise():
            return all(is_whole(value) for value, _ in arguments)
        case Watched():
            return all(map(is_whole, arguments[1:3]))
        case sp.logic.boolalg.Boolean():
            return True
        case _ if isinstance(expression, ARITHMETIC):
            return all(map(is_whole, arguments))
        case _:
            return bool(expression.is_Integer)


def cases(expression: Any) -> tuple[list[tuple[Any, Any]], Any]:
    """Pairs of condition and value of a chain of case distinctions, and what holds otherwise."""
    arguments: Any = expression.args
    match expression:
        case sp.Piecewise():
            *pairs, (last, always) = arguments
            if always != sp.true:
                return [], expression
            more, otherwise = cases(last)
            return [*((holds, value) for value, holds in pairs), *more], otherwise
        case Watched():
            holds, value, other, _ = arguments
            more, otherwise = cases(other)
            return [(holds, value), *more], otherwise
        case _:
            return [], expression


def stated(equations: Sequence[Any], label: str) -> Iterator[Any]:
    """The equations of a class, those of discrete variables as Modelica wants them.

    Raises:
        ModelError: for a discrete variable that takes the value of a continuous one at events of other components.
    """
    given = {e: e.lhs for e in equations if isinstance(e, Eq) and discrete_side(e) is e.lhs}
    whole = [e for e, variable in given.items() if is_discrete(variable, "int", "bool")]
    circles = _circles(whole)
    changes = [sp.Gt(INITIAL, HALF), *(change(e.lhs) for e in whole)]
    for equation in equations:
        if equation in whole:
            yield Eq(equation.lhs, equation.rhs.xreplace(circles.get(equation.lhs, {})))
        elif equation in given and is_discrete(equation.lhs, "real"):
            yield _assigned(equation, changes, label)
        elif isinstance(equation, Eq) and is_discrete(equation.lhs):
            yield Eq(equation.rhs, equation.lhs)  # it gives something else, such as a derivative
        else:
            yield equation


def _assigned(equation: Eq, changes: Sequence[Any], label: str) -> When:
    """A real variable's equation as a when-clause: at the instants at which its conditions come true."""
    variable: Any = equation.lhs
    pairs, otherwise = cases(equation.rhs)
    if otherwise == Previous(variable):
        link: When | None = None
        for holds, value in reversed(pairs):
            link = When(holds, Eq(equation.lhs, value), otherwise=link)
        if link is not None:
            return link
    if len(changes) == 1:
        raise ModelError(
            f"export.modelica: '{equation.lhs}' of {label} changes at every event of the model, which Modelica cannot "
            "say; state when it does: ac.When(condition, ac.Eq(...))"
        )
    return When(list(changes), Eq(equation.lhs, equation.rhs))


def _circles(equations: Sequence[Eq]) -> dict[Any, dict[Any, Any]]:
    """By variable, which others of its circle are to be read as they were: itself, and those that come later."""
    place = {e.lhs: i for i, e in enumerate(equations)}
    reads = {e.lhs: [r for r in references(e.rhs) if r in place] for e in equations}

    def reached(start: Any) -> set[Any]:
        found: set[Any] = set()
        waiting = list(reads[start])
        while waiting:
            if (one := waiting.pop()) not in found:
                found.add(one)
                waiting += reads[one]
        return found

    beyond = {v: reached(v) for v in place}
    return {
        v: {r: Previous(r) for r in read if v in beyond[r] and place[r] >= place[v]}
        for v, read in reads.items()
    }
