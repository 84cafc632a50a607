"""How long a user waits from ``import acausal`` to the first result: the quarter vehicle, and clutches with events.

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

TIMED = """
import time
start, own = time.perf_counter(), time.process_time()
{code}
print(time.perf_counter() - start, time.process_time() - own)
"""

RIDE = """
import numpy as np
import acausal as ac
from examples.qvm.model import with_networks

system = ac.compile(with_networks())
road = 0.01 * np.sin(np.arange(42001))
ride = ac.simulate(system, (0.0, 42.0), dt=1e-3, inputs={"road.v_ref": road})
assert abs(float(ride["body.a"][-1])) < 10.0
"""

CLUTCHES = """
import acausal as ac
from acausal.components import blocks, rotational as rot

class Drive(ac.Component):
    def __init__(self):
        super().__init__()
        self.wave, self.torque = blocks.Sine(f=1.0, amplitude=10.0), rot.Torque()
        self.pressed = blocks.Constant(k=1.0)
        self.inertias = [rot.Inertia(J=1.0) for _ in range(3)]
        self.clutches = [rot.Clutch(fn_max=8.0) for _ in range(2)]
        self.connect(self.wave.y, self.torque.tau)
        self.connect(self.torque.flange, self.inertias[0].flange_a)
        for clutch, left, right in zip(self.clutches, self.inertias, self.inertias[1:]):
            self.connect(self.pressed.y, clutch.f_normalized)
            self.connect(left.flange_b, clutch.flange_a)
            self.connect(clutch.flange_b, right.flange_a)

assert ac.simulate(ac.compile(Drive()), 2.0).events
"""

CODE = {
    "import": "import acausal",
    "jax_import": "import jax",
    "cold": RIDE,
    "warm": RIDE,
    "events_cold": CLUTCHES,
    "events_warm": CLUTCHES,
}
"""In this order: the first run of each fills the compilation cache."""

ROWS = {
    "import": "import acausal",
    "jax_import": "import jax",
    "cold": "quarter vehicle, from the import to the first result, cold",
    "warm": "... warm",
    "events_cold": "three inertias and two clutches, cold",
    "events_warm": "... warm",
}


def seconds(code: str, environment: Mapping[str, str]) -> tuple[float, float]:
    """How long code takes in a fresh process, and for how long it keeps processors busy."""
    done = subprocess.run(
        [sys.executable, "-c", TIMED.format(code=code)],
        cwd=ROOT,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=True,
    )
    passed, busy = done.stdout.splitlines()[-1].split()
    return float(passed), float(busy)


def measured() -> dict[str, float]:
    """Every figure once; the processes take turns so that they share what disturbs."""
    found: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, code in CODE.items():
            passed, busy = seconds(code, {"ACAUSAL_COMPILATION_CACHE": folder})
            found |= {f"{name}_seconds": passed, f"{name}_processor_seconds": busy}
    return found


def main() -> None:
    """Measure, print a table, and a line of JSON at the end."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5, help="processes for every figure")
    rounds = [measured() for _ in range(parser.parse_args().rounds)]
    found = {key: statistics.median(r[key] for r in rounds) for key in rounds[0]}
    table = Table("", "seconds", "of processor time")
    for name, title in ROWS.items():
        both = (found[f"{name}_{kind}"] for kind in ("seconds", "processor_seconds"))
        table.add_row(title, *(f"{value:.2f}" for value in both))
    Console().print(table)
    print(json.dumps(found))


if __name__ == "__main__":
    main()
