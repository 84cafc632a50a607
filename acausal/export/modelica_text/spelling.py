"""How names, units, numbers and modifiers are spelled in Modelica."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from acausal.modelica import KEYWORDS

TAKEN = frozenset([
    "Boolean", "Clock", "ExternalObject", "Integer", "Modelica", "Real", "StateSelect", "String", "abs", "acos", "asin",
    "assert", "atan", "atan2", "ceil", "cos", "cosh", "delay", "div", "exp", "fill", "floor", "homotopy", "integer",
    "log", "log10", "mod", "noEvent", "pre", "edge", "change", "product", "reinit", "rem", "sample", "scalar", "sign",
    "sin", "sinh", "size", "smooth", "sqrt", "sum", "tan", "tanh", "terminal", "time", "transpose",
])  # fmt: skip
"""Types, functions and packages, which an element of that name would hide; quoted, as keywords, they are others."""

PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
UNIT = re.compile(r"[A-Za-zΩµ%.0-9/()\-]*")


def identifier(name: str) -> str:
    """A name, quoted where Modelica needs that; an index stays behind it.

    Modelica's names are ASCII, quoted ones too: ``ω`` is ``'{U+03C9}'``, which no name of Python's is.
    """
    word, bracket, index = name.partition("[")
    word = "".join(c if c.isascii() else f"{{U+{ord(c):04X}}}" for c in word)
    if not PLAIN.fullmatch(word) or word in KEYWORDS | TAKEN:
        escaped = word.replace("\\", "\\\\").replace("'", "\\'")
        word = f"'{escaped}'"
    return word + bracket + index


def dotted(path: Sequence[str]) -> str:
    """A name of names."""
    return ".".join(map(identifier, path))


def class_name(name: str) -> str:
    """A name for a class: letters, digits and underscores."""
    word = re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_") or "Model"
    return f"M_{word}" if word[0].isdigit() or word in KEYWORDS else word


def text(value: object) -> str:
    """A text in quotes."""
    escaped = " ".join(str(value).split()).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def comment(value: object) -> str:
    """A description behind a declaration."""
    return f" {text(value)}" if value else ""


def number(value: Any) -> str:
    """A number in full; whole ones without a point."""
    real = float(value)
    return str(int(real)) if real.is_integer() and abs(real) < 1e15 else repr(real)


def array(value: Any, spelled: Any = number) -> str:
    """Numbers in braces, row by row."""
    if isinstance(value, str) or np.ndim(value) == 0:
        return spelled(value)
    return "{" + ", ".join(array(v, spelled) for v in value) + "}"


def unit(given: str) -> dict[str, str]:
    """The attribute of a unit; one that Modelica cannot spell, such as ``N^0.5``, is left out."""
    return {"unit": text(given)} if given and UNIT.fullmatch(given) else {}


def modifiers(flat: Mapping[tuple[str, ...], str]) -> str:
    """Modifiers in parentheses, nested: ``(m=1, s(start=0, fixed=true))``."""
    if not flat:
        return ""
    tree: dict[str, Any] = {}
    for path, value in flat.items():
        inner = tree
        for word in path[:-1]:
            inner = inner.setdefault(word, {})
            if isinstance(inner, str):
                break
        else:
            inner[path[-1]] = value
    return f"({_nested(tree)})"


def _nested(tree: Mapping[str, Any]) -> str:
    parts: list[str] = []
    for name, value in tree.items():
        each, bare = name.startswith("each "), name.removeprefix("each ")
        word = ("each " if each else "") + identifier(bare)
        parts.append(f"{word}({_nested(value)})" if isinstance(value, dict) else f"{word}={value}")
    return ", ".join(parts)
