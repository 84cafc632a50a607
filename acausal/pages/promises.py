"""What a component's network promises for all of its weights."""

from __future__ import annotations

from acausal.errors import AcausalError
from acausal.modeling import Component, Option
from acausal.reporting import Table, Text, table


def promises(component: Component) -> Table | Text | None:
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
