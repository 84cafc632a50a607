"""Several starts: how often they find the true minimum, and what they cost. ``python -m benchmarks.starts``

1. An oscillator whose stiffness starts at a quarter of the truth, from one start and from 32.
2. Two masses with a spring, a damper and a smooth Coulomb friction between them and to the ground: five parameters with
   bounds a decade wide, from 20 random given starts, alone and with 31 others beside each.
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np

import acausal as ac
from acausal.components import translational as tl

TRUE = {"first.m": 2.0, "second.m": 0.7, "spring.c": 300.0, "spring.d": 2.0, "friction.Fc": 3.0}
"""Parameters of the two masses."""

BOUNDS = {n: ac.Bounded(v / 10**0.5, v * 10**0.5) for n, v in TRUE.items()}
NOISE = 0.01
"""Of the position's standard deviation."""

FOUND = 0.05
"""The true minimum is found where all parameters are off by less than this part."""


class Coulomb(tl.PartialCompliantWithRelativeStates):
    """``f = Fc tanh(v_rel / v_small)``."""

    Fc = ac.Parameter(unit="N")
    v_small = ac.Parameter(0.01, unit="m/s")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, self.Fc * ac.tanh(self.v_rel / self.v_small))


class TwoMasses(ac.Component):
    """A mass on a spring that rubs on the ground is pushed, and pulls another one by a spring."""

    def __init__(self) -> None:
        super().__init__()
        at_rest = {"s": ac.Start(0.0, fixed=True), "v": ac.Start(0.0, fixed=True)}
        self.ground, self.push = tl.Fixed(), tl.Force()
        self.friction = Coulomb(Fc=TRUE["friction.Fc"])
        self.mount = tl.Spring(c=100.0)
        self.first = tl.Mass(m=TRUE["first.m"], **at_rest)
        self.spring = tl.SpringDamper(c=TRUE["spring.c"], d=TRUE["spring.d"])
        self.second = tl.Mass(m=TRUE["second.m"], **at_rest)
        self.connect(self.ground.flange, self.friction.flange_a)
        self.connect(self.ground.flange, self.mount.flange_a)
        self.connect(self.mount.flange_b, self.first.flange_a)
        self.connect(self.friction.flange_b, self.first.flange_a, self.push.flange)
        self.connect(self.first.flange_b, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.second.flange_a)


class Oscillator(ac.Component):
    """A mass on a spring and a weak damper, let go at 1 m."""

    def __init__(self) -> None:
        super().__init__()
        self.fixed, self.spring = tl.Fixed(), tl.SpringDamper(c=50.0, d=0.2)
        self.mass = tl.Mass(m=2.0, s=ac.Start(1.0, fixed=True), v=ac.Start(0.0, fixed=True))
        self.connect(self.fixed.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.mass.flange_a)


def oscillator() -> tuple[ac.System, ac.Data]:
    """A record of 20 s, some 16 periods."""
    system, ts = ac.compile(Oscillator()), np.arange(2001) * 0.01
    solution = ac.simulate(system, (0, 20), dt=0.01)
    noise = np.random.default_rng(0).normal(0, 0.005, len(ts))
    return system, ac.Data(ts, {"mass.s": np.asarray(solution["mass.s"]) + noise})


def two_masses() -> tuple[ac.System, ac.Data]:
    """A record of 10 s: steps of the push and a chirp, both positions with noise."""
    system, ts = ac.compile(TwoMasses()), np.arange(2001) * 0.005
    push = 8 * np.sign(np.sin(2 * ts)) + 6 * np.sin(4 * ts + 2 * ts**2)
    inputs = {"push.f": push}
    solution = ac.simulate(system, (0, 10), dt=0.005, inputs=inputs, solver="rk4")
    rng = np.random.default_rng(0)
    signals = {"push.f": push}
    for name in ("first.s", "second.s"):
        s = np.asarray(solution[name])
        signals[name] = s + rng.normal(0, NOISE * s.std(), len(s))
    return system, ac.Data(ts, signals)


def found(fit: ac.Fit, true: dict[str, float]) -> bool:
    """Whether a training is at the true minimum."""
    return all(abs(float(fit.params[n]) / v - 1) < FOUND for n, v in true.items())


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--trials", type=int, default=20, help="random given starts (20)")
    trials = parser.parse_args().trials
    warnings.simplefilter("ignore")
    system, data = oscillator()
    bounds = {"spring.c": ac.Bounded(5.0, 500.0), "spring.d": ac.Bounded(0.02, 2.0)}
    for strategy in ("gauss_newton", "whole_record"):
        for starts in (1, 32):
            fit = ac.fit(
                system,
                data,
                "mass.s",
                params={"spring.c": 12.5},
                modifiers=bounds,
                strategy=strategy,
                x0="model",
                starts=starts,
                progress=False,
            )
            print(
                f"oscillator, {strategy}, {starts:2} starts: c = {fit.params['spring.c']:.2f} (50), loss "
                f"{fit.loss:.4f}, {fit.seconds:.1f} s, of these {fit.compile_seconds:.1f} s compiling"
            )
    print(fit.starts)
    system, data = two_masses()
    options: dict[str, Any] = {
        "modifiers": BOUNDS,
        "strategy": "gauss_newton",
        "x0": "model",
        "solver": "rk4",
        "progress": False,
    }
    rng = np.random.default_rng(1)
    hits = {1: 0, 32: 0}
    for trial in range(trials):
        # not quite at the bounds, where the logistic curve is flat
        shares = rng.uniform(0.02, 0.98, len(TRUE))
        given = {n: v * 10 ** (u - 0.5) for (n, v), u in zip(TRUE.items(), shares, strict=True)}
        line, counted = [], ""
        for starts in hits:
            began = time.perf_counter()
            fit = ac.fit(
                system,
                data,
                ["first.s", "second.s"],
                params=given,
                starts=starts,
                seed=trial,
                **options,
            )
            hits[starts] += found(fit, TRUE)
            line.append(
                f"{starts} starts: loss {fit.loss:.4f} {'found' if found(fit, TRUE) else 'missed'} in "
                f"{time.perf_counter() - began:.1f} s (compiling {fit.compile_seconds:.1f} s)"
            )
            counted = "" if fit.starts is None else fit.starts.summary()
        print(f"trial {trial:2}  {'; '.join(line)}. {counted}", flush=True)
    for starts, count in hits.items():
        print(f"two masses, {starts} starts: {count} of {trials} find the true minimum")


if __name__ == "__main__":
    main()
