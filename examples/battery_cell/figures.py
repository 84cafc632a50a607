"""The page of the cell: errors, learned laws, what was measured and predicted."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from matplotlib.figure import Figure

import acausal as ac
from examples.battery_cell import engineer
from examples.battery_cell.model import Cell
from examples.battery_cell.predict import Prediction, predict
from examples.battery_cell.records import Table
from examples.measured.present import Row, opening

COLUMNS = {
    "trained": "trained [mV]",
    "first": "first voltage [mV]",
    "rest": "end of the rest [mV]",
    "case": "temperature [K]",
}
MEASURED, PREDICTED = "#1d2733", "#1f5c99"
WARMTH = dict(zip(engineer.DEGREES, ("#1f5c99", "#2e7d43", "#d9822b"), strict=True))
HOUR = 3600.0


def rows(errors: Mapping[str, Mapping[str, float]]) -> list[Row]:
    """Errors by record, as rows of a table."""
    return [Row(name, row) for name, row in errors.items()]


def page(
    folder: Path,
    fit: ac.Fit,
    tables: Mapping[str, Table],
    errors: Mapping[str, Mapping[str, float]],
) -> Path:
    """Write the page, and return where it is."""
    shown = opening(
        "A battery cell",
        "One cell of a 2013 Nissan Leaf, measured at Oak Ridge National Laboratory.",
        Cell(),
        fit.system.equations,
        ("root mean square errors", COLUMNS, rows(errors)),
    )
    shown.section("The learned laws")
    shown.figure(
        laws(fit.params),
        "Voltage and entropy of the open circuit, the resistance to small currents and the time of the diffusion, over "
        "the state of charge at the surface of the particles.",
    )
    for line in engineer.formula(fit.params):
        shown.text(line)
    shown.section("The records")
    for name, table in tables.items():
        found = predict(fit.system, fit.params, table, given=fit.records[name].parameters)
        shown.figure(record(table, found), f"{name}: simulated from where the training found it.")
    path = folder / "index.html"
    shown.write(path)
    return path


def record(table: Table, found: Prediction) -> Figure:
    """What was measured and predicted, and the errors; the temperature of the case where it is measured."""
    heat = table.measures_the_case
    figure = Figure(figsize=(11, 5 + 2 * heat), layout="constrained")
    axes = figure.subplots(2 + heat, 1, sharex=True)
    hours = table.time / HOUR
    axes[0].plot(hours, table.voltage, MEASURED, lw=2.2, alpha=0.4, label="measured")
    axes[0].plot(hours, found.voltage, PREDICTED, lw=1.0, label="predicted")
    axes[0].set_ylabel("voltage [V]")
    axes[0].legend(frameon=False, fontsize=8)
    axes[1].plot(hours, 1e3 * (found.voltage - table.voltage), PREDICTED, lw=0.8)
    axes[1].set_ylabel("error [mV]")
    axes[1].grid(alpha=0.25)
    if heat:
        axes[2].plot(table.case_time / HOUR, table.case - 273.15, MEASURED, lw=2.2, alpha=0.4)
        axes[2].plot(hours, found.case - 273.15, PREDICTED, lw=1.0)
        axes[2].set_ylabel("case [degC]")
    axes[-1].set_xlabel("time [h]")
    return figure


def laws(params: Mapping[str, Any]) -> Figure:
    """The learned laws over charge, and over temperature at `engineer.DEGREES`."""
    figure = Figure(figsize=(11, 7), layout="constrained")
    axes = figure.subplots(2, 2, sharex=True)
    soc = np.linspace(0.0, 1.0, 201)
    curve = float(params["ocv.U_nominal"]) + jax.vmap(params["ocv.net"])(jnp.asarray(soc))
    entropy = jax.vmap(params["ocv.entropy"])(jnp.asarray(soc))
    axes[0, 0].plot(soc, curve, MEASURED)
    axes[0, 0].set_ylabel("open-circuit voltage [V]")
    axes[0, 1].plot(soc, 1e3 * entropy, MEASURED)
    axes[0, 1].set_ylabel("its derivative by temperature [mV/K]")
    columns = engineer.laws(params, soc)
    for degrees, color in WARMTH.items():
        label = f"{degrees:g} degC"
        axes[1, 0].plot(soc, columns[f"R {degrees:g} degC [mOhm]"], color, label=label)
        axes[1, 1].plot(soc, columns[f"tau {degrees:g} degC [s]"], color, label=label)
    axes[1, 0].set(xlabel="state of charge", ylabel="resistance [mOhm]")
    axes[1, 1].set(xlabel="state of charge", ylabel="time of diffusion [s]", yscale="log")
    axes[1, 0].legend(frameon=False)
    return figure
