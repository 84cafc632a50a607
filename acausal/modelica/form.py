"""What decides the equations of a component of Modelica text, as something that can be compared."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal.modelica.values import Record
from acausal.modeling import Connector, Reference


def note_form(build: Any) -> None:
    """Make all that decides the equations a constant, so that components with other equations have another form."""
    constants = build.component._node.constants
    for name, value in build.made.items():
        constants[f"value of {name}"] = _plain(value)
    constants["absent"] = tuple(sorted(build.absent))
    constants["classes"] = tuple((n, str(id(c))) for n, c in build.classes.items())
    constants["given inwards"] = tuple(str(id(a)) for a, _ in build.given_inwards)
    constants["cut"] = tuple(edge.cut for edge in build.edges)
    constants["decided"] = tuple(build.decided.items())
    constants["bindings"] = tuple(
        (name, str(id(bound.expression)), bound.index) for _, name, bound in build.bindings
    )


def _plain(value: Any) -> Any:
    """A value as something that can be compared."""
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, Record):
        return [(name, _plain(v)) for name, v in value.fields.items()]
    if isinstance(value, list):
        return [_plain(v) for v in value]
    if isinstance(value, Connector | Reference):
        return None
    return value if isinstance(value, bool | int | float | str) else str(id(value))
