"""Models of the gallery and published examples: no boxes overlap, and wires cross no more than those of `dot`."""

from __future__ import annotations

import ast
import sys
from collections.abc import Callable
from types import ModuleType
from typing import Any

import pytest

import acausal as ac
from acausal.drawing.layout import WIDE
from acausal.drawing.svg import contact, to_pin
from examples.battery_cell.model import Cell
from examples.battery_pack.model import Pack
from examples.campaign.model import unknown
from examples.cascaded_tanks.model import learned
from examples.double_pendulum.model import DoublePendulum
from examples.emps.model import Controlled, network
from examples.fleet.model import Resistance, Vehicle
from examples.following_arm.model import Arm
from examples.four_bar.model import FourBar, Viscous
from examples.qvm.model import with_networks
from examples.silverbox.model import Silverbox
from examples.single_track.model import SingleTrack
from tests.support import dot
from tests.support.clear_drawings import covered, overlaps
from tests.support.drawn import Bridge, Cascade, Drive
from tests.support.paths import ROOT, SHARED
from tests.test_docs import blocks

pytest.importorskip("graphlay")

ORACLES = SHARED / "oracles" / "msl"

GALLERY: dict[str, tuple[Callable[[], ac.Component], int]] = {
    "quarter vehicle": (with_networks, 0),
    "battery cell": (Cell, 4),
    "battery pack": (Pack, 0),
    "campaign": (unknown, 0),
    "cascaded tanks": (lambda: learned()[0], 0),
    "emps": (lambda: Controlled(network()), 0),
    "silverbox": (Silverbox, 0),
    "four-bar": (lambda: FourBar(Viscous()), 0),
    "double pendulum": (lambda: DoublePendulum(Viscous(), Viscous()), 0),
    "fleet": (lambda: Vehicle(Resistance()), 0),
    "following arm": (lambda: Arm(), 0),
    "single track": (lambda: SingleTrack(), 0),
    "drive": (Drive, 0),
    "bridge": (Bridge, 0),
}
"""A model, and how many crossings its drawing may have."""

PUBLISHED = sorted(path.stem for path in ORACLES.glob("*.json"))


PAGES: dict[str, Callable[[Any], ac.Component]] = {
    "battery": lambda page: page.Cell(),
    "building": lambda page: page.Heated(),
    "dc-motor": lambda page: page.Drive(1.0, 1.0),
    "drive-train": lambda page: page.Train(),
    "loudspeaker": lambda page: page.Loudspeaker(page.Hardening(c3=1.0)),
    "quarter-vehicle": lambda page: page.QuarterVehicle(page.Real()),
    "rc-filter": lambda page: page.Filter(),
    "tanks": lambda page: page.Tanks(page.hy.Orifice(area=1.0)),
}
"""Models of docs/gallery."""


def of_page(name: str) -> ac.Component:
    """The model of a page, whose imports and classes are run."""
    page: Any = ModuleType(name)
    sys.modules[page.__name__] = page
    for block in blocks(ROOT / "docs" / "gallery" / f"{name}.md"):
        kept = (ast.Import, ast.ImportFrom, ast.ClassDef)
        body = [node for node in ast.parse(block).body if isinstance(node, kept)]
        exec(compile(ast.Module(body, []), name, "exec"), vars(page))  # noqa: S102
    return PAGES[name](page)


def drawn(name: str) -> ac.Diagram:
    if name in PAGES:
        return ac.diagram(of_page(name), depth=2)
    if name in GALLERY:
        return ac.diagram(GALLERY[name][0]())
    return ac.diagram(ac.load(ORACLES / f"{name}.json"))


@pytest.mark.parametrize("name", GALLERY)
def test_a_gallery_model_is_drawn_well(name: str) -> None:
    placed = drawn(name).placed
    assert not overlaps(placed)
    assert placed.crossings <= GALLERY[name][1]


@pytest.mark.parametrize("name", [*GALLERY, *PAGES, *PUBLISHED])
def test_no_name_is_touched_and_no_wire_ends_in_the_air(name: str) -> None:
    placed = drawn(name).placed
    assert not covered(placed)
    for level in placed.levels():
        for box in level.boxes:
            for number in box.ports if not (box.box.icon.frame or box.box.is_port) else ():
                found = contact(box, to_pin(box, number)[-1])
                assert found is not None, f"{box.box.path}.{box.box.ports[number].name}"


def test_a_servo_is_folded_into_rows() -> None:
    placed = drawn("emps").placed
    assert placed.bounds.width <= WIDE
    assert placed.bounds.height > 300


def test_wires_keep_clear_of_what_they_do_not_belong_to() -> None:
    assert ac.diagram(Cascade()).placed.touched == 0


def test_published_examples_are_there() -> None:
    if not PUBLISHED:
        pytest.skip("the published examples lie beside the repository, in ../shared/oracles")
    assert len(PUBLISHED) >= 25


@pytest.mark.parametrize("name", PUBLISHED)
def test_a_published_example_is_drawn_well(name: str) -> None:
    placed = drawn(name).placed
    assert not overlaps(placed)
    assert placed.crossings <= 1
    assert placed.shared == 0


@pytest.mark.parametrize("name", [*GALLERY, *PUBLISHED])
def test_wires_cross_no_more_than_those_of_dot(name: str) -> None:
    if dot.DOT is None:
        pytest.skip("Graphviz' dot is not installed; with it, crossings are compared")
    placed = drawn(name).placed
    assert placed.crossings <= dot.crossings(placed)
