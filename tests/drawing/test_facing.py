"""How boxes are turned: along the flow of signals, sources first, upright between nets at one place."""

import pytest

import acausal as ac
from acausal.components import blocks, electrical as el, rotational as rot, translational as tl
from tests.support.drawn import Chain, Drive

pytest.importorskip("graphlay")


def places(model: ac.Component) -> dict[str, float]:
    """Where boxes lie from left to right."""
    return {box.box.path: box.icon.x for box in ac.diagram(model).placed.boxes}


def upright(model: ac.Component) -> set[str]:
    return {box.box.path for box in ac.diagram(model).placed.boxes if box.facing.upright}


def test_a_drawing_reads_from_the_source_to_the_load() -> None:
    at = places(Drive())
    chain = ("step", "controller", "supply", "r", "l", "motor", "rotor", "gear", "load")
    assert sorted(chain, key=at.__getitem__) == list(chain)


def test_a_chain_is_a_straight_line_whichever_end_is_declared_first() -> None:
    placed = ac.diagram(Chain(4)).placed
    assert placed.bends == 0
    assert len({round(box.icon.y) for box in placed.boxes}) == 1


def test_flanges_that_are_connected_the_other_way_round_are_no_matter() -> None:
    model = ac.Component()
    model.push, model.a, model.b, model.c = tl.Force(), tl.Mass(m=1), tl.Spring(c=1), tl.Mass(m=1)
    model.connect(model.push.flange, model.a.flange_b)
    model.connect(model.a.flange_a, model.b.flange_b)
    model.connect(model.b.flange_a, model.c.flange_b)
    placed = ac.diagram(model).placed
    assert placed.bends == 0
    assert {box.box.path for box in placed.boxes if box.facing.mirrored} == {"a", "b", "c"}


def test_source_and_capacitor_of_a_loop_stand() -> None:
    model = ac.Component()
    model.source, model.r, model.c = el.SineVoltage(V=1, f=1), el.Resistor(R=1), el.Capacitor(C=1)
    model.connect(model.source.p, model.r.p)
    model.connect(model.r.n, model.c.p)
    model.connect(model.c.n, model.source.n)
    assert upright(model) == {"source", "c"}
    at = places(model)
    assert at["source"] < at["r"] < at["c"]
    assert ac.diagram(model).placed.crossings == 0


def test_parallel_elements_lie() -> None:
    model = ac.Component()
    model.a, model.s, model.d, model.b = tl.Mass(m=1), tl.Spring(c=1), tl.Damper(d=1), tl.Mass(m=1)
    model.connect(model.a.flange_b, model.s.flange_a, model.d.flange_a)
    model.connect(model.s.flange_b, model.d.flange_b, model.b.flange_a)
    assert upright(model) == set()


def test_a_support_is_below_with_its_wall() -> None:
    model = ac.Component()
    model.torque, model.wall = rot.Torque(useSupport=True), rot.Fixed()
    model.inertia, model.sine = rot.Inertia(J=1), blocks.Sine(f=1)
    model.connect(model.sine.y, model.torque.tau)
    model.connect(model.torque.support, model.wall.flange)
    model.connect(model.torque.flange, model.inertia.flange_a)
    placed = ac.diagram(model).placed
    assert {box.box.path for box in placed.boxes} == {"torque", "inertia", "sine"}
    (torque,) = (box for box in placed.boxes if box.box.path == "torque")
    assert [footing.path for footing in torque.box.footings] == ["wall"]
