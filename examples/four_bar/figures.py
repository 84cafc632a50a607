"""The page of the four-bar: the mechanism in motion, the learned friction, and the motor's torque."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from examples.four_bar import model, study
from examples.four_bar.model import FRICTION, TORQUE
from examples.measured.present import opening

MEASURED, LEARNED, VISCOUS = "#22303c", "#1f5c99", "#c2571a"
COLORS = {"learned friction": LEARNED, "viscous friction": VISCOUS}


def page(path: Path, found: study.Study) -> None:
    """Write the page."""
    path.parent.mkdir(parents=True, exist_ok=True)
    shown = opening(
        "Four-bar linkage",
        "A motor turns the crank; the joint between rocker and frame is worn. Its friction is learned from the torque "
        "of the motor.",
        model.FourBar(),
        model.Motor().equations(),
        ("", study.COLUMNS, found.rows),
    )
    shown.text(
        "The first record is trained on. The second, slower one was held out: it is simulated from its first sample "
        f"with what was learned. The noise of the torque is {study.NOISE} N.m."
    )
    shown.section("The mechanism")
    moving = found.solutions["learned friction"]
    shown.add(
        moving.animation(
            trace="coupler.body", caption="The record that was held out, with the learned friction."
        )
    )
    shown.section("The friction")
    shown.figure(
        friction(found), "Friction of the worn joint over its speed.", path.parent / "friction.png"
    )
    shown.section("The motor's torque")
    shown.figure(
        torque(found), "The record that was held out, from its first sample.", path.parent / "torque.png"
    )  # fmt: skip
    shown.write(path)


def friction(found: study.Study) -> Figure:
    """The learned friction [N.m] and the true one."""
    figure = Figure(figsize=(7, 3.4), layout="constrained")
    ax = figure.subplots()
    speeds = np.linspace(0.0, float(np.max(found.fit.arguments[FRICTION])), 200)
    ax.plot(speeds, study.truth(speeds), color=MEASURED, lw=4, alpha=0.35, label="true")
    ax.plot(speeds, study.curve(found.fit, speeds), color=LEARNED, label="learned")
    ax.set(xlabel="speed [rad/s]", ylabel="friction [N.m]")
    ax.set_ylim(bottom=0.0)
    ax.legend(frameon=False)
    ax.grid(alpha=0.25)
    return figure


def torque(found: study.Study) -> Figure:
    """The motor's torque as measured, and how far both models are off."""
    record = found.records["held"]
    figure = Figure(figsize=(9, 5), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True)
    above.plot(record.time, record[TORQUE], color=MEASURED, lw=3, alpha=0.35, label="measured")
    for name, solution in found.solutions.items():
        simulated = np.asarray(solution[TORQUE])
        above.plot(record.time, simulated, color=COLORS[name], lw=1, label=name)
        below.plot(record.time, simulated - record[TORQUE], color=COLORS[name], lw=1)
    above.set(ylabel="torque [N.m]")
    below.set(xlabel="time [s]", ylabel="error [N.m]")
    above.legend(frameon=False, ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    for ax in (above, below):
        ax.grid(alpha=0.25)
    return figure
