"""Springs, dampers and backlash."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.laws import bounded
from acausal.components.thermal.interfaces import PartialElementaryConditionalHeatPortWithoutT

from .interfaces import PartialCompliant, PartialCompliantWithRelativeStates

__modelica__ = "Modelica.Mechanics.Rotational.Components"


_NO_BACKLASH = 1e-10
"""A backlash up to this angle [rad] counts as none."""


class Spring(PartialCompliant):
    """Linear spring: ``tau = c (phi_rel - phi_rel0)``."""

    ICON = icons.SPRING

    c = ac.Parameter(unit="N.m/rad", min=0, doc="spring constant")
    phi_rel0 = ac.Parameter(0.0, unit="rad", doc="angle of the unstretched spring")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.tau, self.c * (self.phi_rel - self.phi_rel0))


class Damper(PartialCompliantWithRelativeStates, PartialElementaryConditionalHeatPortWithoutT):
    """Linear damper: ``tau = d w_rel``, ``lossPower = tau w_rel``."""

    ICON = icons.DAMPER

    d = ac.Parameter(unit="N.m.s/rad", min=0, doc="damping constant")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.tau, self.d * self.w_rel)
        yield ac.Eq(self.lossPower, self.tau * self.w_rel)


class SpringDamper(
    PartialCompliantWithRelativeStates, PartialElementaryConditionalHeatPortWithoutT
):
    """Spring and damper side by side: ``tau = c (phi_rel - phi_rel0) + d w_rel``.

    ``lossPower = d w_rel**2`` is what the damper takes.
    """

    ICON = icons.SPRING_DAMPER

    c = ac.Parameter(unit="N.m/rad", min=0, doc="spring constant")
    d = ac.Parameter(unit="N.m.s/rad", min=0, doc="damping constant")
    phi_rel0 = ac.Parameter(0.0, unit="rad", doc="angle of the unstretched spring")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.tau, self.c * (self.phi_rel - self.phi_rel0) + self.d * self.w_rel)
        yield ac.Eq(self.lossPower, self.d * self.w_rel**2)


class _Backlash(PartialCompliantWithRelativeStates, PartialElementaryConditionalHeatPortWithoutT):
    """Spring and damper behind a backlash; a subclass says how much the damper counts in contact."""

    ICON = icons.BACKLASH

    c = ac.Parameter(unit="N.m/rad", min=0, doc="spring constant")
    d = ac.Parameter(unit="N.m.s/rad", min=0, doc="damping constant")
    b = ac.Parameter(0.0, unit="rad", min=0, doc="total backlash")
    phi_rel0 = ac.Parameter(0.0, unit="rad", doc="angle of the unstretched spring")
    tau_c = ac.Variable(unit="N.m", doc="spring torque")
    tau_d = ac.Variable(unit="N.m", doc="damping torque, if it counted fully")

    @property
    def _damping(self) -> Any:
        """Damping torque while the contact pushes."""
        return self.tau_d

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        angle = self.phi_rel - self.phi_rel0
        pushes = self.tau_c * (self.tau_c + self.tau_d) > 0
        touches = (angle > self.b / 2) | (angle < -self.b / 2)

        def contact(always: Any, pushing: Any) -> Any:
            touching = ac.where(pushes, pushing, 0)
            behind = ac.where(touches, touching, 0, events=None)
            return ac.where(self.b <= _NO_BACKLASH, always, behind)

        yield ac.Eq(self.tau_c, self.c * (angle - bounded(angle, self.b / 2)))
        yield ac.Eq(self.tau_d, self.d * self.w_rel)
        yield ac.Eq(self.tau, contact(self.tau_c + self.tau_d, self.tau_c + self._damping))
        yield ac.Eq(self.lossPower, contact(self.tau_d, self._damping) * self.w_rel)


class ElastoBacklash(_Backlash):
    """Spring and damper behind a backlash; the torque never pulls, and is continuous at contact.

    ``tau_c = c x`` and ``tau_d = d w_rel``, where ``x`` is how far ``phi_rel - phi_rel0`` lies outside
    of ``-b/2 .. b/2``. While ``tau_c + tau_d`` has the sign of ``tau_c``, ``tau`` is ``tau_c`` plus
    ``tau_d``, bounded to ``|tau_d| <= |tau_c|``, and ``lossPower`` is the bounded ``tau_d`` times
    ``w_rel``; else both are 0. Without backlash (``b`` up to 1e-10) it is a `SpringDamper`. Modelica
    smooths the backlash for the initialization; here the law holds then, too.
    """

    @property
    def _damping(self) -> Any:
        return bounded(self.tau_d, ac.Abs(self.tau_c))


class ElastoBacklash2(_Backlash):
    """Spring and damper behind a backlash; the torque never pulls, and jumps at contact.

    As `ElastoBacklash`, but ``tau_d`` counts fully: ``tau = tau_c + tau_d`` while that has the sign of
    ``tau_c``, else 0. In models with events, steps end where contact begins.
    """

    ICON = icons.marked(icons.BACKLASH, "2")
