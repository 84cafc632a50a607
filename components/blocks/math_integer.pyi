"""Sums, products, switches and counters of integers (`Modelica.Blocks.MathInteger`).

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Iterable, Mapping
from typing import Any, ClassVar, SupportsFloat, SupportsIndex

import acausal as ac
from acausal.components import blocks as _blocks

__all__ = ["MultiSwitch", "Product", "Sum", "TriggeredAdd"]

class MultiSwitch(_blocks.Switching):
    """The integer in ``expr`` that belongs to the first input that is true."""

    use_pre_as_default: ClassVar[ac.Option]
    """whether the output is kept where no input is true"""
    y_default: ClassVar[ac.Parameter]
    """output where no input is true, and before the start"""
    y: ClassVar[ac.Discrete]
    """output signal"""
    def __init__(
        self,
        *,
        expr: ac.Start | Mapping[str, Any] = ...,
        y_default: SupportsFloat | ac.Start = ...,
        nu: SupportsIndex = ...,
        use_pre_as_default: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class TriggeredAdd(_blocks.SISO):
    """Adds ``u`` to the output where ``trigger`` turns true."""

    y: ClassVar[ac.Discrete]
    """output signal"""
    use_reset: ClassVar[ac.Option]
    """whether there is the input reset"""
    use_set: ClassVar[ac.Option]
    """whether there is the input set"""
    y_start: ClassVar[ac.Parameter]
    """initial value of the output"""
    trigger: ClassVar[ac.Input]
    """when the input is added"""
    reset: ClassVar[ac.Input]
    """when the output is reset"""
    set: ClassVar[ac.Input]
    """what it is reset to"""
    triggered: ClassVar[ac.Discrete]
    """whether the trigger is true"""
    resetting: ClassVar[ac.Discrete]
    """whether the reset is true"""
    def __init__(
        self,
        *,
        y_start: SupportsFloat | ac.Start = ...,
        use_reset: bool = ...,
        use_set: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        trigger: ac.Start | Mapping[str, Any] = ...,
        reset: ac.Start | Mapping[str, Any] = ...,
        set: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        triggered: ac.Start | Mapping[str, Any] = ...,
        resetting: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Product(_blocks.MultiProduct):
    """``y = u[1] ... u[nu]``; 0 without inputs."""
    def __init__(
        self,
        *,
        nu: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Sum(_blocks.MultiSum):
    """``y = k[1] u[1] + ... + k[nu] u[nu]``."""
    def __init__(
        self,
        *,
        k: SupportsFloat | Iterable[Any] = ...,
        nu: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...
