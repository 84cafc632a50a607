"""``python -m benchmarks.calibration``: how often the band of two sigmas of `confidence()` contains the true law.

A mass on a spring, with a damper or a progressive spring that a network learns, is simulated with the true law, and
measured with white noise. For every draw of the noise a network is trained by Gauss-Newton, and its band compared with
the truth where the law was visited. Prints, by problem, the share of points at which the band contains it, the mean
width of the band over the spread of the learned laws, and how far the laws are from the truth on average.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

import acausal as ac
from acausal.components import neural, translational as tl

NOISE = 0.02
"""Relative to each signal's standard deviation."""

SAMPLE_TIME, LONG = 0.01, 8.0
"""Of the records [s]."""


class Friction(tl.PartialCompliantWithRelativeStates):
    """The true damper."""

    def equations(self) -> Iterator[ac.Eq]:
        """Smooth friction."""
        yield from super().equations()
        yield ac.Eq(self.f, friction(self.v_rel, ac.tanh))


def friction(v: Any, tanh: Callable[[Any], Any] = np.tanh) -> Any:
    """Its force [N] at a speed [m/s]."""
    return 2 * tanh(v / 0.4) + 2 * v


class Progressive(tl.PartialCompliant):
    """The true spring beside the linear one."""

    def equations(self) -> Iterator[ac.Eq]:
        """Cubic."""
        yield from super().equations()
        yield ac.Eq(self.f, progressive(self.s_rel))


def progressive(s: Any) -> Any:
    """Its force [N] at a displacement [m]."""
    return 60 * s**3 + 10 * s


class Oscillator(ac.Component):
    """A mass on a spring and a damper, pushed by a force, with something beside them."""

    def __init__(self, beside: ac.Component) -> None:
        super().__init__()
        self.wall, self.mass, self.push = tl.Fixed(), tl.Mass(m=1.0), tl.Force()
        self.spring, self.beside = tl.SpringDamper(c=50.0, d=1.0), beside
        self.connect(self.wall.flange, self.spring.flange_a, self.beside.flange_a)
        self.connect(self.spring.flange_b, self.beside.flange_b, self.mass.flange_a)
        self.connect(self.mass.flange_b, self.push.flange)


class Case(NamedTuple):
    """A problem.

    Attributes:
        truth, learner: the elements beside the spring. law: the true law.
        target: what is measured besides the states. starts: of the records [s].
        modifiers: parameters that are trained beside the law.
        states: those that are measured.
    """

    truth: Callable[[], ac.Component]
    learner: Callable[[], ac.Component]
    law: Callable[[Any], Any]
    target: str
    starts: tuple[float, ...] = (0.0,)
    modifiers: tuple[str, ...] = ()
    states: tuple[str, ...] = ("mass.s", "mass.v")


def _damper() -> ac.Component:
    return neural.Resistance(input_scale=1.0, output_scale=3.0, width=6, depth=1, activation="tanh")


def _spring() -> ac.Component:
    return neural.Compliance(input_scale=0.4, output_scale=6.0, width=6, depth=1, activation="tanh")


CASES = {
    "friction, position measured": Case(Friction, _damper, friction, "mass.s"),
    "friction, acceleration measured": Case(Friction, _damper, friction, "mass.a"),
    "spring, three records of a position": Case(
        Progressive, _spring, progressive, "mass.s", (0.0, 3.0, 6.0)
    ),
    "friction and a mass": Case(Friction, _damper, friction, "mass.a", modifiers=("mass.m",)),
    "spring, its speed not measured": Case(
        Progressive, _spring, progressive, "mass.s", (3.0,), states=("mass.s",)
    ),
}


def force(t: np.ndarray) -> np.ndarray:
    """The push [N]."""
    return 8 * np.sin(2 * t) + 4 * np.sin(5 * t + 1) + 4 * np.sin(7.3 * t)


def records(case: Case) -> dict[str, ac.Data]:
    """What happens without noise."""
    end = max(case.starts) + LONG
    t = np.linspace(0, end, round(end / SAMPLE_TIME) + 1)
    true = ac.simulate(
        ac.compile(Oscillator(case.truth())), (0, end), saveat=t, rtol=1e-9, atol=1e-10,
        inputs={"push.f": (t, force(t))},
    )  # fmt: skip
    names = dict.fromkeys((*case.states, case.target))
    data = ac.Data(t, {"push.f": force(t), **{n: np.asarray(true[n]) for n in names}})
    return {f"from {a:g} s": data.between(a, a + LONG) for a in case.starts}


def noisy(data: dict[str, ac.Data], rng: np.random.Generator) -> dict[str, ac.Data]:
    """The same, measured."""

    def one(record: ac.Data) -> ac.Data:
        signals = {n: np.asarray(record[n]) for n in record.signals}
        shaken = {
            n: x + (n != "push.f") * NOISE * x.std() * rng.standard_normal(len(x))
            for n, x in signals.items()
        }
        return ac.Data(np.asarray(record.time), shaken)

    return {name: one(record) for name, record in data.items()}


class Found(NamedTuple):
    """Laws at some points, their standard deviations, and whether the band contains the truth there."""

    law: np.ndarray
    sigma: np.ndarray
    inside: np.ndarray


def measure(case: Case, draws: int, **options: Any) -> tuple[np.ndarray, list[Found]]:
    """The true law at some visited points, and what each draw of the noise finds."""
    clean, system = records(case), ac.compile(Oscillator(case.learner()))
    chosen: dict[str, Any] = {
        "strategy": "gauss_newton", "epochs": 60, "solver": "rk4", "progress": False,
        "modifiers": case.modifiers, **options,
    }  # fmt: skip
    found, points = list[Found](), np.zeros(0)
    for seed in range(draws):
        fit = ac.fit(system, noisy(clean, np.random.default_rng(seed)), [case.target], **chosen)
        band = fit.confidence().laws["beside.net"]
        if not len(points):
            points = np.quantile(fit.arguments["beside.net"][:, 0], np.linspace(0.02, 0.98, 60))
        low, high = (np.interp(points, band.x, edge) for edge in band.bounds)
        truth = case.law(points)
        law = np.asarray(jax.vmap(fit.params["beside.net"])(jnp.asarray(points)))
        sigma = np.interp(points, band.x, band.sigma)
        found.append(Found(law, sigma, (low <= truth) & (truth <= high)))
    return case.law(points), found


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--draws", type=int, default=20)
    parser.add_argument("--x0", default="auto", help="where records start: auto, data, fit")
    parser.add_argument("--only", default="", help="part of a problem's name")
    chosen = parser.parse_args()
    print(f"{'problem':<38} {'inside':>8} {'worst draw':>11} {'width':>7} {'off':>7}")
    for name, case in CASES.items():
        if chosen.only not in name:
            continue
        began = time.perf_counter()
        truth, found = measure(case, chosen.draws, x0=chosen.x0)
        laws, sigma = (np.stack([getattr(f, n) for f in found]) for n in ("law", "sigma"))
        inside = np.stack([f.inside for f in found]).mean(axis=1)
        spread = np.sqrt(np.mean(np.var(laws, axis=0)))
        width = np.sqrt(np.mean(sigma**2)) / spread
        off = np.sqrt(np.mean((laws.mean(axis=0) - truth) ** 2)) / spread
        print(
            f"{name:<38} {100 * inside.mean():6.0f} % {100 * inside.min():9.0f} % {width:7.2f} {off:7.2f}"
            f"   ({(time.perf_counter() - began) / chosen.draws:.1f} s a draw)", flush=True,
        )  # fmt: skip


if __name__ == "__main__":
    main()
