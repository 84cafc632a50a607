"""Units in an FMU's model description."""

from __future__ import annotations

from collections.abc import Iterable
from xml.etree.ElementTree import Element, SubElement

from acausal.units import in_si


def add_units(root: Element, units: Iterable[str]) -> None:
    """Append the definitions of units, in base units where these are known.

    Arguments:
        units: texts of units; those that are empty have no definition.
    """
    named = sorted({u for u in units if u})
    if not named:
        return
    listed = SubElement(root, "UnitDefinitions")
    for name in named:
        unit, found = SubElement(listed, "Unit", name=name), in_si(name)
        if found is None:
            continue
        base = SubElement(unit, "BaseUnit", {s: str(e) for s, e in found.exponents.items()})
        if found.factor != 1:
            base.set("factor", repr(found.factor))
        if found.offset != 0:
            base.set("offset", repr(found.offset))
