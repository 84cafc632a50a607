"""Circuits, drives and heat models with pulsed, clipped and rectified excitation: right by default."""

import numpy as np
import pytest

from benchmarks.tolerance import STRUCTURES
from tests.support.slow import some_slow


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", some_slow(STRUCTURES, STRUCTURES.keys() - {"dead zone", "rectifier"}, ["rectifier"])
)
def test_default_arguments_are_right(name):
    structure = STRUCTURES[name]
    found = [structure.error(p)[0] for p in structure.models(10)]
    assert len(found) == 10
    assert max(found) < 1e-4, int(np.argmax(found))


@pytest.mark.cases(fast=1, slow=4)
@pytest.mark.slow
@pytest.mark.parametrize("solver", ["auto", "stiff"])
@pytest.mark.parametrize("name", STRUCTURES)
def test_errors_fall_with_the_tolerance(name, solver):
    structure = STRUCTURES[name]
    options = [{"solver": solver, "rtol": r, "atol": 1e-2 * r} for r in (1e-4, 1e-6, 1e-8)]
    errors = [max(structure.error(p, **o)[0] for p in structure.models(3)) for o in options]
    assert errors[1] < 0.5 * errors[0]
    assert errors[2] < 0.5 * errors[1]
