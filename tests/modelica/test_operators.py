"""Records with operators: in equations, in connectors, and in connections that close a loop."""

from pathlib import Path

import numpy as np
import pytest

import acausal as ac

FILE = Path(__file__).with_name("Phasors.mo")


@pytest.fixture(scope="module")
def run() -> ac.Solution:
    return ac.simulate(ac.compile(ac.load(FILE, "Phasors.Circuit")), 1, dt=0.5)


def phasor(run: ac.Solution, name: str) -> complex:
    return complex(run[f"{name}.re"][0], run[f"{name}.im"][0])


def test_a_circuit_of_phasors_has_the_currents_of_complex_numbers(run: ac.Solution) -> None:
    a, b = 10 / (3 + 4j), 10 / 5
    assert phasor(run, "a.i") == pytest.approx(a)
    assert phasor(run, "source.i") == pytest.approx(-a - b)
    assert phasor(run, "whole") == pytest.approx(a + b)
    assert phasor(run, "power") == pytest.approx(a.conjugate() * 10 + b * 10)
    # one angle is left, in the source, and moves as it says
    np.testing.assert_allclose(run["b.n.angle.phi"], [0, 1, 2], atol=1e-9)


def test_signals_of_records_and_functions_of_arrays(run: ac.Solution) -> None:
    assert phasor(run, "sink.s[1]") == -phasor(run, "c.i") == -1
    assert phasor(run, "twice[2].y") == pytest.approx(4 * (3 + 4j))
    assert run["twice[1].y.im"][-1] == pytest.approx(-8)
    assert [run[f"squares[{k}]"][0] for k in (1, 2)] == pytest.approx([100, 400])


def test_unlike_units_of_modelica_text_are_a_warning(tmp_path: Path) -> None:
    file = tmp_path / "Unlike.mo"
    file.write_text(
        'model Unlike Real x(unit="m", start=1, fixed=true); parameter Real k(unit="A")=2; '
        "equation x + k = 3*cos(time); end Unlike;"
    )
    with pytest.warns(UserWarning, match="'k' is in A"):
        ac.compile(ac.load(file))
