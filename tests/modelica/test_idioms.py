"""What public libraries write: names, sizes, redeclarations, buses."""

from pathlib import Path

import numpy as np
import pytest

import acausal as ac

FILE = Path(__file__).with_name("Idioms.mo")
MOVES = {
    # -load + turned + gain*2*turned
    "direct.machine.x[1]": -1 - 1 - 10 * 2,
    "rotating.machine.x[1]": -1 - 1 - 20 * 2,
    "rotating.machine.x[2]": -1 + 1 + 20 * 2,
    "piping.pipe.x": 3 + 2 + 2010,
    "piping.weighted.sum": 3 + 4,
    "controlled.mass.m.s": 1,
    "controlled.mass.m.v": (-3 - 5) / 2,
    "controlled.sum[1].y": 1,
    "controlled.sum[2].y": 1,
    "free.x[1]": 1,
    "free.x[2]": -4,
    "population.g.species.population": 4 - 0.5 - 1,
    "tank.c[1]": 1,
    "tank.c[2]": 2,
    "fast.law.x": -5,
    "redeclared.law.x": -2,
}
"""State -> its derivative where every state is 1."""


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(ac.load(FILE, "Idioms.All"))


def test_states_move_as_their_equations_say(system: ac.System) -> None:
    ones = np.ones(len(system.states))
    found = system.vector_field(0.0, ones, None, system.parameters())
    moves = dict(zip(system.states, map(float, found), strict=True))
    assert moves == pytest.approx(MOVES)


def test_names_are_those_of_the_text(system: ac.System) -> None:
    assert {"population.'1st'.replace", "population.g.document"} <= set(system.parameters())
