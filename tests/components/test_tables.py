"""Tables: splines against SciPy's, what holds outside, tables in files, arrays in netlists."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import Akima1DInterpolator, PchipInterpolator, RectBivariateSpline
from scipy.io import savemat

import acausal as ac
from acausal.components import blocks

X = np.array([0.0, 0.4, 1.1, 1.5, 2.3, 3.0])
Y = np.array([1.0, 2.0, 0.5, 0.5, 0.8, 3.0])
ROWS = np.stack([X, Y], 1)
SPLINES: dict[Any, Any] = {
    "ContinuousDerivative": Akima1DInterpolator(X, Y),
    "ModifiedContinuousDerivative": Akima1DInterpolator(X, Y, method="makima"),
    "MonotoneContinuousDerivative1": PchipInterpolator(X, Y),
}
TS = np.linspace(0, 4, 81)


def values(**sources: Any) -> ac.Solution:
    """Blocks whose inputs are the time, over four seconds."""
    model = ac.Component()
    model.clock = blocks.ContinuousClock()
    for name, block in sources.items():
        setattr(model, name, block)
        for u in ("u", "u1", "u2"):
            if hasattr(block, u):
                model.connect(model.clock.y, getattr(block, u))
    return ac.simulate(ac.compile(model), (0, 4), saveat=TS)


@pytest.mark.slow
def test_splines_are_those_of_scipy_and_continue_by_their_tangents() -> None:
    found = values(
        **{kind: blocks.CombiTable1Ds(table=ROWS, smoothness=kind) for kind in SPLINES},
        steffen=blocks.CombiTable1Ds(table=ROWS, smoothness="MonotoneContinuousDerivative2"),
        held=blocks.CombiTimeTable(
            table=ROWS, smoothness="ContinuousDerivative", extrapolation="HoldLastPoint"
        ),
        again=blocks.CombiTimeTable(
            table=ROWS, smoothness="ContinuousDerivative", extrapolation="Periodic"
        ),
    )
    inside, beyond = TS <= 3, TS > 3
    akima = SPLINES["ContinuousDerivative"]
    for kind, spline in SPLINES.items():
        inner = inside & (TS >= 0.4) & (TS <= 2.3) if "Monotone" in kind else inside
        np.testing.assert_allclose(found[f"{kind}.y[1]"][inner], spline(TS[inner]), atol=1e-12)
    tangent = 3 + akima(3.0, nu=1) * (TS - 3)
    np.testing.assert_allclose(
        found["ContinuousDerivative.y[1]"][beyond], tangent[beyond], atol=1e-12
    )
    np.testing.assert_allclose(found["held.y[1]"][beyond], 3, atol=1e-12)
    np.testing.assert_allclose(found["again.y[1]"][beyond], akima(TS[beyond] - 3), atol=1e-12)
    steps = np.diff(np.asarray(found["steffen.y[1]"])[inside])
    rises = np.sign(np.diff(Y))[np.searchsorted(X, TS[inside][1:] - 0.02, side="right") - 1]
    assert (steps * rises >= -1e-15)[np.abs(rises) > 0].all()


def test_surfaces_are_smooth_repeat_and_continue() -> None:
    y = np.array([0.0, 1.0, 2.5, 3.0])
    z = np.outer(Y, [1.0, 3.0, 2.0, 2.5])
    table = np.block([[np.zeros((1, 1)), y[None]], [X[:, None], z]])
    smooth: dict[str, Any] = {"table": table, "smoothness": "ContinuousDerivative"}
    found = values(
        smooth=blocks.CombiTable2Ds(**smooth),
        again=blocks.CombiTable2Ds(**smooth, extrapolation="Periodic"),
        bilinear=blocks.CombiTable2Ds(table=table, extrapolation="HoldLastPoint"),
    )
    along_x, along_y = Akima1DInterpolator(X, Y), Akima1DInterpolator(y, [1.0, 3.0, 2.0, 2.5])
    inside = TS <= 3
    product = along_x(TS) * along_y(TS)
    np.testing.assert_allclose(found["smooth.y"][inside], product[inside], atol=1e-12)
    np.testing.assert_allclose(found["again.y"][~inside], product[TS <= 1][1:], atol=1e-12)
    d = TS[~inside] - 3
    corner = (3 + along_x(3.0, nu=1) * d) * (2.5 + along_y(3.0, nu=1) * d)
    np.testing.assert_allclose(found["smooth.y"][~inside], corner, atol=1e-12)
    linear = RectBivariateSpline(X, y, z, kx=1, ky=1)
    clipped = np.minimum(TS, 3)
    np.testing.assert_allclose(
        found["bilinear.y"], linear(clipped, clipped, grid=False), atol=1e-12
    )


def test_a_jump_at_an_end_has_no_line_to_continue() -> None:
    rows = [[1, 1], [1, 2], [2, 3], [2, 7]]
    found = values(table=blocks.CombiTimeTable(table=rows))
    np.testing.assert_allclose(found["table.y[1]"][TS < 1], 1)
    np.testing.assert_allclose(found["table.y[1]"][TS > 2], 7)


def test_files_are_read(tmp_path: Path) -> None:
    rows = [[0, 1, 2], [4, 5, 6]]
    text = "#1\n# comment\nfloat other(1, 2)\n0 0\ndouble a(2 3) # more\n0,1 2 # values\n4\t5 6\n"
    (tmp_path / "table.txt").write_text("\ufeff" + text, encoding="utf-8")
    (tmp_path / "table.csv").write_text("t;a;b\n0;1;2\n4;5;6\n", encoding="utf-8")
    savemat(tmp_path / "table.mat", {"a": rows})
    csv: dict[str, Any] = {"delimiter": ";", "nHeaderLines": 1}
    for file, options in (("txt", {}), ("csv", csv), ("mat", {})):
        table = blocks.CombiTimeTable(
            tableOnFile=True, tableName="a", fileName=str(tmp_path / f"table.{file}"), **options
        )
        np.testing.assert_array_equal(table._rows(), rows)  # pyright: ignore[reportPrivateUsage]
    for name, message in (
        ("table.txt", r"table.txt has no table 'b'; it has other, a"),
        ("table.mat", r"table.mat has no table 'b'; it has a"),
        ("none.txt", "there is no such file"),
    ):
        with pytest.raises(ac.DeclarationError, match=message):
            blocks.CombiTimeTable(tableOnFile=True, tableName="b", fileName=str(tmp_path / name))


ORDER = "the first column of table must ascend, but 1 is followed by 0; sort the table"
UNSORTED = [[-1.0, -5.0], [1.0, 1.0], [0.0, 0.0], [2.0, 8.0]]


@pytest.mark.parametrize(
    ("kind", "table", "message"),
    [
        (blocks.CombiTable1Ds, UNSORTED, f"CombiTable1Ds: {ORDER}"),
        (blocks.CombiTable1Dv, UNSORTED, f"CombiTable1Dv: {ORDER}"),
        (blocks.CombiTimeTable, UNSORTED, f"CombiTimeTable: {ORDER}"),
        (blocks.TimeTable, UNSORTED, f"TimeTable: {ORDER}"),
        (
            blocks.CombiTable2Ds,
            [[0, 1, 2], [3, 0, 0], [3, 0, 0]],
            "CombiTable2Ds: the first column of table, from its second row on, must ascend, but 3 is followed by 3",
        ),
        (
            blocks.CombiTable2Ds,
            [[0, 2, 1], [3, 0, 0]],
            "the first row of table, from its second column on, must ascend, but 2 is followed by 1",
        ),
        (
            blocks.CombiTable1Ds,
            [[-1, -5], [0, 0], [1]],
            "CombiTable1Ds: the rows of table differ in length: row 1 has 2 numbers, row 3 has 1; give each row",
        ),
        (blocks.TimeTable, [[0, "a"]], r"TimeTable: table holds something that is no number"),
    ],
)
def test_wrong_tables_are_refused_where_the_component_is_made(
    kind: Any, table: Any, message: str
) -> None:
    with pytest.raises(ac.DeclarationError, match=message):
        kind(table=table)


def test_a_netlist_names_the_component_of_a_wrong_table(tmp_path: Path) -> None:
    lut = {"class": "Modelica.Blocks.Tables.CombiTable1Ds", "with": {"table": UNSORTED}}
    file = tmp_path / "lut.json"
    file.write_text(json.dumps({"components": {"lut": lut}}), encoding="utf-8")
    with pytest.raises(ac.ModelError, match=rf"lut.json: components.lut: CombiTable1Ds: {ORDER}"):
        ac.load(file)


def test_netlists_write_arrays(tmp_path: Path) -> None:
    rows = "transpose([0, 1; 1, 5; 2, 6])"
    periodic = "Modelica.Blocks.Types.Extrapolation.Periodic"
    document: Any = {
        "components": {
            "table": {
                "class": "Modelica.Blocks.Tables.CombiTable2Ds",
                "with": {"table": rows, "extrapolation": periodic},
            },
            "constants": {
                "class": "Modelica.Blocks.Sources.CombiTimeTable",
                "with": {"table": "fill(2.0, 1, 3)"},
            },
        },
        "connections": [["constants.y[1]", "table.u1"], ["constants.y[2]", "table.u2"]],
    }
    file = tmp_path / "model.json"
    file.write_text(json.dumps(document), encoding="utf-8")
    model = ac.load(file)
    assert model.table.table == [[0, 1, 2], [1, 5, 6]]
    assert model.constants.table == [[2.0, 2.0, 2.0]]
    document["components"]["constants"]["with"]["table"] = "fill(2.0, 1e9, 3)"
    file.write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(ac.ModelError, match="fill does not take these arguments"):
        ac.load(file)
