"""Neural inertias: what stores energy in a motion."""

from collections.abc import Callable, Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .choices import FLOOR
from .interfaces import PartialNeural
from .units import across_unit, flow_unit, per_second, product_unit


class Inductance(PartialNeural):
    """A neural mass, inductor or fluid inertance: momentum as a function of flow.

    The network is the co-energy ``C``, convex for all weights. Its derivative is the momentum, rising with the flow:

    - electrical: flux linkage ``momentum = C'(i)``, ``v = der(momentum)``;
    - fluid: ``momentum = C'(m_flow)``, ``dp = der(momentum)``; likewise where the potential is not a position;
    - mechanical: a rigid body between its flanges, as `translational.Mass`, of speed ``v = der(s)``, with
      ``momentum = C'(v)`` and ``der(momentum) = flange_a.f + flange_b.f``; ``w = der(phi)`` where it turns.

    The stored energy is ``E = v momentum - C(v)``, with the flow in place of the speed elsewhere. It is never negative,
    and what flows in is what is stored: a convex function lies above its tangents, so ``C(0) >= C(v) - v C'(v)``, and
    ``C(0) = 0``; and ``der(E) = v der(momentum)``, the power. The mass, inductance or inertance is the derivative
    of the momentum, at least ``floor output_scale / input_scale``, so that it can be divided by. It starts near
    ``output_scale / input_scale``: choose the scales so that this is a likely value.

    In the magnetic domain, where ``V_m der(Phi)`` is the power, this is an eddy current loss. Heat has no inertia.

    ``input_scale`` is a magnitude of the flow or speed, ``output_scale`` of the momentum; ``odd=True`` makes the
    momentum odd. See `PartialNeural` for the other arguments.
    """

    ICON = icons.network("L")

    floor = ac.Option(FLOOR, doc="least derivative of the momentum, relative to that of the scales")
    promises = (*PartialNeural.promises, "floor")

    def _declare(self) -> None:
        kind = self.connector
        if flow_unit(kind) == "W":
            raise ac.DeclarationError(
                "Inductance: heat has no inertia; take a Resistance or a Compliance"
            )
        super()._declare()
        across, flow = across_unit(kind), flow_unit(kind)
        impulse, speed = (flow, per_second(across)) if self._is_mechanical else (across, flow)
        self.momentum = ac.Variable(unit=product_unit(impulse, "s"), doc="what the flow carries on")
        self.E = ac.Variable(unit=product_unit(impulse, "s", speed), doc="stored energy")

    def _declare_between(self) -> None:
        kind = self.connector
        unit = across_unit(kind)
        if kind.rate is None:
            setattr(self, kind.across, ac.Variable(unit=unit, doc="difference"))
            setattr(self, kind.through, ac.Variable(unit=flow_unit(kind), state="prefer"))
        else:
            setattr(self, kind.potential(), ac.Variable(unit=unit, state="prefer", doc="position"))
            speed = ac.Variable(unit=per_second(unit), state="prefer", doc="speed")
            setattr(self, _speed(kind.rate), speed)

    def _spec(self) -> Callable[[Any], Any]:
        return ac.networks.Energy(
            convex=True, passive=True, floor=self.floor, start=1.0, **self._sizes
        )

    def equations(self) -> Iterator[ac.Eq]:
        yield from self._body() if self._is_mechanical else self._between()
        flow = self._flow
        energy = self._law(flow)
        yield ac.Eq(self.momentum, energy.diff(flow))
        yield ac.Eq(self.E, flow * energy.diff(flow) - energy)

    @property
    def _flow(self) -> Any:
        """What the momentum depends on."""
        kind = self.connector
        return self._through if kind.rate is None else getattr(self, _speed(kind.rate))

    def _between(self) -> Iterator[ac.Eq]:
        """The difference of the potentials changes the momentum of the flow."""
        yield from super().equations()
        yield ac.Eq(self._across, ac.der(self._law(self._flow).diff(self._flow)))

    def _body(self) -> Iterator[ac.Eq]:
        """What acts on the rigid body changes its momentum."""
        kind, ends = self.connector, self._ends
        position = getattr(self, kind.potential())
        for end in ends:
            yield ac.Eq(getattr(end, kind.potential()), position)
        yield ac.Eq(self._flow, ac.der(position))
        acting = sum(getattr(end, kind.flow()) for end in ends)
        yield ac.Eq(ac.der(self._law(self._flow).diff(self._flow)), acting)


def _speed(rate: str) -> str:
    """Name of a body's own speed, from that of a relative one."""
    return rate.removesuffix("_rel")
