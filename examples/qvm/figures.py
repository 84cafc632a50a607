"""The pictures of the quarter vehicle's pages."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure

import acausal as ac
from acausal.reporting import LEARNED, TRUTH, plot_learned, plot_losses, plot_modifiers
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
    """Losses over epochs (figure 3b)."""
    figure = Figure(figsize=(8, 4.2))
    ax = figure.subplots()
    plot_losses(ax, {label: fit.history for label, fit in fits.items()}, levels=levels)
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
    plot_modifiers(ax, fit, targets=UNCERTAIN)
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
