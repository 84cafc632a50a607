"""The magnetic port, and the bases of flux tubes.

A port's flux ``Phi`` is positive into the component. ``V_m = port_p.V_m - port_n.V_m`` is the magnetic
potential difference, the field strength along the tube's length. The product of the two is not a power: that is
``V_m der(Phi)``.
"""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

__modelica__ = "Modelica.Magnetic.FluxTubes.Interfaces"


class MagneticPort(ac.Connector):
    """Magnetic potential ``V_m`` [A] and flux ``Phi`` [Wb], positive into the component."""

    V_m = ac.Potential(unit="A", doc="magnetic potential at the port")
    Phi = ac.Flow(unit="Wb", nominal=1e-3, doc="magnetic flux into the port")

    pair = ("port_p", "port_n")
    across = "V_m"
    through = "Phi"
    power = False
    COLOR = "#c77f1a"


PositiveMagneticPort = MagneticPort
NegativeMagneticPort = MagneticPort


class TwoPortElementary(ac.Component):
    """Two magnetic ports, and nothing said about them."""

    port_p = PositiveMagneticPort()
    port_n = NegativeMagneticPort()


class TwoPortExtended(TwoPortElementary):
    """Two ports with ``V_m = port_p.V_m - port_n.V_m`` [A] and ``Phi = port_p.Phi`` [Wb]."""

    V_m = ac.Variable(unit="A", doc="magnetic potential difference")
    Phi = ac.Variable(unit="Wb", nominal=1e-3, doc="magnetic flux from port_p to port_n")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.V_m, self.port_p.V_m - self.port_n.V_m)
        yield ac.Eq(self.Phi, self.port_p.Phi)


class TwoPort(TwoPortExtended):
    """A flux tube: what enters ``port_p`` leaves at ``port_n``. A subclass relates ``V_m`` and ``Phi``."""

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(0, self.port_p.Phi + self.port_n.Phi)


class Reluctance(TwoPort):
    """A flux tube with ``V_m = Phi R_m`` and ``R_m = 1/G_m``; a subclass states one of the two."""

    ICON = icons.RELUCTANCE

    __modelica__ = None

    R_m = ac.Variable(unit="1/H", nominal=1e6, doc="magnetic reluctance")
    G_m = ac.Variable(unit="H", nominal=1e-6, doc="magnetic permeance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.V_m, self.Phi * self.R_m)
        yield ac.Eq(self.R_m, 1 / self.G_m)
