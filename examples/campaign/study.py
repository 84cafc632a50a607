"""The study: train on all runs, leave out each in turn, and compare with the truth."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import jax
import numpy as np
import optax
from rich.console import Console

import acausal as ac
from examples.campaign import figures
from examples.campaign.model import GAUGE, INPUT, OFFSET, SPEED, TRAINED, learning, truth
from examples.campaign.runs import LATE, RUNS, SPREAD, campaign

UPDATES = 600
TARGETS = (SPEED, GAUGE)
SPEEDS, ANGLES = np.linspace(-13, 13, 401), np.linspace(0, 2 * np.pi / 6, 201)
"""Where laws are compared [rad/s, rad]."""

Law = Callable[[np.ndarray], np.ndarray]


def options(updates: int = UPDATES) -> dict[str, Any]:
    """How to train: on half seconds of any run, from measured states, each run with an offset of its own.

    In simulations of whole runs a wrong friction would turn the motor to the wrong tooth, where no gradient shows the
    way back.
    """
    return {
        "modifiers": TRAINED,
        "gamma": 0.6,
        "per_record": {OFFSET: SPREAD},
        "delays": {INPUT: ac.Delay(0.0, max=0.02)},
        "sequence_length": 0.5,
        "batch_size": 8,
        "epochs": updates,
        "evaluate_every": max(1, updates // 20),
        "optimizer": optax.adam(optax.cosine_decay_schedule(0.03, updates, 0.01)),
        "solver": "rk4",
    }


@dataclass(frozen=True)
class Study:
    """What the campaign tells.

    Attributes:
        fit: trained on all runs.
        crossed: each run left out in turn.
        seconds: from the start, everything.
    """

    fit: ac.Fit
    crossed: ac.CrossValidation
    seconds: float


def study(updates: int = UPDATES, seed: int = 0, progress: bool = True) -> Study:
    """Train and cross-validate; both share one compiled program."""
    began = time.perf_counter()
    system, records = learning(), campaign()
    chosen = options(updates)
    fit = ac.fit(system, records, TARGETS, seed=seed, progress=progress, **chosen)
    crossed = ac.cross_validate(system, records, TARGETS, seed=seed, progress=progress, **chosen)
    return Study(fit, crossed, time.perf_counter() - began)


def law(fit: ac.Fit, network: str) -> Law:
    """A learned law."""
    return jax.jit(jax.vmap(fit.params[network]))


def true_friction(w: np.ndarray) -> np.ndarray:
    """The true friction over the speed [N.m]."""
    p = {n.partition(".")[2]: float(v) for n, v in truth().parameters().items() if "friction" in n}
    dry = p["dry"] + p["stick"] * np.exp(-((w / p["w_stick"]) ** 2))
    return dry * np.tanh(w / p["w_small"]) + p["viscous"] * w


def true_cogging(phi: np.ndarray) -> np.ndarray:
    """The true cogging over the angle [N.m]."""
    p = truth().parameters()
    return p["cogging.first"] * np.sin(6 * phi) + p["cogging.second"] * np.sin(12 * phi + 0.5)


def errors_of_laws(fit: ac.Fit) -> dict[str, float]:
    """Root mean square errors of the learned laws [N.m]."""
    pairs = {
        "friction": (law(fit, "friction.net")(SPEEDS), true_friction(SPEEDS)),
        "cogging": (law(fit, "cogging.net")(ANGLES), true_cogging(ANGLES)),
    }
    return {n: float(np.sqrt(np.mean((np.asarray(a) - b) ** 2))) for n, (a, b) in pairs.items()}


def parameters(found: Study) -> list[tuple[str, str, str, str, str]]:
    """By parameter: its unit, where it started, what all runs and the folds say, and the truth."""
    exact, start, system = truth().parameters(), learning().parameters(), learning()
    rows = [
        (
            f"{name} [{system.unit(name)}]",
            f"{start[name]:.4g}",
            f"{float(found.fit.params[name]):.4g}",
            "{:.4g} ± {:.1g}".format(*found.crossed.parameters[name]),
            f"{exact[name]:.4g}",
        )
        for name in TRAINED
    ]
    late = found.crossed.parameters[f"delay({INPUT})"]
    all_runs = f"{1e3 * found.fit.delays[INPUT]:.4g}"
    folds = f"{1e3 * late.mean:.4g} ± {1e3 * late.deviation:.1g}"
    return [*rows, ("delay of the drive [ms]", "0", all_runs, folds, f"{1e3 * LATE:.4g}")]


def offsets(fit: ac.Fit) -> list[tuple[str, str, str]]:
    """By run: the offset found and the true one [N.m]."""
    return [
        (name, f"{fit.records[name].parameters[OFFSET]:+.4f}", f"{run.offset:+.4f}")
        for name, run in RUNS.items()
    ]


def run(out: Path, updates: int = UPDATES, seed: int = 0) -> dict[str, Any]:
    """Do it, print it, write the page; returns the figures."""
    found = study(updates, seed)
    console = Console(width=120)
    console.print(repr(found.fit), repr(found.crossed), sep="\n", highlight=False, markup=False)
    for row in (*parameters(found), *offsets(found.fit)):
        console.print("  ".join(row), highlight=False, markup=False)
    told = {
        "loss": found.fit.loss,
        "loss_held_out": found.crossed.held_out_loss.mean,
        **{f"law_{n}": e for n, e in errors_of_laws(found.fit).items()},
        **{f"rms_held_out_{n}": s.mean for n, s in found.crossed.rms.items()},
        "seconds": found.seconds,
    }
    page = figures.page(found, out)
    console.print(f"{page}")
    return told
