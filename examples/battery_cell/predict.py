"""Prediction of a record: the state at its start from its first voltage, then a simulation in steps of its own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

import acausal as ac
from examples.battery_cell.model import START, TARGETS
from examples.battery_cell.records import KELVIN, Table

LOWEST, HIGHEST, HALVINGS = -0.1, 1.2, 50
"""Between which states of charge a record may start, and how often the search halves them."""
LEAD = 2.0
"""A current in a first row that comes no later than this [s] has flowed since the clock's zero."""
STEP = 5.0
"""The longest step [s]."""


@dataclass(frozen=True, eq=False)
class Prediction:
    """What a model says about a record.

    Attributes:
        start: state of charge at which it starts.
        voltage: at the rows [V].
        case: temperature of the case at the rows [K].
        rms: of the voltage where it is measured after the first row [V]; NaN if it is nowhere.
        rms_case: of the temperature [K], likewise.
    """

    start: float
    voltage: Float[np.ndarray, " n"]
    case: Float[np.ndarray, " n"]
    rms: float
    rms_case: float


def predict(
    system: ac.System,
    params: Mapping[str, Any],
    table: Table,
    *,
    row: int = 0,
    given: Mapping[str, float] | None = None,
) -> Prediction:
    """Predict a record from one measured voltage, and the first temperature of the case if that is measured, too.

    Arguments:
        system, params: the trained model.
        table: the record.
        row: whose voltage says where the cell starts; a later one of the rest in which the record begins, say.
        given: parameters of this record, if they are known: then no voltage is used.
    """
    warmth = float(table.case[0] - table.ambient[0])
    own = {**params, **({"soc_start": 0.0, "warmth_start": warmth} if given is None else given)}
    start = table.guess() if given is not None else first_charge(system, own, table, row)
    data = table.data(start)
    grid = _fine(data.time)
    u = jnp.asarray([np.interp(grid, data.time, data[n]) for n in system.inputs]).T
    lead = 0.0 if given is not None else led(table)
    x0 = begin(system, own, u[0], lead)
    y = np.asarray(_follow(system, own, jnp.asarray(grid), u, x0))
    volts, case = (np.interp(table.time, grid, column) for column in y.T)
    errors = (volts - table.voltage)[1:]
    heat = np.interp(table.case_time, grid, y[:, 1]) - table.case
    return Prediction(start, volts, case, rms(errors), rms(heat))


def rms(errors: Float[np.ndarray, " n"]) -> float:
    """The root mean square of those that are known; NaN if none is."""
    known = errors[~np.isnan(errors)]
    return float(np.sqrt(np.mean(known**2))) if len(known) else float("nan")


def led(table: Table) -> float:
    """For how long a current has flowed at the first row [s]."""
    first = float(table.time[0])
    return first if table.current[0] != 0 and 0 < first <= LEAD else 0.0


def begin(
    system: ac.System, params: Mapping[str, Any], u: Float[Array, " n_inputs"], lead: float
) -> Float[Array, " n_states"]:
    """The state at the first row: the cell was at rest this long before."""
    x = system.initial_state(params, inputs=u)
    rate = system.vector_field(0.0, x, u, params)
    later = system.vector_field(lead, x + lead * rate, u, params)
    return x + lead / 2 * (rate + later)


def first_charge(system: ac.System, params: Mapping[str, Any], table: Table, row: int = 0) -> float:
    """The state of charge at which a cell at rest has the voltage of a row, just after its current has begun."""
    data = table.data(0.0)
    u = jnp.asarray([data[n][np.searchsorted(data.time, table.time[row])] for n in system.inputs])
    place, lead = system.inputs.index(START), led(table) if row == 0 else 0.0

    @jax.jit
    def volts(soc: Array) -> Array:
        at_start = u.at[place].set(soc)
        x = begin(system, params, at_start, lead)
        return system.observe(TARGETS[0], 0.0, x, at_start, params)

    low, high = LOWEST, HIGHEST
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (
            (middle, high) if volts(jnp.asarray(middle)) < table.voltage[row] else (low, middle)
        )
    return 0.5 * (low + high)


def _fine(times: Float[np.ndarray, " n"]) -> Float[np.ndarray, " m"]:
    """The times, and between them as many others as keep steps short."""
    counts = np.maximum(1, np.ceil(np.diff(times) / STEP - 1e-9)).astype(int)
    before = np.repeat(np.arange(len(counts)), counts)
    part = np.concatenate([np.arange(c) for c in counts]) / counts[before]
    return np.append(times[before] + part * np.diff(times)[before], times[-1])


@eqx.filter_jit
def _follow(
    system: ac.System,
    params: Mapping[str, Any],
    t: Float[Array, " n"],
    u: Float[Array, "n n_inputs"],
    x0: Float[Array, " n_states"],
) -> Float[Array, "n n_targets"]:
    """Voltage and temperature at the times, by Heun's method."""

    def step(x: Array, now: tuple[Array, ...]) -> tuple[Array, Array]:
        t, h, u, ahead = now
        rate, y = system.vector_field_and_observe(TARGETS, t, x, u, params)
        later = system.vector_field(t + h, x + h * rate, ahead, params)
        return x + h / 2 * (rate + later), y

    last, y = jax.lax.scan(step, x0, (t[:-1], jnp.diff(t), u[:-1], u[1:]))
    end = system.observe(TARGETS, t[-1], last, u[-1], params)
    return jnp.concatenate([y, end[None]])


def write(path: Any, table: Table, found: Prediction) -> None:
    """Write time, current, voltage as measured and predicted, and the temperature, as CSV."""
    columns = [table.time, table.current, table.voltage, found.voltage, found.case - KELVIN]
    header = "time [s],current [A],voltage [V],predicted voltage [V],predicted temperature [degC]"
    np.savetxt(path, np.stack(columns, axis=1), "%.6g", ",", header=header, comments="")
