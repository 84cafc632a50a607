"""A part with something at each of its connectors and signals, to draw it with all of its wires."""

from __future__ import annotations

from typing import Any

import acausal as ac
from acausal.modeling import Connector, Input, Output


def surrounded(part: ac.Component) -> ac.Component:
    """A model of ``part`` with a component at each connector and each signal that is not in a list or a vector."""
    model: Any = ac.Component()
    model.part = part
    for number, (name, declared) in enumerate(part._node.declarations()):
        if "[" in name:
            continue
        if isinstance(declared, Connector):
            kind = type("End", (ac.Component,), {"end": type(declared)()})
        elif isinstance(declared, Input) and declared.shape is None:
            kind = type("Source", (ac.Component,), {"end": ac.Output(unit=declared.unit)})
        elif isinstance(declared, Output) and declared.shape is None:
            kind = type("Sink", (ac.Component,), {"end": ac.Input(unit=declared.unit)})
        else:
            continue
        setattr(model, f"x{number}", kind())
        ends = getattr(model, f"x{number}").end, getattr(part, name)
        model.connect(*(ends[::-1] if isinstance(declared, Output) else ends))
    return model
