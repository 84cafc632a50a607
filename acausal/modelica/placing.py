"""Where an annotation puts a component on the diagram of its class (Modelica 3.6, 18.6.3)."""

from __future__ import annotations

import re

from acausal.modeling import Placement

NUMBER = r"([-+]?[\d.]+(?:[eE][-+]?\d+)?)"
SPOT = re.compile(r"Placement\((?:visible=\w+,)?transformation\(((?:[^()]|\([^()]*\))*)\)")
EXTENT = re.compile(rf"extent=\{{\{{{NUMBER},{NUMBER}\}},\{{{NUMBER},{NUMBER}\}}\}}")
ORIGIN = re.compile(rf"origin=\{{{NUMBER},{NUMBER}\}}")
ROTATION = re.compile(rf"rotation=({NUMBER})")


def placement(annotation: str) -> Placement | None:
    """The place that an annotation states in numbers, without spaces; None if it states none.

    An extent ``{{a, b}, {c, d}}`` has a middle, which is turned about the origin and moved there; where
    ``a > c`` the picture is mirrored. Other angles than right ones count as the nearest of these.
    """
    found = SPOT.search(annotation)
    extent = EXTENT.search(found[1]) if found else None
    if found is None or extent is None:
        return None
    a, b, c, d = (float(text) for text in extent.groups())
    origin, rotation = ORIGIN.search(found[1]), ROTATION.search(found[1])
    quarters = round(float(rotation[1]) / 90) % 4 if rotation else 0
    x, y = (a + c) / 2, (b + d) / 2
    for _ in range(quarters):
        x, y = -y, x
    if origin:
        x, y = x + float(origin[1]), y + float(origin[2])
    mirrored, flipped = a > c, b > d
    if flipped:  # upside down is mirrored and turned by half
        mirrored, quarters = not mirrored, (quarters + 2) % 4
    return Placement(x, y, 90 * quarters, mirrored)
