"""Torques: from signals, constant, or dependent on speed."""

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

from .interfaces import PartialElementaryOneFlangeAndSupport2, PartialTorque, PartialTwoFlanges

__modelica__ = "Modelica.Mechanics.Rotational.Sources"


class Torque(PartialElementaryOneFlangeAndSupport2):
    """A torque signal ``tau`` [N.m] that drives what is connected: ``flange.tau = -tau``."""

    ICON = icons.TORQUE

    tau = ac.Input(unit="N.m", doc="driving torque")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange.tau, -self.tau)


class Torque2(PartialTwoFlanges):
    """A torque signal ``tau`` [N.m] between two flanges: ``flange_a.tau = tau``, ``flange_b.tau = -tau``.

    A positive torque drives what is connected at ``flange_b`` forward, at ``flange_a`` backward.
    """

    ICON = icons.TORQUE2

    tau = ac.Input(unit="N.m", doc="driving torque")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange_a.tau, self.tau)
        yield ac.Eq(self.flange_b.tau, -self.tau)


class TorqueStep(PartialTorque):
    """Step: ``tau = offsetTorque``, from ``startTime`` on ``tau = offsetTorque + stepTorque``."""

    ICON = icons.marked(icons.TORQUE, "step")

    stepTorque = ac.Parameter(unit="N.m", doc="height of the step; a load if negative")
    offsetTorque = ac.Parameter(unit="N.m", doc="offset of the torque")
    startTime = ac.Parameter(0.0, unit="s", doc="time of the step")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        step = ac.where(ac.time < self.startTime, 0, self.stepTorque, events=None)
        yield ac.Eq(self.tau, self.offsetTorque + step)


class _SpeedDependentTorque(PartialTorque):
    """A torque that may depend on the flange's speed ``w = der(phi)`` [rad/s] against the support."""

    w = ac.Variable(unit="rad/s", doc="speed of the flange relative to the support")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.w, ac.der(self.phi))


class ConstantTorque(_SpeedDependentTorque):
    """Constant torque: ``tau = tau_constant`` [N.m]; ``w = der(phi)`` is its speed."""

    ICON = icons.marked(icons.TORQUE, "const")

    tau_constant = ac.Parameter(unit="N.m", doc="driving torque; a load if negative")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.tau, self.tau_constant)


class _NominalTorque(_SpeedDependentTorque):
    """A torque that is ``tau_nominal`` at the speed ``w_nominal``.

    With ``TorqueDirection`` it has one direction for both directions of rotation.
    """

    tau_nominal = ac.Parameter(unit="N.m", doc="nominal driving torque; a load if negative")
    TorqueDirection = ac.Option(True, doc="whether the direction is that of forward motion always")
    w_nominal = ac.Parameter(unit="rad/s", min=0, doc="nominal speed")

    @property
    def _ratio(self) -> Any:
        return self.w / self.w_nominal


class LinearSpeedDependentTorque(_NominalTorque):
    """Torque linear in speed: ``tau = tau_nominal |w/w_nominal|``.

    Without ``TorqueDirection`` ``tau = tau_nominal w/w_nominal``.
    """

    ICON = icons.marked(icons.TORQUE, "ω")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        ratio = ac.Abs(self._ratio) if self.TorqueDirection else self._ratio
        yield ac.Eq(self.tau, self.tau_nominal * ratio)


class QuadraticSpeedDependentTorque(_NominalTorque):
    """Torque quadratic in speed: ``tau = tau_nominal (w/w_nominal)**2``.

    Without ``TorqueDirection`` ``tau = tau_nominal (w/w_nominal) |w/w_nominal|``.
    """

    ICON = icons.marked(icons.TORQUE, "ω²")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        ratio = self._ratio
        square = ratio**2 if self.TorqueDirection else ratio * ac.Abs(ratio)
        yield ac.Eq(self.tau, self.tau_nominal * square)


class InverseSpeedDependentTorque(_NominalTorque):
    """Torque inverse to speed: ``tau = tau_nominal w_nominal/|w|``, constant for ``|w| < w0``.

    Without ``TorqueDirection`` ``tau = tau_nominal w_nominal/w``, and ``tau = tau_nominal w/w0`` for
    ``|w| < w0``; as in Modelica that jumps at ``w0`` unless ``w0 = w_nominal``.
    """

    ICON = icons.marked(icons.TORQUE, "1/ω")

    w0 = ac.Parameter(unit="rad/s", min=0, doc="speed below which the torque is bounded")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        shape = inverse(self.w, self.w_nominal, self.w0, one_way=self.TorqueDirection)
        yield ac.Eq(self.tau, self.tau_nominal * shape)


class SignTorque(_SpeedDependentTorque):
    """Constant torque with the sign of the speed: ``tau = tau_nominal sign(w)``.

    A positive ``tau_nominal`` [N.m] drives, a negative brakes, in both directions. The sign is
    smoothed below ``w0`` as ``reg`` says (`acausal.components.laws.regularized_sign`).
    """

    ICON = icons.marked(icons.TORQUE, "sign")

    tau_nominal = ac.Parameter(unit="N.m", doc="nominal driving torque; a load if negative")
    reg = ac.Option("Exp", choices=REGULARIZATION, doc="how the sign of w is smoothed")
    w0 = ac.Parameter(unit="rad/s", min=0, doc="speed below which the sign is smoothed")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.tau, self.tau_nominal * regularized_sign(self.w, self.w0, self.reg))


class EddyCurrentTorque(
    PartialElementaryOneFlangeAndSupport2, PartialElementaryConditionalHeatPort
):
    """Eddy current brake (Kloss): ``tau = 2 tau_max r/(1 + r**2)``, always against the motion.

    ``tau = flange.tau``, unlike the other torques. ``tau_max = excitation**2 tau_nominal`` with the
    input ``excitation`` where there is one (``useExcitationInput``), else ``constantExcitation``.
    ``r = w_normalized = w/(w_nominal (1 + alpha (TheatPort - TRef)))`` with the temperature
    coefficient ``alpha`` of `acausal.components.laws.temperature_factor`; ``lossPower = tau w``.
    """

    ICON = icons.MAGNETIC_BRAKE

    useExcitationInput = ac.Option(False, doc="whether excitation is an input")
    constantExcitation = ac.Parameter(1.0, doc="relative excitation without input")
    tau_nominal = ac.Parameter(unit="N.m", doc="greatest torque at full excitation")
    w_nominal = ac.Parameter(unit="rad/s", min=0, doc="speed of the greatest torque at TRef")
    TRef = ac.Parameter(unit="K", min=0, doc="reference temperature")
    alpha20 = ac.Parameter(unit="1/K", doc="temperature coefficient of the material at 20 degC")
    excitation = ac.Input(when="useExcitationInput", doc="relative excitation; 1 for tau_nominal")
    tau = ac.Variable(unit="N.m", doc="braking torque, = flange.tau")
    w = ac.Variable(unit="rad/s", doc="speed of the flange relative to the support")
    w_normalized = ac.Variable(doc="speed over that of the greatest torque")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        excitation = self.excitation if self.useExcitationInput else self.constantExcitation
        warmed = temperature_factor(self.TheatPort, self.TRef, self.alpha20)
        yield ac.Eq(self.tau, self.flange.tau)
        yield ac.Eq(self.w, ac.der(self.phi))
        yield ac.Eq(self.w_normalized, self.w / (self.w_nominal * warmed))
        tau_max = excitation**2 * self.tau_nominal
        yield ac.Eq(self.tau, tau_max * eddy_current(self.w_normalized))
        yield ac.Eq(self.lossPower, self.tau * self.w)
