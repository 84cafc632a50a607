"""The page of the double pendulum: errors, the learned friction, and a swing that was held out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import jax
import numpy as np
from matplotlib.figure import Figure

import acausal as ac
from examples.double_pendulum import model, study
from examples.double_pendulum.model import ANGLES, JOINTS
from examples.measured.present import Row, opening

MEASURED, LEARNED = "#22303c", "#1f5c99"


def page(path: Path, swings: Mapping[int, ac.Data], rows: Sequence[Row], fit: ac.Fit) -> None:
    """Write the page."""
    path.parent.mkdir(parents=True, exist_ok=True)
    shown = opening(
        "Double pendulum",
        "Free swings of two arms on ball bearings, measured by K. Kaheman and others (2023).",
        model.DoublePendulum(model.bearing(), model.bearing(), drag=True),
        fit.system.equations,
        ("", study.COLUMNS, rows),
    )
    shown.text(
        f"Each swing is simulated from its first sample, for 2.66 s. Swings {', '.join(map(str, study.HELD))} were "
        "held out of the training."
    )
    shown.section("The friction")
    shown.figure(
        friction(fit), "Learned friction of both joints over their speeds.", path.parent / "friction.png"
    )  # fmt: skip
    shown.section("A swing that was held out")
    swing = swings[study.HELD[0]]
    shown.figure(
        held(fit, swing),
        "Measured angles (dark) and simulated ones, and their difference.",
        path.parent / "swing.png",
    )
    shown.write(path)


def friction(fit: ac.Fit) -> Figure:
    """Torques of both joints [N.m]."""
    figure = Figure(figsize=(10, 3.2), layout="constrained")
    axes = figure.subplots(1, 2)
    for ax, joint in zip(axes, JOINTS, strict=True):
        net = fit.params[f"{joint}.net"]
        speeds = np.linspace(0.0, float(np.max(fit.arguments[f"{joint}.net"])), 200)
        ax.plot(speeds, 1e3 * np.asarray(jax.vmap(net)(speeds)), color=LEARNED)
        ax.set(title=joint.partition("_")[0], xlabel="speed [rad/s]", ylabel="friction [mN.m]")
        ax.set_ylim(bottom=0.0)
        ax.grid(alpha=0.25)
    return figure


def held(fit: ac.Fit, swing: ac.Data) -> Figure:
    """Angles of a swing, and how far they are off."""
    solution = study.simulated(fit.system, fit.params, swing)
    figure = Figure(figsize=(10, 5), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True)
    for name in ANGLES:
        above.plot(swing.time, swing[name], color=MEASURED, lw=3, alpha=0.4)
        above.plot(swing.time, np.asarray(solution[name]), lw=1, label=name)
        below.plot(swing.time, 1e3 * (np.asarray(solution[name]) - swing[name]), lw=1, label=name)
    above.set(ylabel="angle [rad]")
    below.set(xlabel="time [s]", ylabel="error [mrad]")
    for ax in (above, below):
        ax.legend(frameon=False)
        ax.grid(alpha=0.25)
    return figure
