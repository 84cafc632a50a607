"""The page of the Cascaded Tanks: tables, learned laws with their bands, the test record."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import jax
import numpy as np
import sympy as sp
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import acausal as ac
from acausal.training import Confidence
from examples.cascaded_tanks import model, study
from examples.cascaded_tanks.model import CURVE, LAW, LEARNED, OURS, OUTPUT, PROMISING, WHITE
from examples.measured.present import Row, opening

SHOWN = {WHITE: "#d9822b", OURS: "#1f5c99", PROMISING: "#2e7d43", LEARNED: "#7a4fa3"}
"""Models in pictures, and their colours."""


def page(
    path: Path,
    measured: Mapping[str, np.ndarray],
    rows: Sequence[Row],
    fits: Mapping[str, ac.Fit],
    short: ac.Fit,
) -> None:
    """Write the page."""
    ours = fits[OURS]
    sure = ours.confidence()
    shown = opening(
        "Cascaded Tanks",
        "A pump, two tanks that overflow, and a level sensor that saturates, "
        "measured by M. Schoukens and J. P. Noël (2017).",
        model.curved()[0],
        ours.system.equations,
        ("RMSE in V", study.COLUMNS, rows),
    )
    shown.text(
        "Models are chosen by what they predict of the training record where a third of it was held out, each third in "
        "turn, and trained on all of it for the test. The upper level at the start of the test is that of the training "
        "record, as the benchmark says; the lower one comes from the first five samples."
    )
    shown.figure(record(measured, fits), "The test record, simulated, and the errors.")
    shown.section("The sensor")
    shown.figure(
        sensor(fits, sure, short),
        "The learned curve with a band of two standard deviations, and the formula that takes its place; levels "
        "between the dashed lines occur in training.",
    )
    area, slack = (
        1e6 * float(ours.params["upper_hole.area"]),
        1e3 * float(ours.params["slack.uMax"]),
    )
    shown.text(
        "The sensor is not straight, and its float sticks: it follows once the level is "
        f"{slack:.2f} mm off. With that Torricelli's law does for both holes, of {area:.1f} mm2 each."
    )
    law = sp.N(short.params[CURVE].net.expression(), 3)
    shown.text(
        f"The curve as a formula, distilled from the network and trained on: {law} V, of the level x in m."
    )
    for sentence in sure.summary():
        shown.text(sentence)
    shown.section("The outflow, if nothing is known of it but its promises")
    shown.figure(
        outflow(fits),
        "One neural resistance in place of both holes, with a band of two standard deviations; pressures between the "
        "dashed lines occur in training.",
    )
    shown.text(
        "Where there are data, the learned flow rises as the pressure to the power of "
        f"{exponent(fits[LEARNED]):.2f}; Torricelli's law has 0.5."
    )
    shown.write(path)


def record(measured: Mapping[str, np.ndarray], fits: Mapping[str, ac.Fit]) -> Figure:
    """The test record and the errors of its simulations."""
    data = study.record(measured["uVal"], measured["yVal"])
    figure = Figure(figsize=(11, 6), layout="constrained")
    axes = figure.subplots(2, 1, sharex=True)
    axes[0].plot(data.time, data[OUTPUT], color="#1d2733", lw=2.5, alpha=0.4, label="measured")
    for name in (WHITE, OURS):
        went = np.asarray(study.tested(measured, fits[name])[OUTPUT])
        axes[0].plot(data.time, went, SHOWN[name], lw=1.2, label=name)
        axes[1].plot(data.time, went - data[OUTPUT], SHOWN[name], lw=1.0, label=name)
    axes[0].set_ylabel("lower level [V]")
    axes[0].legend(frameon=False, fontsize=8)
    axes[1].set(ylabel="error [V]", xlabel="time [s]")
    axes[1].grid(alpha=0.25)
    return figure


def sensor(fits: Mapping[str, ac.Fit], sure: Confidence, short: ac.Fit) -> Figure:
    """Voltage over level: straight in the white box, learned, and a formula."""
    x = np.linspace(0.03, 0.17, 281)
    band, white = sure.laws[CURVE], fits[WHITE].params
    figure = Figure(figsize=(7.5, 4.2), layout="constrained")
    ax = figure.subplots()
    volts = np.asarray(jax.vmap(fits[OURS].params[CURVE])(x))
    sigma = np.interp(x, band.x, band.sigma, left=np.nan, right=np.nan)
    ax.fill_between(
        100 * x, volts - 2 * sigma, volts + 2 * sigma, color=SHOWN[OURS], alpha=0.25, lw=0
    )
    ax.plot(100 * x, volts, SHOWN[OURS], lw=1.6, label="learned")
    other = np.asarray(jax.vmap(fits[PROMISING].params[CURVE])(x))
    ax.plot(100 * x, other, SHOWN[PROMISING], lw=1.0, label="learned, rising, tame")
    formula = np.asarray(jax.vmap(short.params[CURVE])(x))
    ax.plot(100 * x, formula, "#1d2733", lw=1.2, ls=":", label="formula")
    straight = float(white["sensor.y0"]) + float(white["sensor.k"]) * x
    ax.plot(100 * x, straight, SHOWN[WHITE], lw=1.2, label="straight, of the white box")
    ax.axhline(10, color="#7a8794", lw=0.8)
    _edges(ax, 100 * fits[OURS].arguments[CURVE][:, 0])
    ax.set(xlabel="level [cm]", ylabel="sensor [V]", ylim=(0, 14))
    ax.legend(frameon=False)
    return figure


def outflow(fits: Mapping[str, ac.Fit]) -> Figure:
    """What runs out of a tank over the pressure at its bottom: learned, and by Torricelli."""
    learned, known = fits[LEARNED], fits[OURS].params
    x = np.linspace(-300.0, 2000.0, 251)
    band, flow = learned.confidence().laws[LAW], np.asarray(jax.vmap(learned.params[LAW])(x))
    sigma = np.interp(x, band.x, band.sigma, left=np.nan, right=np.nan)
    C_d, area, rho = (float(known[f"upper_hole.{n}"]) for n in ("C_d", "area", "rho"))
    hole = C_d * area * np.sqrt(2 * rho * np.abs(x)) * np.sign(x)
    figure = Figure(figsize=(7.5, 4.2), layout="constrained")
    ax = figure.subplots()
    low, high = (1e3 * (flow + k * sigma) for k in (-2, 2))
    ax.fill_between(x, low, high, color=SHOWN[LEARNED], alpha=0.25, lw=0)
    ax.plot(x, 1e3 * flow, SHOWN[LEARNED], lw=1.6, label="learned")
    ax.plot(x, 1e3 * hole, SHOWN[OURS], lw=1.2, label="Torricelli's law of the model above")
    _edges(ax, learned.arguments[LAW][:, 0])
    ax.axhline(0, color="#7a8794", lw=0.8)
    ax.set(xlabel="pressure [Pa]", ylabel="outflow [g/s]", ylim=(-15, 45))
    ax.legend(frameon=False)
    return figure


def exponent(fit: ac.Fit) -> float:
    """The power of the pressure as which the learned outflow rises where there are data."""
    low, high = np.quantile(fit.arguments[LAW][:, 0], [0.05, 0.95])
    x = np.linspace(low, high, 101)
    return float(np.polyfit(np.log(x), np.log(jax.vmap(fit.params[LAW])(x)), 1)[0])


def _edges(ax: Axes, seen: np.ndarray) -> None:
    for edge in (seen.min(), seen.max()):
        ax.axvline(edge, color="#7a8794", lw=0.8, ls="--")
