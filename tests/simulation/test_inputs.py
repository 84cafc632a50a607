"""Inputs as users give them: names, forms, how far records reach, and derivatives of what the model differentiates."""

import functools
import re
import warnings

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import translational as tl
from acausal.simulation.inputs import Derivative, breaks, functions_of_time, inputs_by_name
from acausal.simulation.sampled_inputs import over_steps
from tests.support.oscillator import plain

T = np.linspace(0.0, 1.0, 11)
PUSH = "push.f"
REFERENCE = "drive.s_ref"


def simulated(inputs, span=(0.0, 1.0), dt=0.1, **options):
    return ac.simulate(plain(), span, dt=dt, inputs=inputs, **options)


def refused(inputs, span=(0.0, 1.0), **options):
    with pytest.raises(ac.DataError) as found:
        simulated(inputs, span, **options)
    return str(found.value)


# -- how far records reach ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    "record",
    [
        {PUSH: (T, T)},
        {PUSH: ac.Signal(T, T)},
        {PUSH: ac.Signal(T, T, "previous", before_start="hold")},
        ac.Data(T, {PUSH: T}),
    ],
    ids=["pair", "signal", "held before", "record"],
)
@pytest.mark.parametrize("dt", [0.1, None])
def test_records_shorter_than_the_simulation_are_refused(record, dt):
    assert refused(record, (0.0, 2.0), dt=dt) == (
        "Input 'push.f' has samples up to 1 s, but the simulation ends at 2 s: end it there, give more samples, "
        "or say after_end='hold' in its ac.Signal or ac.Data."
    )


def test_records_that_start_late_are_refused():
    assert refused({PUSH: (T, T)}, (-0.5, 1.0)) == (
        "Input 'push.f' has samples from 0 s on, but the simulation starts at -0.5 s: start it there, give more "
        "samples, or say before_start='hold' in its ac.Signal or ac.Data."
    )


@pytest.mark.parametrize(
    ("record", "late"),
    [
        (ac.Signal(T, 1 + T, after_end="hold", before_start="hold"), 2.0),
        (ac.Signal(T, 1 + T, extrapolation="hold"), 2.0),
        (ac.Signal(T, 1 + T, extrapolation="linear", before_start="hold"), 3.0),
        (ac.Signal(T, 1 + T, after_end="periodic", before_start="hold"), 1.0),
        (ac.Data(T, {PUSH: 1 + T}, after_end="hold", before_start={PUSH: "hold"}), 2.0),
    ],
)
def test_records_may_say_what_comes_beyond(record, late):
    given = record if isinstance(record, ac.Data) else {PUSH: record}
    push = simulated(given, (-1.0, 2.0), dt=0.25)[PUSH]
    assert (float(push[0]), float(push[-1])) == pytest.approx((1.0, late))


class Defaulted(ac.Component):
    u = ac.Input(shape=2, default=(2.0, 3.0))
    x = ac.Variable(fixed=True)

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.u[0] * self.u[1])


def test_inputs_have_defaults():
    system = ac.compile(Defaulted())
    assert system.input_defaults == {"u[1]": 2.0, "u[2]": 3.0}
    for inputs, x in (({}, 6.0), ({"u[2]": 5.0}, 10.0)):
        assert ac.simulate(system, 1.0, dt=0.5, inputs=inputs)["x"][-1] == pytest.approx(x)
        assert ac.linearize(system, inputs=inputs).A.shape == (1, 1)
    assert system.input_values({"u[1]": 1.0}).tolist() == [1.0, 3.0]


def test_rounded_times_reach_the_end():
    for ts in (
        0.1 * np.arange(11) * (1 - 1e-12),
        np.round(np.linspace(0, 1, 4), 4),
        np.linspace(0, 42, 42_001, dtype=np.float32),
    ):
        span = (0.0, 42.0 if len(ts) > 11 else 1.0)
        (function,) = functions_of_time(plain(), {PUSH: (ts, np.ones(len(ts)))}, span)
        assert float(function(span[1])) == 1.0


@pytest.mark.slow
def test_a_record_of_traced_times_is_nan_where_it_would_be_refused():
    @jax.jit
    def last(ts, values):
        return simulated({PUSH: (ts, values)}).x[-1, 0]

    assert jnp.isfinite(last(jnp.asarray(T), T))
    assert jnp.isnan(last(jnp.asarray(0.9 * T), T))


# -- forms -------------------------------------------------------------------------------------------

FORMS = "a number, samples, (times, samples), an acausal.Signal, or a function of time"


@pytest.mark.parametrize("inputs", [[1.0], np.ones(11), 3.0, "push.f", ("push.f", 1.0)])
def test_inputs_without_names_show_the_right_form(inputs):
    sentence = refused(inputs)
    assert sentence.startswith("inputs=")
    assert sentence.endswith(
        f" has no names; give inputs={{'push.f': ...}}, with {FORMS} for each."
    )


@pytest.mark.parametrize(
    ("value", "told"),
    [
        (None, "None"),
        ("fast", "'fast'"),
        (1j, "1j"),
        ([[0, 1], [2]], "[[0, 1], [2]]"),
        (np.ones(11) * 1j, "an array of complex128, shape (11,)"),
        ({"a": 1}, "{'a': 1}"),
        (ac.Signal, "<class 'acausal.data.signal.Signal'>"),
    ],
)
def test_what_is_no_input(value, told):
    assert refused({PUSH: value}) == f"Input 'push.f' is {told}; give {FORMS}."


@pytest.mark.parametrize(
    ("function", "told"),
    [
        (lambda t: 1j * t, "an array of complex128, shape ()"),
        (lambda t: "fast", "'fast'"),
        (lambda t: None, "None"),
    ],
)
def test_functions_that_return_no_real_number(function, told):
    sentence = refused({PUSH: function})
    assert sentence == f"Input 'push.f' is a function that returns {told}, not a real number."


def test_complex_samples_are_refused():
    with pytest.raises(ac.DataError, match=r"'push\.f' holds complex128; real numbers are needed"):
        simulated({PUSH: (T, 1j * T)})
    with pytest.raises(ac.DataError, match=r"'push\.f' has a time base of complex128; seconds are"):
        simulated({PUSH: (1j * T, T)})


def test_times_that_single_precision_cannot_tell_apart():
    late = (1e6, 1e6 + 1)
    assert refused({PUSH: 1.0}, late, dt=0.01, dtype="float32") == (
        "The steps: 1000000 s and 1000000.01 s are too close for float32; "
        "let time start at zero, or compute in float64."
    )
    sentence = refused({PUSH: 0.0}, late, dt=None, saveat=[1e6, 1e6 + 0.01], dtype="float32")
    assert sentence.startswith("saveat: 1000000 s and")
    record = ac.Signal(1e6 + np.linspace(0, 1, 101), np.zeros(101))
    sentence = refused({PUSH: record}, late, dt=0.25, dtype="float32")
    assert sentence.startswith("An input: 1000000 s and")
    assert np.all(np.diff(simulated({PUSH: 1.0}, late, dt=0.01).t) > 0)
    record = ac.Data(1e7 + T, {PUSH: T, "mass.s": T})
    with pytest.raises(ac.DataError, match=r"^The record: 10000000 s and .* close for float32"):
        ac.fit(plain(), record, "mass.s", modifiers=["mass.m"], x0="model", dtype="float32")


@pytest.mark.parametrize("t", ["01", ("0", "1"), (0, 1j), b"01"])
def test_texts_and_complex_numbers_are_no_span(t):
    with pytest.raises(ac.DataError, match=r"^t=.* is not a span of time; give \(start, end\)"):
        ac.simulate(plain(), t, inputs={PUSH: 0.0})


@pytest.mark.parametrize("saveat", ["01", [0.5j], None])
def test_times_to_save_are_numbers(saveat):
    if saveat is None:
        assert len(simulated({PUSH: 0.0}, saveat=None).t) == 11
        return
    assert refused({PUSH: 0.0}, saveat=saveat) == f"saveat={saveat!r} are not times; give seconds."


def test_a_data_frame_gives_the_inputs():
    pandas = pytest.importorskip("pandas")
    expected = simulated({PUSH: (T, T)}).x
    by_index = pandas.DataFrame({PUSH: T, "remark": T}, index=T)
    by_column = pandas.DataFrame({PUSH: T, "time": T})
    for frame in (by_index, by_column):
        np.testing.assert_array_equal(simulated(frame).x, expected)
    assert refused(by_column[[PUSH]]).startswith(
        "The data frame has no time: its index only counts"
    )
    assert "samples up to 1 s" in refused(by_index, (0.0, 2.0))
    texts = pandas.DataFrame({PUSH: ["a"] * 11}, index=T)
    assert refused(texts) == "'push.f' holds object; real numbers are needed."


def test_a_series_has_its_times():
    pandas = pytest.importorskip("pandas")
    expected = simulated({PUSH: (T, 1e3 * T)}).x
    by_name = pandas.Series(T, pandas.Index(1e3 * T, name="time [ms]"), name="f [kN]")
    by_attributes = pandas.Series(1e3 * T, pandas.to_timedelta(T, unit="s"))
    by_attributes.attrs["units"] = "N"
    for series in (by_name, by_attributes, pandas.Series(1e3 * T, T, name=PUSH)):
        np.testing.assert_allclose(simulated({PUSH: series}).x, expected, rtol=1e-12)
    rows = pandas.Series(1e3 * T)
    np.testing.assert_array_equal(simulated({PUSH: rows}).x, expected)
    assert "The index of its pandas Series only counts" in refused({PUSH: rows}, dt=None)
    assert refused({"push.F": by_name}) == "The model has no input 'push.F': did you mean 'push.f'?"
    assert "'push.f' is given in 'm'" in refused({PUSH: by_name.rename("f [m]")})
    assert refused({PUSH: pandas.Series(["a"] * 11, T)}).startswith("'push.f' holds")


def test_dates_of_two_series_have_one_origin():
    pandas = pytest.importorskip("pandas")
    dates = pandas.date_range("2024-01-01", periods=11, freq="100ms", tz="Europe/Berlin")
    early = pandas.Series(T, dates, name="u")
    late = pandas.Series(T, dates + pandas.Timedelta(seconds=2), name="v")
    given = inputs_by_name(driven(), {REFERENCE: late, f"der({REFERENCE})": early})
    np.testing.assert_allclose([ts[0] for ts, _ in given.values()], [2.0, 0.0], atol=1e-12)


@pytest.mark.parametrize("how", ["end", "span", "saveat"])
def test_times_of_a_simulation_cannot_be_traced(how):
    def last(t):
        span = {"end": t, "span": (0.0, t), "saveat": 1.0}[how]
        saveat = [0.5, t] if how == "saveat" else None
        return ac.simulate(plain(), span, saveat=saveat, inputs={PUSH: 0.0})["mass.s"][-1]

    with pytest.raises(
        ac.DataError, match=r"must be known numbers, but JAX traces (t|saveat)\."
    ) as found:
        jax.grad(last)(1.0)
    assert "with respect to the end time is der(x) there" in str(found.value)


def test_names_from_numpy_and_pandas():
    name = np.array([PUSH])[0]
    x = simulated({name: 1.0}, x0={np.str_("mass.s"): 0.5}).x
    np.testing.assert_array_equal(x, simulated({PUSH: 1.0}, x0={"mass.s": 0.5}).x)


@pytest.mark.parametrize("x0", [{"mass.s": 1j}, {"mass.s": "1"}, {"mass.s": None}, [1j, 0], "01"])
def test_initial_states_are_real(x0):
    assert re.search(r"give (a )?real number", refused({PUSH: 0.0}, x0=x0))


# -- derivatives -------------------------------------------------------------------------------------


class Driven(ac.Component):
    """A mass that follows a position exactly, and pulls another one by a spring."""

    def __init__(self):
        super().__init__()
        self.drive = tl.Position(exact=True)
        self.first, self.second = tl.Mass(m=2.0), tl.Mass(m=1.0)
        self.spring = tl.SpringDamper(c=50.0, d=1.0)
        self.connect(self.drive.flange, self.first.flange_a)
        self.connect(self.first.flange_b, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.second.flange_a)


@functools.cache
def driven():
    system = ac.compile(Driven())
    assert system.inputs == (REFERENCE, f"der({REFERENCE})", f"der(der({REFERENCE}))")
    return system


def position(t):
    return 0.3 * t**3 - 0.2 * t**2


def rate(t):
    return 0.9 * t**2 - 0.4 * t


def acceleration(t):
    return 1.8 * t - 0.4


def follow(inputs, dt=0.1, span=(0.0, 1.0)):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = ac.simulate(driven(), span, dt=dt, saveat=T, inputs=inputs)
    return found, [str(w.message) for w in caught]


SAID = (
    "The model differentiates input 'drive.s_ref': its derivative is that of the record's {} interpolation, noise "
    "included. If it was measured, give 'der(drive.s_ref)', too."
)


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("dt", [0.1, None])
def test_functions_are_differentiated_by_jax(dt):
    found, said = follow({REFERENCE: position}, dt)
    np.testing.assert_allclose(found["first.v"], rate(T), atol=1e-14)
    np.testing.assert_allclose(found["first.a"], acceleration(T), atol=1e-14)
    assert not said


def test_numbers_have_no_rate():
    found, said = follow({REFERENCE: 0.5})
    assert not said
    assert float(jnp.abs(found[["first.v", "first.a"]]).max()) == 0.0


@pytest.mark.cases(fast=0, slow=4)
@pytest.mark.parametrize("dt", [0.1, None])
@pytest.mark.parametrize("form", ["pair", "samples", "record", "signal"])
def test_records_are_differentiated_as_they_are_interpolated(form, dt):
    """The parabolas of a cubic interpolation are exact for parabolas."""
    y = 0.3 * T**2 - 0.1 * T
    forms = {
        "pair": (T, y),
        "samples": y,
        "record": ac.Data(T, {REFERENCE: y}),
        "signal": ac.Signal(T, y, "cubic"),
    }
    if form == "samples" and dt is None:
        return  # they need steps
    given = forms[form]
    found, said = follow(given if form == "record" else {REFERENCE: given}, dt)
    np.testing.assert_allclose(found["first.v"], 0.6 * T - 0.1, atol=1e-12)
    np.testing.assert_allclose(found["first.a"], 0.6, atol=1e-10)
    assert said == [SAID.format("cubic")]


def test_a_derivative_that_is_given_is_used_and_differentiated():
    given = {REFERENCE: (T, position(T)), f"der({REFERENCE})": ac.Signal(T, rate(T))}
    found, said = follow(given)
    np.testing.assert_allclose(found["first.v"], rate(T), atol=1e-14)
    assert [s.split("'")[1] for s in said] == [f"der({REFERENCE})"]
    everything = {**given, f"der(der({REFERENCE}))": acceleration}
    found, said = follow(everything)
    np.testing.assert_allclose(found["first.a"], acceleration(T), atol=1e-14)
    assert not said


SMOOTH = "'cubic' or 'akima' or 'modified-akima' or 'monotone' or 'steffen' or 'band-limited'"


@pytest.mark.parametrize(
    ("interpolation", "derivative", "order", "others"),
    [
        ("previous", "der(drive.s_ref)", "first", f"'linear' or {SMOOTH}"),
        ("linear", "der(der(drive.s_ref))", "second", SMOOTH),
    ],
)
def test_interpolations_without_a_useful_derivative(interpolation, derivative, order, others):
    for given in (
        {REFERENCE: ac.Signal(T, T, interpolation)},
        ac.Data(T, {REFERENCE: T}, interpolation=interpolation),
    ):
        with pytest.raises(ac.DataError) as found:
            follow(given)
        assert str(found.value) == (
            f"The model differentiates an input, '{derivative}': 'drive.s_ref' has the interpolation "
            f"'{interpolation}', which has no useful {order} derivative; choose interpolation={others}, "
            "or give the derivative as measured."
        )


def test_a_missing_reference_is_asked_for_alone():
    with pytest.raises(ac.DataError) as found:
        ac.simulate(driven(), (0, 1), dt=0.1)
    assert str(found.value) == (
        "No value for the model's input 'drive.s_ref': give inputs={'drive.s_ref': ...}."
    )


@pytest.mark.cases(fast=1, slow=7)
@pytest.mark.parametrize("parts", [1, 3])
@pytest.mark.parametrize(
    ("interpolation", "times"),
    [("linear", 1), ("cubic", 1), ("cubic", 2), ("band-limited", 1), ("band-limited", 2)],
)
def test_derivatives_over_steps_integrate_to_their_signal(interpolation, times, parts):
    """Each derivative, over every step, gives the change of what it is the derivative of; jumps lie between steps."""
    ts = np.linspace(0, 2, 21)
    signal = ac.Signal(ts, np.sin(3 * ts), interpolation)
    ends = np.linspace(0, 2, 20 * parts + 1)
    below, rates = (
        over_steps((signal.differentiated(k) if k else signal,), ends) for k in (times - 1, times)
    )
    assert rates.functions == (None,)
    integral = (rates.start + rates.end)[:, 0] / 2
    if rates.coefficients is not None:  # the integral of p (1 - p) p^k is 1 / ((k + 2) (k + 3))
        k = np.arange(rates.coefficients.shape[1])
        integral += rates.coefficients[:, :, 0] @ (1 / ((k + 2) * (k + 3)))
    change = (below.end - below.start)[:, 0]
    np.testing.assert_allclose(integral * np.diff(ends), change, atol=1e-12)


@pytest.mark.slow
def test_derivatives_have_gradients_by_samples():
    def speed(values):
        signal = ac.Signal(T, values, "cubic").differentiated()
        return signal(0.33)

    weights = jax.grad(speed)(jnp.zeros(11))
    assert float(weights @ position(T)) == pytest.approx(rate(0.33), abs=1e-3)


def test_a_derivative_is_compiled_with_its_function():
    assert float(jax.jit(Derivative(position, 2))(2.0)) == pytest.approx(3.2)


@pytest.mark.slow
def test_fit_differentiates_the_record_and_says_so_once():
    true, _ = follow({REFERENCE: position})
    record = ac.Data(T, {REFERENCE: position(T), "second.s": true["second.s"]})
    options = {
        "modifiers": ["spring.c"],
        "x0": "model",
        "strategy": "sequences",
        "epochs": 2,
        "progress": False,
    }
    with pytest.warns(UserWarning, match=r"differentiates input 'drive\.s_ref'") as said:
        fit = ac.fit(driven(), record, "second.s", validation=0.3, **options)
    assert [str(w.message) for w in said] == [SAID.format("cubic")]
    assert fit.loss_before < 0.1
    held = ac.Data(record.time, record.signals, interpolation="previous")
    with pytest.raises(
        ac.DataError, match=r"'drive\.s_ref' has the interpolation 'previous', which"
    ):
        ac.fit(driven(), held, "second.s", **options)


def test_adaptive_steps_end_at_corners_and_jumps_of_inputs_only():
    held = ac.Signal([0.0, 1.0, 1.5, 2.0], [1.0, 3.0, 3.0, 3.0], "previous")
    ramp = ac.Signal([0.0, 0.5, 1.5, 2.5, 4.0], [0.0, 1.0, 3.0, 5.0, 0.0])
    ts, jumps = breaks((held, ramp, lambda t: t), 0.0, 4.0)
    np.testing.assert_allclose(ts, [1.0, 2.0, 2.5])
    assert jumps.tolist() == [True, True, False]
    t, noise = np.linspace(0, 4, 20_001), np.random.default_rng(0).standard_normal(20_001)
    assert len(breaks((ac.Signal(t, np.sin(t)),), 0.0, 4.0)[0]) == 0
    assert len(breaks((ac.Signal(t, np.sin(t) + 0.01 * noise),), 0.0, 4.0)[0]) > 19_000
    traced: list[int] = []
    jax.jit(lambda v: traced.append(len(breaks((ac.Signal(t, v),), 0.0, 4.0)[0])))(jnp.sin(t))
    assert traced == [0]


class Lag(ac.Component):
    u = ac.Input()
    x = ac.Variable(start=0.0)

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.u - self.x)


@pytest.mark.slow
def test_rough_inputs_of_many_samples_take_one_step_from_each_to_the_next():
    t, rng = np.linspace(0.0, 4.0, 20_001), np.random.default_rng(0)
    rough = {"u": (t, rng.standard_normal(len(t)).cumsum())}
    found = ac.simulate(ac.compile(Lag()), 4.0, inputs=rough, max_steps=1000)
    assert found.statistics is not None
    assert found.statistics.steps + found.statistics.rejected < 1.2 * len(t)
