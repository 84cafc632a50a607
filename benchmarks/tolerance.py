"""``python -m benchmarks.tolerance``: the error of adaptive steps against their tolerance, for each solver.

Sixty circuits, drives and heat models with pulsed, clipped and rectified excitation, ten of each of six structures with
random parameters. The truth is integrated here, by the classical Runge-Kutta scheme in steps that end at the edges of
the excitation and take a fiftieth of its shortest feature, from equations that are written by hand. Errors are relative
to the range of what is observed; the table holds the largest of all models, and by how many steps.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

import acausal as ac
from acausal.components import blocks, electrical, rotational, thermal

SAVED = 101
"""Points at which errors are looked at, besides the start."""

SOLVERS = ("auto", "stiff", "tsit5", "kvaerno5")
TOLERANCES = (1e-4, 1e-6, 1e-8)

Rates = Callable[[float, Sequence[float]], Sequence[float]]


@dataclass(frozen=True)
class Truth:
    """What a model should do.

    Attributes:
        rates: the derivatives of the states at a time. start: the states there. observed: which of them is looked at.
        edges: at which rates jump or bend. shortest: feature of the excitation, in seconds.
    """

    rates: Rates
    start: Sequence[float]
    observed: int
    edges: Sequence[float]
    shortest: float

    def at(self, ts: np.ndarray) -> np.ndarray:
        """The observed state at some times, the first of them that of the start."""
        x, found = np.array(self.start, float), [self.start[self.observed]]
        inner = {float(e) for e in self.edges if ts[0] < e < ts[-1]}
        ends = sorted(inner | {float(t) for t in ts})
        saved = {float(t) for t in ts[1:]}
        for begin, end in pairwise(ends):
            n = max(1, math.ceil(50 * (end - begin) / self.shortest))
            x = self._over(begin, end, n, x)
            if end in saved:
                found.append(x[self.observed])
        return np.array(found)

    def _over(self, begin: float, end: float, n: int, x: np.ndarray) -> np.ndarray:
        h, aside = (end - begin) / n, 1e-9 * (end - begin)

        def rates(t: float, x: np.ndarray) -> np.ndarray:
            return np.array(self.rates(min(max(t, begin + aside), end - aside), x))

        for i in range(n):
            t = begin + i * h
            k1 = rates(t, x)
            k2 = rates(t + h / 2, x + h / 2 * k1)
            k3 = rates(t + h / 2, x + h / 2 * k2)
            k4 = rates(t + h, x + h * k3)
            x = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        return x


@dataclass(frozen=True)
class Structure:
    """Models that differ in parameters alone.

    Attributes:
        make: one of them. observed: a state, by name. end: of its runs in seconds.
        draw: random parameters. truth: of some parameters.
    """

    make: Callable[[], ac.Component]
    observed: str
    end: float
    draw: Callable[[np.random.Generator], dict[str, float]]
    truth: Callable[[Mapping[str, float]], Truth]

    def models(self, count: int) -> Iterator[dict[str, float]]:
        """The parameters of some models."""
        rng = np.random.default_rng(list(self.observed.encode()))
        for _ in range(count):
            yield self.draw(rng)

    @property
    def ts(self) -> np.ndarray:
        """Times to look at."""
        return np.linspace(0.0, self.end, SAVED)

    @cache  # noqa: B019 (there are six)
    def system(self) -> ac.System:
        """The compiled model."""
        return ac.compile(self.make())

    @cache  # noqa: B019 (and ten models of each)
    def _true(self, p: tuple[tuple[str, float], ...]) -> np.ndarray:
        return self.truth(dict(p)).at(self.ts)

    def error(self, p: Mapping[str, float], **options: Any) -> tuple[float, int]:
        """Relative to the range, and the steps that it took."""
        system = self.system()
        params = dict(system.parameters()) | dict(p)
        sol = ac.simulate(system, self.end, params=params, saveat=self.ts, **options)
        true = self._true(tuple(p.items()))
        found = float(np.abs(np.asarray(sol[self.observed]) - true).max() / np.ptp(true))
        assert sol.statistics is not None
        return found, int(sol.statistics.steps)


def joined(*connections: str, **parts: Any) -> ac.Component:
    """A model of named parts; a connection is ``"a.p - b.n"``."""
    made = ac.Component()
    for name, part in parts.items():
        setattr(made, name, part)
    for line in connections:
        ends = [end.strip().split(".") for end in line.split("-")]
        made.connect(*(getattr(parts[part], end) for part, end in ends))
    return made


def pulse_edges(p: Mapping[str, float], name: str, end: float) -> list[float]:
    """When a pulse rises and falls."""
    start, period = p[f"{name}.startTime"], p[f"{name}.period"]
    high = period * p[f"{name}.width"] / 100
    rises = [start + k * period for k in range(math.ceil((end - start) / period))]
    return [t for rise in rises for t in (rise, rise + high)]


def is_high(p: Mapping[str, float], name: str, t: float) -> bool:
    """Whether a pulse is, off its edges."""
    since, period = t - p[f"{name}.startTime"], p[f"{name}.period"]
    return since >= 0 and since % period < period * p[f"{name}.width"] / 100


def pulse(rng: np.random.Generator, name: str, scale: float = 1.0) -> dict[str, float]:
    """A random pulse, of 2 to 90 % of a period."""
    return {
        f"{name}.period": scale * rng.uniform(0.4, 3.0),
        f"{name}.width": rng.choice([rng.uniform(2, 10), rng.uniform(10, 90)]),
        f"{name}.startTime": scale * rng.uniform(0.05, 2.0),
    }


def shortest(p: Mapping[str, float], name: str) -> float:
    """The shorter part of a period."""
    part = p[f"{name}.width"] / 100
    return p[f"{name}.period"] * min(part, 1 - part)


def _rc() -> Structure:
    """A pulsed RC circuit."""
    make = lambda: joined(  # noqa: E731
        "v.p - r.p", "r.n - c.p", "c.n - v.n", "v.n - g.p",
        v=electrical.PulseVoltage(V=1.0, period=1.0, width=50.0, startTime=0.1),
        r=electrical.Resistor(R=1.0), c=electrical.Capacitor(C=0.5, v=ac.Start(0.0, fixed=True)),
        g=electrical.Ground(),
    )  # fmt: skip

    def draw(rng: np.random.Generator) -> dict[str, float]:
        return pulse(rng, "v") | {"v.V": 5.0, "r.R": 1.0, "c.C": 10 ** rng.uniform(-2, 0.5)}

    def truth(p: Mapping[str, float]) -> Truth:
        tau = p["r.R"] * p["c.C"]
        rates: Rates = lambda t, x: [(p["v.V"] * is_high(p, "v", t) - x[0]) / tau]  # noqa: E731
        return Truth(rates, [0.0], 0, pulse_edges(p, "v", 10), min(shortest(p, "v"), tau))

    return Structure(make, "c.v", 10.0, draw, truth)


def _heat() -> Structure:
    """Two heated masses, and pulses that last a small part of an hour."""
    make = lambda: joined(  # noqa: E731
        "s.y - q.Q_flow", "q.port - a.port", "a.port - g.port_a", "g.port_b - b.port",
        s=blocks.Pulse(amplitude=1.0, period=1.0, width=50.0, startTime=0.1),
        q=thermal.PrescribedHeatFlow(), g=thermal.ThermalConductor(G=1.0),
        a=thermal.HeatCapacitor(C=1.0, T=ac.Start(300.0, fixed=True)),
        b=thermal.HeatCapacitor(C=1.0, T=ac.Start(300.0, fixed=True)),
    )  # fmt: skip

    def draw(rng: np.random.Generator) -> dict[str, float]:
        size = {"s.amplitude": 100.0, "a.C": rng.uniform(50, 500), "b.C": rng.uniform(50, 500)}
        return pulse(rng, "s", 500.0) | size | {"g.G": rng.uniform(0.1, 5.0)}

    def truth(p: Mapping[str, float]) -> Truth:
        def rates(t: float, x: Sequence[float]) -> list[float]:
            flow = p["g.G"] * (x[0] - x[1])
            heat = p["s.amplitude"] * is_high(p, "s", t)
            return [(heat - flow) / p["a.C"], flow / p["b.C"]]

        fast = min(p["a.C"], p["b.C"]) / p["g.G"]
        return Truth(rates, [300.0] * 2, 1, pulse_edges(p, "s", 3600), min(shortest(p, "s"), fast))

    return Structure(make, "b.T", 3600.0, draw, truth)


def _drive() -> Structure:
    """A motor on pulsed voltage."""
    make = lambda: joined(  # noqa: E731
        "v.p - r.p", "r.n - l.p", "l.n - m.p", "m.n - v.n", "v.n - g.p", "m.flange - j.flange_a",
        v=electrical.PulseVoltage(V=1.0, period=1.0, width=50.0, startTime=0.1),
        r=electrical.Resistor(R=1.0), l=electrical.Inductor(L=0.1, i=ac.Start(0.0, fixed=True)),
        m=electrical.RotationalEMF(k=1.0), g=electrical.Ground(),
        j=rotational.Inertia(J=1.0, w=ac.Start(0.0, fixed=True), phi=ac.Start(0.0, fixed=True)),
    )  # fmt: skip

    def draw(rng: np.random.Generator) -> dict[str, float]:
        own = {"v.V": 24.0, "l.L": 10 ** rng.uniform(-2, 0), "j.J": rng.uniform(0.2, 2.0)}
        return pulse(rng, "v") | own | {"m.k": rng.uniform(0.5, 2.0)}

    def truth(p: Mapping[str, float]) -> Truth:
        def rates(t: float, x: Sequence[float]) -> list[float]:
            current, speed = x
            drop = p["v.V"] * is_high(p, "v", t) - current - p["m.k"] * speed
            return [drop / p["l.L"], p["m.k"] * current / p["j.J"]]

        fast = min(p["l.L"], shortest(p, "v"))
        return Truth(rates, [0.0, 0.0], 1, pulse_edges(p, "v", 10), fast)

    return Structure(make, "j.w", 10.0, draw, truth)


def _sine_edges(p: Mapping[str, float], level: float, end: float) -> list[float]:
    """When a sine crosses a level and its negative."""
    turn, f = math.asin(level / p["s.amplitude"]) / (2 * math.pi), p["s.f"]
    periods = range(math.ceil(end * f) + 1)
    return [(k + at) / f for k in periods for at in (turn, 0.5 - turn, 0.5 + turn, 1 - turn)]


def _clipped() -> Structure:
    """A lag behind a clipped sine."""
    make = lambda: joined(  # noqa: E731
        "s.y - l.u", "l.y - f.u",
        s=blocks.Sine(amplitude=2.0, f=1.0), l=blocks.Limiter(uMax=1.0, uMin=-1.0),
        f=blocks.FirstOrder(T=0.5, y_start=0.0, initType="InitialState"),
    )  # fmt: skip

    def draw(rng: np.random.Generator) -> dict[str, float]:
        limit = rng.uniform(0.2, 1.9)
        own = {"s.f": rng.uniform(0.3, 6.0), "f.T": 10 ** rng.uniform(-2, 0.5)}
        return own | {"s.amplitude": 2.0, "l.uMax": limit, "l.uMin": -limit}

    def truth(p: Mapping[str, float]) -> Truth:
        def rates(t: float, x: Sequence[float]) -> list[float]:
            u = p["s.amplitude"] * math.sin(2 * math.pi * p["s.f"] * t)
            return [(min(max(u, p["l.uMin"]), p["l.uMax"]) - x[0]) / p["f.T"]]

        edges = _sine_edges(p, p["l.uMax"], 10)
        return Truth(rates, [0.0], 0, edges, min(0.1 / p["s.f"], p["f.T"]))

    return Structure(make, "f.y", 10.0, draw, truth)


def _dead_zone() -> Structure:
    """The integral of what a sine is beyond a dead zone, whose ends differ."""
    make = lambda: joined(  # noqa: E731
        "s.y - d.u", "d.y - i.u",
        s=blocks.Sine(amplitude=1.0, f=1.0), d=blocks.DeadZone(uMax=0.9, uMin=-0.95),
        i=blocks.Integrator(y_start=0.0),
    )  # fmt: skip

    def draw(rng: np.random.Generator) -> dict[str, float]:
        low, high = rng.uniform(0.5, 0.98, 2)
        own = {"s.f": rng.uniform(0.3, 6.0), "s.amplitude": 1.0}
        return own | {"d.uMax": high, "d.uMin": -low}

    def truth(p: Mapping[str, float]) -> Truth:
        def rates(t: float, x: Sequence[float]) -> list[float]:
            u = math.sin(2 * math.pi * p["s.f"] * t)
            return [max(u - p["d.uMax"], 0) + min(u - p["d.uMin"], 0)]

        edges = _sine_edges(p, p["d.uMax"], 10) + _sine_edges(p, -p["d.uMin"], 10)
        return Truth(rates, [0.0], 0, edges, 0.1 / p["s.f"])

    return Structure(make, "i.y", 10.0, draw, truth)


def _rectifier() -> Structure:
    """A half-wave rectifier with a buffer capacitor and a load."""
    make = lambda: joined(  # noqa: E731
        "v.p - d.p", "d.n - r.p", "r.n - c.p", "c.p - o.p", "o.n - v.n", "c.n - v.n", "v.n - g.p",
        v=electrical.SineVoltage(V=10.0, f=1.0), d=electrical.Diode(),
        r=electrical.Resistor(R=1.0), o=electrical.Resistor(R=10.0),
        c=electrical.Capacitor(C=0.1, v=ac.Start(0.0, fixed=True)), g=electrical.Ground(),
    )  # fmt: skip

    def draw(rng: np.random.Generator) -> dict[str, float]:
        own = {"v.V": rng.uniform(2, 12), "v.f": rng.uniform(0.5, 4), "r.R": rng.uniform(0.5, 2)}
        return own | {"o.R": rng.uniform(5, 50), "c.C": rng.uniform(0.05, 0.5)}

    def truth(p: Mapping[str, float]) -> Truth:
        def rates(t: float, x: Sequence[float]) -> list[float]:
            across = p["v.V"] * math.sin(2 * math.pi * p["v.f"] * t) - x[0]
            return [(_diode_current(across, p["r.R"]) - x[0] / p["o.R"]) / p["c.C"]]

        return Truth(rates, [0.0], 0, [], 0.02 / p["v.f"])

    return Structure(make, "c.v", 5.0, draw, truth)


def _diode_current(across: float, resistance: float) -> float:
    """Of MSL's diode with default parameters in series with a resistor, by bisection and Newton's method."""
    v = min(across, 0.6)
    for _ in range(60):
        s = v / 0.04
        steep = math.exp(min(s, 15.0))
        current = 1e-6 * (steep * (1 + max(s - 15.0, 0.0)) - 1) + v / 1e8
        slope = 1e-6 * steep / 0.04 + 1e-8
        change = (across - v - resistance * current) / (1 + resistance * slope)
        v += change
        if abs(change) < 1e-14 * (1 + abs(v)):
            break
    return (across - v) / resistance


STRUCTURES = {
    "pulsed RC": _rc(),
    "pulsed heat": _heat(),
    "pulsed drive": _drive(),
    "clipped sine": _clipped(),
    "dead zone": _dead_zone(),
    "rectifier": _rectifier(),
}


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--models", type=int, default=10, help="of each structure")
    parser.add_argument("--solvers", nargs="+", default=SOLVERS)
    chosen = parser.parse_args(arguments)
    print(f"{'':14}{'':10}" + "".join(f"{f'rtol {r:g}':>20}" for r in TOLERANCES))
    for name, structure in STRUCTURES.items():
        for solver in chosen.solvers:
            cells: list[str] = []
            for rtol in TOLERANCES:
                options = {"solver": solver, "rtol": rtol, "atol": 1e-2 * rtol}
                found = [structure.error(p, **options) for p in structure.models(chosen.models)]
                cells.append(f"{max(e for e, _ in found):9.1e}, {sum(n for _, n in found):>7}")
            print(f"{name:14}{solver:10}" + "".join(f"{c:>20}" for c in cells), flush=True)


if __name__ == "__main__":
    main()
