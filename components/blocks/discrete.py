"""Sampled blocks (`Modelica.Blocks.Discrete`), which raise an error since they need discrete states."""

from .interfaces import NeedsDiscreteStates

__modelica__ = "Modelica.Blocks.Discrete"


class Sampler(NeedsDiscreteStates):
    """The input at sample times."""


class ZeroOrderHold(NeedsDiscreteStates):
    """The input at sample times, held in between."""


class FirstOrderHold(NeedsDiscreteStates):
    """Straight on from the last two samples."""


class UnitDelay(NeedsDiscreteStates):
    """The previous sample."""


class TransferFunction(NeedsDiscreteStates):
    """A transfer function in z."""


class StateSpace(NeedsDiscreteStates):
    """A state space system in z."""


class TriggeredSampler(NeedsDiscreteStates):
    """The input at the times of a trigger."""


class TriggeredMax(NeedsDiscreteStates):
    """The greatest absolute value at the times of a trigger."""
