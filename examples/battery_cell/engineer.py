"""The learned laws as an engineer would use them: tables over charge and temperature, and the parameters."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jax import Array
from rich.console import Console
from rich.table import Table

from acausal.components import nature
from examples.battery_cell.records import KELVIN

CHARGES = np.array([0.0, 0.02, 0.05, *np.arange(0.1, 1.01, 0.1)])
DEGREES = (10.0, 25.0, 40.0)
T_REF = 298.15


def laws(params: Mapping[str, Any], charges: np.ndarray = CHARGES) -> dict[str, np.ndarray]:
    """Columns over the state of charge: voltages, entropy, and what depends on temperature at each of `DEGREES`."""
    soc = jnp.asarray(charges)
    curve = params["ocv.U_nominal"] + jax.vmap(params["ocv.net"])(soc)
    entropy = jax.vmap(params["ocv.entropy"])(soc)
    columns = {"soc": charges, "U [V]": curve, "dU/dT [mV/K]": 1e3 * entropy}
    for degrees in DEGREES:
        warmth = T_REF / (degrees + KELVIN) - 1
        series = params["resistance.R"] * _factor(
            params, "resistance", "resistance.net", soc, warmth
        )
        current = params["transfer.I_0"] / _arrhenius(params, "transfer", warmth)
        small = nature.R * (degrees + KELVIN) / nature.F / current
        slow = sum(
            params[f"{name}.R"] * _arrhenius(params, name, warmth)
            for name in ("relaxation", "fast")
        )
        tau = params["particle.tau"] * _factor(
            params, "particle", "particle.diffusion[1].net", soc, warmth
        )
        columns[f"R {degrees:g} degC [mOhm]"] = 1e3 * (series + small + slow)
        columns[f"tau {degrees:g} degC [s]"] = tau
    return {name: np.asarray(column) for name, column in columns.items()}


def _arrhenius(params: Mapping[str, Any], element: str, warmth: float) -> Any:
    return np.exp(params[f"{element}.E_a"] / (nature.R * T_REF) * warmth)


def _factor(params: Mapping[str, Any], element: str, net: str, soc: Array, warmth: float) -> Any:
    learned = jax.vmap(lambda q: params[net](q, warmth))(soc)
    return _arrhenius(params, element, warmth) * np.exp(learned)


def formula(params: Mapping[str, Any]) -> list[str]:
    """The formulas with their trained numbers."""
    net = params["ocv.net"]
    heights, steepness, places, slope, offset = net.terms
    steps = [
        f"{float(a):.4g} tanh({float(k):.4g} (soc {-float(c):+.4g}))"
        for a, k, c in zip(heights, steepness, places, strict=True)
    ]
    offset, slope = float(params["ocv.U_nominal"] + offset), float(slope)
    p = {n: float(v) for n, v in params.items() if not callable(v)}
    return [
        f"U(soc) = {offset:.4g} + {slope:.4g} soc + {' + '.join(steps)}  [V, 25 degC]",
        f"capacity {p['particle.Q'] / 3600:.2f} Ah, overhang {p['overhang.Q'] / 3600:.2f} Ah",
        f"charge transfer: 2 R T/F asinh(i/(2 I)) with I = {p['transfer.I_0']:.3g} A at 25 degC",
        f"relaxation: {1e3 * p['relaxation.R']:.3g} mOhm, {p['relaxation.tau']:.3g} s",
        f"fast relaxation: {1e3 * p['fast.R']:.3g} mOhm, {p['fast.tau']:.3g} s",
        f"heat: {p['core.C'] + p['case.C']:.3g} J/K, to the chamber {p['convection.G']:.3g} W/K",
    ]


def show(params: Mapping[str, Any]) -> None:
    """Print formulas and tables."""
    console = Console(width=160)
    for line in formula(params):
        console.print(line, highlight=False, soft_wrap=True)
    columns = laws(params)
    table = Table(*columns)
    for row in zip(*columns.values(), strict=True):
        table.add_row(*(f"{value:.4g}" for value in row))
    console.print(table)


def write(params: Mapping[str, Any], path: Path) -> None:
    """Write the table as CSV."""
    columns = laws(params)
    values = np.stack(list(columns.values()), axis=1)
    np.savetxt(path, values, "%.6g", ",", header=",".join(columns), comments="")
