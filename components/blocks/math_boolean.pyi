"""Logical operations on several signals, edges, and a delay (`Modelica.Blocks.MathBoolean`).

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, SupportsFloat, SupportsIndex

import acausal as ac
from acausal.components import blocks as _blocks

__all__ = [
    "And",
    "ChangingEdge",
    "FallingEdge",
    "MultiSwitch",
    "Nand",
    "Nor",
    "Not",
    "OnDelay",
    "Or",
    "RisingEdge",
    "Xor",
    "negated",
]

class MultiSwitch(_blocks.Switching):
    """The truth value in ``expr`` that belongs to the first input that is true."""

    use_pre_as_default: ClassVar[ac.Option]
    """whether the output is kept where no input is true"""
    y_default: ClassVar[ac.Option]
    """output where no input is true, and before the start"""
    y: ClassVar[ac.Discrete]
    """output signal, 1 or 0"""
    def __init__(
        self,
        *,
        expr: ac.Start | Mapping[str, Any] = ...,
        nu: SupportsIndex = ...,
        use_pre_as_default: bool = ...,
        y_default: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class OnDelay(_blocks.SISO):
    """The input, a rise ``delayTime`` [s] late, a fall at once."""

    delayTime: ClassVar[ac.Parameter]
    """delay of a rise [s]"""
    delaySignal: ClassVar[ac.Discrete]
    """whether a rise is waited for, or has come"""
    t_next: ClassVar[ac.Discrete]
    """when the output rises [s]"""
    def __init__(
        self,
        *,
        delayTime: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        delaySignal: ac.Start | Mapping[str, Any] = ...,
        t_next: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class And(_blocks.PartialBooleanMISO):
    """True where all inputs are true."""
    def __init__(
        self,
        *,
        nu: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Not(_blocks.Not):
    """True where the input is false."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class Or(_blocks.PartialBooleanMISO):
    """True where any input is true."""
    def __init__(
        self,
        *,
        nu: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Xor(_blocks.PartialBooleanMISO):
    """True where exactly one input is true."""
    def __init__(
        self,
        *,
        nu: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ChangingEdge(_blocks.Change):
    """True at the moment the input changes."""
    def __init__(
        self,
        *,
        pre_u_start: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        held: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FallingEdge(_blocks.FallingEdge):
    """True at the moment the input turns false."""
    def __init__(
        self,
        *,
        pre_u_start: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        held: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Nand(And):
    """True where any input is false."""
    def __init__(
        self,
        *,
        nu: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Nor(Or):
    """True where all inputs are false."""
    def __init__(
        self,
        *,
        nu: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RisingEdge(_blocks.Edge):
    """True at the moment the input turns true."""
    def __init__(
        self,
        *,
        pre_u_start: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        held: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

def negated(condition: Any) -> Any: ...
