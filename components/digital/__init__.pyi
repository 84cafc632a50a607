"""Digital circuits with nine-valued logic (`Modelica.Electrical.Digital`).

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, Literal, SupportsFloat, SupportsIndex

import acausal as ac

__all__ = [
    "Adder",
    "And",
    "AndGate",
    "BooleanToLogic",
    "BufGate",
    "Clock",
    "FullAdder",
    "HalfAdder",
    "InertialDelay",
    "InertialDelaySensitive",
    "InvGate",
    "LogicToBoolean",
    "LogicToReal",
    "LogicToUX01",
    "LogicToX01",
    "LogicToX01Z",
    "Nand",
    "NandGate",
    "Nor",
    "NorGate",
    "Not",
    "Or",
    "OrGate",
    "Pulse",
    "RealToLogic",
    "Set",
    "Step",
    "Table",
    "Xnor",
    "XnorGate",
    "Xor",
    "XorGate",
]

class Adder(ac.Component):
    """Two numbers of ``n`` bits, the least first, and a carry: ``n`` full adders ``FullAdder[i]`` in a chain."""

    n: ClassVar[ac.Option]
    """number of bits"""
    a: ClassVar[ac.Input]
    """first number"""
    b: ClassVar[ac.Input]
    """second number"""
    c_in: ClassVar[ac.Input]
    """carry"""
    s: ClassVar[ac.Output]
    """sum"""
    c_out: ClassVar[ac.Output]
    """carry of the last bit"""
    FullAdder: list[FullAdder]
    def __init__(
        self,
        *,
        n: SupportsIndex = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        b: ac.Start | Mapping[str, Any] = ...,
        c_in: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        c_out: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class BooleanToLogic(ac.Component):
    """``'1'`` where ``x > 0.5``, else ``'0'``, element by element."""

    n: ClassVar[ac.Option]
    """number of signals"""
    x: ClassVar[ac.Input]
    """truth values"""
    y: ClassVar[ac.Output]
    """digital signals"""
    def __init__(
        self,
        *,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Clock(ac.Component):
    """1 during the first ``width`` percent of each period from ``startTime`` [s] on, else 0."""

    startTime: ClassVar[ac.Parameter]
    """time of the first pulse [s]"""
    period: ClassVar[ac.Parameter]
    """duration of a period [s]"""
    width: ClassVar[ac.Parameter]
    """width of a pulse in percent of the period"""
    t_i: ClassVar[ac.Discrete]
    """start of the present period [s]"""
    y: ClassVar[ac.Output]
    """output"""
    def __init__(
        self,
        *,
        startTime: SupportsFloat | ac.Start = ...,
        period: SupportsFloat | ac.Start = ...,
        width: SupportsFloat | ac.Start = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        t_i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FullAdder(ac.Component):
    """Two bits and a carry: ``s`` is their sum without the new carry ``c_out``; half adders of 1 ms."""

    a: ClassVar[ac.Input]
    """first bit"""
    b: ClassVar[ac.Input]
    """second bit"""
    c_in: ClassVar[ac.Input]
    """carry from the bit before"""
    s: ClassVar[ac.Output]
    """sum"""
    c_out: ClassVar[ac.Output]
    """carry to the next bit"""
    Adder1: HalfAdder
    Adder2: HalfAdder
    OR: Or
    def __init__(
        self,
        *,
        a: ac.Start | Mapping[str, Any] = ...,
        b: ac.Start | Mapping[str, Any] = ...,
        c_in: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        c_out: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class HalfAdder(ac.Component):
    """Two bits: ``s`` is their sum without carry, ``c`` the carry; both ``delayTime`` [s] late."""

    delayTime: ClassVar[ac.Parameter]
    """delay of the gates [s]"""
    a: ClassVar[ac.Input]
    """first bit"""
    b: ClassVar[ac.Input]
    """second bit"""
    s: ClassVar[ac.Output]
    """sum"""
    c: ClassVar[ac.Output]
    """carry"""
    AND: AndGate
    XOR: XorGate
    def __init__(
        self,
        *,
        delayTime: SupportsFloat | ac.Start = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        b: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        c: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class LogicToBoolean(ac.Component):
    """1 where ``x`` is ``'1'`` or ``'H'``, else 0, element by element."""

    n: ClassVar[ac.Option]
    """number of signals"""
    x: ClassVar[ac.Input]
    """digital signals"""
    y: ClassVar[ac.Output]
    """truth values, 1 or 0"""
    def __init__(
        self,
        *,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LogicToReal(ac.Component):
    """``value_U``, ``value_X``, ``value_0`` ... for the values of ``x``, element by element."""

    n: ClassVar[ac.Option]
    """number of signals"""
    x: ClassVar[ac.Input]
    """digital signals"""
    y: ClassVar[ac.Output]
    """numbers"""
    value_U: ClassVar[ac.Parameter]
    """for 'U'"""
    value_X: ClassVar[ac.Parameter]
    """for 'X'"""
    value_0: ClassVar[ac.Parameter]
    """for '0'"""
    value_1: ClassVar[ac.Parameter]
    """for '1'"""
    value_Z: ClassVar[ac.Parameter]
    """for 'Z'"""
    value_W: ClassVar[ac.Parameter]
    """for 'W'"""
    value_L: ClassVar[ac.Parameter]
    """for 'L'"""
    value_H: ClassVar[ac.Parameter]
    """for 'H'"""
    value_m: ClassVar[ac.Parameter]
    """for '-'"""
    def __init__(
        self,
        *,
        value_U: SupportsFloat | ac.Start = ...,
        value_X: SupportsFloat | ac.Start = ...,
        value_0: SupportsFloat | ac.Start = ...,
        value_1: SupportsFloat | ac.Start = ...,
        value_Z: SupportsFloat | ac.Start = ...,
        value_W: SupportsFloat | ac.Start = ...,
        value_L: SupportsFloat | ac.Start = ...,
        value_H: SupportsFloat | ac.Start = ...,
        value_m: SupportsFloat | ac.Start = ...,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Pulse(ac.Component):
    """``pulse`` during the first ``width`` percent of each period from ``startTime`` [s] on, else ``quiet``."""

    width: ClassVar[ac.Parameter]
    """width of a pulse in percent of the period"""
    period: ClassVar[ac.Parameter]
    """duration of a period [s]"""
    startTime: ClassVar[ac.Parameter]
    """time of the first pulse [s]"""
    pulse: ClassVar[ac.Option]
    """value during a pulse"""
    quiet: ClassVar[ac.Option]
    """value between pulses"""
    nperiod: ClassVar[ac.Parameter]
    """number of periods; without limit if negative"""
    T0: ClassVar[ac.Discrete]
    """start of the present period [s]"""
    np: ClassVar[ac.Discrete]
    """number of periods begun, if they are limited"""
    sampling: ClassVar[ac.Discrete]
    """1 while there are pulses"""
    y: ClassVar[ac.Output]
    """output"""
    def __init__(
        self,
        *,
        width: SupportsFloat | ac.Start = ...,
        period: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        nperiod: SupportsFloat | ac.Start = ...,
        pulse: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        quiet: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        T0: ac.Start | Mapping[str, Any] = ...,
        np: ac.Start | Mapping[str, Any] = ...,
        sampling: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RealToLogic(ac.Component):
    """``upper_value`` above ``upper_limit``, ``lower_value`` below ``lower_limit``, else ``middle_value``."""

    n: ClassVar[ac.Option]
    """number of signals"""
    x: ClassVar[ac.Input]
    """numbers"""
    y: ClassVar[ac.Output]
    """digital signals"""
    upper_limit: ClassVar[ac.Parameter]
    """above it: upper_value"""
    lower_limit: ClassVar[ac.Parameter]
    """below it: lower_value"""
    upper_value: ClassVar[ac.Option]
    """above upper_limit"""
    lower_value: ClassVar[ac.Option]
    """below lower_limit"""
    middle_value: ClassVar[ac.Option]
    """between the limits"""
    def __init__(
        self,
        *,
        upper_limit: SupportsFloat | ac.Start = ...,
        lower_limit: SupportsFloat | ac.Start = ...,
        n: SupportsIndex = ...,
        upper_value: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        lower_value: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        middle_value: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Set(ac.Component):
    """``x`` at all times."""

    x: ClassVar[ac.Option]
    """value"""
    y: ClassVar[ac.Output]
    """output"""
    def __init__(
        self,
        *,
        x: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Step(ac.Component):
    """``before`` until ``stepTime`` [s], then ``after``."""

    before: ClassVar[ac.Option]
    """value before the step"""
    after: ClassVar[ac.Option]
    """value after the step"""
    stepTime: ClassVar[ac.Parameter]
    """time of the step [s]"""
    y: ClassVar[ac.Output]
    """output"""
    def __init__(
        self,
        *,
        stepTime: SupportsFloat | ac.Start = ...,
        before: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        after: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Table(ac.Component):
    """``y0``, from each time [s] of ``t`` on the value of ``x`` beside it."""

    x: ClassVar[ac.Option]
    """values"""
    t: ClassVar[ac.Option]
    """times from which they hold, ascending"""
    y0: ClassVar[ac.Option]
    """value before the first time"""
    y: ClassVar[ac.Output]
    """output"""
    def __init__(
        self,
        *,
        x: Any = ...,
        t: Any = ...,
        y0: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class InertialDelay(ac.Component):
    """``y`` is ``x`` once that has kept its value for ``delayTime`` [s]."""

    y0: ClassVar[ac.Option]
    """output before the start"""
    x: ClassVar[ac.Input]
    """input"""
    y: ClassVar[ac.Output]
    """output"""
    held: ClassVar[ac.Discrete]
    """the input"""
    passed: ClassVar[ac.Discrete]
    """the output"""
    t_next: ClassVar[ac.Discrete]
    """when the next change is due [s]"""
    delayTime: ClassVar[ac.Parameter]
    """delay [s]"""
    def __init__(
        self,
        *,
        delayTime: SupportsFloat | ac.Start = ...,
        y0: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        held: ac.Start | Mapping[str, Any] = ...,
        passed: ac.Start | Mapping[str, Any] = ...,
        t_next: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class InertialDelaySensitive(ac.Component):
    """``y`` is ``x`` once that has kept its value for the delay of this change."""

    y0: ClassVar[ac.Option]
    """output before the start"""
    x: ClassVar[ac.Input]
    """input"""
    y: ClassVar[ac.Output]
    """output"""
    held: ClassVar[ac.Discrete]
    """the input"""
    passed: ClassVar[ac.Discrete]
    """the output"""
    t_next: ClassVar[ac.Discrete]
    """when the next change is due [s]"""
    tLH: ClassVar[ac.Parameter]
    """delay of rising changes [s]"""
    tHL: ClassVar[ac.Parameter]
    """delay of falling changes [s]"""
    def __init__(
        self,
        *,
        tLH: SupportsFloat | ac.Start = ...,
        tHL: SupportsFloat | ac.Start = ...,
        y0: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        held: ac.Start | Mapping[str, Any] = ...,
        passed: ac.Start | Mapping[str, Any] = ...,
        t_next: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LogicToUX01(ac.Component):
    """``'U'``, ``'0'``, ``'1'``, or ``'X'`` for the rest, element by element."""

    n: ClassVar[ac.Option]
    """number of signals"""
    x: ClassVar[ac.Input]
    """digital signals"""
    y: ClassVar[ac.Output]
    """digital signals of fewer values"""
    def __init__(
        self,
        *,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LogicToX01(ac.Component):
    """``'0'``, ``'1'``, or ``'X'`` for what is neither, element by element."""

    n: ClassVar[ac.Option]
    """number of signals"""
    x: ClassVar[ac.Input]
    """digital signals"""
    y: ClassVar[ac.Output]
    """digital signals of fewer values"""
    def __init__(
        self,
        *,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LogicToX01Z(ac.Component):
    """``'0'``, ``'1'``, ``'Z'``, or ``'X'`` for the rest, element by element."""

    n: ClassVar[ac.Option]
    """number of signals"""
    x: ClassVar[ac.Input]
    """digital signals"""
    y: ClassVar[ac.Output]
    """digital signals of fewer values"""
    def __init__(
        self,
        *,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Not(ac.Component):
    """1 for 0, 0 for 1, ``'U'`` for ``'U'``, else ``'X'``."""

    y: ClassVar[ac.Output]
    """output"""
    auxiliary: ClassVar[ac.Discrete]
    """what the output becomes"""
    x: ClassVar[ac.Input]
    """input"""
    def __init__(
        self,
        *,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        auxiliary: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class And(ac.Component):
    """1 if all inputs are 1; 0 if one is 0."""

    y: ClassVar[ac.Output]
    """output"""
    auxiliary: ClassVar[ac.Discrete]
    """what the output becomes"""
    n: ClassVar[ac.Option]
    """number of inputs"""
    x: ClassVar[ac.Input]
    """inputs"""
    def __init__(
        self,
        *,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        auxiliary: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class AndGate(ac.Component):
    """`And` with a delay."""

    tLH: ClassVar[ac.Parameter]
    """delay of rising outputs [s]"""
    tHL: ClassVar[ac.Parameter]
    """delay of falling outputs [s]"""
    y0: ClassVar[ac.Option]
    """output before the start"""
    y: ClassVar[ac.Output]
    """output"""
    n: ClassVar[ac.Option]
    """number of inputs"""
    x: ClassVar[ac.Input]
    """inputs"""
    G1: And
    G2: InertialDelaySensitive
    def __init__(
        self,
        *,
        tLH: SupportsFloat | ac.Start = ...,
        tHL: SupportsFloat | ac.Start = ...,
        y0: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class BufGate(ac.Component):
    """The input with a delay."""

    tLH: ClassVar[ac.Parameter]
    """delay of rising outputs [s]"""
    tHL: ClassVar[ac.Parameter]
    """delay of falling outputs [s]"""
    y0: ClassVar[ac.Option]
    """output before the start"""
    y: ClassVar[ac.Output]
    """output"""
    x: ClassVar[ac.Input]
    """input"""
    G2: InertialDelaySensitive
    def __init__(
        self,
        *,
        tLH: SupportsFloat | ac.Start = ...,
        tHL: SupportsFloat | ac.Start = ...,
        y0: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class InvGate(ac.Component):
    """`Not` with a delay."""

    tLH: ClassVar[ac.Parameter]
    """delay of rising outputs [s]"""
    tHL: ClassVar[ac.Parameter]
    """delay of falling outputs [s]"""
    y0: ClassVar[ac.Option]
    """output before the start"""
    y: ClassVar[ac.Output]
    """output"""
    x: ClassVar[ac.Input]
    """input"""
    G1: Not
    G2: InertialDelaySensitive
    def __init__(
        self,
        *,
        tLH: SupportsFloat | ac.Start = ...,
        tHL: SupportsFloat | ac.Start = ...,
        y0: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Nand(ac.Component):
    """0 if all inputs are 1; 1 if one is 0."""

    y: ClassVar[ac.Output]
    """output"""
    auxiliary: ClassVar[ac.Discrete]
    """what the output becomes"""
    n: ClassVar[ac.Option]
    """number of inputs"""
    x: ClassVar[ac.Input]
    """inputs"""
    def __init__(
        self,
        *,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        auxiliary: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class NandGate(ac.Component):
    """`Nand` with a delay."""

    tLH: ClassVar[ac.Parameter]
    """delay of rising outputs [s]"""
    tHL: ClassVar[ac.Parameter]
    """delay of falling outputs [s]"""
    y0: ClassVar[ac.Option]
    """output before the start"""
    y: ClassVar[ac.Output]
    """output"""
    n: ClassVar[ac.Option]
    """number of inputs"""
    x: ClassVar[ac.Input]
    """inputs"""
    G1: Nand
    G2: InertialDelaySensitive
    def __init__(
        self,
        *,
        tLH: SupportsFloat | ac.Start = ...,
        tHL: SupportsFloat | ac.Start = ...,
        y0: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Nor(ac.Component):
    """0 if an input is 1; 1 if all are 0."""

    y: ClassVar[ac.Output]
    """output"""
    auxiliary: ClassVar[ac.Discrete]
    """what the output becomes"""
    n: ClassVar[ac.Option]
    """number of inputs"""
    x: ClassVar[ac.Input]
    """inputs"""
    def __init__(
        self,
        *,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        auxiliary: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class NorGate(ac.Component):
    """`Nor` with a delay."""

    tLH: ClassVar[ac.Parameter]
    """delay of rising outputs [s]"""
    tHL: ClassVar[ac.Parameter]
    """delay of falling outputs [s]"""
    y0: ClassVar[ac.Option]
    """output before the start"""
    y: ClassVar[ac.Output]
    """output"""
    n: ClassVar[ac.Option]
    """number of inputs"""
    x: ClassVar[ac.Input]
    """inputs"""
    G1: Nor
    G2: InertialDelaySensitive
    def __init__(
        self,
        *,
        tLH: SupportsFloat | ac.Start = ...,
        tHL: SupportsFloat | ac.Start = ...,
        y0: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Or(ac.Component):
    """1 if an input is 1; 0 if all are 0."""

    y: ClassVar[ac.Output]
    """output"""
    auxiliary: ClassVar[ac.Discrete]
    """what the output becomes"""
    n: ClassVar[ac.Option]
    """number of inputs"""
    x: ClassVar[ac.Input]
    """inputs"""
    def __init__(
        self,
        *,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        auxiliary: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class OrGate(ac.Component):
    """`Or` with a delay."""

    tLH: ClassVar[ac.Parameter]
    """delay of rising outputs [s]"""
    tHL: ClassVar[ac.Parameter]
    """delay of falling outputs [s]"""
    y0: ClassVar[ac.Option]
    """output before the start"""
    y: ClassVar[ac.Output]
    """output"""
    n: ClassVar[ac.Option]
    """number of inputs"""
    x: ClassVar[ac.Input]
    """inputs"""
    G1: Or
    G2: InertialDelaySensitive
    def __init__(
        self,
        *,
        tLH: SupportsFloat | ac.Start = ...,
        tHL: SupportsFloat | ac.Start = ...,
        y0: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Xnor(ac.Component):
    """1 if an even number of inputs is 1."""

    y: ClassVar[ac.Output]
    """output"""
    auxiliary: ClassVar[ac.Discrete]
    """what the output becomes"""
    n: ClassVar[ac.Option]
    """number of inputs"""
    x: ClassVar[ac.Input]
    """inputs"""
    def __init__(
        self,
        *,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        auxiliary: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class XnorGate(ac.Component):
    """`Xnor` with a delay."""

    tLH: ClassVar[ac.Parameter]
    """delay of rising outputs [s]"""
    tHL: ClassVar[ac.Parameter]
    """delay of falling outputs [s]"""
    y0: ClassVar[ac.Option]
    """output before the start"""
    y: ClassVar[ac.Output]
    """output"""
    n: ClassVar[ac.Option]
    """number of inputs"""
    x: ClassVar[ac.Input]
    """inputs"""
    G1: Xnor
    G2: InertialDelaySensitive
    def __init__(
        self,
        *,
        tLH: SupportsFloat | ac.Start = ...,
        tHL: SupportsFloat | ac.Start = ...,
        y0: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Xor(ac.Component):
    """1 if an odd number of inputs is 1."""

    y: ClassVar[ac.Output]
    """output"""
    auxiliary: ClassVar[ac.Discrete]
    """what the output becomes"""
    n: ClassVar[ac.Option]
    """number of inputs"""
    x: ClassVar[ac.Input]
    """inputs"""
    def __init__(
        self,
        *,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        auxiliary: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class XorGate(ac.Component):
    """`Xor` with a delay."""

    tLH: ClassVar[ac.Parameter]
    """delay of rising outputs [s]"""
    tHL: ClassVar[ac.Parameter]
    """delay of falling outputs [s]"""
    y0: ClassVar[ac.Option]
    """output before the start"""
    y: ClassVar[ac.Output]
    """output"""
    n: ClassVar[ac.Option]
    """number of inputs"""
    x: ClassVar[ac.Input]
    """inputs"""
    G1: Xor
    G2: InertialDelaySensitive
    def __init__(
        self,
        *,
        tLH: SupportsFloat | ac.Start = ...,
        tHL: SupportsFloat | ac.Start = ...,
        y0: Literal["'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'"] = ...,
        n: SupportsIndex = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...
