"""Guesses of loops: which loops have them, and what they are called."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal.flattening import flatten
from acausal.structure import Assignment, reduce, with_loop_guesses
from tests.support.parts import Pendulum
from tests.support.planar import Arm, Linkage


def linkage() -> Linkage:
    """Its first joint drives it."""
    found = Linkage([0.3, 1.0, 0.7], [1.0, 0.5, -1.0])
    found.joint[0].modify(
        phi=ac.Start(1.0, state="always"), w=ac.Start(0.0, fixed=True, state="always")
    )
    return found


def test_the_angles_of_a_closed_loop_have_guesses() -> None:
    before = reduce(flatten(linkage()))
    found = with_loop_guesses(before)
    names = [found.name(int(node)) for node in found.states]
    assert names == ["joint[1].phi", "joint[1].w", "body[3].frame.phi", "body[2].frame.phi"]
    assert found.n_independent == len(before.states) == 2
    assert found.steps[:-1] == before.steps
    last = found.steps[-1]
    assert isinstance(last, Assignment)
    np.testing.assert_array_equal(last.unknowns, found.rates[2:])
    assert found.start_guess(found.states).tolist() == pytest.approx([1.0, 0.0, -1.0, 0.5])


@pytest.mark.parametrize("make", [lambda: Arm(2), Pendulum])
def test_other_models_stay_as_they_are(make: type[ac.Component]) -> None:
    reduced = reduce(flatten(make()))
    assert with_loop_guesses(reduced) is reduced


@pytest.mark.slow
def test_a_guess_starts_at_the_solution_and_keeps_off_the_linearization() -> None:
    system = ac.compile(linkage())
    start = {"joint[1].phi": 1.0, "joint[1].w": 0.0}
    x = np.asarray(system.initial_state(x0=start))
    angles = [1.0, x[3], x[2]]
    links = zip([0.3, 1.0, 0.7], angles, strict=True)
    assert abs(sum(n * np.exp(1j * phi) for n, phi in links) - 1.0) < 1e-9
    other = system.initial_state(x0={**start, "body[3].frame.phi": 2.0, "body[2].frame.phi": -1.0})
    assert abs(float(other[2]) - x[2]) > 0.5  # the other assembly
    np.testing.assert_allclose(system.initial_state(x0=x[:2]), x, atol=1e-9)
    assert ac.linearize(system, x=x).states == ("joint[1].phi", "joint[1].w")
