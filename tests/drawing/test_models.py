"""Models of the gallery and published examples: no boxes overlap, and wires cross no more than those of `dot`."""

from __future__ import annotations

from collections.abc import Callable

import pytest

import acausal as ac
from acausal.drawing.layout import WIDE
from examples.battery_cell.model import Cell
from examples.battery_pack.model import Pack
from examples.campaign.model import unknown
from examples.cascaded_tanks.model import learned
from examples.emps.model import Controlled, network
from examples.qvm.model import with_networks
from examples.silverbox.model import Silverbox
from tests.support import dot
from tests.support.drawn import Bridge, Cascade, Drive
from tests.support.paths import SHARED

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
    "drive": (Drive, 0),
    "bridge": (Bridge, 0),
}
"""A model, and how many crossings its drawing may have."""

PUBLISHED = sorted(path.stem for path in ORACLES.glob("*.json"))


def drawn(name: str) -> ac.Diagram:
    if name in GALLERY:
        return ac.diagram(GALLERY[name][0]())
    return ac.diagram(ac.load(ORACLES / f"{name}.json"))


@pytest.mark.parametrize("name", GALLERY)
def test_a_gallery_model_is_drawn_well(name: str) -> None:
    placed = drawn(name).placed
    assert not list(placed.overlaps())
    assert placed.crossings <= GALLERY[name][1]


@pytest.mark.parametrize("name", [*GALLERY, *PUBLISHED])
def test_no_name_is_touched(name: str) -> None:
    assert not drawn(name).placed.covered


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
    assert not list(placed.overlaps())
    assert placed.crossings <= 1
    assert placed.shared == 0


@pytest.mark.parametrize("name", [*GALLERY, *PUBLISHED])
def test_wires_cross_no_more_than_those_of_dot(name: str) -> None:
    if dot.DOT is None:
        pytest.skip("Graphviz' dot is not installed; with it, crossings are compared")
    placed = drawn(name).placed
    assert placed.crossings <= dot.crossings(placed)
