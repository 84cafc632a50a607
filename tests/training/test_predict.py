"""Predictions of other records: what is their own is found, bands hold, and errors stand in a table."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from tests.support.counted import compilations
from tests.support.oscillator import Oscillator, plain, record

QUIET = {"strategy": "gauss_newton", "solver": "rk4", "progress": False}
NOISE = 0.01


def noisy(data: ac.Data, seed: int, *names: str) -> ac.Data:
    """Some signals with white noise, and the force as it is."""
    rng = np.random.default_rng(seed)
    shaken = {n: data[n] + NOISE * rng.standard_normal(len(data)) for n in names}
    return ac.Data(data.time, {"push.f": data["push.f"], **shaken})


@cache
def clean() -> ac.Data:
    return record(cubic=0.0, dt=0.02)


@cache
def trained() -> ac.Fit:
    data = noisy(clean().between(0, 8), 0, "mass.s", "mass.v")
    return ac.fit(plain(), data, "mass.s", modifiers=["mass.m"], **QUIET)


@pytest.mark.slow
def test_a_start_that_is_not_measured_is_found_and_the_band_holds():
    part = clean().between(10, 18)
    found = trained().predict({"a": noisy(part, 1, "mass.s")})["a"]
    assert found.x0["mass.v"] == pytest.approx(part["mass.v"][0], abs=0.03)
    assert found.rms["mass.s"] == pytest.approx(NOISE, rel=0.1)
    assert found.normalized["mass.s"] == pytest.approx(found.rms["mass.s"] / float(found.sigma[0]))
    assert found.inside["mass.s"] == pytest.approx(0.954, abs=0.03)
    assert "'mass.v' near the model's start" in found.found
    given = trained().predict(noisy(part, 1, "mass.s"), x0={"mass.v": 0.0})["record"]
    assert given.rms["mass.s"] > 3 * NOISE
    assert given.x0["mass.v"] == 0.0
    assert not given.found


class Lags(ac.Component):
    """A fast lag before a slow one."""

    K = ac.Parameter(1.0)
    u = ac.Input()
    z = ac.Variable(start=0.0)
    x = ac.Variable(start=0.0)

    def equations(self):
        yield ac.Eq(ac.der(self.z) / 80, self.K * self.u - self.z)
        yield ac.Eq(ac.der(self.x), self.z - self.x)


def lags(u: np.ndarray, K: float, seed: int) -> ac.Data:
    """A record of both with noise, every 50 ms."""
    t, rng = 0.05 * np.arange(len(u)), np.random.default_rng(seed)
    run = ac.simulate(
        ac.compile(Lags()), t[-1], saveat=t, inputs={"u": ac.Signal(t, u)}, params={"K": K}
    )
    shaken = {n: np.asarray(run[n]) + 0.02 * rng.standard_normal(len(t)) for n in ("z", "x")}
    return ac.Data(t, {"u": u, **shaken})


@pytest.mark.slow
def test_steps_are_as_short_as_the_new_record_needs():
    """The training's input is slow against the fast lag, that of the new record jumps."""
    t = 0.05 * np.arange(300)
    fit = ac.fit(
        ac.compile(Lags()),
        lags(np.sin(0.5 * t), 1.3, 0),
        ["z", "x"],
        modifiers=["K"],
        progress=False,
    )
    jumps = lags(np.sign(np.sin(2 * t + 0.1)), 1.3, 1)
    found = fit.predict(jumps)["record"]
    truth = ac.simulate(
        fit.system, t[-1], saveat=t, inputs={"u": ac.Signal(t, jumps["u"])}, params=fit.params,
        x0={"z": found.x0["z"], "x": found.x0["x"]}, rtol=1e-9, atol=1e-11,
    )  # fmt: skip
    assert np.max(np.abs(found.predicted[:, 0] - truth["z"])) < 0.01


@pytest.mark.slow
def test_without_targets_parameters_of_a_record_are_the_mean_of_those_found():
    t = 0.05 * np.arange(200)
    records = {str(K): lags(np.sin(t + K), K, k) for k, K in enumerate((1.8, 2.0, 2.2))}
    fit = ac.fit(
        ac.compile(Lags()), records, ["x"], train=[], per_record={"K": 0.1}, progress=False,
        strategy="gauss_newton", solver="kvaerno3",
    )  # fmt: skip
    found = [record.parameters["K"] for record in fit.records.values()]
    new = fit.predict(lags(np.sin(t), 2.0, 5).select(["u"]))["record"]
    assert new.parameters["K"] == pytest.approx(np.mean(found))
    assert new.parameters["K"] == pytest.approx(2.0, abs=0.05)


@pytest.mark.slow
def test_what_is_compiled_for_a_record_serves_others_of_its_length():
    parts = [noisy(clean().between(t, t + 4), k, "mass.s") for k, t in enumerate((8, 12))]
    trained().predict({"a": parts[0]})
    with compilations() as compiled:
        trained().predict({"b": parts[1]})
    assert not compiled


@pytest.mark.slow
def test_a_record_is_predicted_alone_as_with_others():
    """Also where all records of the training count alike, however long they are."""
    data = {k: noisy(clean().between(*k), 0, "mass.s", "mass.v") for k in ((0, 2), (2, 8))}
    named = {f"{start} s": part for (start, _), part in data.items()}
    options = {**QUIET, "modifiers": ["mass.m"], "record_weights": "records"}
    fit = ac.fit(plain(), named, "mass.s", **options)
    short, long = (noisy(clean().between(10, end), end, "mass.s") for end in (12, 18))
    alone = fit.predict({"a": short})["a"]
    beside = fit.predict({"a": short, "b": long})["a"]
    np.testing.assert_allclose(beside.predicted, alone.predicted, rtol=1e-6, atol=1e-9)
    sigma = alone.bands["mass.s"].sigma
    np.testing.assert_allclose(beside.bands["mass.s"].sigma, sigma, rtol=1e-6)


@pytest.mark.slow
def test_the_band_is_that_of_the_parameters_and_the_noise():
    fit, part = trained(), clean().between(0, 8)
    inputs = ac.Data(part.time, {"push.f": part["push.f"]})
    found = fit.predict(inputs, x0="model")["record"]
    assert np.isnan(found.rms["mass.s"])
    assert "no target is measured" in repr(found)
    know, mass = fit.confidence(), float(fit.params["mass.m"])
    sigma, step = know.parameters["mass.m"] * mass, 1e-4

    def at(m: float) -> np.ndarray:
        run = ac.simulate(
            plain(), (0, 8), dt=0.02, solver="rk4", inputs=inputs, params={**fit.params, "mass.m": m}
        )  # fmt: skip
        return np.asarray(run["mass.s"])

    slope = (at(mass + step) - at(mass - step)) / (2 * step)
    wanted = np.sqrt((slope * sigma) ** 2 + know.noise["mass.s"] ** 2)
    np.testing.assert_allclose(found.bands["mass.s"].sigma, wanted, rtol=1e-5)
    np.testing.assert_allclose(found.predicted[:, 0], at(mass), atol=1e-9)


@pytest.mark.slow
def test_parameters_of_a_record_are_found_or_given():
    def run(d: float, seed: int, *names: str) -> ac.Data:
        t = clean().time[:301]
        system = ac.compile(Oscillator(d=d))
        done = ac.simulate(system, (0, 6), dt=0.02, solver="rk4", inputs=clean().between(0, 6))
        data = ac.Data(t, {n: done[n] for n in ("mass.s", "push.f")})
        return noisy(data, seed, *names)

    fit = ac.fit(
        plain(), [run(0.8, 1, "mass.s"), run(1.4, 2, "mass.s")], "mass.s", modifiers=["mass.m"],
        per_record={"spring.d": None}, x0="model", **QUIET,
    )  # fmt: skip
    new = {"measured": run(2.0, 3, "mass.s"), "not": run(2.0, 3)}
    found = fit.predict(new, x0="model")
    assert found["measured"].parameters["spring.d"] == pytest.approx(2.0, abs=0.05)
    assert found["not"].parameters["spring.d"] == pytest.approx(1.1, abs=0.05)
    known, unknown = (found[n].bands["mass.s"].sigma.max() for n in ("measured", "not"))
    assert unknown > 5 * known
    given = fit.predict(new, x0="model", params={"spring.d": 2.0})
    assert given["not"].parameters["spring.d"] == pytest.approx(2.0)
    assert given["measured"].rms["mass.s"] == pytest.approx(NOISE, rel=0.1)
    with pytest.raises(
        ac.DataError, match=r"'mass\.m' does not differ between records, but 'spring\.d':"
    ):
        fit.predict(new, params={"mass.m": 2.0})
    with pytest.raises(ac.DataError, match="no record 'other'"):
        fit.predict(new, params={"other": {"spring.d": 2.0}})


class Falling(ac.Component):
    """A rod that falls from where it stands."""

    g = ac.Parameter(10.0, min=0)
    u = ac.Input()
    phi = ac.Variable(start=0.0)
    w = ac.Variable(start=0.0)

    def equations(self):
        yield ac.Eq(ac.der(self.phi), self.w)
        yield ac.Eq(ac.der(self.w), self.g * self.phi + self.u)


@pytest.mark.slow
def test_doubts_about_predictions_are_told() -> None:
    part = noisy(clean().between(10, 14), 2, "mass.s", "mass.v")
    assert not trained().predict(part)["record"].doubts
    moved = ac.Data(part.time, {**part.signals, "mass.s": np.roll(part["mass.s"], 40)})
    (said,) = trained().predict(moved)["record"].doubts
    assert "'mass.s' is missed by" in said
    t = np.linspace(0, 1, 101)
    run = ac.simulate(
        ac.compile(Falling()), 1.0, dt=0.01, inputs={"u": np.sin(9 * t)}, x0={"w": 0.1}
    )
    phi = np.asarray(run["phi"]) + 1e-3 * np.random.default_rng(0).standard_normal(len(t))
    fit = ac.fit(
        ac.compile(Falling()),
        ac.Data(t, {"u": np.sin(9 * t), "phi": phi}),
        ["phi"],
        modifiers=["g"],
        progress=False,
    )
    long = np.linspace(0, 4, 401)
    swung = 0.3 * np.sin(2 * long) + 1e-3 * np.random.default_rng(1).standard_normal(len(long))
    held = ac.Data(long, {"u": -14 * 0.3 * np.sin(2 * long), "phi": swung})
    found = fit.predict(held, x0="fit")["record"]
    assert any("the model is unstable" in one for one in found.doubts)
    assert found.found


def test_errors_stand_in_a_table_and_what_leaves_the_range_is_told(tmp_path: Path):
    parts = {"a": clean().between(10, 14), "b": clean().between(14, 18)}
    large = ac.Data(parts["b"].time, {n: 3 * v for n, v in parts["b"].signals.items()})
    found = trained().predict({**parts, "large": large})
    assert not found["a"].outside
    silent = ac.Data(large.time, {"push.f": large["push.f"]})
    assert trained().predict(silent, x0="model")["record"].outside
    assert "'large' is outside of the training's range: 'push.f'" in repr(found)
    page = found.report(tmp_path).read_text()
    assert "outside of the training" in page
    assert "a: mass.s" in page
    table = trained().evaluate({**parts, "large": large})
    assert list(getattr(table, "rows", None) or table.index) == [
        "a: mass.s",
        "b: mass.s",
        "large: mass.s",
    ]
    assert len(found["a"].plot().axes) == 1
    with pytest.raises(ac.DataError, match="There is no record 'c'"):
        found["c"]
    with pytest.raises(ac.DataError, match=r"lack 'push\.f'"):
        trained().predict(ac.Data(parts["a"].time, {"mass.s": parts["a"]["mass.s"]}))


@pytest.mark.slow
def test_conformal_bands_take_the_place_of_two_standard_deviations():
    fit = trained()
    band = fit.conformal(noisy(clean().between(8, 14), 4, "mass.s", "mass.v"), 0.8)
    new = noisy(clean().between(14, 20), 5, "mass.s", "mass.v")
    low, high = fit.predict(new, conformal=band)["record"].bands["mass.s"].bounds
    np.testing.assert_allclose(high - low, 2 * band.width["mass.s"])
