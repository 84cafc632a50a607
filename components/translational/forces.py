"""Forces: from signals, constant, or dependent on speed."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.laws import (
    REGULARIZATION,
    eddy_current,
    inverse,
    regularized_sign,
    temperature_factor,
)
from acausal.components.thermal.interfaces import PartialElementaryConditionalHeatPort

from .interfaces import (
    PartialElementaryOneFlangeAndSupport2,
    PartialForce,
    PartialSpeedDependentForce,
    PartialTwoFlanges,
)

__modelica__ = "Modelica.Mechanics.Translational.Sources"


class Force(PartialElementaryOneFlangeAndSupport2):
    """A force signal ``f`` [N] that drives what is connected: ``flange.f = -f``."""

    ICON = icons.FORCE

    f = ac.Input(unit="N", doc="driving force")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange.f, -self.f)


class Force2(PartialTwoFlanges):
    """A force signal ``f`` [N] between two flanges: ``flange_a.f = f``, ``flange_b.f = -f``.

    A positive force drives what is connected at ``flange_b`` forward, at ``flange_a`` backward.
    """

    ICON = icons.FORCE2

    f = ac.Input(unit="N", doc="driving force")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange_a.f, self.f)
        yield ac.Eq(self.flange_b.f, -self.f)


class ConstantForce(PartialForce):
    """Constant force: ``f = -f_constant``; a positive ``f_constant`` [N] drives forward."""

    ICON = icons.marked(icons.FORCE, "const")

    f_constant = ac.Parameter(unit="N", doc="driving force; a load if negative")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, -self.f_constant)


class ForceStep(PartialForce):
    """Step: ``f = -offsetForce``, from ``startTime`` on ``f = -offsetForce - stepForce``."""

    ICON = icons.marked(icons.FORCE, "step")

    stepForce = ac.Parameter(unit="N", doc="height of the step; a load if negative")
    offsetForce = ac.Parameter(unit="N", doc="offset of the force")
    startTime = ac.Parameter(0.0, unit="s", doc="time of the step")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        step = ac.where(ac.time < self.startTime, 0, self.stepForce, events=None)
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

    ICON = icons.marked(icons.FORCE, "v")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        ratio = ac.Abs(self._ratio) if self.ForceDirection else self._ratio
        yield ac.Eq(self.f, -self.f_nominal * ratio)


class QuadraticSpeedDependentForce(_NominalForce):
    """Force quadratic in speed: ``f = -f_nominal (v/v_nominal)**2``.

    Without ``ForceDirection`` ``f = -f_nominal (v/v_nominal) |v/v_nominal|``.
    """

    ICON = icons.marked(icons.FORCE, "v²")

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

    ICON = icons.marked(icons.FORCE, "1/v")

    v0 = ac.Parameter(unit="m/s", min=0, doc="speed below which the force is bounded")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        shape = inverse(self.v, self.v_nominal, self.v0, one_way=self.ForceDirection)
        yield ac.Eq(self.f, -self.f_nominal * shape)


class SignForce(PartialSpeedDependentForce):
    """Constant force with the sign of the speed: ``f = -f_nominal sign(v)``.

    A positive ``f_nominal`` [N] drives, a negative brakes, in both directions. The sign is smoothed
    below ``v0`` as ``reg`` says (`acausal.components.laws.regularized_sign`).
    """

    ICON = icons.marked(icons.FORCE, "sign")

    f_nominal = ac.Parameter(unit="N", doc="nominal driving force; a load if negative")
    reg = ac.Option("Exp", choices=REGULARIZATION, doc="how the sign of v is smoothed")
    v0 = ac.Parameter(unit="m/s", min=0, doc="speed below which the sign is smoothed")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, -self.f_nominal * regularized_sign(self.v, self.v0, self.reg))


class EddyCurrentForce(PartialElementaryOneFlangeAndSupport2, PartialElementaryConditionalHeatPort):
    """Eddy current brake (Kloss): ``f = 2 f_max r/(1 + r**2)``, always against the motion.

    ``f = flange.f``, unlike the other forces. ``f_max = excitation**2 f_nominal`` with the input
    ``excitation`` where there is one (``useExcitationInput``), else ``constantExcitation``.
    ``r = v_normalized = v/(v_nominal (1 + alpha (TheatPort - TRef)))`` with the temperature
    coefficient ``alpha`` of `acausal.components.laws.temperature_factor`; ``lossPower = f v``.
    """

    ICON = icons.MAGNETIC_BRAKE

    useExcitationInput = ac.Option(False, doc="whether excitation is an input")
    constantExcitation = ac.Parameter(1.0, doc="relative excitation without input")
    f_nominal = ac.Parameter(unit="N", doc="greatest force at full excitation")
    v_nominal = ac.Parameter(unit="m/s", min=0, doc="speed of the greatest force at TRef")
    TRef = ac.Parameter(unit="K", min=0, doc="reference temperature")
    alpha20 = ac.Parameter(unit="1/K", doc="temperature coefficient of the material at 20 degC")
    excitation = ac.Input(when="useExcitationInput", doc="relative excitation; 1 for f_nominal")
    f = ac.Variable(unit="N", doc="braking force, = flange.f")
    v = ac.Variable(unit="m/s", doc="speed of the flange relative to the support")
    v_normalized = ac.Variable(doc="speed over that of the greatest force")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        excitation = self.excitation if self.useExcitationInput else self.constantExcitation
        warmed = temperature_factor(self.TheatPort, self.TRef, self.alpha20)
        yield ac.Eq(self.f, self.flange.f)
        yield ac.Eq(self.v, ac.der(self.s))
        yield ac.Eq(self.v_normalized, self.v / (self.v_nominal * warmed))
        yield ac.Eq(self.f, excitation**2 * self.f_nominal * eddy_current(self.v_normalized))
        yield ac.Eq(self.lossPower, self.f * self.v)
