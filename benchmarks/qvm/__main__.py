"""The command: every contestant on every task, a table, and one JSON line at the end."""

from __future__ import annotations

import json
import math
import os
import sys
from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from rich.console import Console
from rich.table import Table

import acausal as ac
from benchmarks.qvm import by_hand, c, framework, torch
from benchmarks.qvm.task import SAMPLES, Contestant, Gradient, Task, record, task
from benchmarks.race import Result, race
from examples.qvm.model import with_networks


class Shape(NamedTuple):
    """Sequences and their steps; ``ours``: names of the framework's ratios, and what is chosen for them."""

    title: str
    count: int
    length: int
    ours: dict[str, str]


SHAPES = {
    "full": Shape("1 x 42 s", 1, SAMPLES, {"full": "acausal", "full_f32": "float32"}),
    "batch": Shape("3 x 4 s", 3, 4_000, {"batch": "acausal", "batch_f32": "float32"}),
    "segments": Shape(
        "168 x 0.25 s",
        168,
        250,
        {"segments_one_core": "acausal", "segments_f64": "all cores", "segments_f32": "both"},
    ),
}
"""The whole ride, the paper's batch, short sequences side by side."""

OTHERS: dict[str, Contestant] = {
    "c": c.gradient,
    "handwritten_jax": by_hand.scan,
    "diffrax": by_hand.diffrax,
    "torchdiffeq": torch.gradient,
}
TITLES = {
    "acausal": "acausal",
    "float32": "acausal in float32",
    "all cores": "acausal on all cores",
    "both": "acausal in float32 on all cores",
    "c": "C, adjoint by hand, one core",
    "handwritten_jax": "JAX, a plain scan by hand",
    "diffrax": "diffrax, diffeqsolve",
    "torchdiffeq": "torchdiffeq",
}
LEFT_OUT = {("torchdiffeq", "full"): "not tried"}
"""By contestant and task. A graph of 42 000 steps, operation by operation, takes minutes and gigabytes."""

TOLERANCE = {np.dtype("float64"): 1e-8, np.dtype("float32"): 1e-2}
"""Of gradients, relative to the largest element, by precision."""


def main() -> None:
    """Measure, print the table and the JSON line."""
    cores = math.gcd(os.cpu_count() or 1, SHAPES["segments"].count)
    jax.config.update("jax_num_cpu_devices", cores)
    single, devices = {"dtype": jnp.float32}, {"devices": jax.devices()[:cores]}
    choices = {"acausal": {}, "float32": single, "all cores": devices, "both": single | devices}
    data, params = record(), ac.compile(with_networks()).parameters(0)
    cells: dict[str, dict[str, str]] = {title: {} for title in TITLES}
    ratios: dict[str, float] = {}
    cpu: dict[str, float] = {}
    for key, shape in SHAPES.items():
        asked = task(shape.title, data, params, shape.count, shape.length)
        ours = {
            name: framework.gradient(asked, **choices[choice])
            for name, choice in shape.ours.items()
        }
        expected = framework.gradient(asked)()
        others: dict[str, Callable[[], Gradient]] = {}
        for name, contestant in OTHERS.items():
            found = _prepared(name, key, contestant, asked)
            if isinstance(found, str):
                cells[name][key] = found
            else:
                others[name] = found
                _check(name, found(), expected, np.float64)
        for name, choice in shape.ours.items():
            kind = choices[choice].get("dtype", jnp.float64)
            _check(name, ours[name](), expected, kind)
            rivals = (
                others if kind == jnp.float64 else {n: r for n, r in others.items() if n == "c"}
            )
            raced = {rival: race(ours[name], run) for rival, run in rivals.items()}
            ratios |= {f"{name}_vs_{rival}": result.ratio for rival, result in raced.items()}
            cpu |= {f"{name}_vs_{rival}": result.cpu for rival, result in raced.items()}
            if "c" in raced:
                cells[choice][key] = _seconds(raced["c"])
        if "c" in others:
            for name, run in others.items():
                cells[name][key] = _seconds(race(run, others["c"]))
    _show(cells, cores)
    print(json.dumps({"ratio": _rounded(ratios), "cpu_ratio": _rounded(cpu)}))


def _prepared(
    name: str, key: str, contestant: Contestant, asked: Task
) -> Callable[[], Gradient] | str:
    if (name, key) in LEFT_OUT:
        return LEFT_OUT[name, key]
    try:
        return contestant(asked)
    except ImportError as e:
        return f"not installed ({e})"


def _check(title: str, one: Gradient, other: Gradient, kind: Any) -> None:
    (loss, by), (expected, by_expected) = one, other
    off = np.max(np.abs(by - by_expected)) / np.max(np.abs(by_expected))
    limit = TOLERANCE[np.dtype(kind)]
    if not (off < limit and abs(float(loss) / float(expected) - 1) < limit):
        sys.exit(f"{title}: its gradient differs by {off:.1e} from the framework's.")


def _seconds(result: Result) -> str:
    return f"{result.seconds * 1e3:.3g} ms = {result.ratio:.2f} x C ({result.cpu:.2f})"


def _show(cells: dict[str, dict[str, str]], cores: int) -> None:
    columns = [shape.title for shape in SHAPES.values()]
    table = Table(
        "one gradient", *columns, caption=f"{cores} cores; in brackets: of processor time"
    )
    for name, row in cells.items():
        table.add_row(TITLES[name], *(row.get(key, "") for key in SHAPES))
    Console().print(table)


def _rounded(ratios: dict[str, float]) -> dict[str, float]:
    return {name: round(value, 4) for name, value in ratios.items()}


if __name__ == "__main__":
    main()
