"""An hour's drive of a small car: speed over time, and the current that the pack delivers for it."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

import acausal as ac

HOUR = 3600.0
MASS, ROLLING, DRAG = 1200.0, 0.011, 0.38
"""Of the car: mass in kg, rolling resistance, and air drag in N s²/m²."""

AUXILIARY, LOSS = 500.0, 0.12
"""Power for everything but driving in W, and the part of the driving power that is lost on its way."""

TOWN, LAND, MOTORWAY = (50, 32, 50, 18, 40), (80, 65, 90, 50), (115, 100, 120)
"""Speeds in km/h, between which the car changes; it stands after each round in town."""


def speed() -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Times at 1 Hz and speeds in m/s: 25 minutes in town, 15 on the land, 20 on the motorway."""
    rounds = (
        (TOWN, 12.0, 3.4, 25.0, 1500.0),
        (LAND, 40.0, 3.0, 15.0, 2400.0),
        (MOTORWAY, 90.0, 1.8, 0.0, 3570.0),
    )
    knots, speeds = [0.0, 10.0], [0.0, 0.0]
    for targets, hold, pace, pause, end in rounds:
        while knots[-1] < end:
            for target in (*targets, *([0] if pause else [])):
                ramp = max(4.0, abs(target - speeds[-1]) / pace)
                wait = hold if target else pause
                knots += [knots[-1] + ramp, knots[-1] + ramp + wait]
                speeds += [target, target]
    t = np.arange(0.0, HOUR + 1)
    slowing = np.minimum(1.0, (HOUR - 5 - t).clip(0) / 25)
    return t, np.interp(t, knots, speeds) * slowing / 3.6


def current(voltage: float) -> ac.Signal:
    """The current into a pack of a nominal voltage in A, at 1 Hz: negative while it drives the car."""
    t, v = speed()
    force = MASS * np.gradient(v, t) + DRAG * v**2 + ROLLING * 9.81 * MASS * (v > 0)
    driving = force * v
    power = np.where(driving > 0, driving * (1 + LOSS), driving * (1 - LOSS)) + AUXILIARY
    return ac.Signal(t, -power / voltage)
