"""Equation templates: one equation of one class, written once in slots, used by any number of instances.

sympy works on templates only, once per template; the graph works on the integers that fill their slots. A `Template` is
an expression; a `Sum` (in `sums`) has the same interface, but holds integers.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any

import numpy as np
import sympy as sp
from sympy.core.relational import Relational

from acausal.errors import StructureError
from acausal.flattening.leaves_caches import LeavesCaches
from acausal.modeling import Prescribed, time

Integers = np.ndarray[Any, np.dtype[np.int64]]

KeptSlots = tuple[list[int], list[int], list[int]]
"""The columns of the slots that remain: variables, parameters, modules."""


@dataclass(frozen=True)
class Template(LeavesCaches):
    """The equation ``residual = 0`` over slots.

    Attributes:
        residual: expression in the slot symbols and `acausal.time`.
        variables: slot symbols of variables; ``orders`` says how often each is differentiated.
        parameters: slot symbols of parameters. ``modules``: slot symbols of callable parameters.
    """

    residual: sp.Expr
    variables: tuple[sp.Symbol, ...]
    orders: tuple[int, ...]
    parameters: tuple[sp.Symbol, ...]
    modules: tuple[sp.Symbol, ...]

    @cached_property
    def _hash(self) -> int:
        return hash((self.residual, self.variables, self.orders, self.parameters, self.modules))

    def __hash__(self) -> int:
        """Computed once: templates with many slots are looked up often."""
        return self._hash

    # -- rewriting ---------------------------------------------------------------------------------

    @cache
    def specialised(self, pattern: tuple[int, ...]) -> tuple[Template, KeptSlots]:
        """The template with slots merged, negated or set to zero, and the columns of the slots that remain.

        Arguments:
            pattern: for every variable slot 0 (zero), or ``±(1 + j)``: plus or minus slot j; for every parameter
                slot whether it is zero.

        Raises:
            StructureError: if something is divided by zero.
        """
        n = len(self.variables)
        replaced: dict[sp.Symbol, Any] = {}
        for symbol, code in zip(self.variables, pattern[:n], strict=True):
            merged = sp.sign(code) * self.variables[abs(code) - 1]
            replaced[symbol] = sp.S.Zero if code == 0 else merged
        for symbol, is_zero in zip(self.parameters, pattern[n:], strict=True):
            if is_zero:
                replaced[symbol] = sp.S.Zero
        replaced = {s: r for s, r in replaced.items() if s != r}
        residual: Any = self.residual.xreplace(replaced) if replaced else self.residual
        if _is_infinite(residual):
            zeros = [s.name for s, r in replaced.items() if r == 0 and s in self.parameters]
            raise StructureError(
                f"division by zero; {' and '.join(zeros) or 'a variable'} is zero there"
            )
        present = residual.free_symbols
        variables, parameters, modules = (
            [i for i, s in enumerate(slots) if s in present]
            for slots in (self.variables, self.parameters, self.modules)
        )
        special = Template(
            residual,
            tuple(self.variables[i] for i in variables),
            (0,) * len(variables),
            tuple(self.parameters[i] for i in parameters),
            tuple(self.modules[i] for i in modules),
        )
        return interned(special), (variables, parameters, modules)

    @cache
    def differentiated(self) -> tuple[Template, tuple[tuple[int, bool], ...]]:
        """The total time derivative, and where its slots come from.

        Returns:
            The new template and, per variable slot, (column of this template, whether differentiated).
        """
        slots = list(self.variables)
        taken = set(slots)
        rates = [_fresh(f"der({s.name})", taken) for s in slots]
        terms = [self.residual.diff(time)]
        terms += [self.partial(i) * r for i, r in enumerate(rates)]
        residual = sp.Add(*terms)
        present = residual.free_symbols
        kept = [(i, False) for i, s in enumerate(slots) if s in present]
        kept += [(i, True) for i, r in enumerate(rates) if r in present]
        variables = tuple(rates[i] if raised else slots[i] for i, raised in kept)
        derivative = Template(
            residual,
            variables,
            (0,) * len(variables),
            self.parameters,
            self.modules,
        )
        return derivative, tuple(kept)

    def with_orders(self, orders: tuple[int, ...]) -> Template:
        """The same equation with other orders of differentiation of its variables."""
        return replace(self, orders=orders)

    @cache
    def has_prescribed(self) -> bool:
        """Whether the equation is given the derivatives of a signal."""
        return bool(self.residual.has(Prescribed))

    @cache
    def depends_on_time(self) -> bool:
        """Whether time itself occurs in the equation."""
        return time in self.residual.free_symbols

    @cache
    def with_signals(self) -> tuple[Template, tuple[int, ...]]:
        """The equation with signals in the place of `Prescribed`, once all differentiation is done.

        Returns:
            The new template and, per variable slot, the column of this one. Signals that only serve as further
            derivatives are dropped.
        """
        residual = self.residual.replace(Prescribed, lambda order, _, *signals: signals[int(order)])
        present = residual.free_symbols
        kept = tuple(c for c, s in enumerate(self.variables) if s in present)
        variables = tuple(self.variables[c] for c in kept)
        orders = tuple(self.orders[c] for c in kept)
        return replace(self, residual=residual, variables=variables, orders=orders), kept

    # -- properties ----------------------------------------------------------------------------------

    @property
    def is_void(self) -> bool:
        """Whether the equation is void: ``0 = 0``."""
        return self.residual == 0

    @cache
    def coefficients(self) -> tuple[Any, ...] | None:
        """The numbers that slots are multiplied by if the residual is such a sum, else None."""
        if self.parameters or self.modules or not self.variables:
            return None
        if any(a.free_symbols for a in self.residual.atoms(sp.Function, sp.Pow)):
            return None
        factors = [self.partial(i) for i in range(len(self.variables))]
        if not all(f.is_number and f != 0 for f in factors):
            return None
        terms = (f * s for f, s in zip(factors, self.variables, strict=True))
        return tuple(factors) if sp.expand(self.residual - sp.Add(*terms)) == 0 else None

    @cache
    def alias(self) -> tuple[int, ...] | None:
        """``(s,)`` if it states ``first = s * second``, ``()`` if it states ``first = 0``, else None."""
        if len(self.variables) > 2:
            return None
        match self.coefficients():
            case (_,):
                return ()
            case (first, second) if -second / first in (1, -1):
                return (int(-second / first),)
            case _:
                return None

    @cache
    def partial(self, column: int) -> sp.Expr:
        """Partial derivative of the residual with respect to a variable slot."""
        return _derivative(self.residual, self.variables[column])

    @cache
    def solved(self, column: int) -> sp.Expr | None:
        """The slot as an explicit expression of the others; None where the residual is not linear in it."""
        if not self.is_solvable(column):
            return None
        symbol, factor = self.variables[column], self.partial(column)
        rest: Any = self.residual.xreplace({symbol: sp.S.Zero})
        if rest.has(sp.nan, sp.zoo, sp.oo):
            rest = sp.expand(self.residual - factor * symbol)
        return -rest / factor

    @cache
    def is_solvable(self, column: int) -> bool:
        """Whether the slot can be computed from the others by an expression."""
        symbol, factor = self.variables[column], self.partial(column)
        return factor != 0 and symbol not in factor.free_symbols | self._deciding()

    @cache
    def is_safely_solvable(self, column: int) -> bool:
        """Whether the slot appears linearly, with a coefficient that cannot vanish while a simulation runs.

        Numbers and products of parameters count as safe, anything that depends on variables, time or cases does not.
        """
        if not self.is_solvable(column):
            return False
        factor = self.partial(column)
        unsafe = factor.free_symbols & {*self.variables, time}
        return not unsafe and not factor.has(sp.Piecewise, sp.Function)

    @cache
    def is_linear(self, columns: tuple[int, ...]) -> bool:
        """Whether the residual is affine in all of these slots at once."""
        symbols = {self.variables[c] for c in columns}
        if symbols & self._deciding():
            return False
        return not any(self.partial(c).free_symbols & symbols for c in columns)

    def weights(self, column: int) -> tuple[float, ...] | None:
        """Weights whose sum over the other slots is this one; None for a template, see `solved`."""
        return None

    def split(self, inside: tuple[bool, ...]) -> None:
        """None: a template reads variables outside of a loop slot by slot. See `Sum.split`."""

    @cache
    def _deciding(self) -> set[Any]:
        """The symbols that decide a case or a step: the residual jumps there, which its derivatives do not show."""
        places = self.residual.atoms(Relational, sp.Function)
        return set().union(*(p.free_symbols for p in places if not isinstance(p, sp.Piecewise)))


def _derivative(expression: Any, symbol: sp.Symbol) -> Any:
    """The derivative, from those arguments of sums and products that contain the symbol: of hundreds a few."""
    if not isinstance(expression, sp.Add | sp.Mul):
        return expression.diff(symbol)
    places = _places(expression).get(symbol, ())
    if isinstance(expression, sp.Add):
        return sp.Add(*(_derivative(expression.args[i], symbol) for i in places))
    if len(places) != 1:
        return expression.diff(symbol)
    factors = list(expression.args)
    factors[places[0]] = _derivative(factors[places[0]], symbol)
    return sp.Mul(*factors)


@cache
def _places(expression: sp.Expr) -> dict[Any, list[int]]:
    """For every symbol, the arguments of an expression that contain it."""
    found: dict[Any, list[int]] = {}
    for i, argument in enumerate(expression.args):
        for symbol in argument.free_symbols:
            found.setdefault(symbol, []).append(i)
    return found


@cache
def interned(template: Template) -> Template:
    """The first template equal to this one: interned templates are equal only if they are identical."""
    return template


def slot(path: str, order: int = 0) -> sp.Symbol:
    """The slot symbol of a local name, ``order`` times differentiated."""
    name = path
    for _ in range(order):
        name = f"der({name})"
    return sp.Symbol(name, real=True)


def _fresh(name: str, taken: set[sp.Symbol]) -> sp.Symbol:
    """A slot with that name or a similar one: the template may hold the same derivative with the other sign."""
    symbol = sp.Symbol(name, real=True)
    return _fresh(f"{name}'", taken) if symbol in taken else symbol


def _is_infinite(expression: Any) -> bool:
    """Whether an expression is not finite, whatever its conditions choose; a value that they avoid may be infinite."""
    if isinstance(expression, sp.Piecewise):
        pairs: Any = expression.args
        return all(_is_infinite(value) for value, _ in pairs)
    if expression in (sp.zoo, sp.nan, sp.oo, -sp.oo):
        return True
    return expression.has(sp.zoo, sp.nan, sp.oo) and any(map(_is_infinite, expression.args))
