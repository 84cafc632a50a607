"""``python -m examples.qvm.ship``: train the quarter vehicle, ship it in all forms, and run them in others' tools.

``out/ship`` then holds the files, a model card beside each, and the table as ``report.json``.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

import acausal as ac
from acausal.reporting import write_json
from examples.qvm.elsewhere import (
    END,
    POINTS,
    SHOWN,
    TOOLS,
    MissingError,
    Row,
    Vehicle,
    need,
    need_compiler,
)
from examples.qvm.experiments import DEMO, fit
from examples.qvm.judge import loss
from examples.qvm.model import linear
from examples.qvm.record import INPUT, SAMPLE_TIME, ride

OUT = Path("out/ship")
NOISE = 0.02
RISES = (0.1, 2.0)
"""Speeds [m/s] at which the road rises, to show the flag: within the training, and far beyond."""
FLAG = "outside_training_range"

CAPTION = (
    f"Time: of one evaluation of the rates, or of a step. Difference: of rates at {POINTS} points, of the Jacobian at "
    f"one, or of a simulation of {END:g} s; relative to the largest value of acausal. All but C are called from Python."
)

FORMS: dict[str, dict[str, Any]] = {
    ".fmu": {"outputs": SHOWN, "step": SAMPLE_TIME},
    "_fmi2.fmu": {"outputs": SHOWN, "step": SAMPLE_TIME, "fmi": "2.0"},
    ".c": {"outputs": SHOWN},
    ".onnx": {"outputs": SHOWN},
    ".jax": {"outputs": SHOWN},
    ".mo": {"selfcontained": True},
}
"""Ends of the files' names, and options of their exports."""


def run(seed: int = 0, out: Path = OUT) -> dict[str, Any]:
    """Train, export, run elsewhere; returns the report."""
    console = Console()
    with console.status("driving the true vehicle over a rough road"):
        data = ride(NOISE)
        base = ac.compile(linear())
        notes = {"loss of the linear model": loss(base, base.parameters(), data.measured, data)}
    trained = fit(DEMO, data, seed=seed)
    console.print(trained)
    with console.status("asking how sure the laws are"):
        sure = trained.confidence()
    missing = export_all(console, trained, out, confidence=sure, notes=notes)
    vehicle = Vehicle(trained.system, trained.params, out)
    rows, more = run_all(console, vehicle)
    missing += more
    console.print(table(rows))
    sentences = [*missing, *flag(vehicle)]
    for sentence in sentences:
        console.print(sentence, soft_wrap=True)
    report = {"loss": trained.loss, **notes, "rows": list(map(asdict, rows)), "notes": sentences}
    write_json(out / "report.json", report)
    console.print(f"\n{out} holds the files, with a model card beside each.")
    return report


def export_all(console: Console, trained: ac.Fit, out: Path, **card: Any) -> list[str]:
    """Write all forms; gives sentences on those that could not be written. ``card``: of `Fit.export`."""
    out.mkdir(parents=True, exist_ok=True)
    missing: list[str] = []
    for ending, options in FORMS.items():
        path = out / f"vehicle{ending}"
        with console.status(f"writing {path}"):
            begin = time.perf_counter()
            try:
                trained.export(path, **card, **options)
            except ac.AcausalError as error:
                missing.append(str(error))
                path.unlink(missing_ok=True)  # that of an earlier run
                continue
            console.print(f"{path}, in {time.perf_counter() - begin:.1f} s", highlight=False)
    return missing


def run_all(console: Console, vehicle: Vehicle) -> tuple[list[Row], list[str]]:
    """The table's rows, and sentences on tools that are missing."""
    rows: list[Row] = []
    missing: list[str] = []
    for doing, tool in TOOLS.items():
        with console.status(doing):
            try:
                rows += tool(vehicle)
            except MissingError as error:
                missing.append(f"Left out, {doing}: {error}")
            except FileNotFoundError as error:
                missing.append(f"Left out, {doing}: there is no '{error.filename}'.")
    return rows, missing


def table(rows: Sequence[Row]) -> Table:
    """Form, size, time of one evaluation, difference to acausal; see `CAPTION`."""
    shown = Table("form", "compared", caption=CAPTION, caption_justify="left")
    for title in ("size", "time", "difference"):
        shown.add_column(title, justify="right", no_wrap=True)
    for row in rows:
        size = "" if row.size is None else f"{row.size / 1e3:.1f} kB"
        seconds = "" if row.seconds is None else f"{1e6 * row.seconds:.2f} µs"
        shown.add_row(row.form, row.of, size, seconds, f"{row.difference:.1e}")
    return shown


def flag(vehicle: Vehicle) -> list[str]:
    """When the FMU says that a network is outside of what it was trained for, in sentences."""
    try:
        need_compiler()
        fmpy = need("fmpy")
    except MissingError:
        return []
    sentences: list[str] = []
    for rise in RISES:
        result = fmpy.simulate_fmu(
            str(vehicle.path(".fmu")), fmi_type="CoSimulation", stop_time=END, output_interval=1e-3,
            start_values={INPUT: rise}, output=[FLAG],
        )  # fmt: skip
        on = float(np.mean(result[FLAG] != 0))
        told = f"is on for {100 * on:.0f} % of the time" if on else "stays off"
        sentences.append(f"While the road rises at {rise:g} m/s, {FLAG} {told}.")
    return sentences


def main() -> None:
    """Parse the command line and run."""
    parser = argparse.ArgumentParser(prog="python -m examples.qvm.ship", description=__doc__)
    parser.add_argument("--seed", type=int, default=0, help="of the training")
    run(parser.parse_args().seed)


if __name__ == "__main__":
    main()
