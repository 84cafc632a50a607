"""What a name can mean besides a class of the text."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from acausal.errors import shortened


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


class Literal(str):
    """The value of an enumeration: the text of its name, and its number.

    Attributes:
        number: from 1.
        among: all values of the enumeration.
    """

    number: int = 0
    among: list[Literal]
