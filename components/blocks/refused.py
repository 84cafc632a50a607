"""Blocks that need the past of a signal, or a buffer of samples, and raise an error."""

from .interfaces import NeedsDiscreteStates

__modelica__ = "Modelica.Blocks.Nonlinear"


class FixedDelay(NeedsDiscreteStates):
    """The input of a while ago; see `PadeDelay` for an approximation."""

    needs, instead = "the past of a signal", "; PadeDelay is an approximation"


class VariableDelay(NeedsDiscreteStates):
    """The input of a while ago, which may change."""

    needs, instead = "the past of a signal", "; PadeDelay is an approximation"


class RealFFT(NeedsDiscreteStates):
    """Spectrum of a sampled signal."""

    __modelica__ = "Modelica.Blocks.Math"

    needs = "a Fourier transform"
