"""Elements that join rotation and translation."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from . import rotational, translational

__modelica__ = (
    "Modelica.Mechanics.Rotational.Components",
    "Modelica.Mechanics.Translational.Components",
)


class PartialElementaryRotationalToTranslational(ac.Component):
    """A rotational flange ``flangeR`` and a translational one ``flangeT``, each with its support.

    The supports exist with ``useSupportR`` and ``useSupportT``; else that side works against the
    ground. ``supportR.tau = -flangeR.tau``, ``supportT.f = -flangeT.f``.
    """

    ICON = icons.ROLLING

    __modelica__ = (
        "Modelica.Mechanics.Rotational.Interfaces",
        "Modelica.Mechanics.Translational.Interfaces",
    )

    useSupportR = ac.Option(False, doc="whether there is a rotational support flange")
    useSupportT = ac.Option(False, doc="whether there is a translational support flange")
    flangeR = rotational.Flange()
    flangeT = translational.Flange()
    supportR = rotational.Support(when="useSupportR")
    supportT = translational.Support(when="useSupportT")

    @property
    def phi(self) -> Any:
        """Angle of ``flangeR`` relative to its support."""
        return self.flangeR.phi - self.supportR.phi if self.useSupportR else self.flangeR.phi

    @property
    def s(self) -> Any:
        """Position of ``flangeT`` relative to its support."""
        return self.flangeT.s - self.supportT.s if self.useSupportT else self.flangeT.s

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        if self.useSupportR:
            yield ac.Eq(self.supportR.tau, -self.flangeR.tau)
        if self.useSupportT:
            yield ac.Eq(self.supportT.f, -self.flangeT.f)


class IdealGearR2T(PartialElementaryRotationalToTranslational):
    """Ideal gear from rotation to translation, such as a rack and pinion.

    ``phi = ratio s``, ``0 = ratio flangeR.tau + flangeT.f``; angle and position count from the supports.
    """

    ICON = icons.RACK

    ratio = ac.Parameter(unit="rad/m", doc="transmission ratio flangeR.phi / flangeT.s")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.phi, self.ratio * self.s)
        yield ac.Eq(0, self.ratio * self.flangeR.tau + self.flangeT.f)


class IdealRollingWheel(PartialElementaryRotationalToTranslational):
    """A wheel without inertia that rolls without slip.

    ``phi radius = s``, ``0 = radius flangeT.f + flangeR.tau``; angle and position count from the supports.
    """

    radius = ac.Parameter(unit="m", doc="radius of the wheel")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.phi * self.radius, self.s)
        yield ac.Eq(0, self.radius * self.flangeT.f + self.flangeR.tau)
