"""The study: train on several records at once, leave each out in turn, and judge by every row as measured."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable, Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jax import Array

import acausal as ac
from examples.battery_cell.model import NETS, TARGETS, build
from examples.battery_cell.predict import predict
from examples.battery_cell.records import Table

ENERGY = 8e3
"""How far activation energies are likely to be from where they start [J/mol]."""
FACTOR = 0.7
"""How far the logarithms of positive parameters are, but for the capacity: 0.02."""
WEIGHT = 2.0
"""How far the networks' weights are."""
PRIOR = 3e-3
"""How much all that counts."""
POSITIVE = dict.fromkeys(
    (
        *("particle.tau", "overhang.Q", "creep.tau", "transfer.I_0", "resistance.R"),
        *(
            "relaxation.R",
            "relaxation.tau",
            "fast.R",
            "fast.tau",
            "core.C",
            "case.C",
            "conduction.G",
            "convection.G",
        ),
    ),
    FACTOR,
) | {"particle.Q": 0.02}
ENERGIES = tuple(
    f"{name}.E_a" for name in ("particle", "creep", "transfer", "resistance", "relaxation", "fast")
)
STEP, EPOCHS = 15.0, 24
"""The longest step of the integration in training [s]; updates."""
MODIFIERS: dict[str, Any] = {
    **dict.fromkeys(POSITIVE, ac.Bounded(0, math.inf)),
    **dict.fromkeys(ENERGIES, ac.Shift(ENERGY)),
    "fast.tau": ac.Bounded(STEP / 2, 10 * STEP),  # longer than what the steps are stable for
    "particle.Q": ac.Shift(0.02 * 31 * 3600),
    "overhang_start": ac.Shift(0.2),
}
PER_RECORD = {"soc_start": 0.03, "warmth_start": 1.0}
"""What differs between records: the start, by how much [1, K]."""
ERRORS = np.array([8e-3, 0.8])
"""Errors of voltage and temperature that count the same [V, K]."""


def loss(predicted: Array, measured: Array, sigma: Array, weight: Array) -> Array:
    """Root mean square of the errors in units of `ERRORS`."""
    squares = weight * ((predicted - measured) / ERRORS) ** 2
    total = jnp.sum(weight, axis=0)
    mean = jnp.sum(squares, axis=0) / jnp.where(total > 0, total, 1.0)
    return jnp.sqrt(jnp.sum(mean) + 1e-12)


def prior(start: Mapping[str, Any]) -> Callable[[Mapping[str, Any], Any], Array]:
    """What is known before: parameters and weights stay near where they start, unless records say otherwise."""

    def penalty(params: Mapping[str, Any], context: Any) -> Array:
        total = jnp.zeros(())
        for name, deviation in POSITIVE.items():
            total += (jnp.log(params[name] / start[name]) / deviation) ** 2
        for name in ENERGIES:
            total += ((params[name] - start[name]) / ENERGY) ** 2
        for name in NETS:
            now, then = (jax.tree.leaves(p[name]) for p in (params, start))
            squares = [jnp.sum((a - b) ** 2) for a, b in zip(now, then, strict=True)]
            total += sum(squares) / WEIGHT**2
        return PRIOR * total

    return penalty


def train(
    tables: Mapping[str, Table], seed: int = 0, epochs: int = EPOCHS, **options: Any
) -> ac.Fit:
    """Train on some records at once; the seed is that of the networks."""
    system = build()
    start = system.parameters(seed)
    chosen: dict[str, Any] = {
        "train": NETS,
        "modifiers": MODIFIERS,
        "per_record": PER_RECORD,
        "loss": loss,
        "regularizers": prior(start),
        "strategy": "gauss_newton",
        "epochs": epochs,
        "dt": STEP,
        "x0": "model",
        "progress": False,
        **options,
    }
    data = {name: table.few().data() for name, table in tables.items()}
    return ac.fit(system, data, TARGETS, params=start, seed=seed, **chosen)


def judge(fit: ac.Fit, tables: Mapping[str, Table]) -> dict[str, dict[str, float]]:
    """Errors over all rows as measured, in mV and K, by record.

    ``trained`` starts where the training found that its records start. ``first`` starts at rest at the first
    voltage; ``rest`` at the last voltage of the rest with which the record begins, if it does.
    """
    found: dict[str, dict[str, float]] = {}
    for name, table in tables.items():
        at_first = predict(fit.system, fit.params, table)
        at_rest = predict(fit.system, fit.params, table, row=table.first_rest)
        errors = {"first": 1e3 * at_first.rms, "rest": 1e3 * at_rest.rms}
        heat = at_rest.rms_case
        if name in fit.records:
            own = fit.records[name].parameters
            known = predict(fit.system, fit.params, table, given=own)
            errors["trained"], heat = 1e3 * known.rms, known.rms_case
        if table.measures_the_case:
            errors["case"] = heat
        found[name] = errors
    return found


def leave_one_out(
    tables: Mapping[str, Table], seeds: Sequence[int], path: Path, epochs: int = EPOCHS
) -> list[dict[str, Any]]:
    """Train with all records, and with each left out in turn, from each seed.

    Every training adds a line of JSON to a file as soon as it is judged. What stands there already is not trained
    again, so that the table may be interrupted and goes on with the same command.

    Arguments:
        tables: the records.
        seeds: of the networks.
        path: of the file with the lines.
        epochs: updates of each training.

    Raises:
        DataError: if the file holds something else.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = lines_of(path)
    for seed, out in product(seeds, (None, *tables)):
        if any(
            (line["seed"], line["out"], line["epochs"]) == (seed, out, epochs) for line in lines
        ):
            continue
        kept = {name: table for name, table in tables.items() if name != out}
        begun, busy = time.time(), time.process_time()
        fit = train(kept, seed, epochs)
        took = {"seconds": time.time() - begun, "processor_seconds": time.process_time() - busy}
        about = {"seed": seed, "out": out, "epochs": epochs}
        lines.append({**about, **took, "errors": judge(fit, tables)})
        text = json.dumps(lines[-1])
        print(text, flush=True)
        with path.open("a", encoding="utf-8") as file:
            file.write(text + "\n")
        jax.clear_caches()  # each training has programs of its own, and a process room for some eight of them
    return [line for line in lines if line["seed"] in seeds and line["epochs"] == epochs]


def lines_of(path: Path) -> list[dict[str, Any]]:
    """The trainings that a file tells of; none if there is no file.

    Raises:
        DataError: for a file with other lines.
    """
    if not path.is_file():
        return []
    try:
        lines = [json.loads(text) for text in path.read_text(encoding="utf-8").splitlines()]
        if all({"seed", "out", "epochs", "seconds", "errors"} <= set(line) for line in lines):
            return lines
    except (ValueError, TypeError):
        pass
    raise ac.DataError(
        f"{path} holds no results of --leave-one-out: move it, or choose another --out."
    )


def summary(lines: Sequence[Mapping[str, Any]]) -> dict[str, dict[str, tuple[float, float, int]]]:
    """By record, mean, standard deviation over seeds, and their number: trained with all, and left out."""
    table: dict[str, dict[str, tuple[float, float, int]]] = {}
    kinds = ("trained", "first", "rest", "case"), ("first", "rest", "case")
    for name in lines[0]["errors"]:
        row: dict[str, tuple[float, float, int]] = {}
        for out, some in zip((None, name), kinds, strict=True):
            errors = [line["errors"][name] for line in lines if line["out"] == out]
            for kind in (k for k in some if errors and all(k in e for e in errors)):
                values = [e[kind] for e in errors]
                deviation = float(np.std(values, ddof=1)) if len(values) > 1 else 0.0
                title = kind if out is None else f"left out, {kind}"
                row[title] = float(np.mean(values)), deviation, len(values)
        table[name] = row
    return table


def save(fit: ac.Fit, path: Path) -> None:
    """Save the trained parameters; records to come start at rest, in the chamber's temperature."""
    path.parent.mkdir(parents=True, exist_ok=True)
    ac.save_params({**fit.params, "soc_start": 0.0, "warmth_start": 0.0}, path)
