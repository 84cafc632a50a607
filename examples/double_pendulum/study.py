"""The study: learn the joints' friction from measured swings, and predict swings that were held out."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

import acausal as ac
from examples.double_pendulum import figures, model
from examples.double_pendulum.model import ANGLES, ARMS, DRAG, SPEEDS
from examples.measured.judge import follow
from examples.measured.present import Row, show

SWINGS = 26
HELD = (4, 11, 18, 25)
"""Swings that train nothing."""
EVERY, STEP = 10, 0.01
"""Of the samples, 1 ms apart, those that are used; so long is a step [s]."""
UPDATES = 40
COLUMNS = {"trained": "trained [rad]", "held": "held out [rad]"}


def load(folder: Path | None) -> dict[int, ac.Data]:
    """The swings of a folder, or of its folder ``double_pendulum``, by their numbers.

    Raises:
        DataError: if they are not there.
    """
    places = () if folder is None else (folder, folder / "double_pendulum")
    for place in places:
        files = {i: place / f"swing_{i:02d}.csv" for i in range(1, SWINGS + 1)}
        if all(file.is_file() for file in files.values()):
            return {i: _swing(file) for i, file in files.items()}
    raise ac.DataError(
        f"There is no swing_01.csv to swing_{SWINGS}.csv in {folder}; the swings of the repository "
        "dynamicslab/MultiArm-Pendulum are not part of this project. Say where they are by --data."
    )


def _swing(file: Path) -> ac.Data:
    rows = np.loadtxt(file, delimiter=",", skiprows=1)[::EVERY]
    return ac.Data(rows[:, 0], dict(zip((*ANGLES, *SPEEDS), rows[:, 1:5].T, strict=True)))


def train(
    swings: Mapping[int, ac.Data], numbers: Sequence[int], seed: int = 0, **options: Any
) -> ac.Fit:
    """Train friction, drag and the numbers of the arms, together with how each swing starts."""
    wishes: dict[str, Any] = {
        "modifiers": (*ARMS, DRAG),
        "strategy": "gauss_newton",
        "x0": "fit",
        "epochs": UPDATES,
        "solver": "rk4",
        "progress": False,
        **options,
    }
    records = {f"swing {i}": swings[i] for i in numbers}
    return ac.fit(model.learned(), records, list(ANGLES), seed=seed, **wishes)


def simulated(system: ac.System, params: Mapping[str, Any], swing: ac.Data) -> ac.Solution:
    """A swing from its first sample."""
    start = {name: float(swing[name][0]) for name in (*ANGLES, *SPEEDS)}
    return follow(system, params, swing, start, solver="rk4", dt=STEP)


def error(system: ac.System, params: Mapping[str, Any], swings: Sequence[ac.Data]) -> float:
    """Root mean square error of both angles [rad], of each swing from its first sample, on average."""
    found: list[float] = []
    for swing in swings:
        solution = simulated(system, params, swing)
        off = [np.asarray(solution[name]) - swing[name] for name in ANGLES]
        found.append(float(np.sqrt(np.mean(np.square(off)))))
    return float(np.mean(found))


def run(folder: Path | None, seeds: int, out: Path) -> dict[str, Any]:
    """The whole study; returns what the line of JSON says."""
    started = time.time()
    swings = load(folder)
    trained = [i for i in swings if i not in HELD]
    known = model.published()
    fits = [train(swings, trained, seed) for seed in range(seeds)]
    fit = min(fits, key=lambda one: one.score)

    def errors(system: ac.System, params: Mapping[str, Any]) -> dict[str, float]:
        groups = {"trained": trained, "held": HELD}
        return {n: error(system, params, [swings[i] for i in g]) for n, g in groups.items()}

    rows = [
        Row("viscous joints, published numbers", errors(known, known.parameters())),
        Row("learned friction", errors(fit.system, fit.params)),
    ]
    show("Double pendulum: root mean square error from the first sample", COLUMNS, rows)
    figures.page(out / "index.html", swings, rows, fit)
    return {
        "held_rad": rows[1].errors["held"],
        "published_held_rad": rows[0].errors["held"],
        "trained_rad": rows[1].errors["trained"],
        "seeds": seeds,
        "seconds": time.time() - started,
    }
