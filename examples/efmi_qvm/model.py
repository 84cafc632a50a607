"""The quarter vehicle of the eFMI test case, with larger networks, and the sweep that drives it.

M11_NeuralQVM has the parameters and the two networks below. A ramp is the frequency of a sine, the sine is the road's
vertical speed, and its integral the road's height. Height and range of the ramp and the amplitude of the sine are ours.
"""

from __future__ import annotations

import acausal as ac
from acausal.components import blocks, neural
from examples.qvm.model import ProgressiveSpring, QuarterVehicle, StribeckFriction

TRAVEL, SPRING_FORCE = 0.01, 25.0
"""What the spring's network is scaled by [m, N]."""
SPEED, DAMPER_FORCE = 1 / 3, 100.0
"""What the damper's network is scaled by [m/s, N]."""
WIDTH, DEPTH = 16, 3
"""Of the networks: 1-16-16-16-1."""
DURATION, SAMPLE_TIME = 60.0, 1e-3
"""[s]"""


def truth() -> QuarterVehicle:
    """The vehicle that is measured."""
    return QuarterVehicle(
        progressive=ProgressiveSpring(c1=500.0, su=0.03),
        friction=StribeckFriction(F_brk=45.0, F_C=35.0, v_brk=0.02, d=150.0),
    )


def with_networks() -> QuarterVehicle:
    """The vehicle that is trained and shipped."""
    return QuarterVehicle(
        spring_nn=neural.Compliance(
            input_scale=TRAVEL, output_scale=SPRING_FORCE, width=WIDTH, depth=DEPTH
        ),
        damper_nn=neural.Resistance(
            input_scale=SPEED, output_scale=DAMPER_FORCE, width=WIDTH, depth=DEPTH
        ),
    )


class Sweep(ac.Component):
    """A vehicle on a road whose waves get shorter and shorter."""

    def __init__(self, vehicle: QuarterVehicle) -> None:
        super().__init__()
        self.ramp = blocks.Ramp(offset=0.5, height=9.5, duration=DURATION)
        self.sine = blocks.SineVariableFrequencyAndAmplitude(
            useConstantAmplitude=True, constantAmplitude=0.08
        )
        self.vehicle = vehicle
        self.connect(self.ramp.y, self.sine.f)
        self.connect(self.sine.y, self.vehicle.road.v_ref)  # which the road integrates
