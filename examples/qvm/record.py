"""The data: a ride over a rough road, measured with noise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import acausal as ac
from examples.qvm.model import truth

SAMPLE_TIME, DURATION = 1e-3, 42.0
"""[s]"""
INPUT = "road.v_ref"
STATES = ("body.s", "body.v", "wheel.s", "wheel.v", "road.s")
OUTPUTS = ("body.a", "wheel.a")
SUBSTEPS = 2


@dataclass(frozen=True)
class Ride:
    """One trajectory of the true vehicle.

    Attributes:
        clean: states, outputs and input without noise.
        measured: the same, with Gaussian noise on states and outputs.
        noise: standard deviation of the noise relative to that of each signal.
    """

    clean: ac.Data
    measured: ac.Data
    noise: float


def rough_road(
    seed: int,
    *,
    scale: float,
    roughness: float = 64e-6,
    speed: float = 10.0,
    waves: int = 1000,
    band: tuple[float, float] = (0.011, 2.83),
) -> tuple[np.ndarray, np.ndarray]:
    """Vertical speed of an ISO 8608 road under a wheel, at 1 kHz.

    The height is the sum of waves sqrt(2 Gd(n) dn) cos(2 pi n x + phi) with Gd(n) = Gd(0.1) (n / 0.1)^-2;
    its derivative in time is taken wave by wave.

    Arguments:
        scale: factor on the height. roughness: Gd(0.1) [m^3]. speed: of the vehicle [m/s].
        waves: number of equal cells that the band of wave numbers [1/m] is cut into.

    Returns:
        Times [s] and speeds [m/s].
    """
    width = (band[1] - band[0]) / waves
    wave_number = band[0] + width * (np.arange(waves) + 0.5)
    amplitude = scale * np.sqrt(2 * roughness * (wave_number / 0.1) ** -2 * width)
    phase = np.random.default_rng(seed).uniform(0, 2 * np.pi, waves)
    omega = 2 * np.pi * wave_number * speed
    time = SAMPLE_TIME * np.arange(round(DURATION / SAMPLE_TIME) + 1)
    velocity = np.zeros_like(time)
    for w, a, p in zip(omega, amplitude, phase, strict=True):
        velocity -= a * w * np.sin(w * time + p)
    return time, velocity


def ride(noise: float, *, road_seed: int = 1, noise_seed: int = 0, scale: float = 1.12) -> Ride:
    """Drive the true vehicle over a road and measure it.

    Arguments:
        noise: standard deviation of the noise relative to each signal's own.
        scale: factor on the road's height; the default gives suspension speeds of about 0.14 m/s (1 sigma).
    """
    time, velocity = rough_road(road_seed, scale=scale)
    system = ac.compile(truth())
    road = ac.Signal(time, velocity)
    solution = ac.simulate(
        system,
        (0.0, DURATION),
        dt=SAMPLE_TIME / SUBSTEPS,
        saveat=time,
        inputs={INPUT: road},
        solver="rk4",
    )
    signals = {name: np.asarray(solution[name]) for name in (*STATES, *OUTPUTS)}
    generator = np.random.default_rng(noise_seed)
    noisy = {n: s + noise * s.std() * generator.standard_normal(len(s)) for n, s in signals.items()}
    return Ride(
        clean=ac.Data(time, {INPUT: velocity, **signals}),
        measured=ac.Data(time, {INPUT: velocity, **noisy}),
        noise=noise,
    )
