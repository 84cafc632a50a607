"""States at which records start: found within what is known of them, by default."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

import acausal as ac
from acausal.components import translational as tl
from acausal.data import noise_level
from acausal.training.objective.start_prior import start_prior
from tests.support.oscillator import force, plain, record

QUIET = {"strategy": "gauss_newton", "solver": "rk4", "progress": False}


def noisy(data: ac.Data, share: float, leave_out: tuple[str, ...] = ()) -> ac.Data:
    rng = np.random.default_rng(3)
    signals = {n: np.asarray(x) for n, x in data.signals.items()}
    shaken = {
        n: x + (n != "push.f") * share * x.std() * rng.standard_normal(len(x))
        for n, x in signals.items()
    }
    return ac.Data(data.time, {n: x for n, x in shaken.items() if n not in leave_out})


@pytest.mark.parametrize("count", [60, 2000])
def test_the_noise_of_a_signal_is_told_from_the_signal(count: int):
    t = np.linspace(0, 10, count)
    rng = np.random.default_rng(0)
    pieces = [np.sin(t), np.cos(2 * t)]
    noise = [0.03 * rng.standard_normal(count) for _ in pieces]
    level = noise_level([a + b for a, b in zip(pieces, noise, strict=True)])
    assert level == pytest.approx(0.03, rel=0.25)
    assert noise_level(pieces) < 1e-3 * level
    with_gap = pieces[0] + noise[0]
    with_gap[5:9] = np.nan
    assert noise_level([with_gap]) == pytest.approx(0.03, rel=0.4)
    uneven = np.sort(rng.choice(count, count // 2, replace=False))
    samples = (pieces[1] + noise[1])[uneven]
    assert noise_level([samples], [t[uneven]]) == pytest.approx(0.03, rel=0.4)
    assert noise_level([pieces[1][uneven]], [t[uneven]]) < 0.05 * level


@pytest.mark.slow
def test_measured_starts_are_found_within_their_noise():
    """Taken as true, the first noisy samples make the mass pay for them."""
    clean = record(cubic=0.0).between(4.0, 10.0)
    data = noisy(clean, 0.1)
    fit = ac.fit(plain(), data, ["mass.s"], modifiers=["mass.m"], **QUIET)
    for name in ("mass.s", "mass.v"):
        noise = 0.1 * np.std(clean[name])
        assert abs(fit.x0[name] - clean[name][0]) < 0.5 * noise
        assert abs(data[name][0] - clean[name][0]) > 0.6 * noise  # as measured
    assert "x0        found: 'mass.s', 'mass.v' near the measured start" in repr(fit)
    given = ac.fit(plain(), data, ["mass.s"], modifiers=["mass.m"], x0="data", **QUIET)
    assert given.x0["mass.s"] == pytest.approx(data["mass.s"][0], rel=1e-12)
    assert given.trained.starts is None
    assert given.loss > 1.05 * fit.loss


@pytest.mark.slow
def test_a_start_that_is_not_measured_is_found_near_that_of_the_model():
    clean = record(cubic=0.0).between(4.0, 10.0)
    data = noisy(clean, 0.01, ("mass.v",))
    fit = ac.fit(plain(), data, ["mass.s", "mass.a"], modifiers=["mass.m"], **QUIET)
    assert fit.x0["mass.v"] == pytest.approx(clean["mass.v"][0], abs=0.01 * np.std(clean["mass.v"]))
    assert "'mass.v' near the model's start" in repr(fit)
    assert fit.params["mass.m"] == pytest.approx(2.0, rel=3e-3)
    assert fit.confidence().parameters["mass.m"] < 3e-3
    known = ac.fit(
        plain(), data, ["mass.s", "mass.a"], modifiers=["mass.m"], x0={"mass.s": 0.25}, **QUIET
    )
    assert known.x0["mass.s"] == 0.25  # exactly as given
    assert known.x0["mass.v"] != 0


@pytest.mark.slow
def test_starts_without_noise_are_exact():
    fit = ac.fit(plain(), record(cubic=0.0, end=3.0), ["mass.s"], modifiers=["mass.m"], **QUIET)
    assert fit.trained.starts is None
    assert "x0 " not in repr(fit)


class Sledge(ac.Component):
    """A mass that a damper brakes: nothing depends on its position."""

    def __init__(self) -> None:
        super().__init__()
        self.ground, self.damper = tl.Fixed(), tl.Damper(d=1.0)
        self.mass, self.push = tl.Mass(m=1.0), tl.Force()
        self.connect(self.ground.flange, self.damper.flange_a)
        self.connect(self.damper.flange_b, self.mass.flange_a)
        self.connect(self.mass.flange_b, self.push.flange)


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("given", [{}, {"x0": {"mass.v": 0.0}}])
def test_nothing_is_demanded_of_a_position_on_which_nothing_depends(given: dict[str, object]):
    t = np.linspace(0, 4, 201)
    true = ac.simulate(ac.compile(Sledge()), (0, 4), dt=0.02, inputs={"push.f": force(t)})
    data = ac.Data(t, {"push.f": force(t), "mass.v": np.asarray(true["mass.v"])})
    start = {"damper.d": 2.0}
    fit = ac.fit(
        ac.compile(Sledge()),
        data,
        ["mass.v"],
        modifiers=list(start),
        params=start,
        **given,
        **QUIET,
    )
    assert fit.params["damper.d"] == pytest.approx(1.0, rel=1e-3)


class Lag(ac.Component):
    """A lag, and one behind it that is not measured."""

    K, T = ac.Parameter(1.0, min=0), ac.Parameter(1.0, min=0, unit="s")
    u = ac.Input()
    x, z = ac.Variable(), ac.Variable(start=1.0)

    def equations(self):
        yield ac.Eq(self.T * ac.der(self.x), self.K * self.u + self.z - self.x)
        yield ac.Eq(5 * self.T * ac.der(self.z), -self.z)


@pytest.mark.slow
def test_a_start_far_from_what_it_was_taken_to_be_is_told() -> None:
    system, t = ac.compile(Lag()), np.linspace(0, 3, 61)
    truth = ac.simulate(system, 3.0, saveat=t, inputs={"u": 1.0}, x0={"x": 0.0, "z": 6.0})
    noise = 0.01 * np.random.default_rng(0).standard_normal(61)
    data = ac.Data(t, {"u": np.ones(61), "x": np.asarray(truth["x"]) + noise})
    fit = ac.fit(system, data, ["x"], modifiers=["K", "T"], **QUIET)
    assert "'z' was found to start" in str(fit)
    assert "(x0='fit')" in str(fit)
    known = ac.fit(system, data, ["x"], modifiers=["K", "T"], x0={"x": 0.0, "z": 6.0}, **QUIET)
    assert "found to start" not in str(known)


@pytest.mark.slow
def test_as_many_samples_as_numbers_are_no_proof() -> None:
    t = np.array([0.0, 1.0, 3.0])
    data = ac.Data(t, {"u": np.ones(3), "x": np.array([0.0, 1.3, 2.1])})
    fit = ac.fit(ac.compile(Lag()), data, ["x"], modifiers=["K", "T"], **QUIET)
    assert "3 samples are explained by as many numbers" in str(fit)


class Behind(ac.Component):
    """A state that nobody measures behind a law of it: where it starts decides what the law is at which value."""

    u = ac.Input()
    z = ac.Variable(start=0.9, fixed=True)
    y = ac.Variable()
    law = ac.Module(ac.networks.Law())

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.z), -self.u)
        yield ac.Eq(self.y, self.law(self.z))


def behind(start: float, begin: float = 0.0) -> ac.Data:
    t = np.linspace(0, 20, 201)
    u = np.where(t % 6 < 3, 0.05, -0.01)
    z = start - np.concatenate([[0.0], np.cumsum((u[1:] + u[:-1]) / 2 * np.diff(t))])
    noise = 0.003 * np.random.default_rng(2).standard_normal(len(t))
    return ac.Data(t + begin, {"u": u, "y": 3 + z - 0.4 * np.exp(-6 * z) + noise})


@pytest.mark.slow
def test_a_start_that_the_model_fixes_is_exact() -> None:
    fit = ac.fit(ac.compile(Behind()), behind(0.9), ["y"], progress=False)
    assert fit.x0["z"] == 0.9
    assert fit.trained.starts is None
    z = np.linspace(0.55, 0.9, 8)
    np.testing.assert_allclose(
        [fit.params["law"](v) for v in z], 3 + z - 0.4 * np.exp(-6 * z), atol=0.01
    )


def test_it_is_open_where_a_record_begins_later() -> None:
    system = ac.compile(Behind())
    for own, begins in ((behind(0.9), 0), (behind(0.9, 5.0), 1)):
        prior = start_prior(system, {"one": own}, "auto")
        assert (prior is not None) == bool(begins)


class Fading(ac.Component):
    """A hidden state adds to an input."""

    u = ac.Input()
    hidden = ac.Variable(start=0.0, fixed=True)
    y = ac.Variable(start=0.0)
    tau = ac.Parameter(1.0, min=0)

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(3 * ac.der(self.hidden), -self.hidden)
        yield ac.Eq(self.tau * ac.der(self.y), self.hidden + self.u - self.y)


@pytest.mark.slow
def test_a_fixed_start_that_the_record_does_not_have_is_named() -> None:
    t = np.linspace(0, 20, 201)
    given = {"u": np.sin(t) + np.sin(0.3 * t)}
    system = ac.compile(Fading())
    run = ac.simulate(
        system, 20.0, dt=0.1, inputs=given, params={"tau": 1.2}, x0={"hidden": 2.0}, solver="rk4"
    )
    y = np.asarray(run["y"]) + 0.01 * np.random.default_rng(1).standard_normal(len(t))
    with pytest.warns(UserWarning, match="does not explain"):
        fit = ac.fit(
            system, ac.Data(t, {**given, "y": y}), ["y"], modifiers=["tau"], progress=False
        )
    assert "hidden did not start where it was taken to (leave it open: x0='fit')" in str(
        fit.verdict
    )
