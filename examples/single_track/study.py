"""The study: a campaign of manoeuvres, the tyres that it determines, and two manoeuvres that were held out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import jax
import numpy as np

import acausal as ac
from examples.measured.judge import follow
from examples.measured.present import Row, show
from examples.single_track import model
from examples.single_track.model import AXLES, LATERAL, STEER, YAW_RATE

STEP, PARTS, SECONDS = 0.01, 2, 5.0
"""Sample time [s], steps from sample to sample, and length of a record [s]."""
NOISE = {YAW_RATE: 0.005, LATERAL: 0.1}
"""Of each sensor [rad/s, m/s2]."""
TARGETS = (YAW_RATE, LATERAL)
UNITS = {YAW_RATE: "rad/s", LATERAL: "m/s2"}


def _step(t: np.ndarray) -> np.ndarray:
    return 0.05 * np.clip((t - 0.5) / 0.3, 0.0, 1.0)


def _sweep(t: np.ndarray) -> np.ndarray:
    return 0.04 * np.sin(2 * np.pi * (0.2 + 0.15 * t) * t)


def _ramp(t: np.ndarray) -> np.ndarray:
    return 0.03 * t


def _hard(t: np.ndarray) -> np.ndarray:
    return 0.12 * np.sin(2 * np.pi * 0.5 * t) * np.exp(-0.2 * t)


def _lane_change(t: np.ndarray) -> np.ndarray:
    return 0.07 * np.sin(2 * np.pi * 0.5 * (t - 0.5)) * ((t > 0.5) & (t < 2.5))


def _fast_step(t: np.ndarray) -> np.ndarray:
    return -0.09 * np.clip((t - 0.3) / 0.2, 0.0, 1.0)


TRAINED: Mapping[str, Callable[[np.ndarray], np.ndarray]] = {
    "step": _step, "sweep": _sweep, "ramp": _ramp, "hard sine": _hard
}  # fmt: skip
HELD = {"lane change": _lane_change, "fast step": _fast_step}
"""Steering angles [rad] over time [s]."""
COLUMNS = {f"{n}, {y}": f"{n}: {y} [{UNITS[y]}]" for n in HELD for y in TARGETS}


class Study(NamedTuple):
    """What came of it.

    Attributes:
        fit: of the learned tyres. records: those that were held out.
        solutions: of these, by model and record. rows: their errors by model.
    """

    fit: ac.Fit
    records: dict[str, ac.Data]
    solutions: dict[str, dict[str, ac.Solution]]
    rows: list[Row]


def measured(plant: ac.System, manoeuvre: Callable[[np.ndarray], np.ndarray], seed: int) -> ac.Data:
    """A record of the steering angle, and of what the sensors show."""
    t = np.linspace(0.0, SECONDS, round(SECONDS / STEP) + 1)
    angle, rng = manoeuvre(t), np.random.default_rng(seed)
    run = ac.simulate(plant, SECONDS, saveat=t, inputs={STEER: (t, angle)}, rtol=1e-9, atol=1e-9)
    noisy = {n: np.asarray(run[n]) + NOISE[n] * rng.standard_normal(len(t)) for n in TARGETS}
    return ac.Data(t, {STEER: angle, **noisy})


def train(system: ac.System, records: Mapping[str, ac.Data], **options: Any) -> ac.Fit:
    """Train the tyres such that yaw rate and lateral acceleration come out; every record starts as the model does."""
    wishes: dict[str, Any] = {
        "strategy": "gauss_newton", "x0": "model", "solver": "rk4", "dt": STEP / PARTS, "epochs": 40, "progress": False,
        **options,
    }  # fmt: skip
    return ac.fit(system, dict(records), list(TARGETS), **wishes)


def curve(fit: ac.Fit, axle: str, slips: np.ndarray) -> np.ndarray:
    """The learned coefficient of friction of an axle's tyre."""
    return np.asarray(jax.vmap(fit.params[f"{axle}.net"])(slips))


def truth(axle: str, slips: np.ndarray) -> np.ndarray:
    """The true one."""
    b, c, d = model.TYRES[axle].values()
    return d * np.sin(c * np.arctan(b * slips))


def compared() -> Study:
    """Learn the tyres from the campaign, and judge them beside linear ones by the manoeuvres that were held out."""
    plant = ac.compile(model.SingleTrack(model.true))
    every = {n: measured(plant, m, seed) for seed, (n, m) in enumerate({**TRAINED, **HELD}.items())}
    campaign, held = ({n: every[n] for n in names} for names in (TRAINED, HELD))
    constants = [f"{axle}.c" for axle in AXLES]
    linear = ac.compile(model.SingleTrack(model.linear))
    fits = {
        "linear tyres": train(linear, campaign, modifiers=constants),
        "learned tyres": train(ac.compile(model.SingleTrack()), campaign),
    }
    runs = {
        name: {n: follow(fit.system, fit.params, data, {}, solver="rk4", dt=STEP / PARTS) for n, data in held.items()}
        for name, fit in fits.items()
    }  # fmt: skip

    def errors(found: Mapping[str, ac.Solution]) -> dict[str, float]:
        return {
            f"{n}, {target}": float(
                np.sqrt(np.mean((np.asarray(found[n][target]) - held[n][target]) ** 2))
            )
            for n in held
            for target in TARGETS
        }

    rows = [Row(name, errors(found)) for name, found in runs.items()]
    return Study(fits["learned tyres"], held, runs, rows)


def run(out: Path) -> dict[str, Any]:
    """The whole study, with its page; returns what the line of JSON says."""
    from examples.single_track.figures import page

    found = compared()
    show("Single track: root mean square errors of held-out manoeuvres", COLUMNS, found.rows)
    page(out / "index.html", found)
    linear, learned = (row.errors for row in found.rows)
    off = {}
    for axle in AXLES:
        seen = np.quantile(found.fit.arguments[f"{axle}.net"], 0.99)
        slips = np.linspace(0.0, float(seen), 100)
        off[axle] = float(np.max(np.abs(curve(found.fit, axle, slips) - truth(axle, slips))))
    return {
        "held_rad_s": max(learned[f"{n}, {YAW_RATE}"] for n in HELD),
        "linear_held_rad_s": max(linear[f"{n}, {YAW_RATE}"] for n in HELD),
        "held_m_s2": max(learned[f"{n}, {LATERAL}"] for n in HELD),
        "linear_held_m_s2": max(linear[f"{n}, {LATERAL}"] for n in HELD),
        "friction": max(off.values()),
    }
