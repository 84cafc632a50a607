"""Compiled programs: one for each model and shape, of which the last ones are kept."""

from __future__ import annotations

import gc
import subprocess
import sys
import weakref
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal._jax import compile_ahead, compiled
from tests.support.counted import compilations
from tests.support.parts import Equations
from tests.support.paths import ROOT


def test_one_program_serves_equal_shapes_and_constants() -> None:
    traced: list[Any] = []

    @compiled
    def scaled(x: Any, by: dict[str, Any], n: object = 1) -> Any:
        traced.append(n)
        return x * by["a"] * n

    x = jnp.arange(3.0)
    for n in (2, 2, 2.0, True, 2):
        np.testing.assert_allclose(scaled(x, {"a": 3.0}, n=n), x * 3 * n)
    assert len(traced) == 3  # 2, 2.0 and True are equal, but not the same
    scaled(x[:2], {"a": 3.0}, n=2)
    scaled(x, {"a": jnp.asarray(3.0)}, n=2)
    scaled(x, {"a": np.float64(4.0)}, n=2)
    assert len(traced) == 6
    grown = jax.grad(lambda x: scaled(x, {"a": 3.0}, n=2).sum())(x)
    np.testing.assert_allclose(grown, 6.0)


def test_a_program_that_is_compiled_ahead_is_compiled_once() -> None:
    @compiled
    def scaled(x: Any, by: float) -> Any:
        return x * by + x[0]

    x = jnp.arange(3.0)
    with compilations() as names:
        compile_ahead(scaled, jnp.zeros(3), 2.0)
        compile_ahead(scaled, x, 2.0)
        np.testing.assert_allclose(scaled(x, 2.0), x * 2)
        compile_ahead(scaled, x, 2.0)
    assert names.count("jit(scaled)") == 1


@pytest.mark.slow
def test_the_steps_of_a_model_with_events_are_compiled_once_while_its_start_is_found() -> None:
    class Falls(ac.Component):
        h = ac.Variable(start=1.0, fixed=True)

        def equations(self) -> Any:
            yield ac.Eq(ac.der(self.h), -1.0)
            yield ac.When(self.h < 0.5, ac.Reinit(self.h, 2.0))

    system = ac.compile(Falls())
    with compilations() as names:
        sol = ac.simulate(system, (0, 1))
    assert names.count("jit(_run)") == 1
    np.testing.assert_allclose(sol["h"][-1], 1.5, rtol=1e-9)


def test_models_that_are_gone_leave_nothing_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("acausal._jax.programs.MOST", 2)
    first = None
    for i in range(4):
        system = ac.compile(Equations("x", lambda s, i=i: [ac.Eq(ac.der(s.x), -(i + 1.0) * s.x)]))
        last = ac.simulate(system, 1.0, dt=0.5, solver="euler", x0={"x": 1.0})["x"][-1]
        assert float(last) == pytest.approx((1 - (i + 1) / 2) ** 2)
        first = first or weakref.ref(system)
    del system, last
    gc.collect()
    assert first is not None
    assert first() is None


CYCLES = """
import gc, resource, sys
import numpy as np
import acausal as ac
from acausal._jax import programs
from tests.support.parts import Equations

programs.MOST = 8
for i in range(100):
    system = ac.compile(Equations("x", lambda s: [ac.Eq(ac.der(s.x), -s.x)]))
    np.asarray(ac.simulate(system, (0, (i + 3) * 0.01), dt=0.01, solver="rk4", x0={"x": 1.0})["x"])
    if i in (29, 99):
        gc.collect()
        print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**(20 if sys.platform == "darwin" else 10))
"""


@pytest.mark.slow
def test_a_process_that_compiles_and_simulates_all_day_does_not_fill_the_memory() -> None:
    """Each model and each length of runs is a program of 2 MB; of one that is not kept a tenth remains."""
    pytest.importorskip("resource")
    run = subprocess.run(
        [sys.executable, "-c", CYCLES], cwd=ROOT, capture_output=True, text=True, check=True
    )
    before, after = map(float, run.stdout.split())
    assert (after - before) / 70 < 0.5, "MB for each cycle"
