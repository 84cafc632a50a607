"""Data frames, Parquet, MAT, MDF, xarray: what is written is read; what is wrong gets one sentence."""

import gc
import sys

import numpy as np
import pytest
import scipy.io
from hypothesis import given, settings, strategies as st

import acausal as ac

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning")

TIME = np.linspace(0, 1, 11)
GAP = np.where((TIME > 0.25) & (TIME < 0.65), np.nan, TIME)
SLOW = np.array([0.05, 0.5, 1.0])
RATES = ac.Data(
    signals={"acc": (TIME, TIME**2), "level": (SLOW, 10 * SLOW)},
    units={"acc": "m/s2", "level": "V"},
)


def refused(make):
    with pytest.raises(ac.DataError) as error:
        make()
    return str(error.value)


def need(name):
    return pytest.importorskip(name, reason=f"{name} is not installed")


def assert_same(one, other):
    assert one.names == other.names
    assert one.units == other.units
    np.testing.assert_array_equal(one.time, other.time)
    for name in one:
        np.testing.assert_array_equal(one[name], other[name])


vectors = st.lists(st.floats(allow_infinity=False, width=64), min_size=2, max_size=6).filter(
    lambda v: not np.isnan(v).all()
)


@pytest.mark.parametrize("form", ["dataframe", "xarray"])
@settings(max_examples=40, deadline=None)
@given(values=vectors, with_units=st.booleans())
def test_what_is_made_of_a_record_is_read_back(form, values, with_units):
    need({"dataframe": "pandas", "xarray": "xarray"}[form])
    time = np.arange(len(values)) / 3
    units = {"x": "m", "y": ""} if with_units else None
    data = ac.Data(time, {"x": values, "y": time}, units, missing="nan")
    written = getattr(data, f"to_{form}")()
    assert_same(getattr(ac.Data, f"from_{form}")(written, missing="nan"), data)


def test_two_rates_are_read_back():
    need("pandas")
    assert_same(ac.Data.from_dataframe(RATES.to_dataframe(), missing="nan"), RATES)


def test_units_of_a_data_frame():
    pandas = need("pandas")
    frame = pandas.DataFrame({"time [ms]": 1e3 * TIME, "x [mm]": TIME, "y": TIME})
    assert "'y' has no unit" in refused(lambda: ac.Data.from_dataframe(frame))
    frame.attrs["units"] = {"y": "V", "x": "cm"}
    data = ac.Data.from_dataframe(frame, rename={"y": "level"})
    assert data.units == {"x": "cm", "level": "V"}
    np.testing.assert_allclose(data.time, TIME)
    assert ac.Data.from_dataframe(frame, units={"x": "m"}).units == {"x": "m", "y": "V"}


@pytest.mark.parametrize("zone", [None, "Europe/Berlin"])
def test_dates_become_seconds_from_the_first(zone):
    pandas = need("pandas")
    dates = pandas.date_range("2024-03-31 00:59:59", periods=11, freq="100ms", tz=zone)
    by_index = pandas.DataFrame({"x": TIME}, index=dates)
    by_column = pandas.DataFrame({"x": TIME, "when": dates})
    durations = pandas.DataFrame({"x": TIME}, index=dates - dates[0])
    for frame, time in ((by_index, "time"), (by_column, "when"), (durations, "time")):
        data = ac.Data.from_dataframe(frame, time=time)
        np.testing.assert_allclose(data.time, TIME, atol=1e-12)
        assert data.names == ("x",)
    np.testing.assert_allclose(ac.Data.of(by_index).time, TIME, atol=1e-12)


def test_kinds_of_numbers_in_a_data_frame():
    pandas = need("pandas")
    frame = pandas.DataFrame(
        {
            "time": pandas.array([0, 1, 2], dtype="Int64"),
            "x": pandas.array([1.5, None, 2], dtype="Float64"),
            "n": np.array([1, 2, 3], np.int8),
            "on": [True, False, True],
            "text": ["a", "b", "c"],
        }
    )
    data = ac.Data.from_dataframe(frame, columns=["x", "n", "on"], missing="nan")
    np.testing.assert_array_equal(data["x"], [1.5, np.nan, 2])
    np.testing.assert_array_equal(data["on"], [1, 0, 1])
    assert "'text' holds" in refused(lambda: ac.Data.from_dataframe(frame, missing="nan"))


def test_wrong_data_frames():
    pandas = need("pandas")
    frame = pandas.DataFrame({"x": TIME})
    assert refused(lambda: ac.Data.from_dataframe(3)) == (
        "from_dataframe needs a pandas DataFrame, not 3."
    )
    assert "its index only counts the rows" in refused(lambda: ac.Data.from_dataframe(frame))
    assert "The data frame has no column 't'" in refused(
        lambda: ac.Data.from_dataframe(frame, time="t")
    )
    assert "The data frame has a column 0" in refused(
        lambda: ac.Data.from_dataframe(pandas.DataFrame({0: TIME}))
    )
    doubled = pandas.DataFrame({"x": TIME}, index=pandas.Index(TIME // 0.5, name="time"))
    assert "0 s at sample 0 is followed by 0 s" in refused(lambda: ac.Data.from_dataframe(doubled))


def test_parquet(tmp_path):
    need("pandas")
    need("pyarrow")
    for name in ("a", "b"):
        RATES.to_dataframe().to_parquet(tmp_path / f"{name}.parquet")
    assert_same(ac.Data.from_parquet(tmp_path / "a.parquet", missing="nan"), RATES)
    assert list(ac.Data.from_parquet(f"{tmp_path}/*.parquet", missing="nan")) == ["a", "b"]
    (tmp_path / "c.parquet").write_text("no")
    assert "c.parquet is not a Parquet file" in refused(
        lambda: ac.Data.from_parquet(tmp_path / "c.parquet")
    )
    assert "cannot be read" in refused(lambda: ac.Data.from_parquet(tmp_path / "d.parquet"))


def test_mat_version_5(tmp_path):
    path = tmp_path / "run.mat"
    content = {
        "t": TIME[:, None],
        "x": GAP[None, :],
        "scale": 3.0,
        "note": "text",
        "cells": np.array([1, "a"], object),
        "run": {"y": TIME, "deep": {"z": TIME.astype(np.int16)}},
        "matrix": np.ones((3, 3)),
    }
    scipy.io.savemat(path, content)
    data = ac.Data.from_mat(path, time="t", rename={"x": "mass.s"}, missing="nan")
    assert set(data.names) == {"mass.s", "run.y", "run.deep.z"}
    np.testing.assert_array_equal(data["mass.s"], GAP)
    chosen = ac.Data.from_mat(path, time="t", columns=["run.y"], units={"run.y": "V", "time": "ms"})
    assert chosen.units == {"run.y": "V"}
    np.testing.assert_allclose(chosen.time, TIME / 1e3)
    for options, told in (
        ({}, "run.mat has no column 'time'"),
        ({"time": "matrix"}, "'matrix' has shape (3, 3); a vector of times is needed."),
        ({"time": "t", "columns": ["matrix"]}, "'matrix' are not vectors of numbers"),
        ({"time": "t", "columns": ["note"]}, "'note' are not vectors of numbers"),
        ({"time": "t", "columns": ["scale"]}, "'scale' has 1 samples for 11 times."),
        ({"time": "t", "columns": ["q"]}, "run.mat has no column 'q'"),
    ):
        assert told in refused(lambda options=options: ac.Data.from_mat(path, **options))


@pytest.mark.parametrize("content", [b"", b"no", bytes(range(256)) * 4])
def test_what_is_no_mat_file(tmp_path, content):
    path = tmp_path / "bad.mat"
    path.write_bytes(content)
    assert "bad.mat is not a MAT file" in refused(lambda: ac.Data.from_mat(path))
    assert "cannot be read" in refused(lambda: ac.Data.from_mat(tmp_path / "none.mat"))


def test_mat_version_7_3(tmp_path, monkeypatch):
    h5py = need("h5py")
    path = tmp_path / "run.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        file["time"] = TIME[None, :]
        file["run/x"] = TIME[:, None] ** 2
        file["note"] = np.frombuffer(b"text", np.uint8)
        file["note"].attrs["MATLAB_class"] = np.bytes_("char")
        file["#refs#/a"] = TIME
    data = ac.Data.from_mat(path)
    assert data.names == ("run.x",)
    np.testing.assert_array_equal(data["run.x"], TIME**2)
    monkeypatch.setitem(sys.modules, "h5py", None)
    assert refused(lambda: ac.Data.from_mat(path)) == (
        f"{path} has MATLAB's version 7.3, which needs h5py: pip install 'acausal[mat]'."
    )


@pytest.fixture(scope="module")
def mf4(tmp_path_factory):
    asammdf = need("asammdf")
    path = tmp_path_factory.mktemp("mdf") / "run.mf4"
    signal = asammdf.Signal
    with asammdf.MDF() as file:
        file.append(
            [
                signal(TIME**2, TIME, name="acc", unit="m/s^2"),
                signal(np.arange(11, dtype=np.uint8), TIME, name="count"),
                signal(TIME, TIME, name="twice", unit="V"),
            ]
        )
        file.append(
            [
                signal(10 * SLOW, SLOW, name="level", unit="V"),
                signal(SLOW, SLOW, name="twice", unit="V"),
                signal(np.array([b"a", b"b", b"c"]), SLOW, name="text", encoding="utf-8"),
            ]
        )
        file.save(path, overwrite=True)
    return path


def test_mdf(mf4):
    data = ac.Data.from_mdf(mf4, columns=["acc", "level"], rename={"level": "tank.level"})
    assert data.units == {"acc": "m/s^2", "tank.level": "V"}
    np.testing.assert_array_equal(data.samples("acc")[1], TIME**2)
    np.testing.assert_array_equal(data.samples("tank.level")[0], SLOW)
    assert data.missing == "nan"
    everything = ac.Data.from_mdf(mf4)
    assert set(everything.names) == {"acc", "count", "twice@0", "level", "twice@1"}
    assert everything.units["count"] == ""
    assert list(ac.Data.from_mdf(str(mf4.parent / "*.mf4"))) == ["run"]
    assert "'text' are not numbers" in refused(lambda: ac.Data.from_mdf(mf4, columns=["text"]))
    assert "has no column 'speed'" in refused(lambda: ac.Data.from_mdf(mf4, columns=["speed"]))
    assert "from_mdf has no option 'time'" in refused(lambda: ac.Data.from_mdf(mf4, time="t"))


@pytest.mark.parametrize(
    "content", [b"", b"no", bytes(range(256)) * 4, b"MDF     4.10    " + bytes(200)]
)
def test_what_is_no_mdf_file(tmp_path, monkeypatch, content):
    need("asammdf")
    monkeypatch.setattr(sys, "unraisablehook", lambda _: None)
    path = tmp_path / "bad.mf4"
    path.write_bytes(content)
    assert "bad.mf4 is not an MDF file" in refused(lambda: ac.Data.from_mdf(path))
    gc.collect()  # asammdf fails to close what it failed to open
    assert "cannot be read" in refused(lambda: ac.Data.from_mdf(tmp_path / "none.mf4"))


def test_xarray():
    xarray = need("xarray")
    two = xarray.Dataset(
        {
            "acc": ("t1", TIME**2, {"units": "m/s2"}),
            "level": ("t2", 10 * SLOW, {"units": "V"}),
        },
        coords={"t1": TIME, "t2": SLOW},
    )
    assert_same(ac.Data.from_xarray(two), RATES)
    dated = xarray.Dataset(
        {"x": ("when", TIME)},
        coords={"when": np.datetime64("2024-01-01", "ns") + (1e9 * TIME).astype("m8[ns]")},
    )
    np.testing.assert_allclose(ac.Data.from_xarray(dated).time, TIME, atol=1e-9)
    assert "from_xarray needs an xarray.Dataset, not 3" in refused(lambda: ac.Data.from_xarray(3))
    bare = xarray.Dataset({"x": ("t", TIME), "m": (("a", "b"), np.ones((2, 2)))})
    assert "'x', 'm' over other than one dimension" in refused(lambda: ac.Data.from_xarray(bare))
    mixed = two.assign_coords(t1=("t1", TIME, {"units": "s"}), t2=("t2", SLOW, {"units": "ms"}))
    assert "times of the data set have the units 's', 'ms'" in refused(
        lambda: ac.Data.from_xarray(mixed)
    )


@pytest.mark.parametrize(
    ("module", "extra", "call"),
    [
        ("pandas", "dataframe", lambda path: RATES.to_dataframe()),
        ("pyarrow", "parquet", ac.Data.from_parquet),
        ("asammdf", "mdf", ac.Data.from_mdf),
        ("xarray", "xarray", lambda path: RATES.to_xarray()),
    ],
)
def test_a_library_that_is_absent_is_named(tmp_path, monkeypatch, module, extra, call):
    monkeypatch.setitem(sys.modules, module, None)
    assert refused(lambda: call(tmp_path / "file")).endswith(
        f"needs {module}: pip install 'acausal[{extra}]'."
    )


def test_a_column_of_a_data_frame_names_the_runs():
    pd = pytest.importorskip("pandas")
    frame = pd.DataFrame(
        {"run": [2, 1, 2, 1], "time": [0.0, 0.0, 1.0, 1.0], "x": [1.0, 2.0, 3.0, 4.0]}
    )
    runs = ac.Data.from_dataframe(frame, group="run")
    assert list(runs) == ["2", "1"]
    assert runs["2"]["x"].tolist() == [1.0, 3.0]
    with pytest.raises(ac.DataError, match="no column 'Run': did you mean 'run'"):
        ac.Data.from_dataframe(frame, group="Run")
