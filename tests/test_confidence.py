"""What a record tells of laws and parameters, what is left over, and the page about it."""

from __future__ import annotations

import re
from functools import cache
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.components import translational as tl
from acausal.training.residuals import residuals
from tests.oscillator import learned, plain, record

CUBIC, NOISE = 80.0, 0.05


def noisy(seed: int, cubic: float = CUBIC) -> ac.Data:
    data, rng = record(cubic), np.random.default_rng(seed)
    a = data["mass.a"] + NOISE * data["mass.a"].std() * rng.standard_normal(len(data))
    return ac.Data(data.time, {"mass.a": a, "push.f": data["push.f"]})


@cache
def trained(seed: int = 0) -> ac.Fit:
    return ac.fit(
        learned(), noisy(seed), "mass.a", x0="model", strategy="whole_record", epochs=60,
        modifiers=["mass.m"], solver="rk4", progress=False,
    )  # fmt: skip


def test_the_band_of_a_law_holds_the_truth():
    fit = trained()
    band = fit.confidence().laws["extra.net"]
    low, high = (float(v[0]) for v in fit.seen["extra.net"].interval(1.5))
    inside = (band.x > low) & (band.x < high)
    miss = np.abs(band.law - CUBIC * band.x**3)
    assert np.mean(miss[inside] < 2.5 * band.sigma[inside]) > 0.9
    assert band.sigma[inside].max() < 0.2 * 20.0
    middle, edge = band.sigma[len(band.sigma) // 2], band.sigma[0]
    assert edge > 3 * middle  # nothing was seen there


@pytest.mark.slow
def test_bands_hold_the_truth_as_often_as_they_say():
    """Over noises: two standard deviations are 95 % of a Gaussian; a band that is too wide would tell nothing."""
    shares: list[float] = []
    scores: list[float] = []
    for seed in range(10):
        fit = trained(seed)
        band = fit.confidence().laws["extra.net"]
        low, high = (float(v[0]) for v in fit.seen["extra.net"].interval(1.5))
        inside = (band.x > low) & (band.x < high)
        z = (band.law - CUBIC * band.x**3)[inside] / band.sigma[inside]
        shares.append(float(np.mean(np.abs(z) < 2)))
        scores.append(float(np.sqrt(np.mean(z**2))))
    assert 0.85 < np.mean(shares) < 1
    assert 0.6 < np.mean(scores) < 1.4


def test_standard_deviations_are_those_of_repeated_measurements():
    found, told = [], []
    for seed in range(12):
        fit = ac.fit(
            plain(), noisy(seed, 0.0), "mass.a", x0="model", strategy="whole_record",
            epochs=25, modifiers=["mass.m", "spring.c"], solver="rk4", progress=False,
        )  # fmt: skip
        found.append(list(fit.modifiers.values()))
    told = list(fit.confidence().parameters.values())
    np.testing.assert_allclose(np.std(found, axis=0), told, rtol=0.6)
    assert np.all(np.abs(np.mean(found, axis=0)) < 3 * np.asarray(told) / np.sqrt(12) + 1e-5)


class TwoSprings(ac.Component):
    """A mass on two springs side by side, which no measurement of it can tell apart."""

    def __init__(self) -> None:
        super().__init__()
        self.fixed, self.push = tl.Fixed(), tl.Force()
        self.one, self.other = tl.Spring(c=20.0), tl.SpringDamper(c=30.0, d=1.0)
        self.mass = tl.Mass(m=2.0, s=ac.Start(0.0, fixed=True), v=ac.Start(0.0, fixed=True))
        for spring in (self.one, self.other):
            self.connect(self.fixed.flange, spring.flange_a)
            self.connect(spring.flange_b, self.mass.flange_a)
        self.connect(self.push.flange, self.mass.flange_b)


def test_what_cannot_be_told_apart_is_said():
    fit = ac.fit(
        ac.compile(TwoSprings()), noisy(0, 0.0), "mass.a", x0="model", strategy="whole_record",
        epochs=5, modifiers=["one.c", "other.c"], progress=False,
    )  # fmt: skip
    words = fit.confidence().words()
    assert words[-1].startswith("The data can hardly tell 'other.c' from 'one.c' (correlation -")


# -- residuals ---------------------------------------------------------------------------------------


def test_residuals_are_judged():
    rng = np.random.default_rng(0)
    white, u = rng.standard_normal((2, 4000))
    slow = np.convolve(white, np.ones(5) / 5, mode="same")
    driven = white + 0.3 * np.roll(u, 7)
    quiet = residuals("y", white, {"u": u})
    assert quiet.is_white
    assert quiet.drivers == ()
    assert "looks like white noise" in quiet.words()
    assert not residuals("y", slow, {"u": u}).is_white
    follows = residuals("y", driven, {"u": u})
    lag = int(np.argmax(np.abs(follows.inputs["u"]))) - len(follows.inputs["u"]) // 2
    assert lag == 7
    assert follows.inputs["u"].max() == pytest.approx(0.3 / np.sqrt(1.09), abs=0.05)


def test_residuals_of_a_fit():
    (found,) = trained().residuals()
    assert found.target == "mass.a"
    assert np.std(found.values) == pytest.approx(NOISE * record()["mass.a"].std(), rel=0.1)
    assert len(found.own) == 50


# -- the page ----------------------------------------------------------------------------------------


def test_the_page_holds_everything_itself(tmp_path: Any):
    path = trained().report(tmp_path / "out", "An oscillator")
    text = path.read_text(encoding="utf-8")
    assert path == tmp_path / "out" / "index.html"
    for word in ("An oscillator", "extra.net", "mass.m", "What is left over", "mass.a"):
        assert word in text
    assert text.count("data:image/png;base64,") == 4
    assert not re.search(r'(src|href)="(?!data:)', text)


def test_a_learned_law_is_distilled():
    found = trained().distill("extra.net", terms=2, tolerance=0.05)
    assert "cube" in found.formula.terms
    with pytest.raises(
        ac.TrainingError, match=r"^There is no trained network 'extra': did you mean"
    ):
        trained().distill("extra")
