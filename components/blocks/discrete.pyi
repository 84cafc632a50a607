"""Sampled blocks (`Modelica.Blocks.Discrete`): they take their inputs at sample times, or at the times of a trigger.

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Iterable, Mapping
from typing import Any, ClassVar, SupportsFloat

import acausal as ac
from acausal.components import blocks as _blocks

__all__ = [
    "FirstOrderHold",
    "Sampler",
    "StateSpace",
    "TransferFunction",
    "TriggeredMax",
    "TriggeredSampler",
    "UnitDelay",
    "ZeroOrderHold",
]

class FirstOrderHold(_blocks.DiscreteSISO):
    """Straight on from the last two samples: ``y = pre_uSample + pre(c) (time - tSample)``."""

    tSample: ClassVar[ac.Discrete]
    """last sample time [s]"""
    uSample: ClassVar[ac.Discrete]
    """input at the last sample time"""
    pre_uSample: ClassVar[ac.Discrete]
    """input at the sample time before"""
    c: ClassVar[ac.Discrete]
    """slope between the two samples"""
    def __init__(
        self,
        *,
        samplePeriod: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        firstTrigger: ac.Start | Mapping[str, Any] = ...,
        tSample: ac.Start | Mapping[str, Any] = ...,
        uSample: ac.Start | Mapping[str, Any] = ...,
        pre_uSample: ac.Start | Mapping[str, Any] = ...,
        c: ac.Start | Mapping[str, Any] = ...,
        sampleTrigger: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Sampler(_blocks.DiscreteSISO):
    """The input at sample times: ``y = u`` then, and at the start."""

    y: ClassVar[ac.Discrete]
    """sampled signal"""
    def __init__(
        self,
        *,
        samplePeriod: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        firstTrigger: ac.Start | Mapping[str, Any] = ...,
        sampleTrigger: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class StateSpace(_blocks.DiscreteMIMO):
    """At sample times ``x = A pre(x) + B u``, ``y = C pre(x) + D u`` with matrices; ``D`` is zero by default."""

    y: ClassVar[ac.Discrete]
    """output signals"""
    A: ClassVar[ac.Parameter]
    """state matrix"""
    B: ClassVar[ac.Parameter]
    """input matrix"""
    C: ClassVar[ac.Parameter]
    """output matrix"""
    D: ClassVar[ac.Parameter]
    """feedthrough matrix"""
    x: ClassVar[ac.Discrete]
    """states"""
    def __init__(
        self,
        *,
        samplePeriod: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        A: SupportsFloat | Iterable[Any] = ...,
        B: SupportsFloat | Iterable[Any] = ...,
        C: SupportsFloat | Iterable[Any] = ...,
        D: SupportsFloat | Iterable[Any] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        firstTrigger: ac.Start | Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        sampleTrigger: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TransferFunction(_blocks.DiscreteSISO):
    """``(b[1] z**m + ... + b[m+1])/(a[1] z**n + ... + a[n+1])`` with ``m <= n``, in controller canonical form."""

    y: ClassVar[ac.Discrete]
    """output signal"""
    b: ClassVar[ac.Parameter]
    """numerator, highest power first"""
    a: ClassVar[ac.Parameter]
    """denominator, highest power first"""
    x: ClassVar[ac.Discrete]
    """states in controller canonical form"""
    x1: ClassVar[ac.Discrete]
    """the newest of them"""
    xext: ClassVar[ac.Discrete]
    """the newest and the previous states"""
    def __init__(
        self,
        *,
        samplePeriod: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        b: SupportsFloat | Iterable[Any] = ...,
        a: SupportsFloat | Iterable[Any] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        firstTrigger: ac.Start | Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        x1: ac.Start | Mapping[str, Any] = ...,
        xext: ac.Start | Mapping[str, Any] = ...,
        sampleTrigger: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TriggeredMax(_blocks.SISO):
    """The greatest absolute value of the input at the times of a trigger so far."""

    y: ClassVar[ac.Discrete]
    """greatest absolute value"""
    trigger: ClassVar[ac.Input]
    """when the input is taken"""
    def __init__(
        self,
        *,
        u: ac.Start | Mapping[str, Any] = ...,
        trigger: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TriggeredSampler(_blocks.SISO):
    """The input at the times of a trigger: ``y = u`` then, and ``y_start`` before."""

    y: ClassVar[ac.Discrete]
    """sampled signal"""
    trigger: ClassVar[ac.Input]
    """when the input is taken"""
    y_start: ClassVar[ac.Parameter]
    """initial value of the output"""
    def __init__(
        self,
        *,
        y_start: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        trigger: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class UnitDelay(_blocks.DiscreteSISO):
    """The previous sample: at sample times the input just before, from ``y_start`` on."""

    y: ClassVar[ac.Discrete]
    """output signal"""
    y_start: ClassVar[ac.Parameter]
    """initial value of the output"""
    def __init__(
        self,
        *,
        samplePeriod: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        y_start: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        firstTrigger: ac.Start | Mapping[str, Any] = ...,
        sampleTrigger: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ZeroOrderHold(_blocks.DiscreteSISO):
    """The input at sample times, held in between: ``y = pre(ySample)``."""

    ySample: ClassVar[ac.Discrete]
    """input at the last sample time"""
    def __init__(
        self,
        *,
        samplePeriod: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        firstTrigger: ac.Start | Mapping[str, Any] = ...,
        ySample: ac.Start | Mapping[str, Any] = ...,
        sampleTrigger: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...
