"""Ideal elements that remember or wait for events, which raise an error since they need discrete states."""

from acausal.components.blocks.interfaces import NeedsDiscreteStates

__modelica__ = "Modelica.Electrical.Analog.Ideal"


class IdealThyristor(NeedsDiscreteStates):
    """Ideal thyristor: it conducts from when it is fired until the current vanishes."""


class IdealTriac(NeedsDiscreteStates):
    """Two ideal thyristors in opposite directions."""


class OpenerWithArc(NeedsDiscreteStates):
    """Contact that a signal opens, with an arc after it opens."""


class CloserWithArc(NeedsDiscreteStates):
    """Contact that a signal closes, with an arc after it opens."""


class ControlledOpenerWithArc(NeedsDiscreteStates):
    """Contact that a pin opens, with an arc after it opens."""


class ControlledCloserWithArc(NeedsDiscreteStates):
    """Contact that a pin closes, with an arc after it opens."""


class AD_Converter(NeedsDiscreteStates):  # noqa: N801 (Modelica's name)
    """Converter from a voltage to digital signals, triggered by an edge."""


class DA_Converter(NeedsDiscreteStates):  # noqa: N801
    """Converter from digital signals to a voltage, triggered by an edge."""
