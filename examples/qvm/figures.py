"""The pictures of the quarter vehicle's pages."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import cycle
from typing import Any

import numpy as np
from matplotlib.figure import Figure

import acausal as ac
from acausal.reporting import GUIDE, LEARNED, TRUTH, plot_learned
from examples.qvm.judge import DAMPER, SPRING, true_forces
from examples.qvm.model import UNCERTAIN, linear
from examples.qvm.record import INPUT, Ride

MATHS = {
    "body.s": "z_b",
    "body.v": "v_b",
    "wheel.s": "z_w",
    "wheel.v": "v_w",
    "road.s": "z_r",
    "road.v_ref": "u",
    "body.m": "m_b",
    "wheel.m": "m_w",
    "suspension.c": "c_s",
    "suspension.d": "d_s",
    "tyre.c": "c_t",
    "tyre.d": "d_t",
    SPRING: "F_NN_c",
    DAMPER: "F_NN_d",
}
"""The paper's names."""


def forces(fits: Mapping[str, ac.Fit]) -> Figure:
    """Learned spring and damper against the truth (the paper's figures 2 and 3a)."""
    true = true_forces()
    *_, last = fits.values()
    figure = Figure(figsize=(11, 4.2))
    axes = figure.subplots(1, 2)
    for ax, name, symbol in ((axes[0], SPRING, "z_s [m]"), (axes[1], DAMPER, "v_s [m/s]")):
        functions = {label: fit.remove_offset()[name] for label, fit in fits.items()}
        plot_learned(
            ax, functions, last.seen[name], truth=true[name], xlabel=symbol, ylabel="force [N]"
        )
    axes[0].set_title("spring: what the linear spring lacks")
    axes[1].set_title("damper: what the linear damper lacks")
    figure.tight_layout()
    return figure


def losses(fits: Mapping[str, ac.Fit], levels: Mapping[str, float]) -> Figure:
    """Losses over epochs (figure 3b): of the batches (thin), over the record (dots), of held-out samples (squares)."""
    histories = {label: fit.history for label, fit in fits.items()}
    figure = Figure(figsize=(8, 4.2))
    ax = figure.subplots()
    if not any(np.any(h.loss <= 0) or np.any(h.full_loss[:, 1] <= 0) for h in histories.values()):
        ax.set_yscale("log")  # a logarithm of a likelihood may be negative
    for (label, history), color in zip(histories.items(), cycle(LEARNED), strict=False):
        ax.plot(np.arange(history.epochs), history.loss, color=color, lw=0.6, alpha=0.45)
        ax.plot(*history.full_loss.T, "o-", color=color, lw=1.2, ms=3, label=label)
        if len(history.validation_loss):
            kept = f"{label}, held out"
            ax.plot(*history.validation_loss.T, "s--", color=color, lw=1.2, ms=3, label=kept)
    for label, level in levels.items():
        ax.axhline(level, color=GUIDE, lw=1, ls=":")
        place = (1.0, level)
        ax.annotate(
            label, place, xycoords=("axes fraction", "data"), xytext=(4, 0), textcoords="offset points",
            va="center", fontsize=8, color=GUIDE, annotation_clip=False,
        )  # fmt: skip
    ax.set(xlabel="epoch", ylabel="loss")
    ax.grid(alpha=0.25, which="both")
    ax.legend(frameon=False)
    figure.tight_layout()
    return figure


def trajectories(fit: ac.Fit, ride: Ride, window: tuple[float, float] = (4.0, 8.0)) -> Figure:
    """Travel, speed and acceleration of the body: measured truth, linear model, trained model (figure 4)."""
    runs = {
        "linear model": _drive(ac.compile(linear()), None, ride),
        "PeN-ODE": _drive(fit.system, fit.params, ride),
    }
    time = ride.clean.time
    shown = (time >= window[0]) & (time <= window[1])
    figure = Figure(figsize=(10, 7.5))
    axes = figure.subplots(3, 1, sharex=True)
    rows = (("body.s", "z_b [m]"), ("body.v", "v_b [m/s]"), ("body.a", "a_b [m/s²]"))
    for ax, (name, label) in zip(axes, rows, strict=True):
        ax.plot(
            time[shown],
            ride.clean[name][shown],
            color=TRUTH,
            lw=2.4,
            alpha=0.5,
            label="reference",
        )
        for (run, solution), style, color in zip(
            runs.items(), ("--", "-"), LEARNED[1::-1], strict=True
        ):
            ax.plot(
                time[shown],
                np.asarray(solution[name])[shown],
                style,
                color=color,
                lw=1.1,
                label=run,
            )
        ax.set_ylabel(label)
        ax.grid(alpha=0.25)
    axes[0].legend(frameon=False, ncols=3, loc="upper right")
    axes[-1].set_xlabel("time [s]")
    figure.tight_layout()
    return figure


def modifiers(fit: ac.Fit) -> Figure:
    """Modifiers of the parameters over epochs (figure 5)."""
    figure = Figure(figsize=(8, 4.2))
    ax = figure.subplots()
    for (name, values), color in zip(fit.history.modifiers.items(), cycle(LEARNED), strict=False):
        ax.plot(values, color=color, lw=1.4, label=name)
        ax.axhline(UNCERTAIN[name], color=color, lw=0.9, ls="--")
    ax.set(xlabel="epoch", ylabel="change")
    ax.grid(alpha=0.25)
    ax.legend(frameon=False)
    figure.tight_layout()
    return figure


def _drive(system: ac.System, params: dict[str, Any] | None, ride: Ride) -> ac.Solution:
    record = ride.clean
    return ac.simulate(
        system,
        (record.time[0], record.time[-1]),
        dt=record.sample_time,
        inputs={INPUT: record[INPUT]},
        params=params,
        solver="heun",
    )
