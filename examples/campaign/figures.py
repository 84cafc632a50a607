"""The page of the campaign: runs, laws and parameters, beside what they are in truth."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

import acausal as ac
from acausal.reporting import LEARNED, TRUTH, Page
from examples.campaign import study as laws
from examples.campaign.model import GAUGE, OFFSET, SPEED, unknown
from examples.campaign.runs import RUNS

if TYPE_CHECKING:
    from examples.campaign.study import Study

MEASURED, PREDICTED = "#22303c", LEARNED[0]


def page(found: Study, out: Path) -> Path:
    """Write the page, and those of the training and of the cross-validation beside it."""
    written = Page(
        "A test campaign",
        f"Five runs of a drive train train one model, and each is left out in turn, in {found.seconds:.0f} s. "
        + found.crossed.summary(),
    )
    out.mkdir(parents=True, exist_ok=True)
    written.section("The drive train")
    written.drawing(
        ac.diagram(unknown()).svg, "The connected components; those that are tinted hold a network."
    )
    written.section("What was measured, and what is predicted of it")
    written.figure(
        runs(found), "Each run as predicted by the fold that was trained without it. The gauge of a run that is left "
        "out has an offset that nobody knows: its error is a constant, as large as offsets are.", out / "runs.png"
    )  # fmt: skip
    header = ("left out", "loss", *(f"RMS of {n}" for n in (SPEED, GAUGE)))
    rows = [
        (fold.name, f"{fold.held_out_loss:.3f}", *(f"{fold.rms[n]:.3f}" for n in (SPEED, GAUGE)))
        for fold in found.crossed.folds
    ]
    written.table(header, rows)
    written.section("What was learned")
    written.figure(
        learned(found), "Learned friction and cogging, and how far they are off.", out / "laws.png"
    )  # fmt: skip
    written.table(("parameter", "start", "all runs", "folds", "truth"), laws.parameters(found))
    written.section("The gauge's offset")
    written.figure(
        offsets(found), "The offset of each run [N.m], found together with all else.", out / "offsets.png"
    )  # fmt: skip
    written.table(("run", "found [N.m]", "truth [N.m]"), laws.offsets(found.fit))
    found.fit.report(out / "training", "Training on all runs")
    found.crossed.report(out / "cross-validation")
    return written.write(out / "index.html")


def runs(found: Study) -> Figure:
    """Speed and torque of every run, measured and predicted by the fold without it."""
    figure = Figure(figsize=(11, 2 * len(RUNS)), layout="constrained")
    axes = figure.subplots(len(RUNS), 2)
    for row, (name, record) in zip(axes, found.crossed.records.items(), strict=True):
        for i, (ax, label) in enumerate(zip(row, ("speed [rad/s]", "torque [N.m]"), strict=True)):
            known = ~np.isnan(record.measured[:, i])
            ax.plot(
                record.time[known], record.measured[known, i], ".", ms=1.5, color=MEASURED,
                alpha=0.5, label="measured",
            )  # fmt: skip
            ax.plot(record.time, record.predicted[:, i], color=PREDICTED, lw=0.9, label="predicted")
            ax.set(ylabel=label)
            ax.grid(alpha=0.25)
        row[0].set_title(f"{name}, left out", loc="left", fontsize=9)
    axes[0, 0].legend(frameon=False, fontsize=8)
    for ax in axes[-1]:
        ax.set_xlabel("time [s]")
    return figure


def learned(found: Study) -> Figure:
    """Both laws over their arguments, beside the truth."""
    figure = Figure(figsize=(11, 5.5), layout="constrained")
    axes = figure.subplots(2, 2, height_ratios=(2, 1), sharex="col")
    parts = (
        ("friction.net", laws.SPEEDS, laws.true_friction, "speed [rad/s]", "friction [N.m]"),
        ("cogging.net", laws.ANGLES, laws.true_cogging, "angle of the motor [rad]", "cogging [N.m]"),
    )  # fmt: skip
    for (ax, below), (network, x, true, xlabel, ylabel) in zip(axes.T, parts, strict=True):
        exact = true(x)
        law = laws.law(found.fit, network)(x)
        ax.plot(x, exact, color=TRUTH, lw=5, alpha=0.35, label="truth")
        ax.plot(x, law, color=PREDICTED, lw=1.3, label="learned from all runs")
        for k, fit in enumerate(found.crossed.fits):
            off = 1e3 * (laws.law(fit, network)(x) - exact)
            label = None if k else "folds"
            below.plot(x, off, color=PREDICTED, lw=0.7, alpha=0.4, label=label)
        below.plot(x, 1e3 * (law - exact), color=PREDICTED, lw=1.3, label="all runs")
        ax.set(ylabel=ylabel)
        below.set(xlabel=xlabel, ylabel="error [mN.m]")
        for each in (ax, below):
            each.grid(alpha=0.25)
            each.legend(frameon=False, fontsize=8)
    return figure


def offsets(found: Study) -> Figure:
    """The gauge's offset of every run, found and true."""
    figure = Figure(figsize=(6, 3), layout="constrained")
    ax = figure.subplots()
    places = np.arange(len(RUNS))
    ax.bar(places, [run.offset for run in RUNS.values()], 0.7, color="#c9d3dc", label="truth")
    values = [found.fit.records[name].parameters[OFFSET] for name in RUNS]
    ax.plot(places, values, "o", color=PREDICTED, label="found")
    ax.set_xticks(places, list(RUNS))
    ax.set(ylabel="offset [N.m]")
    ax.axhline(0, color=MEASURED, lw=0.8)
    ax.legend(frameon=False)
    return figure
