"""The study: drive the true vehicle, train the networks on it, write the vehicle as C, measure the C."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

import acausal as ac
from acausal.reporting import write_json
from examples.efmi_qvm.controller import Controller, compiler
from examples.efmi_qvm.model import DURATION, SAMPLE_TIME, Sweep, truth, with_networks
from examples.qvm.record import INPUT, OUTPUTS, STATES

SOLVERS = ("euler", "heun")
"""Methods of the controllers: the test case's, and the one that trains."""
OUT = Path("out/efmi_qvm")
SCALARISED, ONNX2C = 117.0, 5.5
"""Kilobytes of C that the authors report: with networks written number by number, and by onnx2c without weights."""
WIDE = 120
"""Columns of a table that is written to a file."""


def record(duration: float = DURATION) -> ac.Data:
    """The true vehicle on the sweep, sampled at 1 kHz."""
    system = ac.compile(Sweep(truth()))
    ts = SAMPLE_TIME * np.arange(round(duration / SAMPLE_TIME) + 1)
    run = ac.simulate(system, (0.0, ts[-1]), dt=SAMPLE_TIME / 2, saveat=ts, solver="rk4")
    signals = {name: run[f"vehicle.{name}"] for name in (INPUT, *STATES, *OUTPUTS)}
    return ac.Data(ts, {name: np.asarray(signal) for name, signal in signals.items()})


def train(data: ac.Data, *, epochs: tuple[int, int] = (300, 100), seed: int = 0) -> ac.Fit:
    """Train both networks."""
    return ac.fit(
        ac.compile(with_networks()),
        data,
        OUTPUTS,
        seed=seed,
        strategy=("equation_error", "whole_record"),
        epochs=epochs,
        x0=dict.fromkeys(STATES, 0.0),
    )


def errors(found: np.ndarray, data: ac.Data) -> dict[str, float]:
    """Root mean square errors over standard deviations, by output; ``found`` has shape (M, 2)."""
    return {
        name: float(np.sqrt(np.mean((found[:, k] - data[name]) ** 2)) / data[name].std())
        for k, name in enumerate(OUTPUTS)
    }


def ship(fit: ac.Fit, data: ac.Data, solver: str, out: Path, command: str | None) -> dict[str, Any]:
    """Write the vehicle as C that takes steps of a method; returns sizes and, where it can run, errors."""
    files = ac.export.c(
        fit.system, out / solver, fit.params, name="vehicle", outputs=OUTPUTS, solver=solver,
        derivatives=False,
    )  # fmt: skip
    controller = Controller(*files, command)
    report: dict[str, Any] = controller.sizes()
    if command is None:
        return report
    found = controller.drive(data[INPUT], SAMPLE_TIME)
    simulated = ac.simulate(
        fit.system, (0.0, data.time[-1]), dt=SAMPLE_TIME, solver=solver, params=fit.params,
        inputs=data, x0=dict.fromkeys(STATES, 0.0),
    )  # fmt: skip
    expected = np.stack([simulated[name] for name in OUTPUTS], axis=1)
    off = float(np.abs(found - expected).max() / np.abs(expected).max())
    spent = controller.microseconds(data[INPUT], SAMPLE_TIME)
    return {**report, "microseconds": spent, "errors": errors(found, data), "off": off}


def run(seed: int = 0, out: Path = OUT) -> dict[str, Any]:
    """The whole study; prints a table and returns its figures."""
    started = time.time()
    data = record()
    fit = train(data, seed=seed)
    command = compiler()
    shipped = {solver: ship(fit, data, solver, out, command) for solver in SOLVERS}
    show(shipped)
    report = {
        **shipped,
        "seed": seed,
        "training_seconds": fit.seconds,
        "seconds": time.time() - started,
    }
    write_json(out / "report.json", report)
    return report


KILOBYTES = {
    "source": "C of the vehicle with its networks",
    "source_without_values": "... without values of parameters",
    "source_of_steps": "... without names and units: equations and steps",
    "machine_code": "machine code of all, gcc -Os",
    "memory": "memory of a vehicle, parameters included",
}


def show(shipped: Mapping[str, Mapping[str, Any]]) -> None:
    """Print the table."""
    names = {"euler": "explicit Euler", "heun": "Heun"}
    table = Table("M11_NeuralQVM", *(names[s] for s in shipped), "authors")

    def row(title: str, cell: Callable[[Mapping[str, Any]], str], theirs: str = "") -> None:
        table.add_row(title, *(cell(report) for report in shipped.values()), theirs)

    for key, title in KILOBYTES.items():
        if key in shipped[SOLVERS[0]]:
            theirs = f"{SCALARISED:g} KB" if key == "source" else ""
            row(title, lambda r, key=key: f"{r[key] / 1e3:.1f} KB", theirs)
    row("C of the networks alone, by onnx2c, without weights", lambda r: "", f"{ONNX2C:g} KB")
    row("parameters, weights included", lambda r: f"{r['parameters']}")
    if "errors" in shipped[SOLVERS[0]]:
        row("one step of 1 ms and its outputs", lambda r: f"{r['microseconds']:.2f} µs")
        for name in OUTPUTS:
            title = f"error of {name} over 60 s, in its standard deviations"
            row(title, lambda r, name=name: f"{r['errors'][name]:.3f}")
        row("difference to ac.simulate, relative", lambda r: f"{r['off']:.0e}")
    Console(width=None if sys.stdout.isatty() else WIDE).print(table)
