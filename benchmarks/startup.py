"""How long a user waits for the quarter vehicle: from ``import acausal`` to the first simulated result.

Each figure is the median over fresh processes. Cold: an empty compilation cache; warm: a second run with the same.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

from rich.console import Console
from rich.table import Table

ROOT = Path(__file__).parents[1]

IMPORT = """
import time
start = time.perf_counter()
import {module}
print(time.perf_counter() - start)
"""

RIDE = """
import time
start = time.perf_counter()
import acausal as ac
from examples.qvm.model import with_networks

system = ac.compile(with_networks())
road = 0.01 * __import__("numpy").sin(range(42001))
ride = ac.simulate(system, (0.0, 42.0), dt=1e-3, inputs={"road.v_ref": road})
assert abs(float(ride["body.a"][-1])) < 10.0
print(time.perf_counter() - start)
"""

ROWS = {
    "import_seconds": "import acausal [s]",
    "jax_import_seconds": "import jax [s]",
    "cold_seconds": "to the first result, cold [s]",
    "warm_seconds": "to the first result, warm [s]",
}


def seconds(code: str, environment: Mapping[str, str]) -> float:
    """What a fresh process prints."""
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=ROOT,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=True,
    )
    return float(done.stdout.splitlines()[-1])


def measured() -> dict[str, float]:
    """Every figure once; the processes take turns so that they share what disturbs."""
    with tempfile.TemporaryDirectory() as folder:
        own = {"ACAUSAL_COMPILATION_CACHE": folder}
        return {
            "import_seconds": seconds(IMPORT.format(module="acausal"), own),
            "jax_import_seconds": seconds(IMPORT.format(module="jax"), own),
            "cold_seconds": seconds(RIDE, own),
            "warm_seconds": seconds(RIDE, own),
        }


def main() -> None:
    """Measure, print a table, and a line of JSON at the end."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5, help="processes for every figure")
    rounds = [measured() for _ in range(parser.parse_args().rounds)]
    found = {key: statistics.median(r[key] for r in rounds) for key in ROWS}
    table = Table("quarter vehicle", "seconds")
    for key, title in ROWS.items():
        table.add_row(title, f"{found[key]:.2f}")
    Console().print(table)
    print(json.dumps(found))


if __name__ == "__main__":
    main()
