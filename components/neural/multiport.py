"""A neural element that stores energy in several displacements at once."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.translational import Flange

from .interfaces import PartialNetwork, PartialTwoPort
from .units import across_unit, flow_unit, product_unit


class CompliancePort(PartialTwoPort):
    """A port of a `MultiportCompliance`: two connectors of one domain, and its displacement ``x``.

    Where the potential is a position, ``x`` is the difference of the positions, and the effort ``e`` the force.
    Elsewhere ``der(x)`` is the flow, so ``x`` is a charge or the like, and ``e`` the difference of the potentials.
    """

    ICON = icons.block("port")

    def _declare(self) -> None:
        super()._declare()
        kind = self.connector
        across, flow = across_unit(kind), flow_unit(kind)
        units = (across, flow) if self._is_mechanical else (product_unit(flow, "s"), across)
        state = "default" if self._is_mechanical else "prefer"
        self.x = ac.Variable(unit=units[0], state=state, doc="displacement")
        self.e = ac.Variable(unit=units[1], doc="effort")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        if self._is_mechanical:
            yield ac.Eq(self.x, self._across)
            yield ac.Eq(self._through, self.e)
        else:
            yield ac.Eq(self._through, ac.der(self.x))
            yield ac.Eq(self._across, self.e)


class MultiportCompliance(PartialNetwork):
    """A neural compliance of several ports: one energy, ``E = net(x_1, x_2, ...)``, and its gradient.

    The effort at port ``i`` is ``ports[i].e = dE/dx_i``: the element is conservative for all weights, the
    stiffness matrix symmetric. With one domain at each port it converts energy without loss, as a piezo stack or a
    capacitor with a movable plate does. ``passive=True`` makes ``E >= 0``, with no energy and no effort at zero;
    ``convex=True`` makes a rest position stable; ``odd=True`` makes the efforts odd in all displacements together.

    Arguments:
        connectors: connector class of every port. The ports are ``ports[0]``, ``ports[1]``, ...; each has the two
            connectors of its domain (`CompliancePort`).
        secondary: names of further signal inputs of the network, such as ``("T",)``.
        modifiers: options. ``input_scale`` is the magnitude of the displacements, one number or one for each
            (and for each secondary input); ``output_scale`` that of the effort at the first port.

    Raises:
        DeclarationError: in one sentence, for options that do not go together, or domains whose energies are not
            the same.
    """

    ICON = icons.network("c n")

    odd = ac.Option(False, doc="the same from both sides")
    passive = ac.Option(False, doc="the energy is never negative, and zero at zero")
    convex = ac.Option(False, doc="the energy is convex")
    floor = ac.Option(0.0, doc="least curvature of a convex energy, relative to that of the scales")
    promises = ("odd", "passive", "convex", "floor")

    def __init__(
        self,
        connectors: Sequence[type[ac.Connector]] = (Flange, Flange),
        *,
        secondary: Sequence[str] = (),
        **modifiers: Any,
    ) -> None:
        pseudo = [kind for kind in connectors if not kind.power]
        if pseudo and any(kind is not pseudo[0] for kind in connectors):
            raise ac.DeclarationError(
                f"MultiportCompliance: difference times flow is not a power for {pseudo[0].__name__}, so that it "
                "shares no energy with other domains; give ports of one domain"
            )
        self.connectors, self.secondary = tuple(connectors), tuple(secondary)
        self.ports = [CompliancePort(kind) for kind in connectors]
        for name in self.secondary:
            setattr(self, name, ac.Input(doc="secondary input of the network"))
        self.E = ac.Variable(unit=self._energy_unit(), doc="stored energy")
        super().__init__(**modifiers)

    def _energy_unit(self) -> str:
        kind = self.connectors[0]
        time = "" if kind.rate is not None else "s"
        return product_unit(across_unit(kind), flow_unit(kind), time)

    def _spec(self) -> Callable[[Any], Any]:
        return ac.networks.Energy(
            inputs=len(self.ports),
            secondary=len(self.secondary),
            passive=self.passive,
            convex=self.convex,
            odd=self.odd,
            floor=self.floor,
            **self._sizes,
        )

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        others = (getattr(self, name) for name in self.secondary)
        energy = self.net(*(port.x for port in self.ports), *others)
        yield ac.Eq(self.E, energy)
        for port in self.ports:
            yield ac.Eq(port.e, energy.diff(port.x))
