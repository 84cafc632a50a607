"""A bridge of ideal diodes at rest: the numbers of all conditions are zero, and their rates say what they become."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from tests.support.bridges import bridge
from tests.support.slow import some_slow

END = 0.016

STEPS: dict[str, dict[str, Any]] = {
    "adaptive": {},
    "stiff": {"solver": "stiff"},
    "fixed": {"dt": 1e-4, "solver": "kvaerno3"},
}


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(bridge())


@pytest.mark.parametrize("steps", some_slow(STEPS, ["stiff"], STEPS.keys() - {"stiff"}))
def test_a_bridge_begins_to_conduct(system: ac.System, steps: str) -> None:
    run = ac.simulate(system, END, saveat=np.linspace(0, END, 161), **STEPS[steps])
    i, v = (np.stack([run[f"d{k}.{n}"] for k in range(1, 7)]) for n in "iv")
    assert i.max() > 10
    assert v.min() < -100
    assert i.min() > -2e-5 * 200  # through Goff
    assert v.max() < 2e-5 * i.max()  # at Ron
    mean = np.mean(run["choke.i"][60:160])  # three periods of the ripple
    commutation = 3 / np.pi * 2 * np.pi * 50 * 1e-4
    assert mean == pytest.approx(3 * np.sqrt(3) / np.pi * 100 / (10 + commutation), rel=2e-3)
