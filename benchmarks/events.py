"""``python -m benchmarks.events``: what events cost.

A buck converter of 10 kHz over a second beside C, its gradient, a ball's events in right-hand sides, a thousand balls
side by side, how programs of many ideal diodes grow, and stiff plates of many states with a thermostat. Ratios are
medians over rounds in which both take turns.
"""

from __future__ import annotations

import ctypes
import json
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp

import acausal as ac
from acausal.components import electrical as el, thermal
from benchmarks.stiff.plate import Plate

ROUNDS = 9
SPAN, STEP = 1.0, 1e-5

SOURCE = """
static void field(double on, const double *p, const double *x, double *dx) {
  dx[0] = (on * p[0] - x[1]) / p[1];
  dx[1] = (x[0] - x[1] / p[3]) / p[2];
}
static void step(double on, const double *p, double h, double *x) {
  double k1[2], k2[2], k3[2], k4[2], y[2];
  field(on, p, x, k1);
  for (int i = 0; i < 2; i++) y[i] = x[i] + h / 2 * k1[i];
  field(on, p, y, k2);
  for (int i = 0; i < 2; i++) y[i] = x[i] + h / 2 * k2[i];
  field(on, p, y, k3);
  for (int i = 0; i < 2; i++) y[i] = x[i] + h * k3[i];
  field(on, p, y, k4);
  for (int i = 0; i < 2; i++) x[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
}
double run(const double *p, double period, double duty, double h, int n) {
  double x[2] = {0, 0}, t = 0, begin = 0;
  int count = 1, on = 1;
  for (int i = 1; i <= n; i++) {
    double stop = i * h;
    while (t < stop) {
      double off = begin + duty * period, next = count * period, to = stop;
      int event = 0;
      if (on && off < to) { to = off; event = 1; }
      if (next <= to) { to = next; event = 2; }
      step(on, p, to - t, x);
      t = to;
      if (event == 1) on = 0;
      if (event == 2) { begin = next; count++; on = 1; }
    }
  }
  return x[1];
}
"""


class Buck(ac.Component):
    """A step-down converter in continuous conduction, switched by a clock and a duty cycle."""

    V = ac.Parameter(24.0, unit="V")
    L = ac.Parameter(100e-6, unit="H")
    C = ac.Parameter(100e-6, unit="F")
    R = ac.Parameter(5.0, unit="Ohm")
    period = ac.Parameter(1e-4, unit="s")
    duty = ac.Parameter(0.43, unit="1")
    i = ac.Variable(fixed=True, unit="A")
    v = ac.Variable(fixed=True, unit="V")
    begin = ac.Discrete(0.0, unit="s")

    def equations(self) -> Iterator[Any]:
        on = ac.time < self.begin + self.duty * self.period
        yield ac.When(ac.sample(0, self.period), ac.Eq(self.begin, ac.time))
        source = ac.where(on, 1, 0, events=True) * self.V
        yield ac.Eq(self.L * ac.der(self.i), source - self.v)
        yield ac.Eq(self.C * ac.der(self.v), self.i - self.v / self.R)


class Ball(ac.Component):
    """A ball that bounces, or falls on."""

    e = ac.Parameter(0.8, unit="1")
    floor = ac.Parameter(0.0, unit="m")
    h = ac.Variable(start=1.0, unit="m", fixed=True)
    v = ac.Variable(unit="m/s", state="always", fixed=True)

    def __init__(self, *, bounces: bool) -> None:
        super().__init__()
        self.bounces = bounces

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.h), self.v)
        yield ac.Eq(ac.der(self.v), -9.81)
        if self.bounces:
            yield ac.When(self.h < self.floor, ac.Reinit(self.v, -self.e * ac.pre(self.v)))


class Diodes(ac.Component):
    """Ideal diodes, each with a resistance and a capacitance behind it, at one source."""

    def __init__(self, n: int) -> None:
        super().__init__()
        self.source, self.ground = el.SineVoltage(V=1.0, f=50.0), el.Ground()
        self.diode = [el.IdealDiode() for _ in range(n)]
        self.resistor = [el.Resistor(R=1.0 + 0.1 * k) for k in range(n)]
        self.capacitor = [el.Capacitor(C=1e-3) for _ in range(n)]
        self.connect(self.source.n, self.ground.p)
        for diode, resistor, capacitor in zip(
            self.diode, self.resistor, self.capacitor, strict=True
        ):
            self.connect(self.source.p, diode.p)
            self.connect(diode.n, resistor.p)
            self.connect(resistor.n, capacitor.p)
            self.connect(capacitor.n, self.ground.p)


def seconds(*functions: Callable[[], Any]) -> list[float]:
    """Medians of processor time, one call of each function in turn."""
    for function in functions:
        jax.block_until_ready(function())
    found: list[list[float]] = [[] for _ in functions]
    for _ in range(ROUNDS):
        for times, function in zip(found, functions, strict=True):
            begin = time.process_time()
            jax.block_until_ready(function())
            times.append(time.process_time() - begin)
    return [statistics.median(times) for times in found]


def compiled_c() -> Callable[[], float]:
    """The converter in C."""
    folder = Path(tempfile.mkdtemp())
    source, library = folder / "buck.c", folder / "buck.so"
    source.write_text(SOURCE, encoding="utf-8")
    subprocess.run(["cc", "-O3", "-shared", "-fPIC", str(source), "-o", str(library)], check=True)
    run = ctypes.CDLL(str(library)).run
    run.restype = ctypes.c_double
    p = (ctypes.c_double * 4)(24.0, 100e-6, 100e-6, 5.0)
    double = ctypes.c_double
    return lambda: run(
        p, double(1e-4), double(0.43), double(STEP), ctypes.c_int(round(SPAN / STEP))
    )


def buck() -> dict[str, float]:
    """The converter beside C, and its gradient beside the converter."""
    system = ac.compile(Buck())

    def end(duty: Any) -> Any:
        params = {**system.parameters(), "duty": duty}
        return ac.simulate(
            system, (0.0, SPAN), dt=STEP, solver="rk4", saveat=[SPAN], params=params
        )["v"][-1]

    run, gradient, c = jax.jit(end), jax.jit(jax.grad(end)), compiled_c()
    ours, theirs = seconds(lambda: run(0.43), c)
    _, derivative = seconds(lambda: run(0.43), lambda: gradient(0.43))
    difference = (float(run(0.43 + 1e-6)) - float(run(0.43 - 1e-6))) / 2e-6
    return {
        "buck_seconds": ours,
        "buck_over_c": ours / theirs,
        "buck_off": abs(float(run(0.43)) - c()),
        "buck_gradient_over_run": derivative / ours,
        "buck_gradient_off": abs(float(gradient(0.43)) / difference - 1),
    }


def balls() -> dict[str, float]:
    """A thousand balls that bounce beside a thousand that do not, in fixed and in adaptive steps."""
    heights = jnp.linspace(0.5, 2.0, 1000)
    found: dict[str, float] = {}
    kinds: dict[str, dict[str, Any]] = {"fixed": {"dt": 0.01, "solver": "rk4"}, "adaptive": {}}
    for kind, steps in kinds.items():
        programs: list[Callable[[], Any]] = []
        for bounces in (True, False):
            system = ac.compile(Ball(bounces=bounces))

            def end(h: Any, system: ac.System = system, steps: dict[str, Any] = steps) -> Any:
                return ac.simulate(system, (0.0, 2.0), x0={"h": h}, **steps).x[-1]

            mapped = jax.jit(jax.vmap(end))
            programs.append(lambda mapped=mapped: mapped(heights))
        with_events, without = seconds(*programs)
        found[f"balls_{kind}_over_without"] = with_events / without
        found[f"balls_{kind}_seconds"] = with_events
    return found


def cost() -> dict[str, float]:
    """Right-hand sides that an event of a ball takes in fixed steps, over those of a step of rk4."""
    system = ac.compile(Ball(bounces=True))
    run = ac.simulate(system, (0.0, 1.5), dt=0.01, solver="rk4")
    assert run.statistics is not None
    steps = len(run.t) - 1
    extra = int(run.statistics.rates) - 4 * steps
    return {"event_in_rk4_steps": extra / 4 / len(run.events)}


def diodes() -> dict[str, float]:
    """How the programs of many diodes grow: of rates, and of a simulation by one of the parameters."""
    found: dict[str, float] = {}
    for n in (10, 1000, 10_000):
        begin = time.perf_counter()
        system = ac.compile(Diodes(n))
        found[f"diodes_{n}_compile_seconds"] = time.perf_counter() - begin
        x, params = jnp.zeros(len(system.states)), system.pack()

        def end(voltage: Any, system: ac.System = system) -> Any:
            return ac.simulate(
                system, (0.0, 0.04), dt=1e-4, solver="rk4", params={"source.V": voltage}
            ).x[-1]

        rates = jax.jit(lambda x, s=system, p=params: s.vector_field(0.0, x, None, p)).lower(x)
        run = jax.jit(end).lower(1.0)
        found[f"diodes_{n}_lines"] = len(rates.as_text().splitlines())
        found[f"diodes_{n}_simulation_lines"] = len(run.as_text().splitlines())
    return found


class HeatedPlate(Plate):
    """A plate whose first capacity is heated until it is hot: a stiff model with an event."""

    flow = ac.Output(unit="W")
    on = ac.Discrete(1, kind="bool")

    def __init__(self, n: int) -> None:
        super().__init__(n)
        self.heater = thermal.PrescribedHeatFlow()
        self.connect(self.heater.port, self.cells[0].port)
        self.connect(self.flow, self.heater.Q_flow)

    def equations(self) -> Iterator[Any]:
        first = self.cells[0].T
        cold = ac.where(first < 315.0, 1, ac.pre(self.on))
        yield ac.Eq(self.flow, ac.where(self.on, 400.0, 0.0))
        yield ac.Eq(self.on, ac.where(first > 320.0, 0, cold))


def plates() -> dict[str, float]:
    """Implicit steps of plates with events: the first simulation, and further ones."""
    found: dict[str, float] = {}
    for n in (20, 50, 70):
        system = ac.compile(HeatedPlate(n))

        def run(system: ac.System = system) -> Any:
            return ac.simulate(system, 20.0, solver="stiff", saveat=[0.0, 20.0]).x

        begin = time.perf_counter()
        jax.block_until_ready(run())
        found[f"plate_{n * n}_first_seconds"] = time.perf_counter() - begin
        found[f"plate_{n * n}_seconds"] = seconds(run)[0]
    return found


def main() -> None:
    """Measure all, or the parts that are named."""
    parts = {"buck": buck, "balls": balls, "cost": cost, "diodes": diodes, "plates": plates}
    found: dict[str, float] = {}
    for name in sys.argv[1:] or parts:
        own = parts[name]()
        for key, value in own.items():
            print(f"{key:<28} {value:.4g}")
        found |= own
    print(json.dumps(found))


if __name__ == "__main__":
    main()
