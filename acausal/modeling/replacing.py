"""Another part in the place of one, with the same connections."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, cast

import sympy as sp

from acausal.errors import ConnectionError, DeclarationError, nearest
from acausal.modeling.endpoints import check_pair, endpoint_label, owner_and_name
from acausal.modeling.node import Endpoint, Node
from acausal.modeling.symbols import Reference


def replace_part(model: Node[Any], path: str, new: Node[Any]) -> None:
    """Put a part into a model in the place of another, by their records; errors as of `Component.replace`."""
    above, name = _place(model, path)
    old: Node[Any] = above.children[name]._node
    if new.parent is not None or new is model:
        raise DeclarationError(
            f"'{path}': this {new.label} is in a model already; make a second one"
        )
    connections = [
        (node, [tuple(_moved(end, old, new) for end in pair) for pair in node.connections])
        for node in (above, *above.ancestors())
    ]
    for node, pairs in connections:
        for before, after in zip(node.connections, pairs, strict=True):
            if any(a is not b for a, b in zip(before, after, strict=True)):
                check_pair(*after)
    _refuse_dependents(model, old)
    for node, pairs in connections:
        node.connections = cast(list[tuple[Endpoint, Endpoint]], pairs)
    above.children = {n: new.component if n == name else c for n, c in above.children.items()}
    new.parent, new.name, old.parent = above, name, None
    attribute, held = name.partition("[")[0], vars(above.component)
    held[attribute] = _with(held[attribute], old.component, new.component)


def _place(model: Node[Any], path: str) -> tuple[Node[Any], str]:
    """The node that has a part, and the part's name there."""
    node, words = model, path.split(".")
    for word in words:
        if word not in node.children:
            raise DeclarationError(
                f"{node.label} has no part '{word}' to replace: {nearest(word, list(node.children))}"
            )
        node = node.children[word]._node
    return cast(Node[Any], node.parent), words[-1]


def _moved(end: Endpoint, old: Node[Any], new: Node[Any]) -> Endpoint:
    """An end of a connection in the new part, if it is one in the old."""
    owner, name = owner_and_name(end)
    route = cast(Node[Any], owner).route_from(old) if owner is not None else None
    if route is None:
        return end
    node, base = new, name.partition("[")[0]
    for word in route:
        child = node.children.get(word)
        if child is None:
            raise ConnectionError(
                f"{endpoint_label(end)} is connected, and {node.label} has no '{word}'"
            )
        node = child._node
    if node.declaration(base) is None or not node.has(cast(Any, node.declaration(base))):
        known = [n for n, _ in node.declarations()]
        raise ConnectionError(
            f"{endpoint_label(end)} is connected, and {node.label} in its place has no '{name}': {nearest(base, known)}"
        )
    found: Any = getattr(node.component, base)
    for i in re.findall(r"\d+", name[len(base) :]):
        found = found[int(i) - 1]
    return found


def _refuse_dependents(model: Node[Any], old: Node[Any]) -> None:
    """Refuse to leave values behind that depend on a part that goes."""
    for node in _below(model, old):
        for name, value in node.modifiers.items():
            symbols = value.free_symbols if isinstance(value, sp.Basic) else set()
            for symbol in symbols:
                if isinstance(symbol, Reference) and symbol.owner.route_from(old) is not None:
                    raise DeclarationError(
                        f"{node.label}.{name} depends on '{endpoint_label(symbol)}', which goes; give it another value"
                    )


def _below(node: Node[Any], but: Node[Any]) -> Iterator[Node[Any]]:
    """A node and those below it, but one with all that is below."""
    if node is but:
        return
    yield node
    for child in node.children.values():
        yield from _below(child._node, but)


def _with(held: Any, old: Any, part: Any) -> Any:
    """What an attribute holds, with the new part in the place of the old."""
    if isinstance(held, list):
        return [_with(one, old, part) for one in cast(list[Any], held)]
    return part if held is old else held
