"""The few parts of spatial mechanics that a planar world meets (`Modelica.Mechanics.MultiBody`).

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Iterable, Mapping
from typing import Any, ClassVar, Literal, SupportsFloat

import acausal as ac

__all__ = [
    "Body",
    "Fixed",
    "FixedRotation",
    "Frame",
    "Frame_a",
    "Frame_b",
    "PartialTwoFrames",
    "Prismatic",
    "World",
]

class Body(ac.Component):
    """A mass ``m`` whose frame does not turn: ``m (a - gravity)`` acts at ``r_CM`` [m]."""

    m: ClassVar[ac.Parameter]
    """mass [kg]"""
    r_CM: ClassVar[ac.Parameter]
    """centre of mass, resolved in frame_a [m]"""
    gravity: ClassVar[ac.Parameter]
    """acceleration of gravity of the world [m/s2]"""
    frame_a: Frame
    r_0: ClassVar[ac.Variable]
    """position in the world [m]"""
    v_0: ClassVar[ac.Variable]
    """speed in the world [m/s]"""
    a_0: ClassVar[ac.Variable]
    """acceleration in the world [m/s2]"""
    def __init__(
        self,
        *,
        m: SupportsFloat | ac.Start = ...,
        r_CM: SupportsFloat | Iterable[Any] = ...,
        gravity: SupportsFloat | Iterable[Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        r_0: ac.Start | Mapping[str, Any] = ...,
        v_0: ac.Start | Mapping[str, Any] = ...,
        a_0: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Fixed(ac.Component):
    """A frame at the place ``r`` [m], with the axes of the world."""

    r: ClassVar[ac.Parameter]
    """position in the world [m]"""
    frame_b: Frame
    def __init__(
        self, *, r: SupportsFloat | Iterable[Any] = ..., frame_b: Mapping[str, Any] = ...
    ) -> None: ...

class Frame(ac.Connector):
    """Position ``r_0`` [m], orientation ``R``, force ``f`` [N] and torque ``t`` [N.m], resolved in the frame."""

    r_0: ClassVar[ac.Potential]
    """position in the world [m]"""
    R: ClassVar[ac.Potential]
    """turns a vector of the world into the frame"""
    f: ClassVar[ac.Flow]
    """cut force, resolved in the frame [N]"""
    t: ClassVar[ac.Flow]
    """cut torque, resolved in the frame [N.m]"""

class PartialTwoFrames(ac.Component):
    """Two frames without equations."""

    frame_a: Frame
    frame_b: Frame
    def __init__(self, **modifiers: Any) -> None: ...

class World(ac.Component):
    """The spatial world: its frame, and gravity ``g`` along ``n``."""

    g: ClassVar[ac.Parameter]
    """acceleration of gravity [m/s2]"""
    n: ClassVar[ac.Parameter]
    """direction of gravity"""
    gravity: ClassVar[ac.Parameter]
    """acceleration of gravity, computed [m/s2]"""
    frame_b: Frame
    def __init__(
        self,
        *,
        gravity: SupportsFloat | Iterable[Any] = ...,
        g: SupportsFloat | ac.Start = ...,
        n: SupportsFloat | Iterable[Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class FixedRotation(PartialTwoFrames):
    """``frame_b`` is turned against ``frame_a``, and ``r`` [m] away."""

    r: ClassVar[ac.Parameter]
    """from frame_a to frame_b, resolved in frame_a [m]"""
    rotationType: ClassVar[ac.Option]
    n: ClassVar[ac.Parameter]
    """axis of the rotation"""
    angle: ClassVar[ac.Parameter]
    """angle about n, in degrees"""
    n_x: ClassVar[ac.Parameter]
    """x-axis of frame_b"""
    n_y: ClassVar[ac.Parameter]
    """about the y-axis of frame_b"""
    sequence: ClassVar[ac.Option]
    """axes of the rotations, one after the other"""
    angles: ClassVar[ac.Parameter]
    """angles about these axes, in degrees"""
    def __init__(
        self,
        *,
        r: SupportsFloat | Iterable[Any] = ...,
        n: SupportsFloat | Iterable[Any] = ...,
        angle: SupportsFloat | ac.Start = ...,
        n_x: SupportsFloat | Iterable[Any] = ...,
        n_y: SupportsFloat | Iterable[Any] = ...,
        angles: SupportsFloat | Iterable[Any] = ...,
        rotationType: Literal["RotationAxis", "TwoAxesVectors", "PlanarRotationSequence"] = ...,
        sequence: Any = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
    ) -> None: ...

class Prismatic(PartialTwoFrames):
    """A joint along ``n``, without friction: ``frame_b`` is ``s`` [m] away."""

    n: ClassVar[ac.Parameter]
    """direction, resolved in frame_a"""
    s: ClassVar[ac.Variable]
    """distance [m]"""
    v: ClassVar[ac.Variable]
    """speed [m/s]"""
    a: ClassVar[ac.Variable]
    """acceleration [m/s2]"""
    def __init__(
        self,
        *,
        n: SupportsFloat | Iterable[Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

Frame_a = Frame
Frame_b = Frame
