"""Sources, sensors and conversions of temperatures in degrees Rankine."""

import acausal as ac
from acausal.components import icons

from . import scales, sensors, sources

__modelica__ = "Modelica.Thermal.HeatTransfer.Rankine"


class FixedTemperature(scales.Rankine, sources.FixedTemperature):
    """A constant temperature ``T`` [degR], whatever the heat flow: ``port.T = 5/9 T``."""

    ICON = icons.marked(icons.temperature("°R"), "=")

    T = ac.Parameter(unit="degR", doc="temperature at the port")


class PrescribedTemperature(scales.Rankine, sources.PrescribedTemperature):
    """A temperature signal ``T`` [degR], whatever the heat flow: ``port.T = 5/9 T``."""

    ICON = icons.temperature("°R")

    T = ac.Input(unit="degR", doc="temperature at the port")


class TemperatureSensor(scales.Rankine, sensors.TemperatureSensor):
    """Absolute temperature ``T = 9/5 port.T`` [degR]."""

    ICON = icons.meter("°R")

    T = ac.Output(unit="degR", doc="absolute temperature of the port")


class ToKelvin(scales.Rankine, scales.ToKelvin):
    """A temperature signal in degrees Rankine as one in kelvin: ``Kelvin = 5/9 Rankine``."""

    ICON = icons.block("°R → K")

    Rankine = ac.Input(unit="degR", doc="temperature")
    Kelvin = ac.Output(unit="K", doc="the same in kelvin")


class FromKelvin(scales.Rankine, scales.FromKelvin):
    """A temperature signal in kelvin as one in degrees Rankine: ``Rankine = 9/5 Kelvin``."""

    ICON = icons.block("K → °R")

    Rankine = ac.Output(unit="degR", doc="the same in degrees Rankine")
