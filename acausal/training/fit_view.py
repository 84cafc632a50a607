"""The view of a training, in a notebook."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from jaxtyping import Float

from acausal.reporting import Curve, View, small_plot
from acausal.training.history import History
from acausal.training.record_fit import RecordFit

MOST_TARGETS = 4
"""Targets that are plotted."""


def fit_view(
    title: str,
    about: str,
    losses: Sequence[tuple[str, float, float]],
    rms: Mapping[str, float],
    units: Mapping[str, str],
    parameters: Sequence[tuple[str, str, str]],
    record: RecordFit,
    history: History,
) -> str:
    """HTML of a training.

    Arguments:
        title, about: what was trained, and how.
        losses: by kind, before and after.
        rms: by target, the error; ``units`` by target.
        parameters: by trained parameter its name, value and change, as text.
        record: that is plotted.
        history: of the training.
    """
    view = View(title, about)
    view.table(("", "before", "after"), losses)
    view.table(("target", "RMS error", "unit"), [(n, e, units[n]) for n, e in rms.items()])
    if parameters:
        view.table(("parameter", "value", "change"), parameters)
    for i, (target, unit) in enumerate(list(units.items())[:MOST_TARGETS]):
        view.folded(f"{target}, measured and simulated", _followed(record, i, unit), opened=i == 0)
    view.folded("Losses, update by update", _losses(history))
    if history.divergences:
        view.text(f"{len(history.divergences)} divergences; see fit.history.divergences")
    return str(view)


def _followed(record: RecordFit, target: int, unit: str) -> str:
    measured: Float[np.ndarray, " n"] = record.measured[:, target]
    exist = ~np.isnan(measured)
    curves = [
        Curve("measured", record.time[exist], measured[exist]),
        Curve("simulated", record.time, record.predicted[:, target]),
    ]
    return small_plot(curves, across="time in s", upwards=unit or "1")


def _losses(history: History) -> str:
    curves = [Curve("of the batch", np.arange(history.epochs), history.loss)]
    for label, rows in (
        ("whole record", history.full_loss),
        ("held out", history.validation_loss),
    ):
        if len(rows):
            curves.append(Curve(label, rows[:, 0], rows[:, 1]))
    return small_plot(curves, across="update", upwards="loss", logarithmic=True)
