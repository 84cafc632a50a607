"""The frame of planar mechanics, and the bases of components that have frames."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import thermal

__modelica__ = "PlanarMechanics.Interfaces"


class Frame(ac.Connector):
    """Position ``x``, ``y`` [m] and angle ``phi`` [rad] in the world; forces ``fx``, ``fy`` [N] and torque ``t`` [N.m].

    Forces and torque are positive into the component and are resolved in the world; angles and torques are positive
    counter-clockwise.
    """

    x = ac.Potential(unit="m", doc="position along the world's x-axis")
    y = ac.Potential(unit="m", doc="position along the world's y-axis")
    phi = ac.Potential(unit="rad", doc="angle against the world")
    fx = ac.Flow(unit="N", doc="cut force along the world's x-axis")
    fy = ac.Flow(unit="N", doc="cut force along the world's y-axis")
    t = ac.Flow(unit="N.m", doc="cut torque")

    pair = ("frame_a", "frame_b")
    second_minus_first = True
    power = False
    COLOR = "#b08a2e"


Frame_a = Frame_b = Frame_resolve = Frame


class PartialTwoFrames(ac.Component):
    """Two frames without equations."""

    frame_a = Frame()
    frame_b = Frame()


class PartialTwoFramesAndHeat(
    PartialTwoFrames, thermal.PartialElementaryConditionalHeatPortWithoutT
):
    """Two frames and, with ``useHeatPort``, a heat port; a subclass states ``lossPower``."""


class ZeroPosition(ac.Component):
    """A frame at the origin of the world: ``frame_resolve.x = frame_resolve.y = frame_resolve.phi = 0``."""

    frame_resolve = Frame()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.frame_resolve.x, 0)
        yield ac.Eq(self.frame_resolve.y, 0)
        yield ac.Eq(self.frame_resolve.phi, 0)


class Offset(PartialTwoFrames):
    """Two frames of the same angle, a vector ``r0`` [m] apart that is resolved in the world; a subclass states ``r0``.

    Forces and torques are in balance, with the force at ``frame_b`` acting at the end of ``r0``.
    """

    __modelica__ = None

    r0 = ac.Variable(unit="m", shape=2, doc="from frame_a to frame_b, resolved in the world")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        yield ac.Eq(a.x + self.r0[0], b.x)
        yield ac.Eq(a.y + self.r0[1], b.y)
        yield ac.Eq(a.phi, b.phi)
        yield ac.Eq(a.fx + b.fx, 0)
        yield ac.Eq(a.fy + b.fy, 0)
        yield ac.Eq(a.t + b.t + self.r0[0] * b.fy - self.r0[1] * b.fx, 0)
