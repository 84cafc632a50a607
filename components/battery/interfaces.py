"""The charge port, and the base of elements whose law depends on charge and temperature."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import nature
from acausal.components.electrical.interfaces import ConditionalHeatPort

__modelica__ = None


class ChargePort(ac.Connector):
    """State of charge ``soc`` (0 empty, 1 full) and the current ``i`` [A] that brings charge into the component."""

    soc = ac.Potential(unit="1", start=0.5, doc="state of charge at the port")
    i = ac.Flow(unit="A", doc="charging current into the port")

    pair = ("port_a", "port_b")
    across = "dsoc"
    through = "i"
    power = False
    COLOR = "#8f6fc4"


class PartialThermal(ConditionalHeatPort):
    """Base of elements that depend on the temperature by Arrhenius' law, with the activation energy ``E_a``."""

    E_a = ac.Parameter(0.0, unit="J/mol", doc="activation energy")
    T_ref = ac.Parameter(298.15, unit="K", min=0, doc="temperature at which parameters hold")
    T = ac.Parameter(lambda self: self.T_ref, unit="K", doc="temperature without heat port")

    @property
    def _warmth(self) -> Any:
        """``T_ref/T - 1``: zero at the reference temperature, and negative above."""
        return self.T_ref / self.T_heatPort - 1


class PartialLearned(PartialThermal):
    """Base of elements with a positive factor: ``exp(net(soc, T_ref/T - 1))`` if it is ``learned``, else 1.

    Arguments:
        net: another network: a module called with both numbers, or a function ``key -> module``.
        modifiers: options and parameters.
    """

    learned = ac.Option(True, doc="whether a network says how the element depends on charge")
    width = ac.Option(6, doc="neurons of the network's hidden layer")
    net = ac.Module("_fresh", unit="1", takes=("1", "1"), doc="logarithm of the factor")

    def _fresh(self, key: Any) -> Any:
        """A network that is nearly zero, so that the factor starts at 1."""
        scale = (0.5, 0.05)
        return ac.MLP(2, self.width, 1, "tanh", input_scale=scale, last_layer=0.05, key=key)

    def _factor(self, soc: Any) -> Any:
        """How much slower or more resistive than Arrhenius' law the element is, at a state of charge."""
        arrhenius = ac.exp(self.E_a / (nature.R * self.T_ref) * self._warmth)
        return arrhenius * ac.exp(self.net(soc, self._warmth)) if self.learned else arrhenius


class PartialDepending(PartialLearned):
    """The same, where the state of charge is a signal ``soc``, if the factor is ``learned``.

    Connect it with ``soc_surface`` of an `OpenCircuitVoltage`, say.
    """

    soc = ac.Input(unit="1", when="learned", doc="state of charge")

    @property
    def _slowing(self) -> Any:
        """The factor at the state of charge of the signal."""
        return self._factor(self.soc if self.learned else None)


class PartialDiffusion(PartialLearned):
    """Base of elements between two charge ports: ``dsoc = port_a.soc - port_b.soc``, ``i`` flows from a to b.

    Besides, it has a temperature, at no heat: how far diffusion heats the cell an `OpenCircuitVoltage` says.
    """

    port_a = ChargePort()
    port_b = ChargePort()
    dsoc = ac.Variable(unit="1", doc="difference of the states of charge")
    i = ac.Variable(unit="A", doc="current from port_a to port_b")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.dsoc, self.port_a.soc - self.port_b.soc)
        yield ac.Eq(self.port_a.i, self.i)
        yield ac.Eq(self.port_b.i, -self.i)
        yield ac.Eq(self.LossPower, 0)
