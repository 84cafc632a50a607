"""The page of the Cascaded Tanks: tables, learned laws with their bands, the test record."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import jax
import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import sympy as sp
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import acausal as ac
from acausal.report import Page
from examples.cascaded_tanks import model, study
from examples.cascaded_tanks.model import FREE, OURS, OUTPUT, PROMISING, WHITE
from examples.measured.present import Row

SHOWN = {
    WHITE: "#d9822b",
    OURS: "#1f5c99",
    FREE: "#2e7d43",
    PROMISING: "#7a4fa3",
}
"""Models in pictures, and their colours."""
PRESSURE = 1e3 * 9.80665
"""Of a metre of water [Pa]."""


def page(
    path: Path,
    measured: Mapping[str, np.ndarray],
    rows: Sequence[Row],
    fits: Mapping[str, ac.Fit],
    formulas: Mapping[str, ac.Fit],
) -> None:
    """Write the page."""
    ours = fits[OURS]
    sure = ours.confidence()
    shown = Page(
        "Cascaded Tanks",
        "A pump, two tanks that overflow, and a level sensor that saturates, "
        "measured by M. Schoukens and J. P. Noël (2017).",
    )
    shown.section("The model")
    diagram = ac.diagram(model.with_tame_curve()[0]).figure
    assert isinstance(diagram, Figure)
    shown.figure(diagram, "The connected components; the tinted one holds a network.")
    shown.equations(ours.system.equations)
    shown.section("The result")
    shown.table(["RMSE in V", *study.COLUMNS.values()], [r.cells(study.COLUMNS) for r in rows])
    shown.text(
        "Models are chosen on the last third of the training record, which goes on from where a training on the first "
        "two thirds ended, and trained on all of it for the test. The upper level at the start of the test is that of "
        "the training record, as the benchmark says; the lower one comes from the first five samples."
    )
    shown.figure(record(measured, fits), "The test record, simulated, and the errors.")
    shown.section("The sensor")
    shown.figure(
        sensor(ours, sure, fits[WHITE]),
        "The learned curve with a band of two standard deviations; levels between the dashed lines occur.",
    )
    areas = [1e6 * float(ours.params[f"{tank}_hole.area"]) for tank in ("upper", "lower")]
    shown.text(
        "The sensor is not straight. With its curve Torricelli's law does for both holes: "
        f"{areas[0]:.1f} and {areas[1]:.1f} mm2, in tanks that are taken to be alike."
    )
    for sentence in sure.words():
        shown.text(sentence)
    shown.section("The outflow, if nothing is known of it")
    shown.figure(
        outflow(fits),
        "Neural resistances in place of the holes, with bands of two standard deviations; between the dashed lines "
        "there were data.",
    )
    for name in ("upper_nn.net", "lower_nn.net"):
        n = exponent(fits[PROMISING], name)
        shown.text(
            f"{name}, with promises: where there are data, the flow rises as the pressure to the power of {n:.2f}."
        )
    shown.text(
        "A network that promises nothing may let water run upwards where nothing was seen. One that promises to be "
        "passive, to rise and to go on linearly starts at zero and stays a law of a hole."
    )
    shown.section("Read as physics")
    for label, fit in formulas.items():
        for name in fit.seen:
            law = sp.N(fit.params[name].expression(), 3)
            shown.text(f"{label}: {name}(x) = {law}, distilled from the network and trained on.")
    shown.write(path)


def record(measured: Mapping[str, np.ndarray], fits: Mapping[str, ac.Fit]) -> Figure:
    """The test record and the errors of its simulations."""
    data = study.record(measured["uVal"], measured["yVal"])
    figure, axes = plt.subplots(2, 1, figsize=(11, 6), sharex=True, layout="constrained")
    axes[0].plot(data.time, data[OUTPUT], color="#1d2733", lw=2.5, alpha=0.4, label="measured")
    for name in (WHITE, OURS):
        went = np.asarray(study.tested(measured, fits[name], fits[name].params)[OUTPUT])
        axes[0].plot(data.time, went, SHOWN[name], lw=1.2, label=name)
        axes[1].plot(data.time, went - data[OUTPUT], SHOWN[name], lw=1.0, label=name)
    axes[0].set_ylabel("lower level [V]")
    axes[0].legend(frameon=False, fontsize=8)
    axes[1].set(ylabel="error [V]", xlabel="time [s]")
    axes[1].grid(alpha=0.25)
    return figure


def sensor(ours: ac.Fit, sure: ac.Confidence, white: ac.Fit) -> Figure:
    """Voltage over level: straight in the white box, and learned."""
    law = sure.laws["curve.net"]
    seen = ours.arguments["curve.net"][:, 0]
    inside = (law.x > 0.9 * seen.min()) & (law.x < 1.05 * seen.max())
    x = law.x[inside]
    line = float(ours.params["sensor.y0"]) + float(ours.params["sensor.k1"]) * x
    volts, sigma = line + law.law[inside], law.sigma[inside]
    figure, ax = plt.subplots(figsize=(7.5, 4.2), layout="constrained")
    ax.fill_between(
        100 * x, volts - 2 * sigma, volts + 2 * sigma, color="#1f5c99", alpha=0.25, lw=0
    )
    ax.plot(100 * x, volts, SHOWN[OURS], lw=1.6, label="learned")
    straight = float(white.params["sensor.y0"]) + float(white.params["sensor.k1"]) * x
    ax.plot(100 * x, straight, SHOWN[WHITE], lw=1.2, label="straight, of the white box")
    ax.axhline(10, color="#7a8794", lw=0.8)
    _edges(ax, 100 * seen)
    ax.set(xlabel="level [cm]", ylabel="sensor [V]", ylim=(0, 14))
    ax.legend(frameon=False)
    return figure


def outflow(fits: Mapping[str, ac.Fit]) -> Figure:
    """What runs out of each tank over the pressure at its bottom."""
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.4), sharey=True, layout="constrained")
    for ax, tank in zip(axes, ("upper", "lower"), strict=True):
        x = np.linspace(-300.0, PRESSURE * model.FULL, 251)
        ax.plot(x, 1e3 * hole(fits[OURS], tank, x), SHOWN[OURS], lw=2, alpha=0.6,
                label="Torricelli's law, with the sensor's curve")  # fmt: skip
        for name in (FREE, PROMISING):
            net, law = f"{tank}_nn.net", fits[name].confidence().laws[f"{tank}_nn.net"]
            flow = 1e3 * np.asarray(jax.vmap(fits[name].params[net])(x))
            sigma = 1e3 * np.interp(x, law.x, law.sigma, left=np.nan, right=np.nan)
            ax.plot(x, flow, SHOWN[name], lw=1.4, label=name)
            ax.fill_between(
                x, flow - 2 * sigma, flow + 2 * sigma, color=SHOWN[name], alpha=0.2, lw=0
            )
        _edges(ax, fits[PROMISING].arguments[f"{tank}_nn.net"][:, 0])
        ax.axhline(0, color="#7a8794", lw=0.8)
        ax.set(xlabel="pressure [Pa]", title=f"{tank} tank", ylim=(-15, 45))
    axes[0].set_ylabel("outflow [g/s]")
    axes[0].legend(frameon=False, fontsize=8)
    return figure


def _edges(ax: Axes, seen: np.ndarray) -> None:
    for edge in (seen.min(), seen.max()):
        ax.axvline(edge, color="#7a8794", lw=0.8, ls="--")


def hole(fit: ac.Fit, tank: str, pressure: np.ndarray) -> np.ndarray:
    """Outflow [kg/s] of a hole, by Torricelli."""
    C_d, area, rho = (float(fit.params[f"{tank}_hole.{n}"]) for n in ("C_d", "area", "rho"))
    return C_d * area * np.sqrt(2 * rho * np.abs(pressure)) * np.sign(pressure)


def exponent(fit: ac.Fit, name: str) -> float:
    """The power of the pressure as which a law rises, over the middle of what it has seen."""
    low, high = np.quantile(fit.arguments[name][:, 0], [0.05, 0.95])
    x = np.linspace(low, high, 101)
    flow = np.asarray(jax.vmap(fit.params[name])(x))
    return float(np.polyfit(np.log(x), np.log(flow), 1)[0])
