"""Signal blocks (`Modelica.Blocks`): sources, mathematics, continuous and nonlinear blocks.

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, ClassVar, Literal, SupportsFloat, SupportsIndex

import acausal as ac
from acausal.modeling.declarations import (
    Input as BooleanInput,
    Input as BooleanVectorInput,
    Input as IntegerInput,
    Input as IntegerVectorInput,
    Input as RealInput,
    Input as RealVectorInput,
    Output as BooleanOutput,
    Output as IntegerOutput,
    Output as RealOutput,
    Output as RealVectorOutput,
)

from . import discrete as discrete, math_boolean as math_boolean, math_integer as math_integer

__all__ = [
    "Abs",
    "Acos",
    "Add",
    "Add3",
    "And",
    "Asin",
    "AssertCondition",
    "Atan",
    "Atan2",
    "BandLimitedWhiteNoise",
    "BooleanChange",
    "BooleanConstant",
    "BooleanExpression",
    "BooleanInput",
    "BooleanMIMOs",
    "BooleanOutput",
    "BooleanPassThrough",
    "BooleanPulse",
    "BooleanReplicator",
    "BooleanSISO",
    "BooleanSignalSource",
    "BooleanStep",
    "BooleanTable",
    "BooleanToInteger",
    "BooleanToReal",
    "BooleanValue",
    "BooleanVectorInput",
    "Change",
    "CombiTable1Ds",
    "CombiTable1Dv",
    "CombiTable2Ds",
    "CombiTable2Dv",
    "CombiTimeTable",
    "Constant",
    "ContinuousClock",
    "ContinuousMean",
    "ContinuousSignalExtrema",
    "Cos",
    "Cosh",
    "Cosine",
    "CosineVariableFrequencyAndAmplitude",
    "CriticalDamping",
    "DeMultiplex",
    "DeMultiplex2",
    "DeMultiplex3",
    "DeMultiplex4",
    "DeMultiplex5",
    "DeMultiplex6",
    "DeadZone",
    "Der",
    "Derivative",
    "DiscreteBlock",
    "DiscreteMIMO",
    "DiscreteMIMOs",
    "DiscreteSISO",
    "Division",
    "Edge",
    "Exp",
    "ExpSine",
    "Exponentials",
    "Exponentiation",
    "ExtractSignal",
    "Extractor",
    "FallingEdge",
    "Feedback",
    "Filter",
    "FirstOrder",
    "FixedDelay",
    "From_bar",
    "From_day",
    "From_deg",
    "From_degC",
    "From_degF",
    "From_degRk",
    "From_gps",
    "From_hour",
    "From_kWh",
    "From_kmh",
    "From_litre",
    "From_minute",
    "From_rpm",
    "Gain",
    "GlobalSeed",
    "Greater",
    "GreaterEqual",
    "GreaterEqualThreshold",
    "GreaterThreshold",
    "Harmonic",
    "Hysteresis",
    "IntegerChange",
    "IntegerConstant",
    "IntegerExpression",
    "IntegerInput",
    "IntegerMIBooleanMOs",
    "IntegerMO",
    "IntegerOutput",
    "IntegerPassThrough",
    "IntegerReplicator",
    "IntegerSIBooleanSO",
    "IntegerSO",
    "IntegerSignalSource",
    "IntegerStep",
    "IntegerTable",
    "IntegerToBoolean",
    "IntegerToReal",
    "IntegerValue",
    "IntegerVectorInput",
    "Integrator",
    "InverseBlockConstraints",
    "KinematicPTP",
    "KinematicPTP2",
    "Less",
    "LessEqual",
    "LessEqualThreshold",
    "LessThreshold",
    "LimIntegrator",
    "LimPID",
    "Limiter",
    "LinearDependency",
    "Log",
    "Log10",
    "LogFrequencySweep",
    "LogicalDelay",
    "LogicalSwitch",
    "LowpassButterworth",
    "MI2BooleanMOs",
    "MI2MO",
    "MIMO",
    "MIMOs",
    "MISO",
    "MO",
    "MVcontrol",
    "MVdiscrete",
    "MatrixGain",
    "Max",
    "Mean",
    "Min",
    "MinMax",
    "MultiProduct",
    "MultiSum",
    "MultiSwitch",
    "Multiplex",
    "Multiplex2",
    "Multiplex3",
    "Multiplex4",
    "Multiplex5",
    "Multiplex6",
    "Nand",
    "NeedsDiscreteStates",
    "Nor",
    "NormalNoise",
    "Not",
    "OnOffController",
    "Or",
    "PI",
    "PID",
    "PadeDelay",
    "PartialBooleanMISO",
    "PartialBooleanSISO_small",
    "PartialColumns",
    "PartialConversionBlock",
    "PartialIntegerMISO",
    "PartialIntegerSISO",
    "PartialNoise",
    "PartialRealMISO",
    "PartialStart",
    "PartialState",
    "PolarToRectangular",
    "Polynomial",
    "Power",
    "Pre",
    "Product",
    "Pulse",
    "Pythagoras",
    "RSFlipFlop",
    "RadioButtonSource",
    "Ramp",
    "RealExpression",
    "RealFFT",
    "RealInput",
    "RealOutput",
    "RealPassThrough",
    "RealToBoolean",
    "RealToInteger",
    "RealValue",
    "RealVectorInput",
    "RealVectorOutput",
    "RectangularToPolar",
    "RectifiedMean",
    "Replicator",
    "RootMeanSquare",
    "SI",
    "SI2BooleanSO",
    "SI2SO",
    "SIMO",
    "SISO",
    "SO",
    "SVcontrol",
    "SVdiscrete",
    "SampleTrigger",
    "SampledSignal",
    "SawTooth",
    "SecondOrder",
    "Sign",
    "SignalExtrema",
    "SignalSource",
    "Sin",
    "Sinc",
    "Sine",
    "SineVariableFrequencyAndAmplitude",
    "Sinh",
    "SlewRateLimiter",
    "Sqrt",
    "StandardDeviation",
    "StateSpace",
    "Step",
    "Sum",
    "Switch",
    "Switching",
    "TableData",
    "Tan",
    "Tanh",
    "TerminateSimulation",
    "TimeTable",
    "Timer",
    "To_bar",
    "To_day",
    "To_deg",
    "To_degC",
    "To_degF",
    "To_degRk",
    "To_gps",
    "To_hour",
    "To_kWh",
    "To_kmh",
    "To_litre",
    "To_minute",
    "To_rpm",
    "TotalHarmonicDistortion",
    "TransferFunction",
    "Trapezoid",
    "TriggeredTrapezoid",
    "TruncatedNormalNoise",
    "UniformNoise",
    "VariableDelay",
    "VariableLimiter",
    "Variance",
    "WrapAngle",
    "Xor",
    "ZeroCrossing",
    "discrete",
    "math_boolean",
    "math_integer",
    "partialBooleanComparison",
    "partialBooleanSI",
    "partialBooleanSI2SO",
    "partialBooleanSI3SO",
    "partialBooleanSISO",
    "partialBooleanSO",
    "partialBooleanSource",
    "partialBooleanThresholdComparison",
]

class AssertCondition(ac.Component):
    """Tells that its input has been false: ``failed`` is 1 from then on."""

    message: ClassVar[ac.Option]
    """what it means if the input is false"""
    assertionLevel: ClassVar[ac.Option]
    """without effect"""
    u: ClassVar[ac.Input]
    """what should be true, 1 or 0"""
    failed: ClassVar[ac.Discrete]
    """whether the input has been false"""
    def __init__(
        self,
        *,
        message: Any = ...,
        assertionLevel: Literal["error", "warning"] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        failed: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class BooleanValue(ac.Component):
    """``showActive`` is the input ``activePort``, or without ``use_activePort`` the truth value ``active``."""

    use_activePort: ClassVar[ac.Option]
    """whether there is the input activePort"""
    activePort: ClassVar[ac.Input]
    """what is shown"""
    active: ClassVar[ac.Variable]
    """what is shown without the input"""
    showActive: ClassVar[ac.Output]
    """what is shown, 1 or 0"""
    def __init__(
        self,
        *,
        active: ac.Start | Mapping[str, Any] = ...,
        use_activePort: bool = ...,
        activePort: ac.Start | Mapping[str, Any] = ...,
        showActive: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class DeMultiplex2(ac.Component):
    """A vector taken apart into ``y1``, ``y2`` of ``n1``, ``n2`` signals: ``[y1; y2] = u``."""

    n1: ClassVar[ac.Option]
    """size of y1"""
    n2: ClassVar[ac.Option]
    """size of y2"""
    u: ClassVar[ac.Input]
    """input signals"""
    y1: ClassVar[ac.Output]
    """the first of them"""
    y2: ClassVar[ac.Output]
    """the next"""
    def __init__(
        self,
        *,
        n1: SupportsIndex = ...,
        n2: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y1: ac.Start | Mapping[str, Any] = ...,
        y2: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class DiscreteBlock(ac.Component):
    """What sampled blocks share: ``sampleTrigger`` is true at ``startTime + k samplePeriod``, k = 0, 1, ..."""

    samplePeriod: ClassVar[ac.Parameter]
    """time between two samples, greater than zero [s]"""
    startTime: ClassVar[ac.Parameter]
    """first sample time [s]"""
    sampleTrigger: ClassVar[ac.Variable]
    """true at sample times"""
    firstTrigger: ClassVar[ac.Discrete]
    """true after the first sample"""
    def __init__(self, **modifiers: Any) -> None: ...

class GlobalSeed(ac.Component):
    """The seed of all noise in the component that it is a part of, and below."""

    enableNoise: ClassVar[ac.Option]
    """whether noise blocks give noise"""
    useAutomaticSeed: ClassVar[ac.Option]
    """runs are reproducible: change fixedSeed instead"""
    fixedSeed: ClassVar[ac.Option]
    """seed, any whole number"""
    def __init__(
        self,
        *,
        enableNoise: bool = ...,
        useAutomaticSeed: Literal[False] = ...,
        fixedSeed: SupportsIndex = ...,
    ) -> None: ...

class Harmonic(ac.Component):
    """The ``k``-th harmonic of the input over each period ``1/f``: ``sqrt(2) y_rms cos(2 pi k f t - y_arg)``."""

    f: ClassVar[ac.Parameter]
    """base frequency, greater than zero [Hz]"""
    k: ClassVar[ac.Parameter]
    """order of the harmonic"""
    useConjugateComplex: ClassVar[ac.Option]
    """whether y_arg has the opposite sign"""
    x0Cos: ClassVar[ac.Parameter]
    """initial value of the integral with the cosine"""
    x0Sin: ClassVar[ac.Parameter]
    """initial value of the integral with the sine"""
    y0Cos: ClassVar[ac.Parameter]
    """initial mean with the cosine"""
    y0Sin: ClassVar[ac.Parameter]
    """initial mean with the sine"""
    u: ClassVar[ac.Input]
    """input signal"""
    y_rms: ClassVar[ac.Output]
    """root mean square of the harmonic"""
    y_arg: ClassVar[ac.Output]
    """angle of the harmonic [rad]"""
    sin1: Cosine
    sin2: Sine
    product1: MultiProduct
    product2: MultiProduct
    mean1: Mean
    mean2: Mean
    rectangularToPolar: RectangularToPolar
    gain: Gain
    def __init__(
        self,
        *,
        f: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        x0Cos: SupportsFloat | ac.Start = ...,
        x0Sin: SupportsFloat | ac.Start = ...,
        y0Cos: SupportsFloat | ac.Start = ...,
        y0Sin: SupportsFloat | ac.Start = ...,
        useConjugateComplex: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y_rms: ac.Start | Mapping[str, Any] = ...,
        y_arg: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class InverseBlockConstraints(ac.Component):
    """Sets two signals equal, to invert a block between them: ``u1 = u2``, ``y1 = y2``."""

    u1: ClassVar[ac.Input]
    """input signal 1"""
    u2: ClassVar[ac.Input]
    """input signal 2, equal to u1"""
    y1: ClassVar[ac.Output]
    """output signal 1"""
    y2: ClassVar[ac.Output]
    """output signal 2, equal to y1"""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y1: ac.Start | Mapping[str, Any] = ...,
        y2: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class KinematicPTP2(ac.Component):
    """Position ``q``, speed ``qd`` and acceleration ``qdd`` of a motion from ``q_begin`` to ``q_end``."""

    q_begin: ClassVar[ac.Parameter]
    """start position"""
    q_end: ClassVar[ac.Parameter]
    """end position"""
    qd_max: ClassVar[ac.Parameter]
    """greatest speed"""
    qdd_max: ClassVar[ac.Parameter]
    """greatest acceleration"""
    startTime: ClassVar[ac.Parameter]
    """start of the motion [s]"""
    endTime: ClassVar[ac.Output]
    """end of the motion [s]"""
    q: ClassVar[ac.Output]
    """position"""
    qd: ClassVar[ac.Output]
    """speed"""
    qdd: ClassVar[ac.Output]
    """acceleration"""
    def __init__(
        self,
        *,
        q_begin: SupportsFloat | Iterable[Any] = ...,
        q_end: SupportsFloat | Iterable[Any] = ...,
        qd_max: SupportsFloat | Iterable[Any] = ...,
        qdd_max: SupportsFloat | Iterable[Any] = ...,
        startTime: SupportsFloat | ac.Start = ...,
        endTime: ac.Start | Mapping[str, Any] = ...,
        q: ac.Start | Mapping[str, Any] = ...,
        qd: ac.Start | Mapping[str, Any] = ...,
        qdd: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LogicalDelay(ac.Component):
    """The input with a delay: ``y1`` turns false, ``y2`` true only ``delayTime`` [s] after it."""

    delayTime: ClassVar[ac.Parameter]
    """delay [s]"""
    u: ClassVar[ac.Input]
    """input signal"""
    y1: ClassVar[ac.Output]
    """turns true at once, false after the delay"""
    y2: ClassVar[ac.Output]
    """turns true after the delay, false at once"""
    held: ClassVar[ac.Discrete]
    """whether the input is true"""
    tSwitch: ClassVar[ac.Discrete]
    """when the input changed last [s]"""
    def __init__(
        self,
        *,
        delayTime: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y1: ac.Start | Mapping[str, Any] = ...,
        y2: ac.Start | Mapping[str, Any] = ...,
        held: ac.Start | Mapping[str, Any] = ...,
        tSwitch: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class MI2MO(ac.Component):
    """``n`` inputs ``u1``, ``n`` inputs ``u2``, ``n`` outputs ``y``."""

    n: ClassVar[ac.Option]
    """number of inputs of each kind and of outputs"""
    u1: ClassVar[ac.Input]
    """first input signals"""
    u2: ClassVar[ac.Input]
    """second input signals"""
    y: ClassVar[ac.Output]
    """output signals"""
    def __init__(self, **modifiers: Any) -> None: ...

class MIMO(ac.Component):
    """``nin`` inputs ``u``, ``nout`` outputs ``y``."""

    nin: ClassVar[ac.Option]
    """number of inputs"""
    nout: ClassVar[ac.Option]
    """number of outputs"""
    u: ClassVar[ac.Input]
    """input signals"""
    y: ClassVar[ac.Output]
    """output signals"""
    def __init__(self, **modifiers: Any) -> None: ...

class MIMOs(ac.Component):
    """``n`` inputs ``u``, as many outputs ``y``."""

    n: ClassVar[ac.Option]
    """number of inputs and of outputs"""
    u: ClassVar[ac.Input]
    """input signals"""
    y: ClassVar[ac.Output]
    """output signals"""
    def __init__(self, **modifiers: Any) -> None: ...

class MISO(ac.Component):
    """``nin`` inputs ``u``, one output ``y``."""

    nin: ClassVar[ac.Option]
    """number of inputs"""
    u: ClassVar[ac.Input]
    """input signals"""
    y: ClassVar[ac.Output]
    """output signal"""
    def __init__(self, **modifiers: Any) -> None: ...

class MO(ac.Component):
    """``nout`` outputs ``y``."""

    nout: ClassVar[ac.Option]
    """number of outputs"""
    y: ClassVar[ac.Output]
    """output signals"""
    def __init__(self, **modifiers: Any) -> None: ...

class MVcontrol(ac.Component):
    """A controller of ``n`` signals: set points ``u_s`` and measurements ``u_m`` enter, actuators ``y`` leave."""

    n: ClassVar[ac.Option]
    """number of signals of each kind"""
    u_s: ClassVar[ac.Input]
    """set points"""
    u_m: ClassVar[ac.Input]
    """measurements"""
    y: ClassVar[ac.Output]
    """actuator signals"""
    def __init__(self, **modifiers: Any) -> None: ...

class MinMax(ac.Component):
    """``yMax`` and ``yMin`` are the greatest and the smallest of the ``nu`` inputs ``u``."""

    nu: ClassVar[ac.Option]
    """number of inputs"""
    u: ClassVar[ac.Input]
    """input signals"""
    yMax: ClassVar[ac.Output]
    """greatest input"""
    yMin: ClassVar[ac.Output]
    """smallest input"""
    def __init__(
        self,
        *,
        nu: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        yMax: ac.Start | Mapping[str, Any] = ...,
        yMin: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Multiplex2(ac.Component):
    """Vectors ``u1``, ``u2`` of ``n1``, ``n2`` signals as one: ``y = [u1; u2]``."""

    n1: ClassVar[ac.Option]
    """size of u1"""
    n2: ClassVar[ac.Option]
    """size of u2"""
    u1: ClassVar[ac.Input]
    """first input signals"""
    u2: ClassVar[ac.Input]
    """second input signals"""
    y: ClassVar[ac.Output]
    """all of them"""
    def __init__(
        self,
        *,
        n1: SupportsIndex = ...,
        n2: SupportsIndex = ...,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class NeedsDiscreteStates(ac.Component):
    """Base of blocks that Modelica has and that cannot be made yet: they need more than states and events."""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialBooleanMISO(ac.Component):
    """``nu`` inputs ``u`` that are truth values, one output ``y``."""

    nu: ClassVar[ac.Option]
    """number of inputs"""
    u: ClassVar[ac.Input]
    """input signals, 1 or 0"""
    y: ClassVar[ac.Output]
    """output signal, 1 or 0"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialStart(ac.Component):
    """What blocks with one state ``y`` share: ``initType`` and ``y_start``."""

    initType: ClassVar[ac.Option]
    """type of initialization"""
    y_start: ClassVar[ac.Parameter]
    """initial or guess value of the output"""
    y: ClassVar[ac.Output]
    """output signal"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialState(ac.Component):
    """The initial equations of blocks with one state ``x``, by ``initType``."""
    def __init__(self, **modifiers: Any) -> None: ...

class PolarToRectangular(ac.Component):
    """``y_re = u_abs cos(u_arg)``, ``y_im = u_abs sin(u_arg)``, the angle in rad."""

    u_abs: ClassVar[ac.Input]
    """length"""
    u_arg: ClassVar[ac.Input]
    """angle [rad]"""
    y_re: ClassVar[ac.Output]
    """real part"""
    y_im: ClassVar[ac.Output]
    """imaginary part"""
    def __init__(
        self,
        *,
        u_abs: ac.Start | Mapping[str, Any] = ...,
        u_arg: ac.Start | Mapping[str, Any] = ...,
        y_re: ac.Start | Mapping[str, Any] = ...,
        y_im: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RSFlipFlop(ac.Component):
    """Memory: ``Q`` turns true where ``S`` is, false where ``R`` is; ``QI`` is its opposite."""

    Qini: ClassVar[ac.Option]
    """truth value of Q at the start"""
    S: ClassVar[ac.Input]
    """sets"""
    R: ClassVar[ac.Input]
    """resets"""
    Q: ClassVar[ac.Output]
    """what is remembered"""
    QI: ClassVar[ac.Output]
    """its opposite"""
    nor: Nor
    nor1: Nor
    pre: Pre
    def __init__(
        self,
        *,
        Qini: bool = ...,
        S: ac.Start | Mapping[str, Any] = ...,
        R: ac.Start | Mapping[str, Any] = ...,
        Q: ac.Start | Mapping[str, Any] = ...,
        QI: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class RadioButtonSource(ac.Component):
    """A button: ``on`` turns true at every time of ``buttonTimeTable`` [s], false where one in ``reset`` turns true."""

    nReset: ClassVar[ac.Option]
    """number of elements of reset"""
    reset: ClassVar[ac.Variable]
    """truth values that turn the button off"""
    buttonTimeTable: ClassVar[ac.Option]
    """times at which the button is pressed"""
    on: ClassVar[ac.Discrete]
    """whether the button is on, 1 or 0"""
    resetting: ClassVar[ac.Discrete]
    """whether an expression in reset is true"""
    pre_reset: ClassVar[ac.Discrete]
    """whether it was so just before"""
    pressed: ClassVar[ac.Discrete]
    """changes where the button is pressed"""
    table: BooleanTable
    def __init__(
        self,
        *,
        reset: ac.Start | Mapping[str, Any] = ...,
        nReset: SupportsIndex = ...,
        buttonTimeTable: Any = ...,
        on: ac.Start | Mapping[str, Any] = ...,
        resetting: ac.Start | Mapping[str, Any] = ...,
        pre_reset: ac.Start | Mapping[str, Any] = ...,
        pressed: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class RealValue(ac.Component):
    """``showNumber`` is the input ``numberPort``, or without ``use_numberPort`` the ``number``."""

    use_numberPort: ClassVar[ac.Option]
    """whether there is the input numberPort"""
    significantDigits: ClassVar[ac.Option]
    """without effect"""
    numberPort: ClassVar[ac.Input]
    """what is shown"""
    number: ClassVar[ac.Variable]
    """what is shown without the input"""
    showNumber: ClassVar[ac.Output]
    """what is shown"""
    def __init__(
        self,
        *,
        number: ac.Start | Mapping[str, Any] = ...,
        use_numberPort: bool = ...,
        significantDigits: SupportsIndex = ...,
        numberPort: ac.Start | Mapping[str, Any] = ...,
        showNumber: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class RectangularToPolar(ac.Component):
    """``y_abs = sqrt(u_re**2 + u_im**2)``, ``y_arg = atan2(u_im, u_re)`` [rad]."""

    u_re: ClassVar[ac.Input]
    """real part"""
    u_im: ClassVar[ac.Input]
    """imaginary part"""
    y_abs: ClassVar[ac.Output]
    """length"""
    y_arg: ClassVar[ac.Output]
    """angle [rad]"""
    def __init__(
        self,
        *,
        u_re: ac.Start | Mapping[str, Any] = ...,
        u_im: ac.Start | Mapping[str, Any] = ...,
        y_abs: ac.Start | Mapping[str, Any] = ...,
        y_arg: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SI(ac.Component):
    """One input ``u``."""

    u: ClassVar[ac.Input]
    """input signal"""
    def __init__(self, **modifiers: Any) -> None: ...

class SI2SO(ac.Component):
    """Two inputs ``u1`` and ``u2``, one output ``y``."""

    u1: ClassVar[ac.Input]
    """first input signal"""
    u2: ClassVar[ac.Input]
    """second input signal"""
    y: ClassVar[ac.Output]
    """output signal"""
    def __init__(self, **modifiers: Any) -> None: ...

class SIMO(ac.Component):
    """One input ``u``, ``nout`` outputs ``y``."""

    nout: ClassVar[ac.Option]
    """number of outputs"""
    u: ClassVar[ac.Input]
    """input signal"""
    y: ClassVar[ac.Output]
    """output signals"""
    def __init__(self, **modifiers: Any) -> None: ...

class SISO(ac.Component):
    """One input ``u``, one output ``y``."""

    u: ClassVar[ac.Input]
    """input signal"""
    y: ClassVar[ac.Output]
    """output signal"""
    def __init__(self, **modifiers: Any) -> None: ...

class SO(ac.Component):
    """One output ``y``."""

    y: ClassVar[ac.Output]
    """output signal"""
    def __init__(self, **modifiers: Any) -> None: ...

class SVcontrol(ac.Component):
    """Set point ``u_s`` and measurement ``u_m`` enter, actuator signal ``y`` leaves."""

    u_s: ClassVar[ac.Input]
    """set point"""
    u_m: ClassVar[ac.Input]
    """measurement"""
    y: ClassVar[ac.Output]
    """actuator signal"""
    def __init__(self, **modifiers: Any) -> None: ...

class Switch(ac.Component):
    """``y = u1`` where ``u2`` is true, else ``y = u3``."""

    u1: ClassVar[ac.Input]
    """output where u2 is true"""
    u2: ClassVar[ac.Input]
    """which input is passed: the first above 0.5, else the third"""
    u3: ClassVar[ac.Input]
    """output where u2 is false"""
    y: ClassVar[ac.Output]
    """output signal"""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        u3: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Switching(ac.Component):
    """What switches share: ``nu`` inputs ``u``, each with a value in ``expr`` for when it is the first that is true."""

    nu: ClassVar[ac.Option]
    """number of inputs"""
    u: ClassVar[ac.Input]
    """input signals, 1 or 0"""
    expr: ClassVar[ac.Variable]
    """output for each"""
    def __init__(self, *, expr: Sequence[Any] | None = ..., **modifiers: Any) -> None: ...

class TableData(ac.Component):
    """A table that is given by its rows, or lies in a file."""

    table: ClassVar[ac.Option]
    """rows of the argument and values"""
    tableOnFile: ClassVar[ac.Option]
    """whether the table lies in a file"""
    tableName: ClassVar[ac.Option]
    """name of the table in the file"""
    fileName: ClassVar[ac.Option]
    """path of the file"""
    delimiter: ClassVar[ac.Option]
    """what separates the numbers in a file .csv"""
    nHeaderLines: ClassVar[ac.Option]
    """lines at the begin of a file .csv without numbers"""
    verboseRead: ClassVar[ac.Option]
    """without effect"""
    verboseExtrapolation: ClassVar[ac.Option]
    """without effect"""
    def __init__(
        self,
        *,
        table: Any = ...,
        tableOnFile: Literal[False, True] = ...,
        tableName: Any = ...,
        fileName: Any = ...,
        delimiter: Any = ...,
        nHeaderLines: SupportsIndex = ...,
        verboseRead: bool = ...,
        verboseExtrapolation: bool = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class TerminateSimulation(ac.Component):
    """Tells that a condition has come true: ``terminated`` is 1 from then on."""

    terminationText: ClassVar[ac.Option]
    """without effect"""
    condition: ClassVar[ac.Output]
    """when the simulation should end, 1 or 0"""
    terminated: ClassVar[ac.Discrete]
    """whether the condition has come true"""
    def __init__(
        self,
        *,
        condition: ac.Start | Mapping[str, Any] = ...,
        terminationText: Any = ...,
        terminated: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class TriggeredTrapezoid(ac.Component):
    """Rises to ``offset + amplitude`` during ``rising`` [s] where ``u`` turns true, and back during ``falling`` [s]."""

    amplitude: ClassVar[ac.Parameter]
    """height of the trapezoid"""
    rising: ClassVar[ac.Parameter]
    """duration of the rise [s]"""
    falling: ClassVar[ac.Parameter]
    """duration of the fall [s]"""
    offset: ClassVar[ac.Parameter]
    """offset of the output"""
    u: ClassVar[ac.Input]
    """whether the output is high, 1 or 0"""
    y: ClassVar[ac.Output]
    """output signal"""
    held: ClassVar[ac.Discrete]
    """whether the input is true"""
    endValue: ClassVar[ac.Discrete]
    """output at the end of the present rise or fall"""
    rate: ClassVar[ac.Discrete]
    """slope of the present rise or fall"""
    T: ClassVar[ac.Discrete]
    """end of the present rise or fall [s]"""
    def __init__(
        self,
        *,
        amplitude: SupportsFloat | ac.Start = ...,
        rising: SupportsFloat | ac.Start = ...,
        falling: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        held: ac.Start | Mapping[str, Any] = ...,
        endValue: ac.Start | Mapping[str, Any] = ...,
        rate: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Add(SI2SO):
    """``y = k1 u1 + k2 u2``."""

    k1: ClassVar[ac.Parameter]
    """gain of u1"""
    k2: ClassVar[ac.Parameter]
    """gain of u2"""
    def __init__(
        self,
        *,
        k1: SupportsFloat | ac.Start = ...,
        k2: SupportsFloat | ac.Start = ...,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Add3(SI2SO):
    """``y = k1 u1 + k2 u2 + k3 u3``."""

    k1: ClassVar[ac.Parameter]
    """gain of u1"""
    k2: ClassVar[ac.Parameter]
    """gain of u2"""
    k3: ClassVar[ac.Parameter]
    """gain of u3"""
    u3: ClassVar[ac.Input]
    """third input signal"""
    def __init__(
        self,
        *,
        k1: SupportsFloat | ac.Start = ...,
        k2: SupportsFloat | ac.Start = ...,
        k3: SupportsFloat | ac.Start = ...,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        u3: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Atan2(SI2SO):
    """``y = atan2(u1, u2)``: the angle whose tangent is ``u1/u2``, in the right quadrant."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class BooleanConstant(SO):
    """``k`` at all times."""

    k: ClassVar[ac.Option]
    """constant truth value"""
    def __init__(self, *, k: bool = ..., y: ac.Start | Mapping[str, Any] = ...) -> None: ...

class BooleanExpression(SO):
    """A number or an expression of `acausal.time`, 1 or 0: ``BooleanExpression(y=1)``."""
    def __init__(
        self, *, y: ac.Start | Mapping[str, Any] = ..., **modifiers: Mapping[str, Any]
    ) -> None: ...

class BooleanPulse(SO):
    """True during the first ``width`` percent of every period from ``startTime`` [s] on."""

    width: ClassVar[ac.Parameter]
    """width of a pulse in percent of the period"""
    period: ClassVar[ac.Parameter]
    """duration of a period [s]"""
    startTime: ClassVar[ac.Parameter]
    """time of the first pulse [s]"""
    def __init__(
        self,
        *,
        period: SupportsFloat | ac.Start = ...,
        width: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class BooleanStep(SO):
    """``startValue`` before ``startTime`` [s], then the opposite."""

    startTime: ClassVar[ac.Parameter]
    """time of the step [s]"""
    startValue: ClassVar[ac.Option]
    """truth value before"""
    def __init__(
        self,
        *,
        startTime: SupportsFloat | ac.Start = ...,
        startValue: bool = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class BooleanToInteger(SISO):
    """``integerTrue`` where ``u`` is true, else ``integerFalse``."""

    integerTrue: ClassVar[ac.Parameter]
    """output where the input is true"""
    integerFalse: ClassVar[ac.Parameter]
    """output where the input is false"""
    def __init__(
        self,
        *,
        integerTrue: SupportsFloat | ac.Start = ...,
        integerFalse: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class BooleanToReal(SISO):
    """``realTrue`` where ``u`` is true, else ``realFalse``."""

    realTrue: ClassVar[ac.Parameter]
    """output where the input is true"""
    realFalse: ClassVar[ac.Parameter]
    """output where the input is false"""
    def __init__(
        self,
        *,
        realTrue: SupportsFloat | ac.Start = ...,
        realFalse: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Constant(SO):
    """``y = k``."""

    k: ClassVar[ac.Parameter]
    """constant output"""
    def __init__(
        self, *, k: SupportsFloat | ac.Start = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class ContinuousMean(SISO):
    """Mean of the input since ``t_0`` [s]: ``der(mu) = (u - mu)/(time - t_0)``, ``y = mu``."""

    t_eps: ClassVar[ac.Parameter]
    """averaging begins so long after t_0 [s]"""
    t_0: ClassVar[ac.Parameter]
    """start time [s]"""
    mu: ClassVar[ac.Variable]
    """mean of the input"""
    def __init__(
        self,
        *,
        t_eps: SupportsFloat | ac.Start = ...,
        t_0: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        mu: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ContinuousSignalExtrema(ac.Component):
    """Least and greatest value, and when they were reached."""

    u: ClassVar[ac.Input]
    """input signal"""
    y_min: ClassVar[ac.Discrete]
    """least value so far"""
    y_max: ClassVar[ac.Discrete]
    """greatest value so far"""
    t_min: ClassVar[ac.Discrete]
    """when the least value was reached [s]"""
    t_max: ClassVar[ac.Discrete]
    """when the greatest value was reached [s]"""
    T: ClassVar[ac.Parameter]
    """time constant of the lag, greater than zero [s]"""
    x: ClassVar[ac.Variable]
    """the input with a lag"""
    above: ClassVar[ac.Discrete]
    """whether the input is above its lag"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y_min: ac.Start | Mapping[str, Any] = ...,
        y_max: ac.Start | Mapping[str, Any] = ...,
        t_min: ac.Start | Mapping[str, Any] = ...,
        t_max: ac.Start | Mapping[str, Any] = ...,
        above: ac.Start | Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CriticalDamping(SISO):
    """``n`` equal lags in series with the cut-off frequency ``f`` [Hz]."""

    n: ClassVar[ac.Option]
    """order of the filter"""
    f: ClassVar[ac.Parameter]
    """cut-off frequency [Hz]"""
    normalized: ClassVar[ac.Option]
    """whether the amplitude at f is -3 dB"""
    initType: ClassVar[ac.Option]
    """type of initialization"""
    x_start: ClassVar[ac.Parameter]
    """initial or guess values of the states"""
    y_start: ClassVar[ac.Parameter]
    """initial value of the output"""
    x: ClassVar[ac.Variable]
    """states"""
    def __init__(
        self,
        *,
        f: SupportsFloat | ac.Start = ...,
        x_start: SupportsFloat | Iterable[Any] = ...,
        y_start: SupportsFloat | ac.Start = ...,
        n: SupportsIndex = ...,
        normalized: bool = ...,
        initType: Literal["NoInit", "SteadyState", "InitialState", "InitialOutput"] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class DeMultiplex3(DeMultiplex2):
    """A vector taken apart into ``y1`` to ``y3``."""

    n3: ClassVar[ac.Option]
    """size of y3"""
    y3: ClassVar[ac.Output]
    """the next"""
    def __init__(
        self,
        *,
        n1: SupportsIndex = ...,
        n2: SupportsIndex = ...,
        n3: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y1: ac.Start | Mapping[str, Any] = ...,
        y2: ac.Start | Mapping[str, Any] = ...,
        y3: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class DeadZone(SISO):
    """``y = 0`` for ``uMin <= u <= uMax``, else how far ``u`` lies beyond."""

    uMax: ClassVar[ac.Parameter]
    """upper end of the dead zone"""
    uMin: ClassVar[ac.Parameter]
    """lower end of the dead zone"""
    def __init__(
        self,
        *,
        uMax: SupportsFloat | ac.Start = ...,
        uMin: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Der(SISO):
    """``y = der(u)``: the input must be differentiable in the model."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class DiscreteMIMO(DiscreteBlock):
    """A sampled block with ``nin`` inputs ``u`` and ``nout`` outputs ``y``; a subclass says how many."""

    u: ClassVar[ac.Input]
    """continuous input signals"""
    y: ClassVar[ac.Output]
    """sampled output signals"""
    def __init__(self, **modifiers: Any) -> None: ...

class DiscreteMIMOs(DiscreteBlock):
    """A sampled block with ``n`` inputs ``u`` and as many outputs ``y``."""

    n: ClassVar[ac.Option]
    """number of inputs and of outputs"""
    u: ClassVar[ac.Input]
    """continuous input signals"""
    y: ClassVar[ac.Output]
    """sampled output signals"""
    def __init__(self, **modifiers: Any) -> None: ...

class DiscreteSISO(DiscreteBlock):
    """A sampled block with one input ``u`` and one output ``y``."""

    u: ClassVar[ac.Input]
    """continuous input signal"""
    y: ClassVar[ac.Output]
    """sampled output signal"""
    def __init__(self, **modifiers: Any) -> None: ...

class Division(SI2SO):
    """``y = u1/u2``."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Exponentiation(SISO):
    """``y = u**exponent``; ``u > 0`` unless the exponent is a whole number."""

    exponent: ClassVar[ac.Option]
    """exponent"""
    def __init__(
        self,
        *,
        exponent: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ExtractSignal(MIMO):
    """``y[i] = u[extract[i]]``; ``extract`` counts from 1 and is ``1, 2, ..., nout`` by default."""

    nin: ClassVar[ac.Option]
    """number of inputs"""
    nout: ClassVar[ac.Option]
    """number of outputs"""
    extract: ClassVar[ac.Option]
    """which inputs are passed on"""
    def __init__(
        self,
        *,
        nin: SupportsIndex = ...,
        nout: SupportsIndex = ...,
        extract: Any = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Extractor(MISO):
    """``y = u[index]`` with an index signal that is rounded to an integer from 1 to ``nin``."""

    allowOutOfRange: ClassVar[ac.Option]
    """whether the index may leave its range"""
    outOfRangeValue: ClassVar[ac.Parameter]
    """output where it does"""
    index: ClassVar[ac.Input]
    """number of the input that is passed on"""
    def __init__(
        self,
        *,
        outOfRangeValue: SupportsFloat | ac.Start = ...,
        nin: SupportsIndex = ...,
        allowOutOfRange: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        index: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Feedback(SI2SO):
    """``y = u1 - u2``."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Filter(SISO):
    """Low pass, high pass, band pass or band stop of any order."""

    analogFilter: ClassVar[ac.Option]
    """characteristic"""
    filterType: ClassVar[ac.Option]
    """type of the filter"""
    order: ClassVar[ac.Option]
    """order of the low pass it is made from"""
    f_cut: ClassVar[ac.Parameter]
    """cut-off frequency [Hz]"""
    gain: ClassVar[ac.Parameter]
    """amplitude in the pass band"""
    A_ripple: ClassVar[ac.Option]
    """ripple of the pass band of ChebyshevI in dB"""
    f_min: ClassVar[ac.Parameter]
    """lower end of the band [Hz]"""
    normalized: ClassVar[ac.Option]
    """whether the amplitude at f_cut is -3 dB"""
    init: ClassVar[ac.Option]
    """type of initialization"""
    x_start: ClassVar[ac.Parameter]
    """initial or guess values of the states"""
    y_start: ClassVar[ac.Parameter]
    """initial value of the output"""
    u_nominal: ClassVar[ac.Parameter]
    """nominal value of the input, for scaling"""
    x: ClassVar[ac.Variable]
    """states"""
    def __init__(
        self,
        *,
        f_cut: SupportsFloat | ac.Start = ...,
        gain: SupportsFloat | ac.Start = ...,
        f_min: SupportsFloat | ac.Start = ...,
        x_start: SupportsFloat | Iterable[Any] = ...,
        y_start: SupportsFloat | ac.Start = ...,
        u_nominal: SupportsFloat | ac.Start = ...,
        analogFilter: Literal["CriticalDamping", "Bessel", "Butterworth", "ChebyshevI"] = ...,
        filterType: Literal["LowPass", "HighPass", "BandPass", "BandStop"] = ...,
        order: SupportsIndex = ...,
        A_ripple: Any = ...,
        normalized: bool = ...,
        init: Literal["NoInit", "SteadyState", "InitialState", "InitialOutput"] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FixedDelay(NeedsDiscreteStates):
    """The input of a while ago; see `PadeDelay` for an approximation."""
    def __init__(self, **modifiers: Any) -> None: ...

class Gain(SISO):
    """``y = k u``."""

    k: ClassVar[ac.Parameter]
    """gain"""
    def __init__(
        self,
        *,
        k: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Greater(SI2SO):
    """1 where ``u1 > u2``."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GreaterEqual(SI2SO):
    """1 where ``u1 >= u2``."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Hysteresis(ac.Component):
    """Switches on where ``u > uHigh`` and off where ``u < uLow``."""

    pre_y_start: ClassVar[ac.Option]
    """truth value of the output just before the start"""
    y: ClassVar[ac.Discrete]
    """output signal, 1 or 0"""
    uLow: ClassVar[ac.Parameter]
    """off below this"""
    uHigh: ClassVar[ac.Parameter]
    """on above this; greater than uLow"""
    u: ClassVar[ac.Input]
    """input signal"""
    def __init__(
        self,
        *,
        uLow: SupportsFloat | ac.Start = ...,
        uHigh: SupportsFloat | ac.Start = ...,
        pre_y_start: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IntegerChange(SISO):
    """True at the moment the input, an integer, changes."""

    held: ClassVar[ac.Discrete]
    """the input"""
    def __init__(
        self,
        *,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        held: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IntegerConstant(SO):
    """``y = k``, an integer."""

    k: ClassVar[ac.Parameter]
    """constant value"""
    def __init__(
        self, *, k: SupportsFloat | ac.Start = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class IntegerMIBooleanMOs(MIMOs):
    """``n`` inputs ``u`` that are integers, ``n`` outputs ``y`` that are truth values."""
    def __init__(self, **modifiers: Any) -> None: ...

class IntegerStep(SO):
    """``y = offset`` before ``startTime`` [s], then ``offset + height``."""

    height: ClassVar[ac.Parameter]
    """height of the step"""
    offset: ClassVar[ac.Parameter]
    """offset of the output"""
    startTime: ClassVar[ac.Parameter]
    """time of the step [s]"""
    def __init__(
        self,
        *,
        height: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IntegerToBoolean(SISO):
    """1 where ``u >= threshold``, else 0."""

    threshold: ClassVar[ac.Parameter]
    """value from which on the output is true"""
    def __init__(
        self,
        *,
        threshold: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IntegerToReal(SISO):
    """``y = u``."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class IntegerValue(RealValue):
    """A `RealValue` for integers."""
    def __init__(
        self,
        *,
        number: ac.Start | Mapping[str, Any] = ...,
        use_numberPort: bool = ...,
        significantDigits: SupportsIndex = ...,
        numberPort: ac.Start | Mapping[str, Any] = ...,
        showNumber: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class KinematicPTP(MO):
    """Acceleration ``y`` of a motion over ``deltaq``, as fast as ``qd_max`` and ``qdd_max`` allow."""

    deltaq: ClassVar[ac.Parameter]
    """distance to move"""
    qd_max: ClassVar[ac.Parameter]
    """greatest speed"""
    qdd_max: ClassVar[ac.Parameter]
    """greatest acceleration"""
    startTime: ClassVar[ac.Parameter]
    """start of the motion [s]"""
    def __init__(
        self,
        *,
        deltaq: SupportsFloat | Iterable[Any] = ...,
        qd_max: SupportsFloat | Iterable[Any] = ...,
        qdd_max: SupportsFloat | Iterable[Any] = ...,
        startTime: SupportsFloat | ac.Start = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Less(SI2SO):
    """1 where ``u1 < u2``."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LessEqual(SI2SO):
    """1 where ``u1 <= u2``."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LimPID(SVcontrol):
    """PID controller with limited output, anti-windup, set-point weights and feed-forward."""

    controllerType: ClassVar[ac.Option]
    """type of controller"""
    k: ClassVar[ac.Parameter]
    """gain"""
    Ti: ClassVar[ac.Parameter]
    """time constant of the integrator [s]"""
    Td: ClassVar[ac.Parameter]
    """time constant of the derivative [s]"""
    yMax: ClassVar[ac.Parameter]
    """upper limit of the output"""
    yMin: ClassVar[ac.Parameter]
    """lower limit of the output"""
    wp: ClassVar[ac.Parameter]
    """weight of the set point in the proportional part"""
    wd: ClassVar[ac.Parameter]
    """weight of the set point in the derivative part"""
    Ni: ClassVar[ac.Parameter]
    """Ni Ti is the time constant of the anti-windup"""
    Nd: ClassVar[ac.Parameter]
    """the higher, the more ideal the derivative"""
    withFeedForward: ClassVar[ac.Option]
    """whether there is the input u_ff"""
    kFF: ClassVar[ac.Parameter]
    """gain of the feed-forward"""
    initType: ClassVar[ac.Option]
    """type of initialization"""
    xi_start: ClassVar[ac.Parameter]
    """initial or guess value of the integrator"""
    xd_start: ClassVar[ac.Parameter]
    """initial or guess value of the derivative's state"""
    y_start: ClassVar[ac.Parameter]
    """initial value of the output"""
    strict: ClassVar[ac.Option]
    """without effect"""
    homotopyType: ClassVar[ac.Option]
    """without effect"""
    u_ff: ClassVar[ac.Input]
    """feed-forward signal"""
    controlError: ClassVar[ac.Variable]
    """set point minus measurement"""
    addP: Add
    P: Gain
    addPID: Add3
    gainPID: Gain
    addFF: Add
    limiter: Limiter
    addD: Add
    D: Derivative
    addI: Add3
    I: Integrator
    addSat: Add
    gainTrack: Gain
    FFzero: Constant
    def __init__(
        self,
        *,
        yMax: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        Ti: SupportsFloat | ac.Start = ...,
        Td: SupportsFloat | ac.Start = ...,
        yMin: SupportsFloat | ac.Start = ...,
        wp: SupportsFloat | ac.Start = ...,
        wd: SupportsFloat | ac.Start = ...,
        Ni: SupportsFloat | ac.Start = ...,
        Nd: SupportsFloat | ac.Start = ...,
        kFF: SupportsFloat | ac.Start = ...,
        xi_start: SupportsFloat | ac.Start = ...,
        xd_start: SupportsFloat | ac.Start = ...,
        y_start: SupportsFloat | ac.Start = ...,
        controllerType: Literal["P", "PI", "PD", "PID"] = ...,
        withFeedForward: bool = ...,
        initType: Literal["NoInit", "SteadyState", "InitialState", "InitialOutput"] = ...,
        strict: bool = ...,
        homotopyType: Literal["NoHomotopy", "Linear", "UpperLimit", "LowerLimit"] = ...,
        u_s: ac.Start | Mapping[str, Any] = ...,
        u_m: ac.Start | Mapping[str, Any] = ...,
        u_ff: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        controlError: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Limiter(SISO):
    """``y = min(max(u, uMin), uMax)``; ``strict`` and ``homotopyType`` have no effect."""

    uMax: ClassVar[ac.Parameter]
    """upper limit"""
    uMin: ClassVar[ac.Parameter]
    """lower limit"""
    strict: ClassVar[ac.Option]
    """without effect"""
    homotopyType: ClassVar[ac.Option]
    """without effect"""
    def __init__(
        self,
        *,
        uMax: SupportsFloat | ac.Start = ...,
        uMin: SupportsFloat | ac.Start = ...,
        strict: bool = ...,
        homotopyType: Literal["NoHomotopy", "Linear", "UpperLimit", "LowerLimit"] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LinearDependency(SI2SO):
    """``y = y0 + k1 u1 + k2 u2``."""

    y0: ClassVar[ac.Parameter]
    """constant"""
    k1: ClassVar[ac.Parameter]
    """gain of u1"""
    k2: ClassVar[ac.Parameter]
    """gain of u2"""
    def __init__(
        self,
        *,
        y0: SupportsFloat | ac.Start = ...,
        k1: SupportsFloat | ac.Start = ...,
        k2: SupportsFloat | ac.Start = ...,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Log(SISO):
    """``y = log(u)/log(base)``, ``u > 0``: the natural logarithm by default."""

    base: ClassVar[ac.Parameter]
    """base of the logarithm"""
    def __init__(
        self,
        *,
        base: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Log10(SISO):
    """``y = log10(u)``, ``u > 0``."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class LogFrequencySweep(SO):
    """From ``wMin`` to ``wMax`` during ``duration`` [s], with a logarithm that is linear in time."""

    wMin: ClassVar[ac.Parameter]
    """start frequency"""
    wMax: ClassVar[ac.Parameter]
    """end frequency"""
    startTime: ClassVar[ac.Parameter]
    """start of the sweep [s]"""
    duration: ClassVar[ac.Parameter]
    """duration of the sweep; 0 gives a step [s]"""
    def __init__(
        self,
        *,
        wMin: SupportsFloat | ac.Start = ...,
        wMax: SupportsFloat | ac.Start = ...,
        duration: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LogicalSwitch(Switch):
    """A `Switch` for truth values."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        u3: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LowpassButterworth(SISO):
    """Butterworth low pass of order ``n`` with the cut-off frequency ``f`` [Hz]."""

    n: ClassVar[ac.Option]
    """order of the filter"""
    f: ClassVar[ac.Parameter]
    """cut-off frequency [Hz]"""
    initType: ClassVar[ac.Option]
    """type of initialization"""
    x1_start: ClassVar[ac.Parameter]
    """initial or guess values of the outputs of sections"""
    x2_start: ClassVar[ac.Parameter]
    """initial or guess values of their derivatives"""
    xr_start: ClassVar[ac.Parameter]
    """initial or guess value of the real pole's state"""
    y_start: ClassVar[ac.Parameter]
    """initial value of the output"""
    x1: ClassVar[ac.Variable]
    """outputs of the sections"""
    x2: ClassVar[ac.Variable]
    """their derivatives"""
    xr: ClassVar[ac.Variable]
    """state of the real pole; 0 for an even order"""
    def __init__(
        self,
        *,
        f: SupportsFloat | ac.Start = ...,
        x1_start: SupportsFloat | Iterable[Any] = ...,
        x2_start: SupportsFloat | Iterable[Any] = ...,
        xr_start: SupportsFloat | ac.Start = ...,
        y_start: SupportsFloat | ac.Start = ...,
        n: SupportsIndex = ...,
        initType: Literal["NoInit", "SteadyState", "InitialState", "InitialOutput"] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        x1: ac.Start | Mapping[str, Any] = ...,
        x2: ac.Start | Mapping[str, Any] = ...,
        xr: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class MVdiscrete(DiscreteBlock):
    """A sampled controller of ``n`` signals."""

    n: ClassVar[ac.Option]
    """number of signals of each kind"""
    u_s: ClassVar[ac.Input]
    """set points"""
    u_m: ClassVar[ac.Input]
    """measurements"""
    y: ClassVar[ac.Output]
    """actuator signals"""
    def __init__(self, **modifiers: Any) -> None: ...

class MatrixGain(MIMO):
    """``y = K u`` with a matrix ``K``."""

    K: ClassVar[ac.Parameter]
    """gain matrix"""
    def __init__(
        self,
        *,
        K: SupportsFloat | Iterable[Any] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Max(SI2SO):
    """``y = max(u1, u2)``."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Mean(SISO):
    """Mean of the input over each period ``1/f``: the output changes at the end of a period."""

    f: ClassVar[ac.Parameter]
    """base frequency, greater than zero [Hz]"""
    x0: ClassVar[ac.Parameter]
    """initial value of the integral"""
    y0: ClassVar[ac.Parameter]
    """initial value of the output"""
    yGreaterOrEqualZero: ClassVar[ac.Option]
    """whether a negative mean counts as zero"""
    t0: ClassVar[ac.Discrete]
    """start of the simulation [s]"""
    x: ClassVar[ac.Variable]
    """integral over the present period"""
    y_last: ClassVar[ac.Discrete]
    """mean over the last period"""
    def __init__(
        self,
        *,
        f: SupportsFloat | ac.Start = ...,
        x0: SupportsFloat | ac.Start = ...,
        y0: SupportsFloat | ac.Start = ...,
        yGreaterOrEqualZero: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        t0: ac.Start | Mapping[str, Any] = ...,
        y_last: ac.Start | Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Min(SI2SO):
    """``y = min(u1, u2)``."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class MultiProduct(SO):
    """``y = u[1] ... u[nu]``; 0 without inputs."""

    nu: ClassVar[ac.Option]
    """number of inputs"""
    u: ClassVar[ac.Input]
    """input signals"""
    def __init__(
        self,
        *,
        nu: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class MultiSum(SO):
    """``y = k[1] u[1] + ... + k[nu] u[nu]``."""

    nu: ClassVar[ac.Option]
    """number of inputs"""
    k: ClassVar[ac.Parameter]
    """gains"""
    u: ClassVar[ac.Input]
    """input signals"""
    def __init__(
        self,
        *,
        k: SupportsFloat | Iterable[Any] = ...,
        nu: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class MultiSwitch(Switching):
    """The value in ``expr`` that belongs to the first input that is true, else ``y_default``."""

    y_default: ClassVar[ac.Parameter]
    """output where no input is true"""
    precision: ClassVar[ac.Option]
    """without effect"""
    y: ClassVar[ac.Output]
    """output signal"""
    def __init__(
        self,
        *,
        expr: ac.Start | Mapping[str, Any] = ...,
        y_default: SupportsFloat | ac.Start = ...,
        nu: SupportsIndex = ...,
        precision: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Multiplex(MIMOs):
    """``n`` scalar inputs as one vector: ``y = u``."""

    n: ClassVar[ac.Option]
    """number of inputs and of outputs"""
    def __init__(
        self,
        *,
        n: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Multiplex3(Multiplex2):
    """Vectors ``u1`` to ``u3`` as one."""

    n3: ClassVar[ac.Option]
    """size of u3"""
    u3: ClassVar[ac.Input]
    """third input signals"""
    def __init__(
        self,
        *,
        n1: SupportsIndex = ...,
        n2: SupportsIndex = ...,
        n3: SupportsIndex = ...,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        u3: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Not(SISO):
    """1 where ``u`` is false."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class OnOffController(ac.Component):
    """On where ``u`` falls below ``reference - bandwidth/2``, off where it rises above ``reference + bandwidth/2``."""

    pre_y_start: ClassVar[ac.Option]
    """truth value of the output just before the start"""
    y: ClassVar[ac.Discrete]
    """output signal, 1 or 0"""
    bandwidth: ClassVar[ac.Parameter]
    """distance of the two levels"""
    reference: ClassVar[ac.Input]
    """set point"""
    u: ClassVar[ac.Input]
    """measurement"""
    def __init__(
        self,
        *,
        bandwidth: SupportsFloat | ac.Start = ...,
        pre_y_start: bool = ...,
        reference: ac.Start | Mapping[str, Any] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PID(SISO):
    """``k (1 + 1/(Ti s) + Td s/(Td/Nd s + 1))``, of the blocks `P`, `I`, `D`, `Add` and `Gain`."""

    k: ClassVar[ac.Parameter]
    """gain"""
    Ti: ClassVar[ac.Parameter]
    """time constant of the integrator [s]"""
    Td: ClassVar[ac.Parameter]
    """time constant of the derivative [s]"""
    Nd: ClassVar[ac.Parameter]
    """the higher, the more ideal the derivative"""
    initType: ClassVar[ac.Option]
    """type of initialization"""
    xi_start: ClassVar[ac.Parameter]
    """initial or guess value of the integrator"""
    xd_start: ClassVar[ac.Parameter]
    """initial or guess value of the derivative's state"""
    y_start: ClassVar[ac.Parameter]
    """initial value of the output"""
    P: Gain
    I: Integrator
    D: Derivative
    Gain: Gain
    Add: Add3
    def __init__(
        self,
        *,
        Ti: SupportsFloat | ac.Start = ...,
        Td: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        Nd: SupportsFloat | ac.Start = ...,
        xi_start: SupportsFloat | ac.Start = ...,
        xd_start: SupportsFloat | ac.Start = ...,
        y_start: SupportsFloat | ac.Start = ...,
        initType: Literal["NoInit", "SteadyState", "InitialState", "InitialOutput"] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class PadeDelay(SISO):
    """Padé approximation of ``y(t) = u(t - delayTime)``, with denominator of order ``n``, numerator ``m``."""

    delayTime: ClassVar[ac.Parameter]
    """delay of the output [s]"""
    n: ClassVar[ac.Option]
    """order of the denominator"""
    m: ClassVar[ac.Option]
    """order of the numerator, at most n; n by default"""
    balance: ClassVar[ac.Option]
    """without effect"""
    x: ClassVar[ac.Variable]
    """states in controller canonical form"""
    def __init__(
        self,
        *,
        delayTime: SupportsFloat | ac.Start = ...,
        n: SupportsIndex = ...,
        m: Any = ...,
        balance: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialColumns(TableData):
    """What tables with several columns of values share."""

    columns: ClassVar[ac.Option]
    """columns of the table that are outputs, counted from 1"""
    smoothness: ClassVar[ac.Option]
    """kind of interpolation"""
    extrapolation: ClassVar[ac.Option]
    """what holds outside of the table"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialConversionBlock(SISO):
    """Base of unit conversions: ``y = factor (u + shift)``."""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialIntegerMISO(PartialBooleanMISO):
    """``nu`` inputs ``u`` that are integers, one output ``y``."""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialNoise(SO):
    """What noise shares: a new number at ``startTime`` and every ``samplePeriod`` [s] after it, ``y_off`` before."""

    samplePeriod: ClassVar[ac.Parameter]
    """time between two numbers [s]"""
    enableNoise: ClassVar[ac.Option]
    """whether there is noise; else y = y_off"""
    y_off: ClassVar[ac.Parameter]
    """output without noise"""
    useGlobalSeed: ClassVar[ac.Option]
    """whether the global seed counts"""
    useAutomaticLocalSeed: ClassVar[ac.Option]
    """whether the local seed follows from the name"""
    fixedLocalSeed: ClassVar[ac.Option]
    """local seed otherwise, any whole number"""
    startTime: ClassVar[ac.Parameter]
    """time of the first number [s]"""
    length: ClassVar[ac.Option]
    """numbers until they repeat"""
    numbers: ClassVar[ac.Module]
    """numbers over the count of samples"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialRealMISO(PartialBooleanMISO):
    """``nu`` inputs ``u``, one output ``y``."""

    significantDigits: ClassVar[ac.Option]
    """without effect"""
    def __init__(self, **modifiers: Any) -> None: ...

class Polynomial(SISO):
    """``y = c[1] u**n + ... + c[n] u + c[n+1]``: coefficients from the highest power down."""

    c: ClassVar[ac.Parameter]
    """coefficients, highest power first"""
    def __init__(
        self,
        *,
        c: SupportsFloat | Iterable[Any] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Power(SISO):
    """``y = base**u``, computed as ``exp(u log(base))``; ``useExp`` has no effect."""

    base: ClassVar[ac.Parameter]
    """base of the power"""
    useExp: ClassVar[ac.Option]
    """without effect"""
    def __init__(
        self,
        *,
        base: SupportsFloat | ac.Start = ...,
        useExp: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Product(SI2SO):
    """``y = u1 u2``."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Pythagoras(SI2SO):
    """``y = sqrt(u1**2 + u2**2)``; with ``u1IsHypotenuse`` ``sqrt(u1**2 - u2**2)``, 0 if negative."""

    u1IsHypotenuse: ClassVar[ac.Option]
    """whether u1 is the hypotenuse"""
    valid: ClassVar[ac.Output]
    """whether the output is valid, 1 or 0"""
    y2: ClassVar[ac.Variable]
    """square of the output"""
    def __init__(
        self,
        *,
        u1IsHypotenuse: bool = ...,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        valid: ac.Start | Mapping[str, Any] = ...,
        y2: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RealExpression(SO):
    """A number or an expression of `acausal.time`: ``RealExpression(y=2 * ac.sin(ac.time))``."""
    def __init__(
        self, *, y: ac.Start | Mapping[str, Any] = ..., **modifiers: Mapping[str, Any]
    ) -> None: ...

class RealFFT(NeedsDiscreteStates):
    """Spectrum of a sampled signal."""
    def __init__(self, **modifiers: Any) -> None: ...

class RealPassThrough(SISO):
    """``y = u``."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class RealToBoolean(SISO):
    """1 where ``u >= threshold``, else 0."""

    threshold: ClassVar[ac.Parameter]
    """value from which on the output is true"""
    def __init__(
        self,
        *,
        threshold: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RealToInteger(SISO):
    """The nearest integer; halves are rounded away from zero."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class RectifiedMean(SISO):
    """Mean of the absolute value of the input over each period ``1/f``."""

    f: ClassVar[ac.Parameter]
    """base frequency, greater than zero [Hz]"""
    x0: ClassVar[ac.Parameter]
    """initial value of the integral"""
    y0: ClassVar[ac.Parameter]
    """initial value of the output"""
    abs1: Abs
    mean: Mean
    def __init__(
        self,
        *,
        f: SupportsFloat | ac.Start = ...,
        x0: SupportsFloat | ac.Start = ...,
        y0: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Replicator(SIMO):
    """``nout`` times the input: ``y[i] = u``."""
    def __init__(
        self,
        *,
        nout: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RootMeanSquare(SISO):
    """Root of the mean square of the input over each period ``1/f``."""

    f: ClassVar[ac.Parameter]
    """base frequency, greater than zero [Hz]"""
    x0: ClassVar[ac.Parameter]
    """initial value of the integral"""
    y0: ClassVar[ac.Parameter]
    """initial value of the output"""
    product: MultiProduct
    mean: Mean
    sqrt1: Sqrt
    def __init__(
        self,
        *,
        f: SupportsFloat | ac.Start = ...,
        x0: SupportsFloat | ac.Start = ...,
        y0: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class SVdiscrete(DiscreteBlock):
    """A sampled controller: set point ``u_s`` and measurement ``u_m`` enter, actuator signal ``y`` leaves."""

    u_s: ClassVar[ac.Input]
    """set point"""
    u_m: ClassVar[ac.Input]
    """measurement"""
    y: ClassVar[ac.Output]
    """actuator signal"""
    def __init__(self, **modifiers: Any) -> None: ...

class SampleTrigger(SO):
    """True at ``startTime + k period`` [s], k = 0, 1, ..., and false otherwise."""

    period: ClassVar[ac.Parameter]
    """sample period, greater than zero [s]"""
    startTime: ClassVar[ac.Parameter]
    """first sample time [s]"""
    def __init__(
        self,
        *,
        period: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SampledSignal(SO):
    """Measured samples as a signal: ``y = signal(time)``."""

    values: ClassVar[ac.Option]
    """samples"""
    ts: ClassVar[ac.Option]
    """times of the samples"""
    dt: ClassVar[ac.Option]
    """sample time, instead of ts"""
    startTime: ClassVar[ac.Option]
    """time of the first sample, with dt"""
    interpolation: ClassVar[ac.Option]
    extrapolation: ClassVar[ac.Option]
    signal: ClassVar[ac.Module]
    def __init__(
        self,
        *,
        values: Any = ...,
        ts: Any = ...,
        dt: Any = ...,
        startTime: Any = ...,
        interpolation: Literal[
            "linear",
            "previous",
            "cubic",
            "akima",
            "modified-akima",
            "monotone",
            "steffen",
            "band-limited",
        ] = ...,
        extrapolation: Literal["hold", "linear", "periodic"] = ...,
        signal: Callable[..., Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SignalExtrema(ac.Component):
    """Least and greatest value at the start and every ``Ts`` [s] after it, and when they were reached."""

    u: ClassVar[ac.Input]
    """input signal"""
    y_min: ClassVar[ac.Discrete]
    """least value so far"""
    y_max: ClassVar[ac.Discrete]
    """greatest value so far"""
    t_min: ClassVar[ac.Discrete]
    """when the least value was reached [s]"""
    t_max: ClassVar[ac.Discrete]
    """when the greatest value was reached [s]"""
    Ts: ClassVar[ac.Parameter]
    """time between two looks, greater than zero [s]"""
    t0: ClassVar[ac.Discrete]
    """start of the simulation [s]"""
    def __init__(
        self,
        *,
        Ts: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y_min: ac.Start | Mapping[str, Any] = ...,
        y_max: ac.Start | Mapping[str, Any] = ...,
        t_min: ac.Start | Mapping[str, Any] = ...,
        t_max: ac.Start | Mapping[str, Any] = ...,
        t0: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SignalSource(SO):
    """One output that is ``offset`` before ``startTime`` [s]."""

    offset: ClassVar[ac.Parameter]
    """offset of the output"""
    startTime: ClassVar[ac.Parameter]
    """the output is the offset before [s]"""
    def __init__(self, **modifiers: Any) -> None: ...

class StateSpace(MIMO):
    """``der(x) = A x + B u``, ``y = C x + D u`` with matrices; ``D`` is zero by default."""

    A: ClassVar[ac.Parameter]
    """state matrix"""
    B: ClassVar[ac.Parameter]
    """input matrix"""
    C: ClassVar[ac.Parameter]
    """output matrix"""
    D: ClassVar[ac.Parameter]
    """feedthrough matrix"""
    initType: ClassVar[ac.Option]
    """type of initialization"""
    x_start: ClassVar[ac.Parameter]
    """initial or guess values of the states"""
    y_start: ClassVar[ac.Parameter]
    """initial values of the outputs"""
    x: ClassVar[ac.Variable]
    """states"""
    multiplier: ClassVar[ac.Variable]
    """of the conditions on the outputs at the start"""
    def __init__(
        self,
        *,
        A: SupportsFloat | Iterable[Any] = ...,
        B: SupportsFloat | Iterable[Any] = ...,
        C: SupportsFloat | Iterable[Any] = ...,
        D: SupportsFloat | Iterable[Any] = ...,
        x_start: SupportsFloat | Iterable[Any] = ...,
        y_start: SupportsFloat | Iterable[Any] = ...,
        initType: Literal["NoInit", "SteadyState", "InitialState", "InitialOutput"] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        multiplier: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Sum(MISO):
    """``y = k[1] u[1] + ... + k[nin] u[nin]``."""

    k: ClassVar[ac.Parameter]
    """gains"""
    def __init__(
        self,
        *,
        k: SupportsFloat | Iterable[Any] = ...,
        nin: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Timer(SISO):
    """The time since the input turned true, 0 while it is false."""

    y: ClassVar[ac.Output]
    """time since then [s]"""
    entryTime: ClassVar[ac.Discrete]
    """when the input turned true [s]"""
    def __init__(
        self,
        *,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        entryTime: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TotalHarmonicDistortion(SISO):
    """All of the input but its first harmonic, relative to that, or without ``useFirstHarmonic`` to all of it."""

    f: ClassVar[ac.Parameter]
    """base frequency, greater than zero [Hz]"""
    useFirstHarmonic: ClassVar[ac.Option]
    """whether the first harmonic is the reference"""
    valid: ClassVar[ac.Output]
    """whether the output is valid, 1 or 0"""
    harmonic: Harmonic
    rootMeanSquare: RootMeanSquare
    greaterThreshold: GreaterThreshold
    andValid: And
    limiter: Limiter
    pythagoras: Pythagoras
    division: Division
    booleanExpression: BooleanExpression
    switch1: Switch
    def __init__(
        self,
        *,
        f: SupportsFloat | ac.Start = ...,
        useFirstHarmonic: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        valid: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class TransferFunction(SISO):
    """``(b[1] s**m + ... + b[m+1])/(a[1] s**n + ... + a[n+1])`` with ``m <= n``."""

    b: ClassVar[ac.Parameter]
    """numerator, highest power first"""
    a: ClassVar[ac.Parameter]
    """denominator, highest power first"""
    initType: ClassVar[ac.Option]
    """type of initialization"""
    x_start: ClassVar[ac.Parameter]
    """initial or guess values of the states"""
    y_start: ClassVar[ac.Parameter]
    """initial value of the output"""
    a_end: ClassVar[ac.Parameter]
    """last coefficient of a, or 1 where it is next to nothing"""
    x: ClassVar[ac.Variable]
    """states in controller canonical form"""
    x_scaled: ClassVar[ac.Variable]
    """states times the last coefficient of a"""
    def __init__(
        self,
        *,
        b: SupportsFloat | Iterable[Any] = ...,
        a: SupportsFloat | Iterable[Any] = ...,
        x_start: SupportsFloat | Iterable[Any] = ...,
        y_start: SupportsFloat | ac.Start = ...,
        a_end: SupportsFloat | ac.Start = ...,
        initType: Literal["NoInit", "SteadyState", "InitialState", "InitialOutput"] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        x_scaled: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class VariableDelay(NeedsDiscreteStates):
    """The input of a while ago, which may change."""
    def __init__(self, **modifiers: Any) -> None: ...

class VariableLimiter(SISO):
    """``y = min(max(u, limit2), limit1)`` with input signals as limits."""

    strict: ClassVar[ac.Option]
    """without effect"""
    homotopyType: ClassVar[ac.Option]
    """without effect"""
    ySimplified: ClassVar[ac.Option]
    """without effect"""
    limit1: ClassVar[ac.Input]
    """upper limit"""
    limit2: ClassVar[ac.Input]
    """lower limit"""
    def __init__(
        self,
        *,
        strict: bool = ...,
        homotopyType: Literal["NoHomotopy", "Linear", "Fixed"] = ...,
        ySimplified: Any = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        limit1: ac.Start | Mapping[str, Any] = ...,
        limit2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Variance(SISO):
    """Variance of the input since ``t_0`` [s] about its mean ``mu``, as of `ContinuousMean`."""

    t_eps: ClassVar[ac.Parameter]
    """averaging begins so long after t_0 [s]"""
    t_0: ClassVar[ac.Parameter]
    """start time [s]"""
    mu: ClassVar[ac.Variable]
    """mean of the input"""
    var: ClassVar[ac.Variable]
    """variance of the input"""
    def __init__(
        self,
        *,
        t_eps: SupportsFloat | ac.Start = ...,
        t_0: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        mu: ac.Start | Mapping[str, Any] = ...,
        var: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class WrapAngle(SISO):
    """The angle ``u`` [rad] in ``]-pi, pi]``, or in ``[0, 2 pi[`` with ``positiveRange``."""

    u: ClassVar[ac.Input]
    """angle [rad]"""
    y: ClassVar[ac.Output]
    """angle wrapped [rad]"""
    positiveRange: ClassVar[ac.Option]
    """whether to wrap to [0, 2 pi["""
    def __init__(
        self,
        *,
        positiveRange: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ZeroCrossing(SISO):
    """True at the moment the input crosses zero while ``enable`` is true, unless that changes just then."""

    enable: ClassVar[ac.Input]
    """whether crossings are looked for"""
    enabled: ClassVar[ac.Discrete]
    """whether enable is true"""
    u_pos: ClassVar[ac.Discrete]
    """whether the input is positive or zero, and enabled"""
    def __init__(
        self,
        *,
        u: ac.Start | Mapping[str, Any] = ...,
        enable: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        enabled: ac.Start | Mapping[str, Any] = ...,
        u_pos: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class partialBooleanSI3SO(SI2SO):
    """Three inputs ``u1``, ``u2``, ``u3``, one output ``y``."""

    u3: ClassVar[ac.Input]
    """third input signal"""
    def __init__(self, **modifiers: Any) -> None: ...

class Abs(SISO):
    """``y = |u|``; ``generateEvent`` has no effect."""

    generateEvent: ClassVar[ac.Option]
    """without effect"""
    def __init__(
        self,
        *,
        generateEvent: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Acos(SISO):
    """``y = acos(u)``, ``-1 <= u <= 1``."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class And(SI2SO):
    """1 where ``u1`` and ``u2`` are true."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Asin(SISO):
    """``y = asin(u)``, ``-1 <= u <= 1``."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class Atan(SISO):
    """``y = atan(u)``."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class BooleanTable(SO):
    """``startValue``, which turns into its opposite at every time of ``table`` [s]."""

    extrapolation: ClassVar[ac.Option]
    """what holds outside of the table"""
    startTime: ClassVar[ac.Parameter]
    """the output is 0 before [s]"""
    shiftTime: ClassVar[ac.Parameter]
    """time of the table's zero [s]"""
    table: ClassVar[ac.Option]
    """times at which the output changes"""
    startValue: ClassVar[ac.Option]
    """truth value before the first time"""
    def __init__(
        self,
        *,
        startTime: SupportsFloat | ac.Start = ...,
        shiftTime: SupportsFloat | ac.Start = ...,
        extrapolation: Literal[
            "HoldLastPoint", "LastTwoPoints", "Periodic", "NoExtrapolation"
        ] = ...,
        table: Any = ...,
        startValue: bool = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Change(SISO):
    """True at the moment the input changes."""

    pre_u_start: ClassVar[ac.Option]
    """truth value of the input just before the start"""
    held: ClassVar[ac.Discrete]
    """whether the input is true"""
    def __init__(
        self,
        *,
        pre_u_start: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        held: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CombiTable1Ds(PartialColumns):
    """Interpolation in rows ``[u, y2, y3, ...]``: output ``y[i]`` is column ``columns[i]`` at ``u``."""

    u: ClassVar[ac.Input]
    """argument"""
    y: ClassVar[ac.Output]
    """values"""
    def __init__(
        self,
        *,
        table: Any = ...,
        tableOnFile: Literal[False, True] = ...,
        tableName: Any = ...,
        fileName: Any = ...,
        delimiter: Any = ...,
        nHeaderLines: SupportsIndex = ...,
        verboseRead: bool = ...,
        verboseExtrapolation: bool = ...,
        columns: Any = ...,
        smoothness: Literal[
            "LinearSegments",
            "ConstantSegments",
            "ContinuousDerivative",
            "ModifiedContinuousDerivative",
            "MonotoneContinuousDerivative1",
            "MonotoneContinuousDerivative2",
        ] = ...,
        extrapolation: Literal[
            "HoldLastPoint", "LastTwoPoints", "Periodic", "NoExtrapolation"
        ] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class ContinuousClock(SignalSource):
    """The time since ``startTime``: ``y = offset + max(time - startTime, 0)``."""
    def __init__(
        self,
        *,
        offset: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Cos(SISO):
    """``y = cos(u)``."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class Cosh(SISO):
    """``y = cosh(u)``."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class CosineVariableFrequencyAndAmplitude(SO):
    """``y = offset + amplitude cos(phi)``, ``der(phi) = 2 pi f``, with inputs ``amplitude``, ``f``."""

    useConstantAmplitude: ClassVar[ac.Option]
    """whether the amplitude is constantAmplitude"""
    constantAmplitude: ClassVar[ac.Parameter]
    """amplitude without input"""
    useConstantFrequency: ClassVar[ac.Option]
    """whether the frequency is constantFrequency"""
    constantFrequency: ClassVar[ac.Parameter]
    """frequency without input [Hz]"""
    offset: ClassVar[ac.Parameter]
    """offset of the output"""
    amplitude: ClassVar[ac.Input]
    """amplitude"""
    f: ClassVar[ac.Input]
    """frequency [Hz]"""
    phi: ClassVar[ac.Variable]
    """phase; its start is the initial phase [rad]"""
    def __init__(
        self,
        *,
        constantAmplitude: SupportsFloat | ac.Start = ...,
        constantFrequency: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        useConstantAmplitude: bool = ...,
        useConstantFrequency: bool = ...,
        amplitude: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class DeMultiplex(Multiplex):
    """A vector as ``n`` scalar outputs: ``y = u``."""
    def __init__(
        self,
        *,
        n: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class DeMultiplex4(DeMultiplex3):
    """A vector taken apart into ``y1`` to ``y4``."""

    n4: ClassVar[ac.Option]
    """size of y4"""
    y4: ClassVar[ac.Output]
    """the next"""
    def __init__(
        self,
        *,
        n1: SupportsIndex = ...,
        n2: SupportsIndex = ...,
        n3: SupportsIndex = ...,
        n4: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y1: ac.Start | Mapping[str, Any] = ...,
        y2: ac.Start | Mapping[str, Any] = ...,
        y3: ac.Start | Mapping[str, Any] = ...,
        y4: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Derivative(SISO, PartialState):
    """Approximate derivative ``k s/(T s + 1)``: ``y = k (u - x)/T``, ``der(x) = (u - x)/T``."""

    k: ClassVar[ac.Parameter]
    """gain"""
    T: ClassVar[ac.Parameter]
    """time constant, greater than zero [s]"""
    initType: ClassVar[ac.Option]
    """type of initialization"""
    x_start: ClassVar[ac.Parameter]
    """initial or guess value of the state"""
    y_start: ClassVar[ac.Parameter]
    """initial value of the output"""
    x: ClassVar[ac.Variable]
    """state: the input, delayed"""
    def __init__(
        self,
        *,
        k: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        x_start: SupportsFloat | ac.Start = ...,
        y_start: SupportsFloat | ac.Start = ...,
        initType: Literal["NoInit", "SteadyState", "InitialState", "InitialOutput"] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Edge(SISO):
    """True at the moment the input turns true."""

    pre_u_start: ClassVar[ac.Option]
    """truth value of the input just before the start"""
    held: ClassVar[ac.Discrete]
    """whether the input is true"""
    def __init__(
        self,
        *,
        pre_u_start: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        held: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Exp(SISO):
    """``y = exp(u)``."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class ExpSine(SignalSource):
    """``y = offset + amplitude exp(-damping t) sin(2 pi f t + phase)``, ``t = time - startTime``."""

    amplitude: ClassVar[ac.Parameter]
    """amplitude"""
    f: ClassVar[ac.Parameter]
    """frequency [Hz]"""
    phase: ClassVar[ac.Parameter]
    """phase at startTime [rad]"""
    damping: ClassVar[ac.Parameter]
    """decay of the amplitude [1/s]"""
    def __init__(
        self,
        *,
        f: SupportsFloat | ac.Start = ...,
        damping: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        amplitude: SupportsFloat | ac.Start = ...,
        phase: SupportsFloat | ac.Start = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Exponentials(SignalSource):
    """Rises towards ``outMax`` for ``riseTime`` [s], then falls, both exponentially."""

    outMax: ClassVar[ac.Parameter]
    """height for an infinite rise time"""
    riseTime: ClassVar[ac.Parameter]
    """rise time [s]"""
    riseTimeConst: ClassVar[ac.Parameter]
    """time constant of the rise [s]"""
    fallTimeConst: ClassVar[ac.Parameter]
    """time constant of the fall [s]"""
    def __init__(
        self,
        *,
        riseTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        outMax: SupportsFloat | ac.Start = ...,
        riseTimeConst: SupportsFloat | ac.Start = ...,
        fallTimeConst: SupportsFloat | ac.Start = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FallingEdge(SISO):
    """True at the moment the input turns false."""

    pre_u_start: ClassVar[ac.Option]
    """truth value of the input just before the start"""
    held: ClassVar[ac.Discrete]
    """whether the input is true"""
    def __init__(
        self,
        *,
        pre_u_start: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        held: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FirstOrder(SISO, PartialStart):
    """Lag ``k/(T s + 1)``: ``der(y) = (k u - y)/T``."""

    y: ClassVar[ac.Output]
    """output signal"""
    k: ClassVar[ac.Parameter]
    """gain"""
    T: ClassVar[ac.Parameter]
    """time constant [s]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        y_start: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        initType: Literal["NoInit", "SteadyState", "InitialState", "InitialOutput"] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class From_bar(PartialConversionBlock):
    """Bars to pascals."""

    u: ClassVar[ac.Input]
    """pressure in bar"""
    y: ClassVar[ac.Output]
    """pressure [Pa]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class From_day(PartialConversionBlock):
    """Days to seconds."""

    u: ClassVar[ac.Input]
    """time in d"""
    y: ClassVar[ac.Output]
    """time [s]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class From_deg(PartialConversionBlock):
    """Degrees to radians."""

    u: ClassVar[ac.Input]
    """angle in deg"""
    y: ClassVar[ac.Output]
    """angle [rad]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class From_degC(PartialConversionBlock):
    """Degrees Celsius to kelvin: ``y = u + 273.15``."""

    u: ClassVar[ac.Input]
    """temperature in degC"""
    y: ClassVar[ac.Output]
    """temperature [K]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class From_degF(PartialConversionBlock):
    """Degrees Fahrenheit to kelvin: ``y = 5/9 (u + 459.67)``."""

    u: ClassVar[ac.Input]
    """temperature in degF"""
    y: ClassVar[ac.Output]
    """temperature [K]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class From_degRk(PartialConversionBlock):
    """Degrees Rankine to kelvin: ``y = 5/9 u``."""

    u: ClassVar[ac.Input]
    """temperature in degR"""
    y: ClassVar[ac.Output]
    """temperature [K]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class From_gps(PartialConversionBlock):
    """Grams per second to kilograms per second."""

    u: ClassVar[ac.Input]
    """mass flow rate in g/s"""
    y: ClassVar[ac.Output]
    """mass flow rate [kg/s]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class From_hour(PartialConversionBlock):
    """Hours to seconds."""

    u: ClassVar[ac.Input]
    """time in h"""
    y: ClassVar[ac.Output]
    """time [s]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class From_kWh(PartialConversionBlock):
    """Kilowatt hours to joules."""

    u: ClassVar[ac.Input]
    """energy in kW.h"""
    y: ClassVar[ac.Output]
    """energy [J]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class From_kmh(PartialConversionBlock):
    """Kilometres per hour to metres per second."""

    u: ClassVar[ac.Input]
    """speed in km/h"""
    y: ClassVar[ac.Output]
    """speed [m/s]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class From_litre(PartialConversionBlock):
    """Litres to cubic metres."""

    u: ClassVar[ac.Input]
    """volume in l"""
    y: ClassVar[ac.Output]
    """volume [m3]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class From_minute(PartialConversionBlock):
    """Minutes to seconds."""

    u: ClassVar[ac.Input]
    """time in min"""
    y: ClassVar[ac.Output]
    """time [s]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class From_rpm(PartialConversionBlock):
    """Revolutions per minute to radians per second."""

    u: ClassVar[ac.Input]
    """angular velocity in rev/min"""
    y: ClassVar[ac.Output]
    """angular velocity [rad/s]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class GreaterEqualThreshold(SISO):
    """1 where ``u >= threshold``."""

    threshold: ClassVar[ac.Parameter]
    """value to compare with"""
    def __init__(
        self,
        *,
        threshold: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GreaterThreshold(SISO):
    """1 where ``u > threshold``."""

    threshold: ClassVar[ac.Parameter]
    """value to compare with"""
    def __init__(
        self,
        *,
        threshold: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IntegerExpression(BooleanExpression):
    """A number or an expression of `acausal.time` whose values are integers."""
    def __init__(
        self, *, y: ac.Start | Mapping[str, Any] = ..., **modifiers: Mapping[str, Any]
    ) -> None: ...

class IntegerTable(SO):
    """Steps: from each time [s] in ``table``'s rows ``[t, y]`` on the value beside it."""

    extrapolation: ClassVar[ac.Option]
    """what holds outside of the table"""
    startTime: ClassVar[ac.Parameter]
    """the output is 0 before [s]"""
    shiftTime: ClassVar[ac.Parameter]
    """time of the table's zero [s]"""
    table: ClassVar[ac.Option]
    """rows of time and value"""
    def __init__(
        self,
        *,
        startTime: SupportsFloat | ac.Start = ...,
        shiftTime: SupportsFloat | ac.Start = ...,
        extrapolation: Literal[
            "HoldLastPoint", "LastTwoPoints", "Periodic", "NoExtrapolation"
        ] = ...,
        table: Any = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LessEqualThreshold(SISO):
    """1 where ``u <= threshold``."""

    threshold: ClassVar[ac.Parameter]
    """value to compare with"""
    def __init__(
        self,
        *,
        threshold: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LessThreshold(SISO):
    """1 where ``u < threshold``."""

    threshold: ClassVar[ac.Parameter]
    """value to compare with"""
    def __init__(
        self,
        *,
        threshold: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Multiplex4(Multiplex3):
    """Vectors ``u1`` to ``u4`` as one."""

    n4: ClassVar[ac.Option]
    """size of u4"""
    u4: ClassVar[ac.Input]
    """fourth input signals"""
    def __init__(
        self,
        *,
        n1: SupportsIndex = ...,
        n2: SupportsIndex = ...,
        n3: SupportsIndex = ...,
        n4: SupportsIndex = ...,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        u3: ac.Start | Mapping[str, Any] = ...,
        u4: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Nand(SI2SO):
    """1 unless ``u1`` and ``u2`` are true."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Nor(SI2SO):
    """1 where neither ``u1`` nor ``u2`` is true."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Or(SI2SO):
    """1 where ``u1`` or ``u2`` is true, or both."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PI(SISO, PartialState):
    """``k (1 + 1/(T s))``: ``der(x) = u/T``, ``y = k (x + u)``."""

    k: ClassVar[ac.Parameter]
    """gain"""
    T: ClassVar[ac.Parameter]
    """time constant [s]"""
    initType: ClassVar[ac.Option]
    """type of initialization"""
    x_start: ClassVar[ac.Parameter]
    """initial or guess value of the state"""
    y_start: ClassVar[ac.Parameter]
    """initial value of the output"""
    x: ClassVar[ac.Variable]
    """state: the integral part"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        x_start: SupportsFloat | ac.Start = ...,
        y_start: SupportsFloat | ac.Start = ...,
        initType: Literal["NoInit", "SteadyState", "InitialState", "InitialOutput"] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Pre(SISO):
    """The input just before an event, ``pre(u)``: it breaks loops of logical blocks."""

    pre_u_start: ClassVar[ac.Option]
    """truth value of the input just before the start"""
    held: ClassVar[ac.Discrete]
    """whether the input is true"""
    def __init__(
        self,
        *,
        pre_u_start: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        held: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Ramp(SignalSource):
    """``y`` rises by ``height`` during ``duration`` [s] and stays there."""

    height: ClassVar[ac.Parameter]
    """height of the ramp"""
    duration: ClassVar[ac.Parameter]
    """duration of the ramp; 0 gives a step [s]"""
    def __init__(
        self,
        *,
        duration: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        height: SupportsFloat | ac.Start = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SecondOrder(SISO, PartialStart):
    """``k/((s/w)**2 + 2 D s/w + 1)``: ``der(y) = yd``, ``der(yd) = w (w (k u - y) - 2 D yd)``."""

    y: ClassVar[ac.Output]
    """output signal"""
    k: ClassVar[ac.Parameter]
    """gain"""
    w: ClassVar[ac.Parameter]
    """angular frequency [rad/s]"""
    D: ClassVar[ac.Parameter]
    """damping"""
    yd_start: ClassVar[ac.Parameter]
    """initial or guess value of the output's derivative"""
    yd: ClassVar[ac.Variable]
    """derivative of the output"""
    def __init__(
        self,
        *,
        w: SupportsFloat | ac.Start = ...,
        D: SupportsFloat | ac.Start = ...,
        y_start: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        yd_start: SupportsFloat | ac.Start = ...,
        initType: Literal["NoInit", "SteadyState", "InitialState", "InitialOutput"] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        yd: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Sign(SISO):
    """``y = sign(u)``; ``generateEvent`` has no effect."""

    generateEvent: ClassVar[ac.Option]
    """without effect"""
    def __init__(
        self,
        *,
        generateEvent: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Sin(SISO):
    """``y = sin(u)``."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class Sinc(SignalSource):
    """``y = offset + amplitude sin(x)/x`` with ``x = 2 pi f (time - startTime)``."""

    amplitude: ClassVar[ac.Parameter]
    """amplitude"""
    f: ClassVar[ac.Parameter]
    """frequency [Hz]"""
    def __init__(
        self,
        *,
        f: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        amplitude: SupportsFloat | ac.Start = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SineVariableFrequencyAndAmplitude(SO):
    """``y = offset + amplitude sin(phi)``, ``der(phi) = 2 pi f``, with inputs ``amplitude``, ``f``."""

    useConstantAmplitude: ClassVar[ac.Option]
    """whether the amplitude is constantAmplitude"""
    constantAmplitude: ClassVar[ac.Parameter]
    """amplitude without input"""
    useConstantFrequency: ClassVar[ac.Option]
    """whether the frequency is constantFrequency"""
    constantFrequency: ClassVar[ac.Parameter]
    """frequency without input [Hz]"""
    offset: ClassVar[ac.Parameter]
    """offset of the output"""
    amplitude: ClassVar[ac.Input]
    """amplitude"""
    f: ClassVar[ac.Input]
    """frequency [Hz]"""
    phi: ClassVar[ac.Variable]
    """phase; its start is the initial phase [rad]"""
    def __init__(
        self,
        *,
        constantAmplitude: SupportsFloat | ac.Start = ...,
        constantFrequency: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        useConstantAmplitude: bool = ...,
        useConstantFrequency: bool = ...,
        amplitude: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Sinh(SISO):
    """``y = sinh(u)``."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class SlewRateLimiter(PartialStart, SISO):
    """Follows the input no faster than allowed: ``der(y) = min(max((u - y)/Td, Falling), Rising)``."""

    y: ClassVar[ac.Output]
    """output signal"""
    initType: ClassVar[ac.Option]
    """type of initialization"""
    Rising: ClassVar[ac.Parameter]
    """greatest rate, in units of the signal per second"""
    Falling: ClassVar[ac.Parameter]
    """least rate"""
    Td: ClassVar[ac.Parameter]
    """time constant of the derivative [s]"""
    strict: ClassVar[ac.Option]
    """without effect"""
    def __init__(
        self,
        *,
        y_start: SupportsFloat | ac.Start = ...,
        Rising: SupportsFloat | ac.Start = ...,
        Falling: SupportsFloat | ac.Start = ...,
        Td: SupportsFloat | ac.Start = ...,
        initType: Literal["NoInit", "SteadyState", "InitialState", "InitialOutput"] = ...,
        strict: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Sqrt(SISO):
    """``y = sqrt(u)``, ``u >= 0``."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class StandardDeviation(Variance):
    """Square root of the `Variance` of the input since ``t_0`` [s]."""
    def __init__(
        self,
        *,
        t_eps: SupportsFloat | ac.Start = ...,
        t_0: SupportsFloat | ac.Start = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        mu: ac.Start | Mapping[str, Any] = ...,
        var: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Step(SignalSource):
    """``y = offset``, from ``startTime`` on ``y = offset + height``."""

    height: ClassVar[ac.Parameter]
    """height of the step"""
    def __init__(
        self,
        *,
        offset: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        height: SupportsFloat | ac.Start = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Tan(SISO):
    """``y = tan(u)``."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class Tanh(SISO):
    """``y = tanh(u)``."""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class To_bar(PartialConversionBlock):
    """Pascals to bars."""

    u: ClassVar[ac.Input]
    """pressure in Pa"""
    y: ClassVar[ac.Output]
    """pressure [bar]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class To_day(PartialConversionBlock):
    """Seconds to days."""

    u: ClassVar[ac.Input]
    """time in s"""
    y: ClassVar[ac.Output]
    """time [d]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class To_deg(PartialConversionBlock):
    """Radians to degrees."""

    u: ClassVar[ac.Input]
    """angle in rad"""
    y: ClassVar[ac.Output]
    """angle [deg]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class To_degC(PartialConversionBlock):
    """Kelvin to degrees Celsius: ``y = u - 273.15``."""

    u: ClassVar[ac.Input]
    """temperature in K"""
    y: ClassVar[ac.Output]
    """temperature [degC]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class To_degF(PartialConversionBlock):
    """Kelvin to degrees Fahrenheit: ``y = 9/5 u - 459.67``."""

    u: ClassVar[ac.Input]
    """temperature in K"""
    y: ClassVar[ac.Output]
    """temperature [degF]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class To_degRk(PartialConversionBlock):
    """Kelvin to degrees Rankine: ``y = 9/5 u``."""

    u: ClassVar[ac.Input]
    """temperature in K"""
    y: ClassVar[ac.Output]
    """temperature [degR]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class To_gps(PartialConversionBlock):
    """Kilograms per second to grams per second."""

    u: ClassVar[ac.Input]
    """mass flow rate in kg/s"""
    y: ClassVar[ac.Output]
    """mass flow rate [g/s]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class To_hour(PartialConversionBlock):
    """Seconds to hours."""

    u: ClassVar[ac.Input]
    """time in s"""
    y: ClassVar[ac.Output]
    """time [h]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class To_kWh(PartialConversionBlock):
    """Joules to kilowatt hours."""

    u: ClassVar[ac.Input]
    """energy in J"""
    y: ClassVar[ac.Output]
    """energy [kW.h]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class To_kmh(PartialConversionBlock):
    """Metres per second to kilometres per hour."""

    u: ClassVar[ac.Input]
    """speed in m/s"""
    y: ClassVar[ac.Output]
    """speed [km/h]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class To_litre(PartialConversionBlock):
    """Cubic metres to litres."""

    u: ClassVar[ac.Input]
    """volume in m3"""
    y: ClassVar[ac.Output]
    """volume [l]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class To_minute(PartialConversionBlock):
    """Seconds to minutes."""

    u: ClassVar[ac.Input]
    """time in s"""
    y: ClassVar[ac.Output]
    """time [min]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class To_rpm(PartialConversionBlock):
    """Radians per second to revolutions per minute."""

    u: ClassVar[ac.Input]
    """angular velocity in rad/s"""
    y: ClassVar[ac.Output]
    """angular velocity [rev/min]"""
    def __init__(
        self, *, u: ac.Start | Mapping[str, Any] = ..., y: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class TruncatedNormalNoise(PartialNoise):
    """Numbers of a normal distribution, ``mu`` and ``sigma``, of which only ``y_min`` to ``y_max`` is left."""

    y_min: ClassVar[ac.Parameter]
    """least value"""
    y_max: ClassVar[ac.Parameter]
    """greatest value"""
    mu: ClassVar[ac.Parameter]
    """mean before it is cut"""
    sigma: ClassVar[ac.Parameter]
    """standard deviation before it is cut"""
    quantile: ClassVar[ac.Module]
    """normal quantile between limits"""
    def __init__(
        self,
        *,
        samplePeriod: SupportsFloat | ac.Start = ...,
        y_off: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        y_min: SupportsFloat | ac.Start = ...,
        y_max: SupportsFloat | ac.Start = ...,
        mu: SupportsFloat | ac.Start = ...,
        sigma: SupportsFloat | ac.Start = ...,
        enableNoise: bool = ...,
        useGlobalSeed: bool = ...,
        useAutomaticLocalSeed: bool = ...,
        fixedLocalSeed: SupportsIndex = ...,
        length: SupportsIndex = ...,
        numbers: Callable[..., Any] = ...,
        quantile: Callable[..., Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class UniformNoise(PartialNoise):
    """Numbers that are equally likely between ``y_min`` and ``y_max``."""

    y_min: ClassVar[ac.Parameter]
    """least value"""
    y_max: ClassVar[ac.Parameter]
    """greatest value"""
    def __init__(
        self,
        *,
        samplePeriod: SupportsFloat | ac.Start = ...,
        y_off: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        y_min: SupportsFloat | ac.Start = ...,
        y_max: SupportsFloat | ac.Start = ...,
        enableNoise: bool = ...,
        useGlobalSeed: bool = ...,
        useAutomaticLocalSeed: bool = ...,
        fixedLocalSeed: SupportsIndex = ...,
        length: SupportsIndex = ...,
        numbers: Callable[..., Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Xor(SI2SO):
    """1 where either ``u1`` or ``u2`` is true, not both."""
    def __init__(
        self,
        *,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class BandLimitedWhiteNoise(PartialNoise):
    """Normal noise of the power ``noisePower`` at all frequencies well below ``1/samplePeriod``."""

    noisePower: ClassVar[ac.Parameter]
    """power of the noise, per hertz and both sides"""
    def __init__(
        self,
        *,
        samplePeriod: SupportsFloat | ac.Start = ...,
        y_off: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        noisePower: SupportsFloat | ac.Start = ...,
        enableNoise: bool = ...,
        useGlobalSeed: bool = ...,
        useAutomaticLocalSeed: bool = ...,
        fixedLocalSeed: SupportsIndex = ...,
        length: SupportsIndex = ...,
        numbers: Callable[..., Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class BooleanChange(Change):
    """True at the moment the input changes."""
    def __init__(
        self,
        *,
        pre_u_start: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        held: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CombiTable1Dv(PartialColumns, MIMOs):
    """Interpolation in rows ``[u, y2, y3, ...]``: output ``y[i]`` is column ``columns[i]`` at ``u[i]``."""
    def __init__(
        self,
        *,
        table: Any = ...,
        tableOnFile: Literal[False, True] = ...,
        tableName: Any = ...,
        fileName: Any = ...,
        delimiter: Any = ...,
        nHeaderLines: SupportsIndex = ...,
        verboseRead: bool = ...,
        verboseExtrapolation: bool = ...,
        columns: Any = ...,
        smoothness: Literal[
            "LinearSegments",
            "ConstantSegments",
            "ContinuousDerivative",
            "ModifiedContinuousDerivative",
            "MonotoneContinuousDerivative1",
            "MonotoneContinuousDerivative2",
        ] = ...,
        extrapolation: Literal[
            "HoldLastPoint", "LastTwoPoints", "Periodic", "NoExtrapolation"
        ] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class CombiTable2Ds(SI2SO, TableData):
    """Interpolation in a table of two arguments: ``y`` is its value at ``u1``, ``u2``."""

    smoothness: ClassVar[ac.Option]
    """kind of interpolation"""
    extrapolation: ClassVar[ac.Option]
    """what holds outside of the table"""
    surface: ClassVar[ac.Module]
    def __init__(
        self,
        *,
        table: Any = ...,
        tableOnFile: Literal[False, True] = ...,
        tableName: Any = ...,
        fileName: Any = ...,
        delimiter: Any = ...,
        nHeaderLines: SupportsIndex = ...,
        verboseRead: bool = ...,
        verboseExtrapolation: bool = ...,
        smoothness: Literal["LinearSegments", "ConstantSegments", "ContinuousDerivative"] = ...,
        extrapolation: Literal[
            "HoldLastPoint", "LastTwoPoints", "Periodic", "NoExtrapolation"
        ] = ...,
        surface: Callable[..., Any] = ...,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class CombiTable2Dv(MI2MO, TableData):
    """The same table for ``n`` pairs of arguments: ``y[i]`` is its value at ``u1[i]``, ``u2[i]``."""

    smoothness: ClassVar[ac.Option]
    """kind of interpolation"""
    extrapolation: ClassVar[ac.Option]
    """what holds outside of the table"""
    surface: ClassVar[ac.Module]
    def __init__(
        self,
        *,
        table: Any = ...,
        tableOnFile: Literal[False, True] = ...,
        tableName: Any = ...,
        fileName: Any = ...,
        delimiter: Any = ...,
        nHeaderLines: SupportsIndex = ...,
        verboseRead: bool = ...,
        verboseExtrapolation: bool = ...,
        smoothness: Literal["LinearSegments", "ConstantSegments", "ContinuousDerivative"] = ...,
        extrapolation: Literal[
            "HoldLastPoint", "LastTwoPoints", "Periodic", "NoExtrapolation"
        ] = ...,
        n: SupportsIndex = ...,
        surface: Callable[..., Any] = ...,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Cosine(SignalSource):
    """``y = offset + amplitude cos(2 pi f (time - startTime) + phase)`` from ``startTime`` on."""

    amplitude: ClassVar[ac.Parameter]
    """amplitude"""
    f: ClassVar[ac.Parameter]
    """frequency [Hz]"""
    phase: ClassVar[ac.Parameter]
    """phase at startTime [rad]"""
    continuous: ClassVar[ac.Option]
    """whether to hold the first value before startTime"""
    def __init__(
        self,
        *,
        f: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        amplitude: SupportsFloat | ac.Start = ...,
        phase: SupportsFloat | ac.Start = ...,
        continuous: bool = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class DeMultiplex5(DeMultiplex4):
    """A vector taken apart into ``y1`` to ``y5``."""

    n5: ClassVar[ac.Option]
    """size of y5"""
    y5: ClassVar[ac.Output]
    """the next"""
    def __init__(
        self,
        *,
        n1: SupportsIndex = ...,
        n2: SupportsIndex = ...,
        n3: SupportsIndex = ...,
        n4: SupportsIndex = ...,
        n5: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y1: ac.Start | Mapping[str, Any] = ...,
        y2: ac.Start | Mapping[str, Any] = ...,
        y3: ac.Start | Mapping[str, Any] = ...,
        y4: ac.Start | Mapping[str, Any] = ...,
        y5: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Integrator(SISO, PartialStart):
    """``der(y) = k u``, from ``y = y_start``."""

    initType: ClassVar[ac.Option]
    """type of initialization"""
    y: ClassVar[ac.Output]
    """output signal"""
    use_reset: ClassVar[ac.Option]
    """whether there is the input reset"""
    use_set: ClassVar[ac.Option]
    """whether there is the input set"""
    reset: ClassVar[ac.Input]
    """when the output is reset"""
    set: ClassVar[ac.Input]
    """what it is reset to"""
    k: ClassVar[ac.Parameter]
    """gain"""
    def __init__(
        self,
        *,
        y_start: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        initType: Literal["NoInit", "SteadyState", "InitialState", "InitialOutput"] = ...,
        use_reset: bool = ...,
        use_set: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        reset: ac.Start | Mapping[str, Any] = ...,
        set: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LimIntegrator(SISO, PartialStart):
    """Integrator that stops at limits: ``der(y) = k u``, but 0 where that leads out of them."""

    initType: ClassVar[ac.Option]
    """type of initialization"""
    y: ClassVar[ac.Output]
    """output signal"""
    use_reset: ClassVar[ac.Option]
    """whether there is the input reset"""
    use_set: ClassVar[ac.Option]
    """whether there is the input set"""
    reset: ClassVar[ac.Input]
    """when the output is reset"""
    set: ClassVar[ac.Input]
    """what it is reset to"""
    k: ClassVar[ac.Parameter]
    """gain"""
    outMax: ClassVar[ac.Parameter]
    """upper limit"""
    outMin: ClassVar[ac.Parameter]
    """lower limit"""
    limitsAtInit: ClassVar[ac.Option]
    """without effect"""
    strict: ClassVar[ac.Option]
    """without effect"""
    def __init__(
        self,
        *,
        outMax: SupportsFloat | ac.Start = ...,
        y_start: SupportsFloat | ac.Start = ...,
        k: SupportsFloat | ac.Start = ...,
        outMin: SupportsFloat | ac.Start = ...,
        initType: Literal["NoInit", "SteadyState", "InitialState", "InitialOutput"] = ...,
        use_reset: bool = ...,
        use_set: bool = ...,
        limitsAtInit: bool = ...,
        strict: bool = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        reset: ac.Start | Mapping[str, Any] = ...,
        set: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Multiplex5(Multiplex4):
    """Vectors ``u1`` to ``u5`` as one."""

    n5: ClassVar[ac.Option]
    """size of u5"""
    u5: ClassVar[ac.Input]
    """fifth input signals"""
    def __init__(
        self,
        *,
        n1: SupportsIndex = ...,
        n2: SupportsIndex = ...,
        n3: SupportsIndex = ...,
        n4: SupportsIndex = ...,
        n5: SupportsIndex = ...,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        u3: ac.Start | Mapping[str, Any] = ...,
        u4: ac.Start | Mapping[str, Any] = ...,
        u5: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class NormalNoise(PartialNoise):
    """Numbers of a normal distribution with the mean ``mu`` and the standard deviation ``sigma``."""

    mu: ClassVar[ac.Parameter]
    """mean"""
    sigma: ClassVar[ac.Parameter]
    """standard deviation"""
    def __init__(
        self,
        *,
        samplePeriod: SupportsFloat | ac.Start = ...,
        y_off: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        mu: SupportsFloat | ac.Start = ...,
        sigma: SupportsFloat | ac.Start = ...,
        enableNoise: bool = ...,
        useGlobalSeed: bool = ...,
        useAutomaticLocalSeed: bool = ...,
        fixedLocalSeed: SupportsIndex = ...,
        length: SupportsIndex = ...,
        numbers: Callable[..., Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Pulse(SignalSource):
    """``amplitude`` for the first ``width`` per cent of each period, else 0, plus ``offset``."""

    amplitude: ClassVar[ac.Parameter]
    """amplitude"""
    period: ClassVar[ac.Parameter]
    """duration of one period [s]"""
    nperiod: ClassVar[ac.Option]
    """number of periods; endless if negative"""
    count: ClassVar[ac.Variable]
    """number of the present period, from 0"""
    T_start: ClassVar[ac.Variable]
    """when it began [s]"""
    width: ClassVar[ac.Parameter]
    """width of the pulse in per cent of the period"""
    def __init__(
        self,
        *,
        period: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        amplitude: SupportsFloat | ac.Start = ...,
        width: SupportsFloat | ac.Start = ...,
        nperiod: SupportsIndex = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        count: ac.Start | Mapping[str, Any] = ...,
        T_start: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SawTooth(SignalSource):
    """Rises from 0 to ``amplitude`` in each period, plus ``offset``."""

    amplitude: ClassVar[ac.Parameter]
    """amplitude"""
    period: ClassVar[ac.Parameter]
    """duration of one period [s]"""
    nperiod: ClassVar[ac.Option]
    """number of periods; endless if negative"""
    count: ClassVar[ac.Variable]
    """number of the present period, from 0"""
    T_start: ClassVar[ac.Variable]
    """when it began [s]"""
    def __init__(
        self,
        *,
        period: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        amplitude: SupportsFloat | ac.Start = ...,
        nperiod: SupportsIndex = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        count: ac.Start | Mapping[str, Any] = ...,
        T_start: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Sine(SignalSource):
    """``y = offset + amplitude sin(2 pi f (time - startTime) + phase)`` from ``startTime`` on."""

    amplitude: ClassVar[ac.Parameter]
    """amplitude"""
    f: ClassVar[ac.Parameter]
    """frequency [Hz]"""
    phase: ClassVar[ac.Parameter]
    """phase at startTime [rad]"""
    continuous: ClassVar[ac.Option]
    """whether to hold the first value before startTime"""
    def __init__(
        self,
        *,
        f: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        amplitude: SupportsFloat | ac.Start = ...,
        phase: SupportsFloat | ac.Start = ...,
        continuous: bool = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TimeTable(SO, TableData):
    """Linear interpolation in rows ``[t, y]``; a repeated time is a jump."""

    timeScale: ClassVar[ac.Parameter]
    """unit of the table's times [s]"""
    startTime: ClassVar[ac.Parameter]
    """the output is the offset before [s]"""
    shiftTime: ClassVar[ac.Parameter]
    """time of the table's zero [s]"""
    passed: ClassVar[ac.Variable]
    """number of jumps and corners that lie behind"""
    offset: ClassVar[ac.Parameter]
    """offset of the output"""
    column: ClassVar[ac.Module]
    def __init__(
        self,
        *,
        timeScale: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        shiftTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        table: Any = ...,
        tableOnFile: Literal[False, True] = ...,
        tableName: Any = ...,
        fileName: Any = ...,
        delimiter: Any = ...,
        nHeaderLines: SupportsIndex = ...,
        verboseRead: bool = ...,
        verboseExtrapolation: bool = ...,
        column: Callable[..., Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        passed: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Trapezoid(SignalSource):
    """In each period: ``rising``, at ``amplitude`` for ``width``, ``falling`` [s], then 0."""

    amplitude: ClassVar[ac.Parameter]
    """amplitude"""
    period: ClassVar[ac.Parameter]
    """duration of one period [s]"""
    nperiod: ClassVar[ac.Option]
    """number of periods; endless if negative"""
    count: ClassVar[ac.Variable]
    """number of the present period, from 0"""
    T_start: ClassVar[ac.Variable]
    """when it began [s]"""
    rising: ClassVar[ac.Parameter]
    """duration of the rise [s]"""
    width: ClassVar[ac.Parameter]
    """duration at the amplitude [s]"""
    falling: ClassVar[ac.Parameter]
    """duration of the fall [s]"""
    def __init__(
        self,
        *,
        period: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        amplitude: SupportsFloat | ac.Start = ...,
        rising: SupportsFloat | ac.Start = ...,
        width: SupportsFloat | ac.Start = ...,
        falling: SupportsFloat | ac.Start = ...,
        nperiod: SupportsIndex = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        count: ac.Start | Mapping[str, Any] = ...,
        T_start: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CombiTimeTable(PartialColumns, MO):
    """Interpolation in rows ``[t, y2, y3, ...]``: output ``y[i]`` is column ``columns[i]``."""

    timeScale: ClassVar[ac.Parameter]
    """unit of the table's times [s]"""
    startTime: ClassVar[ac.Parameter]
    """the output is the offset before [s]"""
    shiftTime: ClassVar[ac.Parameter]
    """time of the table's zero [s]"""
    passed: ClassVar[ac.Variable]
    """number of jumps and corners that lie behind"""
    timeEvents: ClassVar[ac.Option]
    """where steps end in models with events"""
    offset: ClassVar[ac.Parameter]
    """offsets of the outputs, or one for all"""
    def __init__(
        self,
        *,
        timeScale: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        shiftTime: SupportsFloat | ac.Start = ...,
        offset: SupportsFloat | Iterable[Any] = ...,
        table: Any = ...,
        tableOnFile: Literal[False, True] = ...,
        tableName: Any = ...,
        fileName: Any = ...,
        delimiter: Any = ...,
        nHeaderLines: SupportsIndex = ...,
        verboseRead: bool = ...,
        verboseExtrapolation: bool = ...,
        columns: Any = ...,
        smoothness: Literal[
            "LinearSegments",
            "ConstantSegments",
            "ContinuousDerivative",
            "ModifiedContinuousDerivative",
            "MonotoneContinuousDerivative1",
            "MonotoneContinuousDerivative2",
        ] = ...,
        extrapolation: Literal[
            "HoldLastPoint", "LastTwoPoints", "Periodic", "NoExtrapolation"
        ] = ...,
        timeEvents: Literal["Always", "AtDiscontinuities", "NoTimeEvents"] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        passed: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class DeMultiplex6(DeMultiplex5):
    """A vector taken apart into ``y1`` to ``y6``."""

    n6: ClassVar[ac.Option]
    """size of y6"""
    y6: ClassVar[ac.Output]
    """the last"""
    def __init__(
        self,
        *,
        n1: SupportsIndex = ...,
        n2: SupportsIndex = ...,
        n3: SupportsIndex = ...,
        n4: SupportsIndex = ...,
        n5: SupportsIndex = ...,
        n6: SupportsIndex = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y1: ac.Start | Mapping[str, Any] = ...,
        y2: ac.Start | Mapping[str, Any] = ...,
        y3: ac.Start | Mapping[str, Any] = ...,
        y4: ac.Start | Mapping[str, Any] = ...,
        y5: ac.Start | Mapping[str, Any] = ...,
        y6: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Multiplex6(Multiplex5):
    """Vectors ``u1`` to ``u6`` as one."""

    n6: ClassVar[ac.Option]
    """size of u6"""
    u6: ClassVar[ac.Input]
    """sixth input signals"""
    def __init__(
        self,
        *,
        n1: SupportsIndex = ...,
        n2: SupportsIndex = ...,
        n3: SupportsIndex = ...,
        n4: SupportsIndex = ...,
        n5: SupportsIndex = ...,
        n6: SupportsIndex = ...,
        u1: ac.Start | Mapping[str, Any] = ...,
        u2: ac.Start | Mapping[str, Any] = ...,
        u3: ac.Start | Mapping[str, Any] = ...,
        u4: ac.Start | Mapping[str, Any] = ...,
        u5: ac.Start | Mapping[str, Any] = ...,
        u6: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

BooleanMIMOs = MIMOs
BooleanPassThrough = RealPassThrough
BooleanReplicator = Replicator
BooleanSISO = SISO
BooleanSignalSource = SO
IntegerMO = MO
IntegerPassThrough = RealPassThrough
IntegerReplicator = Replicator
IntegerSIBooleanSO = SISO
IntegerSO = SO
IntegerSignalSource = SignalSource
MI2BooleanMOs = MI2MO
PartialBooleanSISO_small = SISO
PartialIntegerSISO = SISO
SI2BooleanSO = SI2SO
partialBooleanComparison = SI2SO
partialBooleanSI = SI
partialBooleanSI2SO = SI2SO
partialBooleanSISO = SISO
partialBooleanSO = SO
partialBooleanSource = SO
partialBooleanThresholdComparison = SISO
