"""The battery pack: its rows share their currents, keep charge and energy, and their loops stay small."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from examples.battery_pack import figures
from examples.battery_pack.cycle import HOUR, current, speed
from examples.battery_pack.model import CURRENT, LAW
from examples.battery_pack.study import Study, drive, places, warmth

ROWS, CELLS = 2, 3


@pytest.fixture(scope="module")
def driven():
    return drive(ROWS, CELLS, seconds=120.0)


@pytest.fixture(scope="module")
def sol(driven):
    return driven.simulate()


def test_the_cycle_lasts_an_hour_and_ends_at_rest() -> None:
    t, v = speed()
    assert t[-1] == HOUR
    assert v[-1] == 0
    assert (v >= 0).all()
    assert 3.6 * v.max() == pytest.approx(120)
    assert float(np.trapezoid(v, t)) / 1e3 == pytest.approx(60, abs=2)
    assert np.isfinite(np.asarray(current(365.0).values)).all()


def test_a_row_is_a_loop_of_one_unknown(driven) -> None:
    torn = [len(i.tears) for i in driven.system.program.instructions if hasattr(i, "tears")]
    assert torn == [1]


def test_all_cells_share_one_network(driven) -> None:
    networks = [n for n in driven.system.parameters() if n.endswith("resistance.net")]
    assert networks == [LAW]


@pytest.mark.slow
def test_currents_of_a_row_add_up_to_that_of_the_pack(driven, sol) -> None:
    whole = jax.vmap(driven.inputs[CURRENT])(jnp.asarray(driven.t))
    for row in range(1, ROWS + 1):
        cells = [sol[f"rows[{row}].cells[{k}].resistance.i"] for k in range(1, CELLS + 1)]
        assert np.allclose(np.sum(cells, axis=0), whole, atol=1e-9)


def test_charge_is_kept(driven, sol) -> None:
    """What flows into a row is what its cells hold more."""
    t = np.linspace(0, driven.t[-1], 1201)
    flown = np.trapezoid(np.asarray(jax.vmap(driven.inputs[CURRENT])(jnp.asarray(t))), t)
    capacity = driven.system.parameters()
    at = places(driven, "charge.soc")[:CELLS]
    held = sum(
        capacity[f"rows[1].cells[{k}].charge.Q"] * float(sol.x[-1, i] - sol.x[0, i])
        for k, i in enumerate(at, 1)
    )
    assert held == pytest.approx(flown, rel=1e-4)


def test_the_voltage_is_the_sum_of_the_rows(sol) -> None:
    rows = [np.asarray(sol[f"rows[{k}].link.v1"]) for k in range(1, ROWS + 1)]
    assert np.allclose(np.asarray(sol["voltmeter.v"]), np.sum(rows, axis=0))


@pytest.mark.slow
def test_the_gradient_by_the_weights_is_that_of_differences(driven) -> None:
    law = driven.system.parameters()[LAW]
    value = jax.jit(lambda law: warmth(driven, law, solver="tsit5"))
    slope = jax.jit(jax.grad(value))(law)
    size = jnp.sqrt(sum(jnp.sum(a**2) for a in jax.tree.leaves(slope)))
    h = 1e-2

    def moved(by: float) -> float:
        return float(value(jax.tree.map(lambda a, s: a + by * s / size, law, slope)))

    assert (moved(h) - moved(-h)) / (2 * h) == pytest.approx(float(size), rel=1e-4)


def test_the_picture_is_drawn(driven, sol) -> None:
    figure = figures.picture(Study(driven, sol, None, {}))
    assert len(figure.axes) == 5
