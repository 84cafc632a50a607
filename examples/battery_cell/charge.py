"""The state of charge of a cell from its current and voltage, found by a filter from a wrong start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Literal

import numpy as np
from jaxtyping import Float

import acausal as ac
from examples.battery_cell.model import VOLTAGE
from examples.battery_cell.predict import first_charge
from examples.battery_cell.records import Table

SHELLS = ("particle.shell[1].soc", "particle.shell[2].soc")
UNSURE = dict.fromkeys((*SHELLS, "overhang.soc"), 0.3)
"""How far the states of charge may be from where they are believed to be at the start."""

WALK = dict.fromkeys(SHELLS, 2e-5) | {"relaxation.v": 3e-4, "fast.v": 3e-4}
"""Random walks after a second, of what the model does not follow exactly [1, V]."""

NOISE = 0.01
"""Of the voltage, with the model's own errors [V]."""


def part(table: Table, begin: float, end: float) -> Table:
    """The rows of a record between two times [s], and no temperatures of the case."""
    rows = (table.time >= begin) & (table.time <= end)
    names = ("time", "current", "voltage", "ambient")
    own = {name: getattr(table, name)[rows] for name in names}
    return replace(table, **own, case_time=own["time"][:2], case=own["ambient"][:2])


def estimate(
    system: ac.System,
    params: Mapping[str, Any],
    table: Table,
    soc: float,
    method: Literal["ekf", "ukf", "mhe"] = "ukf",
) -> ac.Estimation:
    """Estimates over a record that begins at rest, at a state of charge that is believed to be ``soc``."""
    return ac.estimate(
        system,
        table.data(soc),
        method,
        params=params,
        sensors={VOLTAGE: NOISE},
        states={**UNSURE, "relaxation.v": 1e-3, "fast.v": 1e-3, "core.T": 0.5, "case.T": 0.5},
        noise=WALK,
    )


def counted(system: ac.System, params: Mapping[str, Any], table: Table) -> Float[np.ndarray, " n"]:
    """The state of charge at the rows by counting, from the one at which a cell at rest has the first voltage."""
    own = {**params, "soc_start": 0.0, "warmth_start": 0.0}
    data = table.data(0.0)
    passed = np.diff(data.time) * (data["source.i"][1:] + data["source.i"][:-1]) / 2
    charge = np.append(0.0, np.cumsum(passed)) / float(params["particle.Q"])
    return first_charge(system, own, table) + charge
