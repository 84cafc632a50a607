"""What an FMU in a compiled loop costs: python -m benchmarks.fmu [part.fmu].

Without a file it is one of our own: a mass on a spring. Needs fmpy, and a compiler for the latter.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import jax
import numpy as np

import acausal as ac
from acausal._jax import host_calls
from acausal.fmu import function

STEPS = 20_000
TIMES = 5


class Mass(ac.Component):
    m, c, d = ac.Parameter(1.0), ac.Parameter(400.0), ac.Parameter(2.0)
    f = ac.Input()
    s, v = ac.Variable(start=0.1, fixed=True), ac.Variable(fixed=True)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.s), self.v)
        yield ac.Eq(self.m * ac.der(self.v), self.f - self.d * self.v - self.c * self.s)


def best(action: Callable[[], Any]) -> float:
    """Seconds, the least of some tries; the first compiles."""
    jax.block_until_ready(action())
    found: list[float] = []
    for _ in range(TIMES):
        start = time.perf_counter()
        jax.block_until_ready(action())
        found.append(time.perf_counter() - start)
    return min(found)


def main() -> None:
    folder = Path(tempfile.mkdtemp())
    path = sys.argv[1] if len(sys.argv) > 1 else None
    if path is None:
        path = ac.export.fmu(ac.compile(Mass()), folder / "mass.fmu", fmi="2.0", outputs=[])
    model = ac.FMU(path)
    system = ac.compile(model)
    inputs = dict.fromkeys(system.inputs, 0.0)
    end = STEPS * 1e-6
    params = {n: float(v) for n, v in system.parameters().items()}
    state = system.states[0]

    def run(p: dict[str, Any]) -> Any:
        return ac.simulate(system, end, dt=1e-6, solver="euler", inputs=inputs, params=p).x[-1, 0]

    calls = 0
    kept = host_calls._call

    def counted(given: int, found: int, rows: int, width: int, height: int) -> None:
        nonlocal calls
        calls += rows
        kept(given, found, rows, width, height)

    value = best(lambda: run(params))
    host_calls._call = counted
    jax.block_until_ready(run(params))
    host_calls._call = kept
    computed = function.computed(model._part)
    given, found = np.zeros(2 + model._part.n + 99), np.zeros(model._part.n_values)
    starts = np.frombuffer(computed.defaults())
    at = 2 + model._part.n + model._part.n_inputs
    given[at : at + len(starts)] = starts
    pair = given.ctypes.data, found.ctypes.data
    assert isinstance(computed, function.Evaluated)
    alone = best(lambda: [computed._evaluate(*pair) for _ in range(1000)]) / 1000
    print(f"{model.description.model}, {len(params)} parameters, {STEPS} Euler steps")
    print(f"  {value / STEPS * 1e6:8.2f} us a step, {calls / STEPS:.2f} calls a step")
    print(f"  {alone * 1e6:8.2f} us a call from Python")
    slope = best(lambda: jax.grad(run)(params))
    print(f"  {slope / value:8.1f} times as long for the gradient by all parameters ({state})")


if __name__ == "__main__":
    main()
