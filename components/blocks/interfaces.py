"""Bases of blocks: which signals enter and leave. Signals have no unit unless a block says so."""

from collections.abc import Iterator, Sequence
from typing import Any

import acausal as ac

from .conventions import INIT, SMALL, first_true

__modelica__ = "Modelica.Blocks.Interfaces"


RealInput = RealVectorInput = ac.Input
RealOutput = RealVectorOutput = ac.Output
IntegerInput = IntegerVectorInput = BooleanInput = BooleanVectorInput = ac.Input
IntegerOutput = BooleanOutput = ac.Output


class SO(ac.Component):
    """One output ``y``."""

    y = ac.Output(doc="output signal")


class SI(ac.Component):
    """One input ``u``."""

    __modelica__ = None

    u = ac.Input(doc="input signal")


class SISO(ac.Component):
    """One input ``u``, one output ``y``."""

    u = ac.Input(doc="input signal")
    y = ac.Output(doc="output signal")


class SI2SO(ac.Component):
    """Two inputs ``u1`` and ``u2``, one output ``y``."""

    u1 = ac.Input(doc="first input signal")
    u2 = ac.Input(doc="second input signal")
    y = ac.Output(doc="output signal")


class MISO(ac.Component):
    """``nin`` inputs ``u``, one output ``y``."""

    nin = ac.Option(1, doc="number of inputs")
    u = ac.Input(shape="nin", doc="input signals")
    y = ac.Output(doc="output signal")


class MO(ac.Component):
    """``nout`` outputs ``y``."""

    nout = ac.Option(1, doc="number of outputs")
    y = ac.Output(shape="nout", doc="output signals")


class MIMO(ac.Component):
    """``nin`` inputs ``u``, ``nout`` outputs ``y``."""

    nin = ac.Option(1, doc="number of inputs")
    nout = ac.Option(1, doc="number of outputs")
    u = ac.Input(shape="nin", doc="input signals")
    y = ac.Output(shape="nout", doc="output signals")


class MIMOs(ac.Component):
    """``n`` inputs ``u``, as many outputs ``y``."""

    n = ac.Option(1, doc="number of inputs and of outputs")
    u = ac.Input(shape="n", doc="input signals")
    y = ac.Output(shape="n", doc="output signals")


class MI2MO(ac.Component):
    """``n`` inputs ``u1``, ``n`` inputs ``u2``, ``n`` outputs ``y``."""

    n = ac.Option(1, doc="number of inputs of each kind and of outputs")
    u1 = ac.Input(shape="n", doc="first input signals")
    u2 = ac.Input(shape="n", doc="second input signals")
    y = ac.Output(shape="n", doc="output signals")


class SIMO(ac.Component):
    """One input ``u``, ``nout`` outputs ``y``."""

    nout = ac.Option(1, doc="number of outputs")
    u = ac.Input(doc="input signal")
    y = ac.Output(shape="nout", doc="output signals")


class PartialBooleanMISO(ac.Component):
    """``nu`` inputs ``u`` that are truth values, one output ``y``."""

    nu = ac.Option(0, doc="number of inputs")
    u = ac.Input(shape="nu", doc="input signals, 1 or 0")
    y = ac.Output(doc="output signal, 1 or 0")


class Switching(ac.Component):
    """What switches share: ``nu`` inputs ``u``, each with a value in ``expr`` for when it is the first that is true.

    The values are given as a list, or stated by equations of the enclosing model.
    """

    __modelica__ = None

    nu = ac.Option(0, doc="number of inputs")
    u = ac.Input(shape="nu", doc="input signals, 1 or 0")
    expr = ac.Variable(shape="nu", doc="output for each")

    def __init__(self, *, expr: Sequence[Any] | None = None, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.given = None if expr is None else [int(v) if isinstance(v, bool) else v for v in expr]
        if self.given is not None and len(self.given) != self.nu:
            raise ac.DeclarationError(
                f"{type(self).__name__}: expr has {len(self.given)} values for nu={self.nu} inputs; give one for each"
            )

    def _chosen(self, otherwise: Any) -> Any:
        """The value that belongs to the first input that is true."""
        return first_true(self.u, self.expr, otherwise)

    def equations(self) -> Iterator[Any]:
        for value, given in zip(self.expr, self.given or (), strict=False):
            yield ac.Eq(value, given)


class PartialRealMISO(PartialBooleanMISO):
    """``nu`` inputs ``u``, one output ``y``."""

    significantDigits = ac.Option(3, doc="without effect")


class PartialIntegerMISO(PartialBooleanMISO):
    """``nu`` inputs ``u`` that are integers, one output ``y``."""


class IntegerMIBooleanMOs(MIMOs):
    """``n`` inputs ``u`` that are integers, ``n`` outputs ``y`` that are truth values."""


class partialBooleanSI3SO(SI2SO):  # noqa: N801 (Modelica's name)
    """Three inputs ``u1``, ``u2``, ``u3``, one output ``y``."""

    u3 = ac.Input(doc="third input signal")


class SVcontrol(ac.Component):
    """Set point ``u_s`` and measurement ``u_m`` enter, actuator signal ``y`` leaves."""

    u_s = ac.Input(doc="set point")
    u_m = ac.Input(doc="measurement")
    y = ac.Output(doc="actuator signal")


class MVcontrol(ac.Component):
    """A controller of ``n`` signals: set points ``u_s`` and measurements ``u_m`` enter, actuators ``y`` leave."""

    n = ac.Option(1, doc="number of signals of each kind")
    u_s = ac.Input(shape="n", doc="set points")
    u_m = ac.Input(shape="n", doc="measurements")
    y = ac.Output(shape="n", doc="actuator signals")


class SignalSource(SO):
    """One output that is ``offset`` before ``startTime`` [s]."""

    offset = ac.Parameter(0.0, doc="offset of the output")
    startTime = ac.Parameter(0.0, unit="s", doc="the output is the offset before")


class PartialStart(ac.Component):
    """What blocks with one state ``y`` share: ``initType`` and ``y_start``.

    ``SteadyState``: ``der(y) = 0``; ``InitialState`` and ``InitialOutput``: ``y = y_start``;
    ``NoInit``: ``y_start`` is a guess.
    """

    __modelica__ = None

    initType = ac.Option("NoInit", choices=INIT, doc="type of initialization")
    y_start = ac.Parameter(0.0, doc="initial or guess value of the output")
    y = ac.Output(start="y_start", doc="output signal")

    def initial_equations(self) -> Iterator[ac.Eq]:
        if self.initType == "SteadyState":
            yield ac.Eq(ac.der(self.y), 0)
        elif self.initType != "NoInit":
            yield ac.Eq(self.y, self.y_start)


class PartialState(ac.Component):
    """The initial equations of blocks with one state ``x``, by ``initType``.

    ``SteadyState``: ``der(x) = 0``; ``InitialState``: ``x = x_start``; ``InitialOutput``: ``y = y_start``;
    ``NoInit``: ``x_start`` is a guess.
    """

    __modelica__ = None

    initType: Any
    x_start: Any
    y_start: Any
    x: Any
    y: Any

    def initial_equations(self) -> Iterator[ac.Eq]:
        match self.initType:
            case "SteadyState":
                yield ac.Eq(ac.der(self.x), 0)
            case "InitialState":
                yield ac.Eq(self.x, self.x_start)
            case "InitialOutput":
                yield ac.Eq(self.y, self.y_start)
            case _:
                pass


class DiscreteBlock(ac.Component):
    """What sampled blocks share: ``sampleTrigger`` is true at ``startTime + k samplePeriod``, k = 0, 1, ...

    ``firstTrigger`` is true from the first of these instants to the second.
    """

    samplePeriod = ac.Parameter(
        unit="s", min=SMALL, doc="time between two samples, greater than zero"
    )
    startTime = ac.Parameter(0.0, unit="s", doc="first sample time")
    sampleTrigger = ac.Variable(doc="true at sample times")
    firstTrigger = ac.Discrete(kind="bool", doc="true after the first sample")

    @property
    def _sampling(self) -> Any:
        return ac.sample(self.startTime, self.samplePeriod)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.sampleTrigger, self._sampling)
        first = ac.time <= self.startTime + self.samplePeriod / 2
        yield ac.When(self._sampling, ac.Eq(self.firstTrigger, ac.where(first, 1, 0)))


class DiscreteSISO(DiscreteBlock):
    """A sampled block with one input ``u`` and one output ``y``."""

    u = ac.Input(doc="continuous input signal")
    y = ac.Output(doc="sampled output signal")


class DiscreteMIMO(DiscreteBlock):
    """A sampled block with ``nin`` inputs ``u`` and ``nout`` outputs ``y``; a subclass says how many."""

    u = ac.Input(shape="nin", doc="continuous input signals")
    y = ac.Output(shape="nout", doc="sampled output signals")


class DiscreteMIMOs(DiscreteBlock):
    """A sampled block with ``n`` inputs ``u`` and as many outputs ``y``."""

    n = ac.Option(1, doc="number of inputs and of outputs")
    u = ac.Input(shape="n", doc="continuous input signals")
    y = ac.Output(shape="n", doc="sampled output signals")


class SVdiscrete(DiscreteBlock):
    """A sampled controller: set point ``u_s`` and measurement ``u_m`` enter, actuator signal ``y`` leaves."""

    u_s = ac.Input(doc="set point")
    u_m = ac.Input(doc="measurement")
    y = ac.Output(doc="actuator signal")


class MVdiscrete(DiscreteBlock):
    """A sampled controller of ``n`` signals."""

    n = ac.Option(1, doc="number of signals of each kind")
    u_s = ac.Input(shape="n", doc="set points")
    u_m = ac.Input(shape="n", doc="measurements")
    y = ac.Output(shape="n", doc="actuator signals")


class NeedsDiscreteStates(ac.Component):
    """Base of blocks that Modelica has and that cannot be made yet: they need more than states and events.

    Raises:
        DeclarationError: always.
    """

    __modelica__ = None

    needs = "discrete states"
    instead = ""

    def __init__(self, **modifiers: Any) -> None:
        raise ac.DeclarationError(
            f"{type(self).__name__} needs {self.needs}, which acausal does not have yet{self.instead}"
        )


BooleanSISO = partialBooleanSISO = PartialBooleanSISO_small = SISO
PartialIntegerSISO = IntegerSIBooleanSO = partialBooleanThresholdComparison = SISO
partialBooleanSI = SI
SI2BooleanSO = partialBooleanSI2SO = partialBooleanComparison = SI2SO
IntegerSO = partialBooleanSO = partialBooleanSource = BooleanSignalSource = SO
IntegerSignalSource = SignalSource
IntegerMO = MO
BooleanMIMOs = MIMOs
MI2BooleanMOs = MI2MO
