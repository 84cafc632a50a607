"""Fixed steps: each sees its own side of an edge or of a jump of an input, so their order is full."""

import jax
import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks
from acausal.simulation.step_grid import step_ends
from tests.support.parts import Equations, model

T, END = 0.7, 4.0


@pytest.fixture(scope="module")
def lag():
    made = model(
        "s.y - f.u",
        s=blocks.Pulse(amplitude=2.0, width=50.0, period=1.0, startTime=0.5),
        f=blocks.FirstOrder(T=T, k=1.0, y_start=0.0, initType="InitialState"),
    )
    return ac.compile(made)


def exact(start, period=1.0):
    edges = start + period / 2 * np.arange(20)
    behind = np.maximum(END - edges, 0.0)
    return float(np.sum(2.0 * (-1.0) ** np.arange(20) * -np.expm1(-behind / T)))


def errors(system, start, steps, **options):
    params = system.parameters() | {"s.startTime": start}
    found = [
        float(ac.simulate(system, END, dt=dt, params=params, **options)["f.y"][-1]) for dt in steps
    ]
    return np.abs(np.array(found) - exact(start))


@pytest.mark.parametrize(("solver", "order"), [("rk4", 4), ("heun", 2)])
def test_full_order_at_edges_on_the_grid(lag, solver, order):
    coarse, fine = errors(lag, 0.5, (0.1, 0.05), solver=solver)
    assert coarse < 2e-2 * 0.1 ** (order - 1)
    assert np.log2(coarse / fine) == pytest.approx(order, abs=0.4)


@pytest.mark.parametrize(("solver", "start"), [("kvaerno5", 0.5), ("rk4", 0.5 - 4e-15)])
def test_no_stage_looks_behind_an_edge_at_the_end_of_its_step(lag, solver, start):
    assert errors(lag, start, (0.05,), solver=solver)[0] < 1e-6


def test_full_order_at_edges_within_steps(lag):
    coarse, fine = errors(lag, 0.537, (0.1, 0.05), solver="rk4")
    assert coarse < 1e-5
    assert coarse / fine > 8


@pytest.mark.slow
def test_the_steps_that_an_edge_divides_are_saved_on_the_grid(lag):
    params = lag.parameters() | {"s.startTime": 0.537}
    sol = ac.simulate(lag, END, dt=0.1, params=params, solver="rk4")
    np.testing.assert_allclose(sol.t, np.linspace(0.0, END, 41))
    slope = jax.grad(
        lambda start: ac.simulate(
            lag, END, dt=0.1, params=params | {"s.startTime": start}, solver="rk4"
        )["f.y"][-1]
    )(0.537)
    difference = (exact(0.537 + 1e-6) - exact(0.537 - 1e-6)) / 2e-6
    assert float(slope) == pytest.approx(difference, rel=1e-3)


@pytest.mark.slow
def test_edges_within_steps_divide_them_when_jax_compiles_and_maps(lag):
    def last(start, period):
        params = lag.parameters() | {"s.startTime": start, "s.period": period}
        return ac.simulate(lag, END, dt=0.1, params=params, solver="rk4")["f.y"][-1]

    starts = np.array([0.5, 0.537, 0.6001])
    both = jax.vmap(jax.value_and_grad(last, (0, 1)), (0, None))
    found, (by_start, by_period) = jax.jit(both)(starts, 1.0)
    np.testing.assert_allclose(found, [exact(s) for s in starts], atol=1e-5)
    for k, s in list(enumerate(starts))[1:]:  # an edge at the end of a step moves nothing
        slopes = [
            (exact(s + 1e-6) - exact(s - 1e-6)) / 2e-6,
            (exact(s, 1 + 1e-6) - exact(s, 1 - 1e-6)) / 2e-6,
        ]
        assert [by_start[k], by_period[k]] == pytest.approx(slopes, rel=1e-4)


@pytest.mark.cases(slow=1)
@pytest.mark.slow
@pytest.mark.parametrize("wrap", [lambda f: f, jax.jit], ids=["known", "compiled"])
def test_edges_at_ends_of_steps_have_a_gradient(lag, wrap):
    def last(start):
        params = lag.parameters() | {"s.startTime": start}
        return ac.simulate(lag, 3.8, dt=0.1, params=params, solver="rk4")["f.y"][-1]

    edges = 0.5 + 0.5 * np.arange(7)
    terms = 2.0 * (-1.0) ** np.arange(7) * -np.exp(-(3.8 - edges) / T) / T
    assert float(wrap(jax.grad(last))(0.5)) == pytest.approx(terms.sum(), rel=1e-4)


@pytest.fixture(scope="module")
def held():
    return ac.compile(
        Equations(
            "x y",
            lambda s: [ac.Eq(ac.der(s.x), s.u - s.k * s.x), ac.Eq(s.y, 2 * s.u + s.x)],
            inputs="u",
            k=1.0,
        )
    )


def record(late=0.0):
    ts = np.arange(101) * 0.01
    us, x = np.sin(70 * ts), [0.3]
    for u in us[:-1]:
        x.append(u + (x[-1] - u) * np.exp(-0.01))
    return ts, us, np.array(x)


def test_the_last_sample_of_a_held_input_is_its_own(held):
    ts, us, x = record()
    data = ac.Data(ts, {"u": us}, interpolation="previous")
    sol = ac.simulate(held, (0, 1), dt=0.01, solver="rk4", inputs=data, x0={"x": 0.3})
    np.testing.assert_allclose(sol["x"], x, atol=1e-10)
    np.testing.assert_allclose(sol["y"], 2 * us + x, atol=1e-10)


def test_steps_that_an_input_divides_end_where_they_shall(held):
    for end in np.round(0.01 * np.arange(1, 200), 2):
        assert step_ends(0.0, end, 0.01, 1)[-1] == end  # 0.35 is not 35 times 0.01
    step = ac.Signal([0.0, 0.123], [0.0, 1.0], "previous", after_end="hold")
    sol = ac.simulate(held, 0.35, dt=0.01, solver="rk4", inputs={"u": step}, x0={"x": 0.0})
    assert float(sol["x"][-1]) == pytest.approx(-np.expm1(0.123 - 0.35), abs=1e-9)


def test_a_training_on_exact_data_of_a_held_input_stays_where_it_is(held):
    ts, us, x = record()
    data = ac.Data(ts, {"u": us, "x": x, "y": 2 * us + x}, interpolation={"u": "previous"})
    fit = ac.fit(
        held,
        data,
        ["y"],
        modifiers=["k"],
        epochs=3,
        strategy="gauss_newton",
        solver="rk4",
        progress=False,
    )
    assert float(fit.loss_before) < 1e-8
    assert float(fit.params["k"]) == pytest.approx(1.0, abs=1e-5)


def test_a_held_input_that_jumps_within_steps_divides_them(held):
    ts, us, _ = record()
    late = ac.Signal(ts, us, "previous").delayed(0.0037)
    sol = ac.simulate(held, (0, 1), dt=0.01, solver="rk4", inputs={"u": late}, x0={"x": 0.3})
    value, t = 0.3, 0.0
    for edge, u in zip(np.append(ts[1:] + 0.0037, 9.0), us, strict=True):
        end = min(edge, 1.0)
        value, t = u + (value - u) * np.exp(-(end - t)), end
        if end == 1.0:
            break
    assert float(sol["x"][-1]) == pytest.approx(value, abs=1e-9)


def test_a_held_input_that_jumps_within_steps_divides_them_when_jax_compiles(held):
    ts, us, _ = record()
    params = held.parameters()

    def last(late, k, dt):
        inputs = {"u": ac.Signal(ts, us, "previous").delayed(late)}
        options = {"params": params | {"k": k}, "x0": {"x": 0.3}, "solver": "rk4"}
        return ac.simulate(held, (0, 1), dt=dt, inputs=inputs, **options)["x"][-1]

    fine = float(last(0.0037, 1.0, 1e-4))  # jumps are at ends of steps
    assert float(jax.jit(lambda k: last(0.0037, k, 0.02))(1.0)) == pytest.approx(fine, abs=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["previous", "linear"])
def test_a_training_with_a_delayed_input_simulates_that_delay(held, kind):
    ts = np.arange(101) * 0.02
    us, late = np.sin(9 * ts), 0.013
    inputs = {"u": ac.Signal(ts, us, kind).delayed(late)}
    fine = ac.simulate(held, (0, 2), dt=1e-3, saveat=ts, solver="rk4", inputs=inputs, x0={"x": 0.3})
    data = ac.Data(ts, {"u": us, "x": np.asarray(fine["x"])}, interpolation={"u": kind})
    fit = ac.fit(
        held,
        data,
        ["x"],
        modifiers=["k"],
        epochs=2,
        strategy="gauss_newton",
        delays={"u": late},
        solver="rk4",
        progress=False,
    )
    assert float(fit.loss_before) < 1e-7
    assert float(fit.params["k"]) == pytest.approx(1.0, abs=1e-6)


class Counted(ac.Component):
    """The same lag beside a counter, so that the model has events."""

    x = ac.Variable(start=0.3, fixed=True)
    u = ac.Input()
    k = ac.Parameter(1.0)
    n = ac.Discrete(0, kind="int")

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.u - self.k * self.x)
        yield ac.When(ac.sample(0.1, 0.25), ac.Eq(self.n, ac.pre(self.n) + 1))


@pytest.mark.machines
def test_a_delayed_held_input_divides_rows_of_models_with_events():
    system, ts = ac.compile(Counted()), np.arange(51) * 0.02
    us, late = np.sin(9 * ts), 0.013
    inputs = {"u": ac.Signal(ts, us, "previous").delayed(late)}
    fine = ac.simulate(system, (0, 1), dt=1e-3, saveat=ts, solver="rk4", inputs=inputs)
    data = ac.Data(ts, {"u": us, "x": np.asarray(fine["x"])}, interpolation={"u": "previous"})
    options = {"modifiers": ["k"], "delays": {"u": late}, "solver": "rk4", "progress": False}
    fit = ac.fit(system, data, ["x"], epochs=2, strategy="gauss_newton", **options)
    assert float(fit.loss_before) < 1e-7
    assert float(fit.params["k"]) == pytest.approx(1.0, abs=1e-6)
