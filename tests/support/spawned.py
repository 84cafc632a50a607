"""What a spawned process does for a test: it knows nothing but what it is sent."""

from typing import Any

import numpy as np

import acausal as ac

INPUTS = {"push.f": np.linspace(0.0, 10.0, 101)}


def simulated(sent: tuple[ac.System, dict[str, Any]]) -> ac.Solution:
    """A second of the oscillator under a growing force."""
    system, params = sent
    return ac.simulate(system, (0.0, 1.0), dt=0.01, inputs=INPUTS, params=params)
