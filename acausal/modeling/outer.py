"""What parts take from the models around them, as Modelica's ``outer``: gravity from the world."""

from __future__ import annotations

from functools import cache
from typing import Any

from acausal.modeling.component import Component
from acausal.modeling.node import Node


def inherited(part: Component, name: str) -> Any:
    """The value of a parameter in the nearest enclosing model, where the part's class says so (`Component.OUTER`).

    ``planarWorld.g`` is that of the part of this name, or of one of the class ``PlanarWorld`` or its subclasses. None
    where there is none.
    """
    return _value(part, name, {})


def inherit(model: Component) -> None:
    """Give the parts below what their classes take from the models around them, and nothing else gives."""
    _give(model, {})


Known = dict[tuple[int, str], Component | None]
"""What was found: by the identity of a model's node and a name."""


def _give(model: Component, known: Known) -> None:
    for part in model._node.children.values():
        node = part._node
        for name in part.OUTER:
            given = node.modifiers.get(name)
            if given is not None and given is node.inherited.get(name):
                del node.modifiers[name]  # of an earlier time: the model around it may be another
            if name not in node.modifiers and (value := _value(part, name, known)) is not None:
                part.modify(**{name: value})
                node.inherited[name] = node.modifiers[name]
        _give(part, known)


def _value(part: Component, name: str, known: Known) -> Any:
    where, _, what = part.OUTER[name].partition(".")
    for node in part._node.ancestors():
        if (inner := _named(node, where, known)) is not None and inner is not part:
            return getattr(inner, what, None)
    return None


def _named(node: Node[Component], where: str, known: Known) -> Component | None:
    """The part of a model that has a name, or else a class of it."""
    key = id(node), where
    if key not in known:
        parts = node.children
        of_class = (part for part in parts.values() if _is_of(type(part), where))
        known[key] = parts[where] if where in parts else next(of_class, None)
    return known[key]


@cache
def _is_of(cls: type, where: str) -> bool:
    """Whether a class is what a name is called after: ``planarWorld`` after ``PlanarWorld``."""
    return any(base.__name__ == where[:1].upper() + where[1:] for base in cls.__mro__)
