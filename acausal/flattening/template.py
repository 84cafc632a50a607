"""Equation templates: one equation of one class, written once in slots, used by any number of instances.

sympy works on templates only; the graph works on the integers that fill their slots.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sp

if TYPE_CHECKING:
    from acausal.flattening.sums import Statement

Integers = np.ndarray[Any, np.dtype[np.int64]]


@dataclass(frozen=True)
class Template:
    """The equation ``residual = 0`` over slots.

    Attributes:
        residual: expression in the slot symbols and `acausal.modeling.declarations.time`.
        variables: slot symbols of variables; ``orders`` says how often each is differentiated.
        parameters: slot symbols of parameters. ``modules``: slot symbols of callable parameters.
        origin: the equation as its author wrote it, for messages.
    """

    residual: sp.Expr
    variables: tuple[sp.Symbol, ...]
    orders: tuple[int, ...]
    parameters: tuple[sp.Symbol, ...]
    modules: tuple[sp.Symbol, ...]
    origin: str

    @cached_property
    def _hash(self) -> int:
        return hash((self.residual, self.variables, self.orders, self.parameters, self.modules))

    def __hash__(self) -> int:
        """Computed once: templates with many slots are looked up often."""
        return self._hash

    @cached_property
    def key(self) -> tuple[Any, ...]:
        """Two templates with one key are one equation, whatever class it came from."""
        names = [*self.variables, *self.parameters, *self.modules]
        canonical = {s: sp.Symbol(f"_{i}", real=True) for i, s in enumerate(names)}
        counts = (len(self.variables), len(self.parameters), len(self.modules))
        return self.residual.xreplace(canonical), self.orders, counts


@cache
def interned(template: Template) -> Template:
    """The first template equal to this one: equality of what is interned is identity, whatever its size."""
    return template


@dataclass(frozen=True)
class EquationGroup:
    """The instances of one template: row ``i`` of each array fills the slots of instance ``i``.

    Attributes:
        variables: (n, slots) variable indices; ``parameters`` and ``modules`` likewise.
        components: (n,) index of the component that states each instance; for a connection, -1 minus the index of
            a variable that it joins.
    """

    template: Statement
    variables: Integers
    parameters: Integers
    modules: Integers
    components: Integers

    def __len__(self) -> int:
        return len(self.components)

    def rows(self, chosen: Any) -> EquationGroup:
        """The group restricted to some rows (a mask or indices)."""
        return EquationGroup(
            self.template,
            self.variables[chosen],
            self.parameters[chosen],
            self.modules[chosen],
            self.components[chosen],
        )


@dataclass(frozen=True)
class Binding:
    """A parameter or a start value given by an expression of parameters: ``target = expression(arguments)``."""

    target: int
    expression: sp.Expr
    symbols: tuple[sp.Symbol, ...]
    arguments: tuple[int, ...]


def slot(path: str, order: int = 0) -> sp.Symbol:
    """The slot symbol of a local name, ``order`` times differentiated."""
    name = path
    for _ in range(order):
        name = f"der({name})"
    return sp.Symbol(name, real=True)
