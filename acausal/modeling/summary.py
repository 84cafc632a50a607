"""What a component is, in a few lines: its values, connectors and parts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from acausal.errors import shortened
from acausal.modeling.declarations import Module, Option, Parameter, Variable
from acausal.modeling.documentation import CONNECTORS, DEFAULT_WIDTH, Declared, sections
from acausal.modeling.node import Node
from acausal.modeling.written import default_text

MOST = 8
"""Names in a line of a summary."""

SHOWN = ("Parameters", "Networks", CONNECTORS, "Inputs", "Outputs")
"""Kinds of declarations in a summary; options are where they were set."""


def summary(node: Node[Any]) -> str:
    """What a component is, for the prompt: a line for each kind of what it declares and consists of."""
    lines = [node.label]
    for title, members in sections(dict(node.declarations())):
        texts = [_given(node, n, d) for n, d in members.items() if title in SHOWN]
        if title == "Options":
            texts = [f"{n}={v!r}" for n, v in node.options.items() if n in members]
        if texts:
            lines.append(f"  {title.lower():<10} {_counted(texts)}")
    if node.children:
        parts = [f"{n} ({type(part).__name__})" for n, part in node.children.items()]
        lines.append(f"  {'parts':<10} {_counted(parts)}")
    return "\n".join(lines)


def value_text(node: Node[Any], name: str, declared: Declared) -> str:
    """The value of a parameter, option or network, or the start of a variable: what was given, or the default."""
    match declared:
        case Parameter() | Module():
            value = node.modifiers.get(name, declared.default)
        case Option():
            value = node.options.get(name, declared.default)
        case Variable():
            value = node.modifiers.get(name, declared.start)
        case _:
            return type(declared).__name__
    return "" if value is None else shortened(default_text(value), DEFAULT_WIDTH)


def _given(node: Node[Any], name: str, declared: Declared) -> str:
    if not isinstance(declared, Parameter | Module):
        return name
    unit = "" if declared.unit == "1" else declared.unit
    return f"{name} = {value_text(node, name, declared) or 'not given'} {unit}".rstrip()


def _counted(texts: Sequence[str]) -> str:
    """The first eight of them, and how many there are."""
    more = f", ... ({len(texts)})" if len(texts) > MOST else ""
    return ", ".join(texts[:MOST]) + more
