"""Sources of magnetic potential differences and fluxes."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .interfaces import TwoPortElementary

__modelica__ = "Modelica.Magnetic.FluxTubes.Sources"


class _Source(TwoPortElementary):
    """``V_m = port_p.V_m - port_n.V_m``, ``Phi = port_p.Phi = -port_n.Phi``; one of them is given."""

    ICON = icons.VOLTAGE

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.V_m, self.port_p.V_m - self.port_n.V_m)
        yield ac.Eq(self.Phi, self.port_p.Phi)
        yield ac.Eq(0, self.port_p.Phi + self.port_n.Phi)


class ConstantMagneticPotentialDifference(_Source):
    """Constant magnetomotive force: ``V_m = port_p.V_m - port_n.V_m`` [A]."""

    ICON = icons.marked(icons.VOLTAGE, "Vm")

    V_m = ac.Parameter(unit="A", doc="magnetic potential difference")
    Phi = ac.Variable(unit="Wb", doc="magnetic flux from port_p to port_n")


class SignalMagneticPotentialDifference(_Source):
    """Magnetomotive force from a signal ``V_m`` [A]: ``V_m = port_p.V_m - port_n.V_m``."""

    ICON = icons.marked(icons.SIGNAL_VOLTAGE, "Vm")

    V_m = ac.Input(unit="A", doc="magnetic potential difference")
    Phi = ac.Variable(unit="Wb", doc="magnetic flux from port_p to port_n")


class ConstantMagneticFlux(_Source):
    """Constant flux from ``port_p`` to ``port_n``: ``Phi = port_p.Phi`` [Wb]."""

    ICON = icons.marked(icons.CURRENT, "Φ")

    Phi = ac.Parameter(1.0, unit="Wb", doc="magnetic flux from port_p to port_n")
    V_m = ac.Variable(unit="A", doc="magnetic potential difference")


class SignalMagneticFlux(_Source):
    """Flux from a signal ``Phi`` [Wb], from ``port_p`` to ``port_n``: ``Phi = port_p.Phi``."""

    ICON = icons.marked(icons.SIGNAL_CURRENT, "Φ")

    Phi = ac.Input(unit="Wb", doc="magnetic flux from port_p to port_n")
    V_m = ac.Variable(unit="A", doc="magnetic potential difference")
