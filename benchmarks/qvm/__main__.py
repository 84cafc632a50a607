"""The command: every contestant on every task, a table, and one JSON line at the end."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable

import numpy as np
from rich.console import Console
from rich.table import Table

import acausal as ac
from benchmarks.qvm import by_hand, c, framework, torch
from benchmarks.qvm.task import Contestant, Gradient, Task, record, task
from benchmarks.race import Result, race
from examples.qvm.model import with_networks

SHAPES = {
    "full": ("1 x 42 s", 1, 42_000),
    "batch": ("3 x 4 s", 3, 4_000),
    "segments_f64": ("168 x 0.25 s", 168, 250),
}
"""Title, sequences and steps of each task: the whole ride, the paper's batch, short sequences side by side."""

OTHERS: dict[str, Contestant] = {
    "c": c.gradient,
    "handwritten_jax": by_hand.scan,
    "diffrax": by_hand.diffrax,
    "torchdiffeq": torch.gradient,
}
TITLES = {
    "framework": "acausal",
    "c": "C, adjoint by hand, one core",
    "handwritten_jax": "JAX, a plain scan by hand",
    "diffrax": "diffrax, diffeqsolve",
    "torchdiffeq": "torchdiffeq",
}
LEFT_OUT = {("torchdiffeq", "full"): "not tried"}
"""By contestant and task. A graph of 42 000 steps, operation by operation, takes minutes and gigabytes."""

TOLERANCE = 1e-8
"""Of gradients, relative to the largest element."""


def main() -> None:
    """Measure, print the table and the JSON line."""
    data, params = record(), ac.compile(with_networks()).parameters(0)
    table = Table("one gradient", *(title for title, _, _ in SHAPES.values()))
    cells: dict[str, list[str]] = {name: [] for name in TITLES}
    ratios: dict[str, float] = {}
    for key, (title, count, length) in SHAPES.items():
        found = measured(key, task(title, data, params, count, length))
        for name, (told, ratio) in found.items():
            cells[name].append(told)
            if ratio is not None:
                ratios[f"{key}_vs_{name}"] = ratio
    for name, row in cells.items():
        table.add_row(TITLES[name], *row)
    Console().print(table)
    print(json.dumps({"ratio": {name: round(value, 4) for name, value in ratios.items()}}))


def measured(key: str, which: Task) -> dict[str, tuple[str, float | None]]:
    """By contestant: what to tell, and the framework's time over its time."""
    ours = framework.gradient(which)
    expected = ours()
    runs = {name: _prepared(name, key, contestant, which) for name, contestant in OTHERS.items()}
    reference = runs["c"] if callable(runs["c"]) else ours
    found = {"framework": (_told(race(ours, reference)), None)}
    for name, run in runs.items():
        if isinstance(run, str):
            found[name] = (run, None)
            continue
        _check(TITLES[name], run(), expected)
        found[name] = (_told(race(run, reference)), race(ours, run).ratio)
    return found


def _prepared(
    name: str, key: str, contestant: Contestant, which: Task
) -> Callable[[], Gradient] | str:
    if (name, key) in LEFT_OUT:
        return LEFT_OUT[name, key]
    try:
        return contestant(which)
    except ImportError as e:
        return f"not installed ({e})"


def _check(title: str, one: Gradient, other: Gradient) -> None:
    (loss, by), (expected, by_expected) = one, other
    off = np.max(np.abs(by - by_expected)) / np.max(np.abs(by_expected))
    if not (off < TOLERANCE and abs(float(loss) / float(expected) - 1) < TOLERANCE):
        sys.exit(f"{title}: its gradient differs by {off:.1e} from the framework's.")


def _told(result: Result) -> str:
    return f"{result.seconds:.3g} s = {result.ratio:.2f} x C ({result.rounds})"


if __name__ == "__main__":
    main()
