"""Two-ports of any domain, and the bases of elements whose law is a network."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.translational import Flange

from .units import across_unit, flow_unit


class PartialTwoPort(ac.Component):
    """Two connectors and the variables between them, under the names of their domain.

    The names and signs are the connector class's: for a `translational.Flange` ``flange_a``, ``flange_b``, ``s_rel``
    and ``f``, for a heat port ``port_a``, ``port_b``, ``dT`` and ``Q_flow``. The through variable enters at one
    connector and leaves at the other. A subclass relates the two.

    Arguments:
        connector: connector class of the domain.
        modifiers: of everything else.
    """

    def __init__(self, connector: type[ac.Connector] = Flange, **modifiers: Any) -> None:
        if not (isinstance(connector, type) and issubclass(connector, ac.Connector)):
            raise ac.DeclarationError(
                f"{type(self).__name__}: connector={connector!r:.60} is not a class of connectors; "
                "give one such as translational.Flange"
            )
        self.connector = connector
        self._declare()
        super().__init__(**modifiers)

    def _declare(self) -> None:
        """Declare what has the domain's names."""
        for name in self.connector.pair:
            setattr(self, name, self.connector())
        self._declare_between()

    def _declare_between(self) -> None:
        """Declare the variables between the connectors."""
        kind = self.connector
        setattr(self, kind.across, ac.Variable(unit=across_unit(kind), doc="difference"))
        setattr(self, kind.through, ac.Variable(unit=flow_unit(kind), doc="flow between"))

    @property
    def _across(self) -> Any:
        return getattr(self, self.connector.across)

    @property
    def _through(self) -> Any:
        return getattr(self, self.connector.through)

    @property
    def _is_mechanical(self) -> bool:
        """Whether the potential is a position."""
        return self.connector.rate is not None

    @property
    def _ends(self) -> tuple[Any, Any]:
        """The connectors where the flow enters and leaves."""
        first, second = (getattr(self, name) for name in self.connector.pair)
        return (second, first) if self.connector.second_minus_first else (first, second)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        kind, (enters, leaves) = self.connector, self._ends
        potentials = [getattr(end, kind.potential()) for end in (enters, leaves)]
        yield ac.Eq(self._across, potentials[0] - potentials[1])
        yield ac.Eq(getattr(enters, kind.flow()), self._through)
        yield ac.Eq(getattr(leaves, kind.flow()), -self._through)
        yield from kind.carried(enters, leaves)


class PartialNetwork(ac.Component):
    """An element with a network, and the options of it that all such elements have."""

    ICON = icons.NEURAL

    width = ac.Option(16, doc="neurons in each hidden layer")
    depth = ac.Option(2, doc="hidden layers")
    activation = ac.Option(None, doc="of the hidden layers, by name; None takes the default")
    input_scale = ac.Option(
        None, doc="magnitude of the inputs, one number or one for each; None takes it from the data"
    )
    output_scale = ac.Option(None, doc="magnitude of the output; None takes it from the data")
    net = ac.Module("_fresh", doc="the law")

    promises: tuple[str, ...] = ()
    """Options of the network that a user's own network would not know of."""

    def modify(self, **modifiers: Any) -> None:
        """Change modifiers; raises an error for promises that contradict each other."""
        super().modify(**modifiers)
        own = "net" in self._node.modifiers
        given = [name for name in self.promises if self._node.options.get(name)]
        if own and given:
            promised = ", ".join(f"{name}={self._node.options[name]!r}" for name in given)
            raise ac.DeclarationError(
                f"{self._node.label}: {promised} cannot be promised of a network of your own; wrap it in parts of "
                "ac.networks, such as Passive, or leave out net=..."
            )
        try:
            self._spec()
        except ac.DeclarationError as error:
            raise ac.DeclarationError(f"{self._node.label}: {error}") from None

    def _fresh(self, key: Any) -> Any:
        """The network, with fresh weights."""
        return self._spec()(key)

    def _spec(self) -> Callable[[Any], Any]:
        """How the network is made."""
        raise NotImplementedError

    @property
    def _sizes(self) -> dict[str, Any]:
        """The options that every network has."""
        scale = self.input_scale
        return {
            "width": self.width,
            "depth": self.depth,
            "activation": self.activation,
            "input_scale": tuple(scale) if isinstance(scale, list | tuple) else scale,
            "output_scale": self.output_scale,
        }


class PartialLaw(PartialNetwork):
    """Base of elements whose network is a law of one input, and of secondary inputs.

    A subclass names ``secondary`` and declares them before it is made.
    """

    odd = ac.Option(False, doc="the law is odd: the same from both sides")
    extrapolation = ac.Option(
        None,
        choices=(None, "saturating", "linear", "cubic"),
        doc="how the law goes on beyond the limits",
    )
    limits = ac.Option(
        None, doc="of the first input, a pair or one number; by default three input scales"
    )
    promises = ("odd", "extrapolation", "limits")

    secondary: tuple[str, ...]

    def _declare_secondary(self) -> None:
        for name in self.secondary:
            setattr(self, name, ac.Input(doc="secondary input of the network"))

    def _law(self, argument: Any) -> Any:
        """The network applied to a variable and the secondary inputs."""
        return self.net(argument, *(getattr(self, name) for name in self.secondary))

    @property
    def _sizes(self) -> dict[str, Any]:
        limits = self.limits
        return {
            **super()._sizes,
            "secondary": len(self.secondary),
            "odd": self.odd,
            "extrapolation": self.extrapolation,
            "limits": tuple(limits) if isinstance(limits, list | tuple) else limits,
        }


class PartialNeural(PartialTwoPort, PartialLaw):
    """Base of neural two-ports: two connectors, the variables between them, and a network ``net``.

    Arguments:
        connector: connector class of the domain, which names everything (`PartialTwoPort`).
        secondary: names of further signal inputs of the network, such as ``("T",)``; or how many,
            named ``u1``, ``u2`` and so on.
        net: another network: a module called with scalars, or a function ``key -> module``.
        modifiers: options, and start values of variables.

    Raises:
        DeclarationError: in one sentence, for options that do not go together.
    """

    def __init__(
        self,
        connector: type[ac.Connector] = Flange,
        *,
        secondary: int | Sequence[str] = (),
        **modifiers: Any,
    ) -> None:
        self.secondary = _named(secondary)
        super().__init__(connector, **modifiers)

    def _declare(self) -> None:
        super()._declare()
        self._declare_secondary()


def _named(secondary: int | Sequence[str]) -> tuple[str, ...]:
    """Names of secondary inputs; of a number of them ``u1``, ``u2`` and so on."""
    if isinstance(secondary, int) and secondary >= 0:
        return tuple(f"u{i + 1}" for i in range(secondary))
    if not isinstance(secondary, list | tuple) or not all(isinstance(n, str) for n in secondary):
        raise ac.DeclarationError(
            f"secondary={secondary!r:.60} are the further inputs of a network; give their names, or how many"
        )
    return tuple(secondary)
