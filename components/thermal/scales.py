"""Temperature scales: how sources and sensors convert between their signal and kelvin."""

from typing import Any

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

    def to_kelvin(self, T: Any) -> Any:
        """Temperature [K] of one in [degC]."""
        return T + 273.15

    def from_kelvin(self, T: Any) -> Any:
        """Temperature [degC] of one in [K]."""
        return T - 273.15


class Fahrenheit(Kelvin):
    """Temperatures in degrees Fahrenheit: ``T [K] = (T [degF] + 459.67) 5/9``."""

    def to_kelvin(self, T: Any) -> Any:
        """Temperature [K] of one in [degF]."""
        return (T + 459.67) * 5 / 9

    def from_kelvin(self, T: Any) -> Any:
        """Temperature [degF] of one in [K]."""
        return T * 9 / 5 - 459.67


class Rankine(Kelvin):
    """Temperatures in degrees Rankine: ``T [K] = T [degR] 5/9``."""

    def to_kelvin(self, T: Any) -> Any:
        """Temperature [K] of one in [degR]."""
        return T * 5 / 9

    def from_kelvin(self, T: Any) -> Any:
        """Temperature [degR] of one in [K]."""
        return T * 9 / 5
