"""The page of the Silverbox: tables, learned laws, errors over the arrow."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import jax
import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

import acausal as ac
from acausal.report import Page
from examples.measured.judge import simulate
from examples.measured.present import Row
from examples.silverbox import model, study
from examples.silverbox.model import OUTPUT

FAR = 0.32
"""What the arrow reaches [m]."""

COLORS = {
    "linear": "#9aa5b1",
    "white box (Duffing)": "#d9822b",
    "networks without promises": "#2e7d43",
    "networks with promises": "#7a4fa3",
    "Duffing and networks": "#1f5c99",
}


def page(
    path: Path,
    measured: Mapping[str, np.ndarray],
    rows: Sequence[Row],
    fits: Mapping[str, ac.Fit],
    formulas: Mapping[str, ac.Distilled],
) -> None:
    """Write the page."""
    shown = Page(
        "The Silverbox",
        "An electronic circuit that behaves as a mass on a progressive spring, "
        "measured by T. Wigren and J. Schoukens (2013).",
    )
    system = fits["Duffing and networks"].system
    shown.section("The model")
    diagram = ac.diagram(model.enhanced()[0]).figure
    assert isinstance(diagram, Figure)
    shown.figure(diagram, "The connected components; tinted ones hold a network.")
    shown.equations(system.equations)
    shown.section("The result")
    shown.table(["RMSE in mV", *study.COLUMNS.values()], [r.cells(study.COLUMNS) for r in rows])
    shown.text(
        "Trained on 16,000 samples of the training record, chosen on others of it, tested by free simulation from a "
        "state that the first 50 samples tell. The input is read as a band-limited signal: linear interpolation "
        "between its samples costs more than the error that is left. Published figures: arXiv 2405.10779."
    )
    shown.section("Beyond the data")
    shown.figure(
        laws(fits),
        "What springs and dampers do beyond the linear ones of the white box. Between the dashed lines there "
        "were data; the arrow goes on to 0.3 m.",
    )
    shown.figure(
        arrow(measured, fits), "Errors over the arrow, whose amplitude grows beyond all training."
    )
    shown.text(
        "Networks that promise nothing do beyond the data what they like. Networks that promise to rise and to go "
        "on linearly stay stable, but the true spring grows as a cube. The cubic spring is known physics, and so is "
        "how it goes on; the networks have only to mend it, and to do no harm where they know nothing."
    )
    shown.section("Read as physics")
    for name, formula in formulas.items():
        shown.text(
            f"{name}(x) = {formula.expression}, {100 * formula.relative_error:.2g} % from the network."
        )
    shown.write(path)


def laws(fits: Mapping[str, ac.Fit]) -> Figure:
    """Forces of spring and damper beside those of the white box's linear ones."""
    base = fits["white box (Duffing)"].params
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.2), layout="constrained")
    places = ((model.REACH, FAR, "mass.s"), (model.SPEED, 150.0, "mass.v"))
    for ax, (known, far, state) in zip(axes, places, strict=True):
        x = np.linspace(-far, far, 401)
        slope = base["linear.c"] if state == "mass.s" else base["linear.d"]
        for name, fit in fits.items():
            force = pull(fit, state, x) - slope * x
            ax.plot(x, 1e3 * (force - force[200]), COLORS[name], label=name, lw=1.3)
        for edge in (-known, known):
            ax.axvline(edge, color="#7a8794", lw=0.8, ls="--")
        ax.set_ylabel("force beside the linear one [mN]")
    axes[0].set(xlabel="position [m]", title="spring", ylim=(-150, 150))
    axes[1].set(xlabel="speed [m/s]", title="damper", ylim=(-2, 2))
    axes[0].legend(frameon=False, fontsize=8)
    return figure


def pull(fit: ac.Fit, state: str, x: np.ndarray) -> np.ndarray:
    """What pulls the mass back, where one state is varied and the other one zero, less what a force gives."""
    system, packed = fit.system, fit.system.pack(fit.params)
    place = system.states.index(state)

    def at(value: jax.Array) -> jax.Array:
        states = jax.numpy.zeros(len(system.states)).at[place].set(value)
        return system.observe("mass.a", 0.0, states, jax.numpy.zeros(1), packed)

    return -float(fit.params["mass.m"]) * np.asarray(jax.vmap(at)(jax.numpy.asarray(x)))


def arrow(measured: Mapping[str, np.ndarray], fits: Mapping[str, ac.Fit]) -> Figure:
    """Errors over the arrow."""
    data = study.record(measured, study.TESTS["arrow_full"])
    figure, axes = plt.subplots(2, 1, figsize=(11, 5.5), sharex=True, layout="constrained")
    axes[0].plot(data.time, data[OUTPUT], lw=0.4, color="#1d2733")
    axes[0].set_ylabel("measured [V]")
    for name, fit in fits.items():
        if name == "linear":
            continue  # its errors are off the scale of all others
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
    axes[1].legend(frameon=False, fontsize=8)
    return figure
