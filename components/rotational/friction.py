"""Bearing friction, brake and clutches, by Modelica's finite state machine or by smooth laws."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.laws import SMOOTHNESS, coulomb, friction_over_speed
from acausal.components.mechanics.friction import AWAKE, Locking
from acausal.components.thermal.interfaces import PartialElementaryConditionalHeatPortWithoutT

from .interfaces import (
    PartialCompliantWithRelativeStates,
    PartialElementaryTwoFlangesAndSupport2,
    PartialFriction,
    _smooth_width,
)

__modelica__ = "Modelica.Mechanics.Rotational.Components"

_HYSTERESIS = 1e-4
"""How much more holds a locked one-way clutch, at least, than a sliding one, relative to the friction."""


class _ByCurve(PartialElementaryConditionalHeatPortWithoutT):
    """Friction with a sliding part from a curve and a peak at rest; it may heat a port."""

    peak = ac.Parameter(1.0, min=1, doc="static over sliding friction at w = 0")

    def _curve(self, speed: Any) -> Any:
        """The sliding friction, or its coefficient, at a speed >= 0. A subclass states it."""
        raise NotImplementedError

    def _smoothed(self, w: Any, width: Any) -> Any:
        """The smooth law with its peak."""
        return coulomb(w, self._curve(ac.Abs(w)), (self.peak - 1) * self._curve(0), width)


class _Pressed(_ByCurve):
    """Friction pressed by ``fn`` [N]; ``mu_pos`` holds ``[w, mu]``."""

    smoothness = ac.Option("LinearSegments", choices=SMOOTHNESS, doc="interpolation of the table")
    mu_pos = ac.Parameter(
        [[0.0, 0.5]], shape=(":", ":"), doc="rows of speed and friction coefficient"
    )
    cgeo = ac.Parameter(1.0, min=0, doc="geometry constant of the friction pairing")
    fn_max = ac.Parameter(unit="N", min=0, doc="greatest normal force")
    f_normalized = ac.Input(doc="normal force as a fraction of fn_max")
    mu = ac.Variable(doc="friction coefficient, with the sign of the speed")
    fn = ac.Variable(unit="N", doc="normal force")

    def _curve(self, speed: Any) -> Any:
        return friction_over_speed(speed, self.mu_pos, self.smoothness)

    @property
    def _at_rest(self) -> Any:
        """Torque when it begins to slide."""
        return self._curve(0) * self.cgeo * self.fn

    @property
    def _sliding(self) -> Any:
        """Torque while it slides."""
        return self.mu * self.cgeo * self.fn


class _Switched(PartialFriction, _ByCurve):
    """Friction by the finite state machine, or by the smooth law."""

    def _law(self, w: Any) -> Any:
        """The sliding part, with the sign of the direction; or the smooth law with its peak."""
        if not self.smooth:
            return self._direction * self._curve(self._direction * w)
        return self._smoothed(w, self._width)

    def _locking(self, w: Any, a: Any, sliding: Any, free: Any) -> Iterator[ac.Eq]:
        """What the state machine needs: a speed ``w``, an acceleration ``a`` and the friction at rest."""
        yield ac.Eq(self.w_relfric, w)
        yield ac.Eq(self.a_relfric, a)
        yield ac.Eq(self.tau0, sliding)
        yield ac.Eq(self.tau0_max, self.peak * self.tau0)
        yield ac.Eq(self.free, free)


class _ShaftFriction(PartialElementaryTwoFlangesAndSupport2, _Switched):
    """Both flanges turn together in the support, against a friction torque ``tau`` [N.m].

    ``flange_a.tau + flange_b.tau = tau``, ``w = der(phi)``, ``a = der(w)``, ``lossPower = tau w``.
    """

    ICON = icons.FRICTION

    phi = ac.Variable(unit="rad", doc="angle of the flanges relative to the support")
    w = ac.Variable(unit="rad/s", doc="speed of the flanges relative to the support")
    a = ac.Variable(unit="rad/s2", doc="acceleration of the flanges")
    tau = ac.Variable(unit="N.m", doc="friction torque")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.phi, self.phi_a)
        yield ac.Eq(self.phi, self.phi_b)
        yield ac.Eq(self.w, ac.der(self.phi))
        yield ac.Eq(self.a, ac.der(self.w))
        yield ac.Eq(self.flange_a.tau + self.flange_b.tau, self.tau)
        yield ac.Eq(self.lossPower, self.tau * self.w)


class _PressedFriction(_Switched, _Pressed):
    """Friction pressed by ``fn = fn_max f_normalized`` [N], by the state machine or smooth."""

    def _pressing(self, w: Any, a: Any, torque: Any) -> Iterator[ac.Eq]:
        """The friction ``torque`` at a speed ``w`` and an acceleration ``a``."""
        yield ac.Eq(self.fn, self.fn_max * self.f_normalized)
        yield ac.Eq(self.mu, self._law(w))
        if self.smooth:
            yield ac.Eq(torque, self.mu * self.cgeo * ac.maximum(self.fn, 0))
            return
        yield from self._locking(w, a, self._at_rest, self.fn <= 0)
        yield ac.Eq(torque, self._friction(self._sliding))


class PartialBearingFriction(_ShaftFriction):
    """Friction in the support by a curve ``tau`` over ``w >= 0``, which a subclass states."""

    __modelica__ = None

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        sliding = self._law(self.w)
        if self.smooth:
            yield ac.Eq(self.tau, sliding)
            return
        yield from self._locking(self.w, self.a, self._curve(0), 0)
        yield ac.Eq(self.tau, self._friction(sliding))


class BearingFriction(PartialBearingFriction):
    """Coulomb friction in the support, by a table ``tau_pos`` of ``[w, tau]`` [rad/s, N.m] for ``w >= 0``.

    While it slides, ``tau`` is ``tau_pos(|w|)`` with the sign of ``w``. At rest it locks, up to ``tau0_max``, which is
    ``peak tau_pos(0)``, see `PartialFriction`. With ``smooth``, ``tau = tau_pos(|w|) tanh(w/w_small)``, and near rest
    a peak of ``peak tau_pos(0)`` (`acausal.components.laws.coulomb`): it creeps.
    """

    smoothness = ac.Option("LinearSegments", choices=SMOOTHNESS, doc="interpolation of the table")
    tau_pos = ac.Parameter([[0.0, 1.0]], shape=(":", ":"), doc="rows of speed and friction torque")

    def _curve(self, speed: Any) -> Any:
        return friction_over_speed(speed, self.tau_pos, self.smoothness)


class Brake(_ShaftFriction, _PressedFriction):
    """Friction brake, pressed by ``fn = fn_max f_normalized`` [N]; ``mu_pos`` holds ``[w, mu]``.

    ``tau = cgeo mu fn``, where ``mu`` is ``mu_pos(|w|)`` with the sign of ``w``. At rest it locks, up to ``tau0_max``,
    which is ``peak cgeo mu_pos(0) fn``, see `PartialFriction`. Without a positive normal force it is free. With
    ``smooth``, ``mu = mu_pos(|w|) tanh(w/w_small)``, and near rest a peak of ``peak mu_pos(0)``
    (`acausal.components.laws.coulomb`): it creeps.
    """

    ICON = icons.BRAKE

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from self._pressing(self.w, self.a, self.tau)


class Clutch(PartialCompliantWithRelativeStates, _PressedFriction):
    """Friction clutch between its flanges, pressed by ``fn = fn_max f_normalized`` [N].

    The law is that of `Brake` with the relative speed ``w_rel``; ``lossPower = tau w_rel``. An engaged clutch locks
    where ``w_rel`` becomes zero; with ``smooth`` it creeps.
    """

    ICON = icons.CLUTCH

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from self._pressing(self.w_rel, self.a_rel, self.tau)
        yield ac.Eq(self.lossPower, self.tau * self.w_rel)


class OneWayClutch(PartialCompliantWithRelativeStates, _Pressed, Locking):
    """A clutch and, in parallel, a free wheel that lets ``flange_b`` run ahead of ``flange_a`` only.

    While ``w_rel > 0``, ``tau = cgeo mu fn`` with ``mu = mu_pos(w_rel)``, and nothing where it is ``free``. At
    ``w_rel = 0`` it is ``locked``, ``tau = sa`` is what holds it, up to ``tau0_max``; backward it holds any torque.
    ``lossPower = tau w_rel``. Start it with ``w_rel >= 0``. With ``smooth``, ``mu`` is that of `Clutch`, and a stiff
    damper ``d_lock`` holds against turning back: ``tau = cgeo mu fn + d_lock min(w_rel, 0)`` creeps with
    ``tau/d_lock``.
    """

    ICON = icons.ONE_WAY

    w_small = ac.Parameter(
        1e10, unit="rad/s", min=0, doc="as for PartialFriction, where Reinit changes w_rel"
    )
    d_lock = ac.Parameter(
        1e5, unit="N.m.s/rad", min=0, doc="damping against turning back, with smooth"
    )
    tau0 = ac.Variable(unit="N.m", when="_locks", doc="friction at rest, sliding")
    tau0_max = ac.Variable(unit="N.m", when="_locks", doc="greatest friction while locked")
    free = ac.Discrete(kind="bool", when="_locks", doc="1 where nothing presses the clutch")
    stuck = ac.Discrete(kind="bool", when="_locks", doc="1 where w_rel = 0")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        pressed = self.fn_max * self.f_normalized
        if self.smooth:
            friction = self.mu * self.cgeo * ac.maximum(self.fn, 0)
            yield ac.Eq(self.fn, pressed)
            yield ac.Eq(self.mu, self._smoothed(self.w_rel, _smooth_width(self.w_small)))
            yield ac.Eq(self.tau, friction + self.d_lock * ac.minimum(self.w_rel, 0))
            yield ac.Eq(self.lossPower, self.tau * self.w_rel)
            return
        least = _HYSTERESIS * self._curve(0) * self.cgeo * self.fn_max
        peak = ac.maximum(self.peak, 1 + _HYSTERESIS)
        yield ac.Eq(self.free, self.f_normalized <= 0)
        yield ac.Eq(self.fn, ac.where(self.free, 0, pressed))
        yield ac.Eq(self.mu, self._curve(self.w_rel))
        yield ac.Eq(self.tau0, self._at_rest)
        yield ac.Eq(self.tau0_max, ac.where(self.free, least, peak * self.tau0))
        yield from self._wheel()
        moves = 1 - self.locked
        yield ac.Eq(self.a_rel, ac.where(self.locked, 0, self.sa) - moves * self.tau0_max)
        sliding = ac.where(self.free, 0, self._sliding)
        yield ac.Eq(self.tau, ac.where(self.locked, self.sa, sliding))
        yield ac.Eq(self.lossPower, ac.where(self.stuck, 0, self.tau * self.w_rel))

    def _wheel(self) -> Iterator[ac.Eq]:
        """When it is locked, and when it starts; ``sa`` and ``w_rel`` are watched only where they count."""
        was_stuck = ac.pre(self.stuck)
        to_move = self.tau0_max - ac.pre(self.startForward) * (self.tau0_max - self.tau0)
        gives_way = was_stuck * (self.locked + self.startForward) * (self.sa - to_move) > 0
        runs = (1 - self.locked) * (self.w_rel - self.startForward * was_stuck * AWAKE) > 0
        starts = (was_stuck > 0.5) & (gives_way | (self.w_rel > self.w_small))
        yield ac.Eq(self.startForward, starts | (ac.initial() & runs))
        yield ac.Eq(self.locked, (was_stuck > 0.5) & ~(self.startForward > 0.5))
        yield ac.Eq(self.stuck, ~runs)
