"""``python -m benchmarks.observer``: how long a step of an observer takes, in Python and as exported C.

The quarter vehicle with both networks (five states), observed by the accelerations of body and wheel every millisecond,
on one core. A call in Python takes names and gives names, with inputs as an array.
"""

from __future__ import annotations

import ctypes
import json
import os
import tempfile
from collections.abc import Callable
from pathlib import Path

import jax
import numpy as np

import acausal as ac
from benchmarks.qvm import c
from benchmarks.race import race
from examples.qvm.model import with_networks

SENSORS = {"body.a": 0.1, "wheel.a": 0.5}
NOISE = {"body.v": 0.01, "wheel.v": 0.01}
CALLS, CALLS_IN_C = 200, 10_000

DRIVER = """
#include "seen.h"
int size(void) { return (int)sizeof(seen); }
int steps(seen *m, int n) {
  int failed = 0;
  seen_init(m);
  for (int i = 0; i < n; i++) {
    m->t = 0.001 * i; m->u[0] = 0; m->y[0] = 0.1; m->y[1] = -0.1;
    failed |= seen_step(m);
  }
  return failed;
}
"""


def observer(system: ac.System, method: str) -> ac.Observer:
    """What is measured."""
    return ac.observer(system, SENSORS, NOISE, 1e-3, method=method)


def in_python(seen: ac.Observer) -> Callable[[], None]:
    """`CALLS` steps of an observer."""
    u, y = np.zeros(1), {"body.a": 0.1, "wheel.a": -0.1}

    def run() -> None:
        begin = 0.0 if seen.t is None else seen.t
        for k in range(1, CALLS + 1):
            seen.step(begin + 1e-3 * k, u, y)

    run()
    return run


def in_c(seen: ac.Observer, folder: Path) -> Callable[[], None]:
    """`CALLS_IN_C` steps of the same in C."""
    _, source = ac.export.c(seen, folder, name="seen")
    driver = folder / "driver.c"
    driver.write_text(DRIVER, encoding="utf-8")
    library = c.compiled(source, driver)
    memory = ctypes.create_string_buffer(library.size())

    def run() -> None:
        assert library.steps(memory, CALLS_IN_C) == 0

    return run


def main() -> None:
    """Measure both filters."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    system, found = ac.compile(with_networks()), dict[str, float]()
    for method in ("ekf", "ukf"):
        with tempfile.TemporaryDirectory() as name:
            compiled = in_c(observer(system, method), Path(name))
            result = race(in_python(observer(system, method)), compiled)
        found[f"{method}_microseconds"] = 1e6 * result.seconds / CALLS
        found[f"{method}_c_microseconds"] = 1e6 * result.seconds / result.ratio / CALLS_IN_C
    for key, value in found.items():
        print(f"{key:<24} {value:.3g}")
    print(json.dumps({**found, "backend": jax.default_backend()}))


if __name__ == "__main__":
    main()
