"""The page of a model and of a simulation: every component tells what it states, did and did with its energy."""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, electrical as el, neural, thermal as th, translational as tl
from acausal.pages import Known, component_cards, parallel_law
from acausal.pages.components import MOST_CARDS
from acausal.pages.energy import integrated, powers
from acausal.pages.own_law import own_law
from acausal.reporting import Card, Plot, Table, Text


class Swing(ac.Component):
    """A mass on a spring and a damper."""

    def __init__(self) -> None:
        super().__init__()
        self.wall, self.mass = tl.Fixed(), tl.Mass(m=2.0, s=ac.Start(1.0, fixed=True))
        self.spring, self.damper = tl.Spring(c=50.0), tl.Damper(d=0.5)
        for part in (self.spring, self.damper):
            self.connect(self.wall.flange, part.flange_a)
            self.connect(part.flange_b, self.mass.flange_a)


class Learned(ac.Component):
    """A mass on a known and a learned damper."""

    def __init__(self, *, reverse: bool = False) -> None:
        super().__init__()
        self.wall, self.mass, self.push = tl.Fixed(), tl.Mass(m=2.0), tl.Force()
        self.known = tl.SpringDamper(c=100.0, d=3.0)
        self.learned = neural.Resistance(passive=True)
        a, b = self.known.flange_a, self.known.flange_b
        self.connect(self.wall.flange, b if reverse else a)
        self.connect(a if reverse else b, self.mass.flange_a)
        self.connect(self.wall.flange, self.learned.flange_a)
        self.connect(self.learned.flange_b, self.mass.flange_a)
        self.connect(self.push.flange, self.mass.flange_b)


@cache
def swung() -> ac.Solution:
    return ac.simulate(ac.compile(Swing()), (0, 5), dt=0.002)


@cache
def cards() -> dict[str, Card]:
    run = swung()
    return {
        c.path: c for c in component_cards(run.system, Known(run.packed, runs={"simulated": run}))
    }


def section(card: Card, title: str) -> tuple:
    return next(s.blocks for s in card.sections if s.title == title)


def energies(path: str) -> dict[str, float]:
    table = section(cards()[path], "Energy")[0]
    assert isinstance(table, Table)
    return {name: float(value) for name, value in table.rows}


# -- cards -------------------------------------------------------------------------------------------------


def test_every_component_has_a_card():
    assert list(cards()) == ["", "wall", "mass", "spring", "damper"]
    spring = cards()["spring"]
    assert (spring.kind, spring.learns) == ("Spring", False)
    assert spring.doc.startswith("Linear spring")
    parameters = section(spring, "Parameters")[0]
    assert parameters.rows[0][:3] == ("c", "50", "N/m")
    (equations,) = section(spring, "Equations")
    assert "f" in {getattr(lhs, "path", "") for lhs, _ in equations.equations}
    drawn = {c.label for b in section(spring, "Trajectories") for c in b.curves}
    assert {"s_rel", "f"} <= drawn
    assert "flange_b.f" not in drawn, "what equals another variable is drawn once"


class Wagon(ac.Component):
    def __init__(self) -> None:
        super().__init__()
        self.body, self.drag = tl.Mass(m=1.0), tl.Damper(d=1.0)
        self.connect(self.body.flange_b, self.drag.flange_a)


class Train(ac.Component):
    def __init__(self) -> None:
        super().__init__()
        self.wagons = [Wagon() for _ in range(150)]
        self.rails = tl.Fixed()
        for wagon in self.wagons:
            self.connect(wagon.drag.flange_b, self.rails.flange)


@pytest.mark.slow
def test_of_many_components_those_that_the_schematic_shows_have_a_card():
    system = ac.compile(Train())
    paths = [card.path for card in component_cards(system, Known(system.pack()))]
    assert len(paths) == MOST_CARDS
    assert {"", "rails", "wagons[1]", "wagons[100]"} <= set(paths)


def test_the_model_shows_its_differential_equations():
    texts = [b.text for b in section(cards()[""], "Equations") if isinstance(b, Text)]
    assert texts == ["The differential equations that follow from the connected components:"]


def test_curves_are_the_solution():
    (plot,) = (b for b in section(cards()["mass"], "Trajectories") if b.ylabel.endswith("[m]"))
    assert isinstance(plot, Plot)
    curve = plot.curves[0]
    expected = np.interp(curve.x, np.asarray(swung().t), np.asarray(swung()["mass.s"]))
    np.testing.assert_allclose(curve.y, expected, atol=1e-12)
    assert len(curve.x) < 1000 < len(swung().t)


# -- energy ------------------------------------------------------------------------------------------------


def test_energy_is_conserved():
    """What springs and masses give is what dampers lose: 25 J at first."""
    taken = {path: energies(path)["taken in"] for path in ("mass", "spring", "damper")}
    assert sum(taken.values()) == pytest.approx(0.0, abs=2e-3)
    run = swung()
    spring = 25.0 * (float(run["spring.s_rel"][-1]) ** 2 - 1.0)
    kinetic = 1.0 * float(run["mass.v"][-1]) ** 2
    assert taken["spring"] == pytest.approx(spring, abs=2e-3)
    assert taken["mass"] == pytest.approx(kinetic, abs=2e-3)
    assert energies("damper")["dissipated"] == pytest.approx(taken["damper"], rel=1e-4)
    assert energies("spring")["stored"] == taken["spring"]
    assert energies("mass")["stored"] == taken["mass"]


class Circuit(ac.Component):
    """A capacitor and an inductor that empty into a resistor, which warms a body."""

    def __init__(self) -> None:
        super().__init__()
        self.c = el.Capacitor(C=1e-2, v=ac.Start(10.0, fixed=True))
        self.r, self.l = el.Resistor(R=5.0, useHeatPort=True, T_ref=293.15), el.Inductor(L=0.1)
        self.ground, self.body = (
            el.Ground(),
            th.HeatCapacitor(C=10.0, T=ac.Start(293.15, fixed=True)),
        )
        self.connect(self.c.p, self.r.p)
        self.connect(self.r.n, self.l.p)
        self.connect(self.l.n, self.c.n, self.ground.p)
        self.connect(self.r.heatPort, self.body.port)


@pytest.mark.slow
def test_electrical_energy_becomes_heat():
    run = ac.simulate(ac.compile(Circuit()), (0, 0.5), dt=1e-4)
    found = {
        c.path: c for c in component_cards(run.system, Known(run.packed, runs={"simulated": run}))
    }

    def value(path: str, name: str) -> float:
        return {n: float(v) for n, v in section(found[path], "Energy")[0].rows}[name]

    stored = 0.5 * 1e-2 * (float(run["c.v"][-1]) ** 2 - 100.0)
    assert value("c", "stored") == pytest.approx(stored, rel=1e-3)
    assert value("body", "taken in") == pytest.approx(
        10.0 * (float(run["body.T"][-1]) - 293.15), rel=1e-3
    )
    assert value("r", "dissipated") == pytest.approx(value("body", "stored"), rel=1e-6)


class Wall(ac.Component):
    """Two bodies that exchange heat."""

    def __init__(self) -> None:
        super().__init__()
        self.warm = th.HeatCapacitor(C=10.0, T=ac.Start(320.0, fixed=True))
        self.cold = th.HeatCapacitor(C=20.0, T=ac.Start(290.0, fixed=True))
        self.wall = th.ThermalConductor(G=5.0)
        self.connect(self.warm.port, self.wall.port_a)
        self.connect(self.wall.port_b, self.cold.port)


def test_a_heat_conductor_passes_heat_on():
    """It neither keeps nor loses any: what matters is what went through."""
    run = ac.simulate(ac.compile(Wall()), (0, 5.0), dt=1e-2)
    cards = component_cards(run.system, Known(run.packed, runs={"simulated": run}))
    (card,) = (c for c in cards if c.path == "wall")
    found = {n: float(v) for n, v in section(card, "Energy")[0].rows}
    through = 20.0 * (float(run["cold.T"][-1]) - 290.0)
    assert through > 50
    assert found == pytest.approx({"in at port_a": through, "in at port_b": -through}, rel=1e-3)


def test_signals_have_no_energy():
    assert powers("a", {}) is None
    assert integrated(np.array([0.0, 1.0, 3.0]), np.array([1.0, 1.0, 2.0])).tolist() == [0, 1, 4]


# -- laws --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("component", "reads"),
    [
        (tl.Spring(c=1.0), {"across"}),
        (tl.Damper(d=1.0), {"rate"}),
        (tl.SpringDamper(c=1.0, d=1.0), {"across", "rate"}),
        (el.Resistor(R=1.0), {"across"}),
        (el.Capacitor(C=1.0), {"derivative"}),
        (th.ThermalConductor(G=1.0), {"across"}),
        (neural.Compliance(), {"across"}),
    ],
)
def test_the_law_of_a_two_port_is_found(component: ac.Component, reads: set[str]):
    law = own_law(component)
    assert law is not None
    assert law.reads == reads


@pytest.mark.parametrize("component", [tl.Mass(m=1.0), tl.Fixed(), blocks.Gain(k=1.0)])
def test_other_components_have_none(component: ac.Component):
    assert own_law(component) is None


@pytest.mark.parametrize("reverse", [False, True])
def test_the_known_part_beside_a_learned_law(reverse: bool):
    system = ac.compile(Learned(reverse=reverse))
    known = parallel_law(system, "learned.net", system.pack())
    assert known is not None
    assert (known.names, known.argument, known.held) == (("known",), "v_rel", "s_rel")
    np.testing.assert_allclose(known.value(np.array([-1.0, 0.5])), [-3.0, 1.5])


def test_the_known_part_of_a_spring_is_that_at_rest():
    class Sprung(Learned):
        def __init__(self) -> None:
            super().__init__()
            self.spring = neural.Compliance()
            self.connect(self.wall.flange, self.spring.flange_a)
            self.connect(self.spring.flange_b, self.mass.flange_a)

    system = ac.compile(Sprung())
    known = parallel_law(system, "spring.net", system.pack())
    assert known is not None
    assert (known.names, known.argument, known.held) == (("known",), "s_rel", "v_rel")
    np.testing.assert_allclose(known.value(np.array([0.1])), [10.0])


def test_promises_are_told():
    system = ac.compile(Learned())
    card = next(c for c in component_cards(system, Known(system.pack())) if c.path == "learned")
    assert card.learns
    assert section(card, "What the network promises")[0].rows[0][:2] == ("passive", "yes")


# -- the page ----------------------------------------------------------------------------------------------


def test_a_model_a_system_and_a_solution_have_pages(tmp_path: Path):
    for subject in (Swing(), swung().system, swung()):
        file = ac.page(subject, tmp_path / "out")
        assert file == tmp_path / "out" / "index.html"
        text = file.read_text(encoding="utf-8")
        assert text.count('<article class="card"') == 5
        assert "<math" in text
        assert ("Trajectories</button>" in text) == isinstance(subject, ac.Solution)
    named = ac.page(Swing(), tmp_path / "one.html", "A <swing>")
    assert named == tmp_path / "one.html"
    assert "<h1>A &lt;swing&gt;</h1>" in named.read_text(encoding="utf-8")


def test_the_schematic_is_there_where_it_can_be_drawn(tmp_path: Path):
    pytest.importorskip("graphlay")
    text = ac.page(Swing(), tmp_path).read_text(encoding="utf-8")
    assert text.index("<svg") < text.index('data-component="spring"')


def test_a_page_is_the_same_again(tmp_path: Path):
    first, second = (ac.page(swung(), tmp_path / n).read_text(encoding="utf-8") for n in "ab")
    assert first == second


def test_numbers_of_a_page_are_json(tmp_path: Path):
    text = ac.page(swung(), tmp_path).read_text(encoding="utf-8")
    found = re.search(r'<script type="application/json" id="data">(.*?)</script>', text)
    assert found is not None
    told = json.loads(found[1])
    assert set(told) == {"arrays", "plots", "motions", "first"}


@pytest.mark.parametrize(
    ("subject", "path", "sentence"),
    [
        (3, "out", r"^page: 3 has no page; give a model, a Solution or a Fit, such as ac\.page\(fit, 'out'\)\.$"),
        (Swing, "out", r"^page: <class .*Swing'> has no page"),
        (Swing(), 3, "page"),
        (Swing(), "/proc/none/x.html", r"^'/proc/none/x\.html' cannot be written: "),
    ],
)  # fmt: skip
def test_mistakes_get_one_sentence(subject: object, path: object, sentence: str, tmp_path: Path):
    with pytest.raises(ac.DataError, match=sentence):
        ac.page(subject, path)  # type: ignore[arg-type]
