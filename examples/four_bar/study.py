"""The study: a record of the motor's torque, the friction that it determines, and a slower record that was held out."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import jax
import numpy as np

import acausal as ac
from examples.four_bar import model
from examples.four_bar.model import ANGLE, FRICTION, JOINT, RATE, SPEED, TORQUE
from examples.measured.judge import follow
from examples.measured.present import Row, show

STEP, NOISE = 0.01, 0.02
"""Sample time and step [s], and the noise of the torque [N.m]."""
SPEEDS = {"trained": (5.0, 3.0), "held": (3.5, 1.0)}
"""Of each record, the mean speed of the crank and how far it swings around that [rad/s]."""
COLUMNS = {"trained": "trained [N.m]", "held": "held out [N.m]"}


class Study(NamedTuple):
    """What came of it.

    Attributes:
        fit: of the learned friction. records: by name, as measured.
        solutions: of the held-out record by model.
        rows: errors of the torque by model.
    """

    fit: ac.Fit
    records: dict[str, ac.Data]
    solutions: dict[str, ac.Solution]
    rows: list[Row]


def measured(plant: ac.System, name: str, seconds: float = 6.0, seed: int = 0) -> ac.Data:
    """A record of the torque with noise, of the crank's angle and of its speed."""
    t = np.linspace(0.0, seconds, round(seconds / STEP) + 1)
    mean, swing = SPEEDS[name]
    wanted = mean + swing * np.sin(2 * np.pi * t / seconds)
    inputs, start = {SPEED: (t, wanted)}, {RATE: wanted[0]}
    run = ac.simulate(plant, seconds, inputs=inputs, x0=start, dt=STEP, solver="rk4")
    noise = NOISE * np.random.default_rng(seed).standard_normal(len(t))
    torque = np.asarray(run[TORQUE]) + noise
    seen = {ANGLE: np.asarray(run[ANGLE]), RATE: np.asarray(run[RATE])}
    return ac.Data(t, {SPEED: wanted, TORQUE: torque, **seen})


def train(system: ac.System, record: ac.Data, **options: Any) -> ac.Fit:
    """Train a friction such that the motor's torque comes out."""
    wishes: dict[str, Any] = {
        "strategy": "gauss_newton", "x0": "data", "solver": "rk4", "epochs": 30, "progress": False, **options
    }  # fmt: skip
    return ac.fit(system, record, [TORQUE], **wishes)


def curve(fit: ac.Fit, speeds: np.ndarray) -> np.ndarray:
    """The learned friction [N.m] at some speeds."""
    return np.asarray(jax.vmap(fit.params[FRICTION])(speeds))


def truth(speeds: np.ndarray) -> np.ndarray:
    """The true one, without the smooth change of sign about rest."""
    p = {n: float(d.default) for n, d in vars(model.Worn).items() if isinstance(d, ac.Parameter)}
    return p["c"] + p["b"] * np.exp(-((speeds / p["w_s"]) ** 2)) + p["d"] * speeds


def simulated(fit: ac.Fit, record: ac.Data) -> ac.Solution:
    """A record with what was learned."""
    start = {name: float(record[name][0]) for name in (ANGLE, RATE)}
    return follow(fit.system, fit.params, record, start, solver="rk4", dt=STEP)


def compared() -> Study:
    """Learn the friction from a record, and judge it beside viscous friction by the torque of another."""
    plant = ac.compile(model.FourBar(model.Worn()))
    records = {name: measured(plant, name, seed=i) for i, name in enumerate(SPEEDS)}
    fits = {
        "viscous friction": train(
            ac.compile(model.FourBar(model.Viscous())), records["trained"], modifiers=["friction.d"]
        ),
        "learned friction": train(ac.compile(model.FourBar()), records["trained"]),
    }
    runs = {n: {r: simulated(fit, records[r]) for r in records} for n, fit in fits.items()}

    def errors(found: Mapping[str, ac.Solution]) -> dict[str, float]:
        off = {r: np.asarray(found[r][TORQUE]) - records[r][TORQUE] for r in records}
        return {r: float(np.sqrt(np.mean(error**2))) for r, error in off.items()}

    rows = [Row(name, errors(found)) for name, found in runs.items()]
    return Study(
        fits["learned friction"], records, {n: found["held"] for n, found in runs.items()}, rows
    )


def run(out: Path) -> dict[str, Any]:
    """The whole study, with its page; returns what the line of JSON says."""
    from examples.four_bar.figures import page

    found = compared()
    show("Four-bar: root mean square error of the motor's torque", COLUMNS, found.rows)
    page(out / "index.html", found)
    seen = np.abs(np.asarray(found.solutions["learned friction"][JOINT]))
    speeds = np.linspace(0.1, float(seen.max()), 100)
    off = curve(found.fit, speeds) - truth(speeds)
    return {
        "held_Nm": found.rows[1].errors["held"],
        "viscous_held_Nm": found.rows[0].errors["held"],
        "friction_Nm": float(np.sqrt(np.mean(off**2))),
    }
