"""The command line of a benchmark: every size in processes of its own, a table, and one JSON line at the end."""

from __future__ import annotations

import argparse
import json
import math
import os
import subprocess
import sys
from typing import Any

from rich.console import Console
from rich.table import Table

from benchmarks import measure
from benchmarks.case import Case

ROWS = {
    "unknowns": "unknowns",
    "states": "states",
    "declare_seconds": "declare [s]",
    "flatten_seconds": "flatten [s]",
    "reduce_seconds": "reduce [s]",
    "derive_seconds": "derive [s]",
    "generate_seconds": "generate [s]",
    "xla_rhs_seconds": "XLA, right-hand side [s]",
    "xla_gradient_seconds": "XLA, gradient [s]",
    "total_seconds": "total [s]",
    "processor_seconds": "... of processor time [s]",
    "memory_gb": "peak memory [GB]",
    "hlo_rhs": "HLO instructions, right-hand side",
    "hlo_gradient": "HLO instructions, gradient",
    "sympy_calls": "calls into sympy",
    "calls": "calls of functions of acausal",
    "rhs_seconds": "one right-hand side [s]",
    "by_hand_seconds": "... by hand [s]",
    "rhs_ratio": "... ratio",
    "rhs_error": "... relative difference",
}


def main(case: Case) -> None:
    """Parse the command line and measure."""
    parser = argparse.ArgumentParser(description=f"Compile a {case.title}.")
    parser.add_argument("--n", type=int, nargs="+", default=case.sizes, metavar="N", help="sizes")
    parser.add_argument("--one", choices=PARTS, help="measure only this, and print it as JSON")
    arguments = parser.parse_args()
    if arguments.one:
        print(json.dumps(PARTS[arguments.one](case, *arguments.n)))
        return
    found = {n: _apart(n) for n in arguments.n}
    Console().print(_table(case, found))
    print(json.dumps({**found, "growth_exponent": growth_exponent(found)}))


SAME = {"PYTHONHASHSEED": "0"}
"""Sympy's own ways depend on hashes: with one seed its calls can be compared."""
PARTS = {"measured": measure.measured, "calls": measure.calls}


def _apart(n: int) -> dict[str, Any]:
    """What processes of their own measure: peak memory is a process's, and a profiler slows everything down."""
    found: dict[str, Any] = {}
    for part in PARTS:
        command = [sys.executable, "-m", _module(), "--n", str(n), "--one", part]
        done = subprocess.run(
            command, capture_output=True, text=True, check=False, env={**os.environ, **SAME}
        )
        if done.returncode:
            sys.exit(f"{' '.join(command)}\n{done.stderr}")
        found |= json.loads(done.stdout.splitlines()[-1])
    return found


def _module() -> str:
    """The module that was started."""
    return sys.modules["__main__"].__spec__.name


def growth_exponent(found: dict[int, dict[str, Any]]) -> float | None:
    """Of the total time, between the largest size and the one nearest to a hundredth of it."""
    sizes = sorted(found)
    large = sizes[-1]
    small = min(sizes, key=lambda n: abs(math.log(large / n / 100)))
    if small == large:
        return None
    ratio = found[large]["total_seconds"] / found[small]["total_seconds"]
    return math.log(ratio) / math.log(large / small)


def _table(case: Case, found: dict[int, dict[str, Any]]) -> Table:
    table = Table(case.title, *(f"n = {n}" for n in found))
    for key, title in ROWS.items():
        table.add_row(title, *(_shown(values[key]) for values in found.values()))
    return table


def _shown(value: float) -> str:
    return f"{value:,}".replace(",", " ") if isinstance(value, int) else f"{value:.3g}"
