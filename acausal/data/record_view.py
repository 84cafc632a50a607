"""The view of a record: what was measured, how often, and a small plot of each signal."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float

from acausal.reporting import Curve, Html, View, small_plot

SIZE = (420, 96)
"""Of a plot in a row, in pixels."""

MOST_PLOTS = 12
"""Signals with a plot; further ones are in the table only."""


def record_view(
    about: str,
    time: Float[np.ndarray, " n"],
    signals: Mapping[str, Float[np.ndarray, " n"]],
    units: Mapping[str, str],
    counts: Mapping[str, int],
) -> str:
    """HTML of a record.

    Arguments:
        about: its samples, in words.
        time: in seconds.
        signals: by name; NaN where a sample is missing.
        units, counts: by name, units as far as known, and how many samples exist.
    """
    view = View(f"Data: {len(signals)} signal{'s' * (len(signals) != 1)}", about)
    some_lack = any(count < len(time) for count in counts.values())
    rows = [
        (
            name,
            units.get(name, ""),
            *([f"{counts[name]} of {len(time)}"] if some_lack else []),
            np.nanmin(values),
            np.nanmax(values),
            Html(_plot(time, values) if i < MOST_PLOTS else ""),
        )
        for i, (name, values) in enumerate(signals.items())
    ]
    header = ("", "unit", *(["samples"] if some_lack else []), "least", "largest", "over time in s")
    view.table(header, rows)
    return str(view)


def _plot(time: Float[np.ndarray, " n"], values: Float[np.ndarray, " n"]) -> str:
    exist = ~np.isnan(values)
    return small_plot([Curve("", time[exist], values[exist])], size=SIZE)
