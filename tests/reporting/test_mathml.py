"""Equations are MathML and LaTeX with names as an engineer writes them."""

from typing import Any
from xml.etree import ElementTree

import pytest
import sympy as sp

import acausal as ac
from acausal.reporting import Short, shorten
from acausal.reporting.mathml import latex, mathml, named, names_in
from acausal.reporting.short_names import with_owners


def written(lhs: Any, rhs: Any) -> str:
    """As a page writes it."""
    return mathml(lhs, rhs, with_owners(names_in([(lhs, rhs)])))


def test_an_equation_as_mathml_and_latex() -> None:
    s, v, m, t = sp.symbols("body.s damper.v_rel body.m time")
    force = sp.Function("damper.net'")(v)
    equation = sp.Eq(sp.Derivative(s, t), -force / m, evaluate=False)
    naming = named(shorten(["body.s", "damper.v_rel", "body.m", "wheel.m", "damper.net'"]))
    text = mathml(equation.lhs, equation.rhs, naming)
    assert '<mover><mi>s</mi><mtext mathsize="70%">•</mtext></mover>' in text
    assert "<msub><mi>v</mi><mtext>rel</mtext></msub>" in text
    assert "<msub><mi>m</mi><mtext>body</mtext></msub>" in text
    assert "<msup><mi>net</mi><mo>′</mo></msup>" in text
    assert "<mo>-</mo>" not in text
    assert "−" in text
    assert latex(equation.lhs, naming) == r"\dot{s}"
    assert latex(equation.rhs, naming).count(r"v_{\mathrm{rel}}") == 1
    assert Short.of("T_amb").latex == r"T_{\mathrm{amb}}"


class Named(ac.Component):
    omega_0, s_rel = ac.Variable(), ac.Variable()
    net = ac.Module(lambda key: ac.tanh)


def test_names_have_indices_dots_and_greek_letters() -> None:
    part = Named()
    text = written(ac.der(part.omega_0), 2.5 * part.net(part.s_rel) - ac.sqrt(part.s_rel))
    assert '<mover><mi>ω</mi><mtext mathsize="70%">•</mtext></mover><mtext>0</mtext>' in text
    assert "<msub><mi>s</mi><mtext>rel</mtext></msub>" in text
    assert "<mi>net</mi>" in text
    assert "2.5" in text


def test_symbols_of_a_system_show_whose_they_are() -> None:
    t = sp.Symbol("time")
    text = written(
        sp.Derivative(sp.Symbol("body.v"), t), sp.Function("damper.net")(sp.Symbol("a.b.c_d"))
    )
    assert "<mtext>body</mtext>" in text
    assert "<mtext>d, a.b</mtext>" in text
    assert written(ac.der(t * sp.Symbol("x")), sp.S.Zero).count("<mi>der</mi>") == 1


def test_names_that_would_look_alike_are_spelled_out() -> None:
    text = written(sp.Symbol("T_heatPort"), sp.Symbol("heatPort.T") + sp.Symbol("port.T"))
    assert "<mi>heatPort.T</mi>" in text
    assert text.count("<mtext>") == 2


@pytest.mark.parametrize("name", ["a<b", "x&y", "_", "a_", "lambda", "Omega"])
def test_any_name_can_be_written(name: str) -> None:
    text = written(sp.Symbol(name), sp.Symbol(name))
    assert "<b" not in text
    ElementTree.fromstring(text)
