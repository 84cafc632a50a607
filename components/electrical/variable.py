"""Resistors, capacitors and inductors whose value is a signal, and the potentiometer."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .interfaces import ConditionalHeatPort, NegativePin, OnePort, PositivePin

__modelica__ = "Modelica.Electrical.Analog.Basic"


_EPS = 2.220446049250313e-16
"""Distance from 1.0 to the next larger number, `Modelica.Constants.eps`."""


class VariableResistor(OnePort, ConditionalHeatPort):
    """Resistor with the resistance as a signal ``R`` [Ohm]: ``v = R_actual i``, ``LossPower = v i``.

    ``R_actual = R (1 + alpha (T_heatPort - T_ref))`` [Ohm].
    """

    ICON = icons.variable(icons.RESISTOR)

    T_ref = ac.Parameter(300.15, unit="K", doc="reference temperature")
    alpha = ac.Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    T = ac.Parameter(lambda self: self.T_ref, unit="K", doc="temperature without heat port")
    R = ac.Input(unit="Ohm", doc="resistance at T_ref")
    R_actual = ac.Variable(unit="Ohm", doc="resistance at the actual temperature")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.R_actual, self.R * (1 + self.alpha * (self.T_heatPort - self.T_ref)))
        yield ac.Eq(self.v, self.R_actual * self.i)
        yield ac.Eq(self.LossPower, self.v * self.i)


class VariableConductor(OnePort, ConditionalHeatPort):
    """Conductor with the conductance as a signal ``G`` [S]: ``i = G_actual v``, ``LossPower = v i``.

    ``G_actual = G/(1 + alpha (T_heatPort - T_ref))`` [S].
    """

    ICON = icons.variable(icons.RESISTOR, "G")

    T_ref = ac.Parameter(300.15, unit="K", doc="reference temperature")
    alpha = ac.Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    T = ac.Parameter(lambda self: self.T_ref, unit="K", doc="temperature without heat port")
    G = ac.Input(unit="S", doc="conductance at T_ref")
    G_actual = ac.Variable(unit="S", doc="conductance at the actual temperature")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.G_actual, self.G / (1 + self.alpha * (self.T_heatPort - self.T_ref)))
        yield ac.Eq(self.i, self.G_actual * self.v)
        yield ac.Eq(self.LossPower, self.v * self.i)


class VariableCapacitor(OnePort):
    """Capacitor with the capacitance as a signal ``C`` [F]: ``i = der(Q)``, ``Q = max(C, Cmin) v`` [C].

    With ``UIC`` the voltage starts at ``IC`` [V].
    """

    ICON = icons.variable(icons.CAPACITOR)

    Cmin = ac.Parameter(_EPS, unit="F", min=0, doc="lower bound of the capacitance")
    IC = ac.Parameter(0.0, unit="V", doc="initial voltage, with UIC")
    UIC = ac.Option(False, doc="whether the voltage starts at IC")
    C = ac.Input(unit="F", doc="capacitance")
    Q = ac.Variable(unit="C", doc="charge")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.Q, ac.maximum(self.C, self.Cmin) * self.v)
        yield ac.Eq(self.i, ac.der(self.Q))

    def initial_equations(self) -> Iterator[ac.Eq]:
        if self.UIC:
            yield ac.Eq(self.v, self.IC)


class VariableInductor(OnePort):
    """Inductor with the inductance as a signal ``L`` [H]: ``v = der(Psi)``, ``Psi = max(L, Lmin) i`` [Wb].

    With ``UIC`` the current starts at ``IC`` [A].
    """

    ICON = icons.variable(icons.INDUCTOR)

    Lmin = ac.Parameter(_EPS, unit="H", min=0, doc="lower bound of the inductance")
    IC = ac.Parameter(0.0, unit="A", doc="initial current, with UIC")
    UIC = ac.Option(False, doc="whether the current starts at IC")
    L = ac.Input(unit="H", doc="inductance")
    Psi = ac.Variable(unit="Wb", doc="flux linkage")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.Psi, ac.maximum(self.L, self.Lmin) * self.i)
        yield ac.Eq(self.v, ac.der(self.Psi))

    def initial_equations(self) -> Iterator[ac.Eq]:
        if self.UIC:
            yield ac.Eq(self.i, self.IC)


class Potentiometer(ConditionalHeatPort):
    """Resistor with a sliding contact between ``pin_n`` (0) and ``pin_p`` (1).

    ``pin_p.v - contact.v = Rp pin_p.i``, ``pin_n.v - contact.v = Rn pin_n.i`` with
    ``Rn = r R (1 + alpha (T_heatPort - T_ref))``, ``Rp`` the rest, and ``r`` bounded to 0 ... 1: the
    parameter ``rConstant``, or with ``useRinput`` the input ``r``.
    """

    ICON = icons.POTENTIOMETER

    R = ac.Parameter(unit="Ohm", doc="whole resistance at T_ref")
    T_ref = ac.Parameter(293.15, unit="K", doc="reference temperature")
    alpha = ac.Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    T = ac.Parameter(lambda self: self.T_ref, unit="K", doc="temperature without heat port")
    useRinput = ac.Option(False, doc="whether the input r replaces rConstant")
    rConstant = ac.Parameter(0.5, min=0, max=1, doc="position of the contact without input")
    r = ac.Input(when="useRinput", doc="position of the contact")
    pin_p = PositivePin()
    contact = PositivePin()
    pin_n = NegativePin()
    Rp = ac.Variable(unit="Ohm", doc="resistance between pin_p and contact")
    Rn = ac.Variable(unit="Ohm", doc="resistance between contact and pin_n")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        whole = self.R * (1 + self.alpha * (self.T_heatPort - self.T_ref))
        share = ac.minimum(1, ac.maximum(0, self.r)) if self.useRinput else self.rConstant
        above, below = self.pin_p.v - self.contact.v, self.pin_n.v - self.contact.v
        yield ac.Eq(0, self.pin_p.i + self.contact.i + self.pin_n.i)
        yield ac.Eq(self.Rp, whole * (1 - share))
        yield ac.Eq(self.Rn, whole * share)
        yield ac.Eq(above, self.Rp * self.pin_p.i)
        yield ac.Eq(below, self.Rn * self.pin_n.i)
        yield ac.Eq(self.LossPower, above * self.pin_p.i + below * self.pin_n.i)
