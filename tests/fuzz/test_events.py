"""Random models with events beside a slow simulator that knows nothing of ours: SciPy, and an event iteration."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac

SEEDS = range(200)
END = 4.0


@dataclass(frozen=True)
class Drawn:
    """Two oscillators, a hysteresis, a clock, counters that cause each other, and a state that jumps.

    Attributes:
        w1, w2, damping1, damping2: of the oscillators. low, high: of the hysteresis. period: of the clock.
        gain: of what it samples.
        level: where the second oscillator is counted. most: at so many counts the first one is kicked by kick.
    """

    w1: float
    w2: float
    damping1: float
    damping2: float
    low: float
    high: float
    period: float
    gain: float
    level: float
    most: float
    kick: float

    @staticmethod
    def by(seed: int) -> Drawn:
        rng = np.random.default_rng(seed)
        u = rng.uniform
        return Drawn(
            u(2, 5), u(4, 9), u(0, 0.3), u(0, 0.2), u(-0.5, -0.1), u(0.1, 0.5),
            u(0.17, 0.6), u(-0.5, 0.5), u(-0.4, 0.4), float(rng.integers(2, 4)), u(-0.9, 0.9),
        )  # fmt: skip


class Model(ac.Component):
    """What is drawn, as parameters: all draws share a compiled program."""

    w1, w2, damping1, damping2 = (ac.Parameter(1.0) for _ in range(4))
    low, high, period, gain = (ac.Parameter(1.0) for _ in range(4))
    level, most, kick = (ac.Parameter(1.0) for _ in range(3))

    x, y = ac.Variable(start=1.0, fixed=True), ac.Variable(start=0.3, fixed=True)
    v = ac.Variable(start=0.0, fixed=True, state="always")
    w = ac.Variable(start=2.0, fixed=True, state="always")
    on = ac.Discrete(0, kind="bool")
    held, jumps = ac.Discrete(0.0), ac.Discrete(0.0)
    n, kicks = ac.Discrete(0, kind="int"), ac.Discrete(0, kind="int")

    def equations(self) -> Iterator[Any]:
        pre = ac.pre
        yield ac.Eq(ac.der(self.x), self.v)
        yield ac.Eq(ac.der(self.y), self.w)
        yield ac.Eq(ac.der(self.v), -(self.w1**2) * self.x - self.damping1 * self.v + self.held)
        yield ac.Eq(
            ac.der(self.w),
            -(self.w2**2) * self.y - self.damping2 * self.w + 3 * self.on + self.jumps,
        )
        yield ac.Eq(self.on, (self.x > self.high) | ((pre(self.on) > 0.5) & (self.x > self.low)))
        yield ac.When(
            ac.sample(self.period / 2, self.period),
            ac.Eq(self.held, self.gain * self.y + 0.3 * pre(self.held)),
        )
        full = pre(self.n) >= self.most
        yield ac.When(self.y > self.level, ac.Eq(self.n, ac.where(full, 0, pre(self.n) + 1)))
        yield ac.When(
            self.n >= self.most,
            ac.Eq(self.kicks, pre(self.kicks) + 1),
            ac.Reinit(self.v, pre(self.v) + self.kick),
        )
        yield ac.When(ac.change(self.kicks), ac.Eq(self.jumps, 0.5 * self.kicks - self.y))


def reference(d: Drawn, ts: np.ndarray) -> tuple[np.ndarray, np.ndarray, list[float]]:
    """States and (on, held, jumps, n, kicks) at some times, and the instants of events."""
    z, now, tick = np.array([1.0, 0.3, 0.0, 2.0]), 0.0, 0.5 * d.period
    m = {"on": float(z[0] > d.high), "held": 0.0, "jumps": 0.0, "n": 0, "kicks": 0}
    above = z[1] > d.level
    states, modes, instants = [], [], []

    def field(t: float, z: np.ndarray) -> list[float]:
        x, y, v, w = z
        return [
            v,
            w,
            -(d.w1**2) * x - d.damping1 * v + m["held"],
            -(d.w2**2) * y - d.damping2 * w + 3 * m["on"] + m["jumps"],
        ]

    def crossing(k: int, level: float) -> Callable[[float, np.ndarray], float]:
        def number(t: float, z: np.ndarray) -> float:
            return z[k] - level

        number.terminal = True  # type: ignore[attr-defined]
        return number

    while now < END:
        watched = [crossing(0, d.low if m["on"] else d.high), crossing(1, d.level)]
        watched[0].direction = -1 if m["on"] else 1  # type: ignore[attr-defined]
        watched[1].direction = -1 if above else 1  # type: ignore[attr-defined]
        stop = min(tick, END)
        found = solve_ivp(
            field,
            (now, stop),
            z,
            "DOP853",
            rtol=1e-11,
            atol=1e-12,
            events=watched,
            dense_output=True,
            max_step=0.02,  # SciPy looks for crossings between the ends of steps alone
        )
        inside = [t for t in ts if now <= t < found.t[-1]]
        states += [found.sol(t) for t in inside]
        modes += [list(m.values())] * len(inside)
        z, now = found.y[:, -1].copy(), float(found.t[-1])
        if now >= END:
            break
        instants.append(now)
        if found.status == 0:
            tick += d.period
            m["held"] = d.gain * z[1] + 0.3 * m["held"]
        elif len(found.t_events[0]):
            m["on"] = 1.0 - m["on"]
        else:
            above = not above
            if above:
                m["n"] = 0 if m["n"] >= d.most else m["n"] + 1
                if m["n"] == d.most:
                    m["kicks"] += 1
                    z[2] += d.kick
                    m["jumps"] = 0.5 * m["kicks"] - z[1]
    return np.array(states), np.array(modes), instants


@functools.cache
def compiled() -> ac.System:
    return ac.compile(Model())


@pytest.mark.cases(slow=60)
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.slow
def test_a_random_model(seed: int) -> None:
    drawn, ts = Drawn.by(seed), np.linspace(0.013, END - 0.011, 41)
    states, modes, instants = reference(drawn, ts)
    found = ac.simulate(
        compiled(),
        (0.0, END),
        saveat=ts,
        params=asdict(drawn),
        rtol=1e-9,
        atol=1e-11,
        solver="tsit5",
    )
    ours = np.array([[e.t for e in found.events]]).ravel()
    for t in instants:
        assert np.abs(ours - t).min() < 1e-6
    own = np.stack([np.asarray(found[n]) for n in ("on", "held", "jumps", "n", "kicks")], axis=1)
    np.testing.assert_allclose(own, modes, atol=1e-6)
    own = np.stack([np.asarray(found[n]) for n in "xyvw"], axis=1)
    np.testing.assert_allclose(own, states, atol=2e-6)
