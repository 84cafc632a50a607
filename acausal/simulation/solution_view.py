"""The view of a trajectory: what was simulated, the states over time, and where they end."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from jaxtyping import Float

from acausal.reporting import Animation, Curve, View, small_plot, still

MOST_PLOTS, MOST_CURVES = 4, 6
"""Small plots of a view, one for each unit, and curves in each."""


def solution_view(
    title: str,
    about: Sequence[str],
    time: Float[np.ndarray, " n"],
    curves: Mapping[str, Float[np.ndarray, " n"]],
    units: Mapping[str, str],
    steps: Sequence[str] = (),
    moving: Animation | None = None,
    sigma: Mapping[str, Float[np.ndarray, " n"]] | None = None,
) -> str:
    """HTML of a trajectory.

    Arguments:
        title: what was simulated. about: facts, as parts of a sentence.
        time: in seconds.
        curves: by name, what is shown of it. units: by name.
        steps: the curves that keep each value until the next.
        moving: the mechanism, of which the last frame is shown.
        sigma: the standard deviations of some curves.
    """
    view = View(title, ", ".join(about))
    if moving is not None:
        view.html(still(moving))
    groups: dict[str, list[str]] = {}
    for name in curves:
        groups.setdefault(units[name], []).append(name)
    for unit, names in list(groups.items())[:MOST_PLOTS]:
        lines = [
            Curve(n, time, curves[n], sigma=(sigma or {}).get(n), steps=n in steps)
            for n in names[:MOST_CURVES]
        ]
        view.html(small_plot(lines, across="time in s", upwards=unit or "1"))
    rows = [
        (name, y[0], y[-1], np.nanmin(y), np.nanmax(y), units[name])
        for name, y in curves.items()
        if len(y) and not np.isnan(y).all()
    ]
    if rows:
        view.table(("", "at the start", "at the end", "least", "largest", "unit"), rows)
    return str(view)
