"""Friction, brake and stop: smooth laws where Modelica switches by events."""

from collections.abc import Iterator

import acausal as ac
from acausal.components.choices import STATE_SELECT
from acausal.components.laws import (
    REGULARIZATION,
    SMOOTHNESS,
    coulomb,
    impact,
    lookup,
    regularized_sign,
)
from acausal.components.thermal.interfaces import PartialElementaryConditionalHeatPortWithoutT

from .interfaces import (
    PartialElementaryTwoFlangesAndSupport2,
    PartialFriction,
    PartialRigid,
    PartialSpeedDependentForce,
)

__modelica__ = "Modelica.Mechanics.Translational.Components"


class _SlidingContact(
    PartialElementaryTwoFlangesAndSupport2,
    PartialFriction,
    PartialElementaryConditionalHeatPortWithoutT,
):
    """Both flanges slide together on the support, against a friction force ``f`` [N].

    ``flange_a.f + flange_b.f = f``, ``v = der(s)``, ``a = der(v)``, ``lossPower = f v``.
    """

    smoothness = ac.Option("LinearSegments", choices=SMOOTHNESS, doc="interpolation of the table")
    peak = ac.Parameter(1.0, min=1, doc="static over sliding friction at v = 0")
    s = ac.Variable(unit="m", doc="position of the flanges relative to the support")
    v = ac.Variable(unit="m/s", doc="speed of the flanges relative to the support")
    a = ac.Variable(unit="m/s2", doc="acceleration of the flanges")
    f = ac.Variable(unit="N", doc="friction force")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.s, self.s_a)
        yield ac.Eq(self.s, self.s_b)
        yield ac.Eq(self.v, ac.der(self.s))
        yield ac.Eq(self.a, ac.der(self.v))
        yield ac.Eq(self.flange_a.f + self.flange_b.f, self.f)
        yield ac.Eq(self.lossPower, self.f * self.v)


class SupportFriction(_SlidingContact):
    """Coulomb friction on the support, by a table ``f_pos`` of ``[v, f]`` [m/s, N] for ``v >= 0``.

    ``f = f_pos(|v|) tanh(v/v_small)``, and near rest a peak of ``peak`` times ``f_pos(0)``
    (`acausal.components.laws.coulomb`). Modelica locks at rest; here it creeps, see `PartialFriction`.
    """

    f_pos = ac.Parameter([[0.0, 1.0]], shape=(":", ":"), doc="rows of speed and friction force")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        sliding = lookup(ac.Abs(self.v), self.f_pos, self.smoothness)
        excess = (self.peak - 1) * lookup(0, self.f_pos, self.smoothness)
        yield ac.Eq(self.f, coulomb(self.v, sliding, excess, self.v_small))


class Brake(_SlidingContact):
    """Friction brake, pressed by ``fn = fn_max f_normalized`` [N]; ``mu_pos`` holds ``[v, mu]``.

    ``f = cgeo mu fn`` with ``mu = mu_pos(|v|) tanh(v/v_small)``, and near rest a peak of ``peak``
    times ``mu_pos(0)`` (`acausal.components.laws.coulomb`). A negative normal force brakes nothing.
    Modelica locks at rest; here it creeps, see `PartialFriction`.
    """

    mu_pos = ac.Parameter(
        [[0.0, 0.5]], shape=(":", ":"), doc="rows of speed and friction coefficient"
    )
    cgeo = ac.Parameter(1.0, min=0, doc="geometry constant of the friction pairing")
    fn_max = ac.Parameter(unit="N", min=0, doc="greatest normal force")
    f_normalized = ac.Input(doc="normal force as a fraction of fn_max")
    mu = ac.Variable(doc="friction coefficient, with the sign of v")
    fn = ac.Variable(unit="N", doc="normal force")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        sliding = lookup(ac.Abs(self.v), self.mu_pos, self.smoothness)
        excess = (self.peak - 1) * lookup(0, self.mu_pos, self.smoothness)
        yield ac.Eq(self.fn, self.fn_max * self.f_normalized)
        yield ac.Eq(self.mu, coulomb(self.v, sliding, excess, self.v_small))
        yield ac.Eq(self.f, self.mu * self.cgeo * ac.maximum(self.fn, 0))


class MassWithStopAndFriction(
    PartialRigid, PartialFriction, PartialElementaryConditionalHeatPortWithoutT
):
    """A sliding mass with Stribeck friction ``f`` [N] between two stops.

    ``m a = flange_a.f + flange_b.f - f - f_stop``;
    ``f = F_prop v + (F_Coulomb + F_Stribeck exp(-fexp |v|)) tanh(v/v_small)``.

    Modelica locks at rest and reinitializes at a stop. Here the friction creeps, and the stops at
    ``smin`` and ``smax`` are stiff: where an end of the mass goes beyond, ``c_stop`` and ``d_stop``
    push back but never pull (`acausal.components.laws.impact`); the impact is inelastic but for a
    rebound slower than ``1/d_stop``. ``stopped`` is -1 at ``smin``, 1 at ``smax``, else 0.
    ``lossPower = f v`` leaves out the impacts.
    """

    m = ac.Parameter(unit="kg", min=0, doc="mass")
    smax = ac.Parameter(unit="m", doc="right stop for the right end")
    smin = ac.Parameter(unit="m", doc="left stop for the left end")
    F_prop = ac.Parameter(unit="N.s/m", min=0, doc="viscous friction")
    F_Coulomb = ac.Parameter(unit="N", doc="constant friction")
    F_Stribeck = ac.Parameter(unit="N", doc="excess of friction at rest")
    fexp = ac.Parameter(unit="s/m", min=0, doc="decay of the Stribeck effect")
    c_stop = ac.Parameter(1e7, unit="N/m", min=0, doc="stiffness of the stops")
    d_stop = ac.Parameter(1e3, unit="s/m", min=0, doc="damping of the stops")
    stateSelect = ac.Option("prefer", choices=STATE_SELECT, doc="priority of s and v as states")
    s = ac.Variable(unit="m", state="stateSelect", doc="position of the centre")
    v = ac.Variable(unit="m/s", state="stateSelect", doc="speed")
    a = ac.Variable(unit="m/s2", doc="acceleration")
    f = ac.Variable(unit="N", doc="friction force")
    f_stop = ac.Variable(unit="N", doc="force of the stops, positive at smax")
    stopped = ac.Variable(doc="-1 at smin, 1 at smax, else 0")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        right = self.flange_b.s - self.smax
        left = self.smin - self.flange_a.s
        push_left = impact(right, self.v, self.c_stop, self.d_stop)
        push_right = impact(left, -self.v, self.c_stop, self.d_stop)
        dry = self.F_Coulomb + self.F_Stribeck * ac.exp(-self.fexp * ac.Abs(self.v))
        yield ac.Eq(self.v, ac.der(self.s))
        yield ac.Eq(self.a, ac.der(self.v))
        yield ac.Eq(self.m * self.a, self.flange_a.f + self.flange_b.f - self.f - self.f_stop)
        yield ac.Eq(self.f, self.F_prop * self.v + coulomb(self.v, dry, 0, self.v_small))
        yield ac.Eq(self.f_stop, push_left - push_right)
        yield ac.Eq(self.stopped, ac.where(right >= 0, 1, ac.where(left >= 0, -1, 0)))
        yield ac.Eq(self.lossPower, self.f * self.v)


class RollingResistance(PartialSpeedDependentForce):
    """Rolling resistance of a wheel on a slope: ``f = cr fWeight cos(atan(inclination)) sign(v)``.

    The sign is smoothed below ``v0`` as ``reg`` says (`acausal.components.laws.regularized_sign`).
    ``cr`` and the inclination (tangent of the slope's angle) are parameters or input signals.
    """

    fWeight = ac.Parameter(unit="N", doc="load of the wheel by gravity")
    useCrInput = ac.Option(False, doc="whether cr is an input")
    CrConstant = ac.Parameter(0.01, doc="coefficient of rolling resistance without input")
    useInclinationInput = ac.Option(False, doc="whether inclination is an input")
    inclinationConstant = ac.Parameter(0.0, doc="inclination without input, = tan(angle)")
    reg = ac.Option("Exp", choices=REGULARIZATION, doc="how the sign of v is smoothed")
    v0 = ac.Parameter(0.1, unit="m/s", min=0, doc="speed below which the sign is smoothed")
    inclination = ac.Input(when="useInclinationInput", doc="inclination, = tan(angle)")
    cr = ac.Input(when="useCrInput", doc="coefficient of rolling resistance")
    f_nominal = ac.Variable(unit="N", doc="resistance without smoothing, negative")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        cr = self.cr if self.useCrInput else self.CrConstant
        slope = self.inclination if self.useInclinationInput else self.inclinationConstant
        yield ac.Eq(self.f_nominal, -cr * self.fWeight * ac.cos(ac.atan(slope)))
        yield ac.Eq(self.f, -self.f_nominal * regularized_sign(self.v, self.v0, self.reg))
