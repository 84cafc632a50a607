"""Bases of blocks: which signals enter and leave. Signals have no unit unless a block says so."""

from collections.abc import Iterator
from typing import Any

import acausal as ac

from .conventions import INIT

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
    """``nout`` outputs ``y``; a subclass says how many."""

    y = ac.Output(shape="nout", doc="output signals")


class MIMO(ac.Component):
    """``nin`` inputs ``u``, ``nout`` outputs ``y``; a subclass says how many."""

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


class SVcontrol(ac.Component):
    """Set point ``u_s`` and measurement ``u_m`` enter, actuator signal ``y`` leaves."""

    u_s = ac.Input(doc="set point")
    u_m = ac.Input(doc="measurement")
    y = ac.Output(doc="actuator signal")


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


class NeedsDiscreteStates(ac.Component):
    """Base of blocks that Modelica has and that cannot be made yet: they remember, or wait for events.

    Raises:
        DeclarationError: always.
    """

    __modelica__ = None

    def __init__(self, **modifiers: Any) -> None:
        raise ac.DeclarationError(
            f"{type(self).__name__} needs discrete states, which acausal does not have yet"
        )
