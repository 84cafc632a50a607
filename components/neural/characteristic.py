"""A neural signal block: characteristics of sensors, actuators and maps."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import acausal as ac
from acausal.components import icons

from .choices import ZERO_CROSSING
from .interfaces import PartialLaw, _named


class Characteristic(PartialLaw):
    """A learned characteristic between signals: ``y = net(u)``.

    For example the curve of a sensor or of an actuator. With ``secondary`` inputs it is a map, ``y = net(u, T, ...)``.
    Without further options the network promises nothing; ``monotone=True``, ``odd=True``, ``zero_crossing`` and
    ``extrapolation`` hold for all weights, as of a `Resistance`.

    Arguments:
        secondary: names of further signal inputs of the network, such as ``("T",)``; or how many,
            named ``u1``, ``u2`` and so on.
        net: another network: a module called with scalars, or a function ``key -> module``.
        modifiers: options.

    Raises:
        DeclarationError: in one sentence, for options that do not go together.
    """

    ICON = icons.network("y(u)")

    monotone = ac.Option(False, doc="the characteristic never falls")
    zero_crossing = ac.Option(None, choices=ZERO_CROSSING, doc="how it comes to vanish at 0")
    floor = ac.Option(
        0.0, doc="least derivative of a monotone characteristic, relative to that of the scales"
    )
    start = ac.Option(
        0.0,
        doc="derivative that a new monotone characteristic has in addition, relative likewise; it is trained",
    )
    u = ac.Input(doc="input signal")
    y = ac.Output(doc="output signal")
    promises = (*PartialLaw.promises, "monotone", "zero_crossing", "floor", "start")

    def __init__(self, *, secondary: int | Sequence[str] = (), **modifiers: Any) -> None:
        self.secondary = _named(secondary)
        self._declare_secondary()
        super().__init__(**modifiers)

    def _spec(self) -> Callable[[Any], Any]:
        return ac.networks.Law(
            monotone=self.monotone,
            zero_crossing=self.zero_crossing,
            floor=self.floor,
            start=self.start,
            **self._sizes,
        )

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.y, self._law(self.u))
