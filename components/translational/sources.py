"""Prescribed motions; forces come from their own module."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .interfaces import PartialElementaryOneFlangeAndSupport2, PartialSpeedDependentForce

__modelica__ = "Modelica.Mechanics.Translational.Sources"


class Position(PartialElementaryOneFlangeAndSupport2):
    """The flange follows a position signal ``s_ref`` [m].

    With ``exact`` ``s = s_ref``; the signal is differentiated where the model needs it, and ``v`` and
    ``a`` stay zero. Without, through a Bessel filter of second order that starts at ``s_ref``:
    ``a = ((s_ref - s) w - 1.3617 v) w / 0.6180`` with ``w = 2 pi f_crit``, ``v = der(s)``, ``a = der(v)``.
    """

    ICON = icons.marked(icons.MOVED, "s")

    exact = ac.Option(False, doc="whether to follow the signal exactly; else filtered")
    f_crit = ac.Parameter(50.0, unit="Hz", doc="critical frequency of the filter")
    s_ref = ac.Input(unit="m", doc="reference position")
    s = ac.Variable(
        unit="m", state="_priority", doc="position of the flange relative to the support"
    )
    v = ac.Variable(unit="m/s", state="_priority", doc="speed of the flange; 0 if exact")
    a = ac.Variable(unit="m/s2", doc="acceleration of the flange; 0 if exact")

    @property
    def _priority(self) -> str:
        return "default" if self.exact else "prefer"

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        if self.exact:
            yield ac.Eq(self.s, self.s_ref)
            yield ac.Eq(self.v, 0)
            yield ac.Eq(self.a, 0)
        else:
            w = 2 * ac.pi * self.f_crit
            yield ac.Eq(self.v, ac.der(self.s))
            yield ac.Eq(self.a, ac.der(self.v))
            yield ac.Eq(self.a, ((self.s_ref - self.s) * w - 1.3617 * self.v) * w / 0.618)

    def initial_equations(self) -> Iterator[ac.Eq]:
        if not self.exact:
            yield ac.Eq(self.s, self.s_ref)


class Speed(PartialElementaryOneFlangeAndSupport2):
    """The flange follows a speed signal ``v_ref`` [m/s]; ``v = der(s)``, ``s`` starts at 0.

    With ``exact`` ``v = v_ref``, and ``a`` stays zero. Without, through a filter of first order that
    starts at ``v_ref``: ``a = (v_ref - v) 2 pi f_crit``, ``a = der(v)``.
    """

    ICON = icons.marked(icons.MOVED, "v")

    exact = ac.Option(False, doc="whether to follow the signal exactly; else filtered")
    f_crit = ac.Parameter(50.0, unit="Hz", doc="critical frequency of the filter")
    v_ref = ac.Input(unit="m/s", doc="reference speed")
    s = ac.Variable(
        unit="m", fixed=True, state="prefer", doc="position of the flange relative to the support"
    )
    v = ac.Variable(unit="m/s", state="_priority", doc="speed of the flange")
    a = ac.Variable(unit="m/s2", doc="acceleration of the flange; 0 if exact")

    @property
    def _priority(self) -> str:
        return "default" if self.exact else "prefer"

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, ac.der(self.s))
        if self.exact:
            yield ac.Eq(self.v, self.v_ref)
            yield ac.Eq(self.a, 0)
        else:
            yield ac.Eq(self.a, ac.der(self.v))
            yield ac.Eq(self.a, (self.v_ref - self.v) * (2 * ac.pi * self.f_crit))

    def initial_equations(self) -> Iterator[ac.Eq]:
        if not self.exact:
            yield ac.Eq(self.v, self.v_ref)


class Accelerate(PartialElementaryOneFlangeAndSupport2):
    """The flange follows an acceleration signal ``a_ref`` [m/s2]; ``s`` and ``v`` start at 0."""

    ICON = icons.marked(icons.MOVED, "a")

    a_ref = ac.Input(unit="m/s2", doc="reference acceleration")
    s = ac.Variable(
        unit="m", fixed=True, state="prefer", doc="position of the flange relative to the support"
    )
    v = ac.Variable(unit="m/s", fixed=True, state="prefer", doc="speed of the flange")
    a = ac.Variable(unit="m/s2", doc="acceleration of the flange")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, ac.der(self.s))
        yield ac.Eq(self.a, ac.der(self.v))
        yield ac.Eq(self.a, self.a_ref)


class Move(PartialElementaryOneFlangeAndSupport2):
    """The flange follows ``u = [s, v, a]``: position [m], speed [m/s] and acceleration [m/s2].

    Where the model needs a derivative of the position, it takes the signal; you must make sure that the three
    fit together.
    """

    ICON = icons.marked(icons.MOVED, "s v a")

    u = ac.Input(shape=3, doc="position, speed and acceleration of the flange")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.s, ac.prescribed(*self.u))


class ConstantSpeed(PartialSpeedDependentForce):
    """The flange moves with constant speed ``v_fixed`` [m/s], whatever the force."""

    ICON = icons.marked(icons.MOVED, "const")

    v_fixed = ac.Parameter(unit="m/s", doc="speed")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, self.v_fixed)
