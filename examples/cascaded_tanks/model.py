"""A pump, two tanks one above the other, and a level sensor: known physics, and networks for what is uncertain.

Water runs out of each tank through a hole at its bottom. What flows over the rim of the upper one falls partly into the
lower one. Sizes are not published, and levels in volts tell only ratios. So the tanks, which look alike, have a cross
section of 100 cm2, a rim at 15 cm and the same hole here, and six volts are about ten centimetres.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import acausal as ac
from acausal.components import blocks, hydraulic as hy, neural

INPUT, OUTPUT, CURVE = "drive.u", "saturation.y", "sensor.net"
RIM = 0.15
"""How high the rims are [m]."""
LEVELS = (0.055, 0.16)
"""Lower levels that the training record tells of [m]."""
OUTFLOW: dict[str, Any] = {
    "passive": True,
    "monotone": True,
    "extrapolation": "linear",
    "limits": (0.0, 1600.0),
}
"""Promises of an outflow: no water runs upwards, more under more pressure [Pa], and linearly so beyond the data."""

Model = tuple[ac.Component, dict[str, Any]]
"""A model, and how far its parameters may be trained: modifiers of `acausal.fit`."""

WIDTH = ac.Bounded(0, math.inf)
FLOWS = {"drive.k": 0.9, "over.width": WIDTH, "past.width": WIDTH, "spill.width": WIDTH}
LINE = {"sensor.y0": ac.Shift(2.0), "sensor.k": 0.9}
HOLE, STICKING = {"upper_hole.area": 0.9}, {"slack.uMax": 0.9}
RISING: dict[str, Any] = {
    "monotone": True,
    "start": 3.0,
    "extrapolation": "linear",
    "limits": LEVELS,
}
"""Promises of the sensor's curve, which starts with 60 V/m."""


class Straight(blocks.SISO):
    """``y = y0 + k u``."""

    y0 = ac.Parameter(-1.0, doc="output at zero")
    k = ac.Parameter(60.0, doc="slope")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.y0 + self.k * self.u)


class CascadedTanks(ac.Component):
    """A pump fills the upper tank, which runs out, and over, into the lower one, whose level is measured.

    Arguments:
        holes: what lets water out at the bottoms of the upper and the lower tank.
        sensor: the voltage over the level, a block.
        rims: whether tanks overflow.
        sticks: whether the sensor's float rests until the level is some way off.
    """

    def __init__(
        self,
        holes: tuple[ac.Component, ac.Component],
        sensor: ac.Component,
        *,
        rims: bool = True,
        sticks: bool = False,
    ) -> None:
        super().__init__()
        self.drive, self.pump = blocks.Gain(k=6e-3), hy.MassFlowSource(use_m_flow_in=True)
        self.upper, self.lower = (hy.OpenTank(crossArea=0.01, level=ac.Start(0.09)) for _ in "ab")
        (self.upper_hole, self.lower_hole), self.drain = holes, hy.Boundary()
        self.connect(self.drive.y, self.pump.m_flow_in)
        self.connect(self.pump.port, self.upper.topPort)
        self._lead(self.upper.port, self.upper_hole, self.lower.topPort)
        self._lead(self.lower.port, self.lower_hole, self.drain.port)
        if rims:
            self.over, self.past = hy.Weir(height=RIM, width=0.04), hy.Weir(height=RIM, width=0.02)
            self.spill = hy.Weir(height=RIM, width=0.004)
            self._lead(self.upper.port, self.over, self.lower.topPort)
            self._lead(self.upper.port, self.past, self.drain.port)
            self._lead(self.lower.port, self.spill, self.drain.port)
        self.sensor, self.saturation = sensor, blocks.Limiter(uMax=10.0)
        self.connect(self._float() if sticks else self.lower.level, sensor.u)
        self.connect(sensor.y, self.saturation.u)

    def _lead(self, start: hy.FluidPort, element: Any, end: hy.FluidPort) -> None:
        self.connect(start, element.port_a)
        self.connect(element.port_b, end)

    def _float(self) -> Any:
        """Where the float is: it rests while the level is near, and else follows within seconds."""
        self.off, self.slack = blocks.Feedback(), blocks.DeadZone(uMax=1e-3)
        self.float = blocks.Integrator(k=0.5, y_start=0.09)
        self.connect(self.lower.level, self.off.u1)
        self.connect(self.float.y, self.off.u2)
        self.connect(self.off.y, self.slack.u)
        self.connect(self.slack.y, self.float.u)
        return self.float.y


def linear() -> Model:
    """Two tanks that never overflow, whose outflow rises linearly with the level."""
    upper = hy.LinearResistance(k=1e-5)
    holes = upper, hy.LinearResistance(k=upper.k)
    trained = {"drive.k": 0.9, "upper_hole.k": 0.9, **LINE}
    return CascadedTanks(holes, Straight(), rims=False), trained


def white_box() -> Model:
    """Torricelli's law, rims, and a sensor whose voltage rises linearly with the level."""
    return CascadedTanks(_holes(), Straight()), {**FLOWS, **HOLE, **LINE}


def curved(**promises: Any) -> Model:
    """The white box with a learned curve in place of the sensor's straight line, and a float that sticks."""
    tanks = CascadedTanks(_holes(), _curve(**promises), sticks=True)
    return tanks, {**FLOWS, **HOLE, **STICKING}


def rising() -> Model:
    """The same, whose curve never falls and goes on linearly where the training record has not been."""
    return curved(**RISING)


def learned() -> Model:
    """The same as `curved`, but a learned outflow, one for both tanks, in place of Torricelli's law."""
    sizes: dict[str, Any] = {"width": 6, "depth": 1, "input_scale": 500.0, "output_scale": 0.02}
    upper = neural.Resistance(hy.FluidPort, activation="tanh", **sizes, **OUTFLOW)
    holes = upper, neural.Resistance(hy.FluidPort, net=upper.net)
    return CascadedTanks(holes, _curve(), sticks=True), {**FLOWS, **STICKING}


def _holes() -> tuple[ac.Component, ac.Component]:
    upper = hy.Orifice(area=2.3e-5)
    return upper, hy.Orifice(area=upper.area)


def _curve(**promises: Any) -> neural.Characteristic:
    sizes: dict[str, Any] = {"width": 6, "depth": 1, "input_scale": 0.05, "output_scale": 1.0}
    return neural.Characteristic(activation="softplus", **sizes, **promises)


LINEAR, WHITE = "linear", "white box (Torricelli, rims)"
OURS, PROMISING = "sensor's curve and friction", "the same, a curve that rises, tame"
LEARNED, LAW = "the same, the outflow learned, too", "upper_hole.net"
MODELS: dict[str, Callable[[], Model]] = {
    LINEAR: linear,
    WHITE: white_box,
    OURS: curved,
    PROMISING: rising,
    LEARNED: learned,
}
"""By their names in tables."""
