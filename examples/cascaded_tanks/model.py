"""A pump, two tanks one above the other, and a level sensor: known physics, and networks for what is uncertain.

Water runs out of each tank through a hole at its bottom. What flows over the rim of the upper one falls partly into the
lower one. Sizes are not published, and levels in volts tell only ratios. So the tanks, which look alike, have a cross
section of 100 cm2 and a rim at 15 cm here, and a volt is about a centimetre.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import acausal as ac
from acausal.components import blocks, neural
from acausal.components import hydraulic as hy

INPUT, OUTPUT = "drive.u", "saturation.y"
RIM, FULL = 0.15, 0.2
"""How high the rims are, and how high water ever stands [m]."""
LIMITS = (0.0, 1300.0)
"""Where records tell the outflow [Pa]."""

Model = tuple[ac.Component, dict[str, float]]
"""A model, and by how much its parameters may be trained, as a fraction."""

FLOWS = {"drive.k": 0.9, "over.width": 0.9, "past.width": 0.9}
HOLES = {"upper_hole.area": 0.9, "lower_hole.area": 0.9}
LINE = {"sensor.y0": 0.9, "sensor.k1": 0.5}


class CascadedTanks(ac.Component):
    """A pump fills the upper tank, which runs out, and over, into the lower one, whose level is measured.

    Arguments:
        upper, lower: what lets water out at the bottom of each tank, side by side.
        curve: what the sensor adds to a voltage that rises linearly with the level.
        rims: whether tanks overflow.
    """

    def __init__(
        self,
        upper: Mapping[str, ac.Component],
        lower: Mapping[str, ac.Component],
        curve: neural.Characteristic | None = None,
        *,
        rims: bool = True,
    ) -> None:
        super().__init__()
        self.drive, self.pump = blocks.Gain(k=6e-3), hy.MassFlowSource(use_m_flow_in=True)
        self.upper, self.lower = (hy.OpenTank(crossArea=0.01, level=ac.Start(0.09)) for _ in "ab")
        self.drain = hy.Boundary()
        self.connect(self.drive.y, self.pump.m_flow_in)
        self.connect(self.pump.port, self.upper.topPort)
        if rims:
            upper = {**upper, "over": hy.Weir(height=RIM, width=0.04)}
            lower = {**lower, "spill": hy.Weir(height=RIM, width=0.04)}
            self._lead(self.upper.port, self.drain.port, {"past": hy.Weir(height=RIM, width=0.02)})
        self._lead(self.upper.port, self.lower.topPort, upper)
        self._lead(self.lower.port, self.drain.port, lower)
        self.sensor = blocks.LinearDependency(y0=-4.0, k1=100.0, k2=1.0 if curve else 0.0)
        self.saturation = blocks.Limiter(uMax=10.0)
        self.connect(self.lower.level, self.sensor.u1)
        if curve:
            self.curve = curve
            self.connect(self.lower.level, self.curve.u)
        self.connect(self.curve.y if curve else self.lower.level, self.sensor.u2)
        self.connect(self.sensor.y, self.saturation.u)

    def _lead(self, start: hy.FluidPort, end: hy.FluidPort, elements: Mapping[str, Any]) -> None:
        for name, element in elements.items():
            setattr(self, name, element)
            self.connect(start, element.port_a)
            self.connect(element.port_b, end)


def linear() -> Model:
    """Two tanks that never overflow, whose outflow rises linearly with the level."""
    upper, lower = ({f"{n}_way": hy.LinearResistance(k=1e-5)} for n in ("upper", "lower"))
    trained = {"drive.k": 0.9, "upper_way.k": 0.9, "lower_way.k": 0.9, **LINE}
    return CascadedTanks(upper, lower, rims=False), trained


def white_box() -> Model:
    """Torricelli's law, rims, and a sensor whose voltage rises linearly with the level."""
    return CascadedTanks(*_holes()), {**FLOWS, **HOLES, **LINE}


def with_curve(**promises: Any) -> Model:
    """The white box with a learned curve of the sensor."""
    return CascadedTanks(*_holes(), _curve(**promises)), {**FLOWS, **HOLES}


def with_tame_curve() -> Model:
    """The same, whose curve goes on linearly where the training record has not been."""
    return with_curve(extrapolation="linear", limits=(0.058, 0.155))


def beside() -> Model:
    """Neural resistances beside the holes, for what these lack: more water under more pressure, and tamely so."""
    upper, lower = _holes()
    options = {"output_scale": 2e-3, "monotone": True, "extrapolation": "linear", "limits": LIMITS}
    upper["upper_nn"], lower["lower_nn"] = _resistance(**options), _resistance(**options)
    return CascadedTanks(upper, lower, _curve()), {**FLOWS, **HOLES}


def in_place(**promises: Any) -> Model:
    """Neural resistances in place of the holes, which know nothing of Torricelli, and the sensor's curve."""
    upper, lower = ({f"{n}_nn": _resistance(**promises)} for n in ("upper", "lower"))
    return CascadedTanks(upper, lower, _curve()), FLOWS


def promising() -> Model:
    """Resistances in place of the holes: water never runs upwards, more of it under more pressure, and tamely so."""
    return in_place(passive=True, monotone=True, extrapolation="linear", limits=LIMITS)


def _holes() -> tuple[dict[str, ac.Component], dict[str, ac.Component]]:
    return {"upper_hole": hy.Orifice(area=2.3e-5)}, {"lower_hole": hy.Orifice(area=2.3e-5)}


def _resistance(**options: Any) -> neural.Resistance:
    given: dict[str, Any] = {"input_scale": 500.0, "output_scale": 0.02, **options}
    return neural.Resistance(hy.FluidPort, width=6, depth=1, activation="tanh", **given)


def _curve(**promises: Any) -> neural.Characteristic:
    sizes: dict[str, Any] = {"width": 6, "depth": 1, "input_scale": 0.05, "output_scale": 0.5}
    return neural.Characteristic(activation="tanh", **sizes, **promises)


LINEAR, WHITE = "linear", "white box (Torricelli, rims)"
CURVE, OURS = "sensor's curve learned, no promise", "sensor's curve learned, tame"
FREE, PROMISING = "networks for holes, no promises", "networks for holes, with promises"
BESIDE = "networks beside holes, with promises"
MODELS: dict[str, Callable[[], Model]] = {
    LINEAR: linear,
    WHITE: white_box,
    CURVE: with_curve,
    OURS: with_tame_curve,
    FREE: in_place,
    PROMISING: promising,
    BESIDE: beside,
}
"""By their names in tables."""
