"""Sensors: magnetic quantities as output signals, without an effect on the circuit."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .interfaces import TwoPortElementary

__modelica__ = "Modelica.Magnetic.FluxTubes.Sensors"


class MagneticPotentialDifferenceSensor(TwoPortElementary):
    """Magnetic potential difference: ``V_m = port_p.V_m - port_n.V_m`` [A]; no flux passes."""

    ICON = icons.meter2("Θ")

    V_m = ac.Output(unit="A", doc="magnetic potential difference")
    Phi = ac.Variable(unit="Wb", doc="magnetic flux from port_p to port_n, zero")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.V_m, self.port_p.V_m - self.port_n.V_m)
        yield ac.Eq(self.Phi, self.port_p.Phi)
        yield ac.Eq(self.Phi, 0)
        yield ac.Eq(0, self.port_p.Phi + self.port_n.Phi)


class MagneticFluxSensor(TwoPortElementary):
    """Flux in a branch: ``Phi = port_p.Phi`` [Wb]; ``port_p.V_m = port_n.V_m``."""

    ICON = icons.meter2("Φ")

    Phi = ac.Output(unit="Wb", doc="magnetic flux from port_p to port_n")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.port_p.V_m, self.port_n.V_m)
        yield ac.Eq(self.Phi, self.port_p.Phi)
        yield ac.Eq(0, self.port_p.Phi + self.port_n.Phi)
