"""The study: train on a part of the training record, choose on another, test as the benchmark prescribes."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import acausal as ac
from examples.measured.judge import rms, simulate, spread
from examples.measured.load import load
from examples.measured.present import Row, show
from examples.silverbox import figures, model
from examples.silverbox.model import INPUT, KINDS, OURS, OUTPUT, Kind

SAMPLE_TIME = 2**14 / 1e7
"""[s]"""
TRAIN, VALIDATION = (81_000, 97_000), (97_000, 105_712)
"""Samples of the training record, [40650, 105712), that train, and that choose between models."""
TESTS = {
    "multisine": (105_712, 127_400),
    "arrow_no_extrapolation": (100, 32_100),
    "arrow_full": (100, 40_575),
}
KNOWN = 50
"""Samples from which the state at a test's start may be told."""
SOLVER = "tsit5"

COLUMNS = {
    "validation": "validation",
    "multisine": "multisine",
    "arrow_no_extrapolation": "arrow, no extrapolation",
    "arrow_full": "arrow, full",
}
PUBLISHED = (
    Row("LTI state space", {"multisine": 6.96, "arrow_no_extrapolation": 6.58, "arrow_full": 14.4}),
    Row("GP NARX", {"multisine": 0.301, "arrow_no_extrapolation": 0.259, "arrow_full": 0.60}),
    Row("DT SUBNET", {"multisine": 0.36, "arrow_no_extrapolation": 0.32, "arrow_full": 1.4}),
    Row("PNLSS", {"arrow_full": 0.26}),
)
"""Root mean square errors in mV. M. D. Champneys et al.: Baseline Results for Selected Nonlinear System Identification
Benchmarks, 2024, arXiv 2405.10779.
"""


@dataclass(frozen=True)
class Trained:
    """A trained model and its errors in mV."""

    fit: ac.Fit
    errors: dict[str, float]


def record(measured: Mapping[str, np.ndarray], span: tuple[int, int]) -> ac.Data:
    """A part of the measurement. The generator's filter leaves nothing above half the sampling rate."""
    rows = slice(*span)
    ts = SAMPLE_TIME * np.arange(span[1] - span[0])
    signals = {INPUT: measured["V1"][rows], OUTPUT: measured["V2"][rows]}
    return ac.Data(ts, signals, interpolation={INPUT: "band-limited"})


def train(measured: Mapping[str, np.ndarray], kind: Kind, *, seeds: int = 1) -> list[Trained]:
    """Train a kind of model from several random starts, and judge each."""
    system, data = ac.compile(kind.build()), record(measured, TRAIN)
    wishes: dict[str, Any] = {
        "modifiers": kind.trained,
        "gamma": 0.9,
        "strategy": "whole_record",
        "x0": "fit",
        "epochs": kind.epochs,
        "solver": SOLVER,
        "progress": False,
    }
    if seeds > 1:
        fits = ac.ensemble(system, data, [OUTPUT], members=seeds, **wishes).fits
    else:
        fits = (ac.fit(system, data, [OUTPUT], **wishes),)
    return [Trained(fit, errors(measured, system, fit.params)) for fit in fits]


def errors(
    measured: Mapping[str, np.ndarray], system: ac.System, params: Mapping[str, Any]
) -> dict[str, float]:
    """Errors in mV over the validation part and the tests."""
    spans = {"validation": VALIDATION, **TESTS}
    return {name: error(measured, system, params, span) for name, span in spans.items()}


def error(
    measured: Mapping[str, np.ndarray],
    system: ac.System,
    params: Mapping[str, Any],
    span: tuple[int, int],
) -> float:
    """Root mean square error in mV over a part of the measurement."""
    data = record(measured, span)
    solution = simulate(system, params, data, OUTPUT, known=KNOWN, solver=SOLVER)
    return 1e3 * rms(solution, data, OUTPUT, known=KNOWN)


def middle(trained: Sequence[Trained]) -> ac.Fit:
    """The one in the middle by its error over the validation part."""
    return sorted(trained, key=lambda t: t.errors["validation"])[len(trained) // 2].fit


def distilled(trained: ac.Fit) -> dict[str, ac.Distilled]:
    """Formulas for the networks, where they were trained."""
    reach = {"spring_nn.net": model.REACH, "damper_nn.net": model.SPEED}
    return {n: ac.distill(trained.params[n], -x, x) for n, x in reach.items()}


def run(folder: Path | None, seeds: int, out: Path) -> dict[str, Any]:
    """The whole study; returns what the line of JSON says."""
    started = time.time()
    (measured,) = load(folder, "Silverbox", ["SNLS80mV.mat"])
    models = {
        name: train(measured, kind, seeds=min(seeds, kind.seeds)) for name, kind in KINDS.items()
    }
    averages = {name: spread([t.errors for t in trained]) for name, trained in models.items()}
    fits = {name: middle(trained) for name, trained in models.items()}
    formulas = distilled(fits[OURS])
    short = {n: d.formula for n, d in formulas.items()}
    in_short = errors(measured, fits[OURS].system, {**fits[OURS].params, **short})
    mean, around = averages[OURS]
    rows = [
        *(
            Row(name, found, deviation if len(models[name]) > 1 else None)
            for name, (found, deviation) in averages.items()
        ),
        Row("... its networks distilled", in_short),
        *PUBLISHED,
    ]
    show("Silverbox: root mean square error in mV", COLUMNS, rows)
    everyone = ac.Ensemble(tuple(t.fit for t in models[OURS]))
    figures.page(out / "index.html", measured, rows, fits, everyone, formulas)
    return {
        **{f"{name}_mV": mean[name] for name in COLUMNS},
        "spread_mV": around,
        "distilled_mV": in_short,
        **{name: averages[name][0] for name in models if name != OURS},
        "seeds": seeds,
        "training_seconds": models[OURS][0].fit.seconds,
        "seconds": time.time() - started,
    }
