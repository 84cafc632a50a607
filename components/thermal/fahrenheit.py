"""Sources, sensors and conversions of temperatures in degrees Fahrenheit."""

import acausal as ac
from acausal.components import icons

from . import scales, sensors, sources

__modelica__ = "Modelica.Thermal.HeatTransfer.Fahrenheit"


class FixedTemperature(scales.Fahrenheit, sources.FixedTemperature):
    """A constant temperature ``T`` [degF], whatever the heat flow: ``port.T = (T + 459.67) 5/9``."""

    ICON = icons.marked(icons.temperature("°F"), "=")

    T = ac.Parameter(unit="degF", doc="temperature at the port")


class PrescribedTemperature(scales.Fahrenheit, sources.PrescribedTemperature):
    """A temperature signal ``T`` [degF], whatever the heat flow: ``port.T = (T + 459.67) 5/9``."""

    ICON = icons.temperature("°F")

    T = ac.Input(unit="degF", doc="temperature at the port")


class TemperatureSensor(scales.Fahrenheit, sensors.TemperatureSensor):
    """Absolute temperature ``T = 9/5 port.T - 459.67`` [degF]."""

    ICON = icons.meter("°F")

    T = ac.Output(unit="degF", doc="absolute temperature of the port")


class ToKelvin(scales.Fahrenheit, scales.ToKelvin):
    """A temperature signal in degrees Fahrenheit as one in kelvin: ``Kelvin = (Fahrenheit + 459.67) 5/9``."""

    ICON = icons.block("°F → K")

    Fahrenheit = ac.Input(unit="degF", doc="temperature")
    Kelvin = ac.Output(unit="K", doc="the same in kelvin")


class FromKelvin(scales.Fahrenheit, scales.FromKelvin):
    """A temperature signal in kelvin as one in degrees Fahrenheit: ``Fahrenheit = 9/5 Kelvin - 459.67``."""

    ICON = icons.block("K → °F")

    Fahrenheit = ac.Output(unit="degF", doc="the same in degrees Fahrenheit")
