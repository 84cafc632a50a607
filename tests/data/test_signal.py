import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.simulation.fixed_steps import Steps
from acausal.simulation.sampled_inputs import Samples, over_steps

UNIFORM = np.linspace(0.0, 2.0, 21)
UNEVEN = np.sort(np.r_[0.0, 2.0, np.random.default_rng(0).uniform(0, 2, 19)])


def at(signal, t):
    return np.asarray(jax.jit(jax.vmap(signal))(jnp.asarray(t)))


@pytest.mark.parametrize("ts", [UNIFORM, UNEVEN], ids=["uniform", "uneven"])
def test_linear_agrees_with_numpy(ts):
    t = np.linspace(-0.5, 2.5, 301)
    values = np.cos(3 * ts)
    signal = ac.Signal(ts, values)
    assert signal.uniform == (ts is UNIFORM)
    np.testing.assert_allclose(at(signal, t), np.interp(t, ts, values), atol=1e-12)


@pytest.mark.parametrize(
    "ts", [0.1 * np.arange(21), UNIFORM, UNEVEN], ids=["steps", "uniform", "uneven"]
)
def test_previous_holds_from_each_sample_on(ts):
    values = np.arange(len(ts), dtype=float)
    signal = ac.Signal(ts, values, "previous")
    np.testing.assert_array_equal(at(signal, ts), values)
    np.testing.assert_array_equal(at(signal, (ts[1:] + ts[:-1]) / 2), values[:-1])
    np.testing.assert_array_equal(at(signal, [-1.0, 3.0]), [0, values[-1]])


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("ts", [UNIFORM, UNEVEN], ids=["uniform", "uneven"])
def test_cubic_is_exact_for_parabolas_and_smooth(ts):
    t = np.linspace(0, 2, 201)
    signal = ac.Signal(ts, 3 * ts**2 - ts + 1, "cubic")
    np.testing.assert_allclose(at(signal, t), 3 * t**2 - t + 1, atol=1e-12)
    wave = ac.Signal(ts, np.sin(4 * ts), "cubic")
    derivative = jax.jit(jax.vmap(jax.grad(wave)))
    inner = jnp.asarray(ts[1:-1])
    np.testing.assert_allclose(derivative(inner - 1e-9), derivative(inner + 1e-9), atol=1e-5)


@pytest.mark.slow
def test_cubic_converges_faster_than_linear():
    t = np.linspace(0.2, 1.8, 500)

    def error(n, kind):
        ts = np.linspace(0, 2, n)
        return np.abs(at(ac.Signal(ts, np.sin(3 * ts), kind), t) - np.sin(3 * t)).max()

    assert error(41, "linear") / error(81, "linear") == pytest.approx(4, rel=0.1)
    assert error(41, "cubic") / error(81, "cubic") > 7


def test_two_samples_suffice():
    for kind in ("linear", "cubic"):
        assert float(ac.Signal([0.0, 1.0], [2.0, 4.0], kind)(0.25)) == pytest.approx(2.5)


def test_extrapolation():
    ts = np.linspace(0, 1, 11)
    assert float(ac.Signal(ts, ts**2)(5.0)) == 1.0
    assert float(ac.Signal(ts, 2 * ts, extrapolation="linear")(5.0)) == pytest.approx(10)
    assert float(ac.Signal(ts, 2 * ts, extrapolation="linear")(-1.0)) == pytest.approx(-2)
    wave = ac.Signal(ts, np.sin(2 * np.pi * ts), extrapolation="periodic")
    assert float(wave(3.3)) == pytest.approx(float(wave(0.3)))
    assert float(wave(-0.7)) == pytest.approx(float(wave(0.3)))


def test_each_side_has_its_own_extrapolation():
    ts = np.linspace(0, 1, 11)
    signal = ac.Signal(ts, 2 * ts, "linear", "periodic", before_start="linear")
    assert float(signal(-1.0)) == pytest.approx(-2.0)
    assert float(signal(1.3)) == pytest.approx(0.6)
    for choice in ("linear", "hold"):
        slope = ac.Signal(ts, 2 * ts, after_end=choice).differentiated()
        assert float(slope(1.5)) == pytest.approx(2.0 if choice == "linear" else 0.0)
    with pytest.raises(ac.DataError, match="after_end='stop'; choose one of refuse, hold, linear"):
        ac.Signal(ts, ts, after_end="stop")  # pyright: ignore[reportArgumentType]


@pytest.mark.slow
def test_derivatives_at_samples_and_ends():
    """At a sample the piece on its right counts; at the end, the last one."""
    line = ac.Signal([0.0, 1.0, 2.0], [0.0, 1.0, 5.0]).differentiated()
    np.testing.assert_array_equal(at(line, [0.0, 0.5, 1.0, 1.5, 2.0]), [1, 1, 4, 4, 4])
    cubic = ac.Signal(UNEVEN, UNEVEN**2, "cubic")
    np.testing.assert_allclose(at(cubic.differentiated(), UNEVEN), 2 * UNEVEN, atol=1e-9)
    np.testing.assert_allclose(at(cubic.differentiated(2), UNEVEN), 2.0, atol=1e-6)
    assert line.jumps
    assert cubic.differentiated(2).jumps
    assert not cubic.differentiated().jumps
    wave = ac.Signal(UNIFORM, np.sin(UNIFORM), "band-limited")
    traced = jax.jit(lambda signal: signal.differentiated()(1.0))(wave)
    assert float(traced) == pytest.approx(np.cos(1.0), abs=0.05)
    with pytest.raises(ac.DataError, match="no useful third derivative; give the derivative as"):
        cubic.differentiated(3)


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("kind", ["linear", "cubic"])
def test_derivatives_by_time_and_by_values(kind):
    values = jnp.sin(jnp.asarray(UNEVEN))
    signal = ac.Signal(UNEVEN, values, kind)
    t, e = 0.777, 1e-6
    difference = (signal(t + e) - signal(t - e)) / (2 * e)
    assert float(jax.grad(signal)(t)) == pytest.approx(float(difference), rel=1e-6)
    weights = jax.grad(lambda v: ac.Signal(UNEVEN, v, kind)(t))(values)
    assert float(weights @ values) == pytest.approx(float(signal(t)))  # linear in its values


def test_traced_samples_and_times():
    def value(ts, values):
        return ac.Signal(ts, values)(0.5)

    assert float(jax.jit(value)(jnp.asarray([0.0, 1.0]), jnp.asarray([0.0, 2.0]))) == 1.0


@pytest.mark.parametrize(
    ("ts", "values", "message"),
    [
        (
            [0.0, 1.0, 1.0],
            [1, 2, 3],
            "'u' has a time base that does not increase: 1 s at sample 1 ",
        ),
        ([0.0, np.nan, 1.0], [1, 2, 3], "'u' has a time that is nan at sample 1."),
        ([0.0], [1.0], "'u' needs a time base of at least two samples, got shape (1,)."),
        ([0.0, 1.0], [1, 2, 3], "'u' has 3 samples for 2 times."),
        (
            [0.0, 1.0],
            [1, np.inf],
            "'u' is inf at sample 1; leave such samples out, or fill the gap.",
        ),
        ([0.0, 1.0], [1, 2j], "'u' holds complex128; real numbers are needed."),
        ([0.0, 1.0], None, "'u' holds None; real numbers are needed."),
        ([0.0, 1.0], [1, None], "'u' holds object; real numbers are needed."),
        ([0.0, 1j], [1, 2], "'u' has a time base of complex128; seconds are needed."),
        (
            ["0", "1"],
            [1, 2],
            "'u' has a time base of <U1; seconds are needed: make numbers of texts by np.asarray(t, float).",
        ),
        (
            np.float32([1e6, 1e6 + 0.01]),
            [1, 2],
            (
                "'u' has a time base that does not increase: 1000000 s at sample 0 is followed by 1000000 s. "
                "Times in float32 are too coarse for this: give float64."
            ),
        ),
        ([0.0, 1.0], ["a", "b"], "'u' holds <U1; real numbers are needed."),
    ],
)
def test_bad_samples_are_refused(ts, values, message):
    with pytest.raises(ac.DataError) as error:
        ac.Signal(ts, values, name="u")
    assert str(error.value).startswith(message)


def test_half_a_derivative_is_refused():
    with pytest.raises(
        ac.DataError, match=r"differentiated: times=1\.5; give a whole number, 0 or more"
    ):
        ac.Signal([0.0, 1.0], [0.0, 1.0]).differentiated(1.5)  # pyright: ignore[reportArgumentType]


def test_unknown_interpolation_is_refused():
    with pytest.raises(ac.DataError, match="interpolation='spline'; choose one of linear"):
        ac.Signal([0.0, 1.0], [0.0, 1.0], "spline")  # pyright: ignore[reportArgumentType]


# -- band-limited ------------------------------------------------------------------------------------


def tones(t):
    """Frequencies up to 0.45 of the sampling rate of 10 Hz, and a drift."""
    phases = zip((0.3, 1.1, 2.9, 4.5), (0.1, 0.7, 2.0, 4.0), strict=True)
    return 0.2 * t + sum(np.sin(2 * np.pi * f * t + p) for f, p in phases)


@pytest.mark.slow
def test_band_limited_finds_what_lies_between_samples():
    ts = 0.1 * np.arange(401)
    t = np.linspace(10, 30, 1777)
    error = {
        kind: np.abs(at(ac.Signal(ts, tones(ts), kind), t) - tones(t)).max()
        for kind in ("linear", "cubic", "band-limited")
    }
    assert error["band-limited"] < 0.01 < 0.3 * error["cubic"] < error["linear"]


def test_band_limited_is_exact_at_its_samples_and_for_lines():
    signal = ac.Signal(UNIFORM, tones(UNIFORM), "band-limited")
    np.testing.assert_allclose(at(signal, UNIFORM), tones(UNIFORM), atol=1e-12)
    line = ac.Signal(UNIFORM, 2 - 3 * UNIFORM, "band-limited")
    t = np.linspace(-1, 3, 99)
    np.testing.assert_allclose(at(line, t), 2 - 3 * np.clip(t, 0, 2), atol=1e-12)


def test_band_limited_needs_equal_spaces():
    with pytest.raises(ac.DataError, match="'u' is band-limited, which needs equally spaced times"):
        ac.Signal(UNEVEN, UNEVEN, "band-limited", name="u")


@pytest.mark.cases(fast=2, slow=6)
@pytest.mark.parametrize("interpolation", ["linear", "previous", "cubic", "band-limited"])
@pytest.mark.parametrize("parts", [1, 3])
def test_sampled_inputs_are_their_signals_within_steps(interpolation, parts):
    ts = 0.1 * np.arange(21)
    signals = (ac.Signal(ts, tones(ts), interpolation), ac.Signal(ts, ts))
    grid = np.linspace(0, 2, 20 * parts + 1)
    samples = over_steps(signals, grid)
    assert samples.functions == (None, None)
    for fraction in (0.0, 0.3, 0.8):
        coefficients = samples.coefficients
        for i in (0, 7, 20 * parts - 1):
            own = None if coefficients is None else coefficients[i]
            inputs = Samples(samples.start[i], samples.end[i], samples.functions, own)
            step = Steps(grid[i], grid[1], inputs)
            t = grid[i] + fraction * (grid[i + 1] - grid[i])
            expected = [signal(t) for signal in signals]
            np.testing.assert_allclose(step.inputs_at(fraction), expected, atol=1e-9)


def test_times_that_are_known_stay_so_where_jax_traces():
    def values(samples):
        signal = ac.Signal([0.0, 1.0, 3.0], samples)
        assert not isinstance(signal.ts, jax.core.Tracer)
        assert isinstance(signal.values, jax.core.Tracer)
        return signal(2.0)

    assert float(jax.jit(values)(jnp.arange(3.0))) == 1.5
