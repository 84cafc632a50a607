"""`sweep`: many variants at once are the same as one after the other."""

import sys
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest

import acausal as ac
from acausal.simulation import Solution
from tests.support.oscillator import plain

PUSH = "push.f"
STIFFNESS = [40.0, 50.0, 60.0, 80.0]
FORCES = [5.0, 10.0]


@pytest.fixture(scope="module")
def swept() -> ac.Sweep:
    over = {"spring.c": STIFFNESS, PUSH: FORCES}
    return ac.sweep(plain(), over, 1.0, dt=0.02)


def alone(c: float, force: float, **options: Any) -> Solution:
    params = {**plain().parameters(), "spring.c": c}
    return ac.simulate(plain(), 1.0, dt=0.02, inputs={PUSH: force}, params=params, **options)


def test_a_grid_has_an_axis_for_each_value(swept: ac.Sweep) -> None:
    assert swept.dims == ("spring.c", PUSH, "time")
    assert swept.shape == swept["spring.f"].shape == (4, 2, 51)
    assert swept[["mass.s", "mass.v"]].shape == (4, 2, 51, 2)
    assert swept.t.shape == (51,)
    for i, c in enumerate(STIFFNESS):
        for j, force in enumerate(FORCES):
            one = alone(c, force)
            np.testing.assert_allclose(swept["spring.f"][i, j], one["spring.f"], rtol=1e-12)
            np.testing.assert_allclose(swept["mass.s"][i, j], one["mass.s"], rtol=1e-12)


def test_it_says_what_it_is(swept: ac.Sweep) -> None:
    assert repr(swept).startswith("Sweep(spring.c: 4, push.f: 2, time: 51; ")
    assert swept.unit("spring.f") == "N"
    assert "mass.s" in swept
    assert "mass.s" in swept._ipython_key_completions_()


@pytest.mark.slow
def test_variants_are_selected_by_value(swept: ac.Sweep) -> None:
    one = swept.sel({"spring.c": 61.0, PUSH: 10.0})
    assert isinstance(one, Solution)
    np.testing.assert_allclose(one["spring.f"], alone(60.0, 10.0)["spring.f"], rtol=1e-12)
    some = swept.sel({"spring.c": 50.0})
    assert isinstance(some, ac.Sweep)
    assert some.dims == (PUSH, "time")
    np.testing.assert_array_equal(some["mass.s"], swept["mass.s"][1])
    last = swept.isel({PUSH: -1})
    assert isinstance(last, ac.Sweep)
    np.testing.assert_array_equal(last["mass.s"], swept["mass.s"][:, -1])


@pytest.mark.slow
def test_values_can_vary_together() -> None:
    over = {"spring.c": [40.0, 60.0, 80.0], "mass.s": [0.1, 0.2, 0.3]}
    found = ac.sweep(plain(), over, 1.0, dt=0.02, grid=False, inputs={PUSH: 5.0})
    assert found.dims == ("variant", "time")
    assert found.shape == (3, 51)
    expected = alone(60.0, 5.0, x0={"mass.s": 0.2})
    np.testing.assert_allclose(found["mass.v"][1], expected["mass.v"], rtol=1e-12)
    one = found.sel({"spring.c": 61.0})
    assert isinstance(one, Solution)
    np.testing.assert_allclose(one["mass.v"], expected["mass.v"], rtol=1e-12)


def test_a_dataset_has_coordinates_with_units(swept: ac.Sweep) -> None:
    pytest.importorskip("xarray")
    dataset = swept.to_xarray(["spring.f", "mass.?"])
    assert dict(dataset.sizes) == {"spring.c": 4, PUSH: 2, "time": 51}
    assert dataset["spring.c"].attrs == {"units": "N/m"}
    assert dataset["spring.f"].attrs == {"units": "N"}
    found = dataset["spring.f"].sel({"spring.c": 60.0, PUSH: 10.0})
    np.testing.assert_array_equal(found.values, swept["spring.f"][2, 1])
    assert list(swept.to_xarray().data_vars) == ["mass.s", "mass.v"]


def test_a_plot_has_a_line_for_each_variant(swept: ac.Sweep) -> None:
    try:
        ax, bar = swept.plot("mass.s").axes
        assert len(ax.lines) == 8
        assert ax.get_ylabel() == "mass.s in m"
        assert bar.get_ylabel() == "spring.c in N/m"
    finally:
        plt.close("all")


def test_without_xarray_the_message_names_the_extra(
    swept: ac.Sweep, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(ac.DataError, match=r"pip install 'acausal\[xarray\]'"):
        swept.to_xarray()


def test_variants_that_break_down_are_named() -> None:
    with pytest.warns(UserWarning, match=r"1 of 2 variants did not reach .* spring\.c = 1e\+09:"):
        found = ac.sweep(plain(), {"spring.c": [50.0, 1e9]}, 1.0, dt=0.02, inputs={PUSH: 1.0})
    assert np.isfinite(found["mass.s"][0]).all()


@pytest.mark.parametrize(
    ("over", "options", "sentence"),
    [
        ({"spring.k": [1.0]}, {}, r"'spring\.k' is no parameter, input or state; did you mean"),
        ({"spring.c": [-1.0]}, {}, r"'spring\.c' has -1, but must be at least 0 N/m\."),
        ({"spring.c": "many"}, {}, r"'spring\.c' is 'many'; give numbers"),
        ({"spring.c": [[1.0]]}, {}, r"shape \(1, 1\); give a row of finite numbers"),
        ({"spring.c": []}, {}, r"shape \(0,\); give a row of finite numbers"),
        ({}, {}, "are not values by name"),
        (
            {"spring.c": np.ones(10**6), "mass.m": np.ones(10**6)},
            {},
            r"over: 1e\+12 variants need .* of memory or more where there are .*; vary fewer values",
        ),
        ({"mass.s": [1.0]}, {"x0": [0.0, 0.0]}, "x0: give a mapping by name"),
        ({"spring.c": [1.0, 2.0], "mass.m": [1.0]}, {"grid": False}, r"equally many, but 'spring"),
    ],
)
def test_what_cannot_be_varied(over: Any, options: dict, sentence: str) -> None:
    with pytest.raises(ac.DataError, match=sentence):
        ac.sweep(plain(), over, 1.0, dt=0.1, inputs={PUSH: 0.0}, **options)


def test_a_wrong_selection_is_told(swept: ac.Sweep) -> None:
    with pytest.raises(ac.DataError, match=r"'mass\.m' was not varied"):
        swept.sel({"mass.m": 1.0})
    with pytest.raises(ac.DataError, match="has 4 values, counted from 0; there is no 4"):
        swept.isel({"spring.c": 4})
    with pytest.raises(ac.DataError, match=r"isel: 'spring\.c'=0\.5; give a whole number"):
        swept.isel({"spring.c": 0.5})  # pyright: ignore[reportArgumentType]
    with pytest.raises(ac.DataError, match=r"isel=0\.5 has no names"):
        swept.isel(0.5)  # pyright: ignore[reportArgumentType]
