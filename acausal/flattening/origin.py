"""Origins: where equations are stated, for messages; what an equation is does not depend on it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from typing import Any

import numpy as np
import sympy as sp
from sympy.core.relational import Relational

from acausal.flattening.leaves_caches import LeavesCaches
from acausal.flattening.template import slot
from acausal.modeling import HALF, Component, Eq, Reference, literal, references

Origins = np.ndarray[Any, np.dtype[np.object_]]
"""An `Origin` for every instance."""

HIDDEN = "_event"
"""How the names of hidden discrete variables begin."""


def is_hidden(name: str) -> bool:
    """Whether a variable is one of a watched condition, which users do not see."""
    return name.rpartition(".")[2].startswith(HIDDEN)


@dataclass(frozen=True, eq=False)
class Origin(LeavesCaches):
    """Where an equation is stated, and how its author wrote it: text that is made when a message needs it.

    Attributes:
        stated: the equation, or a text. owner: a component that states it; None for connections.
        derivatives: how often it was differentiated since.
    """

    stated: Eq | str
    owner: Component | None = None
    derivatives: int = 0

    @property
    def cls(self) -> str:
        """The class that states it."""
        return "" if self.owner is None else type(self.owner).__name__

    @property
    def place(self) -> str:
        """The line of a file where it is stated, as far as that is known."""
        return "" if isinstance(self.stated, str) else self.stated.place

    @cached_property
    def text(self) -> str:
        """The equation as its author wrote it."""
        if isinstance(self.stated, str) or self.owner is None:
            return str(self.stated)
        return str(_with_names(self.stated, self.owner))

    def __str__(self) -> str:
        whole = f"{self.cls}: {self.text}" if self.owner else self.text
        return "derivative of " * self.derivatives + whole

    @cached_property
    def differentiated(self) -> Origin:
        """The origin of the equation's derivative."""
        return replace(self, derivatives=self.derivatives + 1)

    def of(self, instances: int) -> Origins:
        """The origin of so many instances."""
        return np.full(instances, self, dtype=np.object_)


def dotted(symbols: Iterable[Reference], owner: Component) -> dict[sp.Basic, Any]:
    """Symbols with dotted names for the variables and parameters of a component's parts."""
    routes = ((symbol, symbol.owner.route_from(owner._node)) for symbol in symbols)
    return {s: slot(".".join((*route, s.path))) for s, route in routes if route}


def _with_names(equation: Eq, owner: Component) -> Eq:
    """The equation with dotted names for the variables and parameters of parts, also where it says nothing (x = x).

    Hidden variables of conditions are these conditions again.
    """
    stated = {*references(equation.lhs), *references(equation.rhs)}
    hidden = {r: r.declaration.meaning for r in stated if is_hidden(r.path)}
    meanings = {r: literal(meaning) for r, meaning in hidden.items() if meaning is not None}
    names = dotted((*stated, *chain.from_iterable(map(references, meanings.values()))), owner)
    for reference, meaning in meanings.items():
        named = meaning.xreplace(names)
        if isinstance(named, Relational):
            names |= {sp.Gt(reference, HALF): named, sp.Le(reference, HALF): named.negated}
        else:
            names[reference] = named
    if not names:
        return equation
    return Eq(equation.lhs.xreplace(names), equation.rhs.xreplace(names))
