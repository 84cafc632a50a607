"""What the modules of planar mechanics share: turned vectors, balances of frames, names that only draw."""

from collections.abc import Iterable, Iterator
from typing import Any

import acausal as ac

GRAVITY = (0.0, -9.81)
"""Acceleration of gravity [m/s2] where a model gives no other."""


DRAWN = ("animate", "zPosition", "specularCoefficient")
"""What parts of Modelica's library have for drawing alone."""


ARROW = (
    "animation", "arrowDiameter", "arrowColor", "specularCoefficient", "s_small", "N_to_m", "Nm_to_m",
    "forceDiameter", "torqueDiameter", "forceColor", "torqueColor", "diameter", "color", "zPosition",
)  # fmt: skip
"""The same of sensors and sources, which are drawn as arrows."""


ABSOLUTE = ("world", "frame_a", "frame_resolve")
RELATIVE = ("world", "frame_a", "frame_b", "frame_resolve")
"""Frames along whose axes vectors of one frame, and of two, may be resolved."""


def equal(vector: Any, values: Iterable[Any]) -> Iterator[ac.Eq]:
    """The elements of a vector, one by one."""
    for element, value in zip(vector, values, strict=True):
        yield ac.Eq(element, value)


def turned(phi: Any, x: Any, y: Any) -> tuple[Any, Any]:
    """A vector turned by ``phi``: from a frame of that angle into the world; by ``-phi``, back."""
    return ac.cos(phi) * x - ac.sin(phi) * y, ac.sin(phi) * x + ac.cos(phi) * y


def direction(r: Any) -> tuple[Any, Any]:
    """The unit vector along ``r``."""
    length = ac.sqrt(r[0] ** 2 + r[1] ** 2)
    return r[0] / length, r[1] / length


def free(frame: Any) -> Iterator[ac.Eq]:
    """A frame that is looked at only: no force and no torque."""
    yield ac.Eq(frame.fx, 0)
    yield ac.Eq(frame.fy, 0)
    yield ac.Eq(frame.t, 0)


def coincident(a: Any, b: Any) -> Iterator[ac.Eq]:
    """Two frames at the same place, whose forces are in balance."""
    yield ac.Eq(a.x, b.x)
    yield ac.Eq(a.y, b.y)
    yield ac.Eq(a.fx + b.fx, 0)
    yield ac.Eq(a.fy + b.fy, 0)


def acting(frame: Any, angle: Any, force: Any) -> Iterator[ac.Eq]:
    """A force along the axes of a frame of an angle, and a torque, on what is connected to a frame."""
    x, y = turned(angle, force[0], force[1])
    yield ac.Eq(frame.fx + x, 0)
    yield ac.Eq(frame.fy + y, 0)
    yield ac.Eq(frame.t + force[2], 0)
