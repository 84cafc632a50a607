"""What a drawing shows: every part, every wire, arrows, networks, lists, sub-models."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import pytest

import acausal as ac
from acausal.components import blocks, electrical as el, translational as tl
from examples.qvm.model import with_networks
from tests.support.clear_drawings import overlaps
from tests.support.counted import calls_below
from tests.support.drawn import Bridge, Chain, Controller, Drive, Tree
from tests.support.paths import ROOT

pytest.importorskip("graphlay")

SVG = "{http://www.w3.org/2000/svg}"


def attributes(drawing: ac.Diagram, name: str) -> list[str]:
    """Values of a data attribute, in order."""
    root = ElementTree.fromstring(drawing.svg)
    return [e.attrib[f"data-{name}"] for e in root.iter() if f"data-{name}" in e.attrib]


def texts(drawing: ac.Diagram) -> list[str]:
    return [e.text or "" for e in ElementTree.fromstring(drawing.svg).iter(f"{SVG}text")]


def test_every_part_and_every_connection_has_a_group() -> None:
    drawing = ac.diagram(with_networks())
    parts = {"body", "suspension", "spring_nn", "damper_nn", "wheel", "tyre", "road"}
    assert set(attributes(drawing, "component")) == parts
    assert parts <= set(texts(drawing))
    wires = {frozenset(names.split()) for names in attributes(drawing, "connection")}
    assert frozenset({"tyre.flange_b", "road.flange"}) in wires
    assert len(wires) == 4
    (body,) = (w for w in wires if "body.flange_b" in w)
    assert len(body) == 4


def test_a_system_is_drawn_as_its_model() -> None:
    model = ac.Component()
    model.mass, model.push = tl.Mass(m=1), tl.Force()
    model.connect(model.push.flange, model.mass.flange_a)
    assert ac.diagram(ac.compile(model)).svg == ac.diagram(model).svg


def test_wires_reach_the_ports_of_their_ends() -> None:
    placed = ac.diagram(Drive()).placed
    ends = {point for box in placed.boxes for point in box.ports.values()}
    for net in placed.nets:
        reached = {line[-1] for line in net.lines} | {line[0] for line in net.lines}
        assert len(reached & ends) == len(net.net.ends)
        for line in net.lines:
            for (a, b), (x, y) in pairwise(line):
                assert a == x or b == y, "wires are horizontal or vertical"


def test_a_ground_is_drawn_at_each_component_that_needs_it() -> None:
    drawing = ac.diagram(Bridge())
    assert attributes(drawing, "component").count("ground") == 4
    assert "load.n ground.p" in attributes(drawing, "connection")


@pytest.mark.slow
def test_lists_are_one_box_with_a_count() -> None:
    chain = Chain(10_000)
    with calls_below(8_000_000):
        drawing = ac.diagram(chain)
    assert sorted(set(attributes(drawing, "component"))) == ["mass", "push", "spring", "wall"]
    assert {"mass (10000)", "spring (10000)"} <= set(texts(drawing))
    assert len(drawing.svg) < 10_000
    short = ac.diagram(Chain(3))
    assert {"mass[1]", "mass[2]", "mass[3]"} <= set(texts(short))


def test_sub_models_open() -> None:
    closed, opened = ac.diagram(Drive()), ac.diagram(Drive(), depth=2)
    assert "controller.pi" not in attributes(closed, "component")
    assert 'data-component="controller" data-inside="true"' in closed.svg
    found = attributes(opened, "component")
    assert {"controller", "controller.error", "controller.pi", "controller.limit"} <= set(found)
    assert sorted(attributes(opened, "port")) == [
        "controller.reference", "controller.speed", "controller.voltage",
    ]  # fmt: skip
    assert ac.diagram(Drive(), depth=3).svg == opened.svg
    alone = ac.diagram(Drive().controller)
    assert "controller.pi" in attributes(alone, "component")


def test_at_depth_zero_a_model_is_one_box() -> None:
    drawing = ac.diagram(Drive().controller, depth=0)
    assert attributes(drawing, "component") == ["controller"]
    assert attributes(ac.diagram(el.Resistor(R=1.0), depth=0), "connection") == []


def test_wires_of_an_opened_component_go_on_inside_it() -> None:
    placed = ac.diagram(Drive(), depth=2).placed
    (box,) = (box for box in placed.boxes if box.inner is not None)
    inner, (right, down) = box.inner
    gates = {g.box.label: (g.icon.x + right, g.icon.y + down) for g in inner.boxes if g.box.is_port}
    for number, (x, y) in box.ports.items():
        gate = gates[box.box.ports[number].name]
        assert (x, y) == pytest.approx(gate, abs=3.0)


def test_a_connection_into_a_part_of_a_part_gets_a_port() -> None:
    model = ac.Component()
    model.drive, model.probe = Drive(), el.VoltageSensor()
    model.connect(model.drive.r.n, model.probe.p)
    model.connect(model.drive.ground.p, model.probe.n)
    assert "drive.r.n probe.p" in attributes(ac.diagram(model), "connection")
    opened = ac.diagram(model, depth=2)
    assert "drive.r.n" in attributes(opened, "port")
    assert not overlaps(opened.placed)


def test_what_holds_a_network_is_tinted() -> None:
    drawing = ac.diagram(with_networks())
    assert drawing.svg.count('fill="#e0962f" fill-opacity="0.16"') == 2


def test_what_holds_a_table_is_not() -> None:
    table = blocks.CombiTimeTable(table=[[0.0, 0.0], [1.0, 1.0]])
    assert "fill-opacity" not in ac.diagram(table, depth=0).svg
    assert (
        "fill-opacity"
        not in ac.diagram(el.TableVoltage(table=[[0.0, 0.0], [1.0, 1.0]]), depth=0).svg
    )


def test_signals_have_arrows_and_open_inputs_are_seen() -> None:
    def arrows(drawing: ac.Diagram) -> int:
        return len(re.findall(r'Z" fill="#6f7fa3"/>', drawing.svg))

    model = Controller()
    assert arrows(ac.diagram(model)) == 4 + 3  # the outside signals are triangles, too
    assert arrows(ac.diagram(with_networks())) == 1  # road.v_ref


def test_a_class_without_icon_shows_its_name() -> None:
    class Gizmo(ac.Component):
        flange_a, flange_b = tl.Flange(), tl.Flange()

    model = ac.Component()
    model.thing, model.mass = Gizmo(), tl.Mass(m=1)
    model.connect(model.thing.flange_b, model.mass.flange_a)
    assert {"thing", "Gizmo"} <= set(texts(ac.diagram(model)))


def test_texts_are_escaped() -> None:
    class Odd(ac.Component):
        ICON = ac.Icon(text="<&>", frame=True)

    model = ac.Component()
    model.odd = Odd()
    assert "<&>" in texts(ac.diagram(model))


def test_an_empty_model_can_be_drawn() -> None:
    assert attributes(ac.diagram(ac.Component()), "component") == []


@pytest.mark.parametrize("model", [3, "x", None, tl.Mass])
def test_only_components_are_drawn(model: object) -> None:
    with pytest.raises(ac.ModelError, match="diagram needs a Component"):
        ac.diagram(model)


@pytest.mark.parametrize("depth", [-1, 1.5, True, "2"])
def test_a_depth_is_a_whole_number(depth: object) -> None:
    with pytest.raises(ac.ModelError, match=r"depth=.*; give a whole number, 0 or more"):
        ac.diagram(ac.Component(), depth=depth)


def test_drawings_are_shown_and_saved(tmp_path: Path) -> None:
    drawing = ac.diagram(Drive())
    assert drawing._repr_svg_() == drawing.svg
    path = drawing.save(tmp_path / "new" / "drive.svg")
    assert path.read_text(encoding="utf-8") == drawing.svg
    with pytest.raises(ac.DataError, match="should end with"):
        drawing.save(tmp_path / "drive.png")
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(ac.DataError, match="cannot be written"):
        drawing.save(tmp_path / "file" / "drive.svg")
    assert len(repr(drawing)) < 200


def test_drawings_need_no_colour_of_their_own_page() -> None:
    """Lines take the page's text colour; a file of its own follows the reader's light or dark scheme."""
    svg = ac.diagram(with_networks()).svg
    assert "currentColor" in svg
    assert "prefers-color-scheme:dark" in svg
    assert "<script" not in svg
    assert "http" not in svg.replace("http://www.w3.org/2000/svg", "")


@pytest.mark.slow
def test_the_same_model_gives_the_same_drawing_whatever_the_hash_seed() -> None:
    code = (
        "import acausal as ac; from tests.support.drawn import Drive, Bridge; import hashlib;"
        "print(hashlib.sha256((ac.diagram(Drive(), depth=2).svg + ac.diagram(Bridge()).svg).encode()).hexdigest())"
    )
    found = {
        subprocess.run(
            [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True,
            env={**os.environ, "PYTHONHASHSEED": seed},
        ).stdout
        for seed in ("1", "2")
    }  # fmt: skip
    assert len(found) == 1


@pytest.mark.slow
def test_two_hundred_components_take_little_work() -> None:
    tree = Tree(100)
    with calls_below(3_000_000):
        placed = ac.diagram(tree).placed
    assert len(placed.boxes) == 199
    assert not overlaps(placed)


def test_what_is_missing_is_told_in_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "graphlay", None)
    with pytest.raises(ac.AcausalError, match=r"needs graphlay: pip install 'acausal\[diagram\]'"):
        ac.diagram(with_networks())
