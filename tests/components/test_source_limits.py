"""Sources at the limits of their parameters: widths, ramps and time constants of zero, equal times in tables."""

import re

import jax
import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks
from tests.support.exported_c import ExportedC
from tests.support.parts import Model, model

START = {"startTime": 0.7, "offset": 1.0}


def after(function):
    """A function of the time since the start; 0 before it."""
    return lambda t: np.where(t < 0.7, 0.0, function(np.maximum(t - 0.7, 0.0)))


def high(width, period=1.3):
    """High for a part of every period."""
    return after(lambda t: 2.0 * (t % period < width))


TABLES = [[0, 0], [0, 1], [1, 2], [1, 3], [3, 3], [3, 4], [8, 4]]
SOURCES = {
    "ramp": (blocks.Ramp(height=2.0, duration=0.0, **START), after(lambda t: 2.0 + 0 * t)),
    "box": (
        blocks.Trapezoid(amplitude=2.0, rising=0, width=0.4, falling=0, period=1.3, **START),
        high(0.4),
    ),
    "steep": (
        blocks.Trapezoid(amplitude=2.0, rising=0, width=0.4, falling=0.5, period=1.3, **START),
        after(lambda t: 2.0 * np.clip((0.9 - t % 1.3) / 0.5, 0, 1)),
    ),
    "sudden_end": (
        blocks.Trapezoid(amplitude=2.0, rising=0.5, width=0.4, falling=0, period=1.3, **START),
        after(lambda t: np.where(t % 1.3 < 0.9, 2.0 * np.clip(t % 1.3 / 0.5, 0, 1), 0)),
    ),
    "no_top": (
        blocks.Trapezoid(amplitude=2.0, rising=0.5, width=0, falling=0.8, period=1.3, **START),
        after(lambda t: 2.0 * np.minimum(t % 1.3 / 0.5, (1.3 - t % 1.3) / 0.8)),
    ),
    "nothing": (
        blocks.Trapezoid(amplitude=2.0, rising=0, width=0, falling=0, period=1.3, **START),
        high(0.0),
    ),
    "whole_period": (
        blocks.Trapezoid(amplitude=2.0, rising=0, width=1.3, falling=0, period=1.3, **START),
        high(2.0),
    ),
    "no_pulse": (blocks.Pulse(amplitude=2.0, width=0, period=1.3, **START), high(0.0)),
    "all_pulse": (blocks.Pulse(amplitude=2.0, width=100, period=1.3, **START), high(2.0)),
    "no_periods": (blocks.SawTooth(amplitude=2.0, period=1.3, nperiod=0, **START), high(0.0)),
    "sweep": (
        blocks.LogFrequencySweep(wMin=2.0, wMax=3.0, startTime=0.7, duration=0.0),
        lambda t: np.where(t < 0.7, 2.0, 3.0),
    ),
    "sinc": (blocks.Sinc(amplitude=2.0, f=0.0, **START), after(lambda t: 2.0 + 0 * t)),
    "sudden_rise": (
        blocks.Exponentials(outMax=2.0, riseTime=1.0, riseTimeConst=0, fallTimeConst=0.5, **START),
        after(lambda t: 2.0 * np.exp(-np.maximum(t - 1.0, 0) / 0.5)),
    ),
    "sudden_fall": (
        blocks.Exponentials(outMax=2.0, riseTime=1.0, riseTimeConst=0.5, fallTimeConst=0, **START),
        after(lambda t: np.where(t <= 1.0, 2.0 * (1 - np.exp(-t / 0.5)), 0.0)),
    ),
    "table": (
        blocks.TimeTable(table=TABLES, shiftTime=0.7, **START),
        after(lambda t: np.where(t < 1, 1 + t, np.where(t < 3, 3.0, 4.0))),
    ),
    "steps": (
        blocks.CombiTimeTable(
            table=TABLES,
            smoothness="ConstantSegments",
            shiftTime=0.7,
            startTime=0.7,
            offset=[1.0],
        ),
        after(lambda t: np.where(t < 1, 1.0, np.where(t < 3, 3.0, 4.0))),
    ),
}
TS = np.linspace(0.0, 6.0, 257)


class Ticks(ac.Component):
    """Something else that has events, at times of no source."""

    n = ac.Discrete(0, kind="int")

    def equations(self):
        yield ac.When(ac.sample(0.123, 0.789), ac.Eq(self.n, ac.pre(self.n) + 1))


def all_sources(**others):
    made = Model()
    for name, (source, _) in SOURCES.items():
        setattr(made, name, source)
        made_i = blocks.Integrator(y_start=0.0)
        setattr(made, f"{name}_i", made_i)
        made.connect(source.y[0] if hasattr(source, "nout") else source.y, made_i.u)
    for name, part in others.items():
        setattr(made, name, part)
    return made


@pytest.fixture(scope="module")
def system():
    return ac.compile(all_sources())


def expected(ts):
    return np.stack([np.asarray(f(ts)) + (n != "sweep") for n, (_, f) in SOURCES.items()], axis=1)


def names():
    return [f"{n}.y[1]" if hasattr(s, "nout") else f"{n}.y" for n, (s, _) in SOURCES.items()]


def near_edges():
    """Times a rounding error before, at and after edges."""
    edges = 0.7 + np.array([0.0, 0.4, 0.5, 0.9, 1.0, 1.3, 1.7, 2.6, 3.0, 3.9])
    return np.concatenate([np.nextafter(edges, 0), edges, np.nextafter(edges, 9)])


@pytest.mark.slow
def test_their_values(system):
    params, x = system.parameters(), np.zeros(len(system.states))
    read = jax.jit(jax.vmap(lambda t: system.observe(names(), t, x, None, params)))
    np.testing.assert_allclose(read(TS), expected(TS), atol=1e-12)
    at_edges = np.asarray(read(near_edges()))
    assert at_edges.min() >= 0.999, names()[at_edges.min(axis=0).argmin()]
    assert at_edges.max() <= 5.001, names()[at_edges.max(axis=0).argmax()]


@pytest.mark.slow
def test_exported_c_computes_the_same(system, tmp_path):
    params, x = system.parameters(), np.zeros(len(system.states))
    field = jax.jit(jax.vmap(lambda t: system.vector_field(t, x, None, params)))
    exported = ExportedC(system, tmp_path)
    for t, dx in zip(TS, np.asarray(field(TS)), strict=True):
        exported.time[:] = t
        np.testing.assert_allclose(exported.derivatives(), dx, atol=1e-12)
    for t in near_edges():  # which side of an edge is a matter of rounding
        exported.time[:] = t
        assert np.all((exported.derivatives() >= 0.999) & (exported.dx <= 5.001))


@pytest.mark.slow
def test_exported_steps_see_every_edge_on_their_grid(tmp_path):
    """Ramps, tops and periods begin and end where steps do, or a rounding error beside; some last no time."""
    i = blocks.Integrator(y_start=0.0)
    s = blocks.Trapezoid(period=1.0, startTime=0.1, rising=0.1, falling=0.1)  # none of them folded
    made = model("s.y - i.u", s=s, i=i, tick=Ticks())
    exported, rng = ExportedC(ac.compile(made), tmp_path), np.random.default_rng(0)
    chosen = {n: place(exported, n) for n in ("startTime", "rising", "width", "falling", "period")}
    for _ in range(200):
        h = rng.choice([0.01, 0.02, 0.05, 0.065, 0.1, 0.13])
        start, rise, top, fall, rest = h * rng.integers((0, 0, 0, 0, 1), (5, 5, 5, 5, 6))
        period, n = rise + top + fall + rest, round(2.99 / h)
        exported.call("init")
        for at, value in zip(chosen.values(), (start, rise, top, fall, period), strict=True):
            exported.p[at] = value
        exported.call("recalibrate")
        assert exported.call("begin") == 0
        for _ in range(n):
            assert exported.step(h) == 0
        periods, left = divmod(n * h - start + 1e-9, period)  # the last edge is behind
        falls = np.clip(left - rise - top, 0, fall)
        area = periods * (top + (rise + fall) / 2) + np.clip(left - rise, 0, top)
        area += min(left, rise) ** 2 / (2 * rise) if rise else 0.0
        area += falls - falls**2 / (2 * fall) if fall else 0.0
        assert exported.x[0] == pytest.approx(area, abs=1e-7), (h, start, rise, top, fall, period)


def place(exported, name):
    """Where a parameter of the source is among those of exported C."""
    listed = exported.header[exported.header.index("_real p[") :]
    return int(re.search(rf"\[(\d+)\]\s+s\.{name}\b", listed)[1])
