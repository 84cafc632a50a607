"""Neural dampers and resistors: what dissipates."""

from collections.abc import Callable, Iterator
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.thermal import HeatPort

from .choices import ZERO_CROSSING
from .interfaces import PartialNeural
from .units import across_unit, per_second


class Resistance(PartialNeural):
    """A neural damper or resistor.

    Where the potential is a position, ``f = net(v_rel)`` with ``v_rel = der(s_rel)``. Elsewhere ``i = net(v)``. Without
    further options the network is the paper's, which promises nothing. These hold for all weights:

    - ``passive=True``: ``net(x) x >= 0``. A damper never drives, a resistor never delivers; between heat ports heat
      flows from hot to cold.
    - ``monotone=True``: the law never falls. With ``floor`` it rises by at least ``floor output_scale / input_scale``.
    - ``odd=True``: ``net(-x) = -net(x)``.
    - ``zero_crossing``: ``"offset"`` is ``net(x) - net(0)``, the paper's (5), already in training; ``"exact"`` is zero
      at zero to the last bit. ``"regularizer"`` leaves it to `acausal.ZeroCrossing` in training, the paper's (4), (6).
    - ``extrapolation="saturating"``, ``"linear"`` or ``"cubic"`` beyond ``limits``.

    They combine: see `acausal.networks.Law`. With ``useHeatPort``, for passive laws in domains where difference
    times flow is a power, ``lossPower`` leaves at ``heatPort``. See `PartialNeural` for the other arguments.
    """

    ICON = icons.network("R")

    passive = ac.Option(False, doc="the law has the sign of its first input")
    monotone = ac.Option(False, doc="the law never falls")
    zero_crossing = ac.Option(None, choices=ZERO_CROSSING, doc="how the law comes to vanish at 0")
    floor = ac.Option(0.0, doc="least derivative of a monotone law, relative to that of the scales")
    useHeatPort = ac.Option(False, doc="whether there is a heat port")
    heatPort = HeatPort(when="useHeatPort")
    lossPower = ac.Variable(unit="W", when="useHeatPort", doc="power that leaves as heat")
    promises = (*PartialNeural.promises, "passive", "monotone", "zero_crossing", "floor")

    def modify(self, **modifiers: Any) -> None:
        """Change modifiers; raises an error for promises that contradict each other."""
        super().modify(**modifiers)
        if self.useHeatPort and not (self.passive and self.connector.power):
            missing = "passive=True" if self.connector.power else "a domain whose flow has a power"
            raise ac.DeclarationError(
                f"{self._node.label}: a heat port takes the power that is lost; useHeatPort=True needs {missing}"
            )

    def _declare(self) -> None:
        super()._declare()
        if self.connector.rate is not None:
            unit = per_second(across_unit(self.connector))
            setattr(self, self.connector.rate, ac.Variable(unit=unit, doc="rate of the difference"))

    def _spec(self) -> Callable[[Any], Any]:
        return ac.networks.Law(
            passive=self.passive,
            monotone=self.monotone,
            zero_crossing=self.zero_crossing,
            floor=self.floor,
            **self._sizes,
        )

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        drive = self._across
        if self.connector.rate is not None:
            drive = getattr(self, self.connector.rate)
            yield ac.Eq(drive, ac.der(self._across))
        yield ac.Eq(self._through, self._law(drive))
        if self.useHeatPort:
            yield ac.Eq(self.lossPower, drive * self._through)
            yield ac.Eq(self.heatPort.Q_flow, -self.lossPower)
