"""Fits without options, beside fits by hand: ``python -m benchmarks.by_default [names]``.

Ten problems in mechanics, circuits, heat and fluids. A network stands in the place of one law, the record has 1 % of
noise. By default nothing is said but the model, the record and the target; by hand the scales are given, and the record
is followed as a whole by `rk4` from the law zero. The law's error is relative to its range over the visited inputs;
that of a fresh record, with other inputs, relative to the target.
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

import acausal as ac
from acausal.components import (
    electrical as el,
    hydraulic as hy,
    neural,
    rotational as rot,
    thermal,
    translational as tl,
)
from acausal.networks import law_of

NOISE = 0.01


class Known(eqx.Module):
    """A law, or an energy, that is known."""

    law: Callable[[Any], Any] = eqx.field(static=True)

    def __call__(self, x: Any) -> Any:
        """Its value."""
        return self.law(jnp.asarray(x))


@dataclass(frozen=True)
class Problem:
    """A model with one unknown law.

    Attributes:
        model: with a network, or with the truth by ``net=``.
        law: the truth.
        net: name of the network; ``scales`` of it, as by hand.
        end: of the record [s], with so many ``samples``, in ``records`` of equal length.
        inputs: by name, functions of time in units of ``end`` and of a number that changes the record.
        target: that is fitted.
        start: values by which records differ, of states.
    """

    model: Callable[..., ac.Component]
    law: Callable[[Any], Any]
    net: str
    scales: tuple[float, float]
    end: float
    samples: int
    inputs: Mapping[str, Callable[[Any, float], Any]]
    target: str
    records: int = 1
    start: Mapping[str, Callable[[float], float]] = field(default_factory=dict)
    energy: Callable[[Any], Any] | None = None


class Wired(ac.Component):
    """Parts and the connectors that meet."""

    def __init__(self, nodes: list[tuple[str, ...]], **parts: ac.Component) -> None:
        super().__init__()
        for name, part in parts.items():
            setattr(self, name, part)
        for node in nodes:
            ends = [name.split(".") for name in node]
            self.connect(*(getattr(parts[part], end) for part, end in ends))


def _oscillator(**own: Any) -> ac.Component:
    return Wired(
        [("wall.flange", "spring.flange_a", "element.flange_a"),
         ("spring.flange_b", "element.flange_b", "mass.flange_a"), ("mass.flange_b", "push.flange")],
        wall=tl.Fixed(), spring=tl.Spring(c=50.0), element=neural.Resistance(**own), mass=tl.Mass(m=1.0),
        push=tl.Force(),
    )  # fmt: skip


def _sprung(**own: Any) -> ac.Component:
    return Wired(
        [("wall.flange", "damper.flange_a", "element.flange_a"),
         ("damper.flange_b", "element.flange_b", "mass.flange_a"), ("mass.flange_b", "push.flange")],
        wall=tl.Fixed(), damper=tl.Damper(d=1.0), element=neural.Compliance(**own), mass=tl.Mass(m=2.0),
        push=tl.Force(),
    )  # fmt: skip


def _circuit(**own: Any) -> ac.Component:
    return Wired(
        [("source.p", "resistor.p"), ("resistor.n", "capacitor.p", "element.p"),
         ("capacitor.n", "element.n", "source.n", "ground.p")],
        source=el.SignalVoltage(), ground=el.Ground(), resistor=el.Resistor(R=1e3), capacitor=el.Capacitor(C=1e-9),
        element=neural.Resistance(el.PositivePin, **own),
    )  # fmt: skip


def _coil(**own: Any) -> ac.Component:
    return Wired(
        [("source.p", "resistor.p"), ("resistor.n", "element.p"), ("element.n", "source.n", "ground.p")],
        source=el.SignalVoltage(), ground=el.Ground(), resistor=el.Resistor(R=2.0),
        element=neural.Inductance(el.PositivePin, **own),
    )  # fmt: skip


def _house(**own: Any) -> ac.Component:
    return Wired(
        [("heater.port", "air.port", "inside.port_a", "element.port_a"), ("inside.port_b", "walls.port"),
         ("element.port_b", "weather.port")],
        air=thermal.HeatCapacitor(C=5e6, T=ac.Start(293.15, fixed=True)),
        walls=thermal.HeatCapacitor(C=8e7, T=ac.Start(291.15, fixed=True)),
        inside=thermal.ThermalConductor(G=400), heater=thermal.PrescribedHeatFlow(),
        weather=thermal.PrescribedTemperature(), element=neural.Resistance(thermal.HeatPort, **own),
    )  # fmt: skip


def _motor(**own: Any) -> ac.Component:
    return Wired(
        [("source.p", "resistor.p"), ("resistor.n", "inductor.p"), ("inductor.n", "emf.p"),
         ("emf.n", "source.n", "ground.p"), ("emf.flange", "shaft.flange_a"), ("shaft.flange_b", "element.flange_b"),
         ("element.flange_a", "housing.flange")],
        source=el.SignalVoltage(), ground=el.Ground(), resistor=el.Resistor(R=0.5), inductor=el.Inductor(L=5e-3),
        emf=el.RotationalEMF(k=0.05), shaft=rot.Inertia(J=2e-4), housing=rot.Fixed(),
        element=neural.Resistance(rot.Flange, **own),
    )  # fmt: skip


def _tanks(**own: Any) -> ac.Component:
    return Wired(
        [("pump.port", "upper.topPort"), ("upper.port", "element.port_a"),
         ("element.port_b", "lower.port", "hole.port_a"), ("hole.port_b", "drain.port")],
        pump=hy.MassFlowSource(use_m_flow_in=True), upper=hy.OpenTank(crossArea=0.02, level=ac.Start(0.15, fixed=True)),
        lower=hy.OpenTank(crossArea=0.03, level=ac.Start(0.05, fixed=True)),
        element=neural.Resistance(hy.FluidPort, **own), hole=hy.Orifice(area=6e-5), drain=hy.Boundary(),
    )  # fmt: skip


def _shaft(**own: Any) -> ac.Component:
    return Wired(
        [("drive.flange", "motor.flange_a"), ("motor.flange_b", "element.flange_a", "damper.flange_a"),
         ("element.flange_b", "damper.flange_b", "load.flange_a"), ("load.flange_b", "brake.flange_b"),
         ("brake.flange_a", "housing.flange")],
        drive=rot.Torque(), motor=rot.Inertia(J=0.1), load=rot.Inertia(J=0.3), brake=rot.Damper(d=0.2),
        damper=rot.Damper(d=0.05), housing=rot.Fixed(), element=neural.Compliance(rot.Flange, **own),
    )  # fmt: skip


def _waves(size: float, *rates: float) -> Callable[[Any, float], Any]:
    def wave(s: Any, k: float) -> Any:
        return size * sum(
            np.sin(2 * np.pi * (r * (1 + 0.07 * k) * s + 0.13 * i + 0.29 * k))
            for i, r in enumerate(rates)
        )

    return wave


PROBLEMS = {
    "friction, position": Problem(
        _oscillator, lambda v: 3 * jnp.tanh(v / 0.1) + 2 * v, "element.net", (1.0, 5.0), 20.0, 2001,
        {"push.f": _waves(6.0, 6.4, 15.9, 23.2)}, "mass.s"),
    "friction, acceleration": Problem(
        _oscillator, lambda v: 3 * jnp.tanh(v / 0.1) + 2 * v, "element.net", (1.0, 5.0), 20.0, 2001,
        {"push.f": _waves(6.0, 6.4, 15.9, 23.2)}, "mass.a"),
    "circuit in microseconds": Problem(
        _circuit, lambda v: 1e-6 * (jnp.exp(jnp.clip(v, -5, 5) / 0.15) - 1), "element.net", (1.0, 1e-3), 2e-5, 1001,
        {"source.v": _waves(0.7, 4.0, 9.3)}, "capacitor.v"),
    "house, a month": Problem(
        _house, lambda d: 150 * d + 12 * d * jnp.abs(d), "element.net", (20.0, 5000.0), 30 * 86400.0, 1441,
        {"heater.Q_flow": lambda s, k: 3000 + _waves(1500.0, 30.0, 11.0)(s, k),
         "weather.T": lambda s, k: 278.0 + _waves(5.0, 30.0, 4.3)(s, k)}, "air.T"),
    "motor's load": Problem(
        _motor, lambda w: 2e-6 * w * jnp.abs(w) + 5e-3 * jnp.tanh(w / 5), "element.net", (100.0, 0.02), 4.0, 2001,
        {"source.v": _waves(4.0, 3.0, 7.7)}, "shaft.w"),
    "tanks": Problem(
        _tanks, lambda p: 0.0025 * jnp.sign(p) * jnp.sqrt(jnp.abs(p) + 5.0), "element.net", (1000.0, 0.1), 1200.0, 1201,
        {"pump.m_flow_in": lambda s, k: 0.06 + _waves(0.025, 4.0, 15.6)(s, k)}, "upper.level"),
    "shaft": Problem(
        _shaft, lambda a: 40.0 * (a - 0.05 * jnp.tanh(a / 0.05)) + 4e3 * a**3, "element.net", (0.2, 10.0), 20.0, 4001,
        {"drive.tau": _waves(2.0, 8.0, 33.0)}, "load.w"),
    "five records": Problem(
        _sprung, lambda s: 50 * s + 400 * s**3, "element.net", (0.5, 50.0), 2.0, 201,
        {"push.f": _waves(15.0, 2.0)}, "mass.s", 5,
        {"mass.s": lambda k: 0.1 * k - 0.2, "mass.v": lambda k: 1.0 - 0.5 * k}),
    "limit cycle": Problem(
        _oscillator, lambda v: 2 * v**3 - 2 * v, "element.net", (1.0, 2.0), 60.0, 3001,
        {"push.f": _waves(0.3, 7.0, 30.0)}, "mass.s", 1, {"mass.s": lambda k: 0.1}),
    "saturating inductor": Problem(
        _coil, lambda i: 0.05 * jnp.tanh(i / 2) + 0.002 * i, "element.net", (3.0, 0.05), 0.5, 2001,
        {"source.v": _waves(4.0, 5.0, 11.0)}, "element.i", 1, {},
        lambda i: 0.1 * jnp.logaddexp(i / 2, -i / 2) + 0.001 * i**2 - 0.1 * jnp.log(2.0)),
}  # fmt: skip


def record(
    problem: Problem, noise: float, seed: int
) -> tuple[Any, dict[str, ac.Data], dict[str, ac.Data]]:
    """The true model; its records with noise, and without."""
    system = ac.compile(problem.model(net=Known(problem.energy or problem.law)))
    t = np.linspace(0.0, problem.end, problem.samples)
    generator = np.random.default_rng(seed)
    noisy, clean = {}, {}
    for k in range(problem.records):
        inputs = {n: f(t / problem.end, k + 10.0 * seed) for n, f in problem.inputs.items()}
        x0 = {n: f(float(k)) for n, f in problem.start.items()}
        run = ac.simulate(
            system, (0.0, problem.end), saveat=t, rtol=1e-9, atol=1e-12,
            inputs={n: (t, u) for n, u in inputs.items()}, x0=x0 or None,
        )  # fmt: skip
        names = dict.fromkeys((*system.states, problem.target))
        signals = {n: np.asarray(run[n]) for n in names}
        clean[f"run {k}"] = ac.Data(t, {**inputs, **signals})
        noisy[f"run {k}"] = ac.Data(
            t, {**inputs, **{n: y + noise * np.std(y) * generator.standard_normal(len(t)) for n, y in signals.items()}}
        )  # fmt: skip
    return system, noisy, clean


def law_error(problem: Problem, fit: ac.Fit) -> float:
    """The largest error of the law over what it was asked, relative to its range there."""
    seen = np.sort(fit.arguments[problem.net][:, 0])
    x = jnp.linspace(*np.quantile(seen, [0.01, 0.99]), 200)
    learned = jax.vmap(law_of(fit.params[problem.net]))(x)
    true = jax.vmap(problem.law)(x)
    return float(jnp.max(jnp.abs(learned - true)) / jnp.ptp(true))


def fresh_error(problem: Problem, fit: ac.Fit) -> float:
    """The error over another record, relative to the target."""
    _, _, clean = record(problem, 0.0, 7)
    data = clean["run 0"]
    t = np.asarray(data.time)
    try:
        run = ac.simulate(
            fit.system, (0.0, problem.end), saveat=t, params=fit.params, rtol=1e-8, atol=1e-11,
            inputs={n: (t, np.asarray(data[n])) for n in fit.system.inputs},
            x0={n: float(data[n][0]) for n in fit.system.states},
        )  # fmt: skip
    except ac.ModelError:
        return np.inf
    y = np.asarray(data[problem.target])
    return float(np.sqrt(np.mean((np.asarray(run[problem.target]) - y) ** 2)) / np.std(y))


def by_default(problem: Problem, data: Any, seed: int = 0, **more: Any) -> ac.Fit:
    """The fit that this is about."""
    return ac.fit(
        ac.compile(problem.model()), data, problem.target, seed=seed, progress=False, **more
    )


def by_hand(problem: Problem, data: Any, seed: int = 0) -> ac.Fit:
    """With scales, and the whole record at once."""
    inner, outer = problem.scales
    system = ac.compile(
        problem.model(
            input_scale=inner,
            output_scale=outer,
            activation="tanh" if problem.energy is None else None,
        )
    )
    return ac.fit(
        system,
        data,
        problem.target,
        seed=seed,
        progress=False,
        strategy="whole_record",
        solver="rk4",
    )


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.by_default", description=__doc__)
    parser.add_argument(
        "names", nargs="*", help="beginnings of the problems' names; all by default"
    )
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--alone", action="store_true", help="without the fits by hand")
    parser.add_argument("--verdict", action="store_true", help="also print what the fit says")
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    print(f"{'':24s}{'':9s}{'law':>8s}{'fresh':>8s}{'loss':>9s}{'noise':>8s}{'s':>7s}")
    for name, problem in PROBLEMS.items():
        if given.names and not any(name.startswith(n) for n in given.names):
            continue
        _, noisy, _ = record(problem, NOISE, given.seed)
        data = noisy if problem.records > 1 else noisy["run 0"]
        for label, how in (("default", by_default), ("by hand", by_hand)):
            if label == "by hand" and given.alone:
                continue
            began = time.perf_counter()
            try:
                fit = how(problem, data, given.seed)
            except ac.ModelError as error:
                print(f"{name:24s}{label:9s} {error}"[:230], flush=True)
                continue
            seconds = time.perf_counter() - began
            law, fresh = law_error(problem, fit), fresh_error(problem, fit)
            print(
                f"{name:24s}{label:9s}{100 * law:7.1f}%{100 * fresh:7.2f}%{fit.loss:9.4f}{NOISE:8.3f}{seconds:7.1f}",
                flush=True,
            )
            if given.verdict:
                print(fit, flush=True)


if __name__ == "__main__":
    main()
