"""The stiff models of the benchmarks are what they are said to be, and are measured."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from benchmarks.stiff.gradients import by_largest_entries, places
from benchmarks.stiff.plate import Plate
from benchmarks.stiff.sections import Ladder
from benchmarks.stiff.stiff_problems import Hires, Pollution, VanDerPol


def rates(problem, y):
    """The derivatives of a problem's states at a point."""
    system = ac.compile(problem())
    x = np.asarray(y, float)
    return np.asarray(system.vector_field(0.0, x, None, system.parameters()))


@pytest.mark.slow
def test_pollution_ends_where_the_book_says() -> None:
    """Its first two concentrations after a minute, from section IV.10."""
    system = ac.compile(Pollution())
    sol = ac.simulate(system, (0, 60), saveat=[60.0], solver="bdf", rtol=1e-8, atol=1e-12)
    assert np.asarray(sol.x[-1, :2]) == pytest.approx([0.05646255480, 0.1342484130], rel=1e-6)


def test_hires_keeps_what_binds() -> None:
    """The bound and the free half of the seventh and eighth species are as many at all times."""
    y = np.arange(1.0, 9.0)
    of = rates(Hires, y)
    assert of[6] + of[7] == pytest.approx(0)


def test_the_plate_warms_as_its_source_heats() -> None:
    system = ac.compile(Plate(4))
    C = np.array([1.0 + i % 7 for i in range(16)])
    assert [300.0 + i % 13 for i in range(16)] == pytest.approx(
        np.asarray(system.initial_state(system.parameters())).tolist()
    )
    T = np.linspace(290, 310, 16)
    flows = np.asarray(system.vector_field(0.0, T, None, system.parameters()))
    assert C @ flows == pytest.approx(50.0)
    assert len(places(system, ".G")) == 24


def test_the_ladder_follows_its_equations() -> None:
    n = 4
    system = ac.compile(Ladder(n))
    v = np.array([0.3, -0.2, 0.7, 0.1])
    R = np.array([10.0 ** ((7919 * i) % 5 - 2) for i in range(n)])
    i = -np.diff(np.append(1.0, v)) / R
    expected = (i - np.append(i[1:], 0.0)) / (1e-3 * (1 + np.arange(n) % 7))
    assert np.asarray(system.vector_field(0.0, v, None, system.parameters())) == pytest.approx(
        expected
    )


def test_differences_find_an_error_of_a_gradient() -> None:

    def value(x):
        return float(x[0] ** 3 * x[1])

    x = jnp.array([1.0, 2.0])
    right, wrong = jnp.array([6.0, 1.0]), jnp.array([6.006, 1.0])
    assert by_largest_entries(value, [right], [x]) < 1e-10
    assert by_largest_entries(value, [wrong], [x]) == pytest.approx(1e-3, rel=1e-3)


@pytest.mark.machines
def test_all_solvers_agree_on_van_der_pol() -> None:
    pytest.importorskip("sksundae")
    from benchmarks.stiff.work_precision import measure

    curves = measure(VanDerPol, (1e-6,))
    assert set(curves) == {"auto", "bdf", "CVODE", "Radau"}
    for points in curves.values():
        assert points[0].error < 1e-3
        assert points[0].rates > 100


@pytest.mark.slow
def test_a_plate_is_measured_beside_cvode() -> None:
    pytest.importorskip("sksundae")
    from benchmarks.stiff.plates import plates

    found = plates((3,))
    assert found["plate_3_difference"] < 1e-4
    assert found["plate_3_cvode_difference"] < 1e-4
    assert found["plate_3_ratio"] > 0
