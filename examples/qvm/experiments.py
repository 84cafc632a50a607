"""The five trainings of the paper, and the fast one of the demo, as settings of `ac.fit`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import optax

import acausal as ac
from examples.qvm.model import UNCERTAIN, with_networks
from examples.qvm.record import OUTPUTS, STATES, Ride

AT_REST: dict[str, float] = dict.fromkeys(STATES, 0.0)
"""The record starts at rest: the one state that is known without noise."""


@dataclass(frozen=True)
class Experiment:
    """A training and what the paper says of it.

    Attributes:
        noise: relative to each signal's standard deviation.
        wrong: whether some parameters start ten percent off.
        settings: arguments of `ac.fit`.
        paper_loss, paper_seconds_per_epoch: the paper's, read off its plots.
        bar: the loss to reach.
    """

    name: str
    title: str
    noise: float
    settings: dict[str, Any]
    paper_loss: float
    bar: float
    paper_seconds_per_epoch: float | None = None
    wrong: bool = False
    epochs: int = 1000


def fit(
    experiment: Experiment,
    ride: Ride,
    *,
    seed: int = 0,
    observers: Sequence[Any] = (),
    **settings: Any,
) -> ac.Fit:
    """Train the networks of an experiment on a ride."""
    system = ac.compile(with_networks(wrong=experiment.wrong))
    chosen: dict[str, Any] = {
        "regularizers": [ac.ZeroCrossing(0.01)],
        "epochs": experiment.epochs,
        "evaluate_every": 50,
        **experiment.settings,
        **settings,
    }
    return ac.fit(
        system,
        ride.measured,
        OUTPUTS,
        x0=AT_REST,
        solver="heun",
        seed=seed,
        observers=observers,
        **chosen,
    )


BATCH = {"sequence_length": 4.0, "batch_size": 3}

DEMO = Experiment(
    "demo",
    "12 random sequences of 1 s",
    0.02,
    {
        "sequence_length": 1.0,
        "batch_size": 12,
        "optimizer": optax.adam(optax.cosine_decay_schedule(0.02, 600, 1e-2)),
    },
    0.035,
    0.035,
    epochs=600,
)
"""Short sequences side by side: the same as the paper's batch, in a minute."""

PAPER = (
    Experiment("baseline", "baseline: 42 s, every sample", 0.02, {}, 0.035, 0.035, 120.0),
    Experiment("batch", "3 random sequences of 4 s", 0.02, BATCH, 0.035, 0.035, 24.0),
    Experiment(
        "batch_subs",
        "... and 25 % of the points",
        0.02,
        {**BATCH, "subsample": 0.25},
        0.035,
        0.035,
        17.0,
    ),
    Experiment("nsy_par", "noise x5, parameters off", 0.10, BATCH, 0.22, 0.225, wrong=True),
    Experiment(
        "paramopt",
        "... and parameters trained",
        0.10,
        {**BATCH, "modifiers": tuple(UNCERTAIN), "gamma": 0.2},
        0.145,
        0.145,
        wrong=True,
    ),
)
