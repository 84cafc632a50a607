"""What a law takes and gives, in the quantities of the model that calls it."""

from collections.abc import Callable, Iterator
from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.analysis import labels
from acausal.components import thermal


class Double(eqx.Module):
    def __call__(self, x: Any) -> Any:
        return 2 * x


class Loss(ac.Component):
    """A heat flow that a network learns, in some form."""

    k = ac.Parameter(4.0)
    w = ac.Input(unit="1/s")
    net = ac.Module()

    def __init__(self, form: Callable[[Any], Any]) -> None:
        super().__init__(net=Double())
        self.form = form
        self.port = thermal.HeatPort_a()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(*self.form(self))


class Room(ac.Component):
    def __init__(self, form: Callable[[Any], Any]) -> None:
        super().__init__()
        self.loss = Loss(form)
        self.air = thermal.HeatCapacitor(C=1.0, T=ac.Start(290.0, fixed=True))
        self.connect(self.loss.port, self.air.port)


FLOW, SPEED = "loss.port.Q_flow [W]", "loss.w [1/s]"


@pytest.mark.parametrize(
    ("form", "result", "factor", "argument"),
    [
        (lambda s: (s.port.Q_flow, s.net(s.w)), FLOW, 1.0, SPEED),
        (lambda s: (s.port.Q_flow, -20 * s.net(s.w / 150)), FLOW, -20.0, "loss.w/150"),
        (lambda s: (s.port.Q_flow, s.k * s.net(s.w)), FLOW, 4.0, SPEED),
        (lambda s: (s.net(s.w), s.port.Q_flow / s.k), FLOW, 4.0, SPEED),
        (lambda s: (s.port.Q_flow, s.w * s.net(s.port.T)), "", 1.0, "loss.port.T [K]"),
        (lambda s: (s.port.Q_flow, s.net(s.w) ** 2), "", 1.0, SPEED),
        (lambda s: (s.port.Q_flow, s.net(s.w) + 3), "", 1.0, SPEED),
        (lambda s: (s.port.Q_flow, s.net(s.w) + s.w), "", 1.0, SPEED),
        (lambda s: (s.port.Q_flow, s.net(s.w + s.port.T / s.k)), FLOW, 1.0, "loss.w + loss.port.T/loss.k"),
    ],
)  # fmt: skip
def test_a_law_is_given_in_the_quantity_that_it_makes(
    form: Callable[[Any], Any], result: str, factor: float, argument: str
) -> None:
    system = ac.compile(Room(form), check_units=False)
    found = labels(system, "loss.net", system.pack(system.parameters()))
    assert found.result == result
    assert found.factor == pytest.approx(factor)
    assert sorted(found.arguments[0].split(" + ")) == sorted(argument.split(" + "))


def test_the_quantity_is_the_law_times_its_factor() -> None:
    form = lambda s: (s.port.Q_flow, -5 * s.k * s.net(s.w / 150))  # noqa: E731
    system = ac.compile(Room(form), check_units=False)
    params = system.parameters()
    found = labels(system, "loss.net", system.pack(params))
    flow = system.observe("loss.port.Q_flow", 0.0, jnp.array([290.0]), np.array([30.0]), params)
    assert float(flow) == pytest.approx(found.factor * 2 * 30.0 / 150)


class Sampled(ac.Component):
    """What a network gives every second, and what it makes a state jump to."""

    e = ac.Input(unit="m")
    x = ac.Variable(unit="m", start=0.0)
    target = ac.Input()
    u = ac.Discrete(0.0, unit="N")
    w = ac.Discrete(0.0)
    net = ac.Module()
    nested = ac.Module()
    jump = ac.Module()

    def __init__(self) -> None:
        super().__init__(net=Double(), jump=Double(), nested=Double())

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), self.u)
        yield ac.When(ac.sample(0.0, 1.0), ac.Eq(self.u, 3 * self.net(self.target - self.x)))
        some = ac.where(self.x > 0, self.nested(self.e), 0.0)
        yield ac.When(ac.sample(0.0, 1.0), ac.Eq(self.w, 2 + some - 2))
        yield ac.When(self.x > 1, ac.Reinit(self.x, self.jump(self.x)))


def test_a_law_at_events_is_given_in_the_variable_that_it_sets() -> None:
    system = ac.compile(Sampled(), check_units=False)
    packed = system.pack(system.parameters())
    net, jump, nested = (labels(system, name, packed) for name in ("net", "jump", "nested"))
    assert (net.arguments, net.result, net.factor) == (("target - x",), "u [N]", pytest.approx(3.0))
    assert (nested.arguments, nested.result) == (("e [m]",), "w")
    assert (jump.arguments, jump.result, jump.factor) == (("x [m]",), "x [m]", pytest.approx(1.0))
