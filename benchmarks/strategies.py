"""Compare ways to train the quarter vehicle: ``python -m benchmarks.strategies``.

Over the ride of 42 s with noise of 2 %: both networks, from random weights; and seven parameters of the model that is
true, from values up to 30 % off. Seconds are those of updates, without compilation and evaluation.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Mapping
from typing import Any

import jax.numpy as jnp
import numpy as np
import optax

import acausal as ac
from examples.qvm.judge import loss
from examples.qvm.model import truth, with_networks
from examples.qvm.record import OUTPUTS, STATES, Ride, ride

NOISE, OFF = 0.02, 0.3
"""Of the measured signals, relative; of the parameters at the start, at most."""

RECORD = {"x0": dict.fromkeys(STATES, 0.0)}
"""The ride starts at rest."""

Legs = tuple[Mapping[str, Any], ...]
"""Arguments of `acausal.fit`, of one training after the other."""


def _pieces(seconds: float, count: int, epochs: int, **others: Any) -> Mapping[str, Any]:
    return {"sequence_length": seconds, "batch_size": count, "epochs": epochs, **others}


WHOLE: dict[str, Any] = {"strategy": "whole_record", "epochs": 150, **RECORD}
EQUATIONS: dict[str, Any] = {"strategy": "equation_error", "epochs": 150, **RECORD}
SHOOTING: dict[str, Any] = {"x0": "fit", "optimizer": ac.lbfgs(), "epochs": 300}
NETWORKS: dict[str, Legs] = {
    "equation error, then L-BFGS over the record": (EQUATIONS, WHOLE),
    "... both in float32": ({**EQUATIONS, "dtype": jnp.float32}, {**WHOLE, "dtype": jnp.float32}),
    "... 110 updates in float32, 40 in float64": (
        EQUATIONS,
        {**WHOLE, "epochs": 110, "dtype": jnp.float32},
        {**WHOLE, "epochs": 40},
    ),
    "Adam on 0.1 s, then L-BFGS over the record": (_pieces(0.1, 64, 450), WHOLE),
    "Adam on 0.1 s, 1 s, 10 s, then L-BFGS over the record": (
        _pieces(0.1, 64, 150),
        _pieces(1.0, 16, 150),
        _pieces(10.0, 4, 150),
        WHOLE,
    ),
    "Adam on 168 x 0.25 s, rate falling as a cosine": (_pieces(0.25, 168, 300),),
    "... constant": (_pieces(0.25, 168, 300, optimizer=optax.adam(1e-2)),),
    "... rising, then falling": (
        _pieces(0.25, 168, 300, optimizer=optax.adam(optax.cosine_onecycle_schedule(300, 3e-2))),
    ),
    "L-BFGS, shooting from 210 points": (_pieces(0.2, 210, **SHOOTING),),
    "... from 2,100 points": (_pieces(0.02, 2_100, **SHOOTING),),
}
"""Ways to train networks."""

PARAMETERS: dict[str, Legs] = {
    "L-BFGS over the record": (WHOLE,),
    "Gauss-Newton over the record": ({**WHOLE, "strategy": "gauss_newton"},),
}
"""Ways to find parameters."""

UNKNOWN = (
    "suspension.c",
    "suspension.d",
    "progressive.c1",
    "friction.F_C",
    "friction.F_brk",
    "tyre.c",
    "tyre.d",
)


def main() -> None:
    """Train, print a table and one JSON line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", choices=("networks", "parameters"), help="one of both tasks")
    only, driven = parser.parse_args().only, ride(NOISE)
    found: dict[str, Any] = {}
    if only != "parameters":
        system = ac.compile(with_networks())
        found["networks"] = _table(NETWORKS, system, system.parameters(0), driven)
    if only != "networks":
        system = ac.compile(truth())
        found["parameters"] = _table(
            PARAMETERS, system, _off(system), driven, modifiers=UNKNOWN, gamma=2 * OFF
        )
    print(json.dumps(found))


def _off(system: ac.System) -> dict[str, Any]:
    """Parameters, some of them wrong."""
    params, random = system.parameters(), np.random.default_rng(0)
    return {**params, **{n: params[n] * (1 + random.uniform(-OFF, OFF)) for n in UNKNOWN}}


def _table(
    ways: Mapping[str, Legs], system: ac.System, start: Any, driven: Ride, **others: Any
) -> dict[str, dict[str, float]]:
    found: dict[str, dict[str, float]] = {}
    for name, legs in ways.items():
        params, updates, seconds, left = start, 0, 0.0, float("nan")
        for leg in legs:
            options: dict[str, Any] = {"evaluate_every": 10_000, "progress": False, **others, **leg}
            fit = ac.fit(system, driven.measured, OUTPUTS, params=params, **options)
            updates += fit.history.epochs
            seconds += fit.history.epochs * fit.seconds_per_epoch
            params, left = fit.params, fit.loss
        clean = loss(system, params, driven.clean, driven)
        found[name] = {"updates": updates, "seconds": seconds, "loss": left, "clean": clean}
        print(
            f"{name:<55} {updates:4d} updates  {seconds:6.1f} s  loss {left:.4f}  without noise {clean:.4f}",
            flush=True,
        )
    return found


if __name__ == "__main__":
    main()
