"""Lower: sympy expressions become JAX operations, node by node, from a table of rules.

Nothing is printed or executed as text; an expression is walked while JAX traces, with common
subexpressions evaluated once.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import sympy as sp
from sympy.functions.elementary.piecewise import ExprCondPair
from sympy.logic.boolalg import Boolean

from acausal.errors import ModelError
from acausal.modeling import Atan2, GivenModule, ModuleCall, Prescribed


@dataclass(frozen=True)
class ModuleValue:
    """A callable parameter at run time.

    Attributes:
        module: one module for all instances; or, if ``stacked``, one whose arrays carry a leading axis of
            instances; or a tuple of different modules, one for each instance.
    """

    module: Any
    stacked: bool = False

    def __call__(self, orders: tuple[int, ...], *args: Any) -> Any:
        """The module, or a partial derivative of it, for scalars or for arrays over instances."""
        return self.mapped(lambda m, *a: _derivative(_scalar(m), orders)(*a), *args)

    def mapped(self, function: Callable[..., Any], *args: Any) -> Any:
        """``function(module, *args)`` for scalars, or for each instance; it may give several values."""
        if isinstance(self.module, tuple):
            n = len(self.module)
            each = zip(self.module, *(jnp.broadcast_to(a, (n,)) for a in args), strict=True)
            return jax.tree.map(lambda *v: jnp.stack(v), *(function(m, *a) for m, *a in each))
        if self.stacked:
            arrays, rest = eqx.partition(self.module, eqx.is_array)
            n = jax.tree.leaves(arrays)[0].shape[0]
            batched = [jnp.broadcast_to(a, (n,)) for a in args]
            return jax.vmap(lambda m, *a: function(eqx.combine(m, rest), *a))(arrays, *batched)
        shape = jnp.broadcast_shapes(*(jnp.shape(a) for a in args))
        own = lambda *a: function(self.module, *a)  # noqa: E731
        return jax.vmap(own)(*(jnp.broadcast_to(a, shape) for a in args)) if shape else own(*args)


def collect(modules: Sequence[Any]) -> ModuleValue:
    """The modules of several instances: stacked if they differ only in the values of their arrays.

    Those that are no parameters are one if they are equal.
    """
    if all(getattr(m, "is_fixed", False) and m == modules[0] for m in modules):
        return ModuleValue(modules[0])
    parts = [eqx.partition(m, eqx.is_array) for m in modules]
    (first, rest), *others = parts
    alike = bool(jax.tree.leaves(first)) and all(
        jax.tree.structure(arrays) == jax.tree.structure(first)
        and jax.tree.map(jnp.shape, arrays) == jax.tree.map(jnp.shape, first)
        and eqx.tree_equal(static, rest) is True
        for arrays, static in others
    )
    if not alike:
        return ModuleValue(tuple(modules))
    stacked = jax.tree.map(lambda *leaves: jnp.stack(leaves), *(arrays for arrays, _ in parts))
    return ModuleValue(eqx.combine(stacked, rest), stacked=True)


def _scalar(module: Any) -> Callable[..., Any]:
    def call(*args: Any) -> Any:
        value = jnp.reshape(module(*args), ())
        if jnp.iscomplexobj(value):
            raise TypeError("its result is complex")
        return value

    return call


def _derivative(function: Callable[..., Any], orders: tuple[int, ...]) -> Callable[..., Any]:
    for position, times in enumerate(orders):
        for _ in range(times):
            function = jax.grad(function, argnums=position)
    return function


SymbolValues = Mapping[sp.Symbol, Any]


def evaluate(expression: sp.Expr, values: SymbolValues) -> Any:
    """Value of an expression for the values of its symbols (scalars or arrays of one length)."""
    memo: dict[sp.Basic, Any] = {**values}

    def visit(node: sp.Basic) -> Any:
        if node not in memo:
            memo[node] = _rule(node)(node, visit)
        return memo[node]

    return visit(expression)


Visit = Callable[[sp.Basic], Any]
LoweringRule = Callable[[Any, Visit], Any]


def _rule(node: sp.Basic) -> LoweringRule:
    for cls in type(node).__mro__:
        if cls in RULES:
            return RULES[cls]
    raise ModelError(
        f"'{type(node).__name__}' cannot be computed; use the functions that acausal exports"
    )


def _number(node: Any, visit: Visit) -> Any:
    return float(node)


def _sum(node: sp.Add, visit: Visit) -> Any:
    total: Any = None
    terms: list[Any] = list(node.args)
    for term in sorted(terms, key=lambda t: bool(t.could_extract_minus_sign())):  # positive first
        negative = term.could_extract_minus_sign() and (term.is_Number or term.is_Mul)
        value = visit(-term if negative else term)
        if total is None:
            total = -value if negative else value
            continue
        total = total - value if negative else total + value
    return total


def _product(node: Any, visit: Visit) -> Any:
    above: Any = None
    below: Any = None
    sign = 1.0
    for factor in node.args:
        if factor is sp.S.NegativeOne:
            sign = -sign
        elif factor.is_Pow and factor.exp.is_Number and factor.exp.is_negative:
            value = visit(sp.Pow(factor.base, -factor.exp))
            below = value if below is None else below * value
        else:
            value = visit(factor)
            above = value if above is None else above * value
    above = 1.0 if above is None else above
    result = above if below is None else above / below
    return -result if sign < 0 else result


def _power(node: sp.Pow, visit: Visit) -> Any:
    base, exponent = visit(node.base), node.exp
    if exponent == sp.S.Half:
        return jnp.sqrt(base)
    if exponent.is_Integer:
        n = int(exponent)
        power = (
            base ** abs(n)
            if isinstance(base, float)
            else jax.lax.integer_pow(jnp.asarray(base), abs(n))
        )
        return 1.0 / power if n < 0 else power
    if exponent.is_negative and exponent.is_Number:
        return 1.0 / visit(sp.Pow(node.base, -exponent))
    return jnp.power(base, visit(exponent))


def _piecewise(node: Any, visit: Visit) -> Any:
    values = [value for value, _ in node.args]
    holds = [visit(condition) for _, condition in node.args]
    firsts = _firsts(holds) if any(map(_is_steep, values)) else holds
    cases = [_case(value, first, visit) for value, first in zip(values, firsts, strict=True)]
    result: Any = jnp.nan
    for condition, value in zip(reversed(holds), reversed(cases), strict=True):
        result = value if condition is True else jnp.where(condition, value, result)
    return result


def _firsts(conditions: Sequence[Any]) -> list[Any]:
    """Whether each condition is the first that holds."""
    earlier = conditions[0]
    found = [earlier]
    for holds in conditions[1:]:
        found.append(jnp.logical_and(holds, jnp.logical_not(earlier)))
        earlier = jnp.logical_or(holds, earlier)
    return found


def _case(value: Any, holds: Any, visit: Visit) -> Any:
    """A case whose gradient counts only where it holds: elsewhere its derivative may be infinite."""
    if not _is_steep(value):
        return visit(value)
    read = {s: visit(s) for s in sorted(value.free_symbols, key=str)}
    return evaluate(value, {s: _only_where(holds, v) for s, v in read.items()})


GENTLE = (
    sp.Atom, sp.Add, sp.Mul, sp.sin, sp.cos, sp.atan, sp.asinh, sp.tanh, sp.Abs, sp.sign, sp.floor,
    sp.ceiling, sp.Heaviside, sp.Max, sp.Min, sp.Piecewise, ExprCondPair,
)  # fmt: skip
"""Operations whose derivatives are finite wherever their arguments are."""


@cache
def _is_steep(value: sp.Basic) -> bool:
    """Whether a derivative may be infinite somewhere; those of conditions are never taken."""
    if isinstance(value, Boolean):
        return False
    if isinstance(value, sp.Pow):
        is_gentle = value.exp.is_Integer and value.exp.is_positive
    else:
        is_gentle = isinstance(value, GENTLE)
    return not is_gentle or any(map(_is_steep, value.args))


def _only_where(holds: Any, value: Any) -> Any:
    if isinstance(value, ModuleValue):
        return value
    return jnp.where(holds, value, jax.lax.stop_gradient(value))


def _call(function: Callable[..., Any]) -> LoweringRule:
    return lambda node, visit: function(*(visit(a) for a in node.args))


def _fold(function: Callable[[Any, Any], Any]) -> LoweringRule:
    def fold(node: Any, visit: Visit) -> Any:
        first, *others = (visit(a) for a in node.args)
        for other in others:
            first = function(first, other)
        return first

    return fold


def _module(node: Any, visit: Visit) -> Any:
    module, orders, *args = node.args
    call, values = visit(module), [jnp.asarray(visit(a)) for a in args]
    try:
        return call(tuple(int(n) for n in orders), *values)
    except (TypeError, ValueError) as error:
        reason = str(error).partition("\n")[0]
        numbers = f"{len(args)} number{'s' * (len(args) != 1)}"
        raise ModelError(
            f"the network '{module}' cannot be evaluated ({reason}); it is called with {numbers} that JAX traces, "
            "and gives one: write it with jax.numpy"
        ) from error


RULES: dict[type, LoweringRule] = {
    sp.Number: _number,
    sp.NumberSymbol: _number,
    sp.Add: _sum,
    sp.Mul: _product,
    sp.Pow: _power,
    sp.exp: _call(jnp.exp),
    sp.log: _call(jnp.log),
    sp.sin: _call(jnp.sin),
    sp.cos: _call(jnp.cos),
    sp.tan: _call(jnp.tan),
    sp.asin: _call(jnp.arcsin),
    sp.acos: _call(jnp.arccos),
    sp.atan: _call(jnp.arctan),
    **dict.fromkeys((sp.atan2, Atan2), _call(jnp.arctan2)),
    sp.sinh: _call(jnp.sinh),
    sp.asinh: _call(jnp.arcsinh),
    sp.cosh: _call(jnp.cosh),
    sp.tanh: _call(jnp.tanh),
    sp.Abs: _call(jnp.abs),
    sp.sign: _call(jnp.sign),
    sp.floor: _call(jnp.floor),
    sp.ceiling: _call(jnp.ceil),
    sp.Mod: _call(jnp.mod),
    sp.Heaviside: _call(lambda x, *_: jnp.where(jnp.asarray(x) >= 0, 1.0, 0.0)),
    sp.DiracDelta: _call(lambda x, *_: jnp.zeros_like(jnp.asarray(x))),
    sp.Max: _fold(jnp.maximum),
    sp.Min: _fold(jnp.minimum),
    sp.Piecewise: _piecewise,
    sp.Gt: _call(lambda a, b: jnp.asarray(a) > b),
    sp.Ge: _call(lambda a, b: jnp.asarray(a) >= b),
    sp.Lt: _call(lambda a, b: jnp.asarray(a) < b),
    sp.Le: _call(lambda a, b: jnp.asarray(a) <= b),
    sp.Eq: _call(lambda a, b: jnp.asarray(a) == b),
    sp.Ne: _call(lambda a, b: jnp.asarray(a) != b),
    sp.And: _fold(jnp.logical_and),
    sp.Or: _fold(jnp.logical_or),
    sp.Not: _call(jnp.logical_not),
    sp.ITE: _call(jnp.where),
    sp.logic.boolalg.BooleanTrue: lambda node, visit: True,
    sp.logic.boolalg.BooleanFalse: lambda node, visit: False,
    GivenModule: lambda node, visit: ModuleValue(node.value),
    ModuleCall: _module,
    Prescribed: lambda node, visit: visit(node.args[2 + int(node.args[0])]),
}
