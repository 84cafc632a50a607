"""The study: choose on the end of the training record, train on all of it, test in open and in closed loop."""

from __future__ import annotations

import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from scipy.signal import butter, sosfiltfilt

import acausal as ac
from acausal.components import neural
from examples.emps import figures, model
from examples.emps.model import INPUT, KINDS, OURS, OUTPUT, PULSES, REFERENCE, Kind
from examples.measured.judge import rms, simulate, spread
from examples.measured.load import load
from examples.measured.present import Row, show

H = 1e-3
"""[s]"""
TRAIN, VALIDATION, ALL = (0, 15_000), (15_000, 24_841), (0, 24_841)
"""Samples of the training record that train, that choose between models, and all."""
KNOWN = 20
"""Samples from which the state at the start of an open loop may be told."""
BORDER = 49
"""Samples at the start of a closed loop that do not count, as in the benchmark's scripts."""
PULSE = 5.0695 / 5
"""Volts of a pulse by what the record gives as its height: what is left of the voltage without the controller's."""
MIDDLE = 0.123
"""Of the way [m]."""
TERMS = ("linear", "square", "signed square", "signed root", "tanh")
"""Terms of frictions."""
CLOSED = ("position", "velocity", "acceleration", "force")

COLUMNS = {
    "validation_mm": "validation [mm]",
    "validation_velocity": "validation, speed [%]",
    "validation_force": "validation, force [%]",
    "open_loop_test_mm": "test [mm]",
    **{f"closed_loop_{name}": f"{name} [%]" for name in CLOSED},
}
PUBLISHED = (
    Row("LTI state space", {"open_loop_test_mm": 5.53}),
    Row("pNARX", {"open_loop_test_mm": 5.17}),
    Row("CT SUBNET", {"open_loop_test_mm": 4.61}),
    Row("dynoNet", {"open_loop_test_mm": 2.64}),
)
"""Root mean square errors in mm. M. D. Champneys et al.: Baseline Results for Selected Nonlinear System Identification
Benchmarks, 2024, arXiv 2405.10779.
"""

Measured = Mapping[str, np.ndarray]


def smooth(measured: Measured) -> dict[str, np.ndarray]:
    """Position, speed, acceleration and voltage below 100 Hz, by a filter of the benchmark's scripts without delay.

    The voltage is held from sample to sample: at a sample the mean of two acts.
    """
    low = np.asarray(butter(4, 100 * 2 * H, output="sos"))
    s = sosfiltfilt(low, measured["qm"])
    v = np.gradient(s, H)
    held = (measured["vir"] + np.r_[measured["vir"][0], measured["vir"][:-1]]) / 2
    return {
        OUTPUT: s,
        "carriage.v": v,
        "carriage.a": np.gradient(v, H),
        INPUT: sosfiltfilt(low, held),
    }


def record(measured: Measured, span: tuple[int, int] = ALL) -> ac.Data:
    """Smoothed signals, of which every second sample will do."""
    rows = slice(span[0] + BORDER, span[1] - BORDER, 2)
    signals = {name: x[rows] for name, x in smooth(measured).items()}
    return ac.Data(2 * H * np.arange(len(signals[OUTPUT])), signals)


def train(
    kind: Kind,
    data: ac.Data | Mapping[str, ac.Data],
    seed: int = 0,
    epochs: tuple[int, int] = (400, 120),
    **options: Any,
) -> ac.Fit:
    """Train by accelerations first, which need no simulation, then by simulations of whole records.

    Accelerations tell the inertia; what drifts does not train it.

    Arguments:
        kind: of the model.
        data: smoothed records.
        seed: of the networks.
        epochs: updates by accelerations, and by simulations.
        options: others of `acausal.fit`, of the simulations those that the first part has not: `delays`.
    """
    params, delays = None, options.pop("delays", None)
    for strategy, parameters, updates, more in (
        ("equation_error", kind.trained, epochs[0], {}),
        (
            "whole_record",
            tuple(n for n in kind.trained if n != "motor.J"),
            epochs[1],
            {"delays": delays},
        ),
    ):
        fit = ac.fit(
            kind.build(model.Axis),
            data,
            [OUTPUT, "carriage.a"],
            params=params,
            modifiers=parameters,
            gamma=0.9,
            parameter_spread=kind.parameter_spread,
            strategy=strategy,
            epochs=updates,
            seed=seed,
            progress=False,
            **more,
            **options,
        )
        params = fit.params
    return fit


def open_loop(
    system: ac.System, params: Mapping[str, Any], measured: Measured, span: tuple[int, int] = ALL
) -> tuple[np.ndarray, float]:
    """Positions when the measured voltage drives the axis, and their error in mm."""
    rows = slice(*span)
    signals = {INPUT: measured["vir"][rows], OUTPUT: measured["qm"][rows]}
    signals["carriage.v"] = np.gradient(signals[OUTPUT], H)  # a first guess where to start
    ts = H * np.arange(span[1] - span[0])
    data = ac.Data(ts, signals, interpolation={INPUT: "previous"})
    solution = simulate(system, params, data, OUTPUT, known=KNOWN, solver="heun")
    return np.asarray(solution[OUTPUT]), 1e3 * rms(solution, data, OUTPUT, known=KNOWN)


def closed_loop(
    kind: Kind, params: Mapping[str, Any], measured: Measured, span: tuple[int, int] = ALL
) -> dict[str, float]:
    """Relative errors in % when the reference drives the axis in its controller, as the benchmark takes them."""
    system, true = kind.build(model.Controlled), smooth(measured)
    rows = slice(*span)
    ts = H * np.arange(span[1] - span[0])
    pulses = PULSE * measured.get("pulses_N", np.zeros(ALL[1]))
    inputs = {
        REFERENCE: ac.Signal(ts, measured["qg"][rows]),
        PULSES: ac.Signal(ts, pulses[rows], "previous"),
    }
    own = system.parameters()
    solution = ac.simulate(
        system,
        (ts[0], ts[-1]),
        dt=H / 2,
        inputs=inputs,
        params={**own, **{n: p for n, p in params.items() if n in own}},
        x0={n: true[n][span[0]] for n in (OUTPUT, "carriage.v")},
        solver="rk4",
    )
    names = (OUTPUT, "carriage.v", "carriage.a", "limit.y")
    exact = (*(true[n] for n in names[:3]), measured["vir"])
    return {
        f"closed_loop_{told}": relative(np.asarray(solution[n])[::2], x[rows])
        for told, n, x in zip(CLOSED, names, exact, strict=True)
    }


def relative(simulated: np.ndarray, measured: np.ndarray) -> float:
    """Error in % of what was measured, both by their norms."""
    x = measured[BORDER:]
    return float(100 * np.linalg.norm(simulated[BORDER:] - x) / np.linalg.norm(x))


def judge(
    kind: Kind, params: Mapping[str, Any], measured: Measured, span: tuple[int, int] = ALL
) -> dict[str, float]:
    """Errors in open loop, in mm, and in closed loop."""
    alone = {"open_loop_test_mm": open_loop(kind.build(model.Axis), params, measured, span)[1]}
    return {**alone, **closed_loop(kind, params, measured, span)}


def chosen(kind: Kind, measured: Measured, seed: int = 0) -> dict[str, float]:
    """Errors over the end of the training record, after training on what comes before."""
    params, _ = trained(kind, measured, TRAIN, seed)
    found = judge(kind, params, measured, VALIDATION)
    return {
        "validation_mm": found["open_loop_test_mm"],
        **{f"validation_{n}": found[f"closed_loop_{n}"] for n in ("velocity", "force")},
    }


def trained(
    kind: Kind, measured: Measured, span: tuple[int, int] = ALL, seed: int = 0
) -> tuple[Mapping[str, Any], ac.Fit | None]:
    """Parameters, and the training if there is something to train."""
    if not kind.trained:
        return kind.build(model.Axis).parameters(), None
    fit = train(kind, record(measured, span), seed)
    return fit.params, fit


def run(folder: Path | None, seeds: int, out: Path) -> dict[str, Any]:
    """The whole study; returns what the line of JSON says."""
    started = time.time()
    training, test = load(folder, "EMPS", ["DATA_EMPS.mat", "DATA_EMPS_PULSES.mat"])
    models = {
        name: [
            trained(kind, training, seed=s) for s in range(seeds if kind.parameter_spread else 1)
        ]
        for name, kind in KINDS.items()
    }
    errors = {
        name: [
            {**chosen(KINDS[name], training, seed), **judge(KINDS[name], params, test)}
            for seed, (params, _) in enumerate(found)
        ]
        for name, found in models.items()
    }
    rows = [
        Row(name, mean, around if len(errors[name]) > 1 else None)
        for name, (mean, around) in ((n, spread(e)) for n, e in errors.items())
    ]
    fits = {name: m[0][1] for name, m in models.items() if m[0][1] is not None}
    net = fits[figures.PHYSICS].params["friction.net"]
    law = ac.distill(lambda v: net(v, MIDDLE), -model.SPEED, model.SPEED, among=TERMS)
    formula = KINDS[OURS].instead(lambda: neural.Resistance(net=law.formula))
    in_short = judge(formula, train(formula, record(training)).params, test)
    rows.append(Row("... its network a formula of the speed", in_short))
    show("EMPS: root mean square errors in mm, relative errors in %", COLUMNS, [*rows, *PUBLISHED])
    figures.page(out / "index.html", training, test, [*rows, *PUBLISHED], fits, law)
    mean, around = spread(errors[OURS])
    return {
        **mean,
        "spread": around,
        "distilled": in_short,
        **{row.model: dict(row.errors) for row in rows if row.model != OURS},
        "seeds": seeds,
        "seconds": time.time() - started,
    }
