"""Conformal bands hold as much of a third record as they promise."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import acausal as ac
from acausal.training.uncertainty.residuals import correlation_time
from examples.qvm.model import with_networks
from examples.qvm.record import INPUT, OUTPUTS, STATES, ride
from tests.support.oscillator import plain, record

LEVEL, PARTS = 0.9, (14.0, 28.0)


@cache
def rides() -> list[ac.Data]:
    """A ride of the quarter vehicle in three parts, every fifth sample."""
    data = ride(0.02).measured
    thin = ac.Data(data.time[::5], {n: data[n][::5] for n in (INPUT, *STATES, *OUTPUTS)})
    return [thin.between(0, PARTS[0]), thin.between(*PARTS), thin.between(PARTS[1], 42.0)]


@cache
def trained() -> ac.Fit:
    """Far from done: what is left over is no noise."""
    return ac.fit(
        ac.compile(with_networks()), rides()[0], OUTPUTS, strategy="equation_error", epochs=40,
        dt=0.0025, progress=False,
    )  # fmt: skip


@pytest.mark.slow
def test_a_band_holds_its_share_of_a_third_record():
    _, calibration, third = rides()
    band = trained().conformal(calibration, LEVEL)
    told = trained().predict(third, conformal=band)["record"]
    for name, held in told.inside.items():
        low, high = told.bands[name].bounds
        deviation = np.sqrt(LEVEL * (1 - LEVEL) / band.independent[name])
        assert abs(held - LEVEL) < 3 * np.sqrt(2) * deviation + 1 / band.independent[name] < 0.15
        assert not trained().residuals()[0].is_white
        np.testing.assert_allclose(high - low, 2 * band.width[name])
    assert "hold 90 % of" in repr(band)


@pytest.mark.slow
def test_a_band_is_the_quantile_of_independent_errors():
    """A perfect model and white noise: the Gaussian's own quantile."""
    data, rng = record(cubic=0.0), np.random.default_rng(0)
    noisy = ac.Data(
        data.time, {**data.signals, "mass.a": data["mass.a"] + rng.standard_normal(len(data))}
    )
    fit = ac.fit(
        plain(), data, "mass.a", modifiers=["mass.m"], strategy="whole_record", epochs=1,
        solver="rk4", progress=False,
    )  # fmt: skip
    band = fit.conformal(noisy, 0.9, x0="model")
    assert band.width["mass.a"] == pytest.approx(1.645, abs=0.1)
    assert band.independent["mass.a"] > 0.5 * len(data)
    head, target = repr(band).splitlines()
    assert "hold 90 % of all measurements" in head
    assert head.endswith("like the one that they were calibrated on: 'record'")
    independent = f"{band.independent['mass.a']:.0f} independent samples"
    assert target == f"  mass.a: ±{band.width['mass.a']:.4g} m/s2 (from errors worth {independent})"
    halves = {"a": noisy.between(0, 1.0), "b": noisy.between(1.01, 2.0)}
    both = repr(fit.conformal(halves, 0.9, x0="model"))
    assert "records like the 2 that they were calibrated on: 'a', 'b'" in both
    with pytest.raises(ac.DataError, match=r"^level=1\.0 is not a share of the samples"):
        fit.conformal(noisy, 1.0)
    with pytest.raises(ac.DataError, match=r"too few for level=0\.99: take a longer one"):
        fit.conformal(noisy.between(0, 0.5), 0.99)


def test_correlated_samples_count_for_less():
    """A first-order process: (1 + a) / (1 - a)."""
    rng, a = np.random.default_rng(0), 0.8
    x = np.zeros(100_000)
    for i, e in enumerate(rng.standard_normal(len(x) - 1)):
        x[i + 1] = a * x[i] + e
    assert correlation_time(x) == pytest.approx((1 + a) / (1 - a), rel=0.15)
    assert correlation_time(rng.standard_normal(10_000)) == pytest.approx(1, abs=0.2)
    assert correlation_time(np.ones(5)) == 1
