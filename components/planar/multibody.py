"""The few parts of spatial mechanics that a planar world meets (`Modelica.Mechanics.MultiBody`).

They move along lines; nothing turns but by fixed angles. Frames hold a position and the orientation matrix ``R`` that
turns a vector of the world into the frame.
"""

from collections.abc import Iterator
from typing import Any, ClassVar

import acausal as ac
from acausal.components import icons

MULTIBODY = "Modelica.Mechanics.MultiBody"
__modelica__ = (f"{MULTIBODY}.Parts", "MB.Parts")

AXES = range(3)


class Frame(ac.Connector):
    """Position ``r_0`` [m], orientation ``R``, force ``f`` [N] and torque ``t`` [N.m], resolved in the frame."""

    __modelica__ = (f"{MULTIBODY}.Interfaces", "MB.Interfaces")

    r_0 = ac.Potential(unit="m", shape=3, doc="position in the world")
    R = ac.Potential(unit="1", shape=(3, 3), doc="turns a vector of the world into the frame")
    f = ac.Flow(unit="N", shape=3, doc="cut force, resolved in the frame")
    t = ac.Flow(unit="N.m", shape=3, doc="cut torque, resolved in the frame")

    pair = ("frame_a", "frame_b")
    second_minus_first = True
    power = False
    COLOR = "#8a8f98"


Frame_a = Frame_b = Frame


def _fixed(frame: Frame, r: Any) -> Iterator[ac.Eq]:
    """A frame at a fixed place, with the axes of the world."""
    for i in AXES:
        yield ac.Eq(frame.r_0[i], r[i])
        for k in AXES:
            yield ac.Eq(frame.R[i][k], 1 if i == k else 0)


def _times(a: Any, v: Any) -> list[Any]:
    """A matrix times a vector."""
    return [sum(a[i][k] * v[k] for k in AXES) for i in AXES]


def _back(a: Any, v: Any) -> list[Any]:
    """The transpose of a matrix times a vector."""
    return [sum(a[k][i] * v[k] for k in AXES) for i in AXES]


def _cross(a: Any, b: Any) -> list[Any]:
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in AXES]


def _unit(v: Any) -> list[Any]:
    length = ac.sqrt(sum(x**2 for x in v))
    return [x / length for x in v]


class World(ac.Component):
    """The spatial world: its frame, and gravity ``g`` along ``n``."""

    ICON = icons.WORLD

    __modelica__ = (MULTIBODY, "MB")

    g = ac.Parameter(9.81, unit="m/s2", doc="acceleration of gravity")
    n = ac.Parameter((0.0, -1.0, 0.0), unit="1", shape=3, doc="direction of gravity")
    gravity = ac.Parameter(unit="m/s2", shape=3, doc="acceleration of gravity, computed")
    frame_b = Frame()

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.modify(gravity=[self.g * n for n in _unit(self.n)])

    def equations(self) -> Iterator[ac.Eq]:
        yield from _fixed(self.frame_b, (0, 0, 0))


class Fixed(ac.Component):
    """A frame at the place ``r`` [m], with the axes of the world."""

    ICON = icons.FIXED

    r = ac.Parameter(0.0, unit="m", shape=3, doc="position in the world")
    frame_b = Frame()

    def equations(self) -> Iterator[ac.Eq]:
        yield from _fixed(self.frame_b, self.r)


class PartialTwoFrames(ac.Component):
    """Two frames without equations."""

    __modelica__ = (f"{MULTIBODY}.Interfaces", "MB.Interfaces")

    frame_a = Frame()
    frame_b = Frame()


class FixedRotation(PartialTwoFrames):
    """``frame_b`` is turned against ``frame_a``, and ``r`` [m] away.

    ``rotationType``: ``RotationAxis``, by ``angle`` about ``n``; ``TwoAxesVectors``, whose x-axis is ``n_x``, with
    ``n_y`` in the plane of x and y; ``PlanarRotationSequence``, by ``angles`` about the axes ``sequence``. Angles are
    in degrees, as in Modelica.
    """

    ICON = icons.ROD

    r = ac.Parameter(0.0, unit="m", shape=3, doc="from frame_a to frame_b, resolved in frame_a")
    rotationType = ac.Option(
        "RotationAxis", choices=("RotationAxis", "TwoAxesVectors", "PlanarRotationSequence")
    )
    n = ac.Parameter((1.0, 0.0, 0.0), unit="1", shape=3, doc="axis of the rotation")
    angle = ac.Parameter(0.0, doc="angle about n, in degrees")
    n_x = ac.Parameter((1.0, 0.0, 0.0), unit="1", shape=3, doc="x-axis of frame_b")
    n_y = ac.Parameter((0.0, 1.0, 0.0), unit="1", shape=3, doc="about the y-axis of frame_b")
    sequence = ac.Option((1, 2, 3), doc="axes of the rotations, one after the other")
    angles = ac.Parameter(0.0, shape=3, doc="angles about these axes, in degrees")

    def _rotation(self) -> Any:
        """The matrix that turns a vector of frame_a into frame_b."""
        if self.rotationType == "TwoAxesVectors":
            x = _unit(self.n_x)
            z = _unit(_cross(x, self.n_y))
            return [x, _cross(z, x), z]
        if self.rotationType == "RotationAxis":
            return _about(_unit(self.n), self.angle)
        matrix: Any = _about((1, 0, 0), 0)
        for axis, angle in zip(self.sequence, self.angles, strict=True):
            turn = _about([int(int(axis) == i + 1) for i in AXES], angle)
            matrix = [[sum(turn[i][m] * matrix[m][k] for m in AXES) for k in AXES] for i in AXES]
        return matrix

    def equations(self) -> Iterator[ac.Eq]:
        a, b, turn = self.frame_a, self.frame_b, self._rotation()
        away, back = _back(a.R, self.r), _back(turn, b.f)
        lever, moment = _cross(self.r, back), _back(turn, b.t)
        for i in AXES:
            yield ac.Eq(b.r_0[i], a.r_0[i] + away[i])
            yield ac.Eq(a.f[i] + back[i], 0)
            yield ac.Eq(a.t[i] + moment[i] + lever[i], 0)
            for k in AXES:
                yield ac.Eq(b.R[i][k], sum(turn[i][m] * a.R[m][k] for m in AXES))


def _about(n: Any, degrees: Any) -> list[list[Any]]:
    """The matrix that turns a vector into a frame that is turned by an angle about a unit vector."""
    c, s = ac.cos(degrees * ac.pi / 180), ac.sin(degrees * ac.pi / 180)
    skew = ((0, -n[2], n[1]), (n[2], 0, -n[0]), (-n[1], n[0], 0))
    return [
        [n[i] * n[k] * (1 - c) + (c if i == k else 0) - skew[i][k] * s for k in AXES] for i in AXES
    ]


class Body(ac.Component):
    """A mass ``m`` whose frame does not turn: ``m (a - gravity)`` acts at ``r_CM`` [m]."""

    ICON = icons.MASS

    OUTER: ClassVar = {"gravity": "world.gravity"}
    UNUSED = (
        *("animation", "sphereDiameter", "cylinderDiameter"),
        *("I_11", "I_22", "I_33", "I_21", "I_31", "I_32"),
    )

    m = ac.Parameter(unit="kg", min=0, doc="mass")
    r_CM = ac.Parameter(0.0, unit="m", shape=3, doc="centre of mass, resolved in frame_a")
    gravity = ac.Parameter(
        (0.0, -9.81, 0.0), unit="m/s2", shape=3, doc="acceleration of gravity of the world"
    )
    frame_a = Frame()
    r_0 = ac.Variable(unit="m", shape=3, doc="position in the world")
    v_0 = ac.Variable(unit="m/s", shape=3, doc="speed in the world")
    a_0 = ac.Variable(unit="m/s2", shape=3, doc="acceleration in the world")

    def equations(self) -> Iterator[ac.Eq]:
        force = [self.m * (self.a_0[i] - self.gravity[i]) for i in AXES]
        resolved = _times(self.frame_a.R, force)
        moment = _cross(self.r_CM, self.frame_a.f)
        for i in AXES:
            yield ac.Eq(self.r_0[i], self.frame_a.r_0[i])
            yield ac.Eq(self.v_0[i], ac.der(self.r_0[i]))
            yield ac.Eq(self.a_0[i], ac.der(self.v_0[i]))
            yield ac.Eq(self.frame_a.f[i], resolved[i])
            yield ac.Eq(self.frame_a.t[i], moment[i])


class Prismatic(PartialTwoFrames):
    """A joint along ``n``, without friction: ``frame_b`` is ``s`` [m] away."""

    ICON = icons.PRISMATIC

    __modelica__ = (f"{MULTIBODY}.Joints", "MB.Joints")
    UNUSED = ("animation", "useAxisFlange", "boxWidth", "boxHeight", "boxColor", "stateSelect")

    n = ac.Parameter((1.0, 0.0, 0.0), unit="1", shape=3, doc="direction, resolved in frame_a")
    s = ac.Variable(unit="m", state="prefer", doc="distance")
    v = ac.Variable(unit="m/s", state="prefer", doc="speed")
    a = ac.Variable(unit="m/s2", doc="acceleration")

    def equations(self) -> Iterator[ac.Eq]:
        a, b, n = self.frame_a, self.frame_b, _unit(self.n)
        away = _back(a.R, [self.s * x for x in n])
        lever = _cross([self.s * x for x in n], b.f)
        yield ac.Eq(self.v, ac.der(self.s))
        yield ac.Eq(self.a, ac.der(self.v))
        yield ac.Eq(sum(n[i] * b.f[i] for i in AXES), 0)
        for i in AXES:
            yield ac.Eq(b.r_0[i], a.r_0[i] + away[i])
            yield ac.Eq(a.f[i] + b.f[i], 0)
            yield ac.Eq(a.t[i] + b.t[i] + lever[i], 0)
            for k in AXES:
                yield ac.Eq(b.R[i][k], a.R[i][k])
