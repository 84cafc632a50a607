"""Forces: from signals, constant, or dependent on speed."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components.laws import REGULARIZATION, regularized_sign
from acausal.components.thermal.interfaces import PartialElementaryConditionalHeatPort

from .interfaces import (
    PartialElementaryOneFlangeAndSupport2,
    PartialForce,
    PartialSpeedDependentForce,
    PartialTwoFlanges,
)


class Force(PartialElementaryOneFlangeAndSupport2):
    """A force signal ``f`` [N] that drives what is connected: ``flange.f = -f``."""

    f = ac.Input(unit="N", doc="driving force")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange.f, -self.f)


class Force2(PartialTwoFlanges):
    """A force signal ``f`` [N] between two flanges: ``flange_a.f = f``, ``flange_b.f = -f``.

    A positive force drives what is connected at ``flange_b`` forward, at ``flange_a`` backward.
    """

    f = ac.Input(unit="N", doc="driving force")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange_a.f, self.f)
        yield ac.Eq(self.flange_b.f, -self.f)


class ConstantForce(PartialForce):
    """Constant force: ``f = -f_constant``; a positive ``f_constant`` [N] drives forward."""

    f_constant = ac.Parameter(unit="N", doc="driving force; a load if negative")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, -self.f_constant)


class ForceStep(PartialForce):
    """Step: ``f = -offsetForce``, from ``startTime`` on ``f = -offsetForce - stepForce``."""

    stepForce = ac.Parameter(unit="N", doc="height of the step; a load if negative")
    offsetForce = ac.Parameter(unit="N", doc="offset of the force")
    startTime = ac.Parameter(0.0, unit="s", doc="time of the step")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        step = ac.where(ac.time < self.startTime, 0, self.stepForce)
        yield ac.Eq(self.f, -self.offsetForce - step)


class _NominalForce(PartialSpeedDependentForce):
    """A force that is ``f_nominal`` at the speed ``v_nominal``.

    With ``ForceDirection`` it has one direction for both directions of motion.
    """

    f_nominal = ac.Parameter(unit="N", doc="nominal driving force; a load if negative")
    ForceDirection = ac.Option(True, doc="whether the direction is that of forward motion always")
    v_nominal = ac.Parameter(unit="m/s", min=0, doc="nominal speed")

    @property
    def _ratio(self) -> Any:
        return self.v / self.v_nominal


class LinearSpeedDependentForce(_NominalForce):
    """Force linear in speed: ``f = -f_nominal |v/v_nominal|``.

    Without ``ForceDirection`` ``f = -f_nominal v/v_nominal``.
    """

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        ratio = ac.Abs(self._ratio) if self.ForceDirection else self._ratio
        yield ac.Eq(self.f, -self.f_nominal * ratio)


class QuadraticSpeedDependentForce(_NominalForce):
    """Force quadratic in speed: ``f = -f_nominal (v/v_nominal)**2``.

    Without ``ForceDirection`` ``f = -f_nominal (v/v_nominal) |v/v_nominal|``.
    """

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        ratio = self._ratio
        square = ratio**2 if self.ForceDirection else ratio * ac.Abs(ratio)
        yield ac.Eq(self.f, -self.f_nominal * square)


class InverseSpeedDependentForce(_NominalForce):
    """Force inverse to speed: ``f = -f_nominal v_nominal/|v|``, constant for ``|v| < v0``.

    Without ``ForceDirection`` ``f = -f_nominal v_nominal/v``, and ``f = -f_nominal v/v0`` for
    ``|v| < v0``; as in Modelica that jumps at ``v0`` unless ``v0 = v_nominal``.
    """

    v0 = ac.Parameter(unit="m/s", min=0, doc="speed below which the force is bounded")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        fast = ac.maximum(ac.Abs(self.v), self.v0)
        force = self.f_nominal * self.v_nominal / fast
        if not self.ForceDirection:
            slow = self.f_nominal * self.v / self.v0
            force = ac.where(ac.Abs(self.v) < self.v0, slow, force * ac.where(self.v < 0, -1, 1))
        yield ac.Eq(self.f, -force)


class SignForce(PartialSpeedDependentForce):
    """Constant force with the sign of the speed: ``f = -f_nominal sign(v)``.

    A positive ``f_nominal`` [N] drives, a negative brakes, in both directions. The sign is smoothed
    below ``v0`` as ``reg`` says (`acausal.components.laws.regularized_sign`).
    """

    f_nominal = ac.Parameter(unit="N", doc="nominal driving force; a load if negative")
    reg = ac.Option("Exp", choices=REGULARIZATION, doc="how the sign of v is smoothed")
    v0 = ac.Parameter(unit="m/s", min=0, doc="speed below which the sign is smoothed")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, -self.f_nominal * regularized_sign(self.v, self.v0, self.reg))


class EddyCurrentForce(PartialSpeedDependentForce, PartialElementaryConditionalHeatPort):
    """Eddy current brake (Kloss): ``f = 2 f_nominal r/(1 + r**2)``, always against the motion.

    ``r = v_normalized = v/(v_nominal (1 + alpha (TheatPort - TRef)))`` with the temperature coefficient
    ``alpha = alpha20/(1 + alpha20 (TRef - 293.15))``; ``lossPower = f v``. With
    ``useF_nominalInput`` the input ``f_input`` [N] takes the place of ``f_nominal``.
    """

    useF_nominalInput = ac.Option(False, doc="whether f_input replaces f_nominal")
    f_nominal = ac.Parameter(0.0, unit="N", doc="greatest force")
    v_nominal = ac.Parameter(unit="m/s", min=0, doc="speed of the greatest force at TRef")
    TRef = ac.Parameter(unit="K", min=0, doc="reference temperature")
    alpha20 = ac.Parameter(unit="1/K", doc="temperature coefficient of the material at 20 degC")
    f_input = ac.Input(unit="N", when="useF_nominalInput", doc="greatest force")
    v_normalized = ac.Variable(doc="speed over that of the greatest force")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        greatest = self.f_input if self.useF_nominalInput else self.f_nominal
        alpha = self.alpha20 / (1 + self.alpha20 * (self.TRef - 293.15))
        heated = 1 + alpha * (self.TheatPort - self.TRef)
        r = self.v_normalized
        yield ac.Eq(r, self.v / (self.v_nominal * heated))
        yield ac.Eq(self.f, 2 * greatest * r / (1 + r**2))
        yield ac.Eq(self.lossPower, self.f * self.v)
