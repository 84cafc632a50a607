"""``python -m examples.qvm.promises``: what promises of the networks cost or bring on the quarter vehicle.

The same short training for several ways to make both networks: loss over the whole record, the same against outputs
without noise, and errors of the learned forces within two sigma, both less their value at zero.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass, field
from statistics import median
from typing import Any

import optax
from rich.console import Console
from rich.table import Table

import acausal as ac
from acausal.components import neural
from examples.qvm.experiments import AT_REST
from examples.qvm.judge import Verdict, judge
from examples.qvm.model import FORCE_SCALE, SPEED_SCALE, TRAVEL_SCALE, QuarterVehicle
from examples.qvm.record import OUTPUTS, Ride, ride

NOISE = 0.02
UPDATES = 500


@dataclass(frozen=True)
class Way:
    """How both networks are made: options of the spring and of the damper, and what else is in the loss."""

    name: str
    spring: dict[str, Any] = field(default_factory=dict[str, Any])
    damper: dict[str, Any] = field(default_factory=dict[str, Any])
    regularizers: tuple[Any, ...] = ()


OFFSET, EXACT = {"zero_crossing": "offset"}, {"zero_crossing": "exact"}
FRICTION = {"passive": True, "odd": True}

WAYS = (
    Way("no promise"),
    Way("zero by a regularizer", regularizers=(ac.ZeroCrossing(0.01),)),
    Way("zero by offset", OFFSET, OFFSET),
    Way("zero exactly", EXACT, EXACT),
    Way("damper passive", EXACT, {"passive": True}),
    Way("damper passive, odd", EXACT, FRICTION),
    Way("..., spring an energy", {"energy": True, **OFFSET}, FRICTION),
    Way("both passive", {"passive": True}, {"passive": True}),
    Way("damper monotone", EXACT, {"monotone": True, **EXACT}),
    Way("both monotone", {"monotone": True, **EXACT}, {"monotone": True, **EXACT}),
)


def vehicle(way: Way) -> QuarterVehicle:
    """The quarter vehicle with both networks made that way."""
    return QuarterVehicle(
        spring_nn=neural.Compliance(
            input_scale=TRAVEL_SCALE, output_scale=FORCE_SCALE, **way.spring
        ),
        damper_nn=neural.Resistance(
            input_scale=SPEED_SCALE, output_scale=FORCE_SCALE, **way.damper
        ),
    )


def train(way: Way, data: Ride, seed: int) -> Verdict:
    """A short training: 12 sequences of 0.25 s in each update."""
    fit = ac.fit(
        ac.compile(vehicle(way)),
        data.measured,
        OUTPUTS,
        x0=AT_REST,
        regularizers=way.regularizers,
        sequence_length=0.25,
        batch_size=12,
        epochs=UPDATES,
        optimizer=optax.adam(optax.cosine_decay_schedule(0.02, UPDATES, 1e-2)),
        seed=seed,
    )
    return judge(fit, data)


def main() -> None:
    """Print a row for every way: medians over the seeds."""
    parser = argparse.ArgumentParser(prog="python -m examples.qvm.promises", description=__doc__)
    parser.add_argument("--seeds", type=int, default=3, help="trainings of each way")
    seeds = range(parser.parse_args().seeds)
    data = ride(NOISE)
    table = Table("", "loss", "without noise", "spring [N]", "damper [N]")
    for way in WAYS:
        runs = [train(way, data, seed) for seed in seeds]
        table.add_row(
            way.name,
            f"{median(v.loss for v in runs):.4f}",
            f"{median(v.loss_clean for v in runs):.4f}",
            f"{median(v.spring_error for v in runs):.2f}",
            f"{median(v.damper_error for v in runs):.2f}",
        )
    Console().print(table)


if __name__ == "__main__":
    main()
