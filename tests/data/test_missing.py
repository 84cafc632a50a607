"""Missing samples, and signals with times of their own."""

import warnings

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import acausal as ac
from acausal.data.samples import TWICE
from tests.support.memory import peak_of
from tests.support.oscillator import plain

TIME = np.linspace(0, 1, 11)
GAP = np.where((TIME > 0.25) & (TIME < 0.65), np.nan, TIME)  # samples 3 to 6
SLOW = np.array([0.05, 0.5, 1.0])


def refused(make):
    with pytest.raises(ac.DataError) as error:
        make()
    return str(error.value)


def with_gap():
    return ac.Data(TIME, {"x": GAP, "y": TIME}, missing="nan")


def two_rates():
    return ac.Data(signals={"acc": (TIME, TIME**2), "level": (SLOW, 10 * SLOW)})


def test_missing_samples_are_nan():
    data = with_gap()
    np.testing.assert_array_equal(data["x"], GAP)
    assert data.missing == "nan"
    assert data.counts == {"x": 7, "y": 11}
    times, values = data.samples("x")
    np.testing.assert_array_equal(times, np.delete(TIME, [3, 4, 5, 6]))
    np.testing.assert_array_equal(values, times)
    assert repr(data) == ("Data(11 samples at 0.1 s, 0 to 1 s: 'x', 'y'; missing: 36.4 % of 'x')")


def test_a_record_without_missing_samples_says_nothing_of_them():
    data = ac.Data(TIME, {"x": TIME})
    assert data.missing == "refuse"
    assert data.counts == {"x": 11}
    assert data.samples("x")[1] is data["x"]
    assert "missing" not in repr(data)


def test_a_mask_makes_samples_missing():
    counts = np.isfinite(GAP)
    junk = np.where(counts, TIME, np.inf)
    data = ac.Data(TIME, {"x": junk, "y": TIME.astype(int)}, mask={"x": counts})
    np.testing.assert_array_equal(data["x"], GAP)
    assert data.missing == "nan"
    own = ac.Data(signals={"x": (TIME, TIME), "y": (SLOW, SLOW)}, mask={"y": [True, False, True]})
    assert own.counts == {"x": 11, "y": 2}


def test_signals_have_times_of_their_own():
    data = two_rates()
    np.testing.assert_allclose(data.time, np.sort([*TIME, 0.05]))
    assert data.counts == {"acc": 11, "level": 3}
    np.testing.assert_array_equal(data.samples("level")[0], SLOW)
    np.testing.assert_array_equal(data.samples("level")[1], 10 * SLOW)
    assert np.isnan(data["acc"][1])
    assert not data.uniform
    assert "75 % of 'level'" in repr(data)


def test_some_signals_may_have_the_times_of_the_record():
    data = ac.Data(
        1e3 * TIME, {"x": TIME, "y": (1e3 * SLOW, SLOW)}, {"time": "ms", "x": "m", "y": "m"}
    )
    np.testing.assert_allclose(data.samples("y")[0], SLOW)
    np.testing.assert_allclose(data.samples("x")[0], TIME)
    same = ac.Data(signals={"x": (TIME, TIME), "y": (TIME.copy(), TIME)})
    assert same.missing == "refuse"
    assert len(same) == 11


def test_times_that_differ_by_rounding_are_one():
    fast, slow = np.arange(1001) * 1e-3, np.arange(101) / 100 + 0.9e-9
    data = ac.Data(signals={"slow": (slow, slow), "fast": (fast, fast)})
    np.testing.assert_array_equal(data.time, fast)
    assert data.uniform
    apart = ac.Data(signals={"slow": (slow + 1e-9, slow), "fast": (fast, fast)})
    assert len(apart) == 1001 + 101


def test_what_is_made_of_a_record_keeps_missing_samples():
    data = ac.Data(
        1e3 * TIME,
        {"mass.s": GAP, "mass.v": (1e3 * SLOW, SLOW)},
        {"time": "ms", "mass.s": "mm", "mass.v": "m/s"},
        missing="nan",
    )
    converted = data.for_system(plain())
    np.testing.assert_allclose(converted.samples("mass.s")[1], 1e-3 * data.samples("mass.s")[1])
    assert (
        converted.missing == data.between(0, 0.5).missing == data.select("mass.v").missing == "nan"
    )
    assert data.between(0, 0.5).counts == {"mass.s": 3, "mass.v": 2}


def test_a_function_of_time_goes_through_the_samples_that_exist():
    data = ac.Data(TIME, {"x": np.where(TIME == 0.5, np.nan, TIME**2)}, missing="nan")
    x = data.signal("x")
    assert float(x(0.5)) == pytest.approx((0.4**2 + 0.6**2) / 2)
    assert float(data.signal("x", "previous")(0.55)) == pytest.approx(0.4**2)


def test_a_long_gap_of_an_input_gives_one_warning():
    time = np.arange(1000) * 1e-3
    u = np.where(((time > 0.1) & (time < 0.2)) | ((time > 0.5) & (time < 0.515)), np.nan, time)
    data = ac.Data(
        time,
        {"u": u, "short": np.where((time > 0.1) & (time < 0.109), np.nan, time)},
        missing="nan",
    )
    with pytest.warns(UserWarning, match="has no samples") as found:
        data.signal("u", "previous")
    assert [str(w.message) for w in found] == [
        (
            "'u' has no samples from 0.1 to 0.2 s, 100 times its median sample time and 1 more gap; the "
            "interpolation 'previous' bridges it. If that is wrong, use the record on both sides of the gap: "
            "data.between(start, end)."
        )
    ]
    assert found[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        data.signal("short")
        uneven = np.append(time, 2.0)  # an uneven log has no missing samples
        ac.Data(uneven, {"u": uneven}).signal("u")


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (
            lambda: ac.Data(TIME, {"x": GAP}),
            "'x' is nan at sample 3 (0.3 s) and 3 more; if such samples are missing, say missing='nan'.",
        ),
        (
            lambda: ac.Data(signals={"x": (TIME, GAP)}, units={"x": "m", "time": "ms"}),
            "'x' is nan at sample 3 (0.3 ms) and 3 more; if such samples are missing, say missing='nan'.",
        ),
        (
            lambda: ac.Data(TIME, {"x": np.where(TIME > 0.85, np.inf, GAP)}, missing="nan"),
            "'x' is inf at sample 9 (0.9 s) and 1 more; leave such samples out, or fill the gap.",
        ),
        (
            lambda: ac.Data(TIME, {"x": np.nan * TIME}, missing="nan"),
            "'x' is missing at all times; leave it out.",
        ),
        (
            lambda: ac.Data(TIME, {"x": TIME}, mask={"x": np.zeros(11, bool)}),
            "'x' is missing at all times; leave it out.",
        ),
        (lambda: ac.Data(TIME, {"x": TIME}, missing="drop"), "missing='drop'; choose one of refuse, nan."),
        (
            lambda: ac.Data(TIME, {"x": TIME}, mask=[True] * 11),
            ("mask=[True, True, True, True, True, True, True, True, True, True, True] has no names; "
            "give {'mass.s': samples_that_count}."),
        ),
        (
            lambda: ac.Data(TIME, {"x": TIME}, mask={"x": [0, 1]}),
            "mask: 'x' has [0, 1]; give True for a sample that counts, else False.",
        ),
        (
            lambda: ac.Data(TIME, {"x": TIME}, mask={"x": [True]}),
            "mask: 'x' has shape (1,) for samples of (11,).",
        ),
        (
            lambda: ac.Data(TIME, {"x": TIME}, mask={"y": [True]}),
            "There is a mask for 'y' but no such signal: known are 'x'.",
        ),
        (
            lambda: ac.Data(TIME, {"x": np.ma.masked_array(TIME, TIME > 0.5)}),
            "'x' is a masked array; give its data, and mask={'x': ~samples.mask}.",
        ),
        (
            lambda: ac.Data(signals={"x": TIME}),
            ("A record needs times: 'x' have none; give ac.Data(time, signals), "
            "or a pair (times, samples) for a signal."),
        ),
        (
            lambda: ac.Data(signals={}),
            "A record needs times; give ac.Data(time, signals), or a pair (times, samples) for a signal.",
        ),
        (
            lambda: ac.Data(TIME, {"x": (TIME, TIME)}),
            "All signals have times of their own; leave out those of the record.",
        ),
        (
            lambda: ac.Data(signals={"x": (TIME, TIME), "y": (SLOW[::-1], SLOW)}),
            "'y' has a time base that does not increase: 1 s at sample 0 is followed by 0.5 s.",
        ),
        (
            lambda: ac.Data(signals={"x": ([0, 1, 1, 2], [1, 2, 3, 4])}),
            "'x' has a time base that does not increase: 1 s at sample 1 is followed by 1 s." + TWICE,
        ),
        (
            lambda: ac.Data(signals={"x": (TIME, SLOW)}),
            "'x' has 3 samples for 11 times.",
        ),
        (
            lambda: two_rates().between(0.1, 0.4),
            "Between 0.1 and 0.4 s the record has no samples of 'level'; leave them out by data.select([...]).",
        ),
        (lambda: ac.Data(), "The signals of a record have names: give ac.Data(time, {'mass.s': samples}), not None."),
    ],
)  # fmt: skip
def test_wrong_ones_are_refused_in_one_sentence(make, sentence):
    assert refused(make) == sentence


times = st.lists(st.integers(0, 60), min_size=2, max_size=12, unique=True).map(sorted)


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(st.lists(times, min_size=1, max_size=4), st.sampled_from([0.0, 1e-9, -1e-9]))
def test_every_signal_keeps_its_samples_whatever_the_others_have(bases, rounding):
    given_ = {
        f"s{i}": (np.array(base) + rounding * i, np.array(base) ** 2.0 + i)
        for i, base in enumerate(bases)
    }
    data = ac.Data(signals=given_)
    assert len(data) == len({t for base in bases for t in base})
    assert np.all(np.diff(data.time) > 0)
    for name, (ts, values) in given_.items():
        np.testing.assert_allclose(data.samples(name)[0], ts, atol=1e-8)
        np.testing.assert_array_equal(data.samples(name)[1], values)


@pytest.mark.parametrize("missing", ["refuse", pytest.param("nan", marks=pytest.mark.slow)])
def test_ten_million_samples_need_no_ten_copies(missing):
    n = 1_000_000  # the shares are those of 10^7
    time = np.arange(n) * 1e-3
    signals = {name: np.sin(time) for name in "xyz"}
    one = time.nbytes
    record = 4 * one  # the samples are copied once
    assert peak_of(lambda: ac.Data(time, signals, missing=missing)) <= record + 0.5 * one
    data = ac.Data(time, signals, missing=missing)
    assert peak_of(lambda: data.uniform) <= 2.1 * one
    rates = {"x": (time, signals["x"]), "y": (time[::10], signals["y"][::10])}
    assert peak_of(lambda: ac.Data(signals=rates, missing=missing)) <= 2 * record
