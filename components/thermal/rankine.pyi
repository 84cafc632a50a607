"""Sources, sensors and conversions of temperatures in degrees Rankine.

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
    """A constant temperature ``T`` [degR], whatever the heat flow: ``port.T = 5/9 T``."""

    T: ClassVar[ac.Parameter]
    """temperature at the port [degR]"""
    def __init__(
        self, *, T: SupportsFloat | ac.Start = ..., port: Mapping[str, Any] = ...
    ) -> None: ...

class FromKelvin(ac.Component):
    """A temperature signal in kelvin as one in degrees Rankine: ``Rankine = 9/5 Kelvin``."""

    Kelvin: ClassVar[ac.Input]
    """temperature [K]"""
    Rankine: ClassVar[ac.Output]
    """the same in degrees Rankine [degR]"""
    def __init__(
        self,
        *,
        Kelvin: ac.Start | Mapping[str, Any] = ...,
        Rankine: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PrescribedTemperature(_thermal.PrescribedTemperature):
    """A temperature signal ``T`` [degR], whatever the heat flow: ``port.T = 5/9 T``."""

    T: ClassVar[ac.Input]
    """temperature at the port [degR]"""
    def __init__(
        self, *, port: Mapping[str, Any] = ..., T: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class TemperatureSensor(_thermal.TemperatureSensor):
    """Absolute temperature ``T = 9/5 port.T`` [degR]."""

    T: ClassVar[ac.Output]
    """absolute temperature of the port [degR]"""
    def __init__(
        self, *, port: Mapping[str, Any] = ..., T: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class ToKelvin(ac.Component):
    """A temperature signal in degrees Rankine as one in kelvin: ``Kelvin = 5/9 Rankine``."""

    Rankine: ClassVar[ac.Input]
    """temperature [degR]"""
    Kelvin: ClassVar[ac.Output]
    """the same in kelvin [K]"""
    def __init__(
        self,
        *,
        Rankine: ac.Start | Mapping[str, Any] = ...,
        Kelvin: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...
