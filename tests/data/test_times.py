"""Times of a record that are dates, durations, large integers or row numbers."""

import numpy as np
import pandas as pd
import pytest

import acausal as ac

STEPS = np.arange(5.0)
SECOND = np.timedelta64(1, "s")
MIDNIGHT = np.datetime64("2024-01-01", "ns") + np.arange(5) * SECOND


def test_dates_of_two_loggers_have_one_origin():
    xarray = pytest.importorskip("xarray")
    given = {"u": ("a", STEPS), "x": ("b", STEPS)}
    coords = {"a": MIDNIGHT, "b": MIDNIGHT + 3 * SECOND}
    data = ac.Data.from_xarray(xarray.Dataset(given, coords=coords))
    assert data.time.tolist() == list(range(8))
    assert data.time[np.isfinite(data["x"])].tolist() == [3, 4, 5, 6, 7]
    coords["b"] = STEPS
    with pytest.raises(ac.DataError, match="dates and numbers, which have no common start"):
        ac.Data.from_xarray(xarray.Dataset(given, coords=coords))


def test_durations_are_seconds():
    times = np.arange(5).astype("timedelta64[ms]") * 20
    expected = [0.0, 0.02, 0.04, 0.06, 0.08]
    assert ac.Data(times, {"x": STEPS}).time == pytest.approx(expected, rel=1e-15)
    assert ac.Data(signals={"x": (times, STEPS)}).time == pytest.approx(expected, rel=1e-15)
    with pytest.raises(ac.DataError, match="real numbers are needed"):
        ac.Data(STEPS, {"x": times})
    with pytest.raises(ac.DataError, match="timedelta64"):
        ac.Data(times, {"x": STEPS}, units={"time": "ms", "x": "m"})


def test_times_that_floats_cannot_tell_apart_are_refused():
    with pytest.raises(ac.DataError, match="too large for float64; subtract the first"):
        ac.Data(2**60 + np.arange(5), {"x": STEPS})
    assert ac.Data(np.arange(5) * 10**9, {"x": STEPS}).time[-1] == 4e9


def test_masked_times_are_refused():
    times = np.ma.MaskedArray(STEPS, [0, 1, 0, 0, 0])
    with pytest.raises(ac.DataError, match="masked times"):
        ac.Data(times, {"x": STEPS})
    for time, values in ((times, STEPS), (STEPS, times)):
        with pytest.raises(ac.DataError, match="'signal' is masked"):
            ac.Signal(time, values)
    whole = np.ma.MaskedArray(STEPS)
    np.testing.assert_array_equal(ac.Data(whole, {"x": whole})["x"], STEPS)


def test_a_record_keeps_its_samples():
    buffer, times, runs = np.zeros(5), STEPS.copy(), []
    for k in range(3):
        buffer[:] = k
        runs.append(ac.Data(times, {"x": buffer}))
    times[:] = 0
    assert [r["x"][0] for r in runs] == [0, 1, 2]
    assert runs[0].time.tolist() == STEPS.tolist()


def test_a_frame_has_its_units():
    frame = pd.DataFrame({"x": [1000.0, 2000.0, 3000.0]})
    frame.attrs["units"] = {"x": "mm"}
    assert ac.Data(STEPS[:3], frame).units == {"x": "mm"}
    assert ac.Data(STEPS[:3], frame, units={"x": "m"}).units == {"x": "m"}
    assert ac.Data(STEPS[:3], pd.DataFrame({"x": STEPS[:3]})).units is None


def test_row_numbers_are_no_times():
    frame = pd.DataFrame({"x": STEPS})
    with pytest.raises(ac.DataError, match="its index only counts the rows"):
        ac.Data.from_dataframe(frame[frame["x"] != 2])


TIMES = pd.Index([0.0, 1000.0, 2000.0, 3000.0, 4000.0], name="time [ms]")


def test_a_named_index_has_a_unit_as_a_column_has():
    frame = pd.DataFrame({"x [mm]": STEPS}, index=TIMES)
    named_t = frame.rename_axis("t [ms]")
    by_attributes = frame.rename_axis("t")
    by_attributes.attrs["units"] = {"t": "ms", "x": "mm"}
    durations = frame.set_axis(pd.to_timedelta(STEPS, unit="s").rename("time [ms]"))
    named_x = frame.rename_axis("x [ms]")
    for given in (frame, frame.reset_index(), named_t, named_x, by_attributes, durations):
        data = ac.Data.from_dataframe(given)
        assert data.time.tolist() == STEPS.tolist()
        assert data.units == {"x": "mm"}


@pytest.mark.parametrize("time", ["t", "t [ms]"])
def test_times_are_found_by_their_name_or_their_whole_header(time, tmp_path):
    frame = pd.DataFrame({"x": STEPS}, index=TIMES.rename("t [ms]"))
    frame.to_csv(tmp_path / "run.csv")
    for data in (
        ac.Data.from_dataframe(frame, time=time),
        ac.Data.from_dataframe(frame.reset_index(), time=time),
        ac.Data.from_csv(tmp_path / "run.csv", time=time),
    ):
        assert data.time.tolist() == STEPS.tolist()
        assert data.names == ("x",)
        assert data.units is None
    with pytest.raises(ac.DataError, match=r"has no column 't \[s\]': known are 'x', 't'"):
        ac.Data.from_dataframe(frame, time="t [s]")


def test_the_unit_of_time_may_be_the_only_one():
    data = ac.Data(TIMES, {"x": STEPS}, units={"time": "ms"})
    assert data.time.tolist() == STEPS.tolist()
    assert data.units is None


def test_two_samples_at_one_time_are_a_jump_to_be_said_otherwise():
    jump = [0.0, 1.0, 1.0, 2.0, 3.0]
    remedy = (
        "1 s at sample 1 is followed by 1 s. Leave out one of the two; for a jump of an input, say "
        "interpolation='previous', or put a blocks.CombiTimeTable into the model, which takes a time twice."
    )
    for make in (ac.Data, lambda t, x: ac.Signal(t, x["x"])):
        with pytest.raises(ac.DataError) as error:
            make(jump, {"x": STEPS})
        assert str(error.value).endswith(remedy)
