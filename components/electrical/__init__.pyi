"""Analog electrical circuits (`Modelica.Electrical.Analog`).

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Iterable, Mapping
from typing import Any, ClassVar, Literal, SupportsFloat, SupportsIndex

import acausal as ac
from acausal.components import (
    blocks as _blocks,
    rotational as _rotational,
    thermal as _thermal,
    translational as _translational,
)
from acausal.components.electrical.utilities import (
    Nand as Nand,
    NonlinearResistor as NonlinearResistor,
    Transistor as Transistor,
)

from . import op_amp_circuits as op_amp_circuits, utilities as utilities

__all__ = [
    "AD_Converter",
    "CCC",
    "CCV",
    "Capacitor",
    "CloserWithArc",
    "ConditionalHeatPort",
    "Conductor",
    "ConstantCurrent",
    "ConstantVoltage",
    "ControlledCloserWithArc",
    "ControlledIdealClosingSwitch",
    "ControlledIdealIntermediateSwitch",
    "ControlledIdealOpeningSwitch",
    "ControlledIdealTwoWaySwitch",
    "ControlledOpenerWithArc",
    "CosineCurrent",
    "CosineCurrentVariableFrequencyAndAmplitude",
    "CosineVoltage",
    "CosineVoltageVariableFrequencyAndAmplitude",
    "CurrentSensor",
    "CurrentSource",
    "DA_Converter",
    "DCPowerSupply",
    "Diode",
    "Diode2",
    "ExpSineCurrent",
    "ExpSineVoltage",
    "ExponentialsCurrent",
    "ExponentialsVoltage",
    "FourPin",
    "GeneralCurrentToVoltageAdaptor",
    "GeneralVoltageToCurrentAdaptor",
    "Ground",
    "Gyrator",
    "IdealClosingSwitch",
    "IdealDiode",
    "IdealGTOThyristor",
    "IdealIntermediateSwitch",
    "IdealOpAmp",
    "IdealOpAmp3Pin",
    "IdealOpAmpLimited",
    "IdealOpeningSwitch",
    "IdealSemiconductor",
    "IdealSwitch",
    "IdealSwitchWithArc",
    "IdealThyristor",
    "IdealTransformer",
    "IdealTriac",
    "IdealTwoWaySwitch",
    "IdealizedOpAmpLimited",
    "Idle",
    "Inductor",
    "LightningImpulse",
    "LightningImpulseCurrent",
    "LightningImpulseVoltage",
    "M_OLine",
    "M_Transformer",
    "MultiSensor",
    "NMOS",
    "NPN",
    "Nand",
    "NegativePin",
    "NonlinearResistor",
    "OLine",
    "OnePort",
    "OpAmp",
    "OpAmpDetailed",
    "OpenerWithArc",
    "PMOS",
    "PNP",
    "Pin",
    "PositivePin",
    "PotentialSensor",
    "Potentiometer",
    "PowerSensor",
    "PulseCurrent",
    "PulseVoltage",
    "RampCurrent",
    "RampVoltage",
    "Resistor",
    "RotationalEMF",
    "SaturatingInductor",
    "SawToothCurrent",
    "SawToothVoltage",
    "Short",
    "SignalCurrent",
    "SignalVoltage",
    "SimpleTriac",
    "SineCurrent",
    "SineCurrentVariableFrequencyAndAmplitude",
    "SineVoltage",
    "SineVoltageVariableFrequencyAndAmplitude",
    "StepCurrent",
    "StepVoltage",
    "SupplyVoltage",
    "TableCurrent",
    "TableVoltage",
    "Thyristor",
    "Transformer",
    "Transistor",
    "TranslationalEMF",
    "TrapezoidCurrent",
    "TrapezoidVoltage",
    "TwoPin",
    "TwoPort",
    "ULine",
    "VCC",
    "VCV",
    "VariableCapacitor",
    "VariableConductor",
    "VariableInductor",
    "VariableResistor",
    "VoltageSensor",
    "VoltageSource",
    "ZDiode",
    "op_amp_circuits",
    "utilities",
]

class AD_Converter(ac.Component):
    """The voltage ``u`` as a number of ``N`` bits ``y``, the least significant first, when ``trig`` turns 1."""

    N: ClassVar[ac.Option]
    """number of bits"""
    VRefHigh: ClassVar[ac.Parameter]
    """voltage of the greatest number [V]"""
    VRefLow: ClassVar[ac.Parameter]
    """voltage of zero [V]"""
    Rin: ClassVar[ac.Parameter]
    """resistance of the input [Ohm]"""
    p: Pin
    n: Pin
    trig: ClassVar[ac.Input]
    """trigger"""
    y: ClassVar[ac.Output]
    """bits, '1' or '0'; 'X' before the first trigger"""
    u: ClassVar[ac.Variable]
    """voltage of the input [V]"""
    z: ClassVar[ac.Discrete]
    """what does not fit into the bits"""
    code: ClassVar[ac.Discrete]
    """the number"""
    bits: ClassVar[ac.Discrete]
    """the bits"""
    def __init__(
        self,
        *,
        VRefHigh: SupportsFloat | ac.Start = ...,
        VRefLow: SupportsFloat | ac.Start = ...,
        Rin: SupportsFloat | ac.Start = ...,
        N: SupportsIndex = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        trig: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        z: ac.Start | Mapping[str, Any] = ...,
        code: ac.Start | Mapping[str, Any] = ...,
        bits: ac.Start | Mapping[str, Any] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ConditionalHeatPort(ac.Component):
    """A component that dissipates ``LossPower`` [W], and may hand it to a heat port."""

    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port"""
    T: ClassVar[ac.Parameter]
    """temperature of the device without heat port [K]"""
    heatPort: _thermal.HeatPort
    LossPower: ClassVar[ac.Variable]
    """power that leaves as heat [W]"""
    T_heatPort: ClassVar[ac.Variable]
    """temperature of the device [K]"""
    def __init__(self, **modifiers: Any) -> None: ...

class CurrentSensor(ac.Component):
    """Current in a branch: ``i = p.i`` [A]; the voltage is zero."""

    p: Pin
    n: Pin
    i: ClassVar[ac.Output]
    """current from p to n [A]"""
    def __init__(
        self,
        *,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class DA_Converter(ac.Component):
    """The number ``y`` of ``N`` bits ``x`` as a voltage ``vout = Vref y/(2**N - 1)``, when ``trig`` turns 1."""

    N: ClassVar[ac.Option]
    """number of bits"""
    Vref: ClassVar[ac.Parameter]
    """voltage of the greatest number [V]"""
    trig: ClassVar[ac.Input]
    """trigger"""
    x: ClassVar[ac.Input]
    """bits"""
    p: Pin
    n: Pin
    vout: ClassVar[ac.Discrete]
    """voltage of the output [V]"""
    y: ClassVar[ac.Discrete]
    """the number"""
    def __init__(
        self,
        *,
        Vref: SupportsFloat | ac.Start = ...,
        N: SupportsIndex = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        trig: ac.Start | Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        vout: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FourPin(ac.Component):
    """Two pairs of pins: ``v1 = p1.v - n1.v``, ``v2 = p2.v - n2.v``, ``i1 = p1.i``, ``i2 = p2.i``."""

    p1: Pin
    n1: Pin
    p2: Pin
    n2: Pin
    v1: ClassVar[ac.Variable]
    """voltage from p1 to n1 [V]"""
    v2: ClassVar[ac.Variable]
    """voltage from p2 to n2 [V]"""
    i1: ClassVar[ac.Variable]
    """current into p1 [A]"""
    i2: ClassVar[ac.Variable]
    """current into p2 [A]"""
    def __init__(self, **modifiers: Any) -> None: ...

class Ground(ac.Component):
    """The potential zero: ``p.v = 0``. Every circuit needs one."""

    p: Pin
    def __init__(self, *, p: Mapping[str, Any] = ...) -> None: ...

class IdealTriac(ac.Component):
    """Two ideal thyristors in opposite directions, which one signal fires, beside a snubber."""

    Ron: ClassVar[ac.Parameter]
    """resistance while conducting [Ohm]"""
    Goff: ClassVar[ac.Parameter]
    """conductance while blocking [S]"""
    Vknee: ClassVar[ac.Parameter]
    """threshold voltage in both directions [V]"""
    Rdis: ClassVar[ac.Parameter]
    """resistance of the snubber [Ohm]"""
    Cdis: ClassVar[ac.Parameter]
    """capacitance of the snubber [F]"""
    fire1: ClassVar[ac.Input]
    """gate: fires above 0.5 (Modelica: true)"""
    n: Pin
    p: Pin
    idealThyristor: IdealThyristor
    idealThyristor1: IdealThyristor
    resistor: Resistor
    capacitor: Capacitor
    def __init__(
        self,
        *,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        Vknee: SupportsFloat | ac.Start = ...,
        Rdis: SupportsFloat | ac.Start = ...,
        Cdis: SupportsFloat | ac.Start = ...,
        n: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        fire1: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class M_OLine(ac.Component):
    """``lines`` coupled lossy lines from ``p[j]`` to ``n[j]`` of ``N`` segments, at least two."""

    length: ClassVar[ac.Parameter]
    """length of the line [m]"""
    N: ClassVar[ac.Option]
    """number of segments"""
    lines: ClassVar[ac.Option]
    """number of lines"""
    r: ClassVar[ac.Parameter]
    """resistances per length [Ohm/m]"""
    l: ClassVar[ac.Parameter]
    """inductances per length [H/m]"""
    g: ClassVar[ac.Parameter]
    """conductances per length [S/m]"""
    c: ClassVar[ac.Parameter]
    """capacitances per length [F/m]"""
    useInternalGround: ClassVar[ac.Option]
    """whether the reference is grounded; else the pin refPin"""
    alpha_R: ClassVar[ac.Parameter]
    """temperature coefficient of the resistance [1/K]"""
    alpha_G: ClassVar[ac.Parameter]
    """temperature coefficient of the conductance [1/K]"""
    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port"""
    T: ClassVar[ac.Parameter]
    """temperature of the device without heat port [K]"""
    T_ref: ClassVar[ac.Parameter]
    """reference temperature [K]"""
    heatPort: _thermal.HeatPort
    refPin: Pin
    s_first: ac.Component
    s: list[ac.Component]
    s_last: ac.Component
    ground: Ground
    def __init__(
        self,
        *,
        length: SupportsFloat | ac.Start = ...,
        r: SupportsFloat | Iterable[Any] = ...,
        l: SupportsFloat | Iterable[Any] = ...,
        g: SupportsFloat | Iterable[Any] = ...,
        c: SupportsFloat | Iterable[Any] = ...,
        alpha_R: SupportsFloat | ac.Start = ...,
        alpha_G: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        N: SupportsIndex = ...,
        lines: SupportsIndex = ...,
        useInternalGround: bool = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        refPin: Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class M_Transformer(ac.Component):
    """``N`` coupled inductors, each from ``p[j]`` to ``n[j]``: ``v = Lm der(i)``; the currents start at 0."""

    N: ClassVar[ac.Option]
    """number of inductors"""
    L: ClassVar[ac.Parameter]
    """inductances and coupling inductances [H]"""
    v: ClassVar[ac.Variable]
    """voltages from p[j] to n[j] [V]"""
    i: ClassVar[ac.Variable]
    """currents from p[j] to n[j] [A]"""
    def __init__(
        self,
        *,
        L: SupportsFloat | Iterable[Any] = ...,
        N: SupportsIndex = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class OpAmp(ac.Component):
    """Amplifier with a smooth characteristic between the potentials of ``VMin`` and ``VMax``."""

    Slope: ClassVar[ac.Parameter]
    """slope of the characteristic at vin = 0"""
    in_p: Pin
    in_n: Pin
    out: Pin
    VMax: Pin
    VMin: Pin
    vin: ClassVar[ac.Variable]
    """input voltage [V]"""
    def __init__(
        self,
        *,
        Slope: SupportsFloat | ac.Start = ...,
        in_p: Mapping[str, Any] = ...,
        in_n: Mapping[str, Any] = ...,
        out: Mapping[str, Any] = ...,
        VMax: Mapping[str, Any] = ...,
        VMin: Mapping[str, Any] = ...,
        vin: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class OpAmpDetailed(ac.Component):
    """Amplifier in five stages, each with its figures of a data sheet."""

    Rdm: ClassVar[ac.Parameter]
    """input resistance, differential mode [Ohm]"""
    Rcm: ClassVar[ac.Parameter]
    """input resistance, common mode [Ohm]"""
    Cin: ClassVar[ac.Parameter]
    """input capacitance [F]"""
    Vos: ClassVar[ac.Parameter]
    """input offset voltage [V]"""
    Ib: ClassVar[ac.Parameter]
    """input bias current [A]"""
    Ios: ClassVar[ac.Parameter]
    """input offset current [A]"""
    vcp: ClassVar[ac.Parameter]
    """correction of the limit by p_supply [V]"""
    vcm: ClassVar[ac.Parameter]
    """correction of the limit by m_supply [V]"""
    Avd0: ClassVar[ac.Parameter]
    """differential gain [dB]"""
    CMRR: ClassVar[ac.Parameter]
    """common-mode rejection [dB]"""
    fp1: ClassVar[ac.Parameter]
    """dominant pole [Hz]"""
    fp2: ClassVar[ac.Parameter]
    """pole [Hz]"""
    fp3: ClassVar[ac.Parameter]
    """pole [Hz]"""
    fp4: ClassVar[ac.Parameter]
    """pole [Hz]"""
    fz: ClassVar[ac.Parameter]
    """zero [Hz]"""
    sr_p: ClassVar[ac.Parameter]
    """slew rate of a rise [V/s]"""
    sr_m: ClassVar[ac.Parameter]
    """slew rate of a fall [V/s]"""
    Rout: ClassVar[ac.Parameter]
    """output resistance [Ohm]"""
    Imaxso: ClassVar[ac.Parameter]
    """greatest current out of the output [A]"""
    Imaxsi: ClassVar[ac.Parameter]
    """greatest current into the output [A]"""
    Ts: ClassVar[ac.Parameter]
    """delay of the slew rate stage [s]"""
    p: Pin
    m: Pin
    outp: Pin
    p_supply: Pin
    m_supply: Pin
    v_pos: ClassVar[ac.Variable]
    """positive supply [V]"""
    v_neg: ClassVar[ac.Variable]
    """negative supply [V]"""
    v_vos: ClassVar[ac.Variable]
    """offset voltage [V]"""
    v_3: ClassVar[ac.Variable]
    """potential behind the offset [V]"""
    v_in: ClassVar[ac.Variable]
    """differential voltage [V]"""
    v_4: ClassVar[ac.Variable]
    """potential at m [V]"""
    i_vos: ClassVar[ac.Variable]
    """current into p [A]"""
    i_3: ClassVar[ac.Variable]
    """common-mode current at p [A]"""
    i_r2: ClassVar[ac.Variable]
    """current through Rdm [A]"""
    i_c3: ClassVar[ac.Variable]
    """current through Cin [A]"""
    i_4: ClassVar[ac.Variable]
    """common-mode current at m [A]"""
    q_fr1: ClassVar[ac.Variable]
    """behind the pole fp2 [V]"""
    q_fr2: ClassVar[ac.Variable]
    """behind the pole fp3 and the zero fz [V]"""
    q_fr3: ClassVar[ac.Variable]
    """behind the pole fp4 [V]"""
    q_sum: ClassVar[ac.Variable]
    """amplified voltage [V]"""
    q_sum_help: ClassVar[ac.Variable]
    """amplified voltage, bounded [V]"""
    q_fp1: ClassVar[ac.Variable]
    """behind the pole fp1 [V]"""
    v_source: ClassVar[ac.Variable]
    """source of the output [V]"""
    x: ClassVar[ac.Variable]
    """integral of the unbounded slew rate [V]"""
    v_out: ClassVar[ac.Variable]
    """potential of the output [V]"""
    i_out: ClassVar[ac.Variable]
    """current into the output [A]"""
    s: ClassVar[ac.Variable]
    """position on the characteristic of the output [A]"""
    def __init__(
        self,
        *,
        Rdm: SupportsFloat | ac.Start = ...,
        Rcm: SupportsFloat | ac.Start = ...,
        Cin: SupportsFloat | ac.Start = ...,
        Vos: SupportsFloat | ac.Start = ...,
        Ib: SupportsFloat | ac.Start = ...,
        Ios: SupportsFloat | ac.Start = ...,
        vcp: SupportsFloat | ac.Start = ...,
        vcm: SupportsFloat | ac.Start = ...,
        Avd0: SupportsFloat | ac.Start = ...,
        CMRR: SupportsFloat | ac.Start = ...,
        fp1: SupportsFloat | ac.Start = ...,
        fp2: SupportsFloat | ac.Start = ...,
        fp3: SupportsFloat | ac.Start = ...,
        fp4: SupportsFloat | ac.Start = ...,
        fz: SupportsFloat | ac.Start = ...,
        sr_p: SupportsFloat | ac.Start = ...,
        sr_m: SupportsFloat | ac.Start = ...,
        Rout: SupportsFloat | ac.Start = ...,
        Imaxso: SupportsFloat | ac.Start = ...,
        Imaxsi: SupportsFloat | ac.Start = ...,
        Ts: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        m: Mapping[str, Any] = ...,
        outp: Mapping[str, Any] = ...,
        p_supply: Mapping[str, Any] = ...,
        m_supply: Mapping[str, Any] = ...,
        v_pos: ac.Start | Mapping[str, Any] = ...,
        v_neg: ac.Start | Mapping[str, Any] = ...,
        v_vos: ac.Start | Mapping[str, Any] = ...,
        v_3: ac.Start | Mapping[str, Any] = ...,
        v_in: ac.Start | Mapping[str, Any] = ...,
        v_4: ac.Start | Mapping[str, Any] = ...,
        i_vos: ac.Start | Mapping[str, Any] = ...,
        i_3: ac.Start | Mapping[str, Any] = ...,
        i_r2: ac.Start | Mapping[str, Any] = ...,
        i_c3: ac.Start | Mapping[str, Any] = ...,
        i_4: ac.Start | Mapping[str, Any] = ...,
        q_fr1: ac.Start | Mapping[str, Any] = ...,
        q_fr2: ac.Start | Mapping[str, Any] = ...,
        q_fr3: ac.Start | Mapping[str, Any] = ...,
        q_sum: ac.Start | Mapping[str, Any] = ...,
        q_sum_help: ac.Start | Mapping[str, Any] = ...,
        q_fp1: ac.Start | Mapping[str, Any] = ...,
        v_source: ac.Start | Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        v_out: ac.Start | Mapping[str, Any] = ...,
        i_out: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Pin(ac.Connector):
    """Potential ``v`` [V] and current ``i`` [A], positive into the component."""

    v: ClassVar[ac.Potential]
    """potential at the pin [V]"""
    i: ClassVar[ac.Flow]
    """current into the pin [A]"""

class PotentialSensor(ac.Component):
    """Potential of a pin: ``phi = p.v`` [V]."""

    p: Pin
    phi: ClassVar[ac.Output]
    """potential of the pin [V]"""
    def __init__(
        self, *, p: Mapping[str, Any] = ..., phi: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class PowerSensor(ac.Component):
    """Power: ``power = v i`` [W] with the voltage from ``pv`` to ``nv`` and the current from ``pc`` to ``nc``."""

    pc: Pin
    nc: Pin
    pv: Pin
    nv: Pin
    power: ClassVar[ac.Output]
    """instantaneous power [W]"""
    def __init__(
        self,
        *,
        pc: Mapping[str, Any] = ...,
        nc: Mapping[str, Any] = ...,
        pv: Mapping[str, Any] = ...,
        nv: Mapping[str, Any] = ...,
        power: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SignalCurrent(ac.Component):
    """A current given by a signal ``i`` [A]: ``i = p.i = -n.i``, ``v = p.v - n.v`` [V]."""

    p: Pin
    n: Pin
    i: ClassVar[ac.Input]
    """current from p to n [A]"""
    v: ClassVar[ac.Variable]
    """voltage from p to n [V]"""
    def __init__(
        self,
        *,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SignalVoltage(ac.Component):
    """A voltage given by a signal ``v`` [V]: ``v = p.v - n.v``, ``i = p.i`` [A]."""

    p: Pin
    n: Pin
    v: ClassVar[ac.Input]
    """voltage from p to n [V]"""
    i: ClassVar[ac.Variable]
    """current from p to n [A]"""
    def __init__(
        self,
        *,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SupplyVoltage(ac.Component):
    """Two constant voltages: ``Vps`` from ``ground`` to ``pin_p``, ``Vns`` from ``ground`` to ``pin_n``."""

    Vps: ClassVar[ac.Parameter]
    """positive supply [V]"""
    Vns: ClassVar[ac.Parameter]
    """negative supply [V]"""
    pin_p: Pin
    pin_n: Pin
    ground: Pin
    positiveSupply: ConstantVoltage
    negativeSupply: ConstantVoltage
    def __init__(
        self,
        *,
        Vps: SupportsFloat | ac.Start = ...,
        Vns: SupportsFloat | ac.Start = ...,
        pin_p: Mapping[str, Any] = ...,
        pin_n: Mapping[str, Any] = ...,
        ground: Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class TwoPin(ac.Component):
    """Two pins and the voltage between them: ``v = p.v - n.v`` [V]."""

    p: Pin
    n: Pin
    v: ClassVar[ac.Variable]
    """voltage from p to n [V]"""
    def __init__(self, **modifiers: Any) -> None: ...

class VoltageSensor(ac.Component):
    """Voltage between two pins: ``v = p.v - n.v`` [V]; no current flows."""

    p: Pin
    n: Pin
    v: ClassVar[ac.Output]
    """voltage from p to n [V]"""
    def __init__(
        self,
        *,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GeneralCurrentToVoltageAdaptor(ac.Component):
    """Current in, voltage out: ``i = f``, ``p = v``."""

    use_pder: ClassVar[ac.Option]
    """whether there is a signal for the derivative of the voltage"""
    use_fder: ClassVar[ac.Option]
    """whether there is a signal for the derivative of the current"""
    pin_p: Pin
    pin_n: Pin
    v: ClassVar[ac.Variable]
    """voltage from pin_p to pin_n [V]"""
    i: ClassVar[ac.Variable]
    """current from pin_p to pin_n [A]"""
    f: ClassVar[ac.Input]
    """current [A]"""
    fder: ClassVar[ac.Input]
    """derivative of the current [A/s]"""
    p: ClassVar[ac.Output]
    """voltage [V]"""
    pder: ClassVar[ac.Output]
    """derivative of the voltage [V/s]"""
    def __init__(
        self,
        *,
        use_pder: bool = ...,
        use_fder: bool = ...,
        pin_p: Mapping[str, Any] = ...,
        pin_n: Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        fder: ac.Start | Mapping[str, Any] = ...,
        p: ac.Start | Mapping[str, Any] = ...,
        pder: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GeneralVoltageToCurrentAdaptor(ac.Component):
    """Voltage in, current out: ``v = p``, ``f = -i``, the current that drives what is connected."""

    use_pder: ClassVar[ac.Option]
    """whether there is a signal for the derivative of the voltage"""
    use_fder: ClassVar[ac.Option]
    """whether there is a signal for the derivative of the current"""
    pin_p: Pin
    pin_n: Pin
    v: ClassVar[ac.Variable]
    """voltage from pin_p to pin_n [V]"""
    i: ClassVar[ac.Variable]
    """current from pin_p to pin_n [A]"""
    p: ClassVar[ac.Input]
    """voltage [V]"""
    pder: ClassVar[ac.Input]
    """derivative of the voltage [V/s]"""
    f: ClassVar[ac.Output]
    """current [A]"""
    fder: ClassVar[ac.Output]
    """derivative of the current [A/s]"""
    def __init__(
        self,
        *,
        use_pder: bool = ...,
        use_fder: bool = ...,
        pin_p: Mapping[str, Any] = ...,
        pin_n: Mapping[str, Any] = ...,
        p: ac.Start | Mapping[str, Any] = ...,
        pder: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        fder: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealOpAmp3Pin(ac.Component):
    """Nullator and norator with three pins: ``in_p.v = in_n.v``, no current in; the output is free."""

    in_p: Pin
    in_n: Pin
    out: Pin
    def __init__(
        self,
        *,
        in_p: Mapping[str, Any] = ...,
        in_n: Mapping[str, Any] = ...,
        out: Mapping[str, Any] = ...,
    ) -> None: ...

class MultiSensor(PowerSensor):
    """Voltage ``v`` [V] from ``pv`` to ``nv``, current ``i`` [A] from ``pc`` to ``nc`` and ``power = v i`` [W]."""

    i: ClassVar[ac.Output]
    """current [A]"""
    v: ClassVar[ac.Output]
    """voltage [V]"""
    def __init__(
        self,
        *,
        pc: Mapping[str, Any] = ...,
        nc: Mapping[str, Any] = ...,
        pv: Mapping[str, Any] = ...,
        nv: Mapping[str, Any] = ...,
        power: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class OLine(ac.Component):
    """Lossy line: ``N + 1`` parts with ``R`` and ``L`` in series, ``N`` nodes with ``C`` and ``G`` to ``p3``."""

    p1: Pin
    p2: Pin
    p3: Pin
    heatPort: _thermal.HeatPort
    N: ClassVar[ac.Option]
    """number of segments"""
    length: ClassVar[ac.Parameter]
    """length of the line [m]"""
    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port"""
    T: ClassVar[ac.Parameter]
    """temperature of the device without heat port [K]"""
    T_ref: ClassVar[ac.Parameter]
    """reference temperature [K]"""
    v13: ClassVar[ac.Variable]
    """voltage from p1 to p3 [V]"""
    v23: ClassVar[ac.Variable]
    """voltage from p2 to p3 [V]"""
    i1: ClassVar[ac.Variable]
    """current into p1 [A]"""
    i2: ClassVar[ac.Variable]
    """current into p2 [A]"""
    r: ClassVar[ac.Parameter]
    """resistance per length [Ohm/m]"""
    l: ClassVar[ac.Parameter]
    """inductance per length [H/m]"""
    g: ClassVar[ac.Parameter]
    """conductance per length [S/m]"""
    c: ClassVar[ac.Parameter]
    """capacitance per length [F/m]"""
    alpha_R: ClassVar[ac.Parameter]
    """temperature coefficient of the resistance [1/K]"""
    alpha_G: ClassVar[ac.Parameter]
    """temperature coefficient of the conductance [1/K]"""
    v: ClassVar[ac.Variable]
    """voltages at the nodes [V]"""
    i: ClassVar[ac.Variable]
    """currents of the parts [A]"""
    R: list[Resistor]
    L: list[Inductor]
    C: list[Capacitor]
    G: list[Conductor]
    def __init__(
        self,
        *,
        length: SupportsFloat | ac.Start = ...,
        r: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        g: SupportsFloat | ac.Start = ...,
        c: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        alpha_R: SupportsFloat | ac.Start = ...,
        alpha_G: SupportsFloat | ac.Start = ...,
        N: SupportsIndex = ...,
        useHeatPort: bool = ...,
        p1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        p3: Mapping[str, Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        v13: ac.Start | Mapping[str, Any] = ...,
        v23: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class OnePort(TwoPin):
    """Two pins with one current ``i = p.i = -n.i`` [A]; a subclass relates ``v`` and ``i``."""

    i: ClassVar[ac.Variable]
    """current from p to n [A]"""
    def __init__(self, **modifiers: Any) -> None: ...

class Potentiometer(ConditionalHeatPort):
    """Resistor with a sliding contact between ``pin_n`` (0) and ``pin_p`` (1)."""

    T: ClassVar[ac.Parameter]
    """temperature without heat port [K]"""
    R: ClassVar[ac.Parameter]
    """whole resistance at T_ref [Ohm]"""
    T_ref: ClassVar[ac.Parameter]
    """reference temperature [K]"""
    alpha: ClassVar[ac.Parameter]
    """temperature coefficient of the resistance [1/K]"""
    useRinput: ClassVar[ac.Option]
    """whether the input r replaces rConstant"""
    rConstant: ClassVar[ac.Parameter]
    """position of the contact without input"""
    r: ClassVar[ac.Input]
    """position of the contact"""
    pin_p: Pin
    contact: Pin
    pin_n: Pin
    Rp: ClassVar[ac.Variable]
    """resistance between pin_p and contact [Ohm]"""
    Rn: ClassVar[ac.Variable]
    """resistance between contact and pin_n [Ohm]"""
    def __init__(
        self,
        *,
        R: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        alpha: SupportsFloat | ac.Start = ...,
        rConstant: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        useRinput: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        pin_p: Mapping[str, Any] = ...,
        contact: Mapping[str, Any] = ...,
        pin_n: Mapping[str, Any] = ...,
        r: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        Rp: ac.Start | Mapping[str, Any] = ...,
        Rn: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TwoPort(FourPin):
    """Two ports: what enters ``p1`` leaves at ``n1``, what enters ``p2`` at ``n2``."""
    def __init__(self, **modifiers: Any) -> None: ...

class ULine(ac.Component):
    """Lossy RC line: ``N + 1`` resistors ``R`` in series, ``N`` nodes with ``C`` to ``p3``."""

    p1: Pin
    p2: Pin
    p3: Pin
    heatPort: _thermal.HeatPort
    N: ClassVar[ac.Option]
    """number of segments"""
    length: ClassVar[ac.Parameter]
    """length of the line [m]"""
    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port"""
    T: ClassVar[ac.Parameter]
    """temperature of the device without heat port [K]"""
    T_ref: ClassVar[ac.Parameter]
    """reference temperature [K]"""
    v13: ClassVar[ac.Variable]
    """voltage from p1 to p3 [V]"""
    v23: ClassVar[ac.Variable]
    """voltage from p2 to p3 [V]"""
    i1: ClassVar[ac.Variable]
    """current into p1 [A]"""
    i2: ClassVar[ac.Variable]
    """current into p2 [A]"""
    r: ClassVar[ac.Parameter]
    """resistance per length [Ohm/m]"""
    c: ClassVar[ac.Parameter]
    """capacitance per length [F/m]"""
    alpha: ClassVar[ac.Parameter]
    """temperature coefficient of the resistance [1/K]"""
    R: list[Resistor]
    C: list[Capacitor]
    def __init__(
        self,
        *,
        length: SupportsFloat | ac.Start = ...,
        r: SupportsFloat | ac.Start = ...,
        c: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        alpha: SupportsFloat | ac.Start = ...,
        N: SupportsIndex = ...,
        useHeatPort: bool = ...,
        p1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        p3: Mapping[str, Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        v13: ac.Start | Mapping[str, Any] = ...,
        v23: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class CCC(TwoPort):
    """Current-controlled current source: ``i2 = gain i1``, ``v1 = 0``."""

    gain: ClassVar[ac.Parameter]
    """current gain"""
    def __init__(
        self,
        *,
        gain: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CCV(TwoPort):
    """Current-controlled voltage source: ``v2 = transResistance i1``, ``v1 = 0``."""

    transResistance: ClassVar[ac.Parameter]
    """transresistance [Ohm]"""
    def __init__(
        self,
        *,
        transResistance: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Capacitor(OnePort):
    """Linear capacitor: ``i = C der(v)``."""

    C: ClassVar[ac.Parameter]
    """capacitance [F]"""
    def __init__(
        self,
        *,
        C: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ConstantCurrent(OnePort):
    """``i = I``."""

    I: ClassVar[ac.Parameter]
    """constant current [A]"""
    def __init__(
        self,
        *,
        I: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ConstantVoltage(OnePort):
    """``v = V``."""

    V: ClassVar[ac.Parameter]
    """constant voltage [V]"""
    def __init__(
        self,
        *,
        V: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class DCPowerSupply(OnePort):
    """A supply of the laboratory: constant voltage, constant power, or constant current, whichever gives the least."""

    v: ClassVar[ac.Variable]
    """voltage from p to n [V]"""
    V0: ClassVar[ac.Parameter]
    """voltage without load [V]"""
    I0: ClassVar[ac.Parameter]
    """current of a short circuit [A]"""
    P0: ClassVar[ac.Parameter]
    """greatest power [W]"""
    Rcv: ClassVar[ac.Parameter]
    """inner resistance at constant voltage [Ohm]"""
    Gcc: ClassVar[ac.Parameter]
    """inner conductance at constant current [S]"""
    iBack: ClassVar[ac.Option]
    """without effect"""
    P: ClassVar[ac.Variable]
    """power, negative where it is delivered [W]"""
    def __init__(
        self,
        *,
        V0: SupportsFloat | ac.Start = ...,
        I0: SupportsFloat | ac.Start = ...,
        P0: SupportsFloat | ac.Start = ...,
        Rcv: SupportsFloat | ac.Start = ...,
        Gcc: SupportsFloat | ac.Start = ...,
        iBack: Any = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        P: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Gyrator(TwoPort):
    """Gyrator: ``i1 = G2 v2``, ``i2 = -G1 v1``."""

    G1: ClassVar[ac.Parameter]
    """primary gyration conductance [S]"""
    G2: ClassVar[ac.Parameter]
    """secondary gyration conductance [S]"""
    def __init__(
        self,
        *,
        G1: SupportsFloat | ac.Start = ...,
        G2: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealOpAmp(TwoPort):
    """Nullator and norator: ``v1 = 0`` and ``i1 = 0``; ``v2`` and ``i2`` are what the circuit asks for."""
    def __init__(
        self,
        *,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealOpAmpLimited(ac.Component):
    """Ideal amplifier whose output stays between the potentials of ``VMin`` and ``VMax``."""

    in_p: Pin
    in_n: Pin
    out: Pin
    mode: ClassVar[ac.Discrete]
    """1 at the upper limit, -1 at the lower limit, 0 between, 2 or -2 while it is tried to leave one"""
    pull: ClassVar[ac.Discrete]
    """at a limit, how much the input asked for a higher output at the last event"""
    push: ClassVar[ac.Variable]
    """while leaving is tried: above zero if it leads to the middle"""
    VMax: Pin
    VMin: Pin
    vin: ClassVar[ac.Variable]
    """input voltage [V]"""
    s: ClassVar[ac.Variable]
    """position on the characteristic; the limits are at -1 and 1"""
    def __init__(
        self,
        *,
        in_p: Mapping[str, Any] = ...,
        in_n: Mapping[str, Any] = ...,
        out: Mapping[str, Any] = ...,
        VMax: Mapping[str, Any] = ...,
        VMin: Mapping[str, Any] = ...,
        mode: ac.Start | Mapping[str, Any] = ...,
        pull: ac.Start | Mapping[str, Any] = ...,
        push: ac.Start | Mapping[str, Any] = ...,
        vin: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealTransformer(TwoPort):
    """Ideal transformer: ``v1 = n v2``, and ``i1 + i2/n = im1``, the magnetizing current."""

    n: ClassVar[ac.Parameter]
    """turns ratio, primary to secondary voltage"""
    considerMagnetization: ClassVar[ac.Option]
    """whether there is a magnetizing current"""
    Lm1: ClassVar[ac.Parameter]
    """magnetizing inductance, primary side [H]"""
    im1: ClassVar[ac.Variable]
    """magnetizing current, primary side [A]"""
    psim1: ClassVar[ac.Variable]
    """flux linkage, primary side [Wb]"""
    def __init__(
        self,
        *,
        n: SupportsFloat | ac.Start = ...,
        Lm1: SupportsFloat | ac.Start = ...,
        considerMagnetization: bool = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        im1: ac.Start | Mapping[str, Any] = ...,
        psim1: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealizedOpAmpLimited(ac.Component):
    """Amplifier with the gain ``V0``: ``v_out = V0 v_in``, bounded to the supply ``vns`` ... ``vps``."""

    in_p: Pin
    in_n: Pin
    out: Pin
    mode: ClassVar[ac.Discrete]
    """1 at the upper limit, -1 at the lower limit, 0 between, 2 or -2 while it is tried to leave one"""
    pull: ClassVar[ac.Discrete]
    """at a limit, how much the input asked for a higher output at the last event"""
    push: ClassVar[ac.Variable]
    """while leaving is tried: above zero if it leads to the middle"""
    V0: ClassVar[ac.Parameter]
    """no-load gain"""
    useSupply: ClassVar[ac.Option]
    """whether there are supply pins"""
    Vps: ClassVar[ac.Parameter]
    """positive supply without pins [V]"""
    Vns: ClassVar[ac.Parameter]
    """negative supply without pins [V]"""
    strict: ClassVar[ac.Option]
    """without effect"""
    homotopyType: ClassVar[ac.Option]
    """where the output begins, if there is a choice"""
    s_p: Pin
    s_n: Pin
    vps: ClassVar[ac.Variable]
    """positive supply [V]"""
    vns: ClassVar[ac.Variable]
    """negative supply [V]"""
    v_in: ClassVar[ac.Variable]
    """input voltage [V]"""
    v_out: ClassVar[ac.Variable]
    """potential of the output [V]"""
    p_in: ClassVar[ac.Variable]
    """power into the inputs [W]"""
    p_out: ClassVar[ac.Variable]
    """power into the output [W]"""
    p_s: ClassVar[ac.Variable]
    """power from the supply [W]"""
    i_s: ClassVar[ac.Variable]
    """current from the supply [A]"""
    def __init__(
        self,
        *,
        V0: SupportsFloat | ac.Start = ...,
        Vps: SupportsFloat | ac.Start = ...,
        Vns: SupportsFloat | ac.Start = ...,
        useSupply: bool = ...,
        strict: bool = ...,
        homotopyType: Literal["NoHomotopy", "Linear", "UpperLimit", "LowerLimit"] = ...,
        in_p: Mapping[str, Any] = ...,
        in_n: Mapping[str, Any] = ...,
        out: Mapping[str, Any] = ...,
        s_p: Mapping[str, Any] = ...,
        s_n: Mapping[str, Any] = ...,
        mode: ac.Start | Mapping[str, Any] = ...,
        pull: ac.Start | Mapping[str, Any] = ...,
        push: ac.Start | Mapping[str, Any] = ...,
        vps: ac.Start | Mapping[str, Any] = ...,
        vns: ac.Start | Mapping[str, Any] = ...,
        v_in: ac.Start | Mapping[str, Any] = ...,
        v_out: ac.Start | Mapping[str, Any] = ...,
        p_in: ac.Start | Mapping[str, Any] = ...,
        p_out: ac.Start | Mapping[str, Any] = ...,
        p_s: ac.Start | Mapping[str, Any] = ...,
        i_s: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Idle(OnePort):
    """An interruption: ``i = 0``."""
    def __init__(
        self,
        *,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Inductor(OnePort):
    """Linear inductor: ``v = L der(i)``."""

    L: ClassVar[ac.Parameter]
    """inductance [H]"""
    def __init__(
        self,
        *,
        L: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LightningImpulse(_blocks.SignalSource):
    """An impulse of the height ``amplitude`` by Heidler's function, or by two exponentials."""

    approximation: ClassVar[ac.Option]
    """approximation of the impulse"""
    amplitude: ClassVar[ac.Parameter]
    """height of the impulse"""
    T1: ClassVar[ac.Option]
    """rise time in s"""
    T2: ClassVar[ac.Option]
    """time in s until it has fallen to a half"""
    m: ClassVar[ac.Option]
    """exponent of Heidler's function, 5 to 10"""
    def __init__(
        self,
        *,
        amplitude: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        approximation: Literal["Heidler", "DoubleExp"] = ...,
        T1: Any = ...,
        T2: Any = ...,
        m: SupportsIndex = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RotationalEMF(OnePort):
    """Rotary motor: ``v = k w``, ``tau = -k i`` with ``w = der(phi)``, ``phi = flange.phi - support.phi``."""

    useSupport: ClassVar[ac.Option]
    """whether there is a support flange; else fixed to the ground"""
    k: ClassVar[ac.Parameter]
    """torque per current, = voltage per speed [N.m/A]"""
    flange: _rotational.Flange
    support: _rotational.Flange
    phi: ClassVar[ac.Variable]
    """angle of the flange relative to the support [rad]"""
    w: ClassVar[ac.Variable]
    """speed of the flange relative to the support [rad/s]"""
    tau: ClassVar[ac.Variable]
    """torque at the flange [N.m]"""
    tauElectrical: ClassVar[ac.Variable]
    """electrical torque, = -tau [N.m]"""
    def __init__(
        self,
        *,
        k: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        tauElectrical: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SaturatingInductor(OnePort):
    """Inductor whose inductance falls from ``Lzer`` at no current to ``Linf`` at large currents."""

    Inom: ClassVar[ac.Parameter]
    """nominal current [A]"""
    Lnom: ClassVar[ac.Parameter]
    """inductance at the nominal current [H]"""
    Lzer: ClassVar[ac.Parameter]
    """inductance near zero current [H]"""
    Linf: ClassVar[ac.Parameter]
    """inductance at large currents [H]"""
    Ipar: ClassVar[ac.Parameter]
    """current that scales the saturation, computed [A]"""
    Lact: ClassVar[ac.Variable]
    """actual inductance [H]"""
    Psi: ClassVar[ac.Variable]
    """flux linkage [Wb]"""
    def __init__(
        self,
        *,
        Inom: SupportsFloat | ac.Start = ...,
        Lnom: SupportsFloat | ac.Start = ...,
        Lzer: SupportsFloat | ac.Start = ...,
        Linf: SupportsFloat | ac.Start = ...,
        Ipar: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        Lact: ac.Start | Mapping[str, Any] = ...,
        Psi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Short(OnePort):
    """A short cut: ``v = 0``."""
    def __init__(
        self,
        *,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SimpleTriac(ConditionalHeatPort):
    """Two thyristors in opposite directions, each with an ideal diode before its gate."""

    VDRM: ClassVar[ac.Parameter]
    """forward breakthrough voltage [V]"""
    VRRM: ClassVar[ac.Parameter]
    """reverse breakthrough voltage [V]"""
    IDRM: ClassVar[ac.Parameter]
    """saturation current, without effect [A]"""
    VTM: ClassVar[ac.Parameter]
    """conducting voltage [V]"""
    IH: ClassVar[ac.Parameter]
    """holding current [A]"""
    ITM: ClassVar[ac.Parameter]
    """conducting current [A]"""
    VGT: ClassVar[ac.Parameter]
    """gate trigger voltage [V]"""
    IGT: ClassVar[ac.Parameter]
    """gate trigger current [A]"""
    TON: ClassVar[ac.Parameter]
    """switch on time [s]"""
    TOFF: ClassVar[ac.Parameter]
    """switch off time [s]"""
    Vt: ClassVar[ac.Parameter]
    """thermal voltage (kT/qn) [V]"""
    Nbv: ClassVar[ac.Parameter]
    """emission coefficient of the reverse breakthrough"""
    n: Pin
    p: Pin
    g: Pin
    thyristor: Thyristor
    thyristor1: Thyristor
    idealDiode: IdealDiode
    idealDiode1: IdealDiode
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        VDRM: SupportsFloat | ac.Start = ...,
        VRRM: SupportsFloat | ac.Start = ...,
        IDRM: SupportsFloat | ac.Start = ...,
        VTM: SupportsFloat | ac.Start = ...,
        IH: SupportsFloat | ac.Start = ...,
        ITM: SupportsFloat | ac.Start = ...,
        VGT: SupportsFloat | ac.Start = ...,
        IGT: SupportsFloat | ac.Start = ...,
        TON: SupportsFloat | ac.Start = ...,
        TOFF: SupportsFloat | ac.Start = ...,
        Vt: SupportsFloat | ac.Start = ...,
        Nbv: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        g: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Thyristor(ConditionalHeatPort):
    """Thyristor, of which a control voltage ``vControl`` [V], a state, says how far it conducts."""

    VDRM: ClassVar[ac.Parameter]
    """forward breakthrough voltage [V]"""
    VRRM: ClassVar[ac.Parameter]
    """reverse breakthrough voltage [V]"""
    IDRM: ClassVar[ac.Parameter]
    """saturation current, without effect [A]"""
    VTM: ClassVar[ac.Parameter]
    """conducting voltage [V]"""
    IH: ClassVar[ac.Parameter]
    """holding current [A]"""
    ITM: ClassVar[ac.Parameter]
    """conducting current [A]"""
    VGT: ClassVar[ac.Parameter]
    """gate trigger voltage [V]"""
    IGT: ClassVar[ac.Parameter]
    """gate trigger current [A]"""
    TON: ClassVar[ac.Parameter]
    """switch on time [s]"""
    TOFF: ClassVar[ac.Parameter]
    """switch off time [s]"""
    Vt: ClassVar[ac.Parameter]
    """thermal voltage (kT/qn) [V]"""
    Nbv: ClassVar[ac.Parameter]
    """emission coefficient of the reverse breakthrough"""
    Anode: Pin
    Cathode: Pin
    Gate: Pin
    iGK: ClassVar[ac.Variable]
    """gate current [A]"""
    vGK: ClassVar[ac.Variable]
    """voltage from gate to cathode [V]"""
    vAK: ClassVar[ac.Variable]
    """voltage from anode to cathode [V]"""
    vControl: ClassVar[ac.Variable]
    """control voltage [V]"""
    vContot: ClassVar[ac.Variable]
    """voltage that the control voltage follows [V]"""
    vConmain: ClassVar[ac.Variable]
    """its part from the main circuit [V]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        VDRM: SupportsFloat | ac.Start = ...,
        VRRM: SupportsFloat | ac.Start = ...,
        IDRM: SupportsFloat | ac.Start = ...,
        VTM: SupportsFloat | ac.Start = ...,
        IH: SupportsFloat | ac.Start = ...,
        ITM: SupportsFloat | ac.Start = ...,
        VGT: SupportsFloat | ac.Start = ...,
        IGT: SupportsFloat | ac.Start = ...,
        TON: SupportsFloat | ac.Start = ...,
        TOFF: SupportsFloat | ac.Start = ...,
        Vt: SupportsFloat | ac.Start = ...,
        Nbv: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        Anode: Mapping[str, Any] = ...,
        Cathode: Mapping[str, Any] = ...,
        Gate: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        iGK: ac.Start | Mapping[str, Any] = ...,
        vGK: ac.Start | Mapping[str, Any] = ...,
        vAK: ac.Start | Mapping[str, Any] = ...,
        vControl: ac.Start | Mapping[str, Any] = ...,
        vContot: ac.Start | Mapping[str, Any] = ...,
        vConmain: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Transformer(TwoPort):
    """Two coupled inductors: ``v1 = L1 der(i1) + M der(i2)``, ``v2 = M der(i1) + L2 der(i2)``."""

    L1: ClassVar[ac.Parameter]
    """primary inductance [H]"""
    L2: ClassVar[ac.Parameter]
    """secondary inductance [H]"""
    M: ClassVar[ac.Parameter]
    """coupling inductance [H]"""
    dv: ClassVar[ac.Variable]
    """difference of the primary and the secondary voltage [V]"""
    def __init__(
        self,
        *,
        L1: SupportsFloat | ac.Start = ...,
        L2: SupportsFloat | ac.Start = ...,
        M: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
        dv: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TranslationalEMF(OnePort):
    """Linear motor: ``v = k vel``, ``f = -k i`` with ``vel = der(s)``, ``s = flange.s - support.s``."""

    useSupport: ClassVar[ac.Option]
    """whether there is a support flange; else fixed to the ground"""
    k: ClassVar[ac.Parameter]
    """force per current, = voltage per speed [N/A]"""
    flange: _translational.Flange
    support: _translational.Flange
    s: ClassVar[ac.Variable]
    """position of the flange relative to the support [m]"""
    vel: ClassVar[ac.Variable]
    """speed of the flange relative to the support [m/s]"""
    f: ClassVar[ac.Variable]
    """force at the flange [N]"""
    fElectrical: ClassVar[ac.Variable]
    """electrical force, = -f [N]"""
    def __init__(
        self,
        *,
        k: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        vel: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        fElectrical: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class VCC(TwoPort):
    """Voltage-controlled current source: ``i2 = transConductance v1``, ``i1 = 0``."""

    transConductance: ClassVar[ac.Parameter]
    """transconductance [S]"""
    def __init__(
        self,
        *,
        transConductance: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class VCV(TwoPort):
    """Voltage-controlled voltage source: ``v2 = gain v1``, ``i1 = 0``."""

    gain: ClassVar[ac.Parameter]
    """voltage gain"""
    def __init__(
        self,
        *,
        gain: SupportsFloat | ac.Start = ...,
        p1: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        i1: ac.Start | Mapping[str, Any] = ...,
        i2: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class VariableCapacitor(OnePort):
    """Capacitor with the capacitance as a signal ``C`` [F]: ``i = der(Q)``, ``Q = max(C, Cmin) v`` [C]."""

    Cmin: ClassVar[ac.Parameter]
    """lower bound of the capacitance [F]"""
    IC: ClassVar[ac.Parameter]
    """initial voltage, with UIC [V]"""
    UIC: ClassVar[ac.Option]
    """whether the voltage starts at IC"""
    C: ClassVar[ac.Input]
    """capacitance [F]"""
    Q: ClassVar[ac.Variable]
    """charge [C]"""
    def __init__(
        self,
        *,
        Cmin: SupportsFloat | ac.Start = ...,
        IC: SupportsFloat | ac.Start = ...,
        UIC: bool = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        C: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        Q: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class VariableInductor(OnePort):
    """Inductor with the inductance as a signal ``L`` [H]: ``v = der(Psi)``, ``Psi = max(L, Lmin) i`` [Wb]."""

    Lmin: ClassVar[ac.Parameter]
    """lower bound of the inductance [H]"""
    IC: ClassVar[ac.Parameter]
    """initial current, with UIC [A]"""
    UIC: ClassVar[ac.Option]
    """whether the current starts at IC"""
    L: ClassVar[ac.Input]
    """inductance [H]"""
    Psi: ClassVar[ac.Variable]
    """flux linkage [Wb]"""
    def __init__(
        self,
        *,
        Lmin: SupportsFloat | ac.Start = ...,
        IC: SupportsFloat | ac.Start = ...,
        UIC: bool = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        L: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        Psi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Conductor(OnePort, ConditionalHeatPort):
    """Linear conductor: ``i = G_actual v``, ``LossPower = v i``."""

    T: ClassVar[ac.Parameter]
    """temperature without heat port [K]"""
    G: ClassVar[ac.Parameter]
    """conductance at T_ref [S]"""
    T_ref: ClassVar[ac.Parameter]
    """reference temperature [K]"""
    alpha: ClassVar[ac.Parameter]
    """temperature coefficient of the resistance [1/K]"""
    G_actual: ClassVar[ac.Variable]
    """conductance at the actual temperature [S]"""
    def __init__(
        self,
        *,
        G: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        alpha: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        G_actual: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CurrentSource(OnePort):
    """A current that follows a signal: ``i = signalSource.y``, with ``offset`` and ``startTime``."""

    startTime: ClassVar[ac.Parameter]
    """start of the signal [s]"""
    offset: ClassVar[ac.Parameter]
    """offset of the current [A]"""
    def __init__(self, **modifiers: Any) -> None: ...

class Diode2(OnePort, ConditionalHeatPort):
    """Diode with a series resistance and reverse breakdown: ``v = vd + Rs id``, ``i = id + Gp v``."""

    Vf: ClassVar[ac.Parameter]
    """forward voltage [V]"""
    Ids: ClassVar[ac.Parameter]
    """reverse saturation current [A]"""
    Rs: ClassVar[ac.Parameter]
    """series resistance [Ohm]"""
    Vt: ClassVar[ac.Parameter]
    """thermal voltage (kT/q) without heat port [V]"""
    N: ClassVar[ac.Parameter]
    """emission coefficient"""
    Bv: ClassVar[ac.Parameter]
    """reverse breakdown voltage [V]"""
    Gp: ClassVar[ac.Parameter]
    """parallel conductance [S]"""
    vd: ClassVar[ac.Variable]
    """voltage across the diode without resistance [V]"""
    id: ClassVar[ac.Variable]
    """diode current [A]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Vf: SupportsFloat | ac.Start = ...,
        Ids: SupportsFloat | ac.Start = ...,
        Rs: SupportsFloat | ac.Start = ...,
        Vt: SupportsFloat | ac.Start = ...,
        N: SupportsFloat | ac.Start = ...,
        Bv: SupportsFloat | ac.Start = ...,
        Gp: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        vd: ac.Start | Mapping[str, Any] = ...,
        id: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealSemiconductor(OnePort, ConditionalHeatPort):
    """An ideal characteristic with a knee, along which the parameter ``s`` runs; ``LossPower = v i``."""

    Ron: ClassVar[ac.Parameter]
    """resistance while conducting [Ohm]"""
    Goff: ClassVar[ac.Parameter]
    """conductance while blocking [S]"""
    Vknee: ClassVar[ac.Parameter]
    """forward threshold voltage [V]"""
    off: ClassVar[ac.Discrete]
    """1 while blocking, else 0"""
    s: ClassVar[ac.Variable]
    """position on the characteristic; the knee is at 0"""
    def __init__(self, **modifiers: Any) -> None: ...

class IdealSwitch(OnePort, ConditionalHeatPort):
    """A switch: ``i = Goff v`` while open (``off``), ``v = Ron i`` while closed; ``LossPower = v i``."""

    Ron: ClassVar[ac.Parameter]
    """resistance while closed [Ohm]"""
    Goff: ClassVar[ac.Parameter]
    """conductance while open [S]"""
    off: ClassVar[ac.Discrete]
    """1 while open, else 0"""
    def __init__(self, **modifiers: Any) -> None: ...

class IdealSwitchWithArc(OnePort, ConditionalHeatPort):
    """A switch with an arc: it opens (``off``) at ``tSwitch``, but conducts until the arc is ``quenched``."""

    Ron: ClassVar[ac.Parameter]
    """resistance while closed [Ohm]"""
    Goff: ClassVar[ac.Parameter]
    """conductance while open [S]"""
    V0: ClassVar[ac.Parameter]
    """voltage of the arc when it begins [V]"""
    dVdt: ClassVar[ac.Parameter]
    """rate of the arc's voltage [V/s]"""
    Vmax: ClassVar[ac.Parameter]
    """greatest voltage of the arc [V]"""
    off: ClassVar[ac.Discrete]
    """1 while open, quenched or not, else 0"""
    quenched: ClassVar[ac.Discrete]
    """1 while open without an arc, else 0"""
    tSwitch: ClassVar[ac.Discrete]
    """when it opened last [s]"""
    margin: ClassVar[ac.Variable]
    """below zero while the current is too strong to be quenched [A]"""
    def __init__(
        self,
        *,
        V0: SupportsFloat | ac.Start = ...,
        dVdt: SupportsFloat | ac.Start = ...,
        Vmax: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        off: ac.Start | Mapping[str, Any] = ...,
        quenched: ac.Start | Mapping[str, Any] = ...,
        tSwitch: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        margin: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class NMOS(ConditionalHeatPort):
    """N-channel MOS transistor with the pins ``D``, ``G``, ``S`` and ``B``."""

    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port; by default as useTemperatureDependency"""
    useTemperatureDependency: ClassVar[ac.Option]
    """whether the law depends on the temperature"""
    D: Pin
    G: Pin
    S: Pin
    B: Pin
    W: ClassVar[ac.Parameter]
    """width [m]"""
    L: ClassVar[ac.Parameter]
    """length [m]"""
    Beta: ClassVar[ac.Parameter]
    """transconductance parameter [A/V2]"""
    Vt: ClassVar[ac.Parameter]
    """zero bias threshold voltage [V]"""
    K2: ClassVar[ac.Parameter]
    """bulk threshold parameter"""
    K5: ClassVar[ac.Parameter]
    """reduction of the pinch-off region"""
    dW: ClassVar[ac.Parameter]
    """narrowing of the channel [m]"""
    dL: ClassVar[ac.Parameter]
    """shortening of the channel [m]"""
    RDS: ClassVar[ac.Parameter]
    """resistance from drain to source, not zero [Ohm]"""
    Tnom: ClassVar[ac.Parameter]
    """temperature at which parameters were taken [K]"""
    kvt: ClassVar[ac.Parameter]
    """temperature coefficient of Vt [1/K]"""
    kk2: ClassVar[ac.Parameter]
    """temperature coefficient of K2 [1/K]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        W: SupportsFloat | ac.Start = ...,
        L: SupportsFloat | ac.Start = ...,
        Beta: SupportsFloat | ac.Start = ...,
        Vt: SupportsFloat | ac.Start = ...,
        K2: SupportsFloat | ac.Start = ...,
        K5: SupportsFloat | ac.Start = ...,
        dW: SupportsFloat | ac.Start = ...,
        dL: SupportsFloat | ac.Start = ...,
        RDS: SupportsFloat | ac.Start = ...,
        Tnom: SupportsFloat | ac.Start = ...,
        kvt: SupportsFloat | ac.Start = ...,
        kk2: SupportsFloat | ac.Start = ...,
        useHeatPort: Literal[None, False, True] = ...,
        useTemperatureDependency: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        D: Mapping[str, Any] = ...,
        G: Mapping[str, Any] = ...,
        S: Mapping[str, Any] = ...,
        B: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class NPN(ConditionalHeatPort):
    """NPN transistor with the pins ``C``, ``B``, ``E``, and with ``useSubstrate`` ``S``."""

    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port; by default as useTemperatureDependency"""
    useTemperatureDependency: ClassVar[ac.Option]
    """whether the law depends on the temperature"""
    C: Pin
    B: Pin
    E: Pin
    S: Pin
    Bf: ClassVar[ac.Parameter]
    """forward beta"""
    Br: ClassVar[ac.Parameter]
    """reverse beta"""
    Is: ClassVar[ac.Parameter]
    """transport saturation current [A]"""
    Vak: ClassVar[ac.Parameter]
    """inverse Early voltage [1/V]"""
    Tauf: ClassVar[ac.Parameter]
    """ideal forward transit time [s]"""
    Taur: ClassVar[ac.Parameter]
    """ideal reverse transit time [s]"""
    Ccs: ClassVar[ac.Parameter]
    """capacitance from collector to substrate [F]"""
    Cje: ClassVar[ac.Parameter]
    """zero bias depletion capacitance, base to emitter [F]"""
    Cjc: ClassVar[ac.Parameter]
    """zero bias depletion capacitance, base to collector [F]"""
    Phie: ClassVar[ac.Parameter]
    """diffusion voltage, base to emitter [V]"""
    Me: ClassVar[ac.Parameter]
    """gradation exponent, base to emitter"""
    Phic: ClassVar[ac.Parameter]
    """diffusion voltage, base to collector [V]"""
    Mc: ClassVar[ac.Parameter]
    """gradation exponent, base to collector"""
    Gbc: ClassVar[ac.Parameter]
    """conductance from base to collector [S]"""
    Gbe: ClassVar[ac.Parameter]
    """conductance from base to emitter [S]"""
    EMin: ClassVar[ac.Parameter]
    """exponent below which the exponential is linear"""
    EMax: ClassVar[ac.Parameter]
    """exponent above which the exponential is linear"""
    Vt: ClassVar[ac.Parameter]
    """thermal voltage without temperature dependency [V]"""
    Tnom: ClassVar[ac.Parameter]
    """temperature at which parameters were taken [K]"""
    XTI: ClassVar[ac.Parameter]
    """temperature exponent of Is"""
    XTB: ClassVar[ac.Parameter]
    """temperature exponent of the betas"""
    EG: ClassVar[ac.Parameter]
    """energy gap for the temperature dependency of Is [V]"""
    NF: ClassVar[ac.Parameter]
    """forward current emission coefficient"""
    NR: ClassVar[ac.Parameter]
    """reverse current emission coefficient"""
    IC: ClassVar[ac.Parameter]
    """initial voltage from collector to substrate, with UIC [V]"""
    UIC: ClassVar[ac.Option]
    """whether vcs starts at IC"""
    useSubstrate: ClassVar[ac.Option]
    """whether there is a pin for the substrate; else grounded"""
    vcs: ClassVar[ac.Variable]
    """voltage from collector to substrate [V]"""
    qbk: ClassVar[ac.Variable]
    """relative majority carrier charge, inverse"""
    Capcje: ClassVar[ac.Variable]
    """depletion capacitance, base to emitter [F]"""
    Capcjc: ClassVar[ac.Variable]
    """depletion capacitance, base to collector [F]"""
    is_t: ClassVar[ac.Variable]
    """saturation current at the actual temperature [A]"""
    br_t: ClassVar[ac.Variable]
    """reverse beta at the actual temperature"""
    bf_t: ClassVar[ac.Variable]
    """forward beta at the actual temperature"""
    vt_t: ClassVar[ac.Variable]
    """thermal voltage [V]"""
    hexp: ClassVar[ac.Variable]
    """exponent of the temperature dependency"""
    htempexp: ClassVar[ac.Variable]
    """its exponential"""
    vS: ClassVar[ac.Variable]
    """potential of the substrate [V]"""
    iS: ClassVar[ac.Variable]
    """current into the substrate [A]"""
    vbc: ClassVar[ac.Variable]
    """voltage from base to collector [V]"""
    vbe: ClassVar[ac.Variable]
    """voltage from base to emitter [V]"""
    ibc: ClassVar[ac.Variable]
    """diode current from base to collector [A]"""
    ibe: ClassVar[ac.Variable]
    """diode current from base to emitter [A]"""
    cbc: ClassVar[ac.Variable]
    """capacitance from base to collector [F]"""
    cbe: ClassVar[ac.Variable]
    """capacitance from base to emitter [F]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Bf: SupportsFloat | ac.Start = ...,
        Br: SupportsFloat | ac.Start = ...,
        Is: SupportsFloat | ac.Start = ...,
        Vak: SupportsFloat | ac.Start = ...,
        Tauf: SupportsFloat | ac.Start = ...,
        Taur: SupportsFloat | ac.Start = ...,
        Ccs: SupportsFloat | ac.Start = ...,
        Cje: SupportsFloat | ac.Start = ...,
        Cjc: SupportsFloat | ac.Start = ...,
        Phie: SupportsFloat | ac.Start = ...,
        Me: SupportsFloat | ac.Start = ...,
        Phic: SupportsFloat | ac.Start = ...,
        Mc: SupportsFloat | ac.Start = ...,
        Gbc: SupportsFloat | ac.Start = ...,
        Gbe: SupportsFloat | ac.Start = ...,
        EMin: SupportsFloat | ac.Start = ...,
        EMax: SupportsFloat | ac.Start = ...,
        Vt: SupportsFloat | ac.Start = ...,
        Tnom: SupportsFloat | ac.Start = ...,
        XTI: SupportsFloat | ac.Start = ...,
        XTB: SupportsFloat | ac.Start = ...,
        EG: SupportsFloat | ac.Start = ...,
        NF: SupportsFloat | ac.Start = ...,
        NR: SupportsFloat | ac.Start = ...,
        IC: SupportsFloat | ac.Start = ...,
        useHeatPort: Literal[None, False, True] = ...,
        useTemperatureDependency: bool = ...,
        UIC: bool = ...,
        useSubstrate: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        C: Mapping[str, Any] = ...,
        B: Mapping[str, Any] = ...,
        E: Mapping[str, Any] = ...,
        S: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        vcs: ac.Start | Mapping[str, Any] = ...,
        qbk: ac.Start | Mapping[str, Any] = ...,
        Capcje: ac.Start | Mapping[str, Any] = ...,
        Capcjc: ac.Start | Mapping[str, Any] = ...,
        is_t: ac.Start | Mapping[str, Any] = ...,
        br_t: ac.Start | Mapping[str, Any] = ...,
        bf_t: ac.Start | Mapping[str, Any] = ...,
        vt_t: ac.Start | Mapping[str, Any] = ...,
        hexp: ac.Start | Mapping[str, Any] = ...,
        htempexp: ac.Start | Mapping[str, Any] = ...,
        vS: ac.Start | Mapping[str, Any] = ...,
        iS: ac.Start | Mapping[str, Any] = ...,
        vbc: ac.Start | Mapping[str, Any] = ...,
        vbe: ac.Start | Mapping[str, Any] = ...,
        ibc: ac.Start | Mapping[str, Any] = ...,
        ibe: ac.Start | Mapping[str, Any] = ...,
        cbc: ac.Start | Mapping[str, Any] = ...,
        cbe: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PMOS(ConditionalHeatPort):
    """P-channel MOS transistor: `NMOS` with all voltages, currents and ``Vt`` negated."""

    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port; by default as useTemperatureDependency"""
    useTemperatureDependency: ClassVar[ac.Option]
    """whether the law depends on the temperature"""
    D: Pin
    G: Pin
    S: Pin
    B: Pin
    W: ClassVar[ac.Parameter]
    """width [m]"""
    L: ClassVar[ac.Parameter]
    """length [m]"""
    Beta: ClassVar[ac.Parameter]
    """transconductance parameter [A/V2]"""
    Vt: ClassVar[ac.Parameter]
    """zero bias threshold voltage [V]"""
    K2: ClassVar[ac.Parameter]
    """bulk threshold parameter"""
    K5: ClassVar[ac.Parameter]
    """reduction of the pinch-off region"""
    dW: ClassVar[ac.Parameter]
    """narrowing of the channel [m]"""
    dL: ClassVar[ac.Parameter]
    """shortening of the channel [m]"""
    RDS: ClassVar[ac.Parameter]
    """resistance from drain to source, not zero [Ohm]"""
    Tnom: ClassVar[ac.Parameter]
    """temperature at which parameters were taken [K]"""
    kvt: ClassVar[ac.Parameter]
    """temperature coefficient of Vt [1/K]"""
    kk2: ClassVar[ac.Parameter]
    """temperature coefficient of K2 [1/K]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        W: SupportsFloat | ac.Start = ...,
        L: SupportsFloat | ac.Start = ...,
        Beta: SupportsFloat | ac.Start = ...,
        Vt: SupportsFloat | ac.Start = ...,
        K2: SupportsFloat | ac.Start = ...,
        K5: SupportsFloat | ac.Start = ...,
        dW: SupportsFloat | ac.Start = ...,
        dL: SupportsFloat | ac.Start = ...,
        RDS: SupportsFloat | ac.Start = ...,
        Tnom: SupportsFloat | ac.Start = ...,
        kvt: SupportsFloat | ac.Start = ...,
        kk2: SupportsFloat | ac.Start = ...,
        useHeatPort: Literal[None, False, True] = ...,
        useTemperatureDependency: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        D: Mapping[str, Any] = ...,
        G: Mapping[str, Any] = ...,
        S: Mapping[str, Any] = ...,
        B: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PNP(ConditionalHeatPort):
    """PNP transistor: `NPN` with voltages and currents at the junctions and pins negated."""

    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port; by default as useTemperatureDependency"""
    useTemperatureDependency: ClassVar[ac.Option]
    """whether the law depends on the temperature"""
    C: Pin
    B: Pin
    E: Pin
    S: Pin
    Bf: ClassVar[ac.Parameter]
    """forward beta"""
    Br: ClassVar[ac.Parameter]
    """reverse beta"""
    Is: ClassVar[ac.Parameter]
    """transport saturation current [A]"""
    Vak: ClassVar[ac.Parameter]
    """inverse Early voltage [1/V]"""
    Tauf: ClassVar[ac.Parameter]
    """ideal forward transit time [s]"""
    Taur: ClassVar[ac.Parameter]
    """ideal reverse transit time [s]"""
    Ccs: ClassVar[ac.Parameter]
    """capacitance from collector to substrate [F]"""
    Cje: ClassVar[ac.Parameter]
    """zero bias depletion capacitance, base to emitter [F]"""
    Cjc: ClassVar[ac.Parameter]
    """zero bias depletion capacitance, base to collector [F]"""
    Phie: ClassVar[ac.Parameter]
    """diffusion voltage, base to emitter [V]"""
    Me: ClassVar[ac.Parameter]
    """gradation exponent, base to emitter"""
    Phic: ClassVar[ac.Parameter]
    """diffusion voltage, base to collector [V]"""
    Mc: ClassVar[ac.Parameter]
    """gradation exponent, base to collector"""
    Gbc: ClassVar[ac.Parameter]
    """conductance from base to collector [S]"""
    Gbe: ClassVar[ac.Parameter]
    """conductance from base to emitter [S]"""
    EMin: ClassVar[ac.Parameter]
    """exponent below which the exponential is linear"""
    EMax: ClassVar[ac.Parameter]
    """exponent above which the exponential is linear"""
    Vt: ClassVar[ac.Parameter]
    """thermal voltage without temperature dependency [V]"""
    Tnom: ClassVar[ac.Parameter]
    """temperature at which parameters were taken [K]"""
    XTI: ClassVar[ac.Parameter]
    """temperature exponent of Is"""
    XTB: ClassVar[ac.Parameter]
    """temperature exponent of the betas"""
    EG: ClassVar[ac.Parameter]
    """energy gap for the temperature dependency of Is [V]"""
    NF: ClassVar[ac.Parameter]
    """forward current emission coefficient"""
    NR: ClassVar[ac.Parameter]
    """reverse current emission coefficient"""
    IC: ClassVar[ac.Parameter]
    """initial voltage from collector to substrate, with UIC [V]"""
    UIC: ClassVar[ac.Option]
    """whether vcs starts at IC"""
    useSubstrate: ClassVar[ac.Option]
    """whether there is a pin for the substrate; else grounded"""
    vcs: ClassVar[ac.Variable]
    """voltage from collector to substrate [V]"""
    qbk: ClassVar[ac.Variable]
    """relative majority carrier charge, inverse"""
    Capcje: ClassVar[ac.Variable]
    """depletion capacitance, base to emitter [F]"""
    Capcjc: ClassVar[ac.Variable]
    """depletion capacitance, base to collector [F]"""
    is_t: ClassVar[ac.Variable]
    """saturation current at the actual temperature [A]"""
    br_t: ClassVar[ac.Variable]
    """reverse beta at the actual temperature"""
    bf_t: ClassVar[ac.Variable]
    """forward beta at the actual temperature"""
    vt_t: ClassVar[ac.Variable]
    """thermal voltage [V]"""
    hexp: ClassVar[ac.Variable]
    """exponent of the temperature dependency"""
    htempexp: ClassVar[ac.Variable]
    """its exponential"""
    vS: ClassVar[ac.Variable]
    """potential of the substrate [V]"""
    iS: ClassVar[ac.Variable]
    """current into the substrate [A]"""
    vcb: ClassVar[ac.Variable]
    """voltage from collector to base [V]"""
    veb: ClassVar[ac.Variable]
    """voltage from emitter to base [V]"""
    icb: ClassVar[ac.Variable]
    """diode current from collector to base [A]"""
    ieb: ClassVar[ac.Variable]
    """diode current from emitter to base [A]"""
    ccb: ClassVar[ac.Variable]
    """capacitance from collector to base [F]"""
    ceb: ClassVar[ac.Variable]
    """capacitance from emitter to base [F]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Bf: SupportsFloat | ac.Start = ...,
        Br: SupportsFloat | ac.Start = ...,
        Is: SupportsFloat | ac.Start = ...,
        Vak: SupportsFloat | ac.Start = ...,
        Tauf: SupportsFloat | ac.Start = ...,
        Taur: SupportsFloat | ac.Start = ...,
        Ccs: SupportsFloat | ac.Start = ...,
        Cje: SupportsFloat | ac.Start = ...,
        Cjc: SupportsFloat | ac.Start = ...,
        Phie: SupportsFloat | ac.Start = ...,
        Me: SupportsFloat | ac.Start = ...,
        Phic: SupportsFloat | ac.Start = ...,
        Mc: SupportsFloat | ac.Start = ...,
        Gbc: SupportsFloat | ac.Start = ...,
        Gbe: SupportsFloat | ac.Start = ...,
        EMin: SupportsFloat | ac.Start = ...,
        EMax: SupportsFloat | ac.Start = ...,
        Vt: SupportsFloat | ac.Start = ...,
        Tnom: SupportsFloat | ac.Start = ...,
        XTI: SupportsFloat | ac.Start = ...,
        XTB: SupportsFloat | ac.Start = ...,
        EG: SupportsFloat | ac.Start = ...,
        NF: SupportsFloat | ac.Start = ...,
        NR: SupportsFloat | ac.Start = ...,
        IC: SupportsFloat | ac.Start = ...,
        useHeatPort: Literal[None, False, True] = ...,
        useTemperatureDependency: bool = ...,
        UIC: bool = ...,
        useSubstrate: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        C: Mapping[str, Any] = ...,
        B: Mapping[str, Any] = ...,
        E: Mapping[str, Any] = ...,
        S: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        vcs: ac.Start | Mapping[str, Any] = ...,
        qbk: ac.Start | Mapping[str, Any] = ...,
        Capcje: ac.Start | Mapping[str, Any] = ...,
        Capcjc: ac.Start | Mapping[str, Any] = ...,
        is_t: ac.Start | Mapping[str, Any] = ...,
        br_t: ac.Start | Mapping[str, Any] = ...,
        bf_t: ac.Start | Mapping[str, Any] = ...,
        vt_t: ac.Start | Mapping[str, Any] = ...,
        hexp: ac.Start | Mapping[str, Any] = ...,
        htempexp: ac.Start | Mapping[str, Any] = ...,
        vS: ac.Start | Mapping[str, Any] = ...,
        iS: ac.Start | Mapping[str, Any] = ...,
        vcb: ac.Start | Mapping[str, Any] = ...,
        veb: ac.Start | Mapping[str, Any] = ...,
        icb: ac.Start | Mapping[str, Any] = ...,
        ieb: ac.Start | Mapping[str, Any] = ...,
        ccb: ac.Start | Mapping[str, Any] = ...,
        ceb: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Resistor(OnePort, ConditionalHeatPort):
    """Linear resistor: ``v = R_actual i``, ``LossPower = v i``."""

    T: ClassVar[ac.Parameter]
    """temperature without heat port [K]"""
    R: ClassVar[ac.Parameter]
    """resistance at T_ref [Ohm]"""
    T_ref: ClassVar[ac.Parameter]
    """reference temperature [K]"""
    alpha: ClassVar[ac.Parameter]
    """temperature coefficient of the resistance [1/K]"""
    R_actual: ClassVar[ac.Variable]
    """resistance at the actual temperature [Ohm]"""
    def __init__(
        self,
        *,
        R: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        alpha: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        R_actual: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class VariableConductor(OnePort, ConditionalHeatPort):
    """Conductor with the conductance as a signal ``G`` [S]: ``i = G_actual v``, ``LossPower = v i``."""

    T: ClassVar[ac.Parameter]
    """temperature without heat port [K]"""
    T_ref: ClassVar[ac.Parameter]
    """reference temperature [K]"""
    alpha: ClassVar[ac.Parameter]
    """temperature coefficient of the resistance [1/K]"""
    G: ClassVar[ac.Input]
    """conductance at T_ref [S]"""
    G_actual: ClassVar[ac.Variable]
    """conductance at the actual temperature [S]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        alpha: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        G: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        G_actual: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class VariableResistor(OnePort, ConditionalHeatPort):
    """Resistor with the resistance as a signal ``R`` [Ohm]: ``v = R_actual i``, ``LossPower = v i``."""

    T: ClassVar[ac.Parameter]
    """temperature without heat port [K]"""
    T_ref: ClassVar[ac.Parameter]
    """reference temperature [K]"""
    alpha: ClassVar[ac.Parameter]
    """temperature coefficient of the resistance [1/K]"""
    R: ClassVar[ac.Input]
    """resistance at T_ref [Ohm]"""
    R_actual: ClassVar[ac.Variable]
    """resistance at the actual temperature [Ohm]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        alpha: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        R: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        R_actual: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class VoltageSource(OnePort):
    """A voltage that follows a signal: ``v = signalSource.y``, with ``offset`` and ``startTime``."""

    startTime: ClassVar[ac.Parameter]
    """start of the signal [s]"""
    offset: ClassVar[ac.Parameter]
    """offset of the voltage [V]"""
    def __init__(self, **modifiers: Any) -> None: ...

class ZDiode(OnePort, ConditionalHeatPort):
    """Zener diode: ``i = Ids (exp(v/Vt) - 1) - Ibv exp(-(v + Bv)/(Nbv Vt)) + v/R``."""

    Ids: ClassVar[ac.Parameter]
    """saturation current [A]"""
    Vt: ClassVar[ac.Parameter]
    """thermal voltage (kT/qn) [V]"""
    Maxexp: ClassVar[ac.Parameter]
    """exponent from which the characteristic is linear"""
    R: ClassVar[ac.Parameter]
    """parallel resistance [Ohm]"""
    Bv: ClassVar[ac.Parameter]
    """breakthrough voltage [V]"""
    Ibv: ClassVar[ac.Parameter]
    """knee current of the breakthrough [A]"""
    Nbv: ClassVar[ac.Parameter]
    """emission coefficient of the breakthrough"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Ids: SupportsFloat | ac.Start = ...,
        Vt: SupportsFloat | ac.Start = ...,
        Maxexp: SupportsFloat | ac.Start = ...,
        R: SupportsFloat | ac.Start = ...,
        Bv: SupportsFloat | ac.Start = ...,
        Ibv: SupportsFloat | ac.Start = ...,
        Nbv: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CloserWithArc(IdealSwitchWithArc):
    """A contact with an arc that the signal ``control`` closes: closed where ``control > 0.5``."""

    control: ClassVar[ac.Input]
    """closed above 0.5 (Modelica: true)"""
    def __init__(
        self,
        *,
        V0: SupportsFloat | ac.Start = ...,
        dVdt: SupportsFloat | ac.Start = ...,
        Vmax: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        control: ac.Start | Mapping[str, Any] = ...,
        off: ac.Start | Mapping[str, Any] = ...,
        quenched: ac.Start | Mapping[str, Any] = ...,
        tSwitch: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        margin: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CosineCurrentVariableFrequencyAndAmplitude(OnePort):
    """``i = offset + I cos(phi)``, ``der(phi) = 2 pi f``, with inputs ``I`` [A] and ``f`` [Hz]."""

    useConstantAmplitude: ClassVar[ac.Option]
    """whether the amplitude is constantAmplitude"""
    useConstantFrequency: ClassVar[ac.Option]
    """whether the frequency is constantFrequency"""
    constantFrequency: ClassVar[ac.Parameter]
    """frequency without input [Hz]"""
    f: ClassVar[ac.Input]
    """frequency [Hz]"""
    phi: ClassVar[ac.Variable]
    """phase [rad]"""
    constantAmplitude: ClassVar[ac.Parameter]
    """amplitude without input [A]"""
    offset: ClassVar[ac.Parameter]
    """offset of the current [A]"""
    I: ClassVar[ac.Input]
    """amplitude [A]"""
    def __init__(
        self,
        *,
        constantFrequency: SupportsFloat | ac.Start = ...,
        constantAmplitude: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        useConstantAmplitude: bool = ...,
        useConstantFrequency: bool = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        I: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CosineVoltageVariableFrequencyAndAmplitude(OnePort):
    """``v = offset + V cos(phi)``, ``der(phi) = 2 pi f``, with inputs ``V`` [V] and ``f`` [Hz]."""

    useConstantAmplitude: ClassVar[ac.Option]
    """whether the amplitude is constantAmplitude"""
    useConstantFrequency: ClassVar[ac.Option]
    """whether the frequency is constantFrequency"""
    constantFrequency: ClassVar[ac.Parameter]
    """frequency without input [Hz]"""
    f: ClassVar[ac.Input]
    """frequency [Hz]"""
    phi: ClassVar[ac.Variable]
    """phase [rad]"""
    constantAmplitude: ClassVar[ac.Parameter]
    """amplitude without input [V]"""
    offset: ClassVar[ac.Parameter]
    """offset of the voltage [V]"""
    V: ClassVar[ac.Input]
    """amplitude [V]"""
    def __init__(
        self,
        *,
        constantFrequency: SupportsFloat | ac.Start = ...,
        constantAmplitude: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        useConstantAmplitude: bool = ...,
        useConstantFrequency: bool = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        V: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Diode(OnePort, ConditionalHeatPort):
    """Diode: ``i = id + v/R``, ``id = Ids (exp(v/Vt) - 1)``, linear beyond ``v/Vt = Maxexp``."""

    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port; by default as useTemperatureDependency"""
    useTemperatureDependency: ClassVar[ac.Option]
    """whether the law depends on the temperature"""
    Ids: ClassVar[ac.Parameter]
    """saturation current [A]"""
    Vt: ClassVar[ac.Parameter]
    """thermal voltage (kT/qn) without temperature dependency [V]"""
    Maxexp: ClassVar[ac.Parameter]
    """exponent from which the characteristic is linear"""
    R: ClassVar[ac.Parameter]
    """parallel resistance [Ohm]"""
    EG: ClassVar[ac.Parameter]
    """activation energy [V]"""
    N: ClassVar[ac.Parameter]
    """emission coefficient"""
    TNOM: ClassVar[ac.Parameter]
    """temperature at which parameters were taken [K]"""
    XTI: ClassVar[ac.Parameter]
    """temperature exponent of the saturation current"""
    vt_t: ClassVar[ac.Variable]
    """thermal voltage [V]"""
    id: ClassVar[ac.Variable]
    """diode current [A]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Ids: SupportsFloat | ac.Start = ...,
        Vt: SupportsFloat | ac.Start = ...,
        Maxexp: SupportsFloat | ac.Start = ...,
        R: SupportsFloat | ac.Start = ...,
        EG: SupportsFloat | ac.Start = ...,
        N: SupportsFloat | ac.Start = ...,
        TNOM: SupportsFloat | ac.Start = ...,
        XTI: SupportsFloat | ac.Start = ...,
        useHeatPort: Literal[None, False, True] = ...,
        useTemperatureDependency: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        vt_t: ac.Start | Mapping[str, Any] = ...,
        id: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealClosingSwitch(IdealSwitch):
    """A contact that the signal ``control`` closes: closed where ``control > 0.5``."""

    control: ClassVar[ac.Input]
    """closed above 0.5 (Modelica: true)"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        control: ac.Start | Mapping[str, Any] = ...,
        off: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealDiode(IdealSemiconductor):
    """Ideal diode: it blocks where ``s < 0``, that is below ``Vknee``. See `IdealSemiconductor`."""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        Vknee: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        off: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealGTOThyristor(IdealSemiconductor):
    """Ideal switching transistor: it conducts above ``Vknee`` while the signal ``fire > 0.5``."""

    fire: ClassVar[ac.Input]
    """may conduct above 0.5 (Modelica: true)"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        Vknee: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        fire: ac.Start | Mapping[str, Any] = ...,
        off: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealIntermediateSwitch(ConditionalHeatPort):
    """Where the signal ``control > 0.5``, ``p1`` - ``n2`` and ``p2`` - ``n1`` are connected."""

    Ron: ClassVar[ac.Parameter]
    """resistance while closed [Ohm]"""
    Goff: ClassVar[ac.Parameter]
    """conductance while open [S]"""
    p1: Pin
    p2: Pin
    n1: Pin
    n2: Pin
    i11: ClassVar[ac.Variable]
    """current from p1 to n1 [A]"""
    i22: ClassVar[ac.Variable]
    """current from p2 to n2 [A]"""
    i12: ClassVar[ac.Variable]
    """current from p1 to n2 [A]"""
    i21: ClassVar[ac.Variable]
    """current from p2 to n1 [A]"""
    control: ClassVar[ac.Input]
    """second position above 0.5 (Modelica: true)"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        control: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        i11: ac.Start | Mapping[str, Any] = ...,
        i22: ac.Start | Mapping[str, Any] = ...,
        i12: ac.Start | Mapping[str, Any] = ...,
        i21: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealOpeningSwitch(IdealSwitch):
    """A contact that the signal ``control`` opens: open where ``control > 0.5``."""

    control: ClassVar[ac.Input]
    """open above 0.5 (Modelica: true)"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        control: ac.Start | Mapping[str, Any] = ...,
        off: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealThyristor(IdealSemiconductor):
    """Ideal thyristor: fired by the signal ``fire > 0.5`` above ``Vknee``, it conducts until ``s < 0``."""

    fire: ClassVar[ac.Input]
    """fires above 0.5 (Modelica: true)"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        Vknee: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        fire: ac.Start | Mapping[str, Any] = ...,
        off: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealTwoWaySwitch(ConditionalHeatPort):
    """``p`` is connected with ``n2`` where the signal ``control > 0.5``, else with ``n1``."""

    Ron: ClassVar[ac.Parameter]
    """resistance while closed [Ohm]"""
    Goff: ClassVar[ac.Parameter]
    """conductance while open [S]"""
    p: Pin
    n2: Pin
    n1: Pin
    control: ClassVar[ac.Input]
    """second position above 0.5 (Modelica: true)"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        control: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class OpenerWithArc(IdealSwitchWithArc):
    """A contact with an arc that the signal ``control`` opens: open where ``control > 0.5``."""

    control: ClassVar[ac.Input]
    """open above 0.5 (Modelica: true)"""
    def __init__(
        self,
        *,
        V0: SupportsFloat | ac.Start = ...,
        dVdt: SupportsFloat | ac.Start = ...,
        Vmax: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        control: ac.Start | Mapping[str, Any] = ...,
        off: ac.Start | Mapping[str, Any] = ...,
        quenched: ac.Start | Mapping[str, Any] = ...,
        tSwitch: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        margin: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SineCurrentVariableFrequencyAndAmplitude(OnePort):
    """``i = offset + I sin(phi)``, ``der(phi) = 2 pi f``, with inputs ``I`` [A] and ``f`` [Hz]."""

    useConstantAmplitude: ClassVar[ac.Option]
    """whether the amplitude is constantAmplitude"""
    useConstantFrequency: ClassVar[ac.Option]
    """whether the frequency is constantFrequency"""
    constantFrequency: ClassVar[ac.Parameter]
    """frequency without input [Hz]"""
    f: ClassVar[ac.Input]
    """frequency [Hz]"""
    phi: ClassVar[ac.Variable]
    """phase [rad]"""
    constantAmplitude: ClassVar[ac.Parameter]
    """amplitude without input [A]"""
    offset: ClassVar[ac.Parameter]
    """offset of the current [A]"""
    I: ClassVar[ac.Input]
    """amplitude [A]"""
    def __init__(
        self,
        *,
        constantFrequency: SupportsFloat | ac.Start = ...,
        constantAmplitude: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        useConstantAmplitude: bool = ...,
        useConstantFrequency: bool = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        I: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SineVoltageVariableFrequencyAndAmplitude(OnePort):
    """``v = offset + V sin(phi)``, ``der(phi) = 2 pi f``, with inputs ``V`` [V] and ``f`` [Hz]."""

    useConstantAmplitude: ClassVar[ac.Option]
    """whether the amplitude is constantAmplitude"""
    useConstantFrequency: ClassVar[ac.Option]
    """whether the frequency is constantFrequency"""
    constantFrequency: ClassVar[ac.Parameter]
    """frequency without input [Hz]"""
    f: ClassVar[ac.Input]
    """frequency [Hz]"""
    phi: ClassVar[ac.Variable]
    """phase [rad]"""
    constantAmplitude: ClassVar[ac.Parameter]
    """amplitude without input [V]"""
    offset: ClassVar[ac.Parameter]
    """offset of the voltage [V]"""
    V: ClassVar[ac.Input]
    """amplitude [V]"""
    def __init__(
        self,
        *,
        constantFrequency: SupportsFloat | ac.Start = ...,
        constantAmplitude: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        useConstantAmplitude: bool = ...,
        useConstantFrequency: bool = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        V: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ControlledCloserWithArc(IdealSwitchWithArc):
    """A contact with an arc that is closed where ``control.v >= level``."""

    level: ClassVar[ac.Parameter]
    """potential of control at which the switch acts [V]"""
    control: Pin
    def __init__(
        self,
        *,
        V0: SupportsFloat | ac.Start = ...,
        dVdt: SupportsFloat | ac.Start = ...,
        Vmax: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        level: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        control: Mapping[str, Any] = ...,
        off: ac.Start | Mapping[str, Any] = ...,
        quenched: ac.Start | Mapping[str, Any] = ...,
        tSwitch: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        margin: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ControlledIdealClosingSwitch(IdealSwitch):
    """A contact that is closed where ``control.v > level``."""

    level: ClassVar[ac.Parameter]
    """potential of control at which the switch acts [V]"""
    control: Pin
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        level: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        control: Mapping[str, Any] = ...,
        off: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ControlledIdealIntermediateSwitch(ConditionalHeatPort):
    """Where ``control.v > level``, ``p1`` - ``n2`` and ``p2`` - ``n1`` are connected."""

    Ron: ClassVar[ac.Parameter]
    """resistance while closed [Ohm]"""
    Goff: ClassVar[ac.Parameter]
    """conductance while open [S]"""
    p1: Pin
    p2: Pin
    n1: Pin
    n2: Pin
    i11: ClassVar[ac.Variable]
    """current from p1 to n1 [A]"""
    i22: ClassVar[ac.Variable]
    """current from p2 to n2 [A]"""
    i12: ClassVar[ac.Variable]
    """current from p1 to n2 [A]"""
    i21: ClassVar[ac.Variable]
    """current from p2 to n1 [A]"""
    level: ClassVar[ac.Parameter]
    """potential of control at which the switch acts [V]"""
    control: Pin
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        level: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p1: Mapping[str, Any] = ...,
        p2: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        control: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        i11: ac.Start | Mapping[str, Any] = ...,
        i22: ac.Start | Mapping[str, Any] = ...,
        i12: ac.Start | Mapping[str, Any] = ...,
        i21: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ControlledIdealOpeningSwitch(IdealSwitch):
    """A contact that is open where ``control.v > level``."""

    level: ClassVar[ac.Parameter]
    """potential of control at which the switch acts [V]"""
    control: Pin
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        level: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        control: Mapping[str, Any] = ...,
        off: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ControlledIdealTwoWaySwitch(ConditionalHeatPort):
    """``p`` is connected with ``n2`` where ``control.v > level``, else with ``n1``."""

    Ron: ClassVar[ac.Parameter]
    """resistance while closed [Ohm]"""
    Goff: ClassVar[ac.Parameter]
    """conductance while open [S]"""
    p: Pin
    n2: Pin
    n1: Pin
    level: ClassVar[ac.Parameter]
    """potential of control at which the switch acts [V]"""
    control: Pin
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        level: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n2: Mapping[str, Any] = ...,
        n1: Mapping[str, Any] = ...,
        control: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ControlledOpenerWithArc(IdealSwitchWithArc):
    """A contact with an arc that is open where ``control.v > level``."""

    level: ClassVar[ac.Parameter]
    """potential of control at which the switch acts [V]"""
    control: Pin
    def __init__(
        self,
        *,
        V0: SupportsFloat | ac.Start = ...,
        dVdt: SupportsFloat | ac.Start = ...,
        Vmax: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        Ron: SupportsFloat | ac.Start = ...,
        Goff: SupportsFloat | ac.Start = ...,
        level: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        control: Mapping[str, Any] = ...,
        off: ac.Start | Mapping[str, Any] = ...,
        quenched: ac.Start | Mapping[str, Any] = ...,
        tSwitch: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        margin: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ExponentialsCurrent(CurrentSource):
    """Rises towards ``iMax`` for ``riseTime`` [s], then falls, both exponentially."""

    riseTime: ClassVar[ac.Parameter]
    """rise time [s]"""
    riseTimeConst: ClassVar[ac.Parameter]
    """time constant of the rise [s]"""
    fallTimeConst: ClassVar[ac.Parameter]
    """time constant of the fall [s]"""
    iMax: ClassVar[ac.Parameter]
    """current after an infinite rise [A]"""
    signalSource: _blocks.Exponentials
    def __init__(
        self,
        *,
        riseTime: SupportsFloat | ac.Start = ...,
        riseTimeConst: SupportsFloat | ac.Start = ...,
        fallTimeConst: SupportsFloat | ac.Start = ...,
        iMax: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class ExponentialsVoltage(VoltageSource):
    """Rises towards ``vMax`` for ``riseTime`` [s], then falls, both exponentially."""

    riseTime: ClassVar[ac.Parameter]
    """rise time [s]"""
    riseTimeConst: ClassVar[ac.Parameter]
    """time constant of the rise [s]"""
    fallTimeConst: ClassVar[ac.Parameter]
    """time constant of the fall [s]"""
    vMax: ClassVar[ac.Parameter]
    """voltage after an infinite rise [V]"""
    signalSource: _blocks.Exponentials
    def __init__(
        self,
        *,
        riseTime: SupportsFloat | ac.Start = ...,
        riseTimeConst: SupportsFloat | ac.Start = ...,
        fallTimeConst: SupportsFloat | ac.Start = ...,
        vMax: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class TableCurrent(CurrentSource):
    """``i`` by linear interpolation in the rows of ``table``: time [s], current [A]."""

    table: ClassVar[ac.Option]
    """rows of time [s] and value"""
    signalSource: _blocks.TimeTable
    def __init__(
        self,
        *,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        table: Any = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class TableVoltage(VoltageSource):
    """``v`` by linear interpolation in the rows of ``table``: time [s], voltage [V]."""

    table: ClassVar[ac.Option]
    """rows of time [s] and value"""
    signalSource: _blocks.TimeTable
    def __init__(
        self,
        *,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        table: Any = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class CosineCurrent(CurrentSource):
    """``i = offset + I cos(2 pi f t + phase)`` for ``t = time - startTime >= 0``, else ``offset``."""

    I: ClassVar[ac.Parameter]
    """amplitude [A]"""
    phase: ClassVar[ac.Parameter]
    """phase at startTime [rad]"""
    f: ClassVar[ac.Parameter]
    """frequency [Hz]"""
    signalSource: _blocks.Cosine
    def __init__(
        self,
        *,
        I: SupportsFloat | ac.Start = ...,
        f: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        phase: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class CosineVoltage(VoltageSource):
    """``v = offset + V cos(2 pi f t + phase)`` for ``t = time - startTime >= 0``, else ``offset``."""

    V: ClassVar[ac.Parameter]
    """amplitude [V]"""
    phase: ClassVar[ac.Parameter]
    """phase at startTime [rad]"""
    f: ClassVar[ac.Parameter]
    """frequency [Hz]"""
    signalSource: _blocks.Cosine
    def __init__(
        self,
        *,
        V: SupportsFloat | ac.Start = ...,
        f: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        phase: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class ExpSineCurrent(CurrentSource):
    """``i = offset + I exp(-damping t) sin(2 pi f t + phase)``, ``t = time - startTime``."""

    I: ClassVar[ac.Parameter]
    """amplitude [A]"""
    f: ClassVar[ac.Parameter]
    """frequency [Hz]"""
    phase: ClassVar[ac.Parameter]
    """phase at startTime [rad]"""
    damping: ClassVar[ac.Parameter]
    """decay of the amplitude [1/s]"""
    signalSource: _blocks.ExpSine
    def __init__(
        self,
        *,
        I: SupportsFloat | ac.Start = ...,
        f: SupportsFloat | ac.Start = ...,
        damping: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        phase: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class ExpSineVoltage(VoltageSource):
    """``v = offset + V exp(-damping t) sin(2 pi f t + phase)``, ``t = time - startTime``."""

    V: ClassVar[ac.Parameter]
    """amplitude [V]"""
    f: ClassVar[ac.Parameter]
    """frequency [Hz]"""
    phase: ClassVar[ac.Parameter]
    """phase at startTime [rad]"""
    damping: ClassVar[ac.Parameter]
    """decay of the amplitude [1/s]"""
    signalSource: _blocks.ExpSine
    def __init__(
        self,
        *,
        V: SupportsFloat | ac.Start = ...,
        f: SupportsFloat | ac.Start = ...,
        damping: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        phase: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class LightningImpulseCurrent(CurrentSource):
    """``i`` is an impulse of the height ``I``, see `LightningImpulse`."""

    I: ClassVar[ac.Parameter]
    """amplitude [A]"""
    approximation: ClassVar[ac.Option]
    """approximation of the impulse"""
    T1: ClassVar[ac.Option]
    """rise time in s"""
    T2: ClassVar[ac.Option]
    """time in s until it has fallen to a half"""
    m: ClassVar[ac.Option]
    """exponent of Heidler's function, 5 to 10"""
    signalSource: LightningImpulse
    def __init__(
        self,
        *,
        I: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        approximation: Literal["Heidler", "DoubleExp"] = ...,
        T1: Any = ...,
        T2: Any = ...,
        m: SupportsIndex = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class LightningImpulseVoltage(VoltageSource):
    """``v`` is an impulse of the height ``V``, see `LightningImpulse`."""

    V: ClassVar[ac.Parameter]
    """amplitude [V]"""
    approximation: ClassVar[ac.Option]
    """approximation of the impulse"""
    T1: ClassVar[ac.Option]
    """rise time in s"""
    T2: ClassVar[ac.Option]
    """time in s until it has fallen to a half"""
    m: ClassVar[ac.Option]
    """exponent of Heidler's function, 5 to 10"""
    signalSource: LightningImpulse
    def __init__(
        self,
        *,
        V: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        approximation: Literal["Heidler", "DoubleExp"] = ...,
        T1: Any = ...,
        T2: Any = ...,
        m: SupportsIndex = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class PulseCurrent(CurrentSource):
    """``i = offset + I`` for the first ``width`` per cent of each ``period``, else ``offset``."""

    I: ClassVar[ac.Parameter]
    """amplitude [A]"""
    width: ClassVar[ac.Parameter]
    """width of the pulse in per cent of the period"""
    period: ClassVar[ac.Parameter]
    """duration of one period [s]"""
    signalSource: _blocks.Pulse
    def __init__(
        self,
        *,
        I: SupportsFloat | ac.Start = ...,
        width: SupportsFloat | ac.Start = ...,
        period: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class PulseVoltage(VoltageSource):
    """``v = offset + V`` for the first ``width`` per cent of each ``period``, else ``offset``."""

    V: ClassVar[ac.Parameter]
    """amplitude [V]"""
    width: ClassVar[ac.Parameter]
    """width of the pulse in per cent of the period"""
    period: ClassVar[ac.Parameter]
    """duration of one period [s]"""
    signalSource: _blocks.Pulse
    def __init__(
        self,
        *,
        V: SupportsFloat | ac.Start = ...,
        width: SupportsFloat | ac.Start = ...,
        period: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class RampCurrent(CurrentSource):
    """``i`` rises by ``I`` during ``duration`` [s] and stays there."""

    I: ClassVar[ac.Parameter]
    """amplitude [A]"""
    duration: ClassVar[ac.Parameter]
    """duration of the ramp [s]"""
    signalSource: _blocks.Ramp
    def __init__(
        self,
        *,
        I: SupportsFloat | ac.Start = ...,
        duration: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class RampVoltage(VoltageSource):
    """``v`` rises by ``V`` during ``duration`` [s] and stays there."""

    V: ClassVar[ac.Parameter]
    """amplitude [V]"""
    duration: ClassVar[ac.Parameter]
    """duration of the ramp [s]"""
    signalSource: _blocks.Ramp
    def __init__(
        self,
        *,
        V: SupportsFloat | ac.Start = ...,
        duration: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class SawToothCurrent(CurrentSource):
    """``i`` rises from ``offset`` by ``I`` in each ``period``."""

    I: ClassVar[ac.Parameter]
    """amplitude [A]"""
    period: ClassVar[ac.Parameter]
    """duration of one period [s]"""
    signalSource: _blocks.SawTooth
    def __init__(
        self,
        *,
        I: SupportsFloat | ac.Start = ...,
        period: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class SawToothVoltage(VoltageSource):
    """``v`` rises from ``offset`` by ``V`` in each ``period``."""

    V: ClassVar[ac.Parameter]
    """amplitude [V]"""
    period: ClassVar[ac.Parameter]
    """duration of one period [s]"""
    signalSource: _blocks.SawTooth
    def __init__(
        self,
        *,
        V: SupportsFloat | ac.Start = ...,
        period: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class SineCurrent(CurrentSource):
    """``i = offset + I sin(2 pi f t + phase)`` for ``t = time - startTime >= 0``, else ``offset``."""

    I: ClassVar[ac.Parameter]
    """amplitude [A]"""
    phase: ClassVar[ac.Parameter]
    """phase at startTime [rad]"""
    f: ClassVar[ac.Parameter]
    """frequency [Hz]"""
    signalSource: _blocks.Sine
    def __init__(
        self,
        *,
        I: SupportsFloat | ac.Start = ...,
        f: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        phase: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class SineVoltage(VoltageSource):
    """``v = offset + V sin(2 pi f t + phase)`` for ``t = time - startTime >= 0``, else ``offset``."""

    V: ClassVar[ac.Parameter]
    """amplitude [V]"""
    phase: ClassVar[ac.Parameter]
    """phase at startTime [rad]"""
    f: ClassVar[ac.Parameter]
    """frequency [Hz]"""
    signalSource: _blocks.Sine
    def __init__(
        self,
        *,
        V: SupportsFloat | ac.Start = ...,
        f: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        phase: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class StepCurrent(CurrentSource):
    """``i = offset``, from ``startTime`` on ``i = offset + I``."""

    I: ClassVar[ac.Parameter]
    """amplitude [A]"""
    signalSource: _blocks.Step
    def __init__(
        self,
        *,
        I: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class StepVoltage(VoltageSource):
    """``v = offset``, from ``startTime`` on ``v = offset + V``."""

    V: ClassVar[ac.Parameter]
    """amplitude [V]"""
    signalSource: _blocks.Step
    def __init__(
        self,
        *,
        V: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class TrapezoidCurrent(CurrentSource):
    """In each ``period``: ``rising``, at ``offset + I`` for ``width``, ``falling`` [s], then ``offset``."""

    I: ClassVar[ac.Parameter]
    """amplitude [A]"""
    rising: ClassVar[ac.Parameter]
    """duration of the rise [s]"""
    width: ClassVar[ac.Parameter]
    """duration at the amplitude [s]"""
    falling: ClassVar[ac.Parameter]
    """duration of the fall [s]"""
    period: ClassVar[ac.Parameter]
    """duration of one period [s]"""
    nperiod: ClassVar[ac.Option]
    """number of periods; endless if negative"""
    signalSource: _blocks.Trapezoid
    def __init__(
        self,
        *,
        I: SupportsFloat | ac.Start = ...,
        rising: SupportsFloat | ac.Start = ...,
        width: SupportsFloat | ac.Start = ...,
        falling: SupportsFloat | ac.Start = ...,
        period: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        nperiod: SupportsIndex = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class TrapezoidVoltage(VoltageSource):
    """In each ``period``: ``rising``, at ``offset + V`` for ``width``, ``falling`` [s], then ``offset``."""

    V: ClassVar[ac.Parameter]
    """amplitude [V]"""
    rising: ClassVar[ac.Parameter]
    """duration of the rise [s]"""
    width: ClassVar[ac.Parameter]
    """duration at the amplitude [s]"""
    falling: ClassVar[ac.Parameter]
    """duration of the fall [s]"""
    period: ClassVar[ac.Parameter]
    """duration of one period [s]"""
    nperiod: ClassVar[ac.Option]
    """number of periods; endless if negative"""
    signalSource: _blocks.Trapezoid
    def __init__(
        self,
        *,
        V: SupportsFloat | ac.Start = ...,
        rising: SupportsFloat | ac.Start = ...,
        width: SupportsFloat | ac.Start = ...,
        falling: SupportsFloat | ac.Start = ...,
        period: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        nperiod: SupportsIndex = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

NegativePin = Pin
PositivePin = Pin
