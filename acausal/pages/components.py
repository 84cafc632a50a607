"""A card for every component: its equations, parameters, promises, laws, trajectories and energy."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from jaxtyping import Float

from acausal.codegen import Packed, read_parameters
from acausal.drawing import diagram_svg
from acausal.errors import AcausalError
from acausal.flattening import is_hidden
from acausal.modeling import Component, Eq, Module, Option
from acausal.pages.energy import energy_blocks, power_names
from acausal.pages.own_law import own_equations
from acausal.pages.trajectories import plot_of_runs, plots_by_unit
from acausal.reporting import (
    Block,
    Card,
    EquationList,
    Plot,
    Table,
    Text,
    table,
    titled_sections,
)
from acausal.simulation import Solution
from acausal.system import System

MOST_CARDS = 120
"""So many components have a card: those on top, of lists their first elements, before what they consist of."""

MOST_PARTS = 150
"""Models with more parts at one level are not drawn on pages."""

MOST_EQUATIONS, MOST_VARIABLES, MOST_STATES = 40, 8, 12
"""Of a card: equations, variables with a plot, and states whose explicit equations are shown."""

POINTS = 800
"""About so many points has a plot of a card."""

NOTHING = ("", "")

Numbers = Float[np.ndarray, " n"]


@dataclass(frozen=True)
class LearnedLaw:
    """What was learned by a network, for the card of its component."""

    network: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, eq=False)
class Known:
    """What is known of a model besides its equations.

    Attributes:
        packed: values of parameters, and networks.
        changes: by trained parameter, its change and its standard deviation, as texts.
        runs: trajectories by label; the last one is that of ``packed``. over: what they are, in words.
        laws: what was learned.
    """

    packed: Packed
    changes: Mapping[str, tuple[str, str]] = field(default_factory=dict[str, tuple[str, str]])
    runs: Mapping[str, Solution] = field(default_factory=dict[str, Solution])
    over: str = ""
    laws: Sequence[LearnedLaw] = ()


def schematic(component: Component) -> str:
    """The parts of a component as SVG, in which they can be clicked; empty where there are none, or too many."""
    return diagram_svg(component, MOST_PARTS) if component._node.children else ""


def component_cards(system: System, known: Known) -> tuple[Card, ...]:
    """Cards of the model and of its components, parents before their parts."""
    book = _Book(system, known)
    return tuple(book.card(i) for i in book.chosen)


def _depth(path: str) -> tuple[int, int]:
    """How deep in the model a component lies, and the greatest place in a list on the way to it."""
    places = [max(map(int, found.split(","))) for found in re.findall(r"\[([0-9,]+)\]", path)]
    return len(path.split(".")) if path else 0, max(places, default=1)


def _promises(component: Component) -> Table | Text | None:
    """The promises that a component's network keeps, with what they mean."""
    names: tuple[str, ...] = getattr(component, "promises", ())
    declared = dict(component._node.declarations())
    rows: list[tuple[str, str, str]] = []
    for name in names:
        try:
            value = getattr(component, name)
        except AcausalError:
            continue
        option = declared.get(name)
        if value and isinstance(option, Option):
            rows.append((name, "yes" if value is True else str(value), option.doc))
    if getattr(component, "energy", False) is True:
        rows.insert(0, ("energy", "yes", "the network is an energy, and the law its derivative"))
    if rows:
        return table(("promise", "value", "meaning"), rows)
    return Text("Nothing: the network is free.") if names else None


@dataclass(frozen=True, eq=False)
class _Book:
    """What cards are written from; looked up once for all."""

    system: System
    known: Known

    @cached_property
    def chosen(self) -> list[int]:
        """Numbers of the components that have a card."""
        paths = self.system.flat.layout.paths
        ranks = sorted(range(len(paths)), key=lambda i: (*_depth(paths[i]), i))
        return sorted(ranks[:MOST_CARDS])

    @cached_property
    def parameter_values(self) -> Numbers:
        numbers = np.arange(int(self.system.flat.layout.parameter_base[-1]))
        values = read_parameters(self.system.layout.gather(numbers), self.known.packed)
        return np.broadcast_to(values, numbers.shape)

    @cached_property
    def variables(self) -> dict[int, dict[str, str]]:
        """By component, local and dotted names of the variables that are drawn; what equals another is left out."""
        return {i: self._variables_of(i) for i in self.chosen}

    def _variables_of(self, number: int) -> dict[str, str]:
        layout, reduced = self.system.flat.layout, self.system.reduced
        first, form = int(layout.variable_base[number]), layout.form(number)
        names = [(i, path) for i, (path, _) in enumerate(form.variables)]
        seen: set[int] = set()
        found: dict[str, str] = {}
        for i, local in sorted(names, key=lambda pair: "." in pair[1]):
            node = reduced.resolve(first + i)[0]
            if is_hidden(local) or node in seen or len(found) >= MOST_VARIABLES:
                continue
            seen.add(node)
            found[local] = layout.variable(first + i)
        return found

    @cached_property
    def columns(self) -> dict[str, dict[str, Numbers]]:
        """By run, all variables that cards show; read at once, which compiles one program."""
        drawn = [n for card in self.variables.values() for n in card.values()]
        flows = [n for i in self.chosen for n in power_names(self.system, i)]
        names = list(dict.fromkeys((*drawn, *flows)))
        return {label: run.to_dict(names) for label, run in self.known.runs.items()}

    # -- the parts of a card ---------------------------------------------------------------------------

    def card(self, number: int) -> Card:
        layout = self.system.flat.layout
        component, path = layout.components[number], layout.paths[number]
        doc = (type(component).__doc__ or "").strip().partition("\n\n")[0]
        own = {
            law.network: law for law in self.known.laws if law.network.rpartition(".")[0] == path
        }
        return Card(
            path,
            type(component).__name__,
            " ".join(doc.split()),
            any(isinstance(d, Module) for _, d in component._node.declarations()),
            titled_sections(
                {
                    "Equations": list(self._equations(component, path)),
                    "Parameters": [self._parameters(number)],
                    "What the network promises": [_promises(component)],
                    "Learned law": [b for law in own.values() for b in law.blocks],
                    "Trajectories": self._trajectories(number),
                    "Energy": self._energy(number),
                }
            ),
            schematic(component) if path else "",
        )

    def _equations(self, component: Component, path: str) -> Iterable[Block]:
        stated = own_equations(component)
        shown = tuple(
            (e.lhs, e.rhs) if isinstance(e, Eq) else str(e) for e in stated[:MOST_EQUATIONS]
        )
        if shown:
            yield EquationList(shown)
        if len(stated) > len(shown):
            yield Text(f"These are the first {len(shown)} of {len(stated)}.")
        if not path and 0 < len(self.system.states) <= MOST_STATES:
            explicit = tuple((e.lhs, e.rhs) for e in self.system.equations)
            yield Text("The differential equations that follow from the connected components:")
            yield EquationList(explicit)

    def _parameters(self, number: int) -> Table | None:
        layout = self.system.flat.layout
        form, first = layout.form(number), int(layout.parameter_base[number])
        if not form.parameters:
            return None
        indices = first + np.arange(len(form.parameters))
        values, changes = self.parameter_values[indices], self.known.changes
        rows = [
            (local, f"{value:.6g}", declared.unit or "1", *changes.get(layout.parameter(int(i)), NOTHING), declared.doc)
            for i, (local, declared), value in zip(indices, form.parameters, values.tolist(), strict=True)
        ]  # fmt: skip
        if all(row[3:5] == NOTHING for row in rows):
            rows = [(*row[:3], *row[5:]) for row in rows]
            return table(("parameter", "value", "unit", "meaning"), rows)
        return table(("parameter", "value", "unit", "trained change", "one sigma", "meaning"), rows)

    def _trajectories(self, number: int) -> list[Block]:
        plots = self._plots(number)
        return [Text(self.known.over), *plots] if plots and self.known.over else [*plots]

    def _plots(self, number: int) -> list[Plot]:
        names, runs = self.variables[number], self.columns
        path = self.system.flat.layout.paths[number]
        group = f"card {path}"
        if not runs or not names:
            return []
        if len(runs) == 1:
            (columns,) = runs.values()
            return plots_by_unit(
                columns["time"],
                {local: columns[n] for local, n in names.items()},
                {local: self.system.unit(n) for local, n in names.items()},
                group=group,
                most=POINTS,
                steps=[local for local, n in names.items() if self.system.is_discrete(n)],
            )
        return [
            plot_of_runs(
                local,
                self.system.unit(n),
                {label: (columns["time"], columns[n]) for label, columns in runs.items()},
                group=group,
                most=POINTS,
            )
            for local, n in names.items()
        ]

    def _energy(self, number: int) -> list[Block]:
        if not self.columns:
            return []
        label, columns = list(self.columns.items())[-1]
        of = "" if label == "simulated" else f" {label}"
        return energy_blocks(self.system, number, columns, of, POINTS)
