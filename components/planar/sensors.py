"""Sensors: quantities of frames as output signals, without a reaction on the frames.

Vectors have three elements: along x, along y, and the angle. ``resolveInFrame`` says along which axes: those of the
``world``, of ``frame_a``, of ``frame_b``, or of a further frame ``frame_resolve``, which exists only then.
"""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .conventions import ABSOLUTE, ARROW, RELATIVE, coincident, equal, free, turned
from .interfaces import Frame, PartialTwoFrames

__modelica__ = "PlanarMechanics.Sensors"


class PartialResolving(ac.Component):
    """Base of what resolves vectors along the axes of a chosen frame."""

    __modelica__ = None

    resolveInFrame = ac.Option("frame_a", choices=ABSOLUTE, doc="frame whose axes are used")
    frame_resolve = Frame(when="_resolves")

    @property
    def _resolves(self) -> bool:
        """Whether there is a frame for the axes alone."""
        return "frame_resolve" in self._named()

    def _named(self) -> tuple[str, ...]:
        """The frames whose axes are used."""
        return (self.resolveInFrame,)

    def _angle(self, frame: str) -> Any:
        """The angle of a frame against the world."""
        return 0 if frame == "world" else getattr(self, frame).phi

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        if self._resolves:
            yield from free(self.frame_resolve)


class PartialAbsolute(PartialResolving):
    """Measures at ``frame_a``."""

    __modelica__ = None
    ICON = icons.SENSOR

    frame_a = Frame()

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from free(self.frame_a)

    def _place(self) -> tuple[Any, Any, Any]:
        return self.frame_a.x, self.frame_a.y, self.frame_a.phi


class PartialRelative(PartialResolving, PartialTwoFrames):
    """Measures ``frame_b`` against ``frame_a``."""

    __modelica__ = None
    ICON = icons.SENSOR2

    resolveInFrame = ac.Option("frame_a", choices=RELATIVE, doc="frame whose axes are used")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from free(self.frame_a)
        yield from free(self.frame_b)

    def _difference(self, frame: str) -> tuple[Any, Any, Any]:
        """From frame_a to frame_b, along the axes of a frame."""
        a, b = self.frame_a, self.frame_b
        return (*turned(-self._angle(frame), b.x - a.x, b.y - a.y), b.phi - a.phi)


class AbsolutePosition(PartialAbsolute):
    """Position and angle ``r`` [m, m, rad] of ``frame_a``; the angle counts from the frame whose axes are used."""

    ICON = icons.meter("r")

    r = ac.Output(shape=3, doc="position and angle")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        x, y, phi = self._place()
        angle = self._angle(self.resolveInFrame)
        yield from equal(self.r, (*turned(-angle, x, y), phi - angle))


class AbsoluteVelocity(PartialAbsolute):
    """Speed ``v`` [m/s, m/s, rad/s] of ``frame_a`` in the world, along the axes of the chosen frame."""

    ICON = icons.meter("v")

    v = ac.Output(shape=3, doc="speed and angular speed")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        x, y, w = (ac.der(value) for value in self._place())
        angle = self._angle(self.resolveInFrame)
        yield from equal(self.v, (*turned(-angle, x, y), w))


class AbsoluteAcceleration(PartialAbsolute):
    """Acceleration ``a`` [m/s2, m/s2, rad/s2] of ``frame_a`` in the world, along the axes of the chosen frame."""

    ICON = icons.meter("a")

    v_0 = ac.Variable(shape=3, doc="speed and angular speed, resolved in the world")
    a = ac.Output(shape=3, doc="acceleration and angular acceleration")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from equal(self.v_0, map(ac.der, self._place()))
        x, y, z = (ac.der(speed) for speed in self.v_0)
        angle = self._angle(self.resolveInFrame)
        yield from equal(self.a, (*turned(-angle, x, y), z))


class RelativePosition(PartialRelative):
    """Position and angle ``r_rel`` [m, m, rad] of ``frame_b`` against ``frame_a``."""

    ICON = icons.meter2("r")

    r_rel = ac.Output(shape=3, doc="position and angle")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from equal(self.r_rel, self._difference(self.resolveInFrame))


class RelativeVelocity(PartialRelative):
    """Speed ``v_rel`` [m/s, m/s, rad/s] of ``frame_b`` as seen from ``frame_a``, along the axes of the chosen frame."""

    ICON = icons.meter2("v")

    r_a = ac.Variable(shape=3, doc="position and angle, resolved in frame_a")
    v_rel = ac.Output(shape=3, doc="speed and angular speed")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from equal(self.r_a, self._difference("frame_a"))
        x, y, w = (ac.der(place) for place in self.r_a)
        angle = self._angle(self.resolveInFrame) - self.frame_a.phi
        yield from equal(self.v_rel, (*turned(-angle, x, y), w))


class RelativeAcceleration(RelativeVelocity):
    """The derivative ``a_rel`` [m/s2, m/s2, rad/s2] of the speed that `RelativeVelocity` measures."""

    ICON = icons.meter2("a")

    v_rel = ac.Variable(shape=3, doc="speed and angular speed")
    a_rel = ac.Output(shape=3, doc="acceleration and angular acceleration")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from equal(self.a_rel, map(ac.der, self.v_rel))


class PartialTransform(PartialResolving):
    """Resolves a vector ``r_in`` along other axes: from those of ``frame_r_in`` to those of ``frame_r_out``."""

    __modelica__ = None
    ICON = icons.SENSOR

    frame_r_in = ac.Option("frame_a", choices=RELATIVE, doc="frame whose axes r_in has")
    frame_r_out = ac.Option("frame_a", choices=RELATIVE, doc="frame whose axes r_out has")
    r_in = ac.Input(shape=3, doc="vector")
    r_out = ac.Output(shape=3, doc="the same vector along other axes")

    def _named(self) -> tuple[str, ...]:
        return self.frame_r_in, self.frame_r_out

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        angle = self._angle(self.frame_r_in) - self._angle(self.frame_r_out)
        x, y, third = self.r_in
        shift = self._shift() if self.frame_r_in != self.frame_r_out else 0
        yield from equal(self.r_out, (*turned(angle, x, y), third + shift))

    def _shift(self) -> Any:
        """What is added to the third element."""
        return 0


class TransformAbsoluteVector(PartialTransform):
    """Resolves a vector along other axes.

    As in Modelica's library the angle of ``frame_r_in`` is added to the third element where the frames differ.
    """

    ICON = icons.block("R v")

    frame_r_in = ac.Option("frame_a", choices=ABSOLUTE, doc="frame whose axes r_in has")
    frame_r_out = ac.Option("frame_a", choices=ABSOLUTE, doc="frame whose axes r_out has")
    frame_a = Frame()

    def _shift(self) -> Any:
        return self._angle(self.frame_r_in)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from free(self.frame_a)


class TransformRelativeVector(PartialTransform, PartialTwoFrames):
    """Resolves a vector along other axes; the third element stays."""

    ICON = icons.block("Rᵣ v")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from free(self.frame_a)
        yield from free(self.frame_b)


class Distance(PartialTwoFrames):
    """The ``distance`` [m] of two frames."""

    ICON = icons.meter2("d")
    UNUSED = ARROW

    s_small = ac.Parameter(1e-10, unit="m", min=0, doc="distance below which it is smoothed")
    distance = ac.Output(unit="m", doc="distance of the frames")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from free(self.frame_a)
        yield from free(self.frame_b)
        a, b, small = self.frame_a, self.frame_b, self.s_small**2
        square = (b.x - a.x) ** 2 + (b.y - a.y) ** 2
        smooth = square / (2 * self.s_small) * (3 - square / small)
        far = ac.sqrt(ac.maximum(square, small))
        yield ac.Eq(self.distance, ac.where(square > small, far, smooth))


class PartialRigidSensor(PartialTwoFrames):
    """Base of sensors in a rigid cut: both frames are at one place, forces and torques are in balance."""

    __modelica__ = None
    ICON = icons.SENSOR2
    UNUSED = ARROW

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from coincident(self.frame_a, self.frame_b)
        yield ac.Eq(self.frame_a.phi, self.frame_b.phi)
        yield ac.Eq(self.frame_a.t + self.frame_b.t, 0)


class Power(PartialRigidSensor):
    """Power [W] that enters at ``frame_a`` and leaves at ``frame_b``."""

    ICON = icons.meter2("P")

    power = ac.Output(unit="W", doc="power into frame_a")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        a = self.frame_a
        moved = a.fx * ac.der(a.x) + a.fy * ac.der(a.y)
        yield ac.Eq(self.power, moved + a.t * ac.der(a.phi))


class PartialCutSensor(PartialRigidSensor):
    """Base of sensors of what goes through a cut; ``positiveSign`` means as it acts at ``frame_a``."""

    __modelica__ = None

    positiveSign = ac.Option(True, doc="whether forces and torques are those at frame_a")

    @property
    def _sign(self) -> int:
        return 1 if self.positiveSign else -1


class CutForce(PartialResolving, PartialCutSensor):
    """The cut ``force`` [N], along the axes of the chosen frame."""

    ICON = icons.meter2("f")

    force = ac.Output(unit="N", shape=2, doc="cut force")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        a, angle = self.frame_a, self._angle(self.resolveInFrame)
        for out, value in zip(self.force, turned(-angle, a.fx, a.fy), strict=True):
            yield ac.Eq(out, self._sign * value)


class CutTorque(PartialCutSensor):
    """The cut ``torque`` [N.m]."""

    ICON = icons.meter2("τ")

    torque = ac.Output(unit="N.m", doc="cut torque")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.torque, self._sign * self.frame_a.t)


class CutForceAndTorque(CutForce, CutTorque):
    """The cut ``force`` [N], along the axes of the chosen frame, and the cut ``torque`` [N.m]."""

    ICON = icons.meter2("fτ")
