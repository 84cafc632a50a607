"""The electrical pin, and the bases that components and users' own elements extend.

A pin's current ``i`` is positive into the component. A one-port's current flows from ``p`` to ``n``, its
voltage is ``v = p.v - n.v``; so ``v i`` is the power that it takes.
"""

from collections.abc import Iterator
from typing import Any, ClassVar

import acausal as ac
from acausal.components import icons
from acausal.components.thermal.interfaces import HeatPort_a

from .laws import contact

__modelica__ = "Modelica.Electrical.Analog.Interfaces"


class Pin(ac.Connector):
    """Potential ``v`` [V] and current ``i`` [A], positive into the component."""

    v = ac.Potential(unit="V", doc="potential at the pin")
    i = ac.Flow(unit="A", doc="current into the pin")

    pair = ("p", "n")
    across = "v"
    through = "i"
    COLOR = "#4a7fd6"


PositivePin = Pin
NegativePin = Pin


class TwoPin(ac.Component):
    """Two pins and the voltage between them: ``v = p.v - n.v`` [V]."""

    p = PositivePin()
    n = NegativePin()
    v = ac.Variable(unit="V", doc="voltage from p to n")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, self.p.v - self.n.v)


class OnePort(TwoPin):
    """Two pins with one current ``i = p.i = -n.i`` [A]; a subclass relates ``v`` and ``i``."""

    i = ac.Variable(unit="A", doc="current from p to n")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(0, self.p.i + self.n.i)
        yield ac.Eq(self.i, self.p.i)


class FourPin(ac.Component):
    """Two pairs of pins: ``v1 = p1.v - n1.v``, ``v2 = p2.v - n2.v``, ``i1 = p1.i``, ``i2 = p2.i``."""

    p1 = PositivePin()
    n1 = NegativePin()
    p2 = PositivePin()
    n2 = NegativePin()
    v1 = ac.Variable(unit="V", doc="voltage from p1 to n1")
    v2 = ac.Variable(unit="V", doc="voltage from p2 to n2")
    i1 = ac.Variable(unit="A", doc="current into p1")
    i2 = ac.Variable(unit="A", doc="current into p2")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v1, self.p1.v - self.n1.v)
        yield ac.Eq(self.v2, self.p2.v - self.n2.v)
        yield ac.Eq(self.i1, self.p1.i)
        yield ac.Eq(self.i2, self.p2.i)


class TwoPort(FourPin):
    """Two ports: what enters ``p1`` leaves at ``n1``, what enters ``p2`` at ``n2``."""

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(0, self.p1.i + self.n1.i)
        yield ac.Eq(0, self.p2.i + self.n2.i)


class ConditionalHeatPort(ac.Component):
    """A component that dissipates ``LossPower`` [W], and may hand it to a heat port.

    With ``useHeatPort`` there is a connector ``heatPort``: ``heatPort.Q_flow = -LossPower`` and
    ``T_heatPort = heatPort.T``. Without, ``T_heatPort = T``. A subclass states ``LossPower``.
    """

    useHeatPort = ac.Option(False, doc="whether there is a heat port")
    T = ac.Parameter(293.15, unit="K", min=0, doc="temperature of the device without heat port")
    heatPort = HeatPort_a(when="_heated")
    LossPower = ac.Variable(unit="W", doc="power that leaves as heat")
    T_heatPort = ac.Variable(unit="K", start=288.15, nominal=300.0, doc="temperature of the device")

    @property
    def _heated(self) -> bool:
        """Whether there is a heat port."""
        return self.useHeatPort

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.T_heatPort, self.heatPort.T if self._heated else self.T)
        if self._heated:
            yield ac.Eq(self.heatPort.Q_flow, -self.LossPower)


class IdealSemiconductor(OnePort, ConditionalHeatPort):
    """An ideal characteristic with a knee, along which the parameter ``s`` runs; ``LossPower = v i``.

    Conducting ``v = Ron s + Vknee``, ``i = s + Goff Vknee``; blocking (``off``) ``v = s + Vknee``,
    ``i = Goff (s + Vknee)``. A subclass says when it blocks; steps end where it begins or ceases to. ``off`` is
    1 while blocking, else 0.
    """

    ICON = icons.IDEAL_DIODE

    Ron = ac.Parameter(1e-5, unit="Ohm", min=0, doc="resistance while conducting")
    Goff = ac.Parameter(1e-5, unit="S", min=0, doc="conductance while blocking")
    Vknee = ac.Parameter(0.0, unit="V", min=0, doc="forward threshold voltage")
    off = ac.Discrete(True, kind="bool", doc="1 while blocking, else 0")
    s = ac.Variable(doc="position on the characteristic; the knee is at 0")

    @property
    def _blocks(self) -> Any:
        """The condition for blocking."""
        raise NotImplementedError

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.off, ac.where(self._blocks, 1, 0))
        yield ac.Eq(self.v, self.s * ac.where(self.off, 1, self.Ron) + self.Vknee)
        yield ac.Eq(self.i, self.s * ac.where(self.off, self.Goff, 1) + self.Goff * self.Vknee)
        yield ac.Eq(self.LossPower, self.v * self.i)


class IdealSwitch(OnePort, ConditionalHeatPort):
    """A switch: ``i = Goff v`` while open (``off``), ``v = Ron i`` while closed; ``LossPower = v i``.

    ``Ron`` or ``Goff`` may be zero where the circuit allows it. A subclass says when it is open; steps end where
    that changes. ``off`` is 1 while open, else 0.
    """

    ICON = icons.CLOSING

    Ron = ac.Parameter(1e-5, unit="Ohm", min=0, doc="resistance while closed")
    Goff = ac.Parameter(1e-5, unit="S", min=0, doc="conductance while open")
    off = ac.Discrete(False, kind="bool", doc="1 while open, else 0")

    @property
    def _open(self) -> Any:
        """The condition for being open."""
        raise NotImplementedError

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.Eq(self.off, ac.where(self._open, 1, 0))
        yield contact(self.off, self.v, self.i, self.Ron, self.Goff)
        yield ac.Eq(self.LossPower, self.v * self.i)


class _Source(OnePort):
    """A source whose law is a block of `acausal.components.blocks`, its part ``signalSource``."""

    startTime = ac.Parameter(0.0, unit="s", doc="start of the signal")

    forwarded: ClassVar[tuple[str, ...]] = ()
    """Options that are the block's own."""

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.signalSource = self._signal()
        self.signalSource.modify(offset=self.offset, startTime=self.startTime)
        self.modify(**{name: getattr(self, name) for name in self.forwarded})

    def _signal(self) -> ac.Component:
        """The block, without ``offset`` and ``startTime``."""
        raise NotImplementedError

    def modify(self, **modifiers: Any) -> None:
        super().modify(**modifiers)
        if "signalSource" in self._node.children:
            passed = {name: modifiers[name] for name in self.forwarded if name in modifiers}
            self.signalSource.modify(**passed)


class VoltageSource(_Source):
    """A voltage that follows a signal: ``v = signalSource.y``, with ``offset`` and ``startTime``."""

    ICON = icons.VOLTAGE

    offset = ac.Parameter(0.0, unit="V", doc="offset of the voltage")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, self.signalSource.y)


class CurrentSource(_Source):
    """A current that follows a signal: ``i = signalSource.y``, with ``offset`` and ``startTime``."""

    ICON = icons.CURRENT

    offset = ac.Parameter(0.0, unit="A", doc="offset of the current")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.i, self.signalSource.y)
