"""Unit conversions: ``To_...`` from the unit of the SI, ``From_...`` back to it."""
# ruff: noqa: N801 (Modelica's names)

from collections.abc import Iterator
from typing import ClassVar

import numpy as np

import acausal as ac
from acausal.components import icons

from .interfaces import SISO

__modelica__ = "Modelica.Blocks.Math.UnitConversions"


class PartialConversionBlock(SISO):
    """Base of unit conversions: ``y = factor (u + shift)``.

    The input is a number without a unit, so that one signal can feed several conversions.
    """

    __modelica__ = "Modelica.Blocks.Interfaces"

    factor: ClassVar[float] = 1.0
    shift: ClassVar[float] = 0.0

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.factor * (self.u + self.shift))


class To_degC(PartialConversionBlock):
    """Kelvin to degrees Celsius: ``y = u - 273.15``."""

    ICON = icons.block("→ °C")

    u = ac.Input(doc="temperature in K")
    y = ac.Output(unit="degC", doc="temperature")
    shift = -273.15


class From_degC(PartialConversionBlock):
    """Degrees Celsius to kelvin: ``y = u + 273.15``."""

    ICON = icons.block("°C →")

    u = ac.Input(doc="temperature in degC")
    y = ac.Output(unit="K", doc="temperature")
    shift = 273.15


class To_degF(PartialConversionBlock):
    """Kelvin to degrees Fahrenheit: ``y = 9/5 u - 459.67``."""

    ICON = icons.block("→ °F")

    u = ac.Input(doc="temperature in K")
    y = ac.Output(unit="degF", doc="temperature")
    factor = 9 / 5
    shift = -459.67 * 5 / 9


class From_degF(PartialConversionBlock):
    """Degrees Fahrenheit to kelvin: ``y = 5/9 (u + 459.67)``."""

    ICON = icons.block("°F →")

    u = ac.Input(doc="temperature in degF")
    y = ac.Output(unit="K", doc="temperature")
    factor = 5 / 9
    shift = 459.67


class To_degRk(PartialConversionBlock):
    """Kelvin to degrees Rankine: ``y = 9/5 u``."""

    ICON = icons.block("→ °R")

    u = ac.Input(doc="temperature in K")
    y = ac.Output(unit="degR", doc="temperature")
    factor = 9 / 5


class From_degRk(PartialConversionBlock):
    """Degrees Rankine to kelvin: ``y = 5/9 u``."""

    ICON = icons.block("°R →")

    u = ac.Input(doc="temperature in degR")
    y = ac.Output(unit="K", doc="temperature")
    factor = 5 / 9


class To_deg(PartialConversionBlock):
    """Radians to degrees."""

    ICON = icons.block("→ deg")

    u = ac.Input(doc="angle in rad")
    y = ac.Output(unit="deg", doc="angle")
    factor = 180 / np.pi


class From_deg(PartialConversionBlock):
    """Degrees to radians."""

    ICON = icons.block("deg →")

    u = ac.Input(doc="angle in deg")
    y = ac.Output(unit="rad", doc="angle")
    factor = np.pi / 180


class To_rpm(PartialConversionBlock):
    """Radians per second to revolutions per minute."""

    ICON = icons.block("→ rpm")

    u = ac.Input(doc="angular velocity in rad/s")
    y = ac.Output(unit="rev/min", doc="angular velocity")
    factor = 30 / np.pi


class From_rpm(PartialConversionBlock):
    """Revolutions per minute to radians per second."""

    ICON = icons.block("rpm →")

    u = ac.Input(doc="angular velocity in rev/min")
    y = ac.Output(unit="rad/s", doc="angular velocity")
    factor = np.pi / 30


class To_kmh(PartialConversionBlock):
    """Metres per second to kilometres per hour."""

    ICON = icons.block("→ km/h")

    u = ac.Input(doc="speed in m/s")
    y = ac.Output(unit="km/h", doc="speed")
    factor = 3.6


class From_kmh(PartialConversionBlock):
    """Kilometres per hour to metres per second."""

    ICON = icons.block("km/h →")

    u = ac.Input(doc="speed in km/h")
    y = ac.Output(unit="m/s", doc="speed")
    factor = 1 / 3.6


class To_day(PartialConversionBlock):
    """Seconds to days."""

    ICON = icons.block("→ d")

    u = ac.Input(doc="time in s")
    y = ac.Output(unit="d", doc="time")
    factor = 1 / 86400


class From_day(PartialConversionBlock):
    """Days to seconds."""

    ICON = icons.block("d →")

    u = ac.Input(doc="time in d")
    y = ac.Output(unit="s", doc="time")
    factor = 86400.0


class To_hour(PartialConversionBlock):
    """Seconds to hours."""

    ICON = icons.block("→ h")

    u = ac.Input(doc="time in s")
    y = ac.Output(unit="h", doc="time")
    factor = 1 / 3600


class From_hour(PartialConversionBlock):
    """Hours to seconds."""

    ICON = icons.block("h →")

    u = ac.Input(doc="time in h")
    y = ac.Output(unit="s", doc="time")
    factor = 3600.0


class To_minute(PartialConversionBlock):
    """Seconds to minutes."""

    ICON = icons.block("→ min")

    u = ac.Input(doc="time in s")
    y = ac.Output(unit="min", doc="time")
    factor = 1 / 60


class From_minute(PartialConversionBlock):
    """Minutes to seconds."""

    ICON = icons.block("min →")

    u = ac.Input(doc="time in min")
    y = ac.Output(unit="s", doc="time")
    factor = 60.0


class To_litre(PartialConversionBlock):
    """Cubic metres to litres."""

    ICON = icons.block("→ l")

    u = ac.Input(doc="volume in m3")
    y = ac.Output(unit="l", doc="volume")
    factor = 1000.0


class From_litre(PartialConversionBlock):
    """Litres to cubic metres."""

    ICON = icons.block("l →")

    u = ac.Input(doc="volume in l")
    y = ac.Output(unit="m3", doc="volume")
    factor = 1e-3


class To_kWh(PartialConversionBlock):
    """Joules to kilowatt hours."""

    ICON = icons.block("→ kWh")

    u = ac.Input(doc="energy in J")
    y = ac.Output(unit="kW.h", doc="energy")
    factor = 1 / 3.6e6


class From_kWh(PartialConversionBlock):
    """Kilowatt hours to joules."""

    ICON = icons.block("kWh →")

    u = ac.Input(doc="energy in kW.h")
    y = ac.Output(unit="J", doc="energy")
    factor = 3.6e6


class To_bar(PartialConversionBlock):
    """Pascals to bars."""

    ICON = icons.block("→ bar")

    u = ac.Input(doc="pressure in Pa")
    y = ac.Output(unit="bar", doc="pressure")
    factor = 1e-5


class From_bar(PartialConversionBlock):
    """Bars to pascals."""

    ICON = icons.block("bar →")

    u = ac.Input(doc="pressure in bar")
    y = ac.Output(unit="Pa", doc="pressure")
    factor = 1e5


class To_gps(PartialConversionBlock):
    """Kilograms per second to grams per second."""

    ICON = icons.block("→ g/s")

    u = ac.Input(doc="mass flow rate in kg/s")
    y = ac.Output(unit="g/s", doc="mass flow rate")
    factor = 1000.0


class From_gps(PartialConversionBlock):
    """Grams per second to kilograms per second."""

    ICON = icons.block("g/s →")

    u = ac.Input(doc="mass flow rate in g/s")
    y = ac.Output(unit="kg/s", doc="mass flow rate")
    factor = 1e-3
