"""Ground, converters between electrical and magnetic quantities, reluctances and eddy currents."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons, nature
from acausal.components.electrical.interfaces import ConditionalHeatPort, OnePort

from .interfaces import (
    MagneticPort,
    NegativeMagneticPort,
    PositiveMagneticPort,
    Reluctance,
    TwoPort,
    TwoPortExtended,
)

__modelica__ = "Modelica.Magnetic.FluxTubes.Basic"


_EPS = 100 * 2.220446049250313e-16
"""Smallest current [A] by which a flux is divided."""


class Ground(ac.Component):
    """The magnetic potential zero: ``port.V_m = 0``. Every magnetic circuit needs one."""

    ICON = icons.GROUND

    port = MagneticPort()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.port.V_m, 0)


class _Converter(OnePort, TwoPort):
    """A coil of ``N`` turns between an electrical one-port and a magnetic port: ``V_m = i N``.

    ``L_stat`` [H], for information, is ``|Psi/i|``. The current is preferred as a state.
    """

    ICON = icons.CONVERTER

    N = ac.Parameter(doc="number of turns")
    i = ac.Variable(unit="A", state="prefer", doc="current from p to n")
    Psi = ac.Variable(unit="Wb", doc="flux linkage")
    L_stat = ac.Variable(unit="H", doc="static inductance")

    def _induction(self, flux: Any) -> Iterator[ac.Eq]:
        """Ampere's and Faraday's law for the flux that the coil links."""
        yield ac.Eq(self.V_m, self.i * self.N)
        yield ac.Eq(self.N * ac.der(flux), -self.v)
        yield ac.Eq(self.Psi, self.N * flux)
        yield ac.Eq(self.L_stat, ac.Abs(self.Psi) / ac.maximum(ac.Abs(self.i), _EPS))


class ElectroMagneticConverter(_Converter):
    """Ideal coil of ``N`` turns: ``V_m = N i``, ``N der(Phi) = -v``.

    For information the flux linkage ``Psi = N Phi`` [Wb] and the static inductance ``L_stat = |Psi/i|`` [H].
    A negative ``N`` makes a left-handed coil.
    """

    N = ac.Parameter(1.0, doc="number of turns")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from self._induction(self.Phi)


class ElectroMagneticConverterWithLeakageInductance(_Converter):
    """Coil with a leakage path: ``Phi = Phi_ind + Phi_leak``, ``Phi_leak = G_m V_m``.

    ``V_m = N i``, ``N der(Phi_ind) = -v``, ``G_m = mu_0 mu_rel A/L``; for information
    ``Psi = N Phi_ind`` [Wb] and ``L_stat = |Psi/i|`` [H].
    """

    ICON = icons.marked(icons.CONVERTER, "σ")

    L = ac.Parameter(10e-3, unit="m", doc="length of the leakage path")
    A = ac.Parameter(10e-6, unit="m2", doc="cross-section of the leakage path")
    mu_rel = ac.Parameter(1.0, unit="1", min=0, doc="relative permeability of the leakage path")
    G_m = ac.Parameter(
        lambda self: nature.mu_0 * self.mu_rel * self.A / self.L,
        unit="H",
        doc="permeance of the leakage path, computed",
    )
    Phi = ac.Variable(unit="Wb", state="never", doc="whole magnetic flux")
    Phi_ind = ac.Variable(unit="Wb", state="never", doc="flux that the coil links")
    Phi_leak = ac.Variable(unit="Wb", state="never", doc="flux of the leakage path")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from self._induction(self.Phi_ind)
        yield ac.Eq(self.Phi_leak, self.G_m * self.V_m)
        yield ac.Eq(self.Phi, self.Phi_ind + self.Phi_leak)


class ConstantReluctance(TwoPort):
    """``V_m = Phi R_m``."""

    ICON = icons.RELUCTANCE

    R_m = ac.Parameter(1.0, unit="1/H", doc="magnetic reluctance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.V_m, self.Phi * self.R_m)


class ConstantPermeance(TwoPort):
    """``Phi = G_m V_m``."""

    ICON = icons.marked(icons.RELUCTANCE, "G")

    G_m = ac.Parameter(1.0, unit="H", doc="magnetic permeance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.G_m * self.V_m, self.Phi)


class VariableReluctance(TwoPort):
    """``V_m = Phi R_m`` with the reluctance as a signal ``R_m`` [1/H]."""

    ICON = icons.variable(icons.RELUCTANCE)

    R_m = ac.Input(unit="1/H", doc="magnetic reluctance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.V_m, self.Phi * self.R_m)


class VariablePermeance(TwoPort):
    """``Phi = G_m V_m`` with the permeance as a signal ``G_m`` [H]."""

    ICON = icons.variable(icons.RELUCTANCE, "G")

    G_m = ac.Input(unit="H", doc="magnetic permeance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.G_m * self.V_m, self.Phi)


class LeakageWithCoefficient(Reluctance):
    """Leakage parallel to a useful path: ``(1 - c_usefulFlux) R_m = c_usefulFlux R_mUsefulTot``.

    ``R_mUsefulTot`` [1/H], a signal, is the reluctance of the useful path, ``c_usefulFlux`` its share
    of the flux. Not for actuators in motion: the leakage would take part in the force.
    """

    ICON = icons.marked(icons.RELUCTANCE, "σ")

    c_usefulFlux = ac.Parameter(
        unit="1", min=0, max=1, doc="useful flux over useful and leakage flux"
    )
    R_mUsefulTot = ac.Input(unit="1/H", doc="reluctance of the useful path")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        useful = self.c_usefulFlux * self.R_mUsefulTot
        yield ac.Eq((1 - self.c_usefulFlux) * self.R_m, useful)


class EddyCurrent(TwoPort, ConditionalHeatPort):
    """Eddy current in a conductive flux tube: ``V_m = der(Phi)/R``, ``LossPower = V_m der(Phi)``.

    ``R = rho l/A`` [Ohm] is the resistance of the current's path; with ``useConductance``
    ``V_m = G der(Phi)``.
    """

    ICON = icons.EDDY

    useConductance = ac.Option(False, doc="whether G replaces rho, l and A")
    G = ac.Parameter(1 / 0.098e-6, unit="S", min=0, doc="conductance of the path, A/(rho l)")
    rho = ac.Parameter(0.098e-6, unit="Ohm.m", doc="resistivity; that of iron at 20 degC")
    l = ac.Parameter(1.0, unit="m", doc="average length of the path")
    A = ac.Parameter(1.0, unit="m2", doc="cross-section of the path")
    R = ac.Parameter(
        lambda self: self.rho * self.l / self.A, unit="Ohm", doc="resistance of the path, computed"
    )
    T = ac.Parameter(273.15, unit="K", min=0, doc="temperature of the device without heat port")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        rate = ac.der(self.Phi)
        yield ac.Eq(self.LossPower, self.V_m * rate)
        yield ac.Eq(self.V_m, self.G * rate if self.useConductance else rate / self.R)


class Idle(TwoPortExtended):
    """An interruption: ``Phi = 0`` at both ports."""

    ICON = icons.IDLE

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.Phi, 0)
        yield ac.Eq(self.port_n.Phi, 0)


class Short(TwoPort):
    """A short cut: ``V_m = 0``."""

    ICON = icons.SHORT

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.V_m, 0)


class Crossing(ac.Component):
    """Two branches that cross: ``port_p1`` is joined with ``port_p2``, ``port_n1`` with ``port_n2``."""

    ICON = icons.CROSSED

    port_p1 = PositiveMagneticPort()
    port_p2 = PositiveMagneticPort()
    port_n1 = NegativeMagneticPort()
    port_n2 = NegativeMagneticPort()

    def equations(self) -> Iterator[ac.Eq]:
        for a, b in ((self.port_p1, self.port_p2), (self.port_n1, self.port_n2)):
            yield ac.Eq(a.V_m, b.V_m)
            yield ac.Eq(0, a.Phi + b.Phi)
