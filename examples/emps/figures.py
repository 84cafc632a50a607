"""The page of the EMPS: tables, the learned friction, and what makes an open loop drift."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import jax
import numpy as np
from matplotlib.figure import Figure

import acausal as ac
from examples.emps import model, study
from examples.emps.model import KINDS, OURS
from examples.measured.present import Row, opening

PHYSICS = "passive network"
"""The model whose laws are read as physics."""
COLORS = {
    "white box, trained": "#d9822b",
    PHYSICS: "#2e7d43",
    OURS: "#1f5c99",
}
LAP = 6240
"""Samples after which the reference repeats."""


def page(
    path: Path,
    training: study.Measured,
    test: study.Measured,
    rows: Sequence[Row],
    fits: Mapping[str, ac.Fit],
    law: ac.Distilled,
) -> None:
    """Write the page."""
    shown = opening(
        "EMPS",
        "An electro-mechanical positioning system, a motor that moves a carriage by a screw, "
        "measured by A. Janot, M. Gautier and M. Brunot (2019).",
        model.Axis(model.network(), dry=model.Coulomb(Fv=0.0), cable=model.cable()),
        fits[OURS].system.equations,
        ("", study.COLUMNS, rows),
    )
    shown.text(
        "Open loop: the measured voltage alone drives the axis for 24.8 s, from a state that 20 samples tell. Closed "
        "loop: the reference drives the axis in its controller, which the model has, too; errors relative to what was "
        "measured, by the definitions of the benchmark's scripts. Published figures: arXiv 2405.10779."
    )
    shown.section("The friction")
    shown.figure(
        friction(training, fits),
        "Left: the measured force without inertia (grey), and the learned laws in the middle of the way: "
        "Coulomb friction and a viscous one, stronger backwards. Training with tolerances bends the law where the axis "
        "is not, for the sake of other runs. Middle and right: both networks with one sigma of confidence; between the "
        "dashed lines there were data.",
    )
    shown.text(
        f"There the network of the friction is, in short, {law.expression}, to {100 * law.relative_error:.2g} %."
    )
    shown.section("Why an open loop drifts")
    shown.figure(drift(training, test, fits), DRIFT)
    shown.write(path)


DRIFT = (
    "Above: errors of position in open loop. Below: by how much the measured force is above that of the model, at all "
    "and in the direction of motion, mean of each lap. A newton more of friction, a twentieth, makes an axis slower by "
    "some 5 mm/s, forth and back; a tenth of a newton more of a constant force moves it by 10 mm in 25 s."
)


def friction(training: study.Measured, fits: Mapping[str, ac.Fit]) -> Figure:
    """Measured and learned friction over the speed, and the part of the network with its confidence."""
    figure = Figure(figsize=(12, 4), layout="constrained")
    axes = figure.subplots(1, 3)
    true = study.smooth(training)
    force = model.GAIN * true[model.INPUT] - mass(fits[OURS]) * true["carriage.a"]
    axes[0].plot(true["carriage.v"][60:-60:5], force[60:-60:5], ".", ms=1.5, color="#b7c0c9")
    v = np.linspace(-model.SPEED, model.SPEED, 801)
    for name, color in list(COLORS.items())[1:]:
        law = total(fits[name], v, study.MIDDLE)
        axes[0].plot(v, law, color=color, lw=1.3, label=f"{name}, in the middle")
    axes[0].set(xlabel="speed [m/s]", ylabel="friction and offset [N]", ylim=(-70, 60))
    axes[0].legend(frameon=False, fontsize=7)
    laws = fits[PHYSICS].confidence().laws
    for ax, name, reach in zip(
        axes[1:], ("friction.net", "cable.net"), ((-0.13, 0.13), (0, 0.246)), strict=True
    ):
        band = laws[name]
        ax.plot(band.x, band.law, color=COLORS[PHYSICS], lw=1.3)
        ax.fill_between(
            band.x, band.law - band.sigma, band.law + band.sigma, color=COLORS[PHYSICS], alpha=0.25
        )
        for edge in reach:
            ax.axvline(edge, color="#7a8794", lw=0.8, ls="--")
    axes[1].set(xlabel="speed [m/s]", ylabel="network of the friction, at the mean position [N]")
    axes[2].set(xlabel="position [m]", ylabel="network of the spring [N]")
    return figure


def mass(fit: ac.Fit) -> float:
    """What a force at the carriage feels [kg]."""
    return float(fit.params["carriage.m"] + fit.params["motor.J"] * model.RATIO**2)


def total(fit: ac.Fit, v: np.ndarray, s: np.ndarray | float) -> np.ndarray:
    """The force that a steady speed takes [N]."""
    p = fit.params
    net = jax.jit(jax.vmap(p["friction.net"]))(v, np.broadcast_to(s, v.shape))
    dry = p["dry.Fc"] * np.tanh(v / p["dry.v_small"])
    pull = jax.jit(jax.vmap(p["cable.net"]))(np.broadcast_to(s, v.shape))
    return np.asarray(net + dry + pull - p["offset.f_constant"])


def drift(training: study.Measured, test: study.Measured, fits: Mapping[str, ac.Fit]) -> Figure:
    """Errors of position over time, and the mean of what is left of the force in each lap."""
    figure = Figure(figsize=(11, 6.2), layout="constrained")
    axes = figure.subplots(2, 2, sharex=True, sharey="row")
    for column, (name, record) in zip(
        axes.T, {"training": training, "test": test}.items(), strict=True
    ):
        ts = study.H * np.arange(len(record["qm"]))
        for kind, color in COLORS.items():
            system = KINDS[kind].build(model.Axis)
            s, _ = study.open_loop(system, fits[kind].params, record)
            column[0].plot(ts, 1e3 * (s - record["qm"]), color=color, lw=1.2, label=kind)
        column[0].set_title(f"{name} record")
        true = study.smooth(record)
        left = model.GAIN * true[model.INPUT] - mass(fits[OURS]) * true["carriage.a"]
        left = left - total(fits[OURS], true["carriage.v"], true["carriage.s"])
        moving = np.abs(true["carriage.v"]) > 5e-3
        laps = [slice(k, k + LAP) for k in range(0, len(ts), LAP)]
        for told, signed in (("constant", left), ("friction", left * np.sign(true["carriage.v"]))):
            means = [signed[lap][moving[lap]].mean() for lap in laps]
            column[1].plot([ts[lap].mean() for lap in laps], means, "o-", label=told)
        column[1].set_xlabel("time [s]")
    axes[0, 0].set_ylabel("error of position [mm]")
    axes[1, 0].set_ylabel("force beside the model [N]")
    for ax in axes[:, 0]:
        ax.legend(frameon=False, fontsize=8)
    return figure
