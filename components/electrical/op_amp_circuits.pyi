"""Basic circuits with one operational amplifier (`Modelica.Electrical.Analog.Examples.OpAmps.OpAmpCircuits`).

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, SupportsFloat

import acausal as ac
from acausal.components import electrical as _electrical

__all__ = [
    "Add",
    "Buffer",
    "Der",
    "Derivative",
    "DifferentialAmplifierData",
    "Feedback",
    "FirstOrder",
    "Gain",
    "Integrator",
    "PI",
    "PartialOpAmp",
]

class DifferentialAmplifierData(ac.Component):
    """A record: what source, differential amplifier and instrument of Modelica's example have as parameters."""

    VSource: ClassVar[ac.Parameter]
    """effective voltage of the source, line to line [V]"""
    fSource: ClassVar[ac.Parameter]
    """frequency of the source [Hz]"""
    RLoad: ClassVar[ac.Parameter]
    """load of the source [Ohm]"""
    RGround: ClassVar[ac.Parameter]
    """resistance to ground [Ohm]"""
    V0: ClassVar[ac.Parameter]
    """gain of the amplifier without feedback"""
    VSupply: ClassVar[ac.Parameter]
    """supply [V]"""
    k: ClassVar[ac.Parameter]
    """attenuation"""
    R1: ClassVar[ac.Parameter]
    """resistor 1 [Ohm]"""
    R2: ClassVar[ac.Parameter]
    """resistor 2 [Ohm]"""
    R3: ClassVar[ac.Parameter]
    """resistor 3 [Ohm]"""
    R4: ClassVar[ac.Parameter]
    """resistor 4 [Ohm]"""
    RInstrument: ClassVar[ac.Parameter]
    """input resistance of the instrument [Ohm]"""
    def __init__(
        self,
        *,
        VSource: SupportsFloat | ac.Start = ...,
        fSource: SupportsFloat | ac.Start = ...,
        RLoad: SupportsFloat | ac.Start = ...,
        RGround: SupportsFloat | ac.Start = ...,
        V0: SupportsFloat | ac.Start = ...,
        VSupply: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        R1: SupportsFloat | ac.Start = ...,
        R2: SupportsFloat | ac.Start = ...,
        R3: SupportsFloat | ac.Start = ...,
        R4: SupportsFloat | ac.Start = ...,
        RInstrument: SupportsFloat | ac.Start = ...,
    ) -> None: ...

class PartialOpAmp(_electrical.FourPin):
    """Base of the circuits: the amplifier ``opAmp``, whose output is ``p2``; ``n1`` and ``n2`` are joined."""

    Vps: ClassVar[ac.Parameter]
    """positive supply [V]"""
    Vns: ClassVar[ac.Parameter]
    """negative supply [V]"""
    V0: ClassVar[ac.Parameter]
    """no-load gain"""
    opAmp: _electrical.IdealizedOpAmpLimited
    def __init__(self, **modifiers: Any) -> None: ...

class Buffer(PartialOpAmp):
    """Amplifier that does not invert: ``v2 = k v1``."""

    k: ClassVar[ac.Parameter]
    """gain"""
    R1: ClassVar[ac.Parameter]
    """resistance at the negative pins [Ohm]"""
    R2: ClassVar[ac.Parameter]
    """resistance, computed [Ohm]"""
    opAmp: _electrical.IdealizedOpAmpLimited
    r1: _electrical.Resistor
    r2: _electrical.Resistor
    def __init__(
        self,
        *,
        Vps: SupportsFloat | ac.Start = ...,
        Vns: SupportsFloat | ac.Start = ...,
        V0: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        R1: SupportsFloat | ac.Start = ...,
        R2: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Der(PartialOpAmp):
    """Differentiator: ``v2 = -k/(2 pi f) der(v1)``; ``v`` [V] is the capacitor's voltage."""

    k: ClassVar[ac.Parameter]
    """gain at the frequency f"""
    f: ClassVar[ac.Parameter]
    """frequency [Hz]"""
    R: ClassVar[ac.Parameter]
    """resistance at the output [Ohm]"""
    C: ClassVar[ac.Parameter]
    """capacitance, computed [F]"""
    v: ClassVar[ac.Variable]
    """voltage of the capacitor [V]"""
    opAmp: _electrical.IdealizedOpAmpLimited
    c: _electrical.Capacitor
    r: _electrical.Resistor
    def __init__(
        self,
        *,
        f: SupportsFloat | ac.Start = ...,
        Vps: SupportsFloat | ac.Start = ...,
        Vns: SupportsFloat | ac.Start = ...,
        V0: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        R: SupportsFloat | ac.Start = ...,
        C: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Derivative(PartialOpAmp):
    """High pass: ``v2 + T der(v2) = -k T der(v1)``; ``v`` [V] is the capacitor's voltage."""

    k: ClassVar[ac.Parameter]
    """gain"""
    R1: ClassVar[ac.Parameter]
    """resistance at the input [Ohm]"""
    R2: ClassVar[ac.Parameter]
    """resistance, computed [Ohm]"""
    T: ClassVar[ac.Parameter]
    """time constant [s]"""
    C: ClassVar[ac.Parameter]
    """capacitance, computed [F]"""
    v: ClassVar[ac.Variable]
    """voltage of the capacitor [V]"""
    opAmp: _electrical.IdealizedOpAmpLimited
    r1: _electrical.Resistor
    r2: _electrical.Resistor
    c: _electrical.Capacitor
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Vps: SupportsFloat | ac.Start = ...,
        Vns: SupportsFloat | ac.Start = ...,
        V0: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        R1: SupportsFloat | ac.Start = ...,
        R2: SupportsFloat | ac.Start = ...,
        C: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Feedback(PartialOpAmp):
    """Difference: ``v2 = -(v1 - v1_2)/k``; as in Modelica ``R3 = R1/k``, although it calls ``k`` the gain."""

    p1_2: _electrical.Pin
    v1_2: ClassVar[ac.Variable]
    """voltage from p1_2 to n1 [V]"""
    i1_2: ClassVar[ac.Variable]
    """current into p1_2 [A]"""
    k: ClassVar[ac.Parameter]
    """inverse of the gain"""
    R1: ClassVar[ac.Parameter]
    """resistance at the inputs [Ohm]"""
    R3: ClassVar[ac.Parameter]
    """resistance, computed [Ohm]"""
    opAmp: _electrical.IdealizedOpAmpLimited
    r1: _electrical.Resistor
    r2: _electrical.Resistor
    r3: _electrical.Resistor
    r4: _electrical.Resistor
    def __init__(
        self,
        *,
        Vps: SupportsFloat | ac.Start = ...,
        Vns: SupportsFloat | ac.Start = ...,
        V0: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        R1: SupportsFloat | ac.Start = ...,
        R3: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        p1_2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        v1_2: ac.Start | Mapping[str, Any] = ...,
        i1_2: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class FirstOrder(PartialOpAmp):
    """Low pass: ``v2 + T der(v2) = -k v1``; ``v`` [V] is the capacitor's voltage."""

    k: ClassVar[ac.Parameter]
    """gain"""
    R1: ClassVar[ac.Parameter]
    """resistance at the input [Ohm]"""
    R2: ClassVar[ac.Parameter]
    """resistance, computed [Ohm]"""
    T: ClassVar[ac.Parameter]
    """time constant [s]"""
    C: ClassVar[ac.Parameter]
    """capacitance, computed [F]"""
    v: ClassVar[ac.Variable]
    """voltage of the capacitor [V]"""
    opAmp: _electrical.IdealizedOpAmpLimited
    r1: _electrical.Resistor
    r2: _electrical.Resistor
    c: _electrical.Capacitor
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Vps: SupportsFloat | ac.Start = ...,
        Vns: SupportsFloat | ac.Start = ...,
        V0: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        R1: SupportsFloat | ac.Start = ...,
        R2: SupportsFloat | ac.Start = ...,
        C: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Gain(PartialOpAmp):
    """Inverting amplifier: ``v2 = -k v1``."""

    k: ClassVar[ac.Parameter]
    """gain"""
    R1: ClassVar[ac.Parameter]
    """resistance at the input [Ohm]"""
    R2: ClassVar[ac.Parameter]
    """resistance, computed [Ohm]"""
    opAmp: _electrical.IdealizedOpAmpLimited
    r1: _electrical.Resistor
    r2: _electrical.Resistor
    def __init__(
        self,
        *,
        Vps: SupportsFloat | ac.Start = ...,
        Vns: SupportsFloat | ac.Start = ...,
        V0: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        R1: SupportsFloat | ac.Start = ...,
        R2: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Integrator(PartialOpAmp):
    """Integrator: ``der(v2) = -2 pi f k v1``; ``v`` [V] is the capacitor's voltage."""

    k: ClassVar[ac.Parameter]
    """gain at the frequency f"""
    f: ClassVar[ac.Parameter]
    """frequency [Hz]"""
    R: ClassVar[ac.Parameter]
    """resistance at the input [Ohm]"""
    C: ClassVar[ac.Parameter]
    """capacitance, computed [F]"""
    v: ClassVar[ac.Variable]
    """voltage of the capacitor [V]"""
    opAmp: _electrical.IdealizedOpAmpLimited
    c: _electrical.Capacitor
    r: _electrical.Resistor
    def __init__(
        self,
        *,
        f: SupportsFloat | ac.Start = ...,
        Vps: SupportsFloat | ac.Start = ...,
        Vns: SupportsFloat | ac.Start = ...,
        V0: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        R: SupportsFloat | ac.Start = ...,
        C: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class PI(PartialOpAmp):
    """Inverting PI controller: ``v2 = -k (v1 + 1/T integral of v1)``."""

    k: ClassVar[ac.Parameter]
    """gain"""
    R1: ClassVar[ac.Parameter]
    """resistance at the input [Ohm]"""
    R2: ClassVar[ac.Parameter]
    """resistance, computed [Ohm]"""
    T: ClassVar[ac.Parameter]
    """time constant [s]"""
    C: ClassVar[ac.Parameter]
    """capacitance, computed [F]"""
    opAmp: _electrical.IdealizedOpAmpLimited
    r1: _electrical.Resistor
    r2: _electrical.Resistor
    c: _electrical.Capacitor
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Vps: SupportsFloat | ac.Start = ...,
        Vns: SupportsFloat | ac.Start = ...,
        V0: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        R1: SupportsFloat | ac.Start = ...,
        R2: SupportsFloat | ac.Start = ...,
        C: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Add(PartialOpAmp):
    """Inverting sum: ``v2 = -(k1 v1 + k2 v1_2)``."""

    p1_2: _electrical.Pin
    v1_2: ClassVar[ac.Variable]
    """voltage from p1_2 to n1 [V]"""
    i1_2: ClassVar[ac.Variable]
    """current into p1_2 [A]"""
    k1: ClassVar[ac.Parameter]
    """weight of the first input"""
    k2: ClassVar[ac.Parameter]
    """weight of the second input"""
    R: ClassVar[ac.Parameter]
    """resistance at the output [Ohm]"""
    R1: ClassVar[ac.Parameter]
    """resistance, computed [Ohm]"""
    R2: ClassVar[ac.Parameter]
    """resistance, computed [Ohm]"""
    opAmp: _electrical.IdealizedOpAmpLimited
    r1: _electrical.Resistor
    r2: _electrical.Resistor
    r: _electrical.Resistor
    def __init__(
        self,
        *,
        Vps: SupportsFloat | ac.Start = ...,
        Vns: SupportsFloat | ac.Start = ...,
        V0: SupportsFloat | ac.Start = ...,
        k1: SupportsFloat | ac.Start = ...,
        k2: SupportsFloat | ac.Start = ...,
        R: SupportsFloat | ac.Start = ...,
        R1: SupportsFloat | ac.Start = ...,
        R2: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        p1_2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        v1_2: ac.Start | Mapping[str, Any] = ...,
        i1_2: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...
