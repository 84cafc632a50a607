"""The study: choose on a part of the training record, train on all of it, test as the benchmark prescribes."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import acausal as ac
from examples.cascaded_tanks import figures, model
from examples.cascaded_tanks.model import INPUT, MODELS, OURS, OUTPUT, PROMISING
from examples.measured.judge import follow, rms, simulate, spread
from examples.measured.load import load
from examples.measured.present import Row, show

SAMPLE_TIME, STEP = 4.0, 2.0
"""[s]"""
SAMPLES, CHOSEN = 1024, 700
"""Of a record; and how many of the training record train where the others choose between models."""
KNOWN = 5
"""Samples from which the state at the test's start may be told."""
SOLVER, EPOCHS = "rk4", 600
SMALL = ac.SmallCorrection(1e-3, ("curve.net",))
"""What the sensor's curve adds to a straight line is as little as the data allow."""

COLUMNS = {"validation": "validation", "test": "test"}
PUBLISHED = (
    Row("LTI state space", {"test": 0.588}),
    Row("NLSS2", {"test": 0.34}),
    Row("TSEM", {"test": 0.33}),
    Row("CT SUBNET", {"test": 0.306}),
    Row("best grey box", {"test": 0.18}),
)
"""Root mean square errors in V. M. D. Champneys et al.: Baseline Results for Selected Nonlinear System Identification
Benchmarks, 2024, arXiv 2405.10779, and what it cites.
"""


@dataclass(frozen=True)
class Trained:
    """A model that was trained on a first part of the training record, and then on all of it.

    Attributes:
        first, fit: both results.
        errors: in V; over the rest of the training record for the one, over the test record for the other.
    """

    first: ac.Fit
    fit: ac.Fit
    errors: dict[str, float]


def record(u: np.ndarray, y: np.ndarray, samples: int = SAMPLES) -> ac.Data:
    """The first samples of a measurement. The pump's voltage is held between two of them."""
    signals = {INPUT: u[:samples], OUTPUT: y[:samples]}
    return ac.Data(SAMPLE_TIME * np.arange(samples), signals, interpolation={INPUT: "previous"})


def train(
    measured: Mapping[str, np.ndarray],
    make: Callable[[], model.Model],
    *,
    seeds: int = 1,
    epochs: int = EPOCHS,
) -> list[Trained]:
    """Train a model from several random starts, and judge each."""
    tanks, moves = make()
    system = ac.compile(tanks)
    learns = any(callable(value) for value in system.parameters().values())
    return [
        trained(
            measured,
            system,
            moves,
            system.parameters(seed),
            regularizers=[SMALL] if learns else [],
            epochs=epochs,
        )
        for seed in range(seeds if learns else 1)
    ]


def trained(
    measured: Mapping[str, np.ndarray],
    system: ac.System,
    moves: Mapping[str, float],
    start: Mapping[str, Any],
    then: Mapping[str, Any] | None = None,
    *,
    regularizers: Sequence[ac.SmallCorrection] = (),
    epochs: int = EPOCHS,
) -> Trained:
    """Train from parameters, on a first part of the record, then on all of it.

    The second training begins with parameters ``then``, by default where the first one ended: from scratch both floods
    of the record together lead some seeds astray.
    """

    def fit(samples: int, params: Mapping[str, Any]) -> ac.Fit:
        return ac.fit(
            system,
            record(measured["uEst"], measured["yEst"], samples),
            [OUTPUT],
            params=params,
            modifiers=moves,
            regularizers=regularizers,
            strategy="whole_record",
            x0="fit",
            epochs=epochs,
            dt=STEP,
            solver=SOLVER,
            progress=False,
        )

    first = fit(CHOSEN, start)
    final = fit(SAMPLES, first.params if then is None else then)
    errors = {
        "validation": validation_error(measured, first),
        "test": test_error(measured, final, final.params),
    }
    return Trained(first, final, errors)


def validation_error(measured: Mapping[str, np.ndarray], fit: ac.Fit) -> float:
    """Error in V over what a training did not see of the training record, where simulation goes on."""
    data = record(measured["uEst"], measured["yEst"])
    went = follow(fit.system, fit.params, data, fit.x0, solver=SOLVER, dt=STEP)
    return rms(went, data, OUTPUT, known=CHOSEN)


def tested(
    measured: Mapping[str, np.ndarray], fit: ac.Fit, params: Mapping[str, Any]
) -> ac.Solution:
    """A simulation of the test record.

    Both records start from the same state, says the benchmark. So the upper level, which is not measured, is the one
    found in training; the lower one comes from the first samples.
    """
    data = record(measured["uVal"], measured["yVal"])
    given = {"upper.level": fit.x0["upper.level"]}
    return simulate(
        fit.system, params, data, OUTPUT, known=KNOWN, solver=SOLVER, dt=STEP, given=given
    )


def test_error(measured: Mapping[str, np.ndarray], fit: ac.Fit, params: Mapping[str, Any]) -> float:
    """Error in V over the test record, with the parameters of a fit or others."""
    data = record(measured["uVal"], measured["yVal"])
    return rms(tested(measured, fit, params), data, OUTPUT, known=KNOWN)


def distilled(fit: ac.Fit) -> dict[str, ac.Distilled]:
    """Formulas for the networks, where the record has been."""
    spans = {name: np.quantile(seen[:, 0], [0.0, 1.0]) for name, seen in fit.arguments.items()}
    return {n: ac.distill(fit.params[n], *span.tolist()) for n, span in spans.items()}


def in_short(
    measured: Mapping[str, np.ndarray], make: Callable[[], model.Model], learned: Trained
) -> Trained:
    """Formulas in the place of networks, trained on."""
    start, then = (
        {**fit.params, **{n: d.formula for n, d in distilled(fit).items()}}
        for fit in (learned.first, learned.fit)
    )
    return trained(measured, learned.fit.system, make()[1], start, then)


def middle(found: list[Trained]) -> Trained:
    """The one that is neither good nor bad, by the validation part."""
    return sorted(found, key=lambda t: t.errors["validation"])[len(found) // 2]


def run(folder: Path | None, seeds: int, out: Path) -> dict[str, Any]:
    """The whole study; returns what the line of JSON says."""
    started = time.time()
    (measured,) = load(folder, "Cascaded_Tanks", ["dataBenchmark.mat"])
    models = {name: train(measured, make, seeds=seeds) for name, make in MODELS.items()}
    shown = {name: middle(found).fit for name, found in models.items()}
    averages = {name: spread([t.errors for t in found]) for name, found in models.items()}
    formulas = {
        name: in_short(measured, MODELS[name], middle(models[name])) for name in (OURS, PROMISING)
    }
    rows: list[Row] = []
    for name, (mean, around) in averages.items():
        rows.append(Row(name, mean, around if len(models[name]) > 1 else None))
        if name in formulas:
            rows.append(Row("... distilled, trained on", formulas[name].errors))
    rows += PUBLISHED
    show("Cascaded Tanks: root mean square error in V", COLUMNS, rows)
    short = {name: found.fit for name, found in formulas.items()}
    figures.page(out / "index.html", measured, rows, shown, short)
    mean, around = averages[OURS]
    return {
        "test_V": mean["test"],
        "validation_V": mean["validation"],
        "spread_V": around,
        "distilled_V": {name: short.errors for name, short in formulas.items()},
        **{name: dict(zip(("mean", "spread"), averages[name], strict=True))
           for name in models if name != OURS},
        "seeds": seeds,
        "training_seconds": float(np.mean([t.fit.seconds for t in models[OURS]])),
        "seconds": time.time() - started,
    }  # fmt: skip
