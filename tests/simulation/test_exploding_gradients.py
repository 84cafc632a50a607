"""Steps far outside the solver's region of stability: states stay finite, derivatives do not."""

import warnings

import jax
import numpy as np
import pytest

import acausal as ac
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
