"""The law of a component with two connectors: its flow as an expression of the difference between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from acausal.flattening import equations_of, read_statements
from acausal.modeling import Component, Connector, Eq, Module, Parameter, Reference, der, references


def own_equations(component: Component) -> tuple[Any, ...]:
    """What a component states itself: equations, and what happens at events."""
    return tuple(read_statements(component, lambda: equations_of(component), 1))


def formulas(component: Component) -> list[Eq]:
    """The equations of a component between numbers; not those between conditions."""
    stated = (e for e in own_equations(component) if isinstance(e, Eq))
    return [e for e in stated if isinstance(e.lhs, sp.Expr) and isinstance(e.rhs, sp.Expr)]


@dataclass(frozen=True)
class OwnLaw:
    """The flow through a component.

    Attributes:
        kind: the class of its two connectors.
        flow: an expression of ``across``, ``rate`` and parameters.
        across, rate: the difference of the potentials and its derivative; ``rate`` is None where the connectors have
            none.
    """

    kind: type[Connector]
    flow: Any
    across: Reference
    rate: Reference | None

    @property
    def reads(self) -> frozenset[str]:
        """Which of ``"across"``, ``"rate"`` and ``"derivative"`` the flow depends on."""
        present = self.flow.free_symbols
        differentiated = self.flow.atoms(der)
        found = {"derivative"} if differentiated else set[str]()
        plain = self.flow.xreplace(dict.fromkeys(differentiated, sp.S.Zero)).free_symbols
        found |= {"across"} if self.across in plain else set()
        return frozenset(found | ({"rate"} if self.rate in present else set()))


def own_law(component: Component) -> OwnLaw | None:
    """The law of a component with two connectors of one class, or None where its flow depends on more."""
    kind = two_port_kind(component)
    if kind is None:
        return None
    names = [kind.across, kind.through, *([] if kind.rate is None else [kind.rate])]
    declared = dict(component._node.declarations())
    across, through, *rates = (getattr(component, n) if n in declared else None for n in names)
    rate = rates[0] if rates else None
    if not isinstance(across, Reference) or not isinstance(through, Reference):
        return None
    leaves = {across, rate}
    flow = _expressed(component, through, leaves)
    return None if flow is None else OwnLaw(kind, flow, across, rate)


def two_port_kind(component: Component) -> type[Connector] | None:
    """The class of the two connectors by which a domain's two-port is recognised."""
    connectors = {n: d for n, d in component._node.declarations() if isinstance(d, Connector)}
    for declared in connectors.values():
        kind = type(declared)
        if all(isinstance(connectors.get(name), kind) for name in kind.pair):
            return kind
    return None


def _expressed(component: Component, through: Reference, leaves: set[Any]) -> Any:
    """A variable in terms of some others and parameters, by putting the component's equations into each other."""
    statements = formulas(component)

    def expressed(unknown: Any, asked: frozenset[Any]) -> Any:
        """The first way to write an unknown that needs none of those that were asked for; None if there is none."""
        for right in filter(None, (_solved(e, unknown) for e in statements)):
            found: Any = right
            for needed in references(right):
                if _is_known(needed, leaves):
                    continue
                known = needed not in asked and "." not in needed.path
                own = expressed(needed, asked | {needed}) if known else None
                if own is None:
                    break
                found = found.xreplace({needed: own})
            else:
                return found
        return None

    return expressed(through, frozenset({through}))


def _solved(equation: Eq, unknown: Any) -> Any:
    """What an unknown equals, from an equation such as ``i = G v`` or ``v = R i``; None where it tells nothing."""
    residual: Any = equation.lhs - equation.rhs
    if any(unknown in d.free_symbols for d in residual.atoms(der)):
        return None
    if unknown == equation.lhs and unknown not in equation.rhs.free_symbols:
        return equation.rhs
    if unknown not in residual.free_symbols or residual.has(sp.Piecewise):
        return None
    rest = residual.xreplace({unknown: sp.S.Zero})
    factor = sp.expand(residual - rest).coeff(unknown)
    if factor == 0 or sp.expand(residual - rest - factor * unknown) != 0:
        return None
    return -rest / factor


def _is_known(reference: Reference, leaves: set[Any]) -> bool:
    return reference in leaves or isinstance(reference.declaration, Parameter | Module)
