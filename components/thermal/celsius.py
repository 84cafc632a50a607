"""Sources, sensors and conversions of temperatures in degrees Celsius."""

import acausal as ac
from acausal.components import icons

from . import scales, sensors, sources

__modelica__ = "Modelica.Thermal.HeatTransfer.Celsius"


class FixedTemperature(scales.Celsius, sources.FixedTemperature):
    """A constant temperature ``T`` [degC], whatever the heat flow: ``port.T = T + 273.15``."""

    ICON = icons.marked(icons.temperature("°C"), "=")

    T = ac.Parameter(unit="degC", doc="temperature at the port")


class PrescribedTemperature(scales.Celsius, sources.PrescribedTemperature):
    """A temperature signal ``T`` [degC], whatever the heat flow: ``port.T = T + 273.15``."""

    ICON = icons.temperature("°C")

    T = ac.Input(unit="degC", doc="temperature at the port")


class TemperatureSensor(scales.Celsius, sensors.TemperatureSensor):
    """Absolute temperature ``T = port.T - 273.15`` [degC]."""

    ICON = icons.meter("°C")

    T = ac.Output(unit="degC", doc="absolute temperature of the port")


class ToKelvin(scales.Celsius, scales.ToKelvin):
    """A temperature signal in degrees Celsius as one in kelvin: ``Kelvin = Celsius + 273.15``."""

    ICON = icons.block("°C → K")

    Celsius = ac.Input(unit="degC", doc="temperature")
    Kelvin = ac.Output(unit="K", doc="the same in kelvin")


class FromKelvin(scales.Celsius, scales.FromKelvin):
    """A temperature signal in kelvin as one in degrees Celsius: ``Celsius = Kelvin - 273.15``."""

    ICON = icons.block("K → °C")

    Celsius = ac.Output(unit="degC", doc="the same in degrees Celsius")
