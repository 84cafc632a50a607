"""Constraints that the structure does not show: parallel, delta and star circuits away from the ground."""

from __future__ import annotations

from typing import Any

import pytest

import acausal as ac
from acausal.components import electrical as el, rotational as rot, translational as tl
from tests.support.oracle import worst
from tests.support.parts import Equations, model

Eq, der = ac.Eq, ac.der


def resistors(count: int) -> dict[str, ac.Component]:
    return {f"r{i}": el.Resistor(R=float(i)) for i in range(1, count + 1)}


def capacitors(count: int) -> dict[str, ac.Component]:
    return {f"c{i}": el.Capacitor(C=float(i)) for i in range(1, count + 1)}


def inductors(count: int) -> dict[str, ac.Component]:
    return {f"l{i}": el.Inductor(L=float(i)) for i in range(1, count + 1)}


def delta(sides: str, legs: str, **parts: ac.Component) -> ac.Component:
    """Three elements in a ring, three more from its corners to the ground."""
    a, b, c = (f"{sides}{i}" for i in (1, 2, 3))
    x, y, z = (f"{legs}{i}" for i in (1, 2, 3))
    return model(
        f"{a}.n - {b}.p", f"{b}.n - {c}.p", f"{c}.n - {a}.p",
        f"{a}.p - {x}.p", f"{b}.p - {y}.p", f"{c}.p - {z}.p",
        f"{x}.n - g.p", f"{y}.n - g.p", f"{z}.n - g.p",
        g=el.Ground(), **parts,
    )  # fmt: skip


def in_series(between: str, *lines: str, **parts: ac.Component) -> ac.Component:
    """A source, a resistor, two elements side by side, another resistor, the ground."""
    a, b = (f"{between}{i}" for i in (1, 2))
    return model(
        "s.p - r1.p", f"r1.n - {a}.p", f"{a}.p - {b}.p", f"{a}.n - {b}.n", f"{a}.n - r2.p",
        "r2.n - s.n", "s.n - g.p", *lines,
        s=el.SignalVoltage(), g=el.Ground(), **parts,
    )  # fmt: skip


MODELS: dict[str, tuple[Any, tuple[str, ...]]] = {
    "capacitors side by side": (
        lambda: in_series("c", **resistors(2), **capacitors(2)),
        ("c1.v",),
    ),
    "capacitors in a delta": (
        lambda: delta("c", "r", **resistors(3), **capacitors(3)),
        ("c1.v", "c2.v"),
    ),
    "inductors around a delta of resistors": (
        lambda: delta("r", "l", **resistors(3), **inductors(3)),
        ("l1.i", "l2.i"),
    ),
    "inductors around resistors side by side": (
        lambda: model(
            "s.p - l1.p", "l1.n - r1.p", "r1.p - r2.p", "r1.n - r2.n", "r1.n - l2.p", "l2.n - s.n",
            "s.n - g.p", s=el.SignalVoltage(), g=el.Ground(), **resistors(2), **inductors(2),
        ),
        ("l1.i",),
    ),
    "a capacitor at both windings of a transformer": (
        lambda: model(
            "s.p - r1.p", "r1.n - c1.p", "c1.p - t.p1", "c1.n - t.n1", "c1.n - r2.p", "r2.n - s.n",
            "t.p2 - c2.p", "t.n2 - c2.n", "t.n2 - s.n", "s.n - g.p",
            s=el.SignalVoltage(), g=el.Ground(), t=el.IdealTransformer(n=3.0),
            **resistors(2), **capacitors(2),
        ),
        ("c1.v",),
    ),
    "springs with dampers in a ring without masses": (
        lambda: model(
            "w.flange - k.flange_a", "k.flange_b - a.flange_a", "a.flange_b - b.flange_a",
            "b.flange_b - c.flange_b", "c.flange_a - a.flange_a", "b.flange_b - l.flange_a",
            "l.flange_b - m.flange_a",
            w=tl.Fixed(), k=tl.Spring(c=5.0), a=tl.SpringDamper(c=1.0, d=2.0),
            b=tl.SpringDamper(c=2.0, d=1.0), c=tl.SpringDamper(c=3.0, d=4.0),
            l=tl.Spring(c=7.0), m=tl.Mass(m=1.0),
        ),
        ("a.s_rel", "b.s_rel", "m.s", "m.v"),
    ),
    "a planetary gear between dampers": (
        lambda: model(
            "g.sun - g.ring", "g.sun - a.flange_a", "a.flange_b - g.carrier",
            "g.sun - b.flange_a", "b.flange_b - w.flange",
            g=rot.IdealPlanetary(ratio=3.5), a=rot.SpringDamper(c=1.0, d=2.0),
            b=rot.SpringDamper(c=1.0, d=2.0), w=rot.Fixed(),
        ),
        ("b.phi_rel",),
    ),
}  # fmt: skip


@pytest.mark.cases(fast=3)
@pytest.mark.parametrize("name", MODELS)
def test_what_only_the_sum_of_equations_says_is_found(name: str) -> None:
    make, states = MODELS[name]
    system = ac.compile(make())
    assert set(system.states) == set(states)
    assert worst(system) < 1e-12


def test_the_constraint_holds_for_other_parameters() -> None:
    make, _ = MODELS["a capacitor at both windings of a transformer"]
    system = ac.compile(make())
    params = {**system.parameters(), "t.n": 0.7, "c1.C": 2.5}
    assert worst(system, params=params) < 1e-12
    first, second = system.observe(["c1.v", "c2.v"], 0.0, [0.5], [1.0], params)
    assert first == pytest.approx(0.7 * second)


def test_two_capacitors_side_by_side_are_one() -> None:
    make, _ = MODELS["capacitors side by side"]
    system = ac.compile(make())
    rate = system.vector_field(0.0, [0.5], [2.0], system.parameters())
    assert rate == pytest.approx([(2.0 - 0.5) / (1.0 + 2.0) / (1.0 + 2.0)])


def test_what_is_left_may_be_nonlinear() -> None:
    made = Equations(
        "x y p q r",
        lambda s: [
            Eq(s.p - s.q, s.x + 1),
            Eq(2 * s.p - 2 * s.q, s.y**3 + s.y),
            Eq(s.r, der(s.x) + der(s.y)),
            Eq(s.p, -s.r - s.x),
            Eq(s.q, s.k * s.r),
        ],
        k=1.5,
    )
    system = ac.compile(made)
    assert len(system.states) == 1
    assert worst(system) < 1e-10


@pytest.mark.parametrize(
    "without",
    [
        lambda: model("a.p - b.p", "a.n - b.n", a=el.SignalVoltage(), b=el.Resistor(R=1.0)),
        lambda: model(
            "a.p - b.p", "a.n - b.n", "a.p - c.p", "c.n - b.n",
            a=el.SignalVoltage(), b=el.Resistor(R=1.0), c=el.Conductor(G=1.0),
        ),
        lambda: model(
            "a.p - b.p", "b.n - c.p", "c.n - a.n",
            a=el.ConstantVoltage(V=1.0), b=el.Resistor(R=1.0), c=el.Capacitor(C=1.0),
        ),
    ],
)  # fmt: skip
def test_a_circuit_without_ground_is_refused(without: Any) -> None:
    with pytest.raises(ac.StructureError, match=r"undetermined: '.*v'.*a ground, a reference"):
        ac.compile(without())
