"""Icons: what a class may state, and that the library's classes have pictures that can be drawn."""

from __future__ import annotations

import importlib
import re
from collections.abc import Iterator

import pytest

import acausal as ac
from acausal.components import (
    blocks,
    electrical as el,
    fluid,
    icons,
    neural,
    rotational as rot,
    translational as tl,
)
from acausal.drawing.ports import BOOLEAN, INTEGER, color_of
from acausal.drawing.svg import contact, to_pin
from tests.support.clear_drawings import covered
from tests.support.scripts import script
from tests.support.surrounded import surrounded

LIBRARY = script("docs/make_components.py")

REFUSED = {"FixedDelay", "VariableDelay", "RealFFT"}
"""Classes that only say what is missing."""


def classes(package: str) -> Iterator[tuple[str, type[ac.Component]]]:
    """Name and class of all components of a package that can be parts of models."""
    for entry in LIBRARY.classes(package):
        partial = entry.name.rpartition(".")[2].startswith("Partial")
        usable = issubclass(entry.cls, ac.Component) and entry.cls.__name__ not in REFUSED
        if usable and not entry.is_base and not partial:
            yield entry.name, entry.cls


def look(cls: type[ac.Component]) -> str:
    return repr(cls.ICON)


@pytest.mark.parametrize("package", LIBRARY.packages())
def test_every_class_has_a_picture_of_its_own(package: str) -> None:
    """Classes may share one if they have the same name, or if one is the base of the other."""
    drawn: dict[str, tuple[str, type[ac.Component]]] = {}
    for name, cls in classes(package):
        assert cls.ICON is not None, name
        other, known = drawn.setdefault(look(cls), (name, cls))
        alike = issubclass(cls, known) or issubclass(known, cls) or is_base(cls) or is_base(known)
        same = name.rpartition(".")[2] == other.rpartition(".")[2]
        assert known is cls or same or alike or {name, other} in TWINS, f"{name} looks like {other}"


def is_base(cls: type[ac.Component]) -> bool:
    return "Base" in (cls.__doc__ or "") or cls in BASES


BASES = (fluid.FlowSensor, fluid.RelativeSensor)
TWINS: tuple[set[str], ...] = (
    {"Edge", "math_boolean.RisingEdge"},
    {"FixedTranslation", "multibody.FixedRotation"},
    {"PlanarWorld", "multibody.World"},
)
"""Two names of one thing."""


@pytest.mark.cases(fast=2, slow=99)
@pytest.mark.parametrize("package", LIBRARY.packages())
def test_no_wire_ends_in_the_air_and_nothing_touches_a_name(package: str) -> None:
    pytest.importorskip("graphlay")
    for name, cls in classes(package):
        try:
            placed = ac.diagram(surrounded(cls())).placed
        except (ac.AcausalError, TypeError):  # it needs a table, or a size
            continue
        assert not covered(placed), name
        for box in placed.boxes:
            if box.box.path != "part" or box.box.icon.frame:
                continue
            for port in box.ports:
                found = contact(box, to_pin(box, port)[-1])
                assert found is not None, f"{name}: {box.box.ports[port].name}"


def test_subclasses_inherit_pictures() -> None:
    class Rusty(tl.Spring):
        pass

    assert Rusty.ICON is tl.Spring.ICON is icons.SPRING
    assert neural.Compliance.ICON != neural.Resistance.ICON


@pytest.mark.parametrize("kind", ["Voltage", "Current"])
def test_sources_are_told_apart(kind: str) -> None:
    waves = "Constant Signal Step Ramp Sine ExpSine Exponentials Pulse SawTooth Trapezoid Table"
    found = [getattr(el, wave + kind).ICON for wave in waves.split()]
    assert len({(icon.strokes, icon.fills, icon.upright) for icon in found}) == len(found)


@pytest.mark.parametrize("domain", ["electrical", "rotational", "translational"])
def test_sensors_of_a_domain_show_what_they_measure(domain: str) -> None:
    package = importlib.import_module(f"acausal.components.{domain}")
    sensors = [
        getattr(package, n) for n in package.__all__ if n.endswith("Sensor") and "Partial" not in n
    ]
    pictures = [(c.ICON.size, c.ICON.text) for c in sensors if c.ICON is not None]
    assert all(text for _, text in pictures)
    assert len(set(pictures)) == len(pictures) > 2


def test_signals_have_the_colours_of_their_kinds() -> None:
    kinds = {kind: ac.Input(kind=kind) for kind in ("real", "bool", "int")}
    assert len({color_of(declared) for declared in kinds.values()}) == 3


def test_truth_values_and_whole_numbers_are_seen() -> None:
    """They are computed as real signals, but are drawn in colours of their own: wires and the frames of blocks."""
    model = ac.Component()
    model.step, model.to_real, model.gain = (
        blocks.BooleanStep(),
        blocks.BooleanToReal(),
        blocks.Gain(k=1),
    )
    model.whole, model.real = blocks.IntegerStep(height=1), blocks.IntegerToReal()
    model.connect(model.step.y, model.to_real.u)
    model.connect(model.to_real.y, model.gain.u)
    model.connect(model.whole.y, model.real.u)
    drawing = ac.diagram(model)
    colors = {drawn.net.names: drawn.net.color for drawn in drawing.placed.nets}
    assert colors["step.y", "to_real.u"] == BOOLEAN
    assert colors["whole.y", "real.u"] == INTEGER
    assert colors["to_real.y", "gain.u"] not in (BOOLEAN, INTEGER)
    assert f'stroke="{BOOLEAN}" stroke-width="1.2"/>' in drawing.svg


def test_ports_have_the_places_of_their_picture() -> None:
    """The positive input of an amplifier is at its sign, however the wires run."""
    part = next(
        b for b in ac.diagram(surrounded(el.IdealOpAmp3Pin())).placed.boxes if b.box.path == "part"
    )
    at = {part.box.ports[number].name: y for number, (_, y) in part.ports.items()}
    first, last = ("in_p", "in_n") if part.facing.flipped else ("in_n", "in_p")
    assert at[first] < at["out"] < at[last]


def test_a_picture_is_turned_upside_down_where_wires_would_cross() -> None:
    model = ac.Component()
    model.gear, model.sun = rot.IdealPlanetary(ratio=2.0), rot.Inertia(J=1.0)
    model.carrier, model.ring = rot.Inertia(J=1.0), rot.Inertia(J=1.0)
    model.engine, model.load = (
        rot.Torque(),
        rot.QuadraticSpeedDependentTorque(tau_nominal=-1.0, w_nominal=1.0),
    )
    model.connect(model.engine.flange, model.sun.flange_a)
    model.connect(model.sun.flange_b, model.gear.sun)
    model.connect(model.gear.carrier, model.carrier.flange_a)
    model.connect(model.carrier.flange_b, model.load.flange)
    model.connect(model.gear.ring, model.ring.flange_a)
    placed = ac.diagram(model).placed
    assert placed.crossings == 0
    assert [box.box.path for box in placed.boxes if box.facing.flipped] == ["gear"]


def test_a_circuit_begins_with_its_source() -> None:
    """A converter reads from the supply to the load, though a pulse rules its switch."""
    model = ac.Component()
    model.pulse = blocks.BooleanPulse(width=50, period=1e-4)
    model.source, model.inductor = el.ConstantVoltage(V=12.0), el.Inductor(L=1e-4)
    model.switch, model.diode = el.IdealClosingSwitch(), el.IdealDiode()
    model.load, model.ground = el.Resistor(R=10.0), el.Ground()
    model.connect(model.source.p, model.inductor.p)
    model.connect(model.inductor.n, model.switch.p, model.diode.p)
    model.connect(model.diode.n, model.load.p)
    model.connect(model.source.n, model.switch.n, model.load.n, model.ground.p)
    model.connect(model.pulse.y, model.switch.control)
    x = {box.box.path: box.icon.x for box in ac.diagram(model).placed.boxes}
    assert x["source"] < x["inductor"] < x["diode"] < x["load"]


@pytest.mark.parametrize("end", ["flange_a", "flange_b"])
def test_a_mark_is_beside_its_network(end: str) -> None:
    """The picture is mirrored where wires want it, the letters go to the free side."""
    model = ac.Component()
    model.push, model.law, model.wall = tl.Force(), neural.Resistance(), tl.Fixed()
    other = {"flange_a": "flange_b", "flange_b": "flange_a"}[end]
    model.connect(model.push.flange, getattr(model.law, end))
    model.connect(getattr(model.law, other), model.wall.flange)
    drawing = ac.diagram(model)
    part = next(box for box in drawing.placed.boxes if box.box.path == "law")
    (x,) = re.findall(r'<text x="([\d.-]+)"[^>]*>R</text>', drawing.svg)
    assert (float(x) < part.icon.x) == part.facing.mirrored == (end == "flange_b")


def test_a_backlash_does_not_look_like_a_damper() -> None:
    assert "M-12 -11H12V11H-12" in icons.DAMPER.strokes
    assert icons.BACKLASH.strokes != icons.DAMPER.strokes


class Standing(ac.Component):
    """A source beside two elements between the same two nodes."""

    def __init__(self) -> None:
        super().__init__()
        self.u, self.r = el.SineVoltage(V=1.0, f=50.0), el.Resistor(R=1.0)
        self.c, self.l = el.Capacitor(C=1.0), el.Inductor(L=1.0)
        self.connect(self.u.p, self.l.p)
        self.connect(self.l.n, self.r.p, self.c.p)
        self.connect(self.u.n, self.r.n, self.c.n)


def test_signs_of_a_turned_source_are_upright() -> None:
    """A minus that is turned with its picture reads as a bar."""
    svg = ac.diagram(Standing()).svg
    assert "rotate(90)" in svg
    place = r'<path transform="translate\((\S+) (\S+)\)" d="'
    (plus,) = re.findall(place + r'M-3 0H3M0 -3V3"', svg)
    (minus,) = re.findall(place + r'M-3 0H3"', svg)
    assert plus[0] == minus[0]  # one above the other
    assert float(plus[1]) == float(minus[1]) - 44


@pytest.mark.parametrize("name", [n for n, v in vars(icons).items() if isinstance(v, ac.Icon)])
def test_a_picture_stays_in_its_box(name: str) -> None:
    icon: ac.Icon = getattr(icons, name)
    width, height = icon.size
    numbers = [
        (float(x), float(y)) for x, y in re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", icon.strokes)
    ]
    for x, y in numbers:
        assert abs(x) <= width / 2 + 0.1
        assert abs(y) <= height / 2 + 4.1


@pytest.mark.parametrize(
    "wrong",
    [
        {"strokes": '"/><script>alert(1)</script>'},
        {"fills": "url(#x)"},
        {"sides": {"p": "up"}},
        {"places": {"p": 2}},
    ],
)
def test_a_wrong_picture_is_refused(wrong: dict[str, object]) -> None:
    with pytest.raises(ac.DeclarationError, match="an icon's"):
        ac.Icon(**wrong)


def test_a_picture_is_no_declaration() -> None:
    model = ac.Component()
    model.mass = tl.Mass(m=1)
    assert "ICON" not in ac.compile(model).variables


def test_connectors_have_colours() -> None:
    assert el.Resistor.p.COLOR != tl.Mass.flange_a.COLOR
    assert re.fullmatch(r"#[0-9a-f]{6}", ac.Connector.COLOR)
