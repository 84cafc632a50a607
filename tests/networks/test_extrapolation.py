"""How laws and energies go on beyond their limits."""

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.networks import Continued, ContinuedEnergy

X = np.linspace(-4, 4, 80)
LIMITS = (-0.5, 0.7)


def looked_at(function: Callable[..., Any]) -> tuple[np.ndarray, ...]:
    """Value, derivative and second derivative at all inputs."""
    derivative = jax.grad(function)
    found = (jax.jit(jax.vmap(f))(X) for f in (function, derivative, jax.grad(derivative)))
    return tuple(np.asarray(y) for y in found)


def duffing(x: Any) -> Any:
    return 0.3 + 2 * x + 5 * x**3


def energy(x: Any) -> Any:
    return 0.1 + 0.3 * x + x**2 + 5 / 4 * x**4


def test_a_cube_goes_on_as_itself() -> None:
    for whole, part in ((duffing, Continued), (energy, ContinuedEnergy)):
        for true, found in zip(
            looked_at(whole), looked_at(part(whole, *LIMITS, "cubic")), strict=True
        ):
            np.testing.assert_allclose(found, true, rtol=1e-12, atol=1e-12)


def test_a_law_that_softens_goes_on_along_its_tangent() -> None:
    cubic, linear = (Continued(jnp.tanh, -1.0, 1.0, how) for how in ("cubic", "linear"))
    for one, other in zip(looked_at(cubic), looked_at(linear), strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("how", ["saturating", "linear", "cubic"])
def test_the_derivative_of_an_energy_goes_on_as_a_law(how: Any) -> None:
    law, whole = Continued(duffing, *LIMITS, how), ContinuedEnergy(energy, *LIMITS, how)
    values, derivatives, _ = looked_at(law)
    _, forces, stiffness = looked_at(whole)
    np.testing.assert_allclose(forces, values, rtol=1e-12)
    np.testing.assert_allclose(stiffness, derivatives, rtol=1e-12, atol=1e-12)


def test_a_passive_law_that_falls_goes_on_level() -> None:
    hill = lambda x: x * jnp.exp(-(x**2))  # noqa: E731
    for how in ("linear", "cubic"):
        values, *_ = looked_at(Continued(hill, -1.0, 1.0, how, rising=True))
        assert (values * X >= 0).all()
        np.testing.assert_allclose(values[X >= 1], np.exp(-1))
        falling, *_ = looked_at(Continued(hill, -1.0, 1.0, how))
        assert (falling * X < 0).any()


def test_limits_that_are_none_are_refused() -> None:
    with pytest.raises(ac.DeclarationError, match="the first must be less than the second"):
        Continued(jnp.sin, 1.0, -1.0)
    with pytest.raises(ac.DeclarationError, match="about zero, which must lie between its limits"):
        ContinuedEnergy(jnp.cosh, 0.0, 1.0, "cubic")
