"""Prescribed motions; torques come from their own module."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .interfaces import PartialElementaryOneFlangeAndSupport2

__modelica__ = "Modelica.Mechanics.Rotational.Sources"


class Position(PartialElementaryOneFlangeAndSupport2):
    """The flange follows an angle signal ``phi_ref`` [rad].

    With ``exact`` ``phi = phi_ref``; the signal is differentiated where the model needs it, and ``w``
    and ``a`` stay zero. Without, through a Bessel filter of second order that starts at ``phi_ref``:
    ``a = ((phi_ref - phi) w_crit - 1.3617 w) w_crit / 0.6180`` with ``w_crit = 2 pi f_crit``,
    ``w = der(phi)``, ``a = der(w)``.
    """

    ICON = icons.marked(icons.MOVED, "φ")

    exact = ac.Option(False, doc="whether to follow the signal exactly; else filtered")
    f_crit = ac.Parameter(50.0, unit="Hz", doc="critical frequency of the filter")
    phi_ref = ac.Input(unit="rad", doc="reference angle")
    phi = ac.Variable(
        unit="rad", state="_priority", doc="angle of the flange relative to the support"
    )
    w = ac.Variable(unit="rad/s", state="_priority", doc="speed of the flange; 0 if exact")
    a = ac.Variable(unit="rad/s2", doc="acceleration of the flange; 0 if exact")

    @property
    def _priority(self) -> str:
        return "default" if self.exact else "prefer"

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        if self.exact:
            yield ac.Eq(self.phi, self.phi_ref)
            yield ac.Eq(self.w, 0)
            yield ac.Eq(self.a, 0)
        else:
            w_crit = 2 * ac.pi * self.f_crit
            pull = (self.phi_ref - self.phi) * w_crit - 1.3617 * self.w
            yield ac.Eq(self.w, ac.der(self.phi))
            yield ac.Eq(self.a, ac.der(self.w))
            yield ac.Eq(self.a, pull * w_crit / 0.618)

    def initial_equations(self) -> Iterator[ac.Eq]:
        if not self.exact:
            yield ac.Eq(self.phi, self.phi_ref)


class Speed(PartialElementaryOneFlangeAndSupport2):
    """The flange follows a speed signal ``w_ref`` [rad/s]; ``w = der(phi)``, ``phi`` starts at 0.

    With ``exact`` ``w = w_ref``, and ``a`` stays zero. Without, through a filter of first order that
    starts at ``w_ref``: ``a = (w_ref - w) 2 pi f_crit``, ``a = der(w)``.
    """

    ICON = icons.marked(icons.MOVED, "ω")

    exact = ac.Option(False, doc="whether to follow the signal exactly; else filtered")
    f_crit = ac.Parameter(50.0, unit="Hz", doc="critical frequency of the filter")
    w_ref = ac.Input(unit="rad/s", doc="reference speed")
    phi = ac.Variable(
        unit="rad", fixed=True, state="prefer", doc="angle of the flange relative to the support"
    )
    w = ac.Variable(unit="rad/s", state="_priority", doc="speed of the flange")
    a = ac.Variable(unit="rad/s2", doc="acceleration of the flange; 0 if exact")

    @property
    def _priority(self) -> str:
        return "default" if self.exact else "prefer"

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.w, ac.der(self.phi))
        if self.exact:
            yield ac.Eq(self.w, self.w_ref)
            yield ac.Eq(self.a, 0)
        else:
            yield ac.Eq(self.a, ac.der(self.w))
            yield ac.Eq(self.a, (self.w_ref - self.w) * (2 * ac.pi * self.f_crit))

    def initial_equations(self) -> Iterator[ac.Eq]:
        if not self.exact:
            yield ac.Eq(self.w, self.w_ref)


class Accelerate(PartialElementaryOneFlangeAndSupport2):
    """The flange follows an acceleration signal ``a_ref`` [rad/s2]; ``phi`` and ``w`` start at 0."""

    ICON = icons.marked(icons.MOVED, "α")

    a_ref = ac.Input(unit="rad/s2", doc="reference acceleration")
    phi = ac.Variable(
        unit="rad", fixed=True, state="prefer", doc="angle of the flange relative to the support"
    )
    w = ac.Variable(unit="rad/s", fixed=True, state="prefer", doc="speed of the flange")
    a = ac.Variable(unit="rad/s2", doc="acceleration of the flange")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.w, ac.der(self.phi))
        yield ac.Eq(self.a, ac.der(self.w))
        yield ac.Eq(self.a, self.a_ref)


class Move(PartialElementaryOneFlangeAndSupport2):
    """The flange follows ``u = [phi, w, a]``: angle [rad], speed [rad/s] and acceleration [rad/s2].

    Where the model needs a derivative of the angle, it takes the signal; you must make sure that the three fit
    together.
    """

    ICON = icons.marked(icons.MOVED, "φωα")

    u = ac.Input(shape=3, doc="angle, speed and acceleration of the flange")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.phi, ac.prescribed(*self.u))


class ConstantSpeed(PartialElementaryOneFlangeAndSupport2):
    """The flange turns with constant speed ``w_fixed`` [rad/s], whatever the torque."""

    ICON = icons.marked(icons.MOVED, "const")

    w_fixed = ac.Parameter(unit="rad/s", doc="speed")
    w = ac.Variable(unit="rad/s", doc="speed of the flange relative to the support")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.w, ac.der(self.phi))
        yield ac.Eq(self.w, self.w_fixed)
