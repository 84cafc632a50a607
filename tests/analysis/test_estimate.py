"""Kalman filters and smoothers against closed formulas, differences, and the truth."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.linalg import expm
from scipy.stats import chi2

import acausal as ac
from acausal.analysis.filtering import (
    Belief,
    Linearized,
    Measured,
    by_derivatives,
    by_points,
    gathered as gathered_in_steps,
    run,
)
from examples.qvm.model import with_networks
from tests.support.oscillator import C, D, M, force, plain
from tests.support.parts import Equations

H, N, R, Q = 0.05, 60, 0.02, 0.3
GIVEN = {
    "states": {"mass.s": 0.2, "mass.v": 0.5}, "x0": {"mass.s": 0.1, "mass.v": -0.2}, "dt": H / 20,
    "solver": "rk4", "noise": {"mass.v": Q}, "sensors": {"mass.s": R, "mass.a": 0.5},
}  # fmt: skip


def record(seed: int = 0) -> ac.Data:
    """Position and acceleration with gaps: the one is missing at every third sample, both at some."""
    rng, t = np.random.default_rng(seed), H * np.arange(N)
    run = ac.simulate(plain(), t[-1], dt=H, inputs={"push.f": force(t)}, solver="dopri8")
    s = np.asarray(run["mass.s"]) + R * rng.standard_normal(N)
    a = np.asarray(run["mass.a"]) + 0.5 * rng.standard_normal(N)
    s[::3], s[10:14], a[12:20] = np.nan, np.nan, np.nan
    return ac.Data(t, {"push.f": force(t), "mass.s": s, "mass.a": a}, missing="nan")


def gathered(A: np.ndarray, density: np.ndarray, h: float) -> np.ndarray:
    """What white noise adds up to over a time: C. Van Loan, IEEE TAC 23, 1978, theorem 1."""
    n = len(A)
    whole = expm(np.block([[-A, density], [np.zeros((n, n)), A.T]]) * h)
    return whole[n:, n:].T @ whole[:n, n:]


def by_hand(data: ac.Data) -> tuple[np.ndarray, ...]:
    """A Kalman filter and smoother in matrices, without the library; the input is linear in each step."""
    A, B = np.array([[0, 1], [-C / M, -D / M]]), np.array([[0], [1 / M]])
    zero = np.zeros((1, 2))
    whole = np.block([[A, B, 0 * B], [zero, 0, 1], [zero, 0, 0]])
    power = expm(whole * H)
    F, held, ramp = power[:2, :2], power[:2, 2], power[:2, 3]
    rows = np.array([[1, 0], [-C / M, -D / M]])
    u, y = data["push.f"], np.stack([data["mass.s"], data["mass.a"]], axis=1)
    m, P, likelihood = np.array([0.1, -0.2]), np.diag([0.04, 0.25]), 0.0
    means, covariances, ahead = [], [], []
    for k in range(N):
        if k:
            m = F @ m + held * u[k - 1] + ramp * (u[k] - u[k - 1]) / H
            P = F @ P @ F.T + gathered(A, np.diag([0, Q**2]), H)
        ahead.append((m, P))
        known = np.isfinite(y[k])
        if known.any():
            G, W = rows[known], np.diag(np.array([R**2, 0.25])[known])
            v = y[k, known] - G @ m - np.array([0, u[k] / M])[known]
            S = G @ P @ G.T + W
            K = P @ G.T @ np.linalg.inv(S)
            m, P = m + K @ v, P - K @ S @ K.T
            size = np.linalg.slogdet(2 * np.pi * S)[1]
            likelihood -= 0.5 * (v @ np.linalg.solve(S, v) + size)
        means.append(m)
        covariances.append(P)
    smooth = [(means[-1], covariances[-1])]
    for k in reversed(range(N - 1)):
        G = covariances[k] @ F.T @ np.linalg.inv(ahead[k + 1][1])
        late, spread = smooth[0]
        m = means[k] + G @ (late - ahead[k + 1][0])
        smooth.insert(0, (m, covariances[k] + G @ (spread - ahead[k + 1][1]) @ G.T))
    later, spread = (np.array(part) for part in zip(*smooth, strict=True))
    return np.array(means), np.array(covariances), np.array(likelihood), later, spread


@pytest.mark.slow
@pytest.mark.parametrize("method", ["ekf", "ukf"])
def test_linear_models_have_the_estimates_of_the_kalman_filter_and_smoother(method):
    data = record()
    found = ac.estimate(plain(), data, method, **GIVEN)
    m, P, likelihood, late, spread = by_hand(data)
    assert plain().states == ("mass.s", "mass.v")
    np.testing.assert_allclose(found.x, m, atol=1e-8)
    np.testing.assert_allclose(found.covariance, P, atol=1e-8)
    assert float(found.log_likelihood) == pytest.approx(float(likelihood), abs=1e-6)
    later = found.smooth()
    np.testing.assert_allclose(later.x, late, atol=1e-8)
    np.testing.assert_allclose(later.covariance, spread, atol=1e-8)
    np.testing.assert_allclose(found.deviation("mass.v"), np.sqrt(P[:, 1, 1]), atol=1e-8)
    row = np.array([-C / M, -D / M])
    wanted = np.sqrt(np.einsum("i,kij,j->k", row, P, row))
    np.testing.assert_allclose(found.deviation(["mass.s", "mass.a"])[:, 1], wanted, atol=1e-7)
    assert np.isnan(found.innovations["mass.s"][:2]).tolist() == [True, False]


@pytest.mark.slow
def test_the_order_of_sensors_changes_nothing_and_an_ensemble_is_near():
    data = record()
    found = ac.estimate(plain(), data, **GIVEN)
    turned = dict(reversed(GIVEN["sensors"].items()))
    other = ac.estimate(plain(), data, **{**GIVEN, "sensors": turned})
    np.testing.assert_allclose(found.x, other.x, atol=1e-13)
    assert list(other.innovations) == ["mass.a", "mass.s"]
    many = ac.estimate(plain(), data, "enkf", members=2000, **GIVEN)
    off = (many.x - found.x) / np.sqrt(np.diagonal(found.covariance, 0, 1, 2))
    assert np.sqrt(np.mean(off**2)) < 0.15


class Lag(ac.Component):
    """What forgets within a second."""

    x = ac.Variable(start=0.0)
    u = ac.Input()

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.u - self.x)


@pytest.mark.slow
@pytest.mark.parametrize("h", [0.2, 5.0])
def test_noise_means_the_same_however_far_samples_are_apart(h: float):
    """White noise of density q² on a lag of T has the variance q² T / 2."""
    t = h * np.arange(12)
    lag, data = ac.compile(Lag()), ac.Data(t, {"u": 0 * t, "x": 0 * t})
    found = ac.estimate(lag, data, noise={"x": 1.0}, sensors={"x": 1e4}, states={"x": 0.7})
    assert float(found.deviation("x")[-1]) == pytest.approx(np.sqrt(0.5), rel=1e-3)


@pytest.mark.slow
def test_noise_gathers_as_the_integral_says():
    A = np.array([[0.0, 1.0], [-4.0, -0.3]])
    found = gathered_in_steps(jnp.asarray(3 * A), jnp.array([0.1, 0.4]), 14)
    wanted = gathered(3 * A, np.diag([0.01, 0.16]), 1.0)
    np.testing.assert_allclose(found, wanted, rtol=1e-6, atol=1e-9)
    unstable = gathered_in_steps(1e5 * jnp.eye(2), jnp.ones(2), 14)
    np.testing.assert_allclose(unstable, np.eye(2))


@pytest.mark.slow
def test_two_rows_are_enough_and_what_is_no_number_changes_no_observer():
    lag = ac.compile(Lag())
    data = ac.Data([0.0, 1.0], {"x": [0.0, 0.1], "u": [0.0, 0.0]})
    assert np.isfinite(ac.estimate(lag, data).x).all()
    seen = ac.observer(lag, {"x": 0.1}, {"x": 0.1}, sample_time=0.1)
    seen.step(0.0, {"u": 1.0}, {"x": 0.1})
    with pytest.raises(ac.DataError, match=r"u: 'u' is not finite at t=0\.1 s"):
        seen.step(0.1, {"u": np.nan}, {"x": 0.2})
    with pytest.raises(ac.DataError, match=r"y: 'x' is inf; give a finite number, or NaN"):
        seen.step(0.1, {"u": 1.0}, {"x": np.inf})
    assert np.isfinite(seen.step(0.1, {"u": 1.0}, {"x": 0.2})["x"])


@pytest.mark.slow
def test_an_estimate_that_diverges_says_where():
    def stated(s):
        yield ac.Eq(ac.der(s.x), s.y)
        yield ac.Eq(ac.der(s.y), 100 * (1 - s.x**2) * s.y - s.x)

    model = Equations("x y", stated)
    model.modify(x=ac.Start(2.0))
    system, t = ac.compile(model), np.arange(0, 100.0)
    run = ac.simulate(system, t[-1], saveat=t)
    noise = 0.05 * np.random.default_rng(0).standard_normal(100)
    data = ac.Data(t, {"x": np.asarray(run["x"]) + noise})
    given = {"sensors": {"x": 0.05}, "noise": {"x": 0.005}, "states": {"x": 0.05, "y": 0.01}}
    with pytest.warns(UserWarning, match=r"not finite from t = \d+ s on: .* solver='kvaerno3'"):
        ac.estimate(system, data, **given, solver="rk4", dt=0.5)


@pytest.mark.slow
def test_the_gradient_of_the_likelihood_is_that_of_differences():
    data = record()

    @jax.jit
    def likelihood(c: jax.Array) -> jax.Array:
        return ac.estimate(plain(), data, params={"spring.c": c}, **GIVEN).log_likelihood

    slope = float(jax.grad(likelihood)(jnp.asarray(C)))
    wanted = float(likelihood(jnp.asarray(C + 1e-3)) - likelihood(jnp.asarray(C - 1e-3))) / 2e-3
    assert slope == pytest.approx(wanted, rel=1e-6)


@pytest.mark.slow
def test_an_observer_steps_as_the_estimate_does():
    whole = record()
    with_pause = np.r_[0:20, 35 : len(whole)]
    data = ac.Data(
        whole.time[with_pause],
        {n: whole[n][with_pause] for n in ("push.f", *GIVEN["sensors"])},
        missing="nan",
    )
    found = ac.estimate(plain(), data, **GIVEN)
    given = {k: v for k, v in GIVEN.items() if k not in ("sensors", "noise")}
    seen = ac.observer(plain(), GIVEN["sensors"], GIVEN["noise"], H, **given)
    for k, t in enumerate(data.time):
        y = {n: data[n][k] for n in GIVEN["sensors"]}
        told = seen.step(t, {"push.f": data["push.f"][k]}, y)
    np.testing.assert_allclose(list(told.values()), found.x[-1], atol=1e-12)
    np.testing.assert_allclose(seen.covariance, found.covariance[-1], atol=1e-12)
    assert seen["mass.a"] == pytest.approx(float(found["mass.a"][-1]), abs=1e-10)
    with pytest.raises(ac.DataError, match="is not later than the last step"):
        seen.step(0.0)
    with pytest.raises(
        ac.DataError, match=r"'mass.v' is not a sensor; the observer has mass.s, mass.a"
    ):
        seen.step(100.0, y={"mass.v": 0.0})
    with pytest.raises(ac.DataError, match="is more than 1000000 times sample_time; make a new"):
        seen.step(1e9)


@pytest.mark.slow
def test_late_measurements_count_as_if_they_had_come_in_time():
    """One comes at the time of a step, one between two; inputs then are on the line between those of the steps."""
    given = {k: v for k, v in GIVEN.items() if k not in ("sensors", "noise")}
    late, prompt = (
        ac.observer(plain(), GIVEN["sensors"], GIVEN["noise"], H, late=seconds, **given)
        for seconds in (2.4 * H, 0.0)
    )
    force = {0.0: 1.0, H: 3.0, 1.5 * H: 2.0, 2 * H: 1.0, 3 * H: 0.0, 4 * H: 1.0}
    seen = {0.0: {"mass.s": 0.1}, H: {"mass.s": 0.12, "mass.a": 1.0}, 1.5 * H: {"mass.a": 2.0}}
    for t, f in force.items():
        wanted = prompt.step(t, {"push.f": f}, seen.get(t))
    for k in range(4):
        late.step(
            k * H, {"push.f": force[k * H]}, {"mass.s": seen[k * H]["mass.s"]} if k < 2 else {}
        )
    late.step(1.5 * H, y=seen[1.5 * H])
    late.step(H, y={"mass.a": 1.0})
    found = late.step(4 * H, {"push.f": force[4 * H]})
    assert late.t == prompt.t
    np.testing.assert_allclose(list(found.values()), list(wanted.values()), atol=1e-13)
    np.testing.assert_allclose(late.covariance, prompt.covariance, atol=1e-13)
    with pytest.raises(ac.DataError, match=r"not later than the last step, at 0\.2 s; for"):
        late.step(H, y={"mass.a": 1.0})
    with pytest.raises(ac.DataError, match=r"inputs are known up to 0\.2 s; leave u out"):
        late.step(3 * H, {"push.f": 1.0}, {"mass.a": 1.0})


class Swing:
    """The oscillator without a force along rows, in matrices."""

    F = jnp.asarray(expm(np.array([[0, 1], [-C / M, -D / M]]) * H))

    def step(self, row: jax.Array):
        return lambda z: self.F @ z

    def observe(self, row: jax.Array):
        return lambda z: z[:1]

    def noise(self, row: jax.Array, z: jax.Array, sigma: jax.Array):
        return jnp.diag(sigma**2)


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("line", [by_derivatives, by_points])
def test_filters_are_consistent_over_many_runs(line):
    """Normalized errors of states (NEES) and innovations (NIS) of 200 runs are within their chi-square bounds."""
    runs, rng, path = 200, np.random.default_rng(1), Swing()
    x = rng.standard_normal((runs, 2)) * [0.2, 0.5]
    states = [x]
    for _ in range(N - 1):
        x = x @ path.F.T + rng.standard_normal((runs, 1)) * [0, Q * np.sqrt(H)]
        states.append(x)
    truth = np.stack(states, axis=1)
    y = jnp.asarray(truth[:, :, :1] + R * rng.standard_normal((runs, N, 1)))
    start = Belief(jnp.zeros(2), jnp.diag(jnp.array([0.04, 0.25])))
    walk = jnp.full((N - 1, 2), Q * np.sqrt(H)) * jnp.array([0.0, 1.0])

    @jax.jit
    @jax.vmap
    def filtered(y: jax.Array):
        measured = Measured(y, jnp.ones((N, 1), bool), jnp.array([R]))
        return run(Linearized(line), path, start, measured, walk, jax.random.key(0))

    found = filtered(y)
    off = np.asarray(found.mean - truth)[..., None]
    nees = np.sum(off * np.linalg.solve(found.covariance, off), axis=(2, 3))
    nis = np.asarray(found.innovation.value**2 / found.innovation.covariance[..., 0])
    for row in (0, 5, N - 1):
        low, high = chi2.ppf([0.001, 0.999], 2 * runs)
        assert low < nees[:, row].sum() < high
    low, high = chi2.ppf([0.001, 0.999], nis.size)
    assert low < nis.sum() < high


class Pendulum(ac.Component):
    """A pendulum with friction; its rate is not measured."""

    phi = ac.Variable(unit="rad", start=0.5)
    w = ac.Variable(unit="rad/s", start=0.0)
    x = ac.Variable(unit="m")
    length = ac.Parameter(1.0, unit="m")
    rub = ac.Parameter(0.2, unit="1/s")

    def equations(self):
        yield ac.Eq(ac.der(self.phi), self.w)
        yield ac.Eq(ac.der(self.w), -9.81 / self.length * ac.sin(self.phi) - self.rub * self.w)
        yield ac.Eq(self.x, self.length * ac.sin(self.phi))


@pytest.mark.slow
@pytest.mark.parametrize("method", ["ekf", "ukf"])
def test_states_and_a_parameter_of_a_pendulum_are_found(method):
    system = ac.compile(Pendulum(), check_units=False)
    truth = ac.simulate(system, 10, dt=0.02, x0={"phi": 0.8, "w": -1.0}, params={"length": 1.3})
    rng = np.random.default_rng(0)
    data = ac.Data(truth.t, {"x": truth["x"] + 0.01 * rng.standard_normal(len(truth.t))})
    found = ac.estimate(
        system, data, method, parameters={"length": 0.3}, states={"phi": 0.5, "w": 1.0},
        x0={"phi": 0.5}, noise={"w": 1e-3},
    )  # fmt: skip
    assert float(found["length"][-1]) == pytest.approx(
        1.3, abs=5 * float(found.deviation("length")[-1])
    )
    assert float(found.deviation("length")[-1]) < 0.01
    assert np.max(np.abs(found["w"][-100:] - truth["w"][-100:])) < 0.05
    assert found["w"].shape == (501,)


@pytest.mark.cases(slow=2)
@pytest.mark.slow
@pytest.mark.parametrize("method", ["ekf", "ukf", "mhe"])
def test_the_wheel_of_a_vehicle_is_seen_through_the_acceleration_of_its_body(method):
    """From a start that is 2 cm and 0.3 m/s off; a simulation from there takes its time to forget it."""
    system, t = ac.compile(with_networks()), 0.002 * np.arange(300)
    inputs = {"road.v_ref": 0.4 * np.sin(25 * t) + 0.2 * np.sin(60 * t)}
    truth, wrong = (
        ac.simulate(system, t[-1], dt=0.002, x0=x0, inputs=inputs, solver="rk4")
        for x0 in ({"wheel.s": 0.02, "wheel.v": 0.3}, {})
    )
    noisy = truth["body.a"] + 0.05 * np.random.default_rng(0).standard_normal(300)
    found = ac.estimate(
        system, ac.Data(t, {**inputs, "body.a": noisy}), method, sensors={"body.a": 0.05}, window=10,
        noise={"wheel.v": 0.02, "body.v": 0.02}, states={"wheel.s": 0.02, "wheel.v": 0.3},
    )  # fmt: skip
    off, without = (np.asarray(r["wheel.v"] - truth["wheel.v"])[10:60] for r in (found, wrong))
    assert np.sqrt(np.mean(off**2)) < 0.2 * np.sqrt(np.mean(without**2))


@pytest.mark.slow
def test_fitted_noise_is_more_likely_than_the_default():
    given = {"dt": H, "states": GIVEN["states"], "sensors": ["mass.s"]}
    fitted, default = (ac.estimate(plain(), record(), noise=n, **given) for n in ("fit", None))
    assert float(fitted.log_likelihood) > float(default.log_likelihood)
    assert float(fitted.sensors["mass.s"]) == pytest.approx(R, rel=0.5)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"sensors": {"mass.z": 1.0}}, "sensors: 'mass.z' is not a variable that the model computes"),
        ({"sensors": "mass.v"}, "sensors: 'mass.v' is not measured in the record"),
        ({"sensors": {"mass.s": -1.0}}, "sensors: 'mass.s' is -1.0; give a finite number that is not"),
        ({"noise": {"mass.x": 1.0}}, "noise: 'mass.x' is not a state, nor a parameter"),
        ({"noise": {"mass.v": -1.0}}, "noise: 'mass.v' is -1.0"),
        ({"noise": "auto"}, "noise='auto': give 'fit', or numbers"),
        ({"states": {"mass.a": 1.0}}, "states: 'mass.a' is not a state of the model"),
        ({"parameters": {"spring.k": 1.0}}, "parameters: 'spring.k' is not a parameter of the model"),
        ({"method": "kf"}, "No method 'kf'"),
        ({"bounds": {"mass.s": (0.0, 1.0)}}, "bounds: method='ekf' keeps none; take method='mhe'"),
        ({"method": "mhe", "window": 1}, "window"),
        ({"method": "mhe", "bounds": {"mass.a": (0, 1)}}, "bounds: 'mass.a' is not estimated"),
        ({"method": "mhe", "bounds": {"mass.s": (1, 0)}}, "'mass.s' has (1, 0); give two numbers"),
        ({"dt": 0.0}, "dt=0.0 is not a step"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused(change, sentence):
    with pytest.raises(ac.DataError) as raised:
        ac.estimate(plain(), record(), **{**GIVEN, **change})
    assert sentence in str(raised.value)


def test_records_and_models_that_do_not_fit_are_refused():
    t = H * np.arange(N)
    with pytest.raises(
        ac.DataError, match=r"measures nothing that the model computes: it has push\.f"
    ):
        ac.estimate(plain(), ac.Data(t, {"push.f": t}))
    with pytest.raises(ac.DataError, match=r"lack 'push\.f', an input"):
        ac.estimate(plain(), ac.Data(t, {"mass.s": t}))


class Hardening(ac.Component):
    """An oscillator of any size."""

    size = ac.Parameter(1.0)
    u = ac.Input()
    x, v = ac.Variable(start=0.0), ac.Variable(start=0.0)

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.v)
        law = 4 * self.x + 0.3 * self.v + self.x**3 / self.size**2
        yield ac.Eq(ac.der(self.v), self.u - law)


@pytest.mark.slow
def test_the_unit_of_a_state_does_not_matter() -> None:
    """Pressures of 1e7 Pa are known at the start as displacements of 1 m are."""
    system, t = ac.compile(Hardening()), np.linspace(0, 5, 101)
    push, found = np.sin(3 * t) + np.cos(1.3 * t), []
    noise = np.random.default_rng(0).standard_normal(len(t))
    for size in (1.0, 1e9):
        sol = ac.simulate(
            system, (0, 5), dt=0.05, inputs={"u": size * push}, params={"size": size}, solver="rk4"
        )
        data = ac.Data(t, {"u": size * push, "x": sol["x"] + 0.01 * size * noise})
        estimated = ac.estimate(
            system, data, sensors={"x": 0.01 * size}, x0={"x": 0.1 * size, "v": 0.0},
            params={"size": size},
        )  # fmt: skip
        found.append(np.asarray(estimated["v"]) / size)
    np.testing.assert_allclose(found[1], found[0], atol=1e-9)
