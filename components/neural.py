"""Neural two-ports: elements of any domain whose law is a small network.

`Compliance` and `Resistance` connect like their conventional fellows, a spring and a damper, a
capacitor and a resistor; only their law is learned. A network has few inputs and one output, so that
it can be looked at and judged as physics.

J. Kamp, J. Ultsch, J. Brembeck: Closing the Sim-to-Real Gap with Physics-Enhanced Neural ODEs,
ICINCO 2023, doi 10.5220/0012160100003543.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any, Self, TypeVar

import acausal as ac

from .translational import Flange


class PartialNeural(ac.Component):
    """Base of neural two-ports: two connectors, the variables between them, and a network ``net``.

    The names are the domain's own, taken from the connector class: for a `translational.Flange`
    ``flange_a``, ``flange_b``, ``s_rel``, ``v_rel`` and ``f``, for a heat port ``port_a``, ``port_b``,
    ``dT`` and ``Q_flow``, and so are the signs. The through variable enters at one connector and leaves
    at the other.

    Arguments:
        connector: connector class of the domain.
        width: neurons in each hidden layer. depth: number of hidden layers.
        activation: of the hidden layers, by name.
        input_scale: magnitude of the network's inputs, in their units; one number or one for each.
        output_scale: magnitude of its output.
        secondary: names of further signal inputs of the network, such as ``("T",)``; or how many,
            named ``u1``, ``u2`` and so on.
        net: another network: a module called with scalars, or a function ``key -> module``.
        modifiers: start values of variables.
    """

    connector = Flange
    secondary: tuple[str, ...] = ()

    width = ac.Option(16, doc="neurons in each hidden layer")
    depth = ac.Option(2, doc="number of hidden layers")
    activation = ac.Option("relu", doc="activation of the hidden layers")
    input_scale = ac.Option(1.0, doc="magnitude of the inputs")
    output_scale = ac.Option(1.0, doc="magnitude of the output")
    net = ac.Module("_net", doc="the law")

    if TYPE_CHECKING:  # connectors and variables bear the domain's names

        def __getattr__(self, name: str) -> Any: ...

    def __new__(
        cls,
        connector: type[ac.Connector] = Flange,
        *,
        secondary: int | Sequence[str] = (),
        **modifiers: Any,
    ) -> Self:
        """An instance of the class for that domain and those inputs."""
        if isinstance(secondary, int):
            secondary = [f"u{i}" for i in range(1, secondary + 1)]
        return super().__new__(_specialised(cls, connector, tuple(secondary)))

    def __init__(
        self,
        connector: type[ac.Connector] = Flange,
        *,
        width: int = 16,
        depth: int = 2,
        activation: str = "relu",
        input_scale: float | tuple[float, ...] = 1.0,
        output_scale: float = 1.0,
        secondary: int | Sequence[str] = (),
        net: Callable[..., Any] | None = None,
        **modifiers: Any,
    ) -> None:
        if net is not None:
            modifiers["net"] = net
        super().__init__(
            width=width,
            depth=depth,
            activation=activation,
            input_scale=input_scale,
            output_scale=output_scale,
            **modifiers,
        )

    def _net(self, key: Any) -> ac.MLP:
        """The default network, with fresh weights."""
        return ac.MLP(
            1 + len(self.secondary),
            self.width,
            self.depth,
            self.activation,
            input_scale=self.input_scale,
            output_scale=self.output_scale,
            key=key,
        )

    def _law(self, argument: Any) -> Any:
        """The network applied to a variable and the secondary inputs."""
        return self.net(argument, *(getattr(self, name) for name in self.secondary))

    @property
    def _across(self) -> Any:
        return getattr(self, self.connector.across)

    @property
    def _through(self) -> Any:
        return getattr(self, self.connector.through)

    def equations(self) -> Iterator[ac.Eq]:
        kind = self.connector
        first, second = (getattr(self, name) for name in kind.pair)
        enters, leaves = (second, first) if kind.second_minus_first else (first, second)
        difference = getattr(enters, kind.potential()) - getattr(leaves, kind.potential())
        yield ac.Eq(self._across, difference)
        yield ac.Eq(getattr(enters, kind.flow()), self._through)
        yield ac.Eq(getattr(leaves, kind.flow()), -self._through)
        yield from kind.carried(enters, leaves)


class Compliance(PartialNeural):
    """A neural spring or capacitor.

    Where the potential is a position, ``f = net(s_rel)``. Elsewhere the network gives what is stored,
    ``q = net(v)``, and the flow is its derivative, ``i = der(q)``. There a secondary input must be
    differentiable, and the slope of the network, together with what is connected in parallel, must not
    vanish. See `PartialNeural` for the arguments.
    """

    q = ac.Variable(when="_stores", doc="what is stored, where the potential is no position")

    @property
    def _stores(self) -> bool:
        return self.connector.rate is None

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        law = self._law(self._across)
        if self._stores:
            yield ac.Eq(self.q, law)
            yield ac.Eq(self._through, ac.der(law))
        else:
            yield ac.Eq(self._through, law)


class Resistance(PartialNeural):
    """A neural damper or resistor.

    Where the potential is a position, ``f = net(v_rel)`` with ``v_rel = der(s_rel)``. Elsewhere
    ``i = net(v)``. See `PartialNeural` for the arguments.
    """

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        if self.connector.rate is None:
            yield ac.Eq(self._through, self._law(self._across))
        else:
            rate = getattr(self, self.connector.rate)
            yield ac.Eq(rate, ac.der(self._across))
            yield ac.Eq(self._through, self._law(rate))


_Element = TypeVar("_Element", bound=PartialNeural)


@cache
def _specialised(
    cls: type[_Element], connector: type[ac.Connector], secondary: tuple[str, ...]
) -> type[_Element]:
    """The subclass with a domain's connectors and variables; one for all elements of a kind."""
    potential = connector.declarations[connector.potential()].unit
    across = connector.across_unit or potential
    through = connector.declarations[connector.flow()].unit
    declared: dict[str, Any] = {name: connector() for name in connector.pair}
    declared[connector.across] = ac.Variable(unit=across, doc="difference of the potentials")
    declared[connector.through] = ac.Variable(unit=through, doc="flow from one to the other")
    if connector.rate is not None and issubclass(cls, Resistance):
        declared[connector.rate] = ac.Variable(
            unit=_per_second(across), doc="rate of the difference"
        )
    declared |= {name: ac.Input(doc="secondary input of the network") for name in secondary}
    namespace = {**declared, "connector": connector, "secondary": secondary}
    named = {"__module__": cls.__module__, "__qualname__": cls.__qualname__, "__doc__": cls.__doc__}
    return type(cls.__name__, (cls,), {**namespace, **named})


def _per_second(unit: str) -> str:
    return f"{unit}/s" if unit else ""
