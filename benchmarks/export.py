"""``python -m benchmarks.export``: what exports cost, and how fast the exported C is.

Seconds and sizes of the exported quarter vehicle and of 10,000 masses; one evaluation in C beside a jitted call; and
the exported steps beside a simulation that is written by hand in C: the same networks, method and flags, one core.
"""

from __future__ import annotations

import ctypes
import json
import tempfile
import time
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

import acausal as ac
from benchmarks.chain import Chain
from benchmarks.qvm import c
from benchmarks.qvm.task import SAMPLES, Task, record, task
from benchmarks.race import race
from examples.qvm.model import with_networks
from examples.qvm.record import SAMPLE_TIME, STATES

MASSES = 10_000
EVALUATIONS = 10_000
SOLVER = "heun"

DRIVER = """
#include "vehicle.h"
int size(void) { return (int)sizeof(vehicle); }
int move(vehicle *m, int n, double h, double *x, const double *u0, const double *u1) {
  int failed = 0;
  for (int i = 0; i < VEHICLE_STATES; i++) m->x[i] = x[i];
  m->u[0] = u0[0];
  for (int i = 0; i < n; i++) failed |= vehicle_step(m, h, u1 + i);
  for (int i = 0; i < VEHICLE_STATES; i++) x[i] = m->x[i];
  return failed;
}
int evaluate(vehicle *m, int n) {
  int failed = 0;
  for (int i = 0; i < n; i++) failed |= vehicle_derivatives(m);
  return failed;
}
"""
"""Calls the exported functions, from a file of its own as a user's program would."""


class Exported:
    """The quarter vehicle in C, compiled with the flags of the code by hand."""

    def __init__(self, system: ac.System, params: Any, folder: Path) -> None:
        _, source = ac.export.c(system, folder, params, name="vehicle", solver=SOLVER)
        driver = folder / "driver.c"
        driver.write_text(DRIVER, encoding="utf-8")
        self.library = c.compiled(source, driver)
        self.m = ctypes.create_string_buffer(self.library.size())
        self.library.vehicle_init(self.m)

    def forward(self, task: Task) -> Callable[[], np.ndarray]:
        """Simulates the first sequence of a task; gives the states at its end."""
        u0, u1 = (np.ascontiguousarray(u[0]) for u in (task.u0, task.u1))

        def run() -> np.ndarray:
            x = np.array(task.x0[0])
            step = ctypes.c_double(SAMPLE_TIME)
            assert self.library.move(self.m, len(u0), step, *c.pointers(x, u0, u1)) == 0
            return x

        return run

    def evaluate(self) -> None:
        """`EVALUATIONS` right-hand sides."""
        assert self.library.evaluate(self.m, EVALUATIONS) == 0


def steps(exported: Exported, asked: Task) -> dict[str, float]:
    """The exported steps beside those by hand."""
    ours, by_hand = exported.forward(asked), c.forward(asked)
    x, expected = ours(), by_hand()
    off = float(np.abs(x - expected).max() / np.abs(expected).max())
    found = race(ours, by_hand)
    return {
        "step_microseconds": 1e6 * found.seconds / asked.length,
        "step_over_c": found.ratio,
        "step_over_c_of_processor_time": found.cpu,
        "step_off": off,
    }


def evaluations(exported: Exported, system: ac.System, params: Any) -> dict[str, float]:
    """One evaluation in C beside a jitted call."""
    packed = system.pack(params)
    field = jax.jit(lambda x, u: system.vector_field(0.0, x, u, packed))
    x, u = jnp.zeros(len(STATES)), jnp.zeros(1)

    def jitted() -> None:
        for _ in range(EVALUATIONS // 10):
            jax.block_until_ready(field(x, u))

    jitted()
    found = race(exported.evaluate, jitted)
    return {
        "evaluation_microseconds": 1e6 * found.seconds / EVALUATIONS,
        "jitted_call_over_evaluation": 10 / found.ratio,
    }


def exports(title: str, system: ac.System, params: Any, folder: Path) -> dict[str, float]:
    """Seconds and sizes of a model as C and as FMU."""
    begin = time.perf_counter()
    files = ac.export.c(system, folder / title, params, name="model")
    seconds = time.perf_counter() - begin
    begin = time.perf_counter()
    fmu = ac.export.fmu(system, folder / f"{title}.fmu", params, name="model")
    with zipfile.ZipFile(fmu) as archive:
        description = archive.getinfo("modelDescription.xml").file_size
    return {
        f"{title}_c_seconds": seconds,
        f"{title}_c_kb": sum(file.stat().st_size for file in files) / 1e3,
        f"{title}_fmu_seconds": time.perf_counter() - begin,
        f"{title}_fmu_kb": fmu.stat().st_size / 1e3,
        f"{title}_description_kb": description / 1e3,
    }


def main() -> None:
    """Measure all."""
    system, chain = ac.compile(with_networks()), ac.compile(Chain(MASSES))
    params, found = system.parameters(0), dict[str, float]()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        found |= exports("vehicle", system, params, folder)
        found |= exports("masses", chain, chain.parameters(), folder)
        exported = Exported(system, params, folder)
        found |= steps(exported, task("", record(), params, 1, SAMPLES))
        found |= evaluations(exported, system, params)
    for key, value in found.items():
        print(f"{key:<32} {value:.4g}")
    print(json.dumps(found))


if __name__ == "__main__":
    main()
