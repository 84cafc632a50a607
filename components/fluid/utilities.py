"""Signals of the examples of `Modelica.Thermal.FluidHeatFlow`."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

__modelica__ = "Modelica.Thermal.FluidHeatFlow.Examples.Utilities"


class DoubleRamp(ac.Component):
    """Two ramps, one after the other: a pump that drops out and comes back.

    ``y = offset + height_1 r_1 + height_2 r_2``, where ``r_1`` rises from 0 to 1 in ``duration_1`` [s] from
    ``startTime`` [s] on, and ``r_2`` in ``duration_2``, beginning ``interval`` [s] after the end of the first.
    """

    ICON = icons.DOUBLE_RAMP

    offset = ac.Parameter(1.0, doc="offset of the ramps")
    startTime = ac.Parameter(0.2, unit="s", doc="start of the first ramp")
    interval = ac.Parameter(0.2, unit="s", doc="time between the ramps")
    height_1 = ac.Parameter(-1.0, doc="height of the first ramp")
    duration_1 = ac.Parameter(0.2, unit="s", min=0, doc="duration of the first ramp")
    height_2 = ac.Parameter(1.0, doc="height of the second ramp")
    duration_2 = ac.Parameter(0.2, unit="s", min=0, doc="duration of the second ramp")
    y = ac.Output(doc="output signal")

    def equations(self) -> Iterator[ac.Eq]:
        second = self.startTime + self.duration_1 + self.interval
        first = self.height_1 * _rise((ac.time - self.startTime) / self.duration_1)
        yield ac.Eq(
            self.y,
            self.offset + first + self.height_2 * _rise((ac.time - second) / self.duration_2),
        )


def _rise(x: Any) -> Any:
    return ac.maximum(ac.minimum(x, 1), 0)
