"""Models with events whose parameters and inputs hold functions, as networks of equinox do."""

from collections.abc import Iterator
from typing import Any

import equinox as eqx
import jax.numpy as jnp
import pytest

import acausal as ac


class _Dropped(ac.Component):
    """A ball that bounces; a network is its resistance, an input the height of its floor."""

    floor = ac.Input(unit="m")
    net = ac.Module(lambda key: eqx.nn.MLP("scalar", "scalar", 4, 1, key=key))
    h = ac.Variable(unit="m", start=1.0, fixed=True)
    v = ac.Variable(unit="m/s", start=0.0, state="always", fixed=True)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.h), self.v)
        yield ac.Eq(ac.der(self.v), -9.81 + 0.1 * self.net(self.v))
        yield ac.When(self.h < self.floor, ac.Reinit(self.v, -0.8 * ac.pre(self.v)))


def _floor(t: Any) -> Any:
    return 0.1 * jnp.sin(t)


@pytest.mark.slow
@pytest.mark.parametrize(
    "steps",
    [
        pytest.param({"rtol": 1e-11, "atol": 1e-13}, marks=pytest.mark.machines),
        {"dt": 0.01, "solver": "rk4"},
    ],
    ids=["adaptive", "fixed"],
)
def test_networks_and_functions_of_time(steps: dict[str, Any]) -> None:
    system = ac.compile(_Dropped())
    params = system.parameters(0)

    def end(bias: Any) -> Any:
        net = eqx.tree_at(lambda n: n.layers[1].bias, params["net"], bias)
        given = {**params, "net": net}
        return ac.simulate(system, (0.0, 1.0), params=given, inputs={"floor": _floor}, **steps)[
            "h"
        ][-1]

    bias = params["net"].layers[1].bias
    _, slope = eqx.filter_value_and_grad(end)(bias)
    change = 1e-3
    found = (float(end(bias + change)) - float(end(bias - change))) / (2 * change)
    assert float(slope.sum()) == pytest.approx(found, rel=1e-4)
