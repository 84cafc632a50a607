"""Records that begin in other modes than the model: measured, given, or told by their first samples."""

from typing import Any

import numpy as np
import pytest

import acausal as ac
from tests.support.hybrid import Thermostat

TRUE = {"C": 8.0, "G": 1.2}
NOISE = 0.02


@pytest.fixture(scope="module")
def zone() -> ac.System:
    return ac.compile(Thermostat())


@pytest.fixture(scope="module")
def records(zone: ac.System) -> dict[str, dict[str, Any]]:
    """Of a thermostat between its thresholds, on at first, as in the model, and off."""
    rng = np.random.default_rng(0)

    def record(on: int) -> dict[str, Any]:
        times = np.linspace(0, 4, 81)
        run = ac.simulate(zone, 4.0, x0={"T": 20.0, "on": on}, params=TRUE, saveat=times)
        noisy = np.asarray(run["T"]) + NOISE * rng.normal(size=len(times))
        return {"time": times, "T": noisy, "on": np.asarray(run["on"])}

    return {"warms": record(1), "cools": record(0)}


def fitted(zone: ac.System, records: dict[str, dict[str, Any]], **options: Any) -> ac.Fit:
    return ac.fit(
        zone,
        records,
        targets=["T"],
        params={"C": 10.0, "G": 1.0},
        modifiers=["C", "G"],
        strategy="gauss_newton",
        solver="rk4",
        epochs=8,
        **options,
    )


def without_mode(records: dict[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
    return {k: {n: v for n, v in r.items() if n != "on"} for k, r in records.items()}


def test_first_samples_tell_in_which_mode_a_record_begins(zone, records):
    fit = fitted(zone, without_mode(records))
    assert [float(fit.params[n]) for n in TRUE] == pytest.approx([*TRUE.values()], rel=0.02)
    assert "'on' begins with 0 in 1 of 2 records, as first samples tell" in str(fit)
    new = {"time": records["cools"]["time"], "T": records["cools"]["T"]}
    told = fit.predict({"new": new})["new"]
    assert told.rms["T"] < 2 * NOISE
    assert "'on' begins with 0" in str(told)
    given = fit.predict({"new": new}, x0={"on": 0})["new"]
    assert given.rms["T"] < 2 * NOISE
    assert "begins" not in str(given)


@pytest.mark.slow
def test_a_column_or_x0_says_it(zone, records):
    expected = pytest.approx([*TRUE.values()], rel=0.02)
    fit = fitted(zone, records)
    assert [float(fit.params[n]) for n in TRUE] == expected
    assert "begins" not in str(fit)
    fit = fitted(zone, without_mode(records), x0={"warms": {}, "cools": {"on": False}})
    assert [float(fit.params[n]) for n in TRUE] == expected


@pytest.mark.slow
def test_exactly_as_the_model_starts_is_so(zone, records):
    with pytest.warns(UserWarning, match="no better than|stops far above|trained model"):
        fit = fitted(zone, without_mode(records), x0="model")
    assert "begins" not in str(fit)
    assert fit.loss > 0.5
