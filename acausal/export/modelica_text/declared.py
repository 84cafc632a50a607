"""What classes declare: connectors, and names and values of parts."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import count
from typing import Any

from acausal.export.modelica_text.spelling import class_name, comment, identifier, modifiers, unit
from acausal.modeling import Component, Connector, Discrete, Flow, Output

Flat = dict[tuple[str, ...], str]
"""Texts of modifiers, by the names on the way to them."""

ELEMENT = re.compile(r"(.+)\[[0-9,]+\]")


def is_integer(declared: Any) -> bool:
    """Whether a variable has the type Integer."""
    return isinstance(declared, Discrete) and declared.kind != "real"


def numbered(wanted: str) -> Iterator[str]:
    """Names to try: ``m``, then ``m_2``, ``m_3`` ..."""
    return (wanted if n == 1 else f"{wanted}_{n}" for n in count(1))


def unused(wanted: str, taken: set[str]) -> str:
    """The first `numbered` name that is not taken; it is from now on."""
    name = next(name for name in numbered(wanted) if name not in taken)
    taken.add(name)
    return name


def names_in_class(node: Any) -> tuple[dict[str, str], dict[str, str], set[str]]:
    """Names of a component's parts in its class, of its discrete outputs, and all that are taken there.

    An element of a list ``m[2]`` is ``m_2``. A discrete output ``y`` is a signal, and ``y_held``, which it equals.
    """
    taken = {name for name, _ in node.declarations()}
    taken |= {name for name in node.children if not ELEMENT.fullmatch(name)}
    parts = {
        name: unused(re.sub(r"\W+", "_", name).rstrip("_"), taken)
        if ELEMENT.fullmatch(name)
        else name
        for name in node.children
    }
    held = {
        name: unused(f"{name}_held", taken)
        for name, declared in node.declarations()
        if isinstance(declared, Discrete) and isinstance(declared, Output)
    }
    return parts, held, taken


def spelled(node: Any, name: str) -> str:
    """The name of a declaration in its class: ``env.g``, a value of an ``outer`` component, is ``env_g``."""
    word, bracket, index = name.partition("[")
    is_one = "." in word and word in dict(node.declarations())
    return (word.replace(".", "_") if is_one else word) + bracket + index


def names_in_tree(model: Component) -> set[str]:
    """All names of elements of the classes of a model; none may be that of a class, which it would hide."""
    return {name for part in parts_of(model) for name in names_in_class(part._node)[2]}


def parts_of(model: Component) -> list[Component]:
    """A model, its parts, and theirs."""
    parts = [model]
    for part in parts:
        parts += part._node.children.values()
    return parts


def connector_class(name: str, kind: type[Connector]) -> str:
    """The text of a connector's class."""
    doc, _, _ = (kind.__doc__ or "").strip().partition("\n")
    lines = [f"connector {name}{comment(doc)}"]
    for variable, declared in kind.declarations.items():
        role = "flow Real" if isinstance(declared, Flow) else "Real"
        flat: Flat = {(key,): v for key, v in unit(declared.unit).items()}
        own = class_name(variable) if "[" in variable else variable
        lines.append(f"  {role} {identifier(own)}{modifiers(flat)};")
    return "\n".join([*lines, f"end {name};"])
