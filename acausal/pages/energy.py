"""The energy of components: what flows in through connectors, how much of it is lost or kept, and how pages show it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from acausal.modeling import Component, Connector, der, full_name
from acausal.pages.own_law import formulas, own_law
from acausal.pages.trajectories import labelled
from acausal.reporting import Block, Curve, Plot, Text, table, thinned
from acausal.system import System

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
        prefix = full_name(path, name)
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
    """Energies from the power [W] that a component takes up and, where a variable holds it, the power that it loses.

    A component keeps what it takes up where its equations hold a derivative, or where its flow follows from a position;
    it loses it where its flow follows from a rate, or from a difference that is none of positions. Where ``loss`` is
    given, ``powers`` are without those of heat.
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


def power_names(system: System, number: int) -> Iterable[str]:
    """The variables that must be read for the power of a component, by its number."""
    for power in _powers(system, number):
        yield power.flow
        if power.effort:
            yield _effort(system, power.effort).name
    if loss := _loss_name(system, number):
        yield loss


def energy_blocks(
    system: System, number: int, columns: Mapping[str, Numbers], of: str, most: int
) -> list[Block]:
    """A table of the energies at the end, and a plot of them; nothing for a component without power.

    Arguments:
        system: the model. number: of the component.
        columns: ``time`` and the variables of `power_names`.
        of: what is added to captions, such as `` after training``.
        most: points in the plot.
    """
    layout, found = system.flat.layout, _powers(system, number)
    if not found:
        return []
    path, t = layout.paths[number], columns["time"]
    total = np.zeros_like(t)
    loss = columns.get(_loss_name(system, number))
    for power in found:
        if loss is not None and not power.effort:
            continue  # there the loss leaves as heat
        total = total + columns[power.flow] * _effort_values(system, power.effort, columns)
    if len(found) > 1 and not any(power.effort for power in found):
        shown = _heat(path, t, {power.flow: columns[power.flow] for power in found})
    else:
        one = energy(layout.components[number], t, total, loss)
        parts = {"taken in": one.taken, "dissipated": one.dissipated, "stored": one.stored}
        shown = {name: part for name, part in parts.items() if part is not None}
    if not all(np.isfinite(part).all() for part in shown.values()):
        return [Text("Its energy is not known: the trajectory is not finite everywhere.")]
    least = 1e-5 * max(float(np.abs(part).max()) for part in shown.values())
    ends = {name: float(part[-1]) for name, part in shown.items()}
    rows = [(n, f"{0.0 if abs(end) < least else end:.5g}") for n, end in ends.items()]
    curves = thinned([Curve(name, t, part) for name, part in shown.items()], most)
    caption = f"Energy of '{path or 'the model'}' since the start{of}."
    return [
        table((f"energy{of}, until {t[-1]:g} s", "J"), rows),
        Plot(caption, "time [s]", labelled("energy", "J"), curves, group=f"card {path}"),
    ]


def _heat(path: str, t: Numbers, flows: Mapping[str, Numbers]) -> dict[str, Numbers]:
    """What flowed in through each connector of a component that conducts heat, and what stays if anything does."""
    names = (flow.removeprefix(f"{path}.").rpartition(".")[0] for flow in flows)
    entered = {f"in at {n}": integrated(t, q) for n, q in zip(names, flows.values(), strict=True)}
    stays = np.sum(list(entered.values()), axis=0)
    least = 1e-9 * max(float(np.abs(part).max()) for part in entered.values())
    return entered if float(np.abs(stays).max()) <= least else {**entered, "stored": stays}


def _powers(system: System, number: int) -> tuple[Power, ...]:
    """The power of every connector of a component; empty where one has none."""
    layout = system.flat.layout
    kinds = {name: kind for name, (kind, _) in layout.form(number).connectors.items()}
    return powers(layout.paths[number], kinds) or ()


def _loss_name(system: System, number: int) -> str:
    """The variable that holds the power that a component loses; empty where there is none."""
    layout = system.flat.layout
    own = (n for n in LOSSES if n in layout.form(number).variable_index)
    return next((f"{layout.paths[number]}.{n}".removeprefix(".") for n in own), "")


@dataclass(frozen=True)
class _Effort:
    """Which variable gives an effort, with what sign, and whether it must be differentiated in time."""

    name: str
    sign: int = 1
    differentiate: bool = False


def _effort(system: System, effort: str) -> _Effort:
    """Where an effort is read: the derivative of a position where the model has a variable that equals it."""
    potential = effort.removeprefix("der(").removesuffix(")")
    if effort == potential:
        return _Effort(effort)
    layout, reduced = system.flat.layout, system.reduced
    index = layout.find_variable(potential)
    assert index is not None
    found = reduced.resolve_derivative(index, 1)
    if found is not None:
        node, sign = found
        same = np.flatnonzero(reduced.aliases.representative[: system.flat.n_variables] == node)
        if len(same):
            own = reduced.resolve(int(same[0]))[1]
            return _Effort(layout.variable(int(same[0])), sign * own)
    return _Effort(potential, differentiate=True)


def _effort_values(system: System, effort: str, columns: Mapping[str, Numbers]) -> Numbers:
    t = columns["time"]
    if not effort:
        return np.ones_like(t)
    found = _effort(system, effort)
    values = found.sign * columns[found.name]
    return gradient(t, values) if found.differentiate else values
