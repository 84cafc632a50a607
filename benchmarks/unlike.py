"""``python -m benchmarks.unlike``: masses joined by twice as many springs, each of a class of its own.

Three kinds of springs: all of one class; of classes that inherit equations and differ in a number (``numbers``); and of
classes whose laws are truly different (``laws``). Prints seconds until a model is compiled and first simulated, and the
peak memory; every model in a process of its own.
"""

from __future__ import annotations

import argparse
import json
import math
import resource
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

import acausal as ac
from acausal.components import translational as tl

SIZES = {"one": (100, 1000), "numbers": (100, 1000), "laws": (50, 200)}
"""By kind, the numbers of masses."""

Base = tl.PartialCompliantWithRelativeStates
TERMS: tuple[Callable[[Any, Any], Any], ...] = (
    lambda s, v: s**3,
    lambda s, v: v**3,
    lambda s, v: s**2 * v,
    lambda s, v: ac.tanh(1.7 * s),
    lambda s, v: ac.tanh(1.7 * v),
    lambda s, v: ac.sin(1.7 * s),
    lambda s, v: ac.atan(1.7 * v),
    lambda s, v: s / (1.7 + s**2),
    lambda s, v: v / (1.7 + v**2),
    lambda s, v: s * ac.exp(-1.7 * s**2),
    lambda s, v: ac.asinh(1.7 * s + 2.3 * v),
)
"""A law is the sum of some of these: those that are digits 1 of its number."""


class Spring(Base):
    """The springs of one class."""

    a = ac.Parameter()

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, 20 * self.a * self.s_rel + 0.3 * self.v_rel)


def spring(kind: str, i: int, a: float) -> tl.PartialCompliant:
    """Spring number i."""
    if kind == "one":
        return Spring(a=a)

    def equations(self: Any) -> Iterator[ac.Eq]:
        yield from Base.equations(self)
        law = 20 * a * self.s_rel + 0.3 * self.v_rel
        if kind == "laws":
            chosen = [t for k, t in enumerate(TERMS) if i >> k & 1]
            law += sum(0.1 * a * term(self.s_rel, self.v_rel) for term in chosen)
        yield ac.Eq(self.f, law)

    return type(f"Spring{i}", (Base,), {"equations": equations})()


def graph(kind: str, n: int) -> ac.Component:
    """A random graph of n masses: each is joined to another, and as many pairs besides."""
    generator = np.random.default_rng(0)
    whole = ac.Component()
    whole.wall = tl.Fixed()
    starts = 0.1 * generator.normal(size=n)
    whole.mass = [
        tl.Mass(m=m, s=ac.Start(s, fixed=True), v=ac.Start(0.0, fixed=True))
        for m, s in zip(generator.uniform(0.5, 2, n).tolist(), starts.tolist(), strict=True)
    ]
    stiffness = generator.uniform(0.1, 1, 2 * n).tolist()
    whole.spring = [spring(kind, i, a) for i, a in enumerate(stiffness)]
    ends = generator.integers(-1, n, 2 * n).tolist()
    for i, (one, end) in enumerate(zip(whole.spring, ends, strict=True)):
        whole.connect(whole.mass[i % n].flange_b, one.flange_a)
        fixed = end in (-1, i % n)
        whole.connect(one.flange_b, whole.wall.flange if fixed else whole.mass[end].flange_a)
    return whole


def measured(kind: str, n: int) -> dict[str, float]:
    """Seconds and memory of one model."""
    model, start = graph(kind, n), time.perf_counter()
    system = ac.compile(model)
    compiled = time.perf_counter()
    ac.simulate(system, 1.0)
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return {
        "compile_seconds": compiled - start,
        "simulate_seconds": time.perf_counter() - compiled,
        "total_seconds": time.perf_counter() - start,
        "memory_gb": memory / (1e9 if sys.platform == "darwin" else 1e6),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description="Compile and simulate models of unlike classes.")
    parser.add_argument("--n", type=int, nargs="+", help="numbers of masses")
    parser.add_argument("--kind", choices=SIZES, nargs="+", default=list(SIZES), help="of springs")
    parser.add_argument(
        "--one", action="store_true", help="measure only this, and print it as JSON"
    )
    arguments = parser.parse_args()
    if arguments.one:
        print(json.dumps(measured(arguments.kind[0], arguments.n[0])))
        return
    found = {k: {n: _apart(k, n) for n in arguments.n or SIZES[k]} for k in arguments.kind}
    table = Table("springs", "masses", "compile [s]", "simulate [s]", "total [s]", "memory [GB]")
    for kind, sizes in found.items():
        for n, values in sizes.items():
            table.add_row(kind, str(n), *(f"{v:.3g}" for v in values.values()))
    Console().print(table)
    growth = {k: _growth(sizes) for k, sizes in found.items() if len(sizes) > 1}
    print(json.dumps({**found, "growth_exponent": growth}))


def _apart(kind: str, n: int) -> dict[str, float]:
    command = [sys.executable, "-m", "benchmarks.unlike", "--kind", kind, "--n", str(n), "--one"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(command)}\n{done.stderr}")
    return json.loads(done.stdout.splitlines()[-1])


def _growth(sizes: dict[int, dict[str, float]]) -> float:
    """The exponent of the total time between the least and the largest size."""
    small, large = min(sizes), max(sizes)
    ratio = sizes[large]["total_seconds"] / sizes[small]["total_seconds"]
    return math.log(ratio) / math.log(large / small)


if __name__ == "__main__":
    main()
