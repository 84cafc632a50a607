"""Profiles of parameters: intervals where the data determine them, and sentences where they do not."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.components import translational as tl
from acausal.training.profile import _crossing
from tests.support.oscillator import C, D, M, force, learned, plain

QUIET: dict[str, Any] = {"progress": False, "x0": "model"}
NAMES = ["spring.c", "mass.m", "spring.d"]
NOISE = 0.02


def data(system: ac.System, end: float = 8.0) -> ac.Data:
    t = np.arange(0.0, end, 0.01)
    u = force(t)
    solution = ac.simulate(system, (0.0, float(t[-1])), dt=0.01, inputs={"push.f": u}, solver="heun")  # fmt: skip
    noise = NOISE * np.random.default_rng(0).normal(size=len(t))
    return ac.Data(t, {"push.f": u, "mass.s": np.asarray(solution["mass.s"]) + noise})


@pytest.fixture(scope="module")
def fit() -> ac.Fit:
    wrong = {**plain().parameters(), "spring.c": 60.0, "mass.m": 1.7}
    return ac.fit(
        plain(), data(plain()), "mass.s", modifiers=NAMES, gamma=0.9, params=wrong,
        strategy="gauss_newton", **QUIET,
    )  # fmt: skip


@pytest.fixture(scope="module")
def mass(fit: ac.Fit) -> ac.Profile:
    return fit.profile("mass.m", points=11)


@pytest.mark.slow
def test_the_profile_of_a_linear_case_is_that_of_the_confidence(fit: ac.Fit, mass: ac.Profile):
    value = float(fit.params["mass.m"])
    sigma = fit.confidence().parameters["mass.m"] * value
    assert mass.value == mass.values[5] == value
    np.testing.assert_allclose(mass.values[[0, -1]], [value - 3 * sigma, value + 3 * sigma])
    np.testing.assert_allclose(mass.ratio, ((mass.values - value) / sigma) ** 2, rtol=0.1, atol=0.03)  # fmt: skip
    np.testing.assert_allclose(mass.interval, [value - 1.96 * sigma, value + 1.96 * sigma], rtol=1e-3)  # fmt: skip
    assert mass.identifiable
    assert mass.converged.all()
    assert mass.interval[0] < M < mass.interval[1]
    assert mass.summary().startswith("'mass.m' is identifiable: with 95 % confidence between 1.9")


@pytest.mark.slow
def test_every_point_is_a_training_with_the_parameter_left_out(fit: ac.Fit, mass: ac.Profile):
    k = 2
    held = {**fit.params, "mass.m": mass.values[k]}
    alone = ac.fit(
        plain(), data(plain()), "mass.s", modifiers=["spring.c", "spring.d"], params=held,
        strategy="gauss_newton", **QUIET,
    )  # fmt: skip
    assert mass.losses[k] == pytest.approx(alone.loss, rel=1e-7)
    for name in ("spring.c", "spring.d"):
        assert mass.others[name][k] == pytest.approx(float(alone.params[name]), rel=1e-4)


class Two(ac.Component):
    """A mass on two springs in parallel, of which only the sum matters."""

    def __init__(self) -> None:
        super().__init__()
        self.fixed, self.spring, self.other = tl.Fixed(), tl.SpringDamper(c=C / 2, d=D), tl.Spring(c=C / 2)  # fmt: skip
        self.mass = tl.Mass(m=M, s=ac.Start(0.0, fixed=True), v=ac.Start(0.0, fixed=True))
        self.push = tl.Force()
        for spring in (self.spring, self.other):
            self.connect(self.fixed.flange, spring.flange_a)
            self.connect(spring.flange_b, self.mass.flange_a)
        self.connect(self.push.flange, self.mass.flange_b)


@pytest.mark.slow
@pytest.mark.parametrize("loss", [pytest.param("nrmse", marks=pytest.mark.slow), "likelihood"])
def test_a_flat_profile_is_not_identifiable(loss: str, tmp_path: Path):
    system = ac.compile(Two())
    bounds = {"spring.c": ac.Bounded(1, 100), "other.c": ac.Bounded(1, 100)}
    fit = ac.fit(
        system, data(plain(), 4.0), "mass.s", modifiers=bounds, strategy="gauss_newton",
        loss=loss, **QUIET,
    )  # fmt: skip
    found = fit.profile("other.c", points=7, width=0.5)
    assert not found.identifiable
    assert found.interval == (-np.inf, np.inf)
    assert np.ptp(found.others["spring.c"] + found.values) < 0.01 * C
    assert found.summary().startswith("'other.c' is not identifiable: from ")
    page = fit.report(tmp_path, profiles=[found]).read_text(encoding="utf-8")
    assert "The profile of &#x27;other.c&#x27;." in page
    assert "&#x27;other.c&#x27; is not identifiable" in page


@pytest.mark.machines
def test_networks_are_trained_along():
    """A spring beside a learned one takes any part of it; without the network it would be known."""
    fit = ac.fit(
        learned(), data(plain(), 3.0), "mass.s", modifiers={"spring.c": 0.5},
        strategy="whole_record", epochs=30, **QUIET,
    )  # fmt: skip
    found = fit.profile("spring.c", points=5, width=0.1)
    assert np.isfinite(found.losses).all()
    assert found.losses[0] < 1.05 * fit.loss


def test_it_is_plotted(mass: ac.Profile):
    import matplotlib.pyplot as plt

    figure = mass.plot()
    (axes,) = figure.axes
    assert axes.get_xlabel() == "mass.m in kg"
    assert repr(mass).startswith("Profile of 11 points: 'mass.m' is identifiable")
    plt.close("all")


def test_one_side_may_be_open():
    values = np.linspace(0.0, 4.0, 5)
    profile = ac.Profile(
        "a.k", "N/m", 2.0, values, values, {}, np.array([np.inf, 1.0, 0.0, 0.1, 0.2]), values > 0
    )
    assert profile.interval == (0.0, np.inf)
    assert profile.summary() == (
        "'a.k' is bounded from below alone: with 95 % confidence above 0 N/m, up to 4 N/m at least."
    )
    ratio = np.array([0.0, 1.0, 4.0, 9.0])
    assert _crossing(np.arange(4.0), ratio, 6.25) == pytest.approx(2.5)


@pytest.mark.parametrize(
    ("chosen", "sentence"),
    [
        ({"parameter": "mass.n"}, "profile: no parameter was trained that is 'mass.n': did you mean 'mass.m'?"),
        ({"points": 4}, "profile: points=4; give an odd number, 5 or more."),
        ({"width": 0}, "profile: width=0; give a number of standard deviations."),
        ({"level": 95}, "profile: level=95; give a number between 0 and 1."),
    ],
)  # fmt: skip
def test_misuse_is_refused(fit: ac.Fit, chosen: dict[str, Any], sentence: str):
    given: dict[str, Any] = {"parameter": "mass.m", **chosen}
    with pytest.raises(ac.TrainingError) as error:
        fit.profile(**given)
    assert str(error.value) == sentence
