"""Temperature scales: how sources, sensors and conversions turn their signal into kelvin and back."""

from collections.abc import Iterator
from typing import Any, ClassVar

import acausal as ac


class Kelvin(ac.Component):
    """A component whose temperatures are in kelvin; the other scales override the conversions."""

    def to_kelvin(self, T: Any) -> Any:
        """Temperature [K] of one on this scale."""
        return T

    def from_kelvin(self, T: Any) -> Any:
        """Temperature on this scale of one in [K]."""
        return T


class Celsius(Kelvin):
    """Temperatures in degrees Celsius: ``T [K] = T [degC] + 273.15``."""

    signal = "Celsius"

    def to_kelvin(self, T: Any) -> Any:
        return T + 273.15

    def from_kelvin(self, T: Any) -> Any:
        return T - 273.15


class Fahrenheit(Kelvin):
    """Temperatures in degrees Fahrenheit: ``T [K] = (T [degF] + 459.67) 5/9``."""

    signal = "Fahrenheit"

    def to_kelvin(self, T: Any) -> Any:
        return (T + 459.67) * 5 / 9

    def from_kelvin(self, T: Any) -> Any:
        return T * 9 / 5 - 459.67


class Rankine(Kelvin):
    """Temperatures in degrees Rankine: ``T [K] = T [degR] 5/9``."""

    signal = "Rankine"

    def to_kelvin(self, T: Any) -> Any:
        return T * 5 / 9

    def from_kelvin(self, T: Any) -> Any:
        return T * 9 / 5


class ToKelvin(Kelvin):
    """A temperature signal as one in kelvin; a subclass declares both signals."""

    signal: ClassVar[str]
    Kelvin: Any

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.Kelvin, self.to_kelvin(getattr(self, self.signal)))


class FromKelvin(Kelvin):
    """A temperature signal in kelvin as one on another scale; a subclass declares the output, which has its name."""

    signal: ClassVar[str]
    Kelvin = ac.Input(unit="K", doc="temperature")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(getattr(self, self.signal), self.from_kelvin(self.Kelvin))
