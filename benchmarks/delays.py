"""``python -m benchmarks.delays``: a delay of 3.7 samples, found beside four parameters and two networks.

The quarter vehicle of `examples.qvm` with 2 % of noise, its four uncertain parameters ten percent off, and a road that
arrives late, or an accelerometer that does. Prints how far the delays found are from the truth, in samples, and what an
update costs with a delay and with a lag, over one without.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Mapping
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import optax

import acausal as ac
from acausal.training import FitOptions
from acausal.training.build_problem import build_problem
from acausal.training.objective.problem import Problem
from acausal.training.objective.whole_record import over_whole_record
from examples.qvm.experiments import AT_REST
from examples.qvm.model import UNCERTAIN, truth, with_networks
from examples.qvm.record import INPUT, OUTPUTS, SAMPLE_TIME, STATES, rough_road

TRUE = 3.7 * SAMPLE_TIME
"""The delay [s]."""

NOISE = 0.02
"""Relative to each signal's standard deviation."""

TIMED = 40
"""Updates of which the shortest counts."""


SETTINGS: dict[str, Any] = {
    "x0": AT_REST,
    "modifiers": tuple(UNCERTAIN),
    "gamma": 0.2,
    "regularizers": [ac.ZeroCrossing(0.01)],
    "sequence_length": 1.0,
    "batch_size": 12,
}
"""Sequences of a second."""


def late_ride(seconds: float, *, road: float = 0.0, sensor: float = 0.0) -> ac.Data:
    """A measured ride, on which the road arrives late, or what the wheel's accelerometer shows."""
    ts, velocity = rough_road(1, scale=1.12)
    rows = ts <= seconds
    ts, velocity = ts[rows], velocity[rows]
    solution = ac.simulate(
        ac.compile(truth()),
        (0.0, float(ts[-1])),
        dt=SAMPLE_TIME / 2,
        saveat=ts,
        inputs={INPUT: ac.Signal(ts, velocity).delayed(road)},
        solver="rk4",
    )
    signals = {n: np.asarray(solution[n]) for n in (*STATES, *OUTPUTS)}
    shown = ac.Signal(ts, signals["wheel.a"], "cubic").delayed(sensor)
    signals["wheel.a"] = np.asarray(jax.vmap(shown)(ts))
    generator = np.random.default_rng(0)
    noisy = {n: s + NOISE * s.std() * generator.standard_normal(len(s)) for n, s in signals.items()}
    return ac.Data(ts, {INPUT: velocity, **noisy})


def train(data: ac.Data, epochs: int, **options: Any) -> ac.Fit:
    """Train networks and parameters on sequences of a second."""
    return ac.fit(
        ac.compile(with_networks(wrong=True)),
        data,
        OUTPUTS,
        **SETTINGS,
        optimizer=optax.adam(optax.cosine_decay_schedule(0.02, epochs, 1e-2)),
        epochs=epochs,
        evaluate_every=epochs // 10,
        progress=False,
        **options,
    )


def found(data: ac.Data, name: str, epochs: int) -> dict[str, float]:
    """How a delay is found that starts at none."""
    start = time.perf_counter()
    fit = train(data, epochs, delays={name: ac.Delay()})
    return {
        "samples": fit.delays[name] / SAMPLE_TIME,
        "error_samples": abs(fit.delays[name] - TRUE) / SAMPLE_TIME,
        "loss_before": fit.loss_before,
        "loss": fit.loss,
        "largest_parameter_error": max(abs(fit.modifiers[n] - m) for n, m in UNCERTAIN.items()),
        "seconds": time.perf_counter() - start,
    }


def costs(data: ac.Data) -> dict[str, dict[str, float]]:
    """What the loss and its gradient cost with delays and lags over those without: the shortest times of many."""
    wheel, road = "wheel.a", INPUT
    kinds: dict[str, dict[str, Any]] = {
        "nothing": {},
        "input delay": {"delays": {road: ac.Delay()}},
        "sensor delay": {"delays": {wheel: ac.Delay()}},
        "sensor lag": {"lags": {wheel: ac.Lag(0.002)}},
    }
    system = ac.compile(with_networks(wrong=True))
    named = {"ride": data.for_system(system)}

    def problem(**options: Any) -> Problem:
        chosen = FitOptions(**{**SETTINGS, "regularizers": (), **options})
        return build_problem(system, named, OUTPUTS, dict(system.parameters(0)), chosen)

    sequences = {n: problem(**options) for n, options in kinds.items()}
    wholes = {n: over_whole_record(p) for n, p in sequences.items()}
    return {"sequences": _costs(sequences), "whole record": _costs(wholes)}


def _costs(problems: Mapping[str, Problem]) -> dict[str, float]:
    update = eqx.filter_jit(
        lambda problem, z, batch: jax.value_and_grad(lambda z: jnp.mean(problem.losses(z, batch)))(
            z
        )
    )
    arguments = {n: (p, p.start(), p.draw(jax.random.key(0))) for n, p in problems.items()}
    shortest = dict.fromkeys(problems, np.inf)
    for _ in range(TIMED):
        for name, given in arguments.items():
            start = time.perf_counter()
            jax.block_until_ready(update(*given))
            shortest[name] = min(shortest[name], time.perf_counter() - start)
    nothing = shortest.pop("nothing")
    return {"nothing, ms": 1e3 * nothing} | {n: s / nothing for n, s in shortest.items()}


def main() -> None:
    """Measure, and print JSON."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.delays", description=__doc__)
    parser.add_argument("--seconds", type=float, default=42.0, help="length of the ride")
    parser.add_argument("--epochs", type=int, default=600, help="updates of a training")
    parser.add_argument("--costs", action="store_true", help="measure the costs alone")
    options = parser.parse_args()
    late_road = late_ride(options.seconds, road=TRUE)
    report: dict[str, Any] = {"cost": costs(late_road)}
    if not options.costs:
        late_sensor = late_ride(options.seconds, sensor=TRUE)
        report["true_samples"] = TRUE / SAMPLE_TIME
        report["input"] = found(late_road, INPUT, options.epochs)
        report["sensor"] = found(late_sensor, "wheel.a", options.epochs)
    print(json.dumps(report, indent=1))


if __name__ == "__main__":
    main()
