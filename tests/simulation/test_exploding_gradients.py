"""Steps outside the solver's region of stability: states stay finite, derivatives do not; or both are wrong."""

import warnings

import diffrax as dfx
import jax
import numpy as np
import pytest

import acausal as ac
from acausal.simulation.solvers import RK4
from acausal.simulation.tableau import tableau_of
from tests.support.friction import sticking


def end(limit, *, dt, solver="heun"):
    params = {"limit": limit}
    inputs = {"push": 1.0}
    return ac.simulate(sticking(), (0, 1), dt=dt, inputs=inputs, params=params, solver=solver).x[
        -1, 0
    ]


SENTENCE = (
    r"^Steps of 0\.001 s are far too long for the model's fastest mode, 7\.\d+e\+04 1/s at t = .* s: "
    r"even where states look right, derivatives are wrong\. Choose dt below 1e-05 s"
)


@pytest.mark.parametrize("solver", ["heun", "rk4", "euler"])
def test_gradients_through_steps_that_are_too_long_are_warned_of(solver):
    with pytest.warns(UserWarning, match=SENTENCE) as said:
        jax.grad(lambda p: end(p, dt=1e-3, solver=solver))(50.0)
    assert said[0].filename == __file__


def test_finite_garbage_becomes_nan():
    """Under `jit` nothing can be said."""
    gradient = jax.jit(jax.grad(lambda p: end(p, dt=1e-3, solver="euler")))(50.0)
    assert np.isnan(gradient)


def test_right_gradients_are_taken_without_a_word():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        gradient = jax.grad(lambda p: end(p, dt=1e-5))(50.0)
        end(50.0, dt=1e-3)  # the states are right
    h = 0.05
    quotient = (end(50.0 + h, dt=1e-5) - end(50.0 - h, dt=1e-5)) / (2 * h)
    assert float(gradient) == pytest.approx(float(quotient), rel=1e-4)


class Saturating(ac.Component):
    """A speed whose friction is steep at rest, and bounded."""

    push = ac.Input()
    v = ac.Variable(start=0.0, fixed=True)

    def equations(self):
        yield ac.Eq(ac.der(self.v), self.push - 50 * ac.tanh(8 * self.v))


@pytest.mark.slow
def test_states_that_are_wrong_within_bounds_are_warned_of():
    system = ac.compile(Saturating())

    def run(**options):
        return ac.simulate(system, 1.0, inputs={"push": lambda t: 40 * np.sin(7 * t)}, **options)[
            "v"
        ]

    right = run(saveat=np.linspace(0.0, 1.0, 101))
    for solver in ("euler", "heun", "rk4"):
        with pytest.warns(UserWarning, match="0.01 s are too long .* 400 1/s at t = 0 s: states"):
            wrong = run(dt=0.01, solver=solver)
        assert np.max(np.abs(wrong - right)) > 0.05
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        np.testing.assert_allclose(run(dt=0.002, solver="heun")[::5], right, atol=2e-3)


def test_limits_of_stability_are_those_of_the_schemes():
    for scheme, limit in ((dfx.Euler(), 2.0), (dfx.Heun(), 2.0), (RK4(), 2.785)):
        assert tableau_of(scheme).stability_limit() == pytest.approx(limit, abs=0.02)
