"""Derivatives where several conditions change at the same instant: each at its own time, if their order is the same."""

from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from tests.support.hybrid import Ball
from tests.support.slow import some_slow

STEPS: dict[str, Any] = {
    "adaptive": {"rtol": 1e-10, "atol": 1e-12},
    "fixed": {"dt": 0.01, "solver": "rk4"},
}


class Three(ac.Component):
    """Balls that bounce at the same instants."""

    def __init__(self) -> None:
        super().__init__()
        self.ball = [Ball() for _ in range(3)]


class Clocks(ac.Component):
    """Lags, switched by clocks and at given times, which coincide."""

    first, second = ac.Parameter(0.1), ac.Parameter(0.2)
    t1, t2 = ac.Parameter(0.4), ac.Parameter(0.4)
    x, y, z = (ac.Variable(fixed=True) for _ in range(3))
    u, w = ac.Discrete(), ac.Discrete()

    def equations(self) -> Any:
        early = ac.where(ac.time < self.t1, 1, 0, events=True)
        late = ac.where(ac.time >= self.t2, 2, 0, events=True)
        yield ac.Eq(ac.der(self.x), self.u - self.x)
        yield ac.Eq(ac.der(self.y), self.w - self.y)
        yield ac.Eq(ac.der(self.z), early + late - self.z)
        yield ac.When(ac.sample(0.1, self.first), ac.Eq(self.u, 1 - self.x))
        yield ac.When(ac.sample(0.2, self.second), ac.Eq(self.w, 2 - self.y**2))


class Chained(ac.Component):
    """Two clocks; what the second takes depends on whether the first came before."""

    first, second = ac.Parameter(0.1), ac.Parameter(0.1)
    x = ac.Variable(fixed=True)
    u, w = ac.Discrete(), ac.Discrete()

    def equations(self) -> Any:
        yield ac.Eq(ac.der(self.x), 1 + self.w)
        yield ac.When(ac.sample(0.05, self.first), ac.Eq(self.u, self.x))
        yield ac.When(ac.sample(0.05, self.second), ac.Eq(self.w, ac.pre(self.u)))


@pytest.fixture(scope="module", params=[Three, Clocks])
def system(request: Any) -> ac.System:
    return ac.compile(request.param())


def ends(system: ac.System, kind: str) -> Any:
    """What comes of all numbers, and they."""
    if "ball[1].e" in system.parameters():
        names = [f"ball[{k}].{n}" for k in (1, 2, 3) for n in ("h", "e")]
        values, end = np.array([1.0, 0.8] * 3), 1.1
    else:
        names, values, end = ["first", "second", "t1", "t2"], np.array([0.1, 0.2, 0.4, 0.4]), 0.95

    def run(values: Any) -> Any:
        given = dict(zip(names, values, strict=True))
        params = {n: given.pop(n) for n in names if n in system.parameters()}
        params, x0 = {**system.parameters(), **params}, given or None
        options = STEPS[kind]
        return ac.simulate(system, (0.0, end), params=params, x0=x0, saveat=[end], **options).x[-1]

    return run, values


@pytest.mark.cases(slow=1)
@pytest.mark.parametrize("kind", some_slow(["fixed", "adaptive"], ["fixed"], ["adaptive"]))
def test_each_has_its_own_time(system: ac.System, kind: str) -> None:
    run, values = ends(system, kind)
    total = lambda v: run(v) @ np.arange(1.0, len(system.states) + 1)  # noqa: E731
    both = jax.jit(jax.value_and_grad(total))
    small = 1e-5 * np.eye(len(values))
    wanted = [float(both(values + d)[0] - both(values - d)[0]) / 2e-5 for d in small]
    np.testing.assert_allclose(both(values)[1], wanted, rtol=1e-6, atol=2e-6)
    along = jax.jit(lambda d: jax.jvp(total, (values,), (d,))[1])
    np.testing.assert_allclose([along(d) for d in 1e5 * small], wanted, rtol=1e-6, atol=2e-6)


@pytest.mark.slow
def test_where_their_order_matters_all_have_the_time_of_one() -> None:
    system = ac.compile(Chained())

    def end(period: Any) -> Any:
        params = {**system.parameters(), "first": period, "second": period}
        found = ac.simulate(system, (0.0, 0.4), params=params, dt=0.05, solver="rk4")
        return found["x"][-1]

    wanted = float(end(0.1 + 1e-6) - end(0.1 - 1e-6)) / 2e-6
    assert float(jax.grad(end)(0.1)) == pytest.approx(wanted, rel=1e-6)
