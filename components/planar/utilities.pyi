"""Signal blocks of the planar library (`PlanarMechanics.Utilities.Blocks`).

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, SupportsFloat, SupportsIndex

import acausal as ac
from acausal.components import blocks as _blocks

__all__ = ["LimiterS", "SquaretimesSign"]

class SquaretimesSign(ac.Component):
    """``blockSize`` inputs squared with their signs kept: ``y = u |u|``."""

    blockSize: ClassVar[ac.Option]
    """number of inputs and of outputs"""
    u: ClassVar[ac.Input]
    """input signals"""
    y: ClassVar[ac.Output]
    """output signals"""
    def __init__(
        self,
        *,
        blockSize: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LimiterS(_blocks.SISO):
    """A limiter with a smooth transition: ``y_min`` up to ``x_min``, ``y_max`` from ``x_max`` on, a cubic between."""

    x_min: ClassVar[ac.Parameter]
    """input up to which the output is y_min"""
    x_max: ClassVar[ac.Parameter]
    """input from which on the output is y_max"""
    y_min: ClassVar[ac.Parameter]
    """least output"""
    y_max: ClassVar[ac.Parameter]
    """greatest output"""
    def __init__(
        self,
        *,
        x_min: SupportsFloat | ac.Start = ...,
        x_max: SupportsFloat | ac.Start = ...,
        y_min: SupportsFloat | ac.Start = ...,
        y_max: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...
