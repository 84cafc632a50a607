"""Homogeneity: the dimension of an expression, from those of its symbols.

An unknown dimension (None) agrees with any other. Symbols without a unit have it, and so have numbers: a number that is
a term takes the dimension of the other terms, and the factor of a single quantity, ``3*tanh(v)``, may be a constant
with a dimension. In formulas, such as ``m*v**2/2`` and ``2*pi*f``, small numbers (`is_small`) are pure numbers.
"""

from __future__ import annotations

import itertools
import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, lru_cache
from typing import Any

import sympy as sp
from sympy.core.relational import Relational
from sympy.logic.boolalg import Boolean

from acausal.errors import shortened
from acausal.modeling import Atan2, ModuleCall, Prescribed, time
from acausal.units.dimensions import NUMBER, SECOND, Dimension, described

MAX_CASES = 64
"""The most cases of one expression that are checked one by one; with more, the expression is checked as a whole."""

MAX_SMALL = 12
"""The largest numerator and denominator of a small number."""


@dataclass(frozen=True)
class Signature:
    """Dimensions of a callable parameter's arguments and result; None where they are unknown."""

    arguments: tuple[Dimension | None, ...] = ()
    result: Dimension | None = None


SlotDimensions = tuple[tuple[sp.Symbol, Dimension | Signature | None], ...]
"""Every symbol, or those that are known, with its dimension."""


@dataclass(frozen=True)
class Finding:
    """A term of the wrong dimension: the sentence for it, and the quotient of its dimension and the right one."""

    reason: str
    excess: Dimension


@lru_cache(maxsize=4096)
def examine(expression: sp.Expr, slots: SlotDimensions) -> Finding | None:
    """The first term, comparison or argument of a function that has the wrong dimension; None if there is none.

    Numbers in the branches of cases may have a dimension of their own. Therefore an expression with cases is right if
    every case is: ``v*where(off, G, 1) - i*where(off, 1, R)`` is ``G*v - i`` or ``v - R*i``.
    """
    known = dict(slots)
    finding = _first_finding(expression, known)
    if finding is None or not expression.has(sp.Piecewise):
        return finding
    return next(filter(None, (_first_finding(case, known) for case in _cases_of(expression))), None)


def _first_finding(expression: Any, known: Mapping[Any, Any]) -> Finding | None:
    try:
        _Walk(known).of(expression)
    except _Unlike as unlike:
        return unlike.finding
    return None


def _cases_of(expression: Any) -> Iterator[Any]:
    """The cases themselves, and the expression in every combination of them; where these are many, the expression.

    Cases with the same conditions are combined only with each other.
    """
    pieces: dict[tuple[Any, ...], list[Any]] = {}
    for piece in sorted(expression.atoms(sp.Piecewise), key=sp.default_sort_key):
        pieces.setdefault(tuple(condition for _, condition in piece.args), []).append(piece)
    if math.prod(map(len, pieces)) > MAX_CASES:
        yield expression
        return
    yield from itertools.chain.from_iterable(pieces.values())
    for choice in itertools.product(*(range(len(conditions)) for conditions in pieces)):
        chosen = zip(choice, pieces.values(), strict=True)
        yield expression.xreplace({p: p.args[i][0] for i, same in chosen for p in same})


class _Unlike(Exception):  # noqa: N818 (a finding, not an error)
    """Carries a finding up through the recursion."""

    def __init__(self, reason: str, excess: Dimension) -> None:
        super().__init__(reason)
        self.finding = Finding(reason, excess)


def is_small(number: Any) -> bool:
    """Whether a number is a pure factor such as 2, 1/2, 0.5 or pi; 9.81 and 1000 may be constants of nature."""
    ratios = (
        (n.p, n.q) if n.is_Rational else float(n).as_integer_ratio()
        for n in number.atoms(sp.Number)
    )
    return all(abs(above) <= MAX_SMALL and below <= MAX_SMALL for above, below in ratios)


class _Walk:
    """One expression with known symbols; a part that occurs often is visited once."""

    def __init__(self, known: Mapping[Any, Any]) -> None:
        self.known = known
        self.seen: dict[Any, Dimension | None] = {time: SECOND}

    def of(self, part: Any) -> Dimension | None:
        """The dimension of a part of the expression."""
        if part.is_Symbol or part in self.seen:
            return self.seen.get(part, self.known.get(part))
        if part.is_number:
            return None
        found = self.seen[part] = _rule(type(part))(self, part)
        return found

    def common(self, parts: Iterable[Any], are_summed: bool = False) -> Dimension | None:
        """The one unit that all parts have; temperatures that are not summed are on one scale, too."""
        first: Any = None
        found: Dimension | None = None
        for part in parts:
            here = self.of(part)
            if here is None:
                continue
            if found is None:
                first, found = part, here
            elif not (
                (found.agrees(here) or _converts(found, here, first, part))
                and (are_summed or found.is_on_scale_of(here))
            ):
                raise _apart(first, found, part, here)
            elif found.zero is None:
                first, found = part, here
        return found

    def pure(self, part: Any, role: str) -> Dimension | None:
        """A part that must be a pure number; an expression of the time alone may be one, as in ``sin(time)``."""
        found = None if part.free_symbols == {time} else self.of(part)
        if found is not None and not found.agrees(NUMBER):
            raise _wrong(f"{role} {_quoted(part)}", found, NUMBER)
        return found


def _apart(first: Any, found: Dimension, part: Any, here: Dimension) -> _Unlike:
    reason = f"{_quoted(first)} is in {described(found)} but {_quoted(part)} in {described(here)}"
    return _Unlike(reason, here / found)


def _converts(found: Dimension, here: Dimension, *terms: Any) -> bool:
    """Whether the number before a term converts one unit to the other: ``10*x``, in m and dm."""
    if found.exponents != here.exponents:
        return False
    numbers = (abs(term.as_coeff_Mul()[0]) for term in terms)
    ratio = here.factor / found.factor
    return any(math.isclose(n, r, rel_tol=1e-9) for n in numbers for r in (ratio, 1 / ratio))


def _wrong(name: str, found: Dimension, wanted: Dimension) -> _Unlike:
    """The finding that something has the wrong dimension."""
    need = "a pure number" if wanted == NUMBER else f"in {described(wanted)}"
    return _Unlike(f"{name} is in {described(found)} but must be {need}", found / wanted)


def _quoted(term: Any) -> str:
    """A term without its sign, for a message."""
    negative = term.is_Mul and term.as_coeff_Mul()[0].is_negative
    return f"'{shortened(str(-term if negative else term))}'"


# -- rules: one for each kind of expression ------------------------------------------------------------

DimensionRule = Callable[[_Walk, Any], Dimension | None]


def _alike(walk: _Walk, expression: Any) -> Dimension | None:
    return walk.common(expression.args)


def _sum(walk: _Walk, expression: Any) -> Dimension | None:
    """A sum; temperatures on two scales are added only as differences on each, or beside a number such as 273.15.

    Where a term is neither, such as a product, the scales are not compared. A bracket's factor may have a dimension,
    and sympy multiplies it out: terms of one dimension with equal factors, ``3*x - 3*y``, are compared as in it.
    """
    for bracket, is_whole in _multiplied_out(walk, expression):
        if is_whole:
            _sum(walk, bracket)
        walk.common(bracket.args, are_summed=True)
    found = walk.common(expression.args, are_summed=True)
    found = None if found is None else replace(found, zero=None)
    terms: dict[float, list[tuple[Any, Any, Dimension]]] = {}
    for part in expression.args:
        factor, term = part.as_coeff_Mul()
        here = walk.of(term)
        if here is None or here.zero is None:
            return found
        terms.setdefault(here.zero, []).append((factor, term, here))
    if len(terms) > 1 and all(abs(sum(n for n, *_ in same)) > 1e-9 for same in terms.values()):
        (_, *first), (_, *other) = (same[0] for same in [*terms.values()][:2])
        raise _apart(*first, *other)
    return found


def _multiplied_out(walk: _Walk, expression: Any) -> Iterator[tuple[Any, bool]]:
    """The brackets, each with terms of one dimension, whose factors sympy has multiplied out.

    And whether one is whole: no further term may have been in it.
    """
    brackets = defaultdict[float, defaultdict[Any, list[Any]]](lambda: defaultdict(list))
    dimensions = list[Any]()
    for part in expression.args:
        factor, term = part.as_coeff_Mul()
        here = walk.of(term)
        exponents = None if here is None else here.exponents
        brackets[float(abs(factor))][exponents].append(sp.sign(factor) * term)
        dimensions.append(exponents)
    for factor, terms in brackets.items():
        for exponents, alike in terms.items():
            if factor != 1 and exponents is not None and len(alike) > 1:
                is_whole = None not in dimensions and dimensions.count(exponents) == len(alike)
                yield sp.Add(*alike), is_whole


def _parts(walk: _Walk, expression: Any) -> None:
    for part in expression.args:
        walk.of(part)


def _compared(walk: _Walk, expression: Any) -> None:
    walk.common(expression.args)


def _number(walk: _Walk, expression: Any) -> Dimension:
    """A sign or an angle is a pure number, whatever the dimension that its arguments share."""
    walk.common(expression.args)
    return NUMBER


def _function(walk: _Walk, expression: Any) -> Dimension:
    walk.pure(expression.args[0], f"the argument of {expression.func.__name__},")
    return NUMBER


def _product(walk: _Walk, expression: Any) -> Dimension | None:
    numbers = [f for f in expression.args if f.is_number and f not in (1, -1)]
    quantities = [walk.of(f) for f in expression.args if not f.is_number]
    known = [q for q in quantities if q is not None]
    is_formula = len(quantities) > 1 or not numbers or any(n.is_irrational for n in numbers)
    if len(known) < len(quantities) or not (is_formula and all(map(is_small, numbers))):
        return None
    found = known[0] if len(known) == 1 else math.prod(known, start=NUMBER)
    converts = found.factor != 1.0 and any(n.is_irrational for n in numbers)  # 2*pi*n, n in rev/s
    return replace(found, factor=math.nan) if converts else found


def _power(walk: _Walk, expression: Any) -> Dimension | None:
    base, exponent = expression.args
    found = walk.of(base)
    if exponent.is_number:
        ratio = Fraction(float(exponent)).limit_denominator(1000)
        return None if found is None else found**ratio
    varied = walk.pure(exponent, f"the exponent of {_quoted(base)},")
    if varied is not None:
        walk.pure(base, f"the base of {_quoted(expression)},")
    return NUMBER if base.is_number or (found is not None and found.agrees(NUMBER)) else None


def _cases(walk: _Walk, expression: Any) -> Dimension | None:
    for _, condition in expression.args:
        walk.of(condition)
    return walk.common(value for value, _ in expression.args)


def _prescribed(walk: _Walk, expression: Any) -> Dimension | None:
    order, _, *signals = expression.args
    found: Dimension | None = None
    for n, signal in enumerate(signals):
        here = walk.of(signal)
        if here is None:
            continue
        if found is not None and not found.agrees(here * SECOND**n):
            name = f"{_quoted(signal)}, derivative {n} of {_quoted(signals[0])},"
            raise _wrong(name, here, found / SECOND**n)
        found = here * SECOND**n
    return None if found is None else found / SECOND ** int(order)


def _call(walk: _Walk, expression: Any) -> Dimension | None:
    """A network; differentiated, its result is divided by its arguments."""
    module, orders, *arguments = expression.args
    signature = walk.known.get(module, Signature())
    declared = dict(enumerate(signature.arguments))
    found = signature.result
    for i, (argument, order) in enumerate(zip(arguments, orders, strict=True)):
        here, takes = walk.of(argument), declared.get(i)
        if (here is not None and takes is not None) and not (
            takes.agrees(here) and takes.is_on_scale_of(here)
        ):
            raise _wrong(f"argument {i + 1} of '{module}', {_quoted(argument)},", here, takes)
        if order:
            divisor = here or takes
            found = None if found is None or divisor is None else found / divisor ** int(order)
    return found


RULES: dict[type, DimensionRule] = {
    sp.Add: _sum,
    sp.Mul: _product,
    sp.Pow: _power,
    sp.Piecewise: _cases,
    Relational: _compared,
    Boolean: _parts,
    **dict.fromkeys((sp.Abs, sp.Max, sp.Min, sp.Mod, sp.floor, sp.ceiling), _alike),
    **dict.fromkeys((sp.sign, sp.Heaviside, sp.atan2, Atan2), _number),
    **dict.fromkeys((sp.exp, sp.log, sp.sin, sp.cos, sp.tan, sp.asin, sp.acos, sp.atan), _function),
    **dict.fromkeys((sp.sinh, sp.cosh, sp.tanh, sp.asinh), _function),
    Prescribed: _prescribed,
    ModuleCall: _call,
}


@cache
def _rule(kind: type) -> DimensionRule:
    return next(RULES[k] for k in kind.__mro__ if k in RULES)
