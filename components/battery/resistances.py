"""What a cell loses: in electrolyte and metal, at the surfaces, and by relaxation."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons, nature
from acausal.components.electrical.interfaces import OnePort

from .interfaces import PartialDepending

__modelica__ = None


class SeriesResistance(OnePort, PartialDepending):
    """A positive resistance that depends on charge and temperature: ``v = R_actual i``, ``LossPower = v i``.

    ``R_actual = R exp(E_a/R_gas (1/T - 1/T_ref) + net(soc, T_ref/T - 1))``.
    """

    ICON = icons.RESISTOR

    R = ac.Parameter(unit="Ohm", min=0, doc="resistance at T_ref")
    R_actual = ac.Variable(unit="Ohm", nominal=1e-3, doc="actual resistance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.R_actual, self.R * self._slowing)
        yield ac.Eq(self.v, self.R_actual * self.i)
        yield ac.Eq(self.LossPower, self.v * self.i)


class ChargeTransfer(OnePort, PartialDepending):
    """The reaction at the surfaces (Butler and Volmer, symmetric): ``v = 2 R_gas T/F asinh(i/(2 I_actual))``.

    The exchange current ``I_actual = I_0 exp(-E_a/R_gas (1/T - 1/T_ref) - net(soc, T_ref/T - 1))`` [A] is positive: at
    small currents the element is a resistance ``R_gas T/(F I_actual)``, at large ones its voltage rises as the
    logarithm. ``LossPower = v i`` is never negative.
    """

    ICON = icons.marked(icons.RESISTOR, "ct")

    I_0 = ac.Parameter(unit="A", min=0, doc="exchange current at T_ref")
    I_actual = ac.Variable(unit="A", start=1.0, nominal=10.0, doc="actual exchange current")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        thermal = 2 * nature.R / nature.F * self.T_heatPort
        yield ac.Eq(self.I_actual, self.I_0 / self._slowing)
        yield ac.Eq(self.v, thermal * ac.asinh(self.i / (2 * self.I_actual)))
        yield ac.Eq(self.LossPower, self.v * self.i)


class Relaxation(OnePort, PartialDepending):
    """A resistance and a capacitance in parallel: ``tau der(v) = R_actual i - v``, ``LossPower = v**2/R_actual``.

    ``R_actual = R exp(E_a/R_gas (1/T - 1/T_ref) + net(soc, T_ref/T - 1))``. The time constant ``tau`` is the same at
    all temperatures; so the capacitance is ``tau/R_actual``.
    """

    ICON = icons.marked(icons.RESISTOR, "RC")

    R = ac.Parameter(unit="Ohm", min=0, doc="resistance at T_ref")
    tau = ac.Parameter(unit="s", min=0, doc="time constant")
    v = ac.Variable(unit="V", state="prefer", doc="voltage from p to n")
    R_actual = ac.Variable(unit="Ohm", nominal=1e-3, doc="actual resistance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.R_actual, self.R * self._slowing)
        yield ac.Eq(self.tau * ac.der(self.v), self.R_actual * self.i - self.v)
        yield ac.Eq(self.LossPower * self.R_actual, self.v**2)
