"""What diffrax gives its root finders; and what happens when it gives something else."""

from __future__ import annotations

from typing import Any

import diffrax as dfx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.simulation import solvers, stages
from acausal.simulation.stage_arguments import Stage, stage_of
from tests.support.oscillator import plain

RATE, STEP = 3.0, 0.1


class Expensive(dfx.ODETerm[Any]):
    """A term for which diffrax solves for a derivative times the step."""

    def is_vf_expensive(self, t0: Any, t1: Any, y: Any, args: Any) -> bool:
        return True


def decay(t: Any, x: Any, args: Any) -> Any:
    return -RATE * x


CASES = {
    "implicit Euler": ("implicit_euler", dfx.ODETerm, -RATE * STEP),
    "derivative": ("kvaerno3", dfx.ODETerm, -RATE),
    "derivative times step": ("kvaerno5", Expensive, -RATE * STEP),
}


@pytest.mark.parametrize("case", CASES)
def test_the_state_of_a_stage_is_read_from_the_arguments(
    case: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of ``x' = -3 x`` the solved unknown of a stage is a known multiple of its state."""
    name, term, factor = CASES[case]
    seen: list[tuple[np.ndarray, np.ndarray]] = []

    def noted(unknown: Any, args: Any) -> Stage:
        stage = stage_of(unknown, args)
        jax.debug.callback(lambda u, s: seen.append((u, s)), unknown, stage.state)
        return stage

    monkeypatch.setattr(stages, "stage_of", noted)
    solver: Any = solvers.for_fixed_steps(solvers.solver_named(name))
    x0, start, end = jnp.ones(2), jnp.asarray(0.0), jnp.asarray(STEP)
    memory = solver.init(term(decay), start, end, x0, None)
    solver.step(term(decay), start, end, x0, None, memory, False)
    jax.effects_barrier()
    assert seen
    np.testing.assert_allclose(seen[-1][0], factor * seen[-1][1], rtol=1e-6)


@pytest.mark.parametrize(
    "args",
    [
        None,
        (),
        (1, 2, 3),
        (0, 0.5, None, "no function", 0.0, jnp.ones(2), None, 0.1),
        (0, 0.5, None, lambda y, h: y, 0.0, "no state", None, 0.1),
        (lambda y, h: y, 0.0, jnp.ones(3), None, 0.1),
    ],
    ids=["none", "empty", "short", "no product", "no state", "another shape"],
)
def test_unknown_arguments_leave_the_unknown_itself(args: Any) -> None:
    stage = stage_of(jnp.asarray([2.0, 3.0]), args)
    np.testing.assert_array_equal(stage.state, [2.0, 3.0])
    np.testing.assert_array_equal(stage.per_unit, [1.0, 1.0])


@pytest.mark.slow
@pytest.mark.parametrize(
    "how",
    [
        {"solver": "kvaerno5", "rtol": 1e-8, "atol": 1e-10},
        {"solver": "kvaerno3", "dt": 1e-3},
        {"solver": "implicit_euler", "dt": 1e-5},
    ],
    ids=["adaptive", "fixed", "Euler"],
)
def test_simulations_go_on_when_diffrax_changes(
    how: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stages, "stage_of", lambda y, args: stage_of(y, (args, "of another form")))
    jax.clear_caches()
    found = ac.simulate(plain(), (0, 0.3), saveat=[0.3], inputs={"push.f": 3.0}, **how)
    expected = ac.simulate(plain(), (0, 0.3), dt=1e-3, solver="dopri8", inputs={"push.f": 3.0})
    np.testing.assert_allclose(found.x[-1], expected.x[-1], rtol=1e-4)
    jax.clear_caches()
