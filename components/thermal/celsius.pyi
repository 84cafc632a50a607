"""Sources, sensors and conversions of temperatures in degrees Celsius.

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, SupportsFloat

import acausal as ac
from acausal.components import thermal as _thermal

__all__ = [
    "FixedTemperature",
    "FromKelvin",
    "PrescribedTemperature",
    "TemperatureSensor",
    "ToKelvin",
]

class FixedTemperature(_thermal.FixedTemperature):
    """A constant temperature ``T`` [degC], whatever the heat flow: ``port.T = T + 273.15``."""

    T: ClassVar[ac.Parameter]
    """temperature at the port [degC]"""
    def __init__(
        self, *, T: SupportsFloat | ac.Start = ..., port: Mapping[str, Any] = ...
    ) -> None: ...

class FromKelvin(ac.Component):
    """A temperature signal in kelvin as one in degrees Celsius: ``Celsius = Kelvin - 273.15``."""

    Kelvin: ClassVar[ac.Input]
    """temperature [K]"""
    Celsius: ClassVar[ac.Output]
    """the same in degrees Celsius [degC]"""
    def __init__(
        self,
        *,
        Kelvin: ac.Start | Mapping[str, Any] = ...,
        Celsius: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PrescribedTemperature(_thermal.PrescribedTemperature):
    """A temperature signal ``T`` [degC], whatever the heat flow: ``port.T = T + 273.15``."""

    T: ClassVar[ac.Input]
    """temperature at the port [degC]"""
    def __init__(
        self, *, port: Mapping[str, Any] = ..., T: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class TemperatureSensor(_thermal.TemperatureSensor):
    """Absolute temperature ``T = port.T - 273.15`` [degC]."""

    T: ClassVar[ac.Output]
    """absolute temperature of the port [degC]"""
    def __init__(
        self, *, port: Mapping[str, Any] = ..., T: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class ToKelvin(ac.Component):
    """A temperature signal in degrees Celsius as one in kelvin: ``Kelvin = Celsius + 273.15``."""

    Celsius: ClassVar[ac.Input]
    """temperature [degC]"""
    Kelvin: ClassVar[ac.Output]
    """the same in kelvin [K]"""
    def __init__(
        self,
        *,
        Celsius: ac.Start | Mapping[str, Any] = ...,
        Kelvin: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...
