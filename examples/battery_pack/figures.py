"""The drive in one picture: currents, charges and temperatures of all cells."""

from __future__ import annotations

import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure

from acausal.reporting import LEARNED, TRUTH
from examples.battery_pack.cycle import speed
from examples.battery_pack.study import Study, places


def picture(found: Study) -> Figure:
    """Speed and voltage; the currents of a row's cells; charge and temperature of all cells."""
    driven, sol = found.drive, found.sol
    minutes, x = driven.t / 60, np.asarray(sol.x)
    figure = Figure(figsize=(11, 6), layout="constrained")
    axes = figure.subplots(2, 2, sharex=True)
    (top, currents), (charges, heats) = axes
    t, v = speed()
    known = t <= driven.t[-1]
    top.fill_between(t[known] / 60, 3.6 * v[known], color=TRUTH, alpha=0.15, lw=0)
    top.set(ylabel="speed [km/h]")
    voltage = top.twinx()
    voltage.plot(minutes, sol["voltmeter.v"], color=LEARNED[0], lw=1)
    voltage.set(ylabel="voltage of the pack [V]")
    shades = colormaps["viridis"](np.linspace(0, 0.9, driven.cells))
    for k, shade in enumerate(shades, 1):
        currents.plot(
            minutes, -np.asarray(sol[f"rows[1].cells[{k}].resistance.i"]), color=shade, lw=0.7
        )
    currents.set(ylabel="current of the cells of one row [A]")
    for ax, state, label, shift in (
        (charges, "charge.soc", "state of charge", 0.0),
        (heats, "body.T", "temperature [°C]", 273.15),
    ):
        cells = x[:, places(driven, state)] - shift
        for part, alpha in ((0, 0.25), (10, 0.35), (25, 0.5)):
            low, high = np.percentile(cells, (part, 100 - part), axis=1)
            ax.fill_between(minutes, low, high, color=LEARNED[0], alpha=alpha, lw=0)
        ax.set(ylabel=f"{label} of all cells", xlabel="time [min]")
    for ax in axes.flat:
        ax.grid(alpha=0.25)
        ax.margins(x=0)
    return figure
