"""Values and starts that are expressions of parameters, as bindings to numbered parameters."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
from typing import Any

import numpy as np
import sympy as sp

from acausal.errors import DeclarationError
from acausal.flattening.layout import Layout
from acausal.flattening.template import Integers
from acausal.modeling import Parameter, Reference, literal, references

ALONE = sp.Symbol("p0", real=True)
"""The symbol in a binding to a single parameter."""


MAX_DOUBLINGS = 64
"""Of the length of chains of parameters that are followed to their end."""


@dataclass(frozen=True)
class Binding:
    """A parameter or a start value given by an expression of parameters: ``target = expression(arguments)``."""

    target: int
    expression: sp.Expr
    symbols: tuple[sp.Symbol, ...]
    arguments: tuple[int, ...]


def is_bound(value: Any) -> bool:
    """Whether a value depends on parameters."""
    return isinstance(value, Reference) or (isinstance(value, sp.Expr) and not value.is_number)


def shifted(layout: Layout, owner: int, binding: Binding, member: int, target: int) -> Binding:
    """A binding of one component to its own parameters, for another component of the same form."""
    by = int(layout.parameter_base[member] - layout.parameter_base[owner])
    arguments = tuple(a + by for a in binding.arguments)
    return Binding(target, binding.expression, binding.symbols, arguments)


def bind(layout: Layout, target: int, expression: sp.Expr, name: Callable[[int], str]) -> Binding:
    """A value given by parameters; ``name`` is the function that names the target in a message."""
    symbols: list[sp.Symbol] = []
    arguments: list[int] = []
    names: dict[sp.Symbol, sp.Symbol] = {}
    alone = isinstance(expression, Reference)
    for reference in (expression,) if alone else references(expression):
        number = layout.position.get(id(reference.owner))
        if number is None:
            raise DeclarationError(
                f"'{name(target)}' refers to '{reference.path}' of {reference.owner.label}, which is not "
                "part of the model; assign that component to an attribute, or give a number"
            )
        if not isinstance(reference.declaration, Parameter):
            raise DeclarationError(
                f"'{name(target)}' is given by '{reference.path}' of {reference.owner.label}, which changes with time; "
                "only parameters may stand there"
            )
        names[reference] = ALONE if alone else sp.Symbol(f"p{len(symbols)}", real=True)
        symbols.append(names[reference])
        index = layout.form(number).parameter_index[reference.path]
        arguments.append(int(layout.parameter_base[number]) + index)
    without_events = literal(expression)
    named: Any = ALONE if alone else without_events.xreplace(names)
    return Binding(target, named, tuple(symbols), tuple(arguments))


def parameter_aliases(bindings: Sequence[Binding], n_parameters: int) -> Integers:
    """For every parameter, the one at the end of its chain: a parameter bound to nothing but another is that other."""
    target = np.arange(n_parameters)
    for binding in bindings:
        if binding.expression in binding.symbols:
            target[binding.target] = binding.arguments[0]
    for _ in range(MAX_DOUBLINGS):
        further = target[target]
        if np.array_equal(further, target):
            return target
        target = further
    circular = np.flatnonzero(target[target] != target)  # refused when parameters are laid out
    target[circular] = circular
    return target


def binding_levels(
    bindings: Sequence[Binding], aliases: Integers
) -> tuple[list[list[Binding]], list[Binding]]:
    """Levels of bindings, each of which needs earlier levels only; and the bindings in a circle or behind one.

    Parameters are read at their aliases.
    """
    number = {b.target: i for i, b in enumerate(bindings)}
    needs = [
        {number[a] for a in aliases[list(b.arguments)].tolist() if a in number} for b in bindings
    ]
    order = TopologicalSorter(dict(enumerate(needs)))
    levels: list[list[Binding]] = []
    done = set[int]()
    with suppress(CycleError):
        order.prepare()
    while ready := sorted(order.get_ready()):
        levels.append([bindings[i] for i in ready])
        done.update(ready)
        order.done(*ready)
    return levels, [b for i, b in enumerate(bindings) if i not in done]
