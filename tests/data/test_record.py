import numpy as np
import pytest

import acausal as ac
from acausal.components import thermal
from acausal.units.si import convert
from tests.support.oscillator import plain

TIME = np.linspace(0, 1, 11)

KINDS = "linear, previous, cubic, akima, modified-akima, monotone, steffen, band-limited"


def refused(make):
    with pytest.raises(ac.DataError) as error:
        make()
    return str(error.value)


def test_a_record():
    data = ac.Data(TIME, {"mass.s": TIME**2})
    assert data.uniform
    assert data.sample_time == pytest.approx(0.1)
    assert len(data) == 11
    assert "11 samples at 0.1 s" in repr(data)
    np.testing.assert_array_equal(data["mass.s"], TIME**2)
    assert len(data.between(0.25, 0.65)) == 4


def test_a_mapping_is_a_record():
    data = ac.Data.of({"time": TIME, "mass.s": TIME})
    assert tuple(data.signals) == ("mass.s",)
    assert (
        refused(lambda: ac.Data.of({"Time": TIME}))
        == "The record has no 'time': did you mean 'Time'?"
    )


def test_units_are_converted():
    units = {"time": "ms", "mass.s": "mm", "mass.v": "km/h"}
    data = ac.Data(1e3 * TIME, {"mass.s": TIME, "mass.v": TIME}, units).for_system(plain())
    np.testing.assert_allclose(data.time, TIME)
    np.testing.assert_allclose(data["mass.s"], 1e-3 * TIME)
    np.testing.assert_allclose(data["mass.v"], TIME / 3.6)


@pytest.mark.parametrize(
    ("given", "wanted", "factor"),
    [
        ("kN.m", "N.m", 1000),
        ("N/mm", "N/m", 1000),
        ("g/cm3", "kg/m3", 1000),
        ("cm/s2", "m/s2", 0.01),
        ("rev/min", "rad/s", 2 * np.pi / 60),
        ("1", "", 1),
        ("percent", "1", 0.01),
    ],
)
def test_spellings_of_units(given, wanted, factor):
    assert convert(np.ones(1), given, wanted, "x")[0] == pytest.approx(factor)


def test_temperatures_have_an_offset():
    assert convert(np.array([20.0]), "degC", "K", "x")[0] == pytest.approx(293.15)


class Room(ac.Component):
    def __init__(self) -> None:
        super().__init__()
        self.air, self.wall = thermal.HeatCapacitor(C=1e4), thermal.ThermalConductor(G=10.0)
        self.outside = thermal.PrescribedTemperature()
        self.connect(self.outside.port, self.wall.port_a)
        self.connect(self.wall.port_b, self.air.port)


def test_temperatures_that_look_like_degrees_celsius_are_said_to(recwarn):
    system, values = ac.compile(Room()), 20 + 5 * TIME
    for name in ("outside.T", "air.T"):
        with pytest.warns(UserWarning, match=f"'{name}' lies between 20 and 25, and the model has"):
            ac.Data(TIME, {name: values}).for_system(system)
    recwarn.clear()
    ac.Data(TIME, {"outside.T": values}, units={"outside.T": "degC"}).for_system(system)
    ac.Data(TIME, {"air.T": values + 273.15, "wall.dT": values}).for_system(system)
    assert not recwarn.list


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (
            lambda: ac.Data(TIME, {"x": np.where(TIME > 0.75, np.nan, TIME)}),
            "'x' is nan at sample 8 (0.8 s) and 2 more; if such samples are missing, say missing='nan'.",
        ),
        (lambda: ac.Data(TIME, {"x": TIME[:-1]}), "'x' has 10 samples for 11 times."),
        (lambda: ac.Data(TIME, {"x": 1j * TIME}), "'x' holds complex128; real numbers are needed."),
        (lambda: ac.Data(TIME, {"x": None}), "'x' holds None; real numbers are needed."),
        (
            lambda: ac.Data(TIME, {"x": TIME}, "m"),
            "units='m' has no names; give a unit by name: {'mass.s': 'm'}.",
        ),
        (
            lambda: ac.Data(TIME, {"x": TIME}, {"x": 3}),
            "units: 'x' has 3; give a text such as 'N/m'.",
        ),
        (
            lambda: ac.Data(TIME, {"x": TIME}, interpolation=3),
            f"interpolation=3; choose one of {KINDS}, for all or by name.",
        ),
        (
            lambda: ac.Data.from_csv(3.5),
            "from_csv: 3.5 is not a path; give a text such as 'folder/file', or a pathlib.Path.",
        ),
        (
            lambda: ac.Data(TIME, {"x": TIME}).between("a", 1.0),
            "start='a' is not a time; give seconds, such as 0.0.",
        ),
        (
            lambda: ac.Data(TIME, {"x": TIME}).for_system(plain().model),
            "for_system needs a compiled model, got Oscillator: give ac.compile(model).",
        ),
        (
            lambda: ac.Signal(TIME, TIME)("now"),
            "A signal has no value at t='now'; give seconds.",
        ),
        (
            lambda: ac.Data(1e7 + TIME.astype(np.float32), {"x": TIME}),
            (
                "The record has a time base that does not increase: 10000000 s at sample 0 is followed by 10000000 s. "
                "Times in float32 are too coarse for this: give float64."
            ),
        ),
        (
            lambda: ac.Data(TIME, TIME),
            (
                "The signals of a record have names: give ac.Data(time, {'mass.s': samples}), "
                "not an array of shape (11,)."
            ),
        ),
        (
            lambda: ac.Data(TIME, {0: TIME}),
            "signals: 0 is not a name; give a text such as 'mass.s', or a list.",
        ),
        (
            lambda: ac.Data(TIME, {"x": TIME}, after_end="stop"),
            "The record has after_end='stop'; choose one of refuse, hold, linear, periodic.",
        ),
        (
            lambda: ac.Data(TIME, {"x": TIME}).between(5, 6),
            "No two samples lie between 5 and 6 s; the record goes from 0 to 1 s.",
        ),
        (
            lambda: ac.Data(TIME[::-1], {"x": TIME}),
            "The record has a time base that does not increase: 1 s at sample 0 is followed by 0.9 s.",
        ),
        (
            lambda: ac.Data(TIME, {"x": TIME, "y": TIME}, {"x": "m"}),
            "'y' has no unit while other signals have one; give units to all.",
        ),
        (
            lambda: ac.Data(TIME, {"x": TIME}, {"x": "m", "y": "m"}),
            "There are units for 'y' but no such signal: known are 'x'.",
        ),
        (
            lambda: ac.Data(TIME, {"mass.vv": TIME}).for_system(plain()),
            (
                "The data have 'mass.vv', but the model does not: did you mean 'mass.v'? "
                "Leave others out by data.select([...])."
            ),
        ),
        (
            lambda: ac.Data(TIME, {"mass.v": TIME}, {"mass.v": "kg"}).for_system(plain()),
            "'mass.v' is given in 'kg', which cannot become 'm/s'.",
        ),
        (
            lambda: convert(TIME, "rpm", "", "'n'"),
            (
                "'n' is given in 'rpm', which cannot become '1': declare unit='rpm' in the model, "
                "or give its numbers with the unit '1'."
            ),
        ),
        (
            lambda: ac.Data(TIME, {"mass.v": TIME}).select(["mass.s"]),
            "The record has no 'mass.s': did you mean 'mass.v'?",
        ),
    ],
)
def test_bad_records_are_refused_in_one_sentence(make, sentence):
    assert refused(make) == sentence


def test_signals_are_read_by_name_or_by_lists_of_names():
    data = ac.Data(TIME, {"x": TIME, np.str_("y"): TIME**2})
    assert list(data) == ["x", "y"] == list(data.names)
    assert type(data.names[1]) is str
    assert "x" in data
    assert "z" not in data
    np.testing.assert_array_equal(data[["y", "x"]], np.stack([TIME**2, TIME], axis=1))
    assert data[[]].shape == (11, 0)
    assert data.select(np.array(["y"])).names == ("y",)
    with pytest.raises(ac.DataError, match="The record has no 'z': known are 'x', 'y'"):
        data[["x", "z"]]


def test_what_comes_beyond_goes_along_with_the_record():
    data = ac.Data(TIME, {"u": TIME, "v": TIME}, before_start="hold", after_end={"u": "periodic"})
    part = data.between(0.1, 0.9)
    assert part.select(["u"]).signal("u").after_end == "periodic"
    assert part.signal("v").after_end == "refuse"
    assert part.signal("v").before_start == "hold"
    scaled = ac.Data(TIME, {"mass.s": TIME}, {"mass.s": "mm"}, after_end="hold").for_system(plain())
    assert scaled.signal("mass.s").after_end == "hold"


def test_a_data_frame_is_a_record():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"x": TIME, "y": TIME**2}, index=TIME)
    for data in (
        ac.Data.of(frame),
        ac.Data(TIME, frame),
        ac.Data.of(frame.rename_axis("time").reset_index()),
    ):
        np.testing.assert_array_equal(data.time, TIME)
        np.testing.assert_array_equal(data[["x", "y"]], frame.to_numpy())
    twice = pandas.concat([frame, frame], axis=1)
    assert refused(lambda: ac.Data.of(twice)) == "The data frame has two columns 'x'."
    assert refused(lambda: ac.Data.of(frame.reset_index(drop=True))).startswith(
        "The data frame has no time: its index only counts the rows."
    )


def test_signals_say_their_units():
    """As those of xarray do, and pandas' columns."""
    column = pytest.importorskip("pandas").Series(TIME)
    column.attrs["units"] = "mm"
    data = ac.Data(TIME, {"mass.s": column}).for_system(plain())
    np.testing.assert_allclose(data["mass.s"], 1e-3 * TIME)
    assert "has no unit" in refused(lambda: ac.Data(TIME, {"mass.s": column, "mass.v": TIME}))


def test_a_unit_that_is_none():
    message = refused(
        lambda: ac.Data(TIME, {"mass.v": TIME}, {"mass.v": "meterz"}).for_system(plain())
    )
    assert message.startswith("'mass.v': 'meterz' is not a unit")


def test_interpolation_goes_along_with_the_record():
    t = np.linspace(0, 1, 11)
    record = ac.Data(t, {"u": t, "w": t**2, "y": t}, interpolation={"u": "previous", "w": "cubic"})
    part = record.between(0, 0.5).select(["u", "y"])
    assert part.signal("u").interpolation == "previous"
    assert part.signal("y").interpolation == "linear"
    assert ac.Data(t, {"u": t}, interpolation="band-limited").signal("u").coefficients is not None


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ("spline", f"The record has interpolation='spline'; choose one of {KINDS}."),
        ({"v": "cubic"}, "There is a choice of interpolation for 'v' but no such signal: known are 'u'."),
    ],
)  # fmt: skip
def test_interpolations_are_checked(given, sentence):
    with pytest.raises(ac.DataError) as error:
        ac.Data([0.0, 1.0], {"u": [0.0, 1.0]}, interpolation=given)
    assert str(error.value) == sentence
