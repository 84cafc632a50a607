"""Neural springs and capacitors: what stores energy in a displacement."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.translational import Flange

from .choices import FLOOR, ZERO_CROSSING
from .interfaces import PartialNeural
from .units import across_unit, flow_unit, product_unit


class Compliance(PartialNeural):
    """A neural spring or capacitor.

    Where the potential is a position, ``f = net(s_rel)``. Elsewhere the network gives what is stored,
    ``q = net(v)``, and the flow is its derivative, ``i = der(q)``. There a secondary input must be differentiable, and
    the derivative of the network, together with what is connected in parallel, must not vanish.

    The options are those of a `Resistance`. ``passive=True`` means that the element never gives back more than it
    took; where something is stored that takes ``monotone=True``, too.

    With ``energy=True`` the network is an energy, and the law its derivative: ``f = net'(s_rel)``, where
    ``E = net(s_rel)`` is stored; elsewhere ``q = net'(v)``, where the network is the co-energy and
    ``E = v q - net(v)``. Then ``convex=True`` makes the law monotone and a rest position stable, and ``passive=True``
    makes ``E >= 0``, with no energy and no force at zero. See `acausal.networks.Energy`, and `PartialNeural` for the
    other arguments.

    A monotone or convex law of what is stored rises by at least ``floor output_scale / input_scale``, so that it can be
    solved for the difference; ``floor`` is 1e-3 there, where none is given. It starts near a derivative of
    ``output_scale / input_scale``.
    """

    ICON = icons.network("c")

    passive = ac.Option(False, doc="it never gives back more energy than it took")
    monotone = ac.Option(False, doc="the law never falls; of an energy say convex")
    convex = ac.Option(False, doc="the energy is convex")
    zero_crossing = ac.Option(None, choices=ZERO_CROSSING, doc="how the law comes to vanish at 0")
    floor = ac.Option(None, doc="least derivative of the law, relative to that of the scales")
    promises = (*PartialNeural.promises, "passive", "monotone", "convex", "zero_crossing", "floor")

    def __init__(
        self,
        connector: type[ac.Connector] = Flange,
        *,
        energy: bool = False,
        secondary: int | Sequence[str] = (),
        **modifiers: Any,
    ) -> None:
        self.energy = energy
        super().__init__(connector, secondary=secondary, **modifiers)

    def _declare(self) -> None:
        super()._declare()
        kind = self.connector
        stored = product_unit(flow_unit(kind), "s")
        if not self._is_mechanical:
            self.q = ac.Variable(unit=stored, doc="what is stored")
        if self.energy:
            flow = flow_unit(kind) if self._is_mechanical else stored
            self.E = ac.Variable(unit=product_unit(across_unit(kind), flow), doc="stored energy")

    def _spec(self) -> Callable[[Any], Any]:
        rising = self.convex if self.energy else self.monotone
        if self.energy and self.monotone:
            raise ac.DeclarationError("the law of an energy is monotone with convex=True; say that")
        if self.convex and not self.energy:
            raise ac.DeclarationError(
                "convex=True speaks of an energy; say energy=True, too, or monotone=True of the law"
            )
        if self.passive and not (rising or self._is_mechanical):
            missing = "convex" if self.energy else "monotone"
            raise ac.DeclarationError(
                f"passive=True is for laws that rise where something is stored; say {missing}=True, too"
            )
        divided = rising and not self._is_mechanical
        floor = FLOOR if divided else 0.0
        given: dict[str, Any] = {
            **self._sizes,
            "passive": self.passive,
            "zero_crossing": self.zero_crossing,
            "floor": floor if self.floor is None else self.floor,
            "start": 1.0 if divided else 0.0,
        }
        if self.energy:
            return ac.networks.Energy(convex=self.convex, **given)
        return ac.networks.Law(monotone=self.monotone, **given)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        x, function = self._across, self._law(self._across)
        law = function.diff(x) if self.energy else function
        if self._is_mechanical:
            yield ac.Eq(self._through, law)
        else:
            yield ac.Eq(self.q, law)
            yield ac.Eq(self._through, ac.der(law))
        if self.energy:
            yield ac.Eq(self.E, function if self._is_mechanical else x * law - function)
