"""The changes that a confidence allows a law keep what the law promises."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.networks import Between, EnergyLaw, Even, Positive, Scaled, bounds_of, kept_promises
from acausal.reporting import Band
from acausal.training.uncertainty.bumps import Bumped, bumped_law
from acausal.training.uncertainty.laplace import _band

INF = float("inf")
SEEN = np.random.default_rng(0).normal(0.1, 0.4, (500, 1))
LAWS: dict[str, Any] = {
    "plain": ac.networks.Law(),
    "zero": ac.networks.Law(zero_crossing="offset"),
    "passive": ac.networks.Law(passive=True),
    "odd": ac.networks.Law(odd=True),
    "energy": ac.networks.Energy(),
    "odd energy": ac.networks.Energy(odd=True),
    "passive energy": ac.networks.Energy(passive=True),
    "even": lambda key: Even(ac.networks.MLP(1, key=jax.random.key(key))),
}


class Tanh(eqx.Module):
    """A law of a width."""

    width: float

    def __call__(self, x: jax.Array) -> jax.Array:
        return jnp.tanh(x / self.width)


def changed(name: str) -> Bumped:
    """A law with bumps of some height."""
    law = bumped_law(LAWS[name](0), SEEN)
    heights = jnp.asarray(np.random.default_rng(1).normal(size=len(law.heights)))
    return replace(law, heights=heights, stretched=None)


@pytest.mark.cases(fast=2, slow=6)
@pytest.mark.parametrize("name", LAWS)
def test_a_changed_law_keeps_its_promises(name: str) -> None:
    law, kept = changed(name), kept_promises(LAWS[name](0))
    x = jnp.asarray([0.05, 0.3, 0.9, -0.4])
    of_law = jax.jit(jax.vmap(law.law))
    here, there = of_law(x), of_law(-x)
    if "zero" in kept:
        assert abs(float(of_law(jnp.zeros(1))[0])) < 1e-12
    if "odd" in kept:
        np.testing.assert_allclose(there, -here, atol=1e-12)
    if "even" in kept:
        np.testing.assert_allclose(there, here, atol=1e-12)
    shapes = jax.jit(jax.vmap(law.bumps))(x)
    assert float(jnp.abs(shapes).max()) > 0.5


@pytest.mark.cases(fast=2, slow=6)
@pytest.mark.parametrize("name", LAWS)
def test_areas_are_the_energies_of_bumps(name: str) -> None:
    law = changed(name)
    both = jax.jit(lambda x: (jax.jacfwd(law.areas)(x), law.bumps(x)))
    for x in (-0.7, 0.02, 0.5):
        slope, bumps = both(jnp.asarray(x))
        np.testing.assert_allclose(slope, bumps, atol=1e-12)
    if isinstance(law.net, EnergyLaw):
        force = jax.grad(law)(jnp.asarray(0.3))
        assert float(force) == pytest.approx(float(law.law(jnp.asarray(0.3))))


def test_a_band_stays_on_the_side_that_is_promised() -> None:
    x = np.linspace(-2.0, 2.0, 5)
    band = Band(x, 0.5 * x, np.full(5, 0.75), np.sign(x))
    low, high = band.bounds
    np.testing.assert_allclose(low, [-2.5, -2.0, -1.5, 0.0, 0.0])
    np.testing.assert_allclose(high, [0.0, 0.0, 1.5, 2.0, 2.5])
    for once, twice in zip(band.bounds, reversed(band.times(-1.0).bounds), strict=True):
        np.testing.assert_allclose(once, -twice)


def test_the_band_of_a_law_that_never_falls_has_edges_that_never_fall():
    x = np.linspace(0, 1, 50)
    sigma = 0.2 + 0.2 * np.sin(20 * x)
    band = Band(x, 0.1 * x, sigma, rising=1)
    low, high = band.bounds
    assert (np.diff(low) >= 0).all()
    assert (np.diff(high) >= 0).all()
    assert (low <= band.law).all()
    assert (band.law <= high).all()
    assert (low >= band.law - 2 * sigma).all()
    low, high = band.times(-3.0).bounds
    assert (np.diff(low) <= 0).all()
    assert (np.diff(high) <= 0).all()
    assert (low <= -0.3 * x).all()
    assert (-0.3 * x <= high).all()


def test_the_band_of_a_bounded_law_ends_at_its_bounds():
    key = jax.random.key(0)
    net = Scaled(Between(ac.MLP(1, 4, 1, "tanh", key=key), -0.5, 1.0), output_scale=4.0)
    assert bounds_of(net) == (-2.0, 4.0)
    assert bounds_of(Scaled(Positive(net, 0.1), output_scale=-2.0)) == (-INF, -0.2)
    assert bounds_of(ac.MLP(1, 4, 1, "tanh", key=key)) == (-INF, INF)
    low, high = Band(np.zeros(3), np.zeros(3), np.full(3, 9.0), limits=bounds_of(net)).bounds
    assert low.tolist() == [-2.0] * 3
    assert high.tolist() == [4.0] * 3


@pytest.mark.slow
def test_bumps_are_narrow_where_a_law_is_steep() -> None:
    x = jnp.linspace(-1.5, 1.5, 1001)
    smooth, steep = (bumped_law(Tanh(width), SEEN) for width in (0.4, 0.02))
    assert smooth.stretched is None
    half = [float(jnp.sum(jax.vmap(steep.bumps)(x)[:, k] > 0.5)) for k in range(len(steep.centres))]
    at = np.asarray([float(x[np.argmax(jax.vmap(steep.bumps)(x)[:, k])]) for k in range(len(half))])
    assert min(half) < 0.1 * max(half)
    assert abs(at[np.argmin(half)]) < 0.05


@pytest.mark.slow
def test_bumps_of_several_arguments_are_products_and_few() -> None:
    seen = np.random.default_rng(0).normal(0.1, 0.4, (500, 5))
    laws = [bumped_law(ac.networks.Law(secondary=n)(0), seen[:, : n + 1]) for n in range(5)]
    assert [len(law.beside) for law in laws] == [1, 6, 16, 8, 16]
    assert all(len(law.heights) == len(law.centres) * len(law.beside) for law in laws)
    law = bumped_law(ac.networks.Law(secondary=1, odd=True)(0), seen[:, :2])
    here, there = (law.bumps(jnp.asarray(x), jnp.asarray(0.3)) for x in (0.2, -0.2))
    np.testing.assert_allclose(there, -here, atol=1e-12)
    assert np.linalg.matrix_rank(np.reshape(here, (len(law.centres), 6)), 1e-9) == 1
    still = np.stack([seen[:, 0], np.full(500, 0.6)], axis=1)
    assert float(bumped_law(laws[1].net, still).widths[0]) > 0.1


def test_an_energy_of_two_arguments_together_stays_odd_and_many_arguments_stay_few_bumps():
    law = ac.networks.Energy(inputs=2, odd=True)(0)
    bumped = bumped_law(law, np.random.default_rng(0).normal(size=(50, 2)))
    assert not np.isfinite(bumped.widths).any()
    for n, most in ((2, 72), (4, 192), (9, 192)):
        many = ac.networks.Law(secondary=n - 1)(0)
        assert len(bumped_law(many, np.random.default_rng(0).normal(size=(50, n))).heights) <= most


def test_the_band_of_an_energy_is_at_arguments_that_were_seen_near_their_mean():
    """These have no bumps of their own, and so no width by which nearness could be judged."""
    law = ac.networks.Energy(inputs=2)(0)
    seen = np.array([[0.0, 5.0], [1.0, 0.1], [-1.0, -5.0]])
    bumped = bumped_law(law, seen)
    change = SimpleNamespace(params={"law": law}, bumped={"law": bumped}, seen={"law": seen})
    n = len(bumped.heights)
    assert _band(change, "law", np.zeros(n), np.zeros((n, n)), np.zeros((1, n))).held == (0.1,)
