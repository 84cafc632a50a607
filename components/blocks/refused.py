"""Blocks that remember or wait for events, which are refused for want of discrete states."""

from .interfaces import NeedsDiscreteStates


class Pre(NeedsDiscreteStates):
    """Value of a signal just before the present event."""


class Edge(NeedsDiscreteStates):
    """True at the moment the input turns true."""


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


class MultiSwitch(NeedsDiscreteStates):
    """The expression that belongs to the first input that is true, else the previous value."""


class BooleanChange(NeedsDiscreteStates):
    """True at the moment the input changes."""


class IntegerChange(NeedsDiscreteStates):
    """True at the moment the input changes."""


class Mean(NeedsDiscreteStates):
    """Mean over each period."""


class RectifiedMean(NeedsDiscreteStates):
    """Mean of the absolute value over each period."""


class RootMeanSquare(NeedsDiscreteStates):
    """Root of the mean square over each period."""


class Harmonic(NeedsDiscreteStates):
    """Amplitude and phase of a harmonic over each period."""


class TotalHarmonicDistortion(NeedsDiscreteStates):
    """Distortion over each period."""


class RealFFT(NeedsDiscreteStates):
    """Spectrum of a sampled signal."""


class SignalExtrema(NeedsDiscreteStates):
    """Least and greatest value so far, sampled."""


class ContinuousSignalExtrema(NeedsDiscreteStates):
    """Least and greatest value so far."""


class SampleTrigger(NeedsDiscreteStates):
    """True at sample times."""


class RadioButtonSource(NeedsDiscreteStates):
    """A button that others reset."""


class FixedDelay(NeedsDiscreteStates):
    """The input of a while ago; see `PadeDelay` for an approximation."""


class VariableDelay(NeedsDiscreteStates):
    """The input of a while ago, which may change."""
