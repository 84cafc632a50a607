"""Blocks that remember or wait for events, which raise an error since they need discrete states."""

from .interfaces import NeedsDiscreteStates

__modelica__ = "Modelica.Blocks.Logical"


class Pre(NeedsDiscreteStates):
    """Value of a signal just before the present event."""


class Edge(NeedsDiscreteStates):
    """True at the moment the input turns true."""

    __modelica__ = ("Modelica.Blocks.Logical", "Modelica.Blocks.Math")


class FallingEdge(NeedsDiscreteStates):
    """True at the moment the input turns false."""


class Change(NeedsDiscreteStates):
    """True at the moment the input changes."""


class ZeroCrossing(NeedsDiscreteStates):
    """True at the moment the input crosses zero."""


class Hysteresis(NeedsDiscreteStates):
    """Switches on at one level and off at another."""


class OnOffController(NeedsDiscreteStates):
    """Two-point controller with a bandwidth."""


class TriggeredTrapezoid(NeedsDiscreteStates):
    """A trapezoid at every trigger."""


class Timer(NeedsDiscreteStates):
    """Time since the input turned true."""


class LogicalDelay(NeedsDiscreteStates):
    """The input, and the input with a delay."""


class RSFlipFlop(NeedsDiscreteStates):
    """Memory with a set and a reset input."""


class TerminateSimulation(NeedsDiscreteStates):
    """Ends the simulation when a condition turns true."""


class SampleTrigger(NeedsDiscreteStates):
    """True at sample times."""

    __modelica__ = "Modelica.Blocks.Sources"


class RadioButtonSource(NeedsDiscreteStates):
    """A button that others reset."""

    __modelica__ = "Modelica.Blocks.Sources"


class FixedDelay(NeedsDiscreteStates):
    """The input of a while ago; see `PadeDelay` for an approximation."""

    __modelica__ = "Modelica.Blocks.Nonlinear"


class VariableDelay(NeedsDiscreteStates):
    """The input of a while ago, which may change."""

    __modelica__ = "Modelica.Blocks.Nonlinear"
