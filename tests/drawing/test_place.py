"""Placement that an author gave, in Python, in a netlist or as a Modelica annotation, is kept."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import acausal as ac
from acausal.components import blocks, electrical as el
from acausal.modelica.placing import placement
from acausal.modeling import Placement
from tests.support.clear_drawings import covered

pytest.importorskip("graphlay")


class Converter(ac.Component):
    """A boost converter as textbooks draw it."""

    def __init__(self) -> None:
        super().__init__()
        self.source, self.inductor = el.ConstantVoltage(V=12.0), el.Inductor(L=1e-4)
        self.switch, self.diode = el.IdealClosingSwitch(), el.IdealDiode()
        self.load, self.ground = el.Resistor(R=10.0), el.Ground()
        self.pulse = blocks.BooleanPulse(width=50, period=1e-4)
        self.connect(self.source.p, self.inductor.p)
        self.connect(self.inductor.n, self.switch.p, self.diode.p)
        self.connect(self.diode.n, self.load.p)
        self.connect(self.source.n, self.switch.n, self.load.n, self.ground.p)
        self.connect(self.pulse.y, self.switch.control)
        ac.place(self.source, -80, 0, turned=270)
        ac.place(self.inductor, -50, 30)
        ac.place(self.switch, -20, 0, turned=90, mirrored=True)
        ac.place(self.diode, 10, 30)
        ac.place(self.load, 40, 0, turned=270)
        ac.place(self.ground, -80, -40)
        ac.place(self.pulse, -50, 0)


def spots(drawing: ac.Diagram) -> dict[str, tuple[float, float]]:
    return {box.box.path: (box.icon.x, box.icon.y) for box in drawing.placed.boxes}


def test_parts_lie_where_they_were_placed() -> None:
    drawing = ac.diagram(Converter())
    x, y = zip(*(spots(drawing)[name] for name in ("source", "inductor", "diode")), strict=True)
    assert x[1] - x[0] == pytest.approx((x[2] - x[1]) / 2)
    assert y[0] > y[1] == y[2]  # upwards in the model is upwards on paper
    placed = drawing.placed
    assert (placed.crossings, placed.shared, placed.touched, covered(placed)) == (0, 0, 0, [])
    source = next(box for box in placed.boxes if box.box.path == "source")
    assert [source.side(number) for number in sorted(source.ports)] == ["top", "bottom"]
    ground = [box for box in placed.boxes if box.box.path == "ground"]
    assert len(ground) == 1, "one ground was placed, not one for each part"


def test_without_a_place_for_every_part_none_is_kept() -> None:
    model = Converter()
    model.more = el.Resistor(R=1.0)
    model.connect(model.more.p, model.load.p)
    model.connect(model.more.n, model.load.n)
    drawn = [box.box.path for box in ac.diagram(model).placed.boxes]
    assert "ground" not in drawn, "it is drawn at each part that needs it"


def test_a_netlist_keeps_places(tmp_path: Path) -> None:
    entry = {"class": "acausal.components.translational.Mass", "with": {"m": 1.0}}
    spot = {"x": 20, "y": 40.5, "turned": 90, "mirrored": True}
    path = tmp_path / "model.json"
    path.write_text(json.dumps({"model": "One", "components": {"mass": {**entry, "place": spot}}}))
    model = ac.load(path)
    assert model.mass._node.placement == Placement(**spot)
    ac.save(model, tmp_path / "again.json")
    assert json.loads((tmp_path / "again.json").read_text())["components"]["mass"]["place"] == spot


@pytest.mark.parametrize(
    ("spot", "message"),
    [
        ({"x": 1}, r"mass\.place: x and y are needed"),
        ({"x": 1, "y": 2, "turned": 45}, "turned by 0, 90, 180 or 270 degrees"),
        ({"x": "1", "y": 2}, "a placement's x is a number"),
        ({"x": 1, "y": 2, "z": 3}, "z"),
    ],
)
def test_a_wrong_place_is_refused(tmp_path: Path, spot: dict[str, object], message: str) -> None:
    entry = {"class": "acausal.components.translational.Mass", "with": {"m": 1.0}, "place": spot}
    path = tmp_path / "model.json"
    path.write_text(json.dumps({"model": "One", "components": {"mass": entry}}))
    with pytest.raises(ac.ModelError, match=message):
        ac.load(path)


def test_only_parts_are_placed() -> None:
    with pytest.raises(ac.ModelError, match="place needs a part, got float"):
        ac.place(1.0, 0, 0)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("extent={{-40,-10},{-20,10}}", Placement(-30.0, 0.0)),
        ("extent={{20,-10},{0,10}}", Placement(10.0, 0.0, 0, True)),
        ("extent={{-10,10},{10,-10}}", Placement(0.0, 0.0, 180, True)),
        ("extent={{-10,-10},{10,10}},rotation=-90,origin={5,7.5}", Placement(5.0, 7.5, 270)),
        ("origin={1,2},extent={{0,-10},{20,10}},rotation=90", Placement(1.0, 12.0, 90)),
        ("extent={{a,-10},{b,10}}", None),
    ],
)
def test_annotations_of_modelica_are_read(text: str, expected: Placement | None) -> None:
    assert placement(f"annotation(Placement(transformation({text})))") == expected
    assert placement(f"annotation(Placement(visible=true,transformation({text})))") == expected


def test_a_modelica_model_is_drawn_as_in_its_tool(tmp_path: Path) -> None:
    path = tmp_path / "Drive.mo"
    path.write_text(
        "model Drive\n"
        "  Modelica.Mechanics.Rotational.Sources.Torque torque\n"
        "    annotation (Placement(transformation(extent={{-80,-10},{-60,10}})));\n"
        '  Modelica.Mechanics.Rotational.Components.Inertia load(J=1) "turned"\n'
        "    annotation (Placement(transformation(extent={{-10,-10},{10,10}}, rotation=270,\n"
        "      origin={-20,-30})));\n"
        "equation\n"
        "  connect(torque.flange, load.flange_a) annotation (Line(points={{-60,0},{-20,0}}));\n"
        "end Drive;\n"
    )
    at = spots(ac.diagram(ac.load(path)))
    assert at["load"][0] - at["torque"][0] == pytest.approx(50 * 3.4)
    assert at["load"][1] - at["torque"][1] == pytest.approx(30 * 3.4)
