"""Mathematical blocks that remember or wait for events, which raise an error since they need discrete states."""

from .interfaces import NeedsDiscreteStates

__modelica__ = "Modelica.Blocks.Math"


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
