"""The page of the Silverbox: tables, learned laws, errors over the arrow."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import jax
import numpy as np
from matplotlib.figure import Figure

import acausal as ac
from acausal.reporting import plot_band
from examples.measured.judge import simulate
from examples.measured.present import Row, opening
from examples.silverbox import model, study
from examples.silverbox.model import KINDS, OURS, OUTPUT

FAR = 0.32
"""What the arrow reaches [m]."""

COLORS = {
    "white box (Duffing)": "#d9822b",
    "spring: a free network": "#9aa5b1",
    "spring: odd": "#c2a33a",
    "spring: odd, of a convex energy": "#b0463c",
    "spring: odd, rising, linear beyond": "#7a4fa3",
    "spring: odd, rising, cubic beyond": "#2e7d43",
    OURS: "#1f5c99",
}
"""Of the kinds that are drawn: the linear one is off the scale of all others."""


def page(
    path: Path,
    measured: Mapping[str, np.ndarray],
    rows: Sequence[Row],
    fits: Mapping[str, ac.Fit],
    everyone: ac.Ensemble,
    formulas: Mapping[str, ac.Distilled],
) -> None:
    """Write the page; ``everyone`` are all trainings of the model whose middle one is among the fits."""
    shown = opening(
        "The Silverbox",
        "An electronic circuit that behaves as a mass on a progressive spring, "
        "measured by T. Wigren and J. Schoukens (2013).",
        KINDS[OURS].build(),
        fits[OURS].system.equations,
        ("RMSE in mV", study.COLUMNS, rows),
    )
    shown.text(
        "Trained on 16,000 samples of the training record, chosen on others of it, tested by free simulation from a "
        "state that the first 50 samples tell. The input is read as a band-limited signal: linear interpolation "
        "between its samples costs more than the error that is left. Published figures: arXiv 2405.10779."
    )
    shown.section("Beyond the data")
    drawn = {name: fits[name] for name in COLORS}
    shown.figure(
        springs(drawn),
        "Left: what springs do beyond the linear one of the white box. Right: how far they are from the white "
        "box's cube. Between the dashed lines there were data; the arrow goes on to 0.3 m.",
    )
    shown.figure(
        arrow(measured, drawn), "Errors over the arrow, whose amplitude grows beyond all training."
    )
    shown.text(
        "Beyond the data a spring does what it promises. One that promises nothing, or is odd, goes on as it "
        "happens to; the slope of a convex energy is stable, but flattens; a linear one rises, but too little; and "
        "one that goes on along a cube comes closest to the true one. A cubic spring beside the network says the "
        "same by physics, and all trainings agree."
    )
    shown.section("Learned functions and their confidence")
    shown.figure(
        confidence(fits["white box (Duffing)"], fits[OURS], everyone, formulas),
        "Above: the force of springs, or of dampers, less that of the white box, with two standard deviations "
        "between trainings from different seeds. Below: the networks' part of it in the middle one of them, with two "
        "standard deviations that the record leaves open: there parameters and networks may take from each other, and "
        "only their sum is well known. Dotted: formulas.",
    )
    for name, formula in formulas.items():
        shown.text(
            f"{name}(x) = {formula.expression}, {100 * formula.relative_error:.2g} % from the network."
        )
    shown.write(path)


def springs(fits: Mapping[str, ac.Fit]) -> Figure:
    """Forces of springs beside the linear one, and beside the cubic one, of the white box."""
    x = np.linspace(-FAR, FAR, 401)
    pulls = {name: pull(fit, "mass.s", x) for name, fit in fits.items()}
    white = fits["white box (Duffing)"].params
    figure = Figure(figsize=(12, 4.6), layout="constrained")
    axes = figure.subplots(1, 2)
    for name, force in pulls.items():
        straight, cube = force - white["linear.c"] * x, force - pulls["white box (Duffing)"]
        axes[0].plot(x, 1e3 * straight, COLORS[name], label=name, lw=1.3)
        axes[1].plot(x, 1e3 * cube, COLORS[name], lw=1.3)
    for ax, beside, reach in zip(axes, ("linear", "cubic"), (140, 25), strict=True):
        for edge in (-model.REACH, model.REACH):
            ax.axvline(edge, color="#7a8794", lw=0.8, ls="--")
        ax.set(
            xlabel="position [m]",
            ylabel=f"force beside the {beside} spring [mN]",
            ylim=(-reach, reach),
        )
    axes[0].legend(frameon=False, fontsize=7)
    return figure


def pull(fit: ac.Fit, state: str, x: np.ndarray) -> np.ndarray:
    """What pulls the mass back where one state is varied and the other zero, less what does so at zero [N]."""
    system, packed = fit.system, fit.system.pack(fit.params)
    place = system.states.index(state)

    def at(value: jax.Array) -> jax.Array:
        states = jax.numpy.zeros(len(system.states)).at[place].set(value)
        return system.observe("mass.a", 0.0, states, jax.numpy.zeros(1), packed)

    force = -float(fit.params["mass.m"]) * np.asarray(jax.vmap(at)(jax.numpy.asarray(x)))
    return force - np.interp(0.0, x, force)


def arrow(measured: Mapping[str, np.ndarray], fits: Mapping[str, ac.Fit]) -> Figure:
    """Errors over the arrow."""
    data = study.record(measured, study.TESTS["arrow_full"])
    figure = Figure(figsize=(11, 5.5), layout="constrained")
    axes = figure.subplots(2, 1, sharex=True)
    axes[0].plot(data.time, data[OUTPUT], lw=0.4, color="#1d2733")
    axes[0].set_ylabel("measured [V]")
    for name, fit in fits.items():
        solution = simulate(
            fit.system, fit.params, data, OUTPUT, known=study.KNOWN, solver=study.SOLVER
        )
        gone = np.abs(np.asarray(solution[OUTPUT]) - data[OUTPUT])
        blocks = gone[: len(gone) // 500 * 500].reshape(-1, 500)
        at = data.time[250 : 500 * len(blocks) : 500]
        axes[1].semilogy(
            at, 1e3 * np.sqrt(np.mean(blocks**2, axis=1)), COLORS[name], label=name, lw=1.3
        )
    axes[1].set(ylabel="RMS error [mV]", xlabel="time [s]")
    axes[1].legend(frameon=False, fontsize=7)
    return figure


def confidence(
    white: ac.Fit, fit: ac.Fit, everyone: ac.Ensemble, formulas: Mapping[str, ac.Distilled]
) -> Figure:
    """What is learned beside the white box by all trainings, and the networks of one of them."""
    told = fit.confidence().laws
    states = {"mass.s": "position [m]", "mass.v": "speed [m/s]"}
    figure = Figure(figsize=(12, 7), layout="constrained")
    axes = figure.subplots(2, 2, sharex="col")
    for (above, below), state, (name, formula) in zip(
        axes.T, states, formulas.items(), strict=True
    ):
        x = np.linspace(*formula.interval, 201)
        beside = [pull(one, state, x) - pull(white, state, x) for one in everyone.fits]
        mean, sigma = np.mean(beside, axis=0), np.std(beside, axis=0)
        above.plot(x, mean, color=COLORS[OURS], label="mean of all trainings")
        above.fill_between(x, mean - 2 * sigma, mean + 2 * sigma, color=COLORS[OURS], alpha=0.25)
        above.set(ylabel="force beside the white box [N]")
        plot_band(below, told[name], color=COLORS[OURS], label="network")
        below.plot(x, jax.vmap(formula.formula)(x), ":", color="#1d2733", label="formula")
        below.set(xlabel=states[state], ylabel=f"{name} [N]")
        for ax in (above, below):
            ax.ticklabel_format(axis="y", scilimits=(-3, -3))
            ax.legend(frameon=False, fontsize=8)
    return figure
