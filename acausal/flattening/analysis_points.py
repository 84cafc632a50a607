"""A model with some signal connections opened: what they fed becomes an input."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from acausal.errors import DeclarationError, known_name
from acausal.flattening.connections import connection_sets, equalities, feeds
from acausal.flattening.flat_model import FlatModel
from acausal.modeling import names_in


def opened(model: FlatModel, names: str | Sequence[str]) -> tuple[FlatModel, tuple[str, ...]]:
    """The model without the connections that feed some signals, and the signals that fed them.

    Raises:
        DeclarationError: for a name of what no connection feeds.
    """
    layout = model.layout
    fed = feeds(layout, connection_sets(layout))
    known = {layout.variable(v): v for v in fed}
    refusal = "points: no connection feeds a signal"
    points = [
        known[known_name(name, known, refusal, DeclarationError)]
        for name in names_in(names, "points")
    ]
    old: set[tuple[int, int]] = set()
    new: set[tuple[int, int]] = set()
    for point in points:
        first, *others = fed[point][1]
        old |= {(first, other) for other in others}
        first, *others = (v for v in fed[point][1] if v not in points)
        new |= {(first, other) for other in others}
    groups = list(model.groups)
    for i, group in enumerate(groups):
        if group.components[0] < 0 and group.variables.shape[1] == 2:
            groups[i] = group.rows(
                np.array([tuple(row) not in old for row in group.variables.tolist()])
            )
    kept = tuple(g for g in groups if len(g))
    return replace(
        model,
        groups=(*kept, *equalities(sorted(new))),
        inputs=np.concatenate([model.inputs, np.asarray(points, dtype=np.int64)]),
    ), tuple(layout.variable(fed[point][0]) for point in points)
