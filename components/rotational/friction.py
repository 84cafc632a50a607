"""Bearing friction, brake and clutches: smooth laws where Modelica switches by events."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components.laws import SMOOTHNESS, coulomb, lookup
from acausal.components.thermal.interfaces import PartialElementaryConditionalHeatPortWithoutT

from .interfaces import (
    PartialCompliantWithRelativeStates,
    PartialElementaryTwoFlangesAndSupport2,
    PartialFriction,
)

__modelica__ = "Modelica.Mechanics.Rotational.Components"


class _TabulatedFriction(PartialFriction, PartialElementaryConditionalHeatPortWithoutT):
    """Friction with a sliding part from a table and a peak at rest; it may heat a port."""

    smoothness = ac.Option("LinearSegments", choices=SMOOTHNESS, doc="interpolation of the table")
    peak = ac.Parameter(1.0, min=1, doc="static over sliding friction at w = 0")

    def _law(self, w: Any, table: Any) -> Any:
        """``table(|w|) tanh(w/w_small)``, and near rest a peak of ``peak table(0)``."""
        sliding = lookup(ac.Abs(w), table, self.smoothness)
        excess = (self.peak - 1) * lookup(0, table, self.smoothness)
        return coulomb(w, sliding, excess, self.w_small)


class _ShaftFriction(PartialElementaryTwoFlangesAndSupport2, _TabulatedFriction):
    """Both flanges turn together in the support, against a friction torque ``tau`` [N.m].

    ``flange_a.tau + flange_b.tau = tau``, ``w = der(phi)``, ``a = der(w)``, ``lossPower = tau w``.
    """

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


class _Pressed(_TabulatedFriction):
    """Friction pressed by ``fn = fn_max f_normalized`` [N]; ``mu_pos`` holds ``[w, mu]``."""

    mu_pos = ac.Parameter(
        [[0.0, 0.5]], shape=(":", ":"), doc="rows of speed and friction coefficient"
    )
    cgeo = ac.Parameter(1.0, min=0, doc="geometry constant of the friction pairing")
    fn_max = ac.Parameter(unit="N", min=0, doc="greatest normal force")
    f_normalized = ac.Input(doc="normal force as a fraction of fn_max")
    mu = ac.Variable(doc="friction coefficient, with the sign of the speed")
    fn = ac.Variable(unit="N", doc="normal force")

    @property
    def _torque(self) -> Any:
        """``cgeo mu fn``; a negative normal force presses nothing."""
        return self.mu * self.cgeo * ac.maximum(self.fn, 0)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.fn, self.fn_max * self.f_normalized)


class BearingFriction(_ShaftFriction):
    """Coulomb friction in the support, by a table ``tau_pos`` of ``[w, tau]`` [rad/s, N.m] for ``w >= 0``.

    ``tau = tau_pos(|w|) tanh(w/w_small)``, and near rest a peak of ``peak`` times ``tau_pos(0)``
    (`acausal.components.laws.coulomb`). Modelica locks at rest; here it creeps, see `PartialFriction`.
    """

    tau_pos = ac.Parameter([[0.0, 1.0]], shape=(":", ":"), doc="rows of speed and friction torque")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.tau, self._law(self.w, self.tau_pos))


class Brake(_ShaftFriction, _Pressed):
    """Friction brake, pressed by ``fn = fn_max f_normalized`` [N]; ``mu_pos`` holds ``[w, mu]``.

    ``tau = cgeo mu fn`` with ``mu = mu_pos(|w|) tanh(w/w_small)``, and near rest a peak of ``peak``
    times ``mu_pos(0)`` (`acausal.components.laws.coulomb`). A negative normal force brakes nothing.
    Modelica locks at rest; here it creeps, see `PartialFriction`.
    """

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.mu, self._law(self.w, self.mu_pos))
        yield ac.Eq(self.tau, self._torque)


class Clutch(PartialCompliantWithRelativeStates, _Pressed):
    """Friction clutch between its flanges, pressed by ``fn = fn_max f_normalized`` [N].

    ``tau = cgeo mu fn`` with ``mu = mu_pos(|w_rel|) tanh(w_rel/w_small)``, and near rest a peak of
    ``peak`` times ``mu_pos(0)`` (`acausal.components.laws.coulomb`); ``lossPower = tau w_rel``. A
    negative normal force presses nothing. Modelica locks an engaged clutch; here it creeps, see
    `PartialFriction`.
    """

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.mu, self._law(self.w_rel, self.mu_pos))
        yield ac.Eq(self.tau, self._torque)
        yield ac.Eq(self.lossPower, self.tau * self.w_rel)


class OneWayClutch(Clutch):
    """A clutch and, in parallel, a free wheel that lets ``flange_b`` run ahead of ``flange_a`` only.

    ``tau = cgeo mu fn + d_lock min(w_rel, 0)``, ``mu`` as in `Clutch`. Modelica locks at
    ``w_rel = 0``; here a stiff damper ``d_lock`` holds against turning back, and creeps with
    ``tau/d_lock``. Start it with ``w_rel >= 0``.
    """

    d_lock = ac.Parameter(1e5, unit="N.m.s/rad", min=0, doc="damping against turning back")

    @property
    def _torque(self) -> Any:
        return super()._torque + self.d_lock * ac.minimum(self.w_rel, 0)
