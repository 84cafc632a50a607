"""Sections of pages about records: as measured and as simulated, and the errors over time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np
from jaxtyping import Float

from acausal.reporting.drawing import new_figure
from acausal.reporting.html import Page
from acausal.reporting.plot import UncertainCurve, plot_band
from acausal.reporting.sections import AFTER, BEFORE, MEASURED, WIDE, figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SAMPLES_SHOWN = 2000
"""Samples in the middle of a record that are drawn."""

ERRORS_SHOWN = 4000
"""At most so many errors over all of a record are drawn."""

RECORDS_SHOWN = 8
"""The first so many records are drawn; all are in the table."""


GAP = 5.0
"""A curve is broken where samples are farther apart than so many times their median distance."""


class FollowedRecord(Protocol):
    """A record and a model's prediction of it, such as `RecordFit`."""

    @property
    def time(self) -> Float[np.ndarray, " n"]:
        """Of the samples."""
        ...

    @property
    def measured(self) -> Float[np.ndarray, "n n_targets"]:
        """The targets; NaN where they are not measured."""
        ...

    @property
    def predicted(self) -> Float[np.ndarray, "n n_targets"]:
        """The targets in a simulation."""
        ...

    @property
    def rms(self) -> Mapping[str, float]:
        """By target, the root mean square error."""
        ...


def add_records(
    page: Page,
    title: str,
    before: Mapping[str, FollowedRecord],
    after: Mapping[str, FollowedRecord],
    units: Mapping[str, str],
) -> None:
    """Records as measured, and as simulated before and after training, with the errors over time and their size.

    Arguments:
        page: the page.
        title: of the section.
        before, after: by name of the record; ``before`` may lack some.
        units: by target, in order.
    """
    page.section(title)
    header = ("record", "samples", *(f"RMS error of {n} [{unit}]" for n, unit in units.items()))
    rows = [
        (name, len(record.time), *(f"{record.rms[n]:.4g}" for n in units))
        for name, record in after.items()
    ]
    page.table(header, rows)
    for name, record in list(after.items())[:RECORDS_SHOWN]:
        where = "" if len(after) == 1 else f" of '{name}'"
        for i, (target, unit) in enumerate(units.items()):
            curves = {"after training": (record.predicted[:, i], AFTER, 1.1)}
            if name in before:
                curves = {"before training": (before[name].predicted[:, i], BEFORE, 0.9), **curves}
            drawn = _draw_record(record, i, target, unit, curves)
            page.figure(drawn, f"A stretch of '{target}'{where}, and its errors over all of it.")


def _draw_record(
    record: FollowedRecord,
    i: int,
    target: str,
    unit: str,
    curves: Mapping[str, tuple[Float[np.ndarray, " n"], str, float]],
) -> Figure:
    """One target of a record: a stretch of it above, the error over all of it below."""
    drawn = new_figure((WIDE[0], 1.5 * WIDE[1]))
    above, below = drawn.subplots(2, 1, height_ratios=(2, 1))
    measured = record.measured[:, i]
    known = np.flatnonzero(~np.isnan(measured))
    if not len(known):
        above.set_title(f"{target} is not measured")
        return drawn
    rows = _middle(len(known))
    first, last = known[rows][0], known[rows][-1] + 1
    low, high = float(measured[known[rows]].min()), float(measured[known[rows]].max())
    room = 0.5 * (high - low) + 1e-12
    shown = known[rows]
    samples = _broken(record.time[shown], measured[shown])
    above.plot(*samples, color=MEASURED, lw=1.6, alpha=0.5, label="measured")
    for label, (values, color, width) in curves.items():
        near = np.clip(values[first:last], low - 2 * room, high + 2 * room)
        above.plot(record.time[first:last], near, color=color, lw=width, label=label)
    bottom, top = above.get_ylim()
    above.set_ylim(max(bottom, low - room), min(top, high + room))
    _label_trajectory(above, target, unit, columns=3)
    every = known[:: max(1, len(known) // ERRORS_SHOWN)]
    errors = measured[every] - record.predicted[every, i]
    below.plot(*_broken(record.time[every], errors), color=AFTER, lw=0.8)
    below.set(xlabel="time [s]", ylabel=f"error [{unit}]")
    below.grid(alpha=0.25)
    return drawn


def _broken(
    t: Float[np.ndarray, " n"], y: Float[np.ndarray, " n"]
) -> tuple[Float[np.ndarray, " m"], Float[np.ndarray, " m"]]:
    """A curve that is broken where samples are missing for long."""
    spaces = np.diff(t)
    if not len(spaces):
        return t, y
    after = np.flatnonzero(spaces > GAP * np.median(spaces)) + 1
    return np.insert(t, after, t[after]), np.insert(y, after, np.nan)


def add_predictions(
    page: Page,
    records: Mapping[str, FollowedRecord],
    predicted: Mapping[str, Mapping[str, UncertainCurve]],
    units: Mapping[str, str],
) -> None:
    """Targets as measured, and as the members of an ensemble predict them on average; by record."""
    page.section("Measured and simulated")
    for record, bands in list(predicted.items())[:RECORDS_SHOWN]:
        measured = records[record].measured
        rows = _middle(len(measured))
        where = "" if len(predicted) == 1 else f" of '{record}'"
        for i, (name, band) in enumerate(bands.items()):
            shown = _Part(band.x[rows], band.law[rows], band.sigma[rows])
            column = measured[rows, i]

            def draw(
                ax: Axes, column: np.ndarray = column, name: str = name, shown: _Part = shown
            ) -> None:
                ax.plot(shown.x, column, color=MEASURED, lw=1.6, alpha=0.5, label="measured")
                plot_band(ax, shown, color=AFTER, label="mean of the members")
                _label_trajectory(ax, name, units[name], columns=2)

            page.figure(
                figure(WIDE, draw), f"A stretch of '{name}'{where}, two standard deviations wide."
            )


class _Part(NamedTuple):
    """Some points of a band."""

    x: Float[np.ndarray, " points"]
    law: Float[np.ndarray, " points"]
    sigma: Float[np.ndarray, " points"]


def _middle(samples: int) -> slice:
    """The rows in the middle of a record that are drawn."""
    middle = samples // 2
    return slice(max(0, middle - SAMPLES_SHOWN // 2), middle + SAMPLES_SHOWN // 2)


def _label_trajectory(ax: Axes, name: str, unit: str, columns: int) -> None:
    ax.set(xlabel="time [s]", ylabel=f"{name} [{unit}]")
    ax.grid(alpha=0.25)
    ax.legend(frameon=False, ncols=columns, loc="lower right", bbox_to_anchor=(1, 1))
