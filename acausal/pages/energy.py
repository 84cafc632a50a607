"""The energy of a component: what flows in through its connectors, and how much of it is lost or kept."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from acausal.modeling import Component, Connector, der
from acausal.pages.own_law import formulas, own_law

LOSSES = ("lossPower", "LossPower")
"""The variables that hold the lost power, as the Modelica Standard Library names them."""

Numbers = Float[np.ndarray, " n"]


@dataclass(frozen=True)
class Power:
    """The power that enters at a connector: ``flow``, times ``effort`` unless that is empty.

    Attributes:
        flow, effort: dotted names; ``effort`` is ``der(potential)`` in domains whose potential is a position.
    """

    flow: str
    effort: str


@dataclass(frozen=True, eq=False)
class EnergyOverTime:
    """Energies over time since the start [J].

    Attributes:
        taken: what flowed in through all connectors.
        dissipated, stored: the parts of it that were lost and kept; None where the equations do not tell.
    """

    taken: Numbers
    dissipated: Numbers | None
    stored: Numbers | None


def powers(path: str, connectors: Mapping[str, type[Connector]]) -> tuple[Power, ...] | None:
    """The power of every connector of a component; None where there are no connectors, or one has no power."""
    found: list[Power] = []
    for name, kind in connectors.items():
        watts = [n for n, d in kind.declarations.items() if d.unit == "W"]
        prefix = f"{path}.{name}" if path else name
        if watts:
            found.append(Power(f"{prefix}.{watts[0]}", ""))
        elif kind.power and kind.across != Connector.across:
            potential = f"{prefix}.{kind.potential()}"
            effort = potential if kind.rate is None else f"der({potential})"
            found.append(Power(f"{prefix}.{kind.flow()}", effort))
        else:
            return None
    return tuple(found) or None


def energy(
    component: Component, t: Numbers, powers: Numbers, loss: Numbers | None
) -> EnergyOverTime:
    """Energies from the power that a component takes up and, where it is known, the power that it loses.

    A component keeps what it takes up where its equations hold a derivative, or where its flow follows from a position;
    it loses it where its flow follows from a rate, or from a difference that is none of positions.

    Arguments:
        component: the component.
        t: times.
        powers: what enters through all connectors [W]; where ``loss`` is given, without those of heat.
        loss: what is lost [W], if a variable holds that.
    """
    taken = integrated(t, powers)
    if loss is not None:
        lost = integrated(t, loss)
        return EnergyOverTime(taken, lost, taken - lost)
    nothing = np.zeros_like(taken)
    law = own_law(component)
    if law is not None and law.reads:
        of_positions = law.kind.rate is not None
        dissipates = frozenset({"rate"} if of_positions else {"across"})
        stores = frozenset({"across"} if of_positions else {"derivative"})
        if law.reads == dissipates:
            return EnergyOverTime(taken, taken, nothing)
        if law.reads == stores:
            return EnergyOverTime(taken, nothing, taken)
        return EnergyOverTime(taken, None, None)
    if law is None and _holds_derivative(component):
        return EnergyOverTime(taken, nothing, taken)
    return EnergyOverTime(taken, None, None)


def integrated(t: Numbers, y: Numbers) -> Numbers:
    """The integral over time from the start on, by the trapezoidal rule."""
    pieces = 0.5 * (y[1:] + y[:-1]) * np.diff(t)
    return np.concatenate([[0.0], np.cumsum(pieces)])


def gradient(t: Numbers, y: Numbers) -> Numbers:
    """The derivative of samples, where the model itself does not know it."""
    return np.gradient(y, t) if len(t) > 2 and bool((np.diff(t) > 0).all()) else np.zeros_like(y)


def _holds_derivative(component: Component) -> bool:
    """Whether a component states a differential equation and has no input that could drive it."""
    driven = any(type(d).__name__ == "Input" for _, d in component._node.declarations())
    return not driven and any((e.lhs - e.rhs).has(der) for e in formulas(component))
