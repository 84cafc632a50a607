"""What a name can mean besides a class of the text, and what to say of one that means nothing."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from acausal.errors import nearest, shortened
from acausal.modelica.syntax import DottedName
from acausal.netlist import find_class


@dataclass(frozen=True, eq=False)
class Native:
    """A class of an installed library."""

    cls: Any
    name: str


@dataclass(frozen=True, eq=False)
class Predefined:
    """A predefined type, with a unit and other attributes."""

    name: str
    attributes: dict[str, Any] = field(default_factory=dict[str, Any])


@dataclass(frozen=True, eq=False)
class Value:
    """A constant, the value of an enumeration, or a function of a library."""

    value: Any


@dataclass(frozen=True, eq=False)
class Prefix:
    """A package whose text is not given."""

    full: str


@dataclass(frozen=True, eq=False)
class Imported:
    """A constant of a package of the text, ``node``, that an import names."""

    node: Any
    name: str


REFUSED_PACKAGES = {
    **dict.fromkeys(
        [f"Modelica.Mechanics.MultiBody.{n}" for n in ("Joints", "Parts", "Forces", "Sensors")],
        "spatial mechanics is not supported; PlanarMechanics has what moves in a plane",
    ),
    "Modelica.Clocked": "clocks are not supported; use the blocks of Modelica.Blocks.Discrete",
    "Modelica_Synchronous": "clocks are not supported; use the blocks of Modelica.Blocks.Discrete",
    "Modelica.Fluid": "stream connectors are not supported; use Modelica.Thermal.FluidHeatFlow",
}
"""Packages of the library, and what to use in their place."""


def refused_package(full: str) -> str:
    """Why a class of that name is not supported; an empty text where nothing is known against it."""
    reasons = (r for name, r in REFUSED_PACKAGES.items() if full.startswith(f"{name}."))
    return next((f"{shortened(full)}: {reason}" for reason in reasons), "")


def is_icon(full: str) -> bool:
    """Whether this is a class of the library that has a picture alone, as ``Modelica.Blocks.Icons.Block``."""
    return full.startswith("Modelica.") and ".Icons." in full


class Literal(str):
    """The value of an enumeration: the text of its name, and its number.

    Attributes:
        number: from 1.
        among: all values of the enumeration.
    """

    number: int = 0
    among: list[Literal]


PATH_HINT = "give the folder that has it by path=[...] or in MODELICAPATH"


def unknown_name(node: Any, name: DottedName, what: str) -> str:
    """Why a name means nothing in a class, a `acausal.modelica.classes.ClassNode`, and what may help."""
    packages = [clause.package for clause in node.imports if clause.everything]
    names = [name.text, *(f"{package}.{name.text}" for package in packages)]
    if reason := next(filter(None, map(refused_package, names)), ""):
        return reason
    return f"there is no {what} '{shortened(name.text)}'; {_hint(node, name)}"


def _hint(node: Any, name: DottedName) -> str:
    words = [w for w in name.words if w]
    above, rest = node.lookup(name.words[:-1]) if len(words) > 1 else (node.parent, words)
    if hasattr(above, "definition") and not rest and above.names():
        return nearest(words[-1], above.names())
    if hasattr(node.tree.root(words[0]) or node, "definition"):
        known = [*node.classes, *getattr(node.parent, "classes", ())]
        return f"{nearest(words[-1], known)} {PATH_HINT}" if known else PATH_HINT
    try:
        find_class(node.tree.libraries, name.text)
        return PATH_HINT
    except KeyError as error:
        return f"{error.args[0].rstrip('.')}; {PATH_HINT}"
