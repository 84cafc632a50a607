"""What models and results show in a notebook: HTML that explains, costs little and fits light and dark pages."""

import re
import warnings
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.components import electrical as el, neural, translational as tl


class Oscillator(ac.Component):
    def __init__(self, damper: ac.Component) -> None:
        super().__init__()
        self.wall, self.spring, self.damper = tl.Fixed(), tl.Spring(c=50.0), damper
        self.mass, self.push = tl.Mass(m=1.0, s=ac.Start(0.25, fixed=True)), tl.Force()
        self.connect(self.wall.flange, self.spring.flange_a, self.damper.flange_a)
        self.connect(self.spring.flange_b, self.damper.flange_b, self.mass.flange_a)
        self.connect(self.mass.flange_b, self.push.flange)


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(Oscillator(neural.Resistance()))


@pytest.fixture(scope="module")
def data() -> ac.Data:
    t = np.linspace(0, 2, 101)
    signals = {"push.f": np.sin(3 * t), "mass.a": np.cos(3 * t), "mass.s": 0 * t, "mass.v": 0 * t}
    return ac.Data(t, signals)


@pytest.fixture(scope="module")
def fit(system: ac.System, data: ac.Data) -> ac.Fit:
    options: dict[str, Any] = {"sequence_length": 0.5, "batch_size": 4, "progress": False}
    with warnings.catch_warnings():  # the record is not of this model
        warnings.filterwarnings("ignore", "The trained model is no better")
        return ac.fit(system, data, ["mass.a"], epochs=3, modifiers=["spring.c"], **options)


def balanced(text: str) -> bool:
    text = re.sub(r"<!.*?>", "", text, flags=re.DOTALL)
    opened = re.findall(r"<\w[^>]*?(?<!/)>", text)
    return len(opened) == len(re.findall(r"</[\w:]+>", text))


def test_a_component_shows_picture_parameters_connectors_and_parts() -> None:
    model = Oscillator(tl.Damper(d=2.0))
    assert balanced(text := model._repr_html_())
    for piece in ("<svg", "Parts (5)", "Damper"):
        assert piece in text
    assert balanced(text := model.damper._repr_html_())
    for piece in ("<svg", ">2.0<", "N.s/m", "Connectors (2)"):
        assert piece in text


def test_equations_show_as_formulas(system: ac.System) -> None:
    assert str(system.equations).startswith("der(mass.s) = mass.v\nder(mass.v) = ")
    assert balanced(text := system.equations._repr_html_())
    assert text.count("<math") == 2


def test_the_times_of_a_fit_add_up(fit: ac.Fit) -> None:
    line = next(line for line in str(fit).splitlines() if line.startswith("  time"))
    total, *parts = (float(n) for n in re.findall(r"([\d.e-]+) s\b", line))
    assert len(parts) == 4
    assert sum(parts) == pytest.approx(total, rel=0.02)


def test_a_system_shows_equations_diagram_and_tables(system: ac.System) -> None:
    text = system._repr_html_()
    assert balanced(text)
    for piece in ("Equations (2)", "Diagram", "States (2)", "Inputs (1)", "Parameters (2)", "<svg"):
        assert piece in text
    assert "<mi>c</mi>" in text
    assert "position of the centre" in text
    assert ">0.25<" in text
    assert "damper.net" in text


def test_a_system_writes_short_names_as_latex(system: ac.System) -> None:
    text = system._repr_latex_()
    assert text is not None
    assert r"\dot{s} &= v" in text
    assert r"\mathrm{net}\left(v\right)" in text


def test_a_large_system_is_shown_without_equations() -> None:
    class Chain(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.masses = [tl.Mass(m=1.0) for _ in range(70)]
            self.springs = [tl.Spring(c=1.0) for _ in range(69)]
            for a, spring, b in zip(self.masses, self.springs, self.masses[1:], strict=False):
                self.connect(a.flange_b, spring.flange_a)
                self.connect(spring.flange_b, b.flange_a)

    system = ac.compile(Chain())
    text = system._repr_html_()
    assert "Equations" not in text
    assert "... and 110 more" in text
    assert len(text) < 40_000
    assert system._repr_latex_() is None


def test_a_solution_shows_what_was_simulated(system: ac.System) -> None:
    run = ac.simulate(system, (0, 1), dt=0.01, inputs={"push.f": 1.0})
    text = run._repr_html_()
    assert balanced(text)
    assert "101 points from 0 to 1 s" in text
    assert "at the end" in text
    assert text.count("<svg") == 3


@pytest.mark.slow
def test_a_solution_with_events_shows_both_sides() -> None:
    class Relay(ac.Component):
        x = ac.Variable(start=1.0, fixed=True)
        n = ac.Discrete()

        def equations(self) -> Any:
            yield ac.Eq(ac.der(self.x), -1.0)
            yield ac.When(self.x < 0.5, ac.Eq(self.n, ac.pre(self.n) + 1))

    text = ac.simulate(ac.compile(Relay()), (0, 1))._repr_html_()
    assert "1 events" in text or "1 event" in text
    assert ">n<" in text


def test_a_model_without_states_has_a_view() -> None:
    class Divider(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.source, self.ground = el.ConstantVoltage(V=10.0), el.Ground()
            self.r, self.s = el.Resistor(R=1.0), el.Resistor(R=3.0)
            self.connect(self.source.p, self.r.p)
            self.connect(self.r.n, self.s.p)
            self.connect(self.s.n, self.source.n, self.ground.p)

    system = ac.compile(Divider())
    assert "States" not in system._repr_html_()
    assert "<svg" in ac.simulate(system, (0, 1), dt=0.5)._repr_html_()


def test_data_show_every_signal_and_what_is_missing(data: ac.Data) -> None:
    text = data._repr_html_()
    assert balanced(text)
    assert "101 samples every 0.02 s, from 0 to 2 s" in text
    assert text.count("<svg") == 4
    late = ac.Data(None, {"a": ([0, 1, 2], [1, 2, 3]), "b": ([0.5, 1.5], [1, 2])})
    assert "3 of 5" in late._repr_html_()


@pytest.mark.slow
def test_a_fit_and_its_confidence_show_what_was_learned(fit: ac.Fit) -> None:
    text = fit._repr_html_()
    assert balanced(text)
    for piece in ("Fit of damper.net, spring.c", "loss over the record", "N/m", "simulated"):
        assert piece in text
    sure = fit.confidence()._repr_html_()
    assert balanced(sure)
    assert "fill-opacity" in sure  # the band of the law
    assert "spring.c" in sure
