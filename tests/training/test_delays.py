"""Delays of inputs and of targets' sensors: exact, trained, one record at a time."""

import functools
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import optax
import pytest

import acausal as ac
from acausal.data import deviation_from_line
from acausal.training.build_problem import build_problem
from acausal.training.objective.intervals import interval
from acausal.training.objective.problem import Problem
from acausal.training.objective.sensors import SensorRows, delayed
from acausal.training.options import FitOptions
from tests.support.oscillator import force, plain

DT = 0.02
TAU = 3.7 * DT
TARGETS = ("mass.a", "mass.s")


@functools.cache
def late(n: int = 401, start: float = 0.0, kind: Any = "cubic", tau: float = TAU) -> ac.Data:
    """A ride of the oscillator whose force comes late."""
    t = start + DT * np.arange(n)
    push = ac.Signal(t, force(t), kind).delayed(tau)
    solution = ac.simulate(
        plain(), (t[0], t[-1]), dt=DT / 4, saveat=t, inputs={"push.f": push}, solver="rk4"
    )
    signals = {n: np.asarray(solution[n]) for n in ("mass.s", "mass.v", "mass.a")}
    return ac.Data(t, {"push.f": force(t), **signals}, interpolation=kind)


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("tau", [-TAU, TAU])
def test_a_held_input_that_is_delayed_holds_its_last_sample(tau: float) -> None:
    """A delay below zero asks for what comes after the record's end: its last sample is held, as by `Signal`."""
    data = late(40, kind="previous", tau=tau)
    p = problem({"a": data}, delays={"push.f": tau}, solver="rk4")
    steps = p.steps(p.pack(p.assemble(p.start()), p.start()))
    signal = data.signal("push.f").delayed(tau)
    last = np.asarray(steps.t)[38] + DT / 2
    np.testing.assert_allclose(steps.inputs.start[38, 0], signal(last), atol=1e-11)


def problem(data: dict[str, ac.Data], **options: Any) -> Problem:
    """A training of the oscillator's stiffness and of some times."""
    options = {"modifiers": ["spring.c"], **options}
    start = plain().parameters()
    return build_problem(plain(), data, TARGETS, dict(start), FitOptions(**options))


@pytest.mark.cases(slow=1)
@pytest.mark.slow
@pytest.mark.parametrize("kind", ["cubic", "linear", "band-limited"])
def test_a_delayed_input_is_the_record_s_interpolation(kind: Any) -> None:
    data = {"a": late(60, kind=kind), "b": late(40, start=3.0, kind=kind)}
    p = problem(data, delays={"push.f": TAU, "mass.s": 0.01}, solver="rk4")
    packed = p.pack(p.assemble(p.start()), p.start())
    steps = p.steps(packed)
    at = 0
    for record in data.values():
        rows = np.arange(at, at + len(record) - 1)
        at += len(record)
        signal = jax.jit(jax.vmap(record.signal("push.f").delayed(TAU)))
        t = np.asarray(steps.t)[rows]
        np.testing.assert_allclose(steps.inputs.start[rows, 0], signal(t), atol=1e-11)
        np.testing.assert_allclose(steps.inputs.end[rows, 0], signal(t + DT), atol=1e-11)
        assert steps.inputs.coefficients is not None
        middle = deviation_from_line(steps.inputs.coefficients[rows].swapaxes(0, 1), 0.5)[:, 0]
        middle += (steps.inputs.start[rows, 0] + steps.inputs.end[rows, 0]) / 2
        np.testing.assert_allclose(middle, signal(t + DT / 2), atol=1e-11)


@pytest.mark.slow
def test_a_step_of_held_inputs_ends_before_the_next_sample() -> None:
    p = problem({"a": late(60, kind="previous")}, delays={"push.f": 2 * DT})
    inputs = p.steps(p.pack(p.assemble(p.start()), p.start())).inputs
    np.testing.assert_allclose(inputs.end[:-1, 0], inputs.start[:-1, 0], atol=1e-12)
    np.testing.assert_allclose(inputs.start[2:, 0], p.inputs[:-2, 0], atol=1e-12)


@pytest.mark.parametrize(
    ("kind", "options"),
    [
        pytest.param("cubic", {"solver": "rk4"}, marks=pytest.mark.machines),
        pytest.param(
            "linear",
            {"sequence_length": 0.6, "batch_size": 3, "x0": "fit"},
            marks=pytest.mark.slow,
        ),
    ],
)
def test_gradients_are_those_of_central_differences(kind: Any, options: dict[str, Any]) -> None:
    data = {"a": late(90, kind=kind), "b": late(50, start=3.0, kind=kind)}
    times = {"delays": {"push.f": ac.Delay(0.0371), "mass.a": ac.Delay(0.033)}}
    p = problem(data, **times, lags={"mass.a": ac.Lag(0.011)}, **options)
    start, batch = p.start(), p.draw(jax.random.key(0))

    def loss(deltas: Any) -> Any:
        moved = eqx.tree_at(lambda z: z.modifiers, start, deltas)
        return jnp.mean(p.losses(moved, batch))

    value, gradient = eqx.filter_jit(loss), eqx.filter_jit(jax.grad(loss))(start.modifiers)
    h = 1e-5
    for name, g in gradient.items():
        ends = [value({**start.modifiers, name: jnp.asarray(e)}) for e in (-h, h)]
        assert g == pytest.approx(float(ends[1] - ends[0]) / (2 * h), rel=1e-6, abs=1e-9)
        assert g != 0


@pytest.mark.machines
def test_a_late_input_is_found_beside_parameters() -> None:
    fit = ac.fit(
        plain(),
        {"long": late(), "short": late(120, start=2.0)},
        TARGETS,
        params={"spring.c": 45.0},
        modifiers={"spring.c": ac.Bounded(20, 100)},
        delays={"push.f": ac.Delay()},
        strategy="gauss_newton",
        solver="rk4",
        x0="data",
        progress=False,
    )
    assert fit.delays["push.f"] == pytest.approx(TAU, abs=1e-3 * DT)
    assert fit.lags == {}
    assert fit.params["spring.c"] == pytest.approx(50, rel=1e-4)
    assert "delay(push.f) 0.074 s" in repr(fit)
    assert set(fit.params) == set(plain().parameters())
    assert 0 < fit.confidence().parameters["delay(push.f)"] < 0.01 * DT
    trained = [
        s for t in fit.page_content().tabs for s in t.sections if s.title == "Trained parameters"
    ]
    assert "delay(push.f)" in [row[0] for row in trained[0].blocks[0].rows]  # pyright: ignore[reportAttributeAccessIssue]
    assert fit.history.modifiers["delay(push.f)"][0] == 0
    push = late().signal("push.f", "cubic").delayed(fit.delays["push.f"])
    again = ac.simulate(
        plain(), (0.0, 8.0), params=fit.params, inputs={"push.f": push}, saveat=late().time,
        rtol=1e-10, atol=1e-12,
    )  # fmt: skip
    np.testing.assert_allclose(again["mass.s"], fit.records["long"].predicted[:, 1], atol=5e-6)


@pytest.mark.slow
def test_a_late_sensor_is_found_in_sequences_and_held_out_data() -> None:
    data = late(tau=0.0)
    shown = jax.vmap(ac.Signal(data.time, data.signals["mass.a"], "cubic").delayed(0.05))
    data = ac.Data(data.time, {**data.signals, "mass.a": np.asarray(shown(data.time))})
    fit = ac.fit(
        plain(),
        data,
        TARGETS,
        delays={"mass.a": ac.Delay(0.02)},
        sequence_length=1.0,
        batch_size=4,
        optimizer=optax.adam(0.05),
        epochs=150,
        evaluate_every=50,
        validation=0.2,
        progress=False,
    )
    assert fit.delays["mass.a"] == pytest.approx(0.05, abs=0.1 * DT)
    assert fit.validation_loss is not None
    assert fit.validation_loss < 0.01


def test_a_delay_looks_at_its_own_record_alone() -> None:
    t = jnp.asarray([0.0, 0.1, 0.2, 0.3, 5.0, 5.1, 5.25, 5.3, 5.5])
    y = jnp.where(t < 1, t**2, 7 + (t - 5) ** 2)
    first = jnp.asarray([0] * 4 + [4] * 5)
    last = jnp.asarray([3] * 4 + [8] * 5)
    h = jnp.diff(t, append=t[-1:] + 0.1)
    for tau in (0.0, 0.07, 0.2, -0.04):
        at = jnp.clip(t - tau, t[first], t[last])
        exact = jnp.where(t < 1, at**2, 7 + (at - 5) ** 2)
        found = delayed(y, SensorRows(t, h, first, last), jnp.asarray(tau))
        np.testing.assert_allclose(found, exact, atol=1e-12)


def test_intervals_are_found_with_and_without_a_search() -> None:
    ts = jnp.concatenate([jnp.arange(5) * 0.5, 1 + jnp.arange(7) * 0.25])
    t = jnp.asarray([-1.0, 0.0, 0.6, 2.0, 9.0])
    for low, high, step in ((0, 4, 0.5), (5, 11, 0.25)):
        base = np.asarray(ts[low : high + 1])
        exact = np.clip(np.searchsorted(base, np.asarray(t), side="right") - 1, 0, None) + low
        for known in (None, jnp.asarray(step)):
            assert list(interval(ts, jnp.asarray(low), jnp.asarray(high), t, known)) == list(exact)


def test_a_signal_can_be_delayed() -> None:
    signal = ac.Signal([0.0, 1.0, 2.0], [1.0, 3.0, 2.0])
    later = signal.delayed(0.5)
    assert [float(later(t)) for t in (0.0, 0.5, 1.0, 2.5)] == [1.0, 1.0, 2.0, 2.0]
    assert later.before_start == "hold"
    assert float(jax.grad(lambda tau: signal.delayed(tau)(1.0))(0.25)) == -2.0
    bad: Any = "x"
    with pytest.raises(ac.DataError, match="cannot be delayed by 'x'"):
        signal.delayed(bad)


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"delays": {"push.g": 0.1}}, "delays: there is no input or target 'push.g'"),
        ({"lags": {"push.f": 0.1}}, "lags: there is no target 'push.f'"),
        ({"delays": {"push.f": "x"}}, "delays: 'push.f' has 'x'; give seconds, or ac.Delay"),
        ({"lags": {"mass.a": None}}, "lags: 'mass.a' has None; give a time constant in seconds"),
        ({"lags": {"mass.a": -1.0}}, "'mass.a' is -1 s; a time constant is not negative."),
        ({"delays": {"push.f": ac.Delay(3, max=1)}}, "starts at 3 s, which is not between its bo"),
        ({"delays": {"push.f": ac.Delay(np.nan)}}, "give finite numbers"),
        ({"delays": {"push.f": ac.Delay(min=0.1, max=0.05)}}, "0.1 to 0.05 s; the lower one comes"),
        ({"delays": {"push.f": ac.Delay()}}, "jumps from sample to sample, .* interpolation='lin"),
    ],
)
def test_what_is_no_delay_is_refused(options: dict[str, Any], sentence: str) -> None:
    with pytest.raises(ac.TrainingError, match=sentence):
        problem({"a": late(60, kind="previous")}, **options)


@pytest.mark.slow
def test_the_equation_error_knows_no_late_sensors() -> None:
    with pytest.raises(ac.TrainingError, match=r"knows no delay or lag of a target, here 'mass.a'"):
        ac.fit(
            plain(), late(60), TARGETS, delays={"mass.a": 0.01}, modifiers=["spring.c"],
            strategy="equation_error", progress=False,
        )  # fmt: skip


def test_limits() -> None:
    p = problem({"a": late(60)}, delays={"push.f": ac.Delay(), "mass.a": ac.Delay(1.0)})
    kinds = dict(zip(p.modifiers.names, p.modifiers.kinds, strict=True))
    assert kinds["delay(push.f)"].high == pytest.approx(20 * DT)  # pyright: ignore[reportAttributeAccessIssue]
    assert kinds["delay(mass.a)"].high == 2.0  # pyright: ignore[reportAttributeAccessIssue]
    assert float(p.timing.values["delay(push.f)"]) == pytest.approx(DT)
    kind = kinds["delay(push.f)"]
    assert kind.limit(DT, -DT) is None
    assert kind.limit(DT, 19 * DT) == pytest.approx(19 * DT)
