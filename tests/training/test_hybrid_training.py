"""Training through events."""

from typing import Any

import numpy as np
import optax
import pytest

import acausal as ac
from tests.support.hybrid import Ball, Sampled, Thermostat, ball_height


@pytest.fixture(scope="module")
def zone() -> tuple[ac.System, ac.Data]:
    system = ac.compile(Thermostat())
    ts = np.linspace(0.0, 6.0, 61)
    sol = ac.simulate(system, (0.0, 6.0), saveat=ts, rtol=1e-9, atol=1e-11)
    return system, ac.Data(ts, {"T": np.asarray(sol["T"])})


@pytest.mark.machines
@pytest.mark.parametrize("solver", ["rk4", pytest.param("tsit5", marks=pytest.mark.slow)])
def test_a_zone_under_a_thermostat_finds_its_parameters(
    zone: tuple[ac.System, ac.Data], solver: str
) -> None:
    system, data = zone
    tolerances: dict[str, Any] = {"rtol": 1e-7, "atol": 1e-9} if solver == "tsit5" else {}
    fit = ac.fit(
        system,
        data,
        targets=["T"],
        params={"C": 9.5, "G": 1.05},
        modifiers=["C", "G"],
        strategy="gauss_newton",
        solver=solver,
        epochs=20,
        **tolerances,
    )
    assert fit.params["C"] == pytest.approx(10.0, rel=1e-4)
    assert fit.params["G"] == pytest.approx(1.0, rel=1e-4)


@pytest.mark.slow
def test_a_balls_restitution_from_two_records() -> None:
    system = ac.compile(Ball())
    ts = np.linspace(0.0, 1.2, 61)
    heights = ([ball_height(h0, 0.8, t) for t in ts] for h0 in (1.0, 1.3))
    data = [ac.Data(ts, {"h": np.asarray(height)}) for height in heights]
    fit = ac.fit(
        system,
        data,
        targets=["h"],
        x0={"v": 0.0},
        params={"e": 0.75},
        modifiers=["e"],
        optimizer=optax.adam(5e-3),
        solver="rk4",
        epochs=120,
    )
    assert fit.params["e"] == pytest.approx(0.8, abs=2e-3)


def test_equation_error_needs_states_without_events(zone: tuple[ac.System, ac.Data]) -> None:
    system, data = zone
    with pytest.raises(ac.TrainingError, match="events"):
        ac.fit(system, data, targets=["T"], modifiers=["C"], strategy="equation_error")


@pytest.mark.slow
def test_sampling_instants_are_those_of_each_records_own_time() -> None:
    """Records begin at any time; a controller samples by the model's time in each of them."""
    system = ac.compile(Sampled())
    records = {}
    for begin, level in ((100.02, 0.0), (3.07, 0.5)):
        t = begin + np.linspace(0.0, 1.0, 21)
        run = ac.simulate(system, (t[0], t[-1]), saveat=t, x0={"x": level}, rtol=1e-9)
        records[f"from {begin:g}"] = ac.Data(t, {"x": np.asarray(run["x"])})
    fit = ac.fit(
        system, records, "x", modifiers=["k"], params={"k": 1.6}, strategy="gauss_newton", epochs=6
    )
    assert fit.params["k"] == pytest.approx(2.0, rel=1e-3)
    assert fit.loss < 1e-3
