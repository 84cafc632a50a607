"""Neural losses between two ports: gears, motors and the like with a learned efficiency map."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.rotational import Flange
from acausal.components.thermal.interfaces import PartialElementaryConditionalHeatPortWithoutT

from .interfaces import PartialNetwork
from .units import across_unit, flow_unit, per_second

_LEAST = 0.15
"""Least efficiency. Above 0.107 the effort on one side falls with that on the other, so that it is determined by it."""


class LossyTransformer(PartialNetwork, PartialElementaryConditionalHeatPortWithoutT):
    """A transformer with a learned efficiency map: a gear, a motor, a rack; what is lost leaves as heat.

    Each port has a rate ``r`` and an effort ``e`` whose product is the power into it: speed and torque of a flange
    against the ground, voltage and current of a pair of pins. With ``ratio``::

        r_a = ratio r_b
        e_b = -ratio e_a eta^tanh(P_a / P_small),   P_a = e_a r_a

    ``eta`` is the efficiency, between 0.15 and 1 for all weights: the network, as a function of the rate ``r_b``,
    of the direction of the power (1 from a to b, else -1) and of ``secondary`` inputs. So ``eta P_a`` arrives at b
    when power flows that way, and ``eta P_b`` at a when it flows back; around ``|P_a| = P_small`` [W] the one goes
    over into the other.

    **Balance.** ``lossPower = P_a + P_b = P_a (1 - eta^tanh(P_a / P_small))``, exactly. It is not negative: for a
    positive ``P_a`` the power of ``eta`` is at most 1, for a negative one at least 1. It leaves at ``heatPort``
    with ``useHeatPort=True``.

    Losses without load, such as drag, are for a `Resistance` beside the element.

    A mechanical port is one flange, named ``flange`` where it is the only one, else ``flange_a`` and ``flange_b``;
    any other port is a pair of connectors of the domain's names, ``p1``, ``n1``, ``p2``, ``n2`` where there are two
    such. As a motor, ``LossyTransformer(electrical.Pin, rotational.Flange, ratio=k)`` is Modelica's EMF: ``v = k
    w``.

    Arguments:
        connector_a, connector_b: connector classes of the two domains.
        secondary: names of further signal inputs of the network, such as ``("T",)``.
        modifiers: of everything else. ``input_scale`` is a magnitude of the rate ``r_b``, or of it and each of the
            secondary inputs.
    """

    ICON = icons.network("η")

    ratio = ac.Parameter(1.0, doc="rate at a over rate at b")
    input_scale = ac.Option(1.0, doc="magnitude of the inputs, one number or one for each")
    output_scale = ac.Option(1.0, doc="magnitude of the output")
    P_small = ac.Parameter(1e-3, unit="W", min=0, doc="power around which the direction changes")
    P_a = ac.Variable(unit="W", doc="power into port a")

    def __init__(
        self,
        connector_a: type[ac.Connector] = Flange,
        connector_b: type[ac.Connector] = Flange,
        *,
        secondary: Sequence[str] = (),
        **modifiers: Any,
    ) -> None:
        for connector in (connector_a, connector_b):
            if not connector.power:
                raise ac.DeclarationError(
                    f"LossyTransformer: difference times flow is not a power for {connector.__name__}; "
                    "take mechanical or electrical ports"
                )
        self.connector_a, self.connector_b = connector_a, connector_b
        self.secondary = tuple(secondary)
        for side, connector, names in self._ports:
            for name in names:
                setattr(self, name, connector())
            unit, mechanical = across_unit(connector), connector.rate is not None
            rate = ac.Variable(
                unit=per_second(unit) if mechanical else unit, doc="rate of the port"
            )
            setattr(self, f"rate_{side}", rate)
            effort = ac.Variable(unit=flow_unit(connector), doc="effort into the port")
            setattr(self, f"effort_{side}", effort)
        for name in self.secondary:
            setattr(self, name, ac.Input(doc="secondary input of the network"))
        super().__init__(**modifiers)

    @property
    def _ports(self) -> tuple[tuple[str, type[ac.Connector], tuple[str, ...]], ...]:
        """Of both ports: side, connector class, names of its connectors."""
        kinds = self.connector_a, self.connector_b
        names = [("flange",) if kind.rate is not None else kind.pair for kind in kinds]
        if names[0] == names[1]:
            marks = "_a", "_b"
            if kinds[0].rate is None:
                marks = "1", "2"
            names = [tuple(n + mark for n in same) for same, mark in zip(names, marks, strict=True)]
        return ("a", kinds[0], names[0]), ("b", kinds[1], names[1])

    def _spec(self) -> Callable[[Any], Any]:
        return self._efficiency

    def _efficiency(self, key: Any) -> Any:
        """The efficiency, with fresh weights: about 0.9 everywhere."""
        scale, inputs = self.input_scale, 1 + len(self.secondary)
        rate, *others = scale if isinstance(scale, list | tuple) else [scale] * inputs
        chosen: dict[str, Any] = {
            "activation": self.activation or "tanh",
            "input_scale": (rate, 1.0, *others),
        }
        net = ac.MLP(1 + inputs, **{**self._sizes, **chosen}, key=key)
        return ac.networks.Between(net, _LEAST, 1.0, start=2.0)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        for side, connector, names in self._ports:
            yield from self._port(side, connector, [getattr(self, name) for name in names])
        yield self._transmission()
        direction = ac.sign(self.P_a)
        others = (getattr(self, name) for name in self.secondary)
        efficiency = self.net(self.rate_b, direction, *others)
        passed = ac.exp(ac.tanh(self.P_a / self.P_small) * ac.log(efficiency))
        yield ac.Eq(self.P_a, self.effort_a * self.rate_a)
        yield ac.Eq(self.effort_b, -self.ratio * self.effort_a * passed)
        yield ac.Eq(self.lossPower, self.P_a * (1 - passed))

    def _port(
        self, side: str, connector: type[ac.Connector], ends: Sequence[Any]
    ) -> Iterator[ac.Eq]:
        """Rate and effort of a port."""
        rate, effort = getattr(self, f"rate_{side}"), getattr(self, f"effort_{side}")
        potentials = [getattr(end, connector.potential()) for end in ends]
        first, *others = (getattr(end, connector.flow()) for end in ends)
        yield ac.Eq(effort, first)
        if connector.rate is not None:
            yield ac.Eq(rate, ac.der(potentials[0]))
            return
        yield ac.Eq(rate, potentials[0] - potentials[1])
        yield ac.Eq(others[0], -effort)

    def _transmission(self) -> ac.Eq:
        """The ratio, of positions where both ports have them."""
        (_, first, (a, *_)), (_, second, (b, *_)) = self._ports
        if first.rate is None or second.rate is None:
            return ac.Eq(self.rate_a, self.ratio * self.rate_b)
        positions = [getattr(getattr(self, n), c.potential()) for n, c in ((a, first), (b, second))]
        return ac.Eq(positions[0], self.ratio * positions[1])
