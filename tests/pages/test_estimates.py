"""Estimates tell how sure they are: on a page, in a notebook and as text."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal.pages.page import model_content
from acausal.reporting import Plot, Table
from tests.analysis.test_estimate import GIVEN, record
from tests.support.oscillator import plain

DRIFTS = {"parameters": {"spring.c": 5.0}, "noise": {"mass.v": 0.3, "spring.c": 0.5}}


@pytest.fixture(scope="module")
def found():
    """Two states and a parameter, from two sensors with gaps."""
    return ac.estimate(plain(), record(), **(GIVEN | DRIFTS))


def test_a_page_has_sensors_and_bands(found, tmp_path):
    content = model_content(found)
    sensors, trajectories = content.tabs
    table, _ = sensors.sections[0].blocks
    assert isinstance(table, Table)
    assert [row[0] for row in table.rows] == ["mass.s", "mass.a"]
    innovation, expected = sensors.sections[1].blocks[0].curves
    seen = found.innovations["mass.s"]
    np.testing.assert_array_equal(innovation.y[np.isfinite(innovation.y)], seen[np.isfinite(seen)])
    np.testing.assert_allclose(
        expected.sigma**2, found.innovation_covariance[np.isfinite(seen), 0, 0], rtol=1e-12
    )
    assert [s.title for s in trajectories.sections] == ["States", "Estimated parameters", "Inputs"]
    plot = trajectories.sections[1].blocks[0]
    assert isinstance(plot, Plot)
    np.testing.assert_array_equal(plot.curves[0].y, found["spring.c"])
    np.testing.assert_allclose(plot.curves[0].sigma, found.deviation("spring.c"))
    assert ac.page(found.smooth(), tmp_path / "page.html").stat().st_size > 10_000


def test_a_notebook_and_print_say_how_consistent_the_filter_is(found):
    assert "89 innovations, squared over their variances 0.639" in repr(found)
    view = found._repr_html_()
    for part in ("Estimation of Oscillator", "0.728 to 1.31", "spring.c", "band"):
        assert part in view


def test_estimates_that_jax_returns_have_no_bands(found):
    import jax

    bare = jax.tree.unflatten(jax.tree.structure(found), jax.tree.leaves(found))
    assert bare.deviations(plain().states) == {}
    assert "Estimation of Oscillator" in bare._repr_html_()
