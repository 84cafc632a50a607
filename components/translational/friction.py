"""Friction, brake and rolling resistance; friction by Modelica's finite state machine or by smooth laws."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.laws import (
    REGULARIZATION,
    SMOOTHNESS,
    coulomb,
    friction_over_speed,
    regularized_sign,
)
from acausal.components.thermal.interfaces import PartialElementaryConditionalHeatPortWithoutT

from .interfaces import (
    PartialElementaryTwoFlangesAndSupport2,
    PartialFriction,
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

    ICON = icons.FRICTION

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

    def _curve(self, speed: Any) -> Any:
        """The sliding friction, or its coefficient, at a speed >= 0. A subclass states it."""
        raise NotImplementedError

    @property
    def _law(self) -> Any:
        """The sliding part, with the sign of the direction; or the smooth law with its peak."""
        if not self.smooth:
            return self._direction * self._curve(self._direction * self.v)
        excess = (self.peak - 1) * self._curve(0)
        return coulomb(self.v, self._curve(ac.Abs(self.v)), excess, self.v_small)

    def _locking(self, sliding: Any, free: Any) -> Iterator[ac.Eq]:
        """What the state machine needs: the friction at rest, and where it is free."""
        yield ac.Eq(self.v_relfric, self.v)
        yield ac.Eq(self.a_relfric, self.a)
        yield ac.Eq(self.f0, sliding)
        yield ac.Eq(self.f0_max, self.peak * self.f0)
        yield ac.Eq(self.free, free)


class PartialSupportFriction(_SlidingContact):
    """Friction on the support by a curve ``f`` over ``v >= 0``, which a subclass states."""

    __modelica__ = None

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        if self.smooth:
            yield ac.Eq(self.f, self._law)
            return
        yield from self._locking(self._curve(0), 0)
        yield ac.Eq(self.f, self._friction(self._law))


class SupportFriction(PartialSupportFriction):
    """Coulomb friction on the support, by a table ``f_pos`` of ``[v, f]`` [m/s, N] for ``v >= 0``.

    While it slides, ``f`` is ``f_pos(|v|)`` with the sign of ``v``. At rest it locks, up to ``f0_max``, which is
    ``peak f_pos(0)``, see `PartialFriction`. With ``smooth``, ``f = f_pos(|v|) tanh(v/v_small)``, and near rest a peak
    of ``peak f_pos(0)`` (`acausal.components.laws.coulomb`): it creeps.
    """

    smoothness = ac.Option("LinearSegments", choices=SMOOTHNESS, doc="interpolation of the table")
    f_pos = ac.Parameter([[0.0, 1.0]], shape=(":", ":"), doc="rows of speed and friction force")

    def _curve(self, speed: Any) -> Any:
        return friction_over_speed(speed, self.f_pos, self.smoothness)


class Brake(_SlidingContact):
    """Friction brake, pressed by ``fn = fn_max f_normalized`` [N]; ``mu_pos`` holds ``[v, mu]``.

    ``f = cgeo mu fn``, where ``mu`` is ``mu_pos(|v|)`` with the sign of ``v``. At rest it locks, up to ``f0_max``,
    which is ``peak cgeo mu_pos(0) fn``, see `PartialFriction`. Without a positive normal force it is free. With
    ``smooth``, ``mu = mu_pos(|v|) tanh(v/v_small)``, and near rest a peak of ``peak mu_pos(0)``
    (`acausal.components.laws.coulomb`): it creeps.
    """

    ICON = icons.BRAKE

    smoothness = ac.Option("LinearSegments", choices=SMOOTHNESS, doc="interpolation of the table")
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
        yield ac.Eq(self.fn, self.fn_max * self.f_normalized)
        yield ac.Eq(self.mu, self._law)
        if self.smooth:
            yield ac.Eq(self.f, self.mu * self.cgeo * ac.maximum(self.fn, 0))
            return
        yield from self._locking(self._curve(0) * self.cgeo * self.fn, self.fn <= 0)
        yield ac.Eq(self.f, self._friction(self.mu * self.cgeo * self.fn))

    def _curve(self, speed: Any) -> Any:
        return friction_over_speed(speed, self.mu_pos, self.smoothness)


class RollingResistance(PartialSpeedDependentForce):
    """Rolling resistance of a wheel on a slope: ``f = cr fWeight cos(atan(inclination)) sign(v)``.

    The sign is smoothed below ``v0`` as ``reg`` says (`acausal.components.laws.regularized_sign`).
    ``cr`` and the inclination (tangent of the slope's angle) are parameters or input signals.
    """

    ICON = icons.marked(icons.FORCE, "roll")

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
