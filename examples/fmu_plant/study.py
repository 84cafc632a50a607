"""Make a record of the true rig, with noise, and train the FMU's spring and the network beside it on that."""

from __future__ import annotations

import sys
import time
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np

import acausal as ac
from examples.fmu_plant.model import NET, POSITION, PUSH, SPRING as C, Rig, Rubbing

PACKAGE, NAME = "gemseo_fmu", "Mass_Damper.fmu"
REMEDY = "pip install --no-deps gemseo-fmu==3.1.1 brings it, or say where it is by --fmu."
DECLARED, SPRING = 1e4, 9e3
"""The spring's constant in the FMU, and the true one [N/m]."""

NOISE, END, SAMPLE, EPOCHS = 1e-3, 0.15, 1e-3, 30
"""Of the position [m]; of the record [s]; between its samples [s]; steps of Levenberg and Marquardt."""

SPEEDS = (5.0, 10.0, 20.0)


class Outcome(NamedTuple):
    """What was learned.

    Attributes:
        spring: its constant [N/m]. friction: the forces at `SPEEDS` [N].
        rms_before, rms: errors of the position, against the true one, of the FMU as it came and trained [m].
        seconds: of the training.
    """

    spring: float
    friction: list[float]
    rms_before: float
    rms: float
    seconds: float


def found() -> Path | None:
    """The FMU, if the package that brings it is installed; the package is not imported."""
    spec = find_spec(PACKAGE)
    folder = "win32" if sys.platform == "win32" else "linux"
    places = spec.submodule_search_locations or () if spec else ()
    paths = [Path(p) / "problems" / "fmu_files" / folder / NAME for p in places]
    return next((path for path in paths if path.is_file()), None)


def friction(v: Any) -> Any:
    """The true friction [N] at a speed [m/s]."""
    return 400.0 * np.tanh(v / 5.0)


def push(t: Any) -> Any:
    """The force [N] at a time [s]."""
    return 2000.0 * jnp.sin(70.0 * t)


def run(fmu: Path) -> Outcome:
    """Train, and compare with the truth."""
    t = np.linspace(0.0, END, round(END / SAMPLE) + 1)
    given: dict[str, Any] = {"saveat": t, "inputs": {PUSH: push}, "dt": SAMPLE, "solver": "rk4"}
    truth = ac.simulate(ac.compile(Rig(fmu, Rubbing())), END, params={C: SPRING}, **given)
    y = np.asarray(truth[POSITION])
    measured = y + NOISE * np.random.default_rng(0).standard_normal(len(t))
    data = ac.Data(t, {PUSH: np.asarray(push(t)), POSITION: measured})
    system = ac.compile(Rig(fmu))
    begun = time.perf_counter()
    fit = ac.fit(
        system, data, [POSITION], modifiers=[C], strategy="gauss_newton", epochs=EPOCHS, solver="rk4"
    )  # fmt: skip
    seconds = time.perf_counter() - begun

    def rms(params: Any) -> float:
        again = ac.simulate(system, END, params=params, **given)
        return float(np.sqrt(np.mean((np.asarray(again[POSITION]) - y) ** 2)))

    forces = [float(fit.params[NET](v)) for v in SPEEDS]
    before = rms(system.parameters(0))
    return Outcome(float(fit.params[C]), forces, before, rms(fit.params), seconds)
