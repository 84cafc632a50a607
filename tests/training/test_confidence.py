"""How well a record determines laws and parameters, the residuals, and the page about them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from typing import Any

import jax
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.signal import lfilter

import acausal as ac
from acausal.components import translational as tl
from acausal.networks import Law
from acausal.training.uncertainty.confidence import INDISTINGUISHABLE
from acausal.training.uncertainty.record_elimination import RecordJacobian, posterior_covariance
from acausal.training.uncertainty.residuals import Piece, residuals
from acausal.training.uncertainty.tangents import correlation_with, law_directions
from tests.support.oscillator import Oscillator, learned, plain, record

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


@pytest.mark.slow
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
    told = repr(fit.confidence()).splitlines()[1]
    assert re.match(r"'extra.net' is known to .* % of its range, at worst to .* % near -?\d", told)
    assert repr(fit.residuals()[0]).startswith("Residuals of 'mass.a': the residuals")


@pytest.mark.machines
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


@pytest.mark.slow
def test_standard_deviations_are_those_of_repeated_measurements():
    found: list[list[float]] = []
    for seed in range(12):
        fit = ac.fit(
            plain(), noisy(seed, 0.0), "mass.a", x0="model", strategy="whole_record",
            epochs=25, modifiers=["mass.m", "spring.c"], solver="rk4", progress=False,
        )  # fmt: skip
        found.append(list(fit.modifiers.values()))
    expected = list(fit.confidence().parameters.values())
    np.testing.assert_allclose(np.std(found, axis=0), expected, rtol=0.6)
    assert np.all(np.abs(np.mean(found, axis=0)) < 3 * np.asarray(expected) / np.sqrt(12) + 1e-5)


def coloured(seed: int, keep: float = 0.9) -> ac.Data:
    """A short record with noise of the first order, each sample ``keep`` times the one before and something new."""
    data, rng = record(0.0, end=2.0), np.random.default_rng(seed)
    fresh = np.sqrt(1 - keep**2) * rng.standard_normal(len(data) + 200)
    noise = lfilter([1.0], [1.0, -keep], fresh)[200:]
    a = data["mass.a"] + NOISE * data["mass.a"].std() * noise
    return ac.Data(data.time, {"mass.a": a, "push.f": data["push.f"]})


@pytest.mark.slow
def test_samples_that_are_alike_count_for_less_and_unknown_starts_make_less_sure():
    """Standard deviations of white noise and a known start are an eighth of these."""
    fits = [
        ac.fit(
            plain(), coloured(seed), "mass.a", x0="fit", strategy="whole_record", epochs=40,
            modifiers=["mass.m", "spring.c"], solver="rk4", progress=False,
        )
        for seed in range(10)
    ]  # fmt: skip
    sure = [fit.confidence() for fit in fits[:3]]
    found = np.std([list(fit.modifiers.values()) for fit in fits], axis=0, ddof=1)
    expected = np.mean([list(s.parameters.values()) for s in sure], axis=0)
    np.testing.assert_allclose(expected, found, rtol=0.5)
    assert all(s.alike["mass.a"] > 4 for s in sure)
    assert "which count as one here" in sure[0].summary()[-1]


def covariance_of(J: np.ndarray, samples: float) -> np.ndarray:
    """Of numbers that one record has in common with others."""
    return posterior_covariance([RecordJacobian(J, J[:, :0])], samples).common


def test_a_covariance_keeps_its_digits():
    """Against fractions; the plain inverse of JᵀJ + 1 is off by its own size here."""
    J = np.array([[1e9, 1e9], [1e9, 1e9 + 1.0]])
    (a, b), (_, d) = ([Fraction(int(v)) for v in row] for row in J)
    p, q, r = 2 * a * a + 1, a * b + a * d, b * b + d * d + 1
    det = p * r - q * q
    exact = np.array([[float(r / det), float(-q / det)], [float(-q / det), float(p / det)]])
    np.testing.assert_allclose(covariance_of(J, 1e20), exact, rtol=1e-6)


def test_few_samples_make_less_sure_than_they_leave_over():
    """A linear model of 4 numbers and 20 samples: the unbiased estimate divides by 16."""
    J = 1e3 * np.random.default_rng(0).standard_normal((20, 4))
    np.testing.assert_allclose(covariance_of(J, 20.0), np.linalg.inv(J.T @ J) * 20 / 16, rtol=1e-4)
    unseen = np.concatenate([J, np.zeros((20, 1))], axis=1)
    assert covariance_of(unseen, 20.0)[4, 4] == pytest.approx(1.0)


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


@pytest.mark.slow
def test_what_cannot_be_told_apart_is_said():
    fit = ac.fit(
        ac.compile(TwoSprings()), noisy(0, 0.0), "mass.a", x0="model", strategy="whole_record",
        epochs=5, modifiers=["one.c", "other.c"], progress=False,
    )  # fmt: skip
    summary = fit.confidence().summary()
    told = "The data can hardly tell 'other.c' from 'one.c' (correlation -"
    assert any(sentence.startswith(told) for sentence in summary)


@pytest.mark.slow
def test_a_spring_beside_a_law_that_can_take_its_part_is_not_called_known():
    """Mass and damper do other things than a spring, and are known."""
    fit = ac.fit(
        learned(), noisy(0, 0.0), "mass.a", x0="model", strategy="whole_record", epochs=5,
        modifiers={"spring.c": 0.2, "spring.d": 0.2, "mass.m": 0.2}, solver="rk4", progress=False,
    )  # fmt: skip
    sure = fit.confidence()
    summary = sure.summary()
    assert [s.split(" is known")[0] for s in summary[:2]] == ["'spring.d'", "'mass.m'"]
    assert summary[2] == (
        "The data can hardly tell 'spring.c' from the law 'extra.net', which can take any part "
        "of it: only the two together are known well; fix one, or measure more."
    )
    assert not any("'spring.c' is known" in sentence for sentence in summary)
    assert not any("law" in sentence for sentence in summary[3:])
    alike = {name: laws["extra.net"] for name, laws in sure.with_laws.items()}
    assert alike["spring.c"] > 0.99999
    assert alike["spring.d"] < 0.8
    assert alike["mass.m"] < 0.995
    assert sure.parameters["spring.c"] > 50 * sure.parameters["mass.m"]


@pytest.mark.slow
@pytest.mark.parametrize("promise", [{}, {"odd": True}, {"monotone": True}])
def test_the_functions_that_a_law_can_add_keep_its_promises(promise: dict[str, Any]):
    x = np.linspace(-1.0, 1.0, 81)
    network = ac.networks.Law(activation="tanh", output_scale=20.0, input_scale=0.5, **promise)(0)
    count, moved = law_directions(network, x[:, None])
    functions = np.asarray(jax.jacfwd(lambda z: jax.vmap(moved(z))(x))(np.zeros(count)))
    np.testing.assert_allclose(np.sqrt(np.mean(functions**2, axis=0)), 20.0, rtol=1e-6)
    assert correlation_with(100 * x, functions) > INDISTINGUISHABLE
    preload = correlation_with(np.full_like(x, 100.0), functions)
    assert preload < 1e-3 if "odd" in promise else preload > INDISTINGUISHABLE
    assert correlation_with(1e-3 * x, functions) == 0.0


class Beside(ac.Component):
    """Two oscillators that have nothing to do with each other."""

    def __init__(self) -> None:
        super().__init__()
        self.one, self.other = Oscillator(), Oscillator(learned=True)


@pytest.mark.slow
def test_what_no_target_depends_on_is_told_of():
    data = noisy(0, 0.0)
    twice = ac.Data(
        data.time,
        {
            "one.mass.a": data["mass.a"],
            "one.push.f": data["push.f"],
            "other.push.f": data["push.f"],
        },
    )
    expected = (
        r"^Training did not move 'other\.extra\.net', 'other\.mass\.m': no target depends on it\."
    )
    with pytest.warns(UserWarning, match=expected):
        fit = ac.fit(
            ac.compile(Beside()), twice, "one.mass.a", x0="model", strategy="whole_record", epochs=5,
            modifiers={"one.mass.m": 0.2, "other.mass.m": 0.2}, progress=False,
        )  # fmt: skip
    summary = fit.confidence().summary()
    assert summary[0].startswith("'one.mass.m' is known to ±")
    assert summary[1].startswith("The data say nothing about 'other.mass.m'")


# -- residuals ---------------------------------------------------------------------------------------


def test_residuals_are_judged():
    rng = np.random.default_rng(0)
    white, u = rng.standard_normal((2, 4000))
    slow = np.convolve(white, np.ones(5) / 5, mode="same")
    driven = white + 0.3 * np.roll(u, 7)
    quiet = residuals("y", [Piece(white, {"u": u})], 1.0)
    assert quiet.is_white
    assert quiet.drivers == ()
    assert "look like white noise" in quiet.summary()
    assert not residuals("y", [Piece(slow, {"u": u})], 1.0).is_white
    follows = residuals("y", [Piece(driven, {"u": u})], 1.0)
    lag = int(np.argmax(np.abs(follows.inputs["u"]))) - len(follows.inputs["u"]) // 2
    assert lag == 7
    assert follows.inputs["u"].max() == pytest.approx(0.3 / np.sqrt(1.09), abs=0.05)


def test_two_lags_are_enough_to_betray_colour():
    white = np.random.default_rng(0).standard_normal(4000)
    short = white[2:] + 0.8 * white[1:-1] + 0.5 * white[:-2]
    assert not residuals("y", [Piece(short, {})], 1.0).is_white


@pytest.mark.slow
def test_slow_noise_is_not_taken_for_what_a_slow_input_does():
    """Of 40 pairs that have nothing to do with each other; the bound of white noise would accuse most of them."""
    rng = np.random.default_rng(0)
    slow = lfilter([1.0], [1.0, -0.97], rng.standard_normal((2, 40, 4000)))
    found = [residuals("y", [Piece(y, {"u": u})], 1.0) for y, u in zip(*slow, strict=True)]
    assert sum(bool(r.drivers) for r in found) <= 2
    assert sum(np.max(np.abs(r.inputs["u"])) > r.bound for r in found) > 20
    driven = residuals("y", [Piece(slow[0, 0] + 0.7 * slow[1, 0], {"u": slow[1, 0]})], 1.0)
    assert driven.drivers == ("u",)


@pytest.mark.parametrize("count", [2, 3, 5, 12])
def test_few_samples_tell_nothing(count: int):
    found = residuals("y", [Piece(np.arange(count) ** 2.0, {"u": np.arange(count) - 1.0})], 1.0)
    assert found.summary() == f"'y': {count} samples are too few to tell residuals from noise."


def test_what_is_followed_exactly_leaves_nothing_to_learn():
    u = np.sin(np.arange(1000) / 20)
    found = residuals("y", [Piece(1e-9 * u, {"u": u})], 2.0)
    assert found.drivers == ("u",)
    assert found.summary() == (
        "'y': the residuals are 4e-08 % of it; there is nothing more to learn."
    )


@pytest.mark.slow
def test_residuals_of_a_fit():
    (found,) = trained().residuals()
    assert found.target == "mass.a"
    assert np.std(found.values) == pytest.approx(NOISE * record()["mass.a"].std(), rel=0.1)
    assert len(found.own) == 50


# -- the page ----------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_page_holds_everything_itself(tmp_path: Any):
    path = trained().report(tmp_path / "out", "An oscillator")
    text = path.read_text(encoding="utf-8")
    assert path == tmp_path / "out" / "index.html"
    for word in ("An oscillator", "extra.net", "mass.m", "Residuals", "mass.a"):
        assert word in text
    assert text.count("data-plot=") == text.count('<figure class="plot"') > 8
    assert not re.search(r'(src|href)="(?!data:)', text)


@pytest.mark.slow
def test_a_path_that_ends_in_html_is_a_file(tmp_path: Any):
    assert trained().report(tmp_path / "a" / "training.html") == tmp_path / "a" / "training.html"
    assert (
        ac.page(trained(), tmp_path, "Mine").read_text(encoding="utf-8").count("<h1>Mine</h1>") == 1
    )


def test_the_page_tells_what_was_learned_where(tmp_path: Any):
    content = trained().page_content()
    cards = {card.path: card for card in content.cards}
    titles = {path: [s.title for s in card.sections] for path, card in cards.items()}
    assert "Learned law" in titles["extra"]
    assert "Learned law" not in titles["spring"]
    (law,) = next(s.blocks for s in cards["extra"].sections if s.title == "Learned law")
    assert [c.label for c in law.curves][:2] == ["before", "learned"]
    parameters = next(s.blocks[0] for s in cards["mass"].sections if s.title == "Parameters")
    assert parameters.header[3] == "trained change"
    changes = {row[0]: row[3] for row in parameters.rows}
    assert changes["m"].endswith("%")
    assert changes["L"] == ""
    assert [tab.title for tab in content.tabs] == ["Records", "Laws", "Training", "Trust"]
    above, below = (p for p in content.plots if p.group.startswith("record 'mass.a'"))
    assert [c.label for c in above.curves] == ["measured", "before", "after"]
    assert (below.low, [c.label for c in below.curves]) == (True, ["before", "after"])


@pytest.mark.slow
def test_a_page_about_a_model_that_diverges(tmp_path: Any):
    """It has no laws to show, and says so; the curves stay by the measured ones."""
    with pytest.warns(UserWarning, match="diverge"):
        fit = ac.fit(
            learned(), noisy(0), "mass.a", x0="model", params={"extra.net": lambda x: -1e4 * x**3},
            train=[], modifiers=["mass.m"], strategy="whole_record", epochs=2, progress=False,
        )  # fmt: skip
    assert not np.isfinite(fit.loss)
    text = fit.report(tmp_path).read_text(encoding="utf-8")
    assert "The trained model diverges over the record" in text
    assert "Learned laws" not in text
    assert "Measured and simulated" in text


def test_a_learned_law_is_distilled():
    found = trained().distill("extra.net", terms=2, tolerance=0.05)
    assert "cube" in found.formula.terms
    with pytest.raises(
        ac.TrainingError, match=r"^There is no trained network 'extra': did you mean"
    ):
        trained().distill("extra")


class Cell(ac.Component):
    """A voltage that depends on a charge, which nothing measures."""

    i = ac.Input()
    charge = ac.Variable(start=0.5)
    v = ac.Variable()
    law = ac.Module()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.charge), -self.i)
        yield ac.Eq(self.v, self.law(self.charge))


@cache
def cell() -> ac.System:
    return ac.compile(Cell(law=Law()))


def voltage(charge: Any) -> Any:
    return 3 + 0.4 * charge + 0.2 * np.tanh(4 * (charge - 0.3))


def cell_record(size: float, seed: int) -> ac.Data:
    """From a charge of 0.7, which the model has at 0.5."""
    t, rng = np.linspace(0.0, 10.0, 201), np.random.default_rng(seed)
    i = size * (0.04 + 0.2 * np.sin(2 * t))
    charge = 0.7 - size * (0.04 * t + 0.1 * (1 - np.cos(2 * t)))
    return ac.Data(t, {"i": i, "v": voltage(charge) + 0.005 * rng.standard_normal(len(t))})


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize("sizes", [(1.0,), (1.0, 0.3)])
def test_a_start_that_a_law_can_take_is_said_and_widens_its_band(sizes: tuple[float, ...]) -> None:
    """The law may be shifted by any charge, and the start with it."""
    records = {f"record {k}": cell_record(size, k) for k, size in enumerate(sizes)}
    fit = ac.fit(cell(), records, ["v"], progress=False)
    known = fit.confidence()
    assert known.starts == {"charge": ("law",)}
    assert "where 'charge' starts: 'law' can take any part of that" in repr(fit)
    band = known.laws["law"]
    seen = (band.x > fit.ranges["law"][0][0]) & (band.x < fit.ranges["law"][0][1])
    miss = np.abs(band.law - voltage(band.x))[seen]
    assert miss.max() > 0.05
    assert (miss < 4 * band.sigma[seen]).all()


@pytest.mark.slow
def test_a_start_is_unknown_beside_a_law_that_is_finer_than_the_bumps_of_its_band() -> None:
    t, rng = np.linspace(0.0, 30.0, 3001), np.random.default_rng(0)
    charge = 0.54 - 0.02 * t - 0.15 / 1.3 * (1 - np.cos(1.3 * t))

    def fine(z: Any) -> Any:
        steps = np.tanh(25 * (z - 0.24)) + np.tanh(30 * (z + 0.11))
        return 3 + 0.4 * z + 0.1 * steps

    noisy = fine(charge) + 0.002 * rng.standard_normal(len(t))
    data = ac.Data(t, {"i": 0.02 + 0.15 * np.sin(1.3 * t), "v": noisy})
    fit = ac.fit(cell(), data, ["v"], progress=False)
    known = fit.confidence()
    assert known.starts == {"charge": ("law",)}
    band = known.laws["law"]
    seen = (band.x > fit.ranges["law"][0][0]) & (band.x < fit.ranges["law"][0][1])
    miss = np.abs(band.law - fine(band.x))[seen]
    assert miss.max() > 0.05
    assert (miss < 4 * band.sigma[seen]).all()


@pytest.mark.machines
def test_a_start_that_is_trained_without_a_prior_is_said_to_be_taken_by_a_law() -> None:
    fit = ac.fit(cell(), cell_record(1.0, 0), ["v"], progress=False, x0="fit")
    assert fit.confidence().starts == {"charge": ("law",)}


@pytest.mark.slow
def test_a_start_that_is_given_beside_a_law_is_not_called_unknown() -> None:
    data = cell_record(1.0, 0)
    fit = ac.fit(cell(), data, ["v"], progress=False, x0={"charge": 0.7})
    assert fit.confidence().starts == {}
    assert "starts" not in repr(fit)


class Cooled(ac.Component):
    """A temperature that a fan lowers by an unknown law of both."""

    T = ac.Variable(start=1.0)
    heat, fan = ac.Input(), ac.Input()
    law = ac.Module(Law(secondary=1))

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.T), self.heat - self.law(self.T, self.fan))


@pytest.mark.slow
def test_bands_of_a_law_of_two_arguments_hold_the_truth_and_open_at_values_that_were_not_seen():
    def truth(T: Any, fan: Any) -> Any:
        return (0.3 + np.sqrt(fan)) * T

    def measured(seed: int, slowest: float) -> ac.Data:
        rng, t = np.random.default_rng(seed), np.arange(0.0, 60.0, 0.1)
        heat, fan = (rng.uniform(low, 1.0, 30).repeat(20) for low in (0.1, slowest))
        T = np.ones_like(t)
        for k in range(len(t) - 1):  # exact, as the inputs are held
            rate = truth(1.0, fan[k])
            T[k + 1] = heat[k] / rate + (T[k] - heat[k] / rate) * np.exp(-0.1 * rate)
        held = {"heat": "previous", "fan": "previous"}
        signals = {"heat": heat, "fan": fan, "T": T + 0.01 * rng.standard_normal(len(t))}
        return ac.Data(t, signals, interpolation=held)

    fit = ac.fit(ac.compile(Cooled()), measured(0, 0.3), ["T"], progress=False)
    band = fit.confidence().laws["law"]
    low, high = np.quantile(fit.arguments["law"][:, 0], (0.05, 0.95))
    seen = (band.x > low) & (band.x < high)
    miss = np.abs(band.law - truth(band.x, *band.held))[seen]
    assert np.mean(miss < 3 * band.sigma[seen]) > 0.9
    within, outside = (fit.predict(measured(1, least))["record"] for least in (0.3, 0.0))
    assert outside.inside["T"] > 0.9
    assert outside.bands["T"].sigma.max() > 2 * within.bands["T"].sigma.max()


class Box(ac.Component):
    """A temperature with losses, and an unknown effect of an input."""

    C, G = ac.Parameter(1.0), ac.Parameter(1.0)
    T = ac.Variable(start=0.0)
    u, outside = ac.Input(), ac.Input()
    law = ac.Module(Law())

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.C * ac.der(self.T), self.G * (self.outside - self.T) - self.law(self.u))


@cache
def box(*modifiers: str) -> ac.Fit:
    """Trained on a record with C = G = 3."""
    t, rng = np.arange(0.0, 60.0, 0.1), np.random.default_rng(0)
    u, outside = rng.uniform(0.0, 1.5, 40).repeat(15), 2 * rng.standard_normal(40).repeat(15)
    T = np.zeros_like(t)
    for k in range(len(t) - 1):  # exact, as the inputs are held
        rest = outside[k] - 2 * u[k] ** 2
        T[k + 1] = rest + (T[k] - rest) * np.exp(-0.1)
    held = {"u": "previous", "outside": "previous"}
    signals = {"u": u, "outside": outside, "T": T + 0.02 * rng.standard_normal(len(t))}
    data = ac.Data(t, signals, interpolation=held)
    params = {n: 3.0 for n in ("C", "G") if n not in modifiers} if len(modifiers) < 2 else {}
    return ac.fit(
        ac.compile(Box()), data, ["T"], modifiers=list(modifiers), params=params, progress=False
    )


@pytest.mark.slow
def test_a_parameter_whose_effect_resembles_that_of_a_law_is_known_where_the_data_determine_it():
    fit = box("G")
    sure = fit.confidence()
    assert abs(float(fit.params["G"]) / 3 - 1) < 3 * sure.parameters["G"] < 0.1
    assert sure.taken == {}
    assert "hardly tell" not in repr(fit)


@pytest.mark.slow
def test_parameters_and_a_law_that_have_a_factor_in_common_are_not_called_known():
    fit = box("C", "G")
    sure = fit.confidence()
    assert sure.taken == {"C": ("law",), "G": ("law",)}
    assert min(sure.parameters.values()) > 0.5
    assert "The data can hardly tell 'G' from the law 'law'" in repr(fit)
    assert fit.verdict is not None
    assert not fit.verdict.good
    band, own = sure.laws["law"], float(fit.params["C"])
    assert own != pytest.approx(3, rel=0.2)  # one factor of many
    miss = np.abs(band.law - 6 * band.x**2)
    seen = (band.x > 0.3) & (band.x < 1.5)
    assert (miss < 4 * band.sigma)[seen].all()


class Ambient(ac.Component):
    """A body whose losses are a law of how much warmer it is than a surrounding that nobody measures."""

    Q, Ta = ac.Input(), ac.Parameter(10.0)
    T = ac.Variable(start=15.0)
    law = ac.Module(ac.networks.Law())

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(10 * ac.der(self.T), self.Q - self.law(self.T - self.Ta))


@pytest.mark.slow
def test_what_records_have_in_common_beside_a_law_is_as_unknown_as_it_was():
    """The law may be shifted, and the surroundings of all records with it."""
    t, rng = np.linspace(0, 60, 241), np.random.default_rng(14)
    records, true = {}, {"a": 13.0, "b": 16.0, "c": 14.0}
    for k, (name, Ta) in enumerate(true.items()):
        Q = 9 + 6 * np.sin(0.5 * t + k) + 3 * np.sin(1.3 * t)
        flow = CubicSpline(t, Q)
        rates = lambda t, T, flow=flow, Ta=Ta: (flow(t) - 0.6 * (T - Ta) ** 1.3) / 10  # noqa: E731
        run = solve_ivp(rates, (0, 60), [Ta + 8], t_eval=t, rtol=1e-9, atol=1e-9)
        records[name] = ac.Data(t, {"Q": Q, "T": run.y[0] + 0.05 * rng.standard_normal(len(t))})
    fit = ac.fit(ac.compile(Ambient()), records, ["T"], per_record={"Ta": 3.0}, progress=False)
    sure = fit.confidence()
    assert sure.taken == {"Ta": ("law",)}
    assert "The data can hardly tell 'Ta' from the law 'law'" in repr(fit)
    found = [record.parameters["Ta"] for record in fit.records.values()]
    assert (np.abs(np.subtract(found, [*true.values()])) < 3 * sure.per_record["Ta"]).all()
