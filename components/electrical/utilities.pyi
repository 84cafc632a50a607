"""Parts of the examples (`Modelica.Electrical.Analog.Examples.Utilities`): circuits, elements with signals for pins.

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, SupportsFloat

import acausal as ac
from acausal.components import electrical as _electrical

__all__ = [
    "Conductor",
    "DirectCapacitor",
    "DirectInductor",
    "InverseCapacitor",
    "InverseInductor",
    "Nand",
    "NonlinearResistor",
    "Resistor",
    "Transistor",
]

class Conductor(ac.Component):
    """A conductor to ground that two currents feed, and the voltage that these find."""

    G: ClassVar[ac.Parameter]
    """conductance [S]"""
    i1: ClassVar[ac.Input]
    """current from the left [A]"""
    v1: ClassVar[ac.Output]
    """voltage that it finds [V]"""
    i2: ClassVar[ac.Input]
    """current from the right [A]"""
    v2: ClassVar[ac.Output]
    """voltage that it finds [V]"""
    conductor: _electrical.Conductor
    currentToVoltage1: _electrical.GeneralCurrentToVoltageAdaptor
    currentToVoltage2: _electrical.GeneralCurrentToVoltageAdaptor
    ground: _electrical.Ground
    def __init__(
        self,
        *,
        G: SupportsFloat | ac.Start = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class DirectCapacitor(ac.Component):
    """A capacitor driven by ``iDrive`` that gives its voltage and takes the current ``i``."""

    C: ClassVar[ac.Parameter]
    """capacitance [F]"""
    iDrive: ClassVar[ac.Input]
    """driving current [A]"""
    i: ClassVar[ac.Input]
    """current from what is connected [A]"""
    v: ClassVar[ac.Output]
    """voltage [V]"""
    dv: ClassVar[ac.Output]
    """rate of the voltage [V/s]"""
    capacitor: _electrical.Capacitor
    currentSource: _electrical.SignalCurrent
    currentToVoltage: _electrical.GeneralCurrentToVoltageAdaptor
    ground: _electrical.Ground
    def __init__(
        self,
        *,
        C: SupportsFloat | ac.Start = ...,
        iDrive: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        dv: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class DirectInductor(ac.Component):
    """An inductor driven by ``vDrive`` that gives its current and takes the voltage ``v`` behind it."""

    L: ClassVar[ac.Parameter]
    """inductance [H]"""
    vDrive: ClassVar[ac.Input]
    """driving voltage [V]"""
    v: ClassVar[ac.Input]
    """voltage of what is connected [V]"""
    i: ClassVar[ac.Output]
    """current [A]"""
    di: ClassVar[ac.Output]
    """rate of the current [A/s]"""
    inductor: _electrical.Inductor
    voltageSource: _electrical.SignalVoltage
    currentToVoltage: _electrical.GeneralVoltageToCurrentAdaptor
    ground: _electrical.Ground
    def __init__(
        self,
        *,
        L: SupportsFloat | ac.Start = ...,
        vDrive: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        di: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class InverseCapacitor(ac.Component):
    """A capacitor at the voltage that the signals say, and the current that this takes."""

    C: ClassVar[ac.Parameter]
    """capacitance [F]"""
    v: ClassVar[ac.Input]
    """voltage [V]"""
    dv: ClassVar[ac.Input]
    """rate of the voltage, consistent with v [V/s]"""
    i: ClassVar[ac.Output]
    """current that charges the capacitor [A]"""
    capacitor: _electrical.Capacitor
    voltageToCurrent: _electrical.GeneralVoltageToCurrentAdaptor
    ground: _electrical.Ground
    def __init__(
        self,
        *,
        C: SupportsFloat | ac.Start = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        dv: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class InverseInductor(ac.Component):
    """An inductor with the current that the signals say, and the voltage that this takes."""

    L: ClassVar[ac.Parameter]
    """inductance [H]"""
    i: ClassVar[ac.Input]
    """current [A]"""
    di: ClassVar[ac.Input]
    """rate of the current, consistent with i [A/s]"""
    v: ClassVar[ac.Output]
    """voltage that drives the current [V]"""
    inductor: _electrical.Inductor
    currentToVoltage: _electrical.GeneralCurrentToVoltageAdaptor
    ground: _electrical.Ground
    def __init__(
        self,
        *,
        L: SupportsFloat | ac.Start = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        di: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Nand(ac.Component):
    """CMOS gate: ``y`` is low where ``x1`` and ``x2`` are high. Tietze, Schenk: Halbleiter-Schaltungstechnik."""

    x1: _electrical.Pin
    x2: _electrical.Pin
    Vdd: _electrical.Pin
    y: _electrical.Pin
    TP1: _electrical.PMOS
    TP2: _electrical.PMOS
    TN1: _electrical.NMOS
    TN2: _electrical.NMOS
    C4: _electrical.Capacitor
    C7: _electrical.Capacitor
    Gnd: _electrical.Ground
    Gnd2: _electrical.Ground
    Gnd3: _electrical.Ground
    Gnd6: _electrical.Ground
    Gnd7: _electrical.Ground
    Gnd8: _electrical.Ground
    def __init__(
        self,
        *,
        x1: Mapping[str, Any] = ...,
        x2: Mapping[str, Any] = ...,
        Vdd: Mapping[str, Any] = ...,
        y: Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Resistor(ac.Component):
    """A resistor between two voltages, and the currents that these take."""

    R: ClassVar[ac.Parameter]
    """resistance [Ohm]"""
    v1: ClassVar[ac.Input]
    """voltage of the left end [V]"""
    i1: ClassVar[ac.Output]
    """current into the left end [A]"""
    v2: ClassVar[ac.Input]
    """voltage of the right end [V]"""
    i2: ClassVar[ac.Output]
    """current into the right end [A]"""
    resistor: _electrical.Resistor
    voltageToCurrent1: _electrical.GeneralVoltageToCurrentAdaptor
    voltageToCurrent2: _electrical.GeneralVoltageToCurrentAdaptor
    ground: _electrical.Ground
    def __init__(
        self,
        *,
        R: SupportsFloat | ac.Start = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Transistor(ac.Component):
    """An `NPN` transistor ``Tr`` with resistances before base and collector and a capacitor at the base."""

    c: _electrical.Pin
    b: _electrical.Pin
    e: _electrical.Pin
    rtb: _electrical.Resistor
    rtc: _electrical.Resistor
    ct: _electrical.Capacitor
    Tr: _electrical.NPN
    Ground1: _electrical.Ground
    def __init__(
        self,
        *,
        c: Mapping[str, Any] = ...,
        b: Mapping[str, Any] = ...,
        e: Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class NonlinearResistor(_electrical.OnePort):
    """Chua's resistor: ``i = Ga v`` for ``|v| < Ve``, outside with the conductance ``Gb``."""

    Ga: ClassVar[ac.Parameter]
    """conductance at small voltages [S]"""
    Gb: ClassVar[ac.Parameter]
    """conductance at large voltages [S]"""
    Ve: ClassVar[ac.Parameter]
    """voltage at which the conductance changes [V]"""
    def __init__(
        self,
        *,
        Ga: SupportsFloat | ac.Start = ...,
        Gb: SupportsFloat | ac.Start = ...,
        Ve: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...
