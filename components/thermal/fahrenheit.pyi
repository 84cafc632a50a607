"""Sources, sensors and conversions of temperatures in degrees Fahrenheit.

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
    """A constant temperature ``T`` [degF], whatever the heat flow: ``port.T = (T + 459.67) 5/9``."""

    T: ClassVar[ac.Parameter]
    """temperature at the port [degF]"""
    def __init__(
        self, *, T: SupportsFloat | ac.Start = ..., port: Mapping[str, Any] = ...
    ) -> None: ...

class FromKelvin(ac.Component):
    """A temperature signal in kelvin as one in degrees Fahrenheit: ``Fahrenheit = 9/5 Kelvin - 459.67``."""

    Kelvin: ClassVar[ac.Input]
    """temperature [K]"""
    Fahrenheit: ClassVar[ac.Output]
    """the same in degrees Fahrenheit [degF]"""
    def __init__(
        self,
        *,
        Kelvin: ac.Start | Mapping[str, Any] = ...,
        Fahrenheit: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PrescribedTemperature(_thermal.PrescribedTemperature):
    """A temperature signal ``T`` [degF], whatever the heat flow: ``port.T = (T + 459.67) 5/9``."""

    T: ClassVar[ac.Input]
    """temperature at the port [degF]"""
    def __init__(
        self, *, port: Mapping[str, Any] = ..., T: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class TemperatureSensor(_thermal.TemperatureSensor):
    """Absolute temperature ``T = 9/5 port.T - 459.67`` [degF]."""

    T: ClassVar[ac.Output]
    """absolute temperature of the port [degF]"""
    def __init__(
        self, *, port: Mapping[str, Any] = ..., T: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class ToKelvin(ac.Component):
    """A temperature signal in degrees Fahrenheit as one in kelvin: ``Kelvin = (Fahrenheit + 459.67) 5/9``."""

    Fahrenheit: ClassVar[ac.Input]
    """temperature [degF]"""
    Kelvin: ClassVar[ac.Output]
    """the same in kelvin [K]"""
    def __init__(
        self,
        *,
        Fahrenheit: ac.Start | Mapping[str, Any] = ...,
        Kelvin: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...
