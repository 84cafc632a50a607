import numpy as np
import pytest

import acausal as ac
from acausal.data import records_of

TIME = np.linspace(0, 1, 11)
ONE = ac.Data(TIME, {"x": TIME})
PLAIN = {"time": TIME, "x": TIME**2}


def test_one_record_has_a_name():
    assert records_of(ONE) == {"record": ONE}
    np.testing.assert_array_equal(records_of(PLAIN)["record"]["x"], TIME**2)


def test_a_data_frame_is_one_record():
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    frame = pandas.DataFrame(PLAIN)
    assert list(records_of(frame)) == ["record"]
    assert list(records_of({"a": frame, "b": ONE})) == ["a", "b"]
    np.testing.assert_array_equal(records_of([frame, ONE])["record 1"]["x"], TIME**2)


@pytest.mark.parametrize("kind", [list, tuple])
def test_records_in_a_row_are_numbered(kind):
    found = records_of(kind([ONE, PLAIN]))
    assert list(found) == ["record 1", "record 2"]
    assert found["record 1"] is ONE


def test_records_by_name_keep_their_order():
    found = records_of({np.str_("warm"): ONE, "cold": PLAIN})
    assert list(found) == ["warm", "cold"]
    assert type(next(iter(found))) is str


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ([], "There are no records; give at least one."),
        ({}, "There are no records; give at least one."),
        (
            3,
            "Data are one record, a list of records, or records by name, not 3: give acausal.Data.",
        ),
        (
            "run.csv",
            "Data are one record, a list of records, or records by name, not 'run.csv': give acausal.Data.",
        ),
        ([ONE, 3], "'record 2': A record is acausal.Data or a mapping, not 3"),
        ({"a": ONE, "b": 3}, "'b': A record is acausal.Data or a mapping, not 3"),
        ({"a": ONE, "b": {"x": TIME}}, "'b': The record has no 'time': known are 'x'."),
        ({"x": TIME}, "The record has no 'time': known are 'x'."),
        ({"": ONE}, "'' is not the name of a record; give a text such as 'run 1'."),
        ({3: ONE}, "3 is not the name of a record; give a text such as 'run 1'."),
        ({"a": {"time": TIME, "x": TIME[1:]}}, "'a': 'x' has 10 samples for 11 times."),
    ],
)
def test_anything_else_is_refused_in_one_sentence(given, sentence):
    with pytest.raises(ac.DataError) as error:
        records_of(given)
    assert str(error.value) == sentence
