"""Parameters that act through conditions alone, unseen by derivatives: which, and the warning of them."""

import warnings
from collections.abc import Callable, Iterator
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks
from acausal.flattening import flatten

Case = Callable[[Any], Any]


class Load(ac.Component):
    """A state whose rate a case distinction gives."""

    limit = ac.Parameter(0.5)
    k = ac.Parameter(2.0)
    x = ac.Variable(start=1.0, fixed=True)

    def __init__(self, case: Case, *, discrete: bool = False) -> None:
        super().__init__()
        self.case, self.discrete = case, discrete

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), self.case(self) - self.x)


class Within(ac.Component):
    """Two loads."""

    def __init__(self, case: Case) -> None:
        super().__init__()
        self.first, self.second = Load(case), Load(case)


@pytest.mark.parametrize(
    "case",
    [
        lambda s: ac.where(s.x > s.limit, s.k, 0),
        lambda s: ac.where((s.x < s.limit) & (ac.time > 1), 1, s.k),
        lambda s: ac.where(s.x > 3, 0, ac.where(s.x > 2 * s.limit, s.k * s.x, 1)),
        lambda s: ac.where(ac.sin(ac.time) + ac.sin(2 * ac.time) > s.limit, 1, 0),
        lambda s: ac.where(s.x**2 + ac.sin(s.limit * s.x) > 0, 1, 0),
    ],
)
def test_a_parameter_without_gradient_is_named(case: Case) -> None:
    with pytest.warns(UserWarning, match="The gradient by 'first.limit' is zero") as caught:
        ac.compile(Within(case))
    (warning,) = caught
    assert "write ac.where(..., events=True)." in str(warning.message)
    assert warning.filename == __file__
    assert set(flatten(Within(case)).silent) == {"first.limit", "second.limit"}


@pytest.mark.parametrize(
    "case",
    [
        lambda s: ac.where(s.x > s.limit, s.k, 0, events=True),
        lambda s: ac.where(s.x > s.limit, s.k * (s.x - s.limit), 0),
        lambda s: ac.where(s.x > s.limit, s.k, 0) + s.limit,
        lambda s: ac.where(s.x > 0, s.x, 0),
        lambda s: ac.where(s.x > s.limit, s.x, ac.maximum(s.x, s.limit)),
        lambda s: ac.where(s.limit > s.k, 1, 0),
        lambda s: ac.where(ac.time > s.limit, 1, 0),
        lambda s: ac.where(s.k * ac.sin(ac.time) > s.limit, 1, 0),
        lambda s: ac.where(ac.Abs(ac.sin(ac.time)) > s.limit, 1, 0),
        lambda s: ac.where(ac.where(ac.time < 5, 1, 2) * ac.sin(ac.time) > s.limit, 1, 0),
        lambda s: ac.where(ac.time - ac.floor(ac.time / s.k) * s.k > s.limit, 1, 0),
    ],
)
def test_what_is_continuous_or_acts_elsewhere_is_not_warned_of(case: Case) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        flat = flatten(Load(case))
    assert not flat.silent


def test_equations_of_discrete_variables_are_watched() -> None:
    class Relay(ac.Component):
        limit = ac.Parameter(0.5)
        x = ac.Variable(start=0.0, fixed=True)
        on = ac.Discrete(0, kind="bool")

        def equations(self) -> Iterator[Any]:
            yield ac.Eq(ac.der(self.x), 1)
            yield ac.Eq(self.on, ac.where(self.x > self.limit, 1, 0))

    assert not flatten(Relay()).silent


class Stepped(ac.Component):
    """A lag behind a step."""

    def __init__(self) -> None:
        super().__init__()
        self.step = blocks.Step(startTime=0.5)
        self.lag = blocks.FirstOrder(T=0.3, y=ac.Start(0.0, fixed=True))
        self.connect(self.step.y, self.lag.u)


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize("events", [False, True])
def test_a_time_that_is_known_ahead_has_a_gradient(events: bool) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        system = ac.compile(Stepped(), events=events)
    assert (system.events is not None) == events
    assert not system.flat.silent

    def end(start: float) -> Any:
        params = {**system.parameters(), "step.startTime": start}
        found = ac.simulate(system, (0.0, 1.0), params=params, saveat=[1.0], rtol=1e-9, atol=1e-12)
        return found["lag.y"][-1]

    assert float(jax.grad(end)(0.5)) == pytest.approx(-np.exp(-0.5 / 0.3) / 0.3, rel=1e-6)


@pytest.mark.slow
def test_a_training_finds_the_time_of_a_step() -> None:
    system = ac.compile(Stepped())
    watched = ac.compile(Stepped(), events=True)
    record = ac.simulate(watched, (0.0, 1.0), dt=0.1, solver="rk4")
    data = ac.Data(record.t, {"lag.y": record["lag.y"]})
    fit = ac.fit(
        system,
        data,
        targets=["lag.y"],
        params={"step.startTime": 0.43},
        modifiers=["step.startTime"],
        strategy="gauss_newton",
        solver="rk4",
        epochs=15,
    )
    assert fit.params["step.startTime"] == pytest.approx(0.5, abs=1e-2)


class Slowed(ac.Component):
    """A ramp that becomes slower where k times it passes the threshold of a block: 1, then 0.2 a second."""

    def __init__(self) -> None:
        super().__init__()
        self.ramp, self.gain = blocks.Integrator(y_start=0.0), blocks.Gain(k=2.0)
        self.passed = blocks.GreaterThreshold(threshold=1.0)
        self.rate = blocks.BooleanToReal(realTrue=0.2, realFalse=1.0)
        self.connect(self.ramp.y, self.gain.u)
        self.connect(self.gain.y, self.passed.u)
        self.connect(self.passed.y, self.rate.u)
        self.connect(self.rate.y, self.ramp.u)


@pytest.mark.slow
def test_all_that_moves_the_instant_of_a_block_has_a_gradient() -> None:
    """The end is y0 + t + 0.2 (2 - t) with t = threshold / k - y0."""
    system = ac.compile(Slowed())
    for name, exact in (("gain.k", -0.2), ("passed.threshold", 0.4), ("ramp.y_start", 0.2)):

        def end(value: float, name: str = name) -> Any:
            return ac.simulate(system, 2.0, params={name: value}, saveat=[2.0])["ramp.y"][0]

        assert float(jax.grad(end)(float(system.parameters()[name]))) == pytest.approx(exact)


@pytest.mark.slow
def test_derivatives_over_a_literal_jump_are_warned_of() -> None:
    system = ac.compile(Load(lambda s: ac.where(s.x > 0.5, s.k, 1)))

    def end(x: float) -> Any:
        return ac.simulate(system, 2.0, x0={"x": x}, saveat=[2.0])["x"][0]

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        end(0.0)
    says = r"Values jump at the condition x > 0\.5, which is no event: if its instant moves, derivatives do not see it"
    with pytest.warns(UserWarning, match=says):
        jax.grad(end)(0.0)
