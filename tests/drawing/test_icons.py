"""Icons: what a class may state, and that the library's classes have pictures that can be drawn."""

from __future__ import annotations

import importlib
import inspect
import re
from collections.abc import Iterator

import pytest

import acausal as ac
from acausal.components import electrical as el, icons, neural, translational as tl
from acausal.drawing.ports import color_of

DOMAINS = (
    *("battery", "blocks", "digital", "electrical", "fluid", "hydraulic", "magnetic", "neural"),
    *("rotational", "thermal", "translational"),
)


def classes() -> Iterator[type[ac.Component]]:
    for domain in DOMAINS:
        package = importlib.import_module(f"acausal.components.{domain}")
        for name in package.__all__:
            value = getattr(package, name)
            if inspect.isclass(value) and issubclass(value, ac.Component):
                yield value


def test_most_classes_have_a_picture_and_share_few() -> None:
    with_picture = [c for c in classes() if c.ICON is not None]
    assert len(with_picture) >= 250
    assert len({repr(c.ICON) for c in with_picture}) < 190


def test_subclasses_inherit_pictures() -> None:
    class Rusty(tl.Spring):
        pass

    assert Rusty.ICON is tl.Spring.ICON is icons.SPRING
    assert el.Conductor.ICON is icons.RESISTOR
    assert neural.Compliance.ICON is neural.Resistance.ICON is icons.NEURAL


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
    pictures = [(c.ICON.strokes, c.ICON.text) for c in sensors if c.ICON is not None]
    assert all(text for _, text in pictures)
    assert len(set(pictures)) == len(pictures) > 2


def test_signals_have_the_colours_of_their_kinds() -> None:
    kinds = {kind: ac.Input(kind=kind) for kind in ("real", "bool", "int")}
    assert len({color_of(declared) for declared in kinds.values()}) == 3


def test_a_backlash_does_not_look_like_a_damper() -> None:
    assert "M-12 -11H12V11H-12" in icons.DAMPER.strokes
    assert icons.BACKLASH.strokes.count("M") == 2


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
