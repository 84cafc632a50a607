"""Laws learned in models with events, against the truth that made the data."""

from collections.abc import Callable, Iterator
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import optax
import pytest

import acausal as ac
from acausal.components import electrical as el
from acausal.networks import Law as Network, law_of
from acausal.training.build_problem import build_problem
from acausal.training.options import FitOptions
from tests.support.hybrid import Ball
from tests.support.hybrid_training import (
    Convection,
    Converter,
    Motor,
    Stribeck,
    Zone,
    learned_friction,
    learned_inductor,
    learned_losses,
)

Law = Callable[[Any], Any]


def trained(
    learner: ac.Component,
    truth: ac.Component,
    target: str,
    end: float,
    n: int,
    epochs: int,
    **options: Any,
) -> tuple[ac.Fit, ac.Solution]:
    """A training on what the truth shows at n times after the start, and the truth's run."""
    times = np.linspace(0.0, end, n + 1)
    chosen: dict[str, Any] = {"strategy": "gauss_newton", **options}
    true = ac.simulate(ac.compile(truth), (0.0, end), saveat=times, rtol=1e-9, atol=1e-9)
    fit = ac.fit(
        ac.compile(learner),
        ac.Data(times, {target: np.asarray(true[target])}),
        targets=[target],
        x0="model",
        solver="rk4",
        epochs=epochs,
        **chosen,
    )
    return fit, true


def error(law: Any, truth: Law, low: float, high: float) -> float:
    """The largest error of a law between two arguments, relative to the truth."""
    x = np.linspace(low, high, 50)
    return float(np.max(np.abs(jax.vmap(law)(x) / truth(x) - 1)))


@pytest.mark.machines
def test_a_thermostats_zone_learns_its_losses() -> None:
    fit, true = trained(Zone(learned_losses()), Zone(Convection()), "zone.T", 12.0, 120, 40)
    assert len(true.events) >= 5
    assert fit.loss < 2e-3
    assert error(fit.params["losses.net"], lambda x: 0.5 * x**1.25, 4.0, 11.0) < 0.03


@pytest.mark.slow
def test_a_ball_learns_its_restitution_from_noisy_heights() -> None:
    ball, times = ac.compile(Ball()), np.linspace(0.0, 3.0, 151)
    true = ac.simulate(ball, (0.0, 3.0), saveat=times, rtol=1e-10, atol=1e-10)
    noise = np.random.default_rng(0).normal(0.0, 2e-3, len(times))
    fit = ac.fit(
        ball,
        ac.Data(times, {"h": np.asarray(true["h"]) + noise}),
        targets=["h"],
        x0="model",
        params={"e": 0.78},
        modifiers=["e"],
        strategy="gauss_newton",
        solver="rk4",
        epochs=30,
    )
    assert int(true["n"][-1]) >= 4
    assert fit.params["e"] == pytest.approx(0.8, abs=5e-4)


@pytest.mark.machines
def test_a_motor_learns_its_stribeck_curve() -> None:
    fit, true = trained(Motor(learned_friction()), Motor(Stribeck()), "rotor.w", 4.0, 200, 20)
    assert {-1, 0, 1} <= set(np.asarray(true["friction.mode"]).astype(int).tolist())

    def stribeck(w: Any) -> Any:
        return 0.5 + 0.4 * np.exp(-(w**2)) + 0.05 * w

    assert fit.loss < 1e-4
    assert error(fit.params["friction.net"], stribeck, 0.0, 2.8) < 1e-3


@pytest.mark.machines
def test_a_converter_learns_how_its_inductor_saturates() -> None:
    values: dict[str, Any] = {"Inom": 5.0, "Lnom": 0.8e-3, "Lzer": 1.5e-3, "Linf": 0.3e-3}
    inductor = el.SaturatingInductor(**values, i=ac.Start(0.0, fixed=True))
    learner = Converter(learned_inductor())
    adam: dict[str, Any] = {"strategy": "sequences", "optimizer": optax.adam(2e-2)}
    fit, true = trained(learner, Converter(inductor), "inductor.i", 4e-3, 200, 400, **adam)
    assert len(true.events) >= 38
    i, flux = np.asarray(true["inductor.i"]), np.asarray(true["inductor.Psi"])
    learned = jax.vmap(law_of(fit.params["inductor.net"]))(i)
    inside = i > 3
    assert fit.loss < 0.01
    assert np.max(np.abs(learned[inside] / flux[inside] - 1)) < 0.02


class SampledLoop(ac.Component):
    """A controller that looks every 0.25 s, and the actuator that it moves."""

    r = ac.Input()
    u = ac.Discrete(0.0)
    x = ac.Variable(start=0.0)
    controller = ac.Module()
    actuator = ac.Module()

    def __init__(self) -> None:
        linear = Network(input_scale=10.0, output_scale=10.0)
        super().__init__(controller=linear, actuator=linear)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), self.actuator(self.u) - self.x)
        yield ac.When(ac.sample(0.0, 0.25), ac.Eq(self.u, self.controller(self.r - self.x)))


@pytest.mark.slow
def test_laws_at_events_are_trained_and_laws_of_discrete_variables_see_their_values() -> None:
    system, times = ac.compile(SampledLoop()), np.linspace(0.0, 4.0, 81)
    r = 3 * np.sin(times)

    def run(params: Any) -> ac.Solution:
        steps: dict[str, Any] = {"dt": 0.05, "solver": "heun"}
        return ac.simulate(system, (0.0, 4.0), inputs={"r": (times, r)}, params=params, **steps)

    before = system.parameters()
    data = ac.Data(times, {"r": r, "x": 1.1 * np.asarray(run(before)["x"])})
    options: dict[str, Any] = {"strategy": "whole_record", "epochs": 2, "x0": "model"}
    fit = ac.fit(system, data, ["x"], regularizers=[lambda *_: jnp.zeros(())], **options)
    for name in ("controller", "actuator"):
        assert float(before[name](1.0)) != float(fit.params[name](1.0))
    context, found = fit.problem.context, run(fit.params)
    np.testing.assert_allclose(context.arguments["actuator"][:, 0], run(before)["u"], atol=1e-9)
    np.testing.assert_allclose(fit.arguments["actuator"][:, 0], found["u"], atol=1e-9)
    e = r - np.asarray(found["x"])
    np.testing.assert_allclose(fit.arguments["controller"][:, 0], e, atol=1e-9)


class SampleAndHold(ac.Component):
    """It keeps what it has read, and integrates it."""

    k, period = ac.Parameter(1.0), ac.Parameter(0.1)
    r = ac.Input()
    u = ac.Discrete(0.0)
    x = ac.Variable(start=0.0)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), self.k * self.u)
        yield ac.When(ac.sample(0.0, self.period), ac.Eq(self.u, self.r))


def sampled_record(seed: int, n: int) -> ac.Data:
    """An input that jumps every 0.1 s, and its integral, every 0.01 s."""
    r = np.repeat(np.random.default_rng(seed).standard_normal(n // 10 + 1), 10)[: n + 1]
    x = np.append(0.0, np.cumsum(r[:-1]) * 0.01)
    return ac.Data(0.01 * np.arange(n + 1), {"r": r, "x": x}, interpolation={"r": "previous"})


@pytest.mark.cases(slow=1)
@pytest.mark.slow
@pytest.mark.parametrize("period", [0.1, 0.01])
def test_a_tick_at_a_jump_reads_what_is_behind_it_in_each_of_several_records(period: float) -> None:
    records = {"a": sampled_record(0, 400), "b": sampled_record(1, 300)}
    options: dict[str, Any] = {"strategy": "whole_record", "epochs": 1, "x0": "model"}
    system, params = ac.compile(SampleAndHold()), {"period": period}
    fit = ac.fit(system, records, ["x"], params=params, modifiers=["k"], solver="heun", **options)
    found = np.asarray(fit.problem.simulate(fit.problem.start()).y)[:, 0]
    exact = np.concatenate([r.signals["x"] for r in records.values()])
    np.testing.assert_allclose(found, exact, atol=1e-12)


class Sampled(ac.Component):
    """A lag behind a sample-and-hold of its input."""

    T, tau = ac.Parameter(0.2), ac.Parameter(0.5, min=0)
    r, x, u = ac.Input(), ac.Variable(start=0.0), ac.Discrete(0.0)

    def equations(self) -> Any:
        yield ac.Eq(self.tau * ac.der(self.x), self.u - self.x)
        yield ac.When(ac.sample(0, self.T), ac.Eq(self.u, self.r))


@pytest.mark.slow
def test_an_input_that_jumps_as_it_is_sampled_is_read_alike_by_derivatives() -> None:
    """At 10 s both instants differ by rounding; forward mode read the input before it jumped."""
    system, t = ac.compile(Sampled()), np.arange(0, 15, 0.05)
    r = np.repeat([1.0, -0.5, 0.7], 100)
    record = ac.Data(t, {"r": r, "x": np.sin(t)}, interpolation={"r": "previous"})
    options = FitOptions(strategy="gauss_newton", modifiers=["tau"])
    problem = build_problem(system, {"": record}, ("x",), system.parameters(), options)
    start = problem.start()
    simulated = problem.simulate(start)
    assert (np.asarray(simulated.d) == r[:, None]).all(axis=0).any(), (
        "what is held is what was given"
    )
    assert np.allclose(problem.predict(start, problem.assemble(start)), simulated.y, atol=1e-12)
