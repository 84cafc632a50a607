"""The campaign: five runs of the true drive train, measured as on a test bench.

Each has a length and an excitation of its own and another offset of the torque gauge. Encoders at the motor and at the
load are sampled at 500 Hz, the gauge at 125 Hz; the gauge's cable fails for a while in one run, and in another one
sample in fifty of the motor's speed is lost. What is recorded of the drive is its command, which it follows late.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np

import acausal as ac
from examples.campaign.model import GAUGE, INPUT, OFFSET, SPEED, truth

FAST, EVERY, FINE = 2e-3, 4, 4
"""Sample time of speed and drive [s]; every so many samples the gauge is read; steps of the truth in a sample."""
NOISE = {"motor.phi": 1e-3, SPEED: 0.05, "load.phi": 1e-3, "load.w": 0.05, GAUGE: 0.01}
"""Standard deviations of the noise of both encoders and of the gauge [rad, rad/s, N.m]."""
LATE = 5.4e-3
"""The drive follows its command so much later [s]: 2.7 samples."""
SPREAD = 0.05
"""Standard deviation of the gauge's offset from run to run [N.m]."""


@dataclass(frozen=True)
class Run:
    """A run on the test bench.

    Attributes:
        drive: torque over time [N.m].
        seconds: how long.
        offset: of the gauge [N.m].
        gap: from when to when the gauge gives nothing [s].
        lost: share of the samples of the speed that are lost.
    """

    drive: Callable[[np.ndarray], np.ndarray]
    seconds: float
    offset: float
    gap: tuple[float, float] | None = None
    lost: float = 0.0

    def ends(self) -> int:
        """How many samples of the speed there are."""
        return round(self.seconds / FAST) + 1


def ramp(t: np.ndarray) -> np.ndarray:
    """Slowly up, down and up again, so that the motor creeps over its teeth."""
    return np.interp(t, (0, 2.5, 6, 8), (0, 0.75, -0.75, 0.1))


def sines(t: np.ndarray) -> np.ndarray:
    """Several tones."""
    return 0.45 * np.sin(2.1 * t) + 0.3 * np.sin(7.3 * t + 1) + 0.25 * np.sin(23 * t + 2)


def chirp(t: np.ndarray) -> np.ndarray:
    """From 1 to 30 Hz, past the resonance of the shaft, on a constant torque."""
    return 0.35 + 0.5 * np.sin(2 * np.pi * (t + 29 * t**2 / 12))


def steps(t: np.ndarray) -> np.ndarray:
    """Torques in turn, half a second each."""
    levels = np.array((0.3, 0.8, -0.5, 0.6, -0.8, 0.0, 0.5, -0.3, 0.7, -0.6))
    return levels[(t / 0.5).astype(int) % len(levels)]


def reversal(t: np.ndarray) -> np.ndarray:
    """Back and forth, ever faster."""
    return 0.7 * np.sin(2 * np.pi * (0.4 * t + 0.15 * t**2))


RUNS: Mapping[str, Run] = {
    "ramp": Run(ramp, 8.0, 0.06),
    "sines": Run(sines, 5.0, -0.04),
    "chirp": Run(chirp, 6.0, 0.01, gap=(2.0, 3.5)),
    "steps": Run(steps, 5.0, -0.07),
    "reversal": Run(reversal, 4.0, 0.03, lost=0.02),
}


@cache
def campaign() -> dict[str, ac.Data]:
    """The records, by name."""
    system = truth()
    return {name: _measured(system, run, seed) for seed, (name, run) in enumerate(RUNS.items())}


def _measured(system: ac.System, run: Run, seed: int) -> ac.Data:
    rng = np.random.default_rng(seed)
    t = FAST * np.arange(run.ends())
    drive = ac.Signal(t, run.drive(t)).delayed(LATE)
    params = {**system.parameters(), OFFSET: run.offset}
    solution = ac.simulate(
        system, (0, t[-1]), dt=FAST / FINE, inputs={INPUT: drive}, params=params, solver="rk4"
    )
    measured = {
        n: np.asarray(solution[n])[::FINE] + rng.normal(0, sigma, len(t))
        for n, sigma in NOISE.items()
    }
    measured[SPEED] = np.where(rng.uniform(size=len(t)) < run.lost, np.nan, measured[SPEED])
    slow = t[::EVERY]
    gauge = measured.pop(GAUGE)[::EVERY]
    if run.gap is not None:
        gauge = np.where((slow >= run.gap[0]) & (slow < run.gap[1]), np.nan, gauge)
    fast = {n: (t, y) for n, y in {INPUT: run.drive(t), **measured}.items()}
    return ac.Data(signals={**fast, GAUGE: (slow, gauge)}, missing="nan")
