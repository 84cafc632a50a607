"""Parameters that move by a sum, or stay between bounds."""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import translational as tl
from acausal.training.objective.modifiers import Factor, Modifiers, modifiers
from tests.support.oscillator import C, D, M, force, plain, record

INF = float("inf")
ZERO = (
    "Parameter 'p' is 0, and a modifier multiplies; give it a value to start from, "
    "or let it move by a sum: modifiers={'p': ac.Shift(...)}."
)


def nothing(name: str) -> None:
    """No parameter of the model that `name` could be, free or not."""


def anything(name: str) -> tuple[float, float]:
    """No declared bounds."""
    return -INF, INF


def chosen(kind: Any, value: float) -> Modifiers:
    return modifiers({"p": kind}, 0.2, {"p": value}, nothing, anything)


@pytest.mark.parametrize(
    ("kind", "value"),
    [
        (0.2, -3.0), (ac.Shift(0.5), 0.0), (ac.Bounded(-1, 2), 1.5), (ac.Bounded(0, INF), 0.3),
        (ac.Bounded(-INF, -1), -2.0),
    ],
)  # fmt: skip
def test_training_starts_at_the_value_and_can_move_both_ways(kind: Any, value: float):
    found = chosen(kind, value)

    def moved(delta: float) -> float:
        return float(found.apply({"p": value}, {"p": jnp.asarray(delta)})["p"])

    assert moved(0.0) == value
    derivative = float(jax.grad(lambda d: found.apply({"p": value}, {"p": d})["p"])(0.0))
    assert derivative == pytest.approx((moved(1e-6) - moved(-1e-6)) / 2e-6, rel=1e-6)
    assert derivative != 0
    assert (moved(1.0) - value) * (moved(-1.0) - value) < 0
    change = float(found.changes({"p": jnp.asarray(0.7)})["p"])
    assert float(found.changed({"p": value}, {"p": change})["p"]) == moved(0.7)


@pytest.mark.parametrize(
    ("low", "high"), [(0.0, 0.3), (0.1, 0.3), (-INF, 0.3), (0.0, INF), (0.1, INF)]
)
def test_bounds_hold_whatever_happens(low: float, high: float):
    found = chosen(ac.Bounded(low, high), 0.2)
    for delta in (-700.0, -50.0, -1.0, 1.0, 50.0, 700.0):
        value = float(found.apply({"p": 0.2}, {"p": jnp.asarray(delta)})["p"])
        assert low <= value <= high
        assert np.isfinite(value)


def test_a_logistic_curve_leads_from_bound_to_bound():
    """As far from 0 in log odds as δ says."""
    moved = chosen(ac.Bounded(1, 5), 2.0).apply({"p": 2.0}, {"p": jnp.asarray(0.4)})["p"]
    odds = (float(moved) - 1) / (5 - float(moved))
    assert np.log(odds) == pytest.approx(np.log(1 / 3) + 0.4)


class Wall(ac.Component):
    """A mass on a spring and a damper at a wall whose place is not known."""

    def __init__(self) -> None:
        super().__init__()
        self.wall, self.push = tl.Fixed(s0=0.0), tl.Force()
        self.spring, self.mass = tl.SpringDamper(c=50.0, d=0.1), tl.Mass(m=M)
        self.connect(self.wall.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.mass.flange_a)
        self.connect(self.push.flange, self.mass.flange_b)


@pytest.mark.slow
def test_a_list_of_names_leaves_parameters_free_within_their_declared_bounds():
    """Mass, stiffness and damping begin 50, 40 and 100 % off; a gamma of 0.2 stops them near its limits."""
    wrong = {"mass.m": 1.5 * M, "spring.c": 0.6 * C, "spring.d": 2.0 * D}
    fit = ac.fit(
        plain(), record(cubic=0.0, end=5.0), "mass.s", modifiers=list(wrong), params=wrong,
        strategy="gauss_newton", solver="rk4", progress=False,
    )  # fmt: skip
    assert fit.params["mass.m"] == pytest.approx(M, rel=1e-3)
    assert fit.params["spring.c"] == pytest.approx(C, rel=1e-3)
    assert fit.params["spring.d"] == pytest.approx(D, rel=1e-3)
    assert fit.modifiers["mass.m"] == pytest.approx(-1 / 3, rel=1e-3)  # relative, as with a gamma


@pytest.mark.parametrize(
    ("declared", "value"), [((0, INF), 2.0), ((-INF, 0), -2.0), ((0, 3), 2.0), ((-INF, INF), -2.0)]
)
def test_a_free_parameter_stays_within_what_it_declares(
    declared: tuple[float, float], value: float
):
    free = modifiers(["p"], None, {"p": value}, nothing, lambda name: declared)

    def moved(delta: float) -> float:
        return float(free.apply({"p": value}, {"p": jnp.asarray(delta)})["p"])

    assert moved(0.0) == value
    assert all(declared[0] <= moved(delta) <= declared[1] for delta in (-30.0, -0.5, 0.5, 30.0))
    assert (moved(0.5) - value) * (moved(-0.5) - value) < 0
    if np.isinf(declared).sum() == 1:
        assert moved(0.7) / value == pytest.approx(np.exp(0.7 * np.sign(value)))
        assert not free.at_limit({"p": -0.999}, lambda name: "")
    if declared == (0, 3):
        assert "+50 %" in free.at_limit({"p": 0.499}, lambda name: "")["p"]


@pytest.mark.slow
def test_an_offset_is_found_from_zero_and_a_damping_within_its_bounds():
    time = np.linspace(0, 5, 501)
    wall = ac.compile(Wall())
    true = ac.simulate(
        wall, (0, 5), dt=0.01, inputs={"push.f": force(time)}, solver="rk4",
        params=wall.parameters() | {"wall.s0": 0.07, "spring.d": 1.0}, x0=[0.0, 0.0],
    )  # fmt: skip
    signals = {n: np.asarray(true[n]) for n in ("mass.s", "mass.v", "mass.a")}
    fit = ac.fit(
        wall, ac.Data(time, {**signals, "push.f": force(time)}), "mass.s", solver="rk4",
        modifiers={"wall.s0": ac.Shift(0.1), "spring.d": ac.Bounded(0.0, 3.0), "mass.m": 0.2},
        strategy="whole_record", epochs=60, progress=False,
    )  # fmt: skip
    assert fit.params["wall.s0"] == pytest.approx(0.07, abs=1e-5)
    assert fit.modifiers["wall.s0"] == pytest.approx(0.07, abs=1e-5)
    assert fit.params["spring.d"] == pytest.approx(1.0, rel=1e-3)
    assert fit.modifiers["spring.d"] == pytest.approx(0.9, rel=1e-3)
    assert fit.modifiers["mass.m"] == pytest.approx(0.0, abs=1e-3)
    summary = fit.confidence().summary()
    assert "%" not in summary[0] + summary[1]
    assert summary[2].startswith("'mass.m' is known to ±")
    assert "%" in summary[2]


@pytest.mark.slow
def test_a_bound_is_where_training_ends_that_wants_beyond():
    """The record's damping is 1 N s/m. A warning names it, and says that no deviation can be given."""
    expected = (
        r"^'spring\.d' has run into the limit of its modifier, \+0\.25 N\.s/m: let it move further"
    )
    with pytest.warns(UserWarning, match=expected):
        fit = ac.fit(
            plain(), record(cubic=0.0, end=5.0), "mass.a", strategy="whole_record", epochs=40,
            params={"spring.d": 0.25}, progress=False,
            modifiers={"spring.d": ac.Bounded(0.0, 0.5), "spring.c": 0.2},
        )  # fmt: skip
    assert 0.499 < fit.params["spring.d"] <= 0.5
    assert fit.confidence().summary()[0].endswith("Its standard deviation cannot be given.")


@pytest.mark.parametrize(
    ("kind", "value", "change", "limit"),
    [
        (ac.Bounded(0, 3), 1.0, -0.98, None),
        (ac.Bounded(0, 3), 1.0, -0.995, -1.0),
        (ac.Bounded(0, 3), 1.0, 1.99, 2.0),
        (ac.Bounded(0, INF), 1.0, 1e6, None),
        (ac.Bounded(0, INF), 1.0, -0.995, -1.0),
        (ac.Bounded(-INF, 3), 1.0, -1e6, None),
        (Factor(0.2), 5.0, -0.199, -0.2),
        (Factor(0.2), 5.0, -0.192, -0.2),
        (Factor(0.2), 5.0, 0.188, None),
        (ac.Shift(0.1), 0.0, 1e6, None),
    ],
)
def test_a_limit_is_reached_or_not(kind: Any, value: float, change: float, limit: float | None):
    assert kind.limit(value, change) == limit


@pytest.mark.parametrize(
    ("kind", "value", "size"),
    [
        (Factor(0.2), 5.0, 1.0), (ac.Shift(0.1), 7.0, 0.1), (ac.Bounded(1, 5), 4.9, 2.0),
        (ac.Bounded(0, INF), 3.0, 3.0), (ac.Bounded(-INF, 2), -1.0, 3.0),
    ],
)  # fmt: skip
def test_the_prior_deviation_of_a_change(kind: Any, value: float, size: float):
    """Between two bounds all is possible, however near to one of them a parameter is."""
    assert kind.prior_deviation(value) == pytest.approx(size)


def test_one_name_is_no_list_of_letters():
    assert modifiers("mass", 0.2, {"mass": 1.0}, nothing, anything).names == ("mass",)


@pytest.mark.parametrize(
    ("kind", "value", "sentence"),
    [
        (ac.Shift(0.0), 0.0, "The shift of 'p' has scale=0.0; give a positive size in its unit."),
        (ac.Bounded(1, 2), 2.0, "Parameter 'p' starts at 2, not between its bounds 1 and 2."),
        (ac.Bounded(-INF, INF), 2.0,
         "The bounds of 'p' are both infinite; give one of them, or take ac.Shift(...)."),
        (0.2, 0.0, ZERO),
        (ac.Bounded, 2.0,
         f"The modifier of 'p' is {ac.Bounded}; give a gamma, ac.Shift(...) or ac.Bounded(...)."),
        ("much", 2.0,
         "The modifier of 'p' is 'much'; give a gamma, ac.Shift(...) or ac.Bounded(...)."),
    ],
)  # fmt: skip
def test_mistakes_get_one_sentence(kind: Any, value: float, sentence: str):
    with pytest.raises(ac.TrainingError) as error:
        chosen(kind, value)
    assert str(error.value) == sentence


@pytest.mark.slow
def test_a_parameter_that_leaves_its_range_is_told():
    """A damper that drives: only a shift lets it go there, and only a trained model may have it."""
    system, times = plain(), np.linspace(0, 2, 101)
    inputs = {"push.f": force(times)}

    @jax.jit
    def driven(d: float) -> ac.Solution:
        params = {**system.parameters(), "spring.d": d}
        return ac.simulate(system, (0, 2), dt=0.02, inputs=inputs, params=params)

    data = ac.Data(times, {"mass.s": driven(-0.5)["mass.s"], **inputs})
    options: dict[str, Any] = {
        "modifiers": {"spring.d": ac.Shift(1.0)}, "x0": "model", "strategy": "whole_record",
        "sequence_length": None, "epochs": 10, "progress": False,
    }  # fmt: skip
    told = r"After training, 'spring\.d' is -0\.[45]\d*, but must be at least 0 N\.s/m\. .*Bounded"
    with pytest.warns(UserWarning, match=told):
        fit = ac.fit(system, data, "mass.s", **options)
    with pytest.raises(ac.DataError, match=r"params: 'spring\.d' is -0"):
        ac.fit(system, data, "mass.s", params=fit.params, **options)


def test_a_parameter_that_is_not_free_is_explained():
    model = ac.Component()
    model.a = tl.Mass(m=2.0)
    model.b = tl.Mass(m=2 * model.a.m)
    model.connect(model.a.flange_b, model.b.flange_a)
    system = ac.compile(model)
    data = ac.Data(np.arange(3.0), {"a.s": np.arange(3.0)})
    for name, told in {"a.L": "default of zero and is folded", "b.m": "bound to an expr"}.items():
        with pytest.raises(ac.TrainingError, match=rf"no parameter '{name}' to train: .*{told}"):
            ac.fit(system, data, "a.s", modifiers=[name], progress=False)


@pytest.mark.parametrize(("low", "high"), [(5, 1), (np.nan, 1), (2, 2), ("a", "b")])
def test_bounds_in_the_wrong_order_are_refused_where_they_are_given(low, high):
    with pytest.raises(ac.TrainingError, match=r"^Bounded\(.*: the lower bound comes first"):
        ac.Bounded(low, high)


def test_a_parameter_that_has_vanished_would_have_to_change_its_sign():
    free = modifiers(["R"], None, {"R": 2.0}, lambda _: None, lambda _: (0.0, np.inf))
    said = free.at_limit({"R": -1 + 1e-9}, lambda _: "Ohm")
    assert said["R"].endswith(
        "-100 %: it is zero, and would have to change its sign: look for what else the model lacks."
    )
