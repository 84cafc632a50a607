"""Which colour of the style sheet a curve has."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import count

from acausal.reporting.page.content import Curve

OTHERS = 6
"""How many colours curves without a role have, in turn."""


def colors(curves: Iterable[Curve]) -> Iterator[str]:
    """The class in the style sheet of each curve."""
    turn = count()
    for curve in curves:
        yield f"o{next(turn) % OTHERS}" if curve.role == "other" else curve.role
