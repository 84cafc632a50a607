"""Forces and torques: given by signals, or that grow with the square of the speed."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .conventions import ABSOLUTE, ARROW, RELATIVE, acting, turned
from .interfaces import Frame, PartialTwoFrames
from .sensors import PartialResolving

__modelica__ = "PlanarMechanics.Sources"


class WorldForce(PartialResolving):
    """A force and a torque ``force`` [N, N, N.m] on what is connected to ``frame_b``.

    The force is along the axes of the chosen frame: of the ``world``, of ``frame_b`` or of ``frame_resolve``.
    """

    ICON = icons.FORCE
    UNUSED = ARROW

    resolveInFrame = ac.Option(
        "frame_b", choices=("world", "frame_b", "frame_resolve"), doc="frame whose axes are used"
    )
    frame_b = Frame()
    force = ac.Input(shape=3, doc="force along x and y, and torque")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from acting(self.frame_b, self._angle(self.resolveInFrame), self.force)


class RelativeForce(PartialResolving, PartialTwoFrames):
    """A force and a torque ``force`` [N, N, N.m] on what is connected to ``frame_b``, and against ``frame_a``."""

    ICON = icons.FORCE2
    UNUSED = ARROW

    resolveInFrame = ac.Option("frame_a", choices=RELATIVE, doc="frame whose axes are used")
    force = ac.Input(shape=3, doc="force along x and y, and torque")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        yield from acting(b, self._angle(self.resolveInFrame), self.force)
        yield ac.Eq(a.fx + b.fx, 0)
        yield ac.Eq(a.fy + b.fy, 0)
        yield ac.Eq(a.t + b.t, 0)


class QuadraticSpeedDependentForce(PartialResolving):
    """A force along each axis that grows with the square of the speed along it, and a torque likewise.

    ``force = F_nominal (v/v_nominal) |v/v_nominal|``, for the torque ``tau_nominal`` and ``w_nominal``; negative
    nominal values brake. The speed is that of ``frame_b``, along the axes of the chosen frame; ``frame_a`` means those
    of ``frame_b``.
    """

    ICON = icons.marked(icons.FORCE, "v²")
    UNUSED = ARROW

    resolveInFrame = ac.Option("world", choices=ABSOLUTE, doc="frame whose axes are used")
    F_nominal = ac.Parameter(unit="N", doc="force at the nominal speed")
    v_nominal = ac.Parameter(unit="m/s", min=0, doc="nominal speed")
    tau_nominal = ac.Parameter(unit="N.m", doc="torque at the nominal angular speed")
    w_nominal = ac.Parameter(unit="rad/s", min=0, doc="nominal angular speed")
    frame_b = Frame()
    force = ac.Variable(shape=3, doc="force along x and y, and torque")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        frame = self.frame_b
        angle = frame.phi if self.resolveInFrame == "frame_a" else self._angle(self.resolveInFrame)
        v = turned(-angle, ac.der(frame.x), ac.der(frame.y))
        ratios = (v[0] / self.v_nominal, v[1] / self.v_nominal, ac.der(frame.phi) / self.w_nominal)
        nominal = (self.F_nominal, self.F_nominal, self.tau_nominal)
        for force, size, ratio in zip(self.force, nominal, ratios, strict=True):
            yield ac.Eq(force, size * ratio * ac.Abs(ratio))
        yield from acting(frame, angle, self.force)
