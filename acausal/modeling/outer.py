"""What parts take from the models around them, as Modelica's ``outer``: gravity from the world."""

from __future__ import annotations

from typing import Any

from acausal.modeling.component import Component


def inherited(part: Component, name: str) -> Any:
    """The value of a parameter in the nearest enclosing model, where the part's class says so (`Component.OUTER`).

    ``planarWorld.g`` is that of the part of this name, or of one of the class ``PlanarWorld`` or its subclasses. None
    where there is none.
    """
    where, _, what = part.OUTER[name].partition(".")
    for node in part._node.ancestors():
        parts = node.children
        named = (parts[where],) if where in parts else tuple(parts.values())
        for inner in named:
            classes = (c.__name__ for c in type(inner).__mro__)
            if inner is not part and (where in parts or where[:1].upper() + where[1:] in classes):
                return getattr(inner, what, None)
    return None


def inherit(model: Component) -> None:
    """Give the parts below what their classes take from the models around them, and nothing else gives."""
    for part in model._node.children.values():
        for name in part.OUTER:
            value = inherited(part, name)
            if value is not None and name not in part._node.modifiers:
                part.modify(**{name: value})
        inherit(part)
