"""What is fixed or rigid; compliances, gears, friction and adaptors come from their own modules."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons
from acausal.components.choices import STATE_SELECT

from .interfaces import Flange, PartialTwoFlanges

__modelica__ = "Modelica.Mechanics.Rotational.Components"


class Fixed(ac.Component):
    """A flange fixed in the housing: ``flange.phi = phi0`` [rad]."""

    ICON = icons.FIXED

    phi0 = ac.Parameter(0.0, unit="rad", doc="fixed angle")
    flange = Flange()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.flange.phi, self.phi0)


class Inertia(PartialTwoFlanges):
    """A rotating inertia: ``J a = flange_a.tau + flange_b.tau`` with ``w = der(phi)``, ``a = der(w)``.

    Both flanges have its angle ``phi`` [rad]. ``phi`` and the speed ``w`` [rad/s] are preferred as
    states (Modelica: ``default``).
    """

    ICON = icons.INERTIA

    J = ac.Parameter(unit="kg.m2", min=0, doc="moment of inertia")
    stateSelect = ac.Option("prefer", choices=STATE_SELECT, doc="priority of phi and w as states")
    phi = ac.Variable(unit="rad", state="stateSelect", doc="angle")
    w = ac.Variable(unit="rad/s", state="stateSelect", doc="speed")
    a = ac.Variable(unit="rad/s2", doc="acceleration")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.phi, self.flange_a.phi)
        yield ac.Eq(self.phi, self.flange_b.phi)
        yield ac.Eq(self.w, ac.der(self.phi))
        yield ac.Eq(self.a, ac.der(self.w))
        yield ac.Eq(self.J * self.a, self.flange_a.tau + self.flange_b.tau)


class Disc(PartialTwoFlanges):
    """Two flanges, rigid and without inertia, turned by ``deltaPhi`` against each other.

    ``flange_a.phi = phi - deltaPhi/2``, ``flange_b.phi = phi + deltaPhi/2``,
    ``0 = flange_a.tau + flange_b.tau``.
    """

    ICON = icons.DISC

    deltaPhi = ac.Parameter(0.0, unit="rad", doc="fixed angle, = flange_b.phi - flange_a.phi")
    phi = ac.Variable(unit="rad", doc="angle of the centre")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.flange_a.phi, self.phi - self.deltaPhi / 2)
        yield ac.Eq(self.flange_b.phi, self.phi + self.deltaPhi / 2)
        yield ac.Eq(0, self.flange_a.tau + self.flange_b.tau)


class Coupling(PartialTwoFlanges):
    """Ideal coupling of two shafts face to face: ``flange_a.phi + flange_b.phi = 0``.

    Both flanges take the same torque ``tau = flange_a.tau = flange_b.tau``; ``w = der(flange_a.phi)``.
    """

    ICON = icons.marked(icons.DISC, "−")

    w = ac.Variable(unit="rad/s", doc="speed of flange_a")
    tau = ac.Variable(unit="N.m", doc="torque of both flanges")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange_a.phi + self.flange_b.phi, 0)
        yield ac.Eq(self.flange_a.tau, self.flange_b.tau)
        yield ac.Eq(self.w, ac.der(self.flange_a.phi))
        yield ac.Eq(self.tau, self.flange_a.tau)
