"""What planar components look like in an animation: lengths to scale, pins and coils as marks."""

from typing import Any

import acausal as ac

__modelica__ = None

DISC = "M-1 0A1 1 0 1 0 1 0A1 1 0 1 0 -1 0ZM0 0H1"
"""A disc of radius 1 with a line that shows how it turns."""
BOX = "M-1 -1H1V1H-1Z"
PIN = "M-.45 0A.45 .45 0 1 0 .45 0A.45 .45 0 1 0 -.45 0Z"
GROUND = "M0 0L-1 -1.5H1ZM-1.7 -1.5H1.7M-1.2 -1.5L-1.7 -2.1M-.4 -1.5L-.9 -2.1M.4 -1.5L-.1 -2.1M1.2 -1.5L.7 -2.1"
ROD = "M0 0H1"
SLIDE = "M0 -.4H1M0 .4H1"
SPRING = "M0 0H.2L.25 1L.35 -1L.45 1L.55 -1L.65 1L.75 -1L.8 0H1"
DAMPER = "M0 0H.55M.55 -.7V.7M.35 -1H.75V1H.35M.75 0H1"
SPRING_DAMPER = (
    "M0 0H.1V1.3H.2L.25 2L.35 .6L.45 2L.55 .6L.65 2L.75 .6L.8 1.3H.9V0H1"
    "M.1 0V-1.3H.5M.5 -2V-.6M.35 -2.2H.7V-.4H.35M.7 -1.3H.9V0"
)


def at(frame: Any, path: str, **looks: Any) -> ac.Shape:
    """An outline that moves with a frame."""
    return ac.Shape(path, **{"x": frame.x, "y": frame.y, "phi": frame.phi, **looks})


def between(a: Any, b: Any, path: str) -> ac.Shape:
    """An outline from one frame to another, as long as they are apart."""
    x, y = b.x - a.x, b.y - a.y
    length = ac.sqrt(x**2 + y**2)
    return ac.Shape(path, a.x, a.y, ac.atan2(y, x), (length, None), (0.0, -1.0, 1.0, 1.0))


def disc(frame: Any, radius: Any, **looks: Any) -> ac.Shape:
    """A disc that turns with a frame."""
    return at(frame, DISC, size=(radius, radius), filled=True, **looks)


def pin(frame: Any) -> ac.Shape:
    """The axis of a joint."""
    return at(frame, PIN, filled=True)
