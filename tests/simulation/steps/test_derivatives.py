"""Derivatives through events: closed forms, differences, both modes, `vmap`, fixed and adaptive steps."""

import warnings
from collections.abc import Iterator
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks
from tests.support.hybrid import Ball, Sampled, Step, ball_height, sampled_end
from tests.support.slow import some_slow

TIGHT: dict[str, Any] = {"rtol": 1e-10, "atol": 1e-12}
STEPS: dict[str, Any] = {"adaptive": TIGHT, "fixed": {"dt": 0.01, "solver": "rk4"}}


@pytest.fixture(scope="module")
def ball() -> ac.System:
    return ac.compile(Ball())


@pytest.fixture(scope="module")
def step() -> ac.System:
    return ac.compile(Step())


def height(system: ac.System, end: float, **steps: Any) -> Any:
    def at_end(h0: Any, e: Any) -> Any:
        params = {**system.parameters(), "e": e}
        found = ac.simulate(system, (0.0, end), x0={"h": h0}, params=params, saveat=[end], **steps)
        return found["h"][-1]

    return at_end


def central(function: Any, at: tuple[float, ...], i: int, change: float = 1e-6) -> float:
    up, down = (list(at) for _ in range(2))
    up[i], down[i] = at[i] + change, at[i] - change
    return (float(function(*up)) - float(function(*down))) / (2 * change)


@pytest.mark.cases(fast=0, slow=4)
@pytest.mark.parametrize("kind", STEPS)
@pytest.mark.parametrize("bounces", [1, 2, 5])
def test_a_bouncing_ball(ball: ac.System, kind: str, bounces: int) -> None:
    end = {1: 0.8, 2: 1.5, 5: 2.7}[bounces]
    function = height(ball, end, **STEPS[kind])
    at = 1.0, 0.8
    value, found = jax.value_and_grad(function, (0, 1))(*at)
    assert value == pytest.approx(ball_height(1.0, 0.8, end), abs=1e-9)
    h0, e = sp_derivatives(end)
    assert found[0] == pytest.approx(h0, rel=1e-8)
    assert found[1] == pytest.approx(e, rel=1e-8)


def sp_derivatives(end: float) -> tuple[float, float]:
    """Derivatives of the exact height by complex steps."""
    tiny = 1e-20
    by_height = _complex_height(1.0 + 1j * tiny, 0.8, end).imag / tiny
    by_restitution = _complex_height(1.0, 0.8 + 1j * tiny, end).imag / tiny
    return by_height, by_restitution


def _complex_height(h0: complex, e: complex, t: float) -> complex:
    g = 9.81
    t1 = (2 * h0 / g) ** 0.5
    v, begin = e * g * t1, t1
    while t > (begin + 2 * v / g).real:
        begin, v = begin + 2 * v / g, e * v
    return v * (t - begin) - g * (t - begin) ** 2 / 2


@pytest.mark.slow
def test_forward_and_reverse_modes_agree(ball: ac.System) -> None:
    function = height(ball, 1.5, **TIGHT)
    backwards, forwards = jax.grad(function, (0, 1)), jax.jacfwd(function, (0, 1))
    np.testing.assert_allclose(backwards(1.0, 0.8), forwards(1.0, 0.8), rtol=1e-12)


@pytest.mark.machines
def test_many_balls_side_by_side(ball: ac.System) -> None:
    heights = jnp.asarray([0.5, 1.0, 2.0])
    function = jax.value_and_grad(lambda h: height(ball, 1.5, **TIGHT)(h, 0.8))
    values, gradients = jax.jit(jax.vmap(function))(heights)
    for h, value, gradient in zip(heights, values, gradients, strict=True):
        by_height = _complex_height(complex(h, 1e-20), 0.8, 1.5).imag / 1e-20
        assert float(gradient) == pytest.approx(by_height, rel=1e-8)
        assert float(value) == pytest.approx(ball_height(float(h), 0.8, 1.5), abs=1e-9)


@pytest.mark.slow
def test_an_event_at_a_time_to_save(ball: ac.System) -> None:
    t1 = float(np.sqrt(2 / 9.81))
    found = ac.simulate(ball, (0.0, 1.0), saveat=[t1, 1.0], **TIGHT)
    assert found["h"][0] == pytest.approx(0.0, abs=1e-9)
    assert found["h"][1] == pytest.approx(ball_height(1.0, 0.8, 1.0), abs=1e-9)
    gradient = jax.grad(
        lambda h: ac.simulate(ball, (0.0, 1.0), x0={"h": h}, saveat=[t1, 1.0], **TIGHT)["h"][1]
    )(1.0)
    assert gradient == pytest.approx(sp_derivatives(1.0)[0], rel=1e-8)


@pytest.mark.cases(slow=1)
@pytest.mark.slow
@pytest.mark.parametrize("kind", STEPS)
def test_a_sampling_period_is_trained(kind: str) -> None:
    system = ac.compile(Sampled())

    def end(period: Any, k: Any) -> Any:
        params = {**system.parameters(), "period": period, "k": k}
        return ac.simulate(system, (0.0, 1.05), params=params, saveat=[1.05], **STEPS[kind])["x"][0]

    at = 0.1, 2.0
    value, found = jax.value_and_grad(end, (0, 1))(*at)
    assert value == pytest.approx(sampled_end(*at, 1.05), abs=1e-9)
    expected = [central(lambda *p: sampled_end(*p, 1.05), at, i) for i in range(2)]
    np.testing.assert_allclose(found, expected, rtol=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("kind", some_slow(STEPS, [], [k for k in STEPS if k != "fixed"]))
def test_an_event_at_the_end_moves_and_the_end_does_not(kind: str) -> None:
    system = ac.compile(Sampled())

    def end(period: Any) -> Any:
        params = {**system.parameters(), "period": period}
        return ac.simulate(system, 1.0, params=params, **STEPS[kind])["x"][-1]

    below = central(lambda period: sampled_end(period, 2.0, 1.0), (0.1 - 2e-7,), 0, 1e-7)
    for derivative in (jax.grad, jax.jacfwd):
        assert derivative(end)(0.1) == pytest.approx(below, rel=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("kind", some_slow(STEPS, [], [k for k in STEPS if k != "fixed"]))
def test_a_switching_time_and_a_threshold_of_a_later_event(step: ac.System, kind: str) -> None:
    def late(t1: Any, threshold: Any) -> Any:
        params = {**step.parameters(), "t1": t1, "threshold": threshold}
        found = ac.simulate(step, (0.0, 2.0), params=params, saveat=[2.0], **STEPS[kind])
        return found["late"][0]

    # x = 1 - exp(-(t - t1)) passes the threshold at t1 - log(1 - threshold)
    value, found = jax.value_and_grad(late, (0, 1))(0.503, 0.2)
    assert value == pytest.approx(2.0 - 0.503 + np.log(0.8), abs=1e-8)
    np.testing.assert_allclose(found, [-1.0, -1 / 0.8], rtol=1e-7)


@pytest.mark.machines
def test_twins_meet_the_ground_together() -> None:
    class Twins(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.ball = [Ball() for _ in range(2)]

    system = ac.compile(Twins())

    def sum_of_heights(h0: Any) -> Any:
        x0 = {"ball[1].h": h0, "ball[2].h": h0}
        found = ac.simulate(system, (0.0, 1.5), x0=x0, saveat=[1.5], **TIGHT)
        return found["ball[1].h"][0] + found["ball[2].h"][0]

    found = ac.simulate(system, (0.0, 1.5), **TIGHT)
    assert len(found.events) == 2  # not four: both bounce at once
    assert jax.grad(sum_of_heights)(1.0) == pytest.approx(2 * sp_derivatives(1.5)[0], rel=1e-8)


@pytest.mark.slow
def test_a_time_that_lies_far_away_spoils_no_gradient() -> None:
    class Late(ac.Component):
        rate = ac.Parameter(3.0)
        x = ac.Variable(fixed=True)
        begin = ac.Discrete(-1e60)

        def equations(self) -> Any:
            growing = ac.where(
                self.rate * (ac.time - self.begin) < 1, ac.time - self.begin, 0, events=True
            )
            yield ac.Eq(ac.der(self.x), growing)
            yield ac.When(ac.time > 0.5, ac.Eq(self.begin, ac.time))

    system = ac.compile(Late())

    def end(rate: Any) -> Any:
        params = {**system.parameters(), "rate": rate}
        return ac.simulate(system, (0.0, 1.0), params=params, dt=0.1, solver="rk4")["x"][-1]

    # 1/rate long, it grows from zero with slope 1
    assert float(jax.grad(end)(3.0)) == pytest.approx(-1 / 27, rel=1e-9)


class _StepResponse(ac.Component):
    """A first-order lag behind a step: no events of its own."""

    def __init__(self) -> None:
        super().__init__()
        self.step = blocks.Step(startTime=0.3, height=2.0)
        self.lag = blocks.FirstOrder(T=0.5)
        self.connect(self.step.y, self.lag.u)


@pytest.mark.slow
@pytest.mark.parametrize(
    "how",
    [
        pytest.param({"rtol": 1e-10, "atol": 1e-12}, marks=pytest.mark.machines),
        {"dt": 0.01, "solver": "rk4"},
    ],
)
def test_the_time_of_a_step_has_a_gradient_in_a_model_without_events(how: dict[str, Any]) -> None:
    system = ac.compile(_StepResponse())
    assert system.events is None

    def end(start_time: Any) -> Any:
        params = {**system.parameters(), "step.startTime": start_time}
        return ac.simulate(system, (0.0, 1.0), params=params, saveat=[1.0], **how)["lag.y"][-1]

    exact = -2 * np.exp(-0.7 / 0.5) / 0.5
    assert float(jax.grad(end)(0.3)) == pytest.approx(exact, rel=1e-7)
    assert float(jax.jacfwd(end)(0.3)) == pytest.approx(exact, rel=1e-7)


class _Late(ac.Component):
    """A rate that grows a while after an event; the condition is none itself."""

    wait, level = ac.Parameter(0.2), ac.Parameter(0.4)
    x = ac.Variable(start=0.0, fixed=True)
    begun = ac.Discrete(10.0)

    def equations(self) -> Iterator[Any]:
        late = ac.time > self.begun + self.wait
        yield ac.Eq(ac.der(self.x), ac.where(late, 3, 1))
        yield ac.When(self.x > self.level, ac.Eq(self.begun, ac.time))


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize("at", [(0.2, 0.4), (0.23, 0.41)], ids=["on the grid", "within steps"])
def test_an_edge_that_an_event_moves_has_a_gradient_where_fixed_steps_end(at: Any) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # steps end at the edge, so it has a gradient
        system = ac.compile(_Late())

    def end(at: Any) -> Any:
        params = dict(zip(("wait", "level"), at, strict=True))
        return ac.simulate(system, 1.0, params=params, dt=0.1, solver="rk4")["x"][-1]

    for derivative in (jax.grad, jax.jacfwd):
        np.testing.assert_allclose(derivative(end)(jnp.array(at)), [-2.0, -2.0], rtol=1e-9)


class _LearnedThreshold(ac.Component):
    """A rate that halves at a threshold; a network gives the threshold, and nothing else."""

    threshold = ac.Module(lambda key: ac.MLP(1, 2, 1, "tanh", key=key))
    x = ac.Variable(fixed=True)

    def equations(self) -> Iterator[Any]:
        slow = self.x > 0.5 + self.threshold(1.0)
        yield ac.Eq(ac.der(self.x), ac.where(slow, 1, 2, events=True))


@pytest.mark.slow
def test_a_network_in_conditions_alone_has_forward_derivatives_through_implicit_steps() -> None:
    system = ac.compile(_LearnedThreshold())
    net = system.parameters()["threshold"]

    def end(shift: Any) -> Any:
        moved = eqx.tree_at(lambda n: n.biases[-1], net, net.biases[-1] + shift)
        params = {**system.parameters(), "threshold": moved}
        return ac.simulate(system, 1.0, params=params, dt=0.1, solver="stiff")["x"][-1]

    # it takes (0.5 + net) / 2 to the threshold
    assert float(jax.jacfwd(end)(0.0)) == pytest.approx(0.5, rel=1e-9)
