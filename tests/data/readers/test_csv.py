import io
import random

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import acausal as ac
from acausal.data.readers import csv_file
from acausal.data.samples import TWICE
from tests.support.memory import peak_of
from tests.support.oscillator import plain


def refused(make):
    with pytest.raises(ac.DataError) as error:
        make()
    return str(error.value)


@pytest.fixture
def write(tmp_path):
    def write(text, name="run.csv", encoding="utf-8"):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(text.encode(encoding))
        return path

    return write


def test_a_file_with_units(write):
    path = write("time [s], mass.s [mm],mass.v [m/s]\n0,1,2\n\n0.5,2,3\n1,4,5\n")
    data = ac.Data.from_csv(path).for_system(plain())
    np.testing.assert_allclose(data["mass.s"], [1e-3, 2e-3, 4e-3])
    np.testing.assert_allclose(data.time, [0, 0.5, 1])


def test_a_file_without_units(write):
    held = ac.Data.from_csv(write("time,mass.s\n0,1\n1,2\n"), "previous", after_end="hold")
    assert held.units is None
    assert held.signal("mass.s").after_end == "hold"
    assert held.signal("mass.s").interpolation == "previous"


@pytest.mark.parametrize(
    "text",
    [
        "time [s],x [m]\n0,1.5\n0.5,-2e3\n",
        "time [s];x [m]\n0;1.5\n0.5;-2e3\n",
        "time [s];x [m]\n0;1,5\n0,5;-2e3\n",
        "time [s]\tx [m]\n0\t1,5\n0,5\t-2e3\n",
        "time [s] x [m]\n0 1.5\n0.5  -2e3 \n",
        "  time [s]   x [m]\r\n  0,0  1,5\r\n\r\n  0,5  -2e3\r\n",
        '"time [s]","x [m]"\n"0","1,5"\n"0,5","-2e3"\n',
        '"time [s]";"x [m]"\n"0";"1.5"\n"0.5";"-2e3"\n',
        "\ufeff\n\ntime [s],x [m]\n0,1.5\n0.5,-2e3",
    ],
)
def test_separator_and_decimal_mark_are_guessed(write, text):
    data = ac.Data.from_csv(write(text))
    np.testing.assert_array_equal(data.time, [0, 0.5])
    np.testing.assert_array_equal(data["x"], [1.5, -2000])
    assert data.units == {"x": "m"}


def test_separator_and_decimal_mark_can_be_said(write):
    path = write("time;x, measured\n0;1\n1;2\n" + "2;3\n" * 0)
    assert ac.Data.from_csv(path).names == ("x, measured",)
    late = "time;x\n" + "".join(f"{i};{i}\n" for i in range(200)) + "200;1,5\n"
    assert refused(lambda: ac.Data.from_csv(write(late))).endswith(
        "line 202: '1,5' in column 'x' is not a number "
        "(guessed: columns separated by semicolons, a decimal point)."
    )
    assert ac.Data.from_csv(write(late), decimal=",")["x"][-1] == 1.5


def test_columns_are_chosen_and_renamed(write):
    path = write("t [ms];comment;ch 1 [mm];ch 2 [V]\n0;ok;1;5\n1;;2;6\n")
    data = ac.Data.from_csv(
        path, time="t", columns=["ch 1"], rename={"ch 1": "mass.s"}, interpolation="cubic"
    )
    assert data.names == ("mass.s",)
    np.testing.assert_array_equal(data.time, [0, 1e-3])
    assert data.units == {"mass.s": "mm"}
    assert data.interpolation == "cubic"
    other = ac.Data.from_csv(path, time="t", columns=["ch 2"], units={"ch 2": "mV"})
    assert other.units == {"ch 2": "mV"}


@pytest.mark.parametrize("cell", ["", "nan", "NaN", " NA ", "null"])
def test_missing_cells(write, cell):
    text = f"time,x,y\n0,1,2\n1,{cell},3\n2,3,{cell}\n"
    data = ac.Data.from_csv(write(text), missing="nan")
    np.testing.assert_array_equal(data["x"], [1, np.nan, 3])
    assert data.counts == {"x": 2, "y": 2}
    assert refused(lambda: ac.Data.from_csv(write(text))).endswith(
        "run.csv: 'x' is nan at line 3; if such samples are missing, say missing='nan'."
    )


def test_many_files(write, tmp_path):
    for name in ("b", "a", "c"):
        write(f"time,x\n0,{ord(name)}\n1,0\n", f"{name}.csv")
    found = ac.Data.from_csv(tmp_path / "*.csv", after_end="hold")
    assert list(found) == ["a", "b", "c"]
    assert found["b"]["x"][0] == ord("b")
    assert found["b"].after_end == "hold"
    assert list(ac.Data.from_csv([tmp_path / "c.csv", str(tmp_path / "a.csv")])) == ["c", "a"]
    for folder in ("one", "two"):
        write("time,x\n0,1\n1,0\n", f"{folder}/run.csv")
    assert list(ac.Data.from_csv(f"{tmp_path}/*/run.csv")) == ["one/run", "two/run"]
    write("time,x\n0,1\n1,0\n", "[odd].csv")
    assert ac.Data.from_csv(tmp_path / "[odd].csv").names == ("x",)


def test_many_files_that_are_none(write, tmp_path):
    path = write("time,x\n0,1\n0,0\n")
    assert refused(lambda: ac.Data.from_csv(f"{tmp_path}/*.txt")).endswith(
        "*.txt'; give at least one."
    )
    assert refused(lambda: ac.Data.from_csv([])) == "from_csv: no files at '[]'; give at least one."
    assert "two files are called 'run'" in refused(lambda: ac.Data.from_csv([path, path]))
    assert refused(lambda: ac.Data.from_csv([path, 3])).startswith("from_csv: 3 is not a path")
    assert refused(lambda: ac.Data.from_csv(f"{tmp_path}/*.csv")).startswith(str(path))


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", " is empty; its first line must name the columns."),
        ("\n \n", " is empty; its first line must name the columns."),
        (
            "time,x\n0,1\n1\n",
            ", line 3: 1 values for 2 columns (guessed: columns separated by commas, a decimal point).",
        ),
        (
            "time,x\n0,5,1\n1,5,2\n",
            ", line 2: 3 values for 2 columns (guessed: columns separated by commas, a decimal point).",
        ),
        (
            "time,x\n0,1\n\n1,abc\n",
            ", line 4: 'abc' in column 'x' is not a number (guessed: columns separated by commas, a decimal point).",
        ),
        (
            "time;x\n0,5;1.5\n",
            ", line 2: '1.5' in column 'x' is not a number (guessed: columns separated by semicolons, a decimal comma).",  # noqa: E501
        ),
        ("time,x\n0,1\n1,nan\n", ": 'x' is nan at line 3; if such samples are missing, say missing='nan'."),
        ("time,x\n0,1\n\n1,inf\n", ": 'x' is inf at line 4; leave such samples out, or fill the gap."),
        ("time,x\n0,1\n,2\n", ": The record has a time that is nan at line 3."),
        (
            "\ntime,x\n0,1\n\n2,2\n1,2\n",
            ": The record has a time base that does not increase: 2 s at line 5 is followed by 1 s.",
        ),
        (
            "time,x\n0,1\n0,2\n1,2\n",
            ": The record has a time base that does not increase: 0 s at line 2 is followed by 0 s."
            + TWICE,
        ),
        ("time,x\n", ": The record needs a time base of at least two samples, got shape (0,)."),
        ("time,x,x\n0,1,1\n", ", line 1: two columns are called 'x'."),
        ("time,x [m\n0,1\n", ", line 1: 'x [m' is not a column header; write 'name' or 'name [unit]'."),
        (
            "t,x\n0,1\n1,1\n",
            " has no column 'time': known are 't', 'x'. Say time='...' if the times are called otherwise.",
        ),
        (
            "time,x [m],y\n0,1,1\n1,1,1\n",
            ": 'y' has no unit while other signals have one; give units to all.",
        ),
    ],
)  # fmt: skip
def test_bad_files_are_refused_with_the_line(write, text, sentence):
    path = write(text)
    message = refused(lambda: ac.Data.from_csv(path))
    assert message == f"{path}{sentence}"


def test_lines_are_counted_over_blocks(write, monkeypatch):
    monkeypatch.setattr(csv_file, "LINES", 7)
    rows = [f"{i},{i}\n" + "\n" * (i % 3 == 0) for i in range(300)]
    text = "time,x\n" + "".join(rows)
    np.testing.assert_array_equal(ac.Data.from_csv(write(text)).time, np.arange(300))
    line = text[: text.index("\n250,")].count("\n") + 2
    for wrong, told in (
        ("250,?", f", line {line}: '?'"),
        ("249,0", "followed by 249 s"),
        ("250,nan", f"line {line};"),
    ):
        bad = write(text.replace("\n250,250", f"\n{wrong}"))
        assert told in refused(lambda bad=bad: ac.Data.from_csv(bad))


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"colums": ["x"]}, "from_csv has no option 'colums': did you mean 'columns'?"),
        ({"columns": ["y"]}, "run.csv has no column 'y': known are 'time', 'x', 'z'."),
        ({"columns": 3}, "columns: 3 is not a name; give a text such as 'mass.s', or a list."),
        ({"rename": {"y": "z"}}, "run.csv has no column 'y': known are 'time', 'x', 'z'."),
        ({"rename": "y"}, "rename='y' has no names; give {'column': 'mass.s'}."),
        ({"rename": {"x": 3}}, "rename: 3 is not a name; give a text such as 'mass.s', or a list."),
        ({"rename": {"x": "z"}}, "run.csv are called 'z'."),
        ({"units": "m"}, "units='m' has no names; give a unit by name: {'mass.s': 'm'}."),
        ({"time": 3}, "time=3 is not a column; give its name, such as 'time'."),
        ({"separator": "|"}, "separator='|'; choose one of ';', '\\t', ',', ' '."),
        ({"decimal": "'"}, "decimal=\"'\"; choose one of '.', ','."),
        ({"encoding": "klingon"}, "encoding='klingon' is not known; give one such as 'latin-1'."),
        ({"missing": "drop"}, "missing='drop'; choose one of refuse, nan."),
    ],
)
def test_wrong_options_are_refused(write, options, sentence):
    path = write("time,x,z\n0,1,2\n1,2,3\n")
    assert refused(lambda: ac.Data.from_csv(path, **options)).endswith(sentence)


def test_what_is_no_text(write, tmp_path):
    path = write("time [s];T [°C]\n0;1\n1;2\n", encoding="latin-1")
    assert refused(lambda: ac.Data.from_csv(path)) == (
        f"{path} cannot be read: it is not utf-8; say encoding='latin-1' or another."
    )
    assert ac.Data.from_csv(path, encoding="latin-1").units == {"T": "°C"}
    for other in (tmp_path / "none.csv", tmp_path):
        assert "cannot be read" in refused(lambda other=other: ac.Data.from_csv(other))


def test_whatever_a_file_holds_it_is_read_or_refused_in_one_sentence(write):
    chance = random.Random(0)
    pieces = [*'time,x[m];\t "\n015._-e#\0é', "nan", "inf", "1e999", "\r\n", "0,5", ",,", "\n\n"]
    read, told = 0, ""
    for _ in range(500):
        separator = chance.choice(",;\t ")
        text = "\n".join(separator.join(row) for row in (["time", "x"], "01", "12", "23")) + "\n"
        for _ in range(chance.randint(0, 4)):
            at = chance.randrange(len(text))
            text = text[:at] + chance.choice(pieces) + text[at + chance.randint(0, 2) :]
        path = write(text)
        try:
            ac.Data.from_csv(path, missing=chance.choice(["refuse", "nan"]))
            read += 1
        except ac.DataError as error:
            told += str(error)
    assert "\n" not in told
    assert read > 100


@pytest.mark.parametrize("path", ["a\0b", ["a\0b"], "\0*", 3, None, b"x", {"a": "b"}])
def test_what_is_no_path(path):
    for read in (
        ac.Data.from_csv,
        ac.Data.from_mat,
        ac.Data.from_parquet,
        ac.Data.from_mdf,
    ):
        assert " is not a path; " in refused(lambda read=read: read(path))


numbers = st.floats(allow_nan=True, allow_infinity=False, width=64)


@settings(max_examples=80, deadline=None)
@given(
    rows=st.lists(st.tuples(numbers, numbers), min_size=2, max_size=8),
    separator=st.sampled_from([",", ";", "\t", " "]),
    decimal=st.sampled_from([".", ","]),
    empty=st.booleans(),
    blanks=st.booleans(),
)
def test_what_is_written_is_read(tmp_path_factory, rows, separator, decimal, empty, blanks):
    quoted = separator == decimal == ","

    def cell(x):
        text = "" if np.isnan(x) and empty and separator != " " else repr(x)
        text = text.replace(".", decimal)
        return f'"{text}"' if quoted else text

    values = np.array(rows)
    out = io.StringIO()
    out.write(separator.join(["time", "x", "y"]) + "\n")
    for i, row in enumerate(rows):
        out.write(separator.join([cell(i + 0.5), *map(cell, row)]) + "\n" + "\n" * blanks)
    path = tmp_path_factory.mktemp("csv") / "a.csv"
    path.write_text(out.getvalue())
    if np.isnan(values).all(axis=0).any():
        assert "is missing at all times" in refused(lambda: ac.Data.from_csv(path, missing="nan"))
        return
    data = ac.Data.from_csv(path, missing="nan")
    np.testing.assert_array_equal(data[["x", "y"]], values)
    np.testing.assert_array_equal(data.time, np.arange(len(rows)) + 0.5)


@pytest.mark.slow
def test_a_large_file_is_not_held_as_python_numbers(write):
    n = 200_000
    path = write("time,x,y\n" + "".join(f"{i},{i},\n" for i in range(n)))
    record = 3 * 8 * n
    peak = peak_of(lambda: ac.Data.from_csv(path, columns=["x"]))
    assert peak <= 2 * record + 20e6  # a block of lines as text


def test_a_column_names_the_runs(write):
    """Runs may be interleaved, and each has its own times."""
    path = write("run,time,x\nwarm,0,1\nwarm,1,2\ncold,0,3\ncold,0.5,4\nwarm,2,5\n")
    runs = ac.Data.from_csv(path, group="run")
    assert list(runs) == ["warm", "cold"]
    assert runs["warm"]["x"].tolist() == [1, 2, 5]
    assert runs["cold"].time.tolist() == [0, 0.5]
    assert "no column 'ru': did you mean 'run'?" in refused(
        lambda: ac.Data.from_csv(path, group="ru")
    )
    broken = write("run,time,x\nwarm,0,1\ncold,0,\nwarm,2,5\ncold,1,2\n")
    assert "run 'cold'" in (told := refused(lambda: ac.Data.from_csv(broken, group="run")))
    assert "line 3" in told
