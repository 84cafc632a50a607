"""The page of the single-track vehicle: the learned tyres, and what they are worth in manoeuvres that were held out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from examples.measured.present import opening
from examples.single_track import model, study
from examples.single_track.model import AXLES, LATERAL

MEASURED, LEARNED, LINEAR = "#22303c", "#1f5c99", "#c2571a"
COLORS = {"learned tyres": LEARNED, "linear tyres": LINEAR}


def page(path: Path, found: study.Study) -> None:
    """Write the page."""
    path.parent.mkdir(parents=True, exist_ok=True)
    shown = opening(
        "Single-track vehicle",
        "A vehicle coasts from 20 m/s through a campaign of manoeuvres. The friction of the tyres of both axles is "
        "learned from its yaw rate and its lateral acceleration.",
        model.SingleTrack(),
        [*model.linear("front").equations()][-1:],
        ("", study.COLUMNS, found.rows),
    )
    shown.text(
        f"Trained on: {', '.join(study.TRAINED)}. Held out: {', '.join(study.HELD)}. The noise is "
        f"{study.NOISE[model.YAW_RATE]} rad/s and {study.NOISE[LATERAL]} m/s2. The equation above is that of a "
        "linear tyre, whose stiffness at both axles is trained on the same records."
    )
    shown.section("The tyres")
    shown.figure(tyres(found), "Coefficient of friction over slip.", path.parent / "tyres.png")
    shown.section("A manoeuvre that was held out")
    moving = found.solutions["learned tyres"]["lane change"]
    shown.add(moving.animation(trace="body", caption="The lane change with the learned tyres."))
    caption = "Lateral acceleration in both manoeuvres."
    shown.figure(acceleration(found), caption, path.parent / "held.png")
    shown.write(path)


def tyres(found: study.Study) -> Figure:
    """The learned curves of both axles, the true ones, and the slips of the campaign."""
    figure = Figure(figsize=(9, 3.4), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    for axis, axle in zip(axes, AXLES, strict=True):
        seen = np.asarray(found.fit.arguments[f"{axle}.net"])[:, 0]
        slips = np.linspace(0.0, 1.3 * float(seen.max()), 200)
        axis.plot(slips, study.truth(axle, slips), color=MEASURED, lw=4, alpha=0.35, label="true")
        axis.plot(slips, study.curve(found.fit, axle, slips), color=LEARNED, label="learned")
        axis.plot(
            seen[::10], np.zeros(len(seen[::10])), "|", color=MEASURED, alpha=0.3, label="seen"
        )
        axis.set(xlabel=f"slip of the {axle} tyre", ylim=(0, 1.15))
        axis.grid(alpha=0.25)
    axes[0].set(ylabel="coefficient of friction")
    axes[0].legend(frameon=False)
    return figure


def acceleration(found: study.Study) -> Figure:
    """The lateral acceleration as measured, and by both models."""
    figure = Figure(figsize=(9, 3.4), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    for axis, (name, record) in zip(axes, found.records.items(), strict=True):
        axis.plot(record.time, record[LATERAL], color=MEASURED, lw=3, alpha=0.35, label="measured")
        for what, runs in found.solutions.items():
            axis.plot(
                record.time, np.asarray(runs[name][LATERAL]), color=COLORS[what], lw=1, label=what
            )
        axis.set(xlabel=f"time [s], {name}")
        axis.grid(alpha=0.25)
    axes[0].set(ylabel="lateral acceleration [m/s2]")
    axes[0].legend(frameon=False)
    return figure
