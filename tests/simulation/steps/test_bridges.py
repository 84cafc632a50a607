"""A bridge of ideal diodes at rest: the numbers of all conditions are zero, and their rates say what they become."""

from __future__ import annotations

from typing import Any

import diffrax
import jax
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


@pytest.mark.slow
@pytest.mark.parametrize("steps", STEPS)
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


@pytest.mark.parametrize("mode", some_slow(["reverse", "forward"], ["reverse"], ["forward"]))
def test_a_bridge_that_begins_to_conduct_has_a_gradient(system: ac.System, mode: str) -> None:
    def current(change: Any, **options: Any) -> Any:
        params = {f"l{k}.L": 1e-4 * (1 + change) for k in (1, 2, 3)}
        run = ac.simulate(
            system, 2e-3, params=params, saveat=[2e-3], rtol=1e-10, atol=1e-11, **options
        )
        return run["choke.i"][-1]

    options: dict[str, Any] = {"solver": "stiff"}
    difference = (current(1e-4, **options) - current(-1e-4, **options)) / 2e-4
    if mode == "reverse":
        gradient = jax.grad(lambda c: current(c, **options))(0.0)
    else:
        options["adjoint"] = diffrax.ForwardMode()
        gradient = jax.jvp(lambda c: current(c, **options), (0.0,), (1.0,))[1]
    assert gradient == pytest.approx(difference, rel=1e-6)
