"""Records that begin in other modes than the model: measured, given, or shown by their first samples."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.training.build_problem import build_problem
from acausal.training.options import FitOptions
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


@pytest.mark.slow
def test_first_samples_show_in_which_mode_a_record_begins(zone, records):
    fit = fitted(zone, without_mode(records))
    assert [float(fit.params[n]) for n in TRUE] == pytest.approx([*TRUE.values()], rel=0.02)
    assert "'on' begins with 0 in 1 of 2 records, as first samples show" in str(fit)
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


class Walled(Thermostat):
    """A zone with a wall that nobody measures, and an alarm that the first samples do not depend on."""

    W = ac.Variable(start=14.0)
    armed = ac.Discrete(1, kind="bool")
    off = ac.Variable()

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.C * ac.der(self.T), self.P * self.on - self.G * (self.T - self.W))
        yield ac.Eq(20 * ac.der(self.W), self.T - self.W + 0.5 * (10 - self.W))
        stays = (ac.pre(self.on) > 0.5) & (self.high > self.T)
        yield ac.Eq(self.on, (self.low > self.T) | stays)
        yield ac.When(self.T > 100, ac.Eq(self.armed, 0))
        yield ac.Eq(self.off, -self.on)


@pytest.mark.slow
def test_states_that_nobody_measures_do_not_hide_the_mode_nor_does_a_blurred_column():
    system, times = ac.compile(Walled()), np.linspace(0, 4, 81)
    records = {}
    for name, on in (("warms", 1), ("cools", 0)):
        run = ac.simulate(system, 4.0, x0={"T": 20.0, "on": on}, saveat=times)
        noisy = np.asarray(run["T"]) + NOISE * np.random.default_rng(on).normal(size=81)
        blurred = np.r_[0.5, np.asarray(run["on"])[1:]]
        records[name] = {"time": times, "T": noisy, "on": blurred}
    options = FitOptions(modifiers=["C"], strategy="gauss_newton", solver="rk4")
    data = {n: ac.Data(r.pop("time"), r) for n, r in records.items()}
    params = {**system.parameters(), "C": 9.0}
    begun = build_problem(system, data, ("T",), params, options).first_states
    assert begun.discrete is not None
    assert begun.shown is not None
    place = {n: at for n, (at, _) in system.discrete.items()}
    assert np.asarray(begun.discrete)[:, place["on"]].tolist() == pytest.approx(
        [np.nan, 0], nan_ok=True
    )
    assert np.isnan(np.asarray(begun.discrete)[:, place["armed"]]).all()
    assert np.asarray(begun.shown).sum() == 1


def test_another_name_of_a_mode_is_it():
    system = ac.compile(Walled())
    run = ac.simulate(system, 1.0, x0={"T": 20.0, "off": -1}, saveat=[0.0])
    assert float(run["on"][0]) == 1
    for wrong, message in (
        ({"off": 1}, r"'off' is 1, so that 'on' is -1; give True or False"),
        ({"on": 1, "off": 0}, "'off' and another name are the same"),
    ):
        with pytest.raises(ac.DataError, match=message):
            ac.simulate(system, 1.0, x0=wrong)


class Fanned(ac.Component):
    """A warm body that a fan cools from above 60 to below 40."""

    C, G = ac.Parameter(50.0, min=0), ac.Parameter(1.0, min=0)
    T = ac.Variable(start=25.0)
    fan = ac.Discrete(0, kind="bool")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.C * ac.der(self.T), 80 - self.G * (1 + 2 * self.fan) * (self.T - 20))
        off = ac.When(self.T < 40, ac.Eq(self.fan, 0))
        yield ac.When(self.T > 60, ac.Eq(self.fan, 1), otherwise=off)


@pytest.mark.slow
def test_a_parameter_that_is_off_is_not_taken_for_a_mode():
    """The body warms more slowly than the model says, as it would with the fan; with the fan on it cools instead."""
    t, data = np.linspace(0, 30, 31), {}
    for name, T, factor in (("cold", 25.0, 1), ("fan", 52.0, 3)):
        rest = 20 + 80 / (1.3 * factor)
        data[name] = ac.Data(t, {"T": rest + (T - rest) * np.exp(-1.3 * factor / 65 * t)})
    system, options = ac.compile(Fanned()), FitOptions(modifiers=["C", "G"], solver="rk4")
    begun = build_problem(system, data, ("T",), system.parameters(), options).first_states
    assert begun.discrete is not None
    place, _ = system.discrete["fan"]
    assert np.asarray(begun.discrete)[:, place].tolist() == pytest.approx([np.nan, 1], nan_ok=True)
