"""The ends of a connection: which component they belong to, their names, and which pairs may be connected."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from acausal.errors import ConnectionError
from acausal.modeling.arrays import is_array
from acausal.modeling.connector import Connector
from acausal.modeling.declarations import Input, Output
from acausal.modeling.names import full_name
from acausal.modeling.node import Endpoint
from acausal.modeling.symbols import Owner, Reference


def owner_and_name(end: Endpoint) -> tuple[Owner | None, str]:
    """The node that an end belongs to (None outside of a component), and the end's name there."""
    return (end.owner, end.path) if isinstance(end, Reference) else (end._owner, end._name)


def endpoint_label(end: Any) -> str:
    """The name of an end of a connection in messages."""
    if isinstance(end, Reference):
        return full_name(end.owner.path, end.path)
    return repr(end).partition("\n")[0]


def check_pair(a: Any, b: Any) -> None:
    """Refuse two ends that cannot be connected.

    Raises:
        ConnectionError: if they are of unlike kind, are the same, or are not connectors.
    """
    for end in (a, b):
        if not (isinstance(end, Connector) or _is_signal(end)):
            raise ConnectionError(
                f"{endpoint_label(end)} is not a connector; connect({endpoint_label(a)}, {endpoint_label(b)})"
            )
    if isinstance(a, Connector) != isinstance(b, Connector):
        raise ConnectionError(
            f"unlike connectors: {endpoint_label(a)} and {endpoint_label(b)}; one is a signal"
        )
    if a is b:
        raise ConnectionError(f"{endpoint_label(a)} is connected to itself")
    if isinstance(a, Connector) and type(a) is not type(b) and a.kind() != b.kind():
        raise ConnectionError(
            f"unlike connectors: {endpoint_label(a)} and {endpoint_label(b)} carry {_carried(a)} "
            f"and {_carried(b)}; only connectors of one domain can be connected"
        )


def is_vector(end: Any) -> bool:
    """Whether this is a list or an array of ends."""
    return is_array(end) or (
        not isinstance(end, Connector | Reference | str) and isinstance(end, Sequence)
    )


def check_lengths(a: Any, b: Any) -> None:
    """Refuse vectors of different length, and a vector with a single end.

    Raises:
        ConnectionError: with the name and length of each.
    """
    if is_vector(a) and is_vector(b):
        if len(a) != len(b):
            raise ConnectionError(
                f"vectors differ in length: {_vector_label(a)} has {len(a)}, {_vector_label(b)} has {len(b)}"
            )
    elif is_vector(a) != is_vector(b):
        vector, single = (a, b) if is_vector(a) else (b, a)
        raise ConnectionError(
            f"{_vector_label(vector)} is a vector of {len(vector)}, {endpoint_label(single)} is single; "
            "connect one element"
        )


def _vector_label(vector: Sequence[Any]) -> str:
    """The name of a vector: that of its elements without their index."""
    if not len(vector):
        return "an empty vector"
    first: Any = vector[0]
    while is_vector(first) and len(first):
        first = first[0]
    label = endpoint_label(first)
    return label.rpartition("[")[0] if label.endswith("]") else f"[{label}, ...]"


def _is_signal(value: Any) -> bool:
    return isinstance(value, Reference) and isinstance(value.declaration, Input | Output)


def _carried(connector: Connector) -> str:
    """The variables of a connector with their units, for a message."""
    return ", ".join(f"{name} [{d.unit or '1'}]" for name, d in connector.declarations.items())
