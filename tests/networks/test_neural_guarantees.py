"""What networks promise holds for random and adversarial weights and inputs, before, during and after training."""

import functools
import itertools
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from acausal.networks import Energy, Law, law_of

SCALE, OUT = 0.5, 20.0
LIMITS = 1.2
"""Of the laws under test: input scale, output scale, limits of what is extrapolated."""
TINY, HUGE = 1e-30, 1e6 * SCALE
PLACES = (0.0, -0.0, TINY, -TINY, LIMITS, -LIMITS, HUGE, -HUGE)
MODULES = 3
"""Networks that are tried side by side."""


def combinations(recipe: Any, flags: tuple[str, ...], **more: Any) -> dict[str, Any]:
    """Recipes with every combination of promises, some of them extrapolated, every other with a secondary input."""
    found: dict[str, Any] = {}
    for on in itertools.product((False, True), repeat=len(flags)):
        chosen = dict(zip(flags, on, strict=True))
        name = " ".join(n for n, wanted in chosen.items() if wanted) or "free"
        given = {**chosen, **more, "input_scale": SCALE, "output_scale": OUT}
        found[name] = recipe(**given, secondary=sum(on) % 2)
        if sum(on) in (0, 3) or name in ("passive monotone", "odd"):
            for beyond in (("linear", "saturating")[sum(on) % 2], "cubic"):
                found[f"{name} {beyond}"] = recipe(**given, extrapolation=beyond, limits=LIMITS)
    return found


def zero_crossings(recipe: Any, **more: Any) -> dict[str, Any]:
    """Recipes of laws that vanish at zero."""
    return {
        " ".join((zero, *more)): recipe(
            **more, zero_crossing=zero, input_scale=SCALE, output_scale=OUT
        )
        for zero in ("offset", "exact")
    }


LAWS: dict[str, Law] = {
    **combinations(Law, ("passive", "monotone", "odd")),
    **zero_crossings(Law),
    **zero_crossings(Law, monotone=True),
    "bent monotone": Law(
        monotone=True, activation="tanh", floor=0.1, start=1.0, input_scale=SCALE, output_scale=OUT
    ),
}
ENERGIES: dict[str, Energy] = {
    **combinations(Energy, ("passive", "convex", "odd")),
    **zero_crossings(Energy),
    **zero_crossings(Energy, convex=True),
    "curved convex": Energy(
        convex=True, activation="elu", floor=0.1, start=1.0, input_scale=SCALE, output_scale=OUT
    ),
}
SINGLE = (
    "passive",
    "odd",
    "monotone",
    "passive monotone odd saturating",
    "passive monotone odd cubic",
    "convex",
    "passive convex",
)
"""Those that are tried in single precision, too."""


def tried(recipes: dict[str, Any]) -> list[Any]:
    """Recipes and precisions."""
    single = [n for n in recipes if n in SINGLE]
    return [*((n, "float64") for n in recipes), *((n, "float32") for n in single)]


@functools.cache
def fresh(recipe: Any, dtype: str) -> Any:
    """Networks side by side, their weights along a leading axis."""
    made = jax.vmap(recipe)(jax.random.split(jax.random.key(0), MODULES))
    return jax.tree.map(lambda a: a.astype(dtype) if eqx.is_inexact_array(a) else a, made)


def weighted(recipe: Any, dtype: str, seed: int, exponent: float, kind: str) -> Any:
    """The networks with other weights: normal ones, all alike, only the last layers, none."""
    generator = np.random.default_rng(seed)

    def other(leaf: Any) -> Any:
        if not eqx.is_inexact_array(leaf):
            return leaf
        drawn = {
            "normal": lambda: generator.standard_normal(leaf.shape),
            "alike": lambda: np.full(leaf.shape, generator.choice([-1.0, 1.0])),
            "sparse": lambda: (
                generator.standard_normal(leaf.shape) * (generator.random(leaf.shape) < 0.3)
            ),
            "none": lambda: np.zeros(leaf.shape),
        }[kind]()
        return jnp.asarray(drawn * 10.0**exponent, dtype)

    return jax.tree.map(other, fresh(recipe, dtype))


@functools.cache
def compiled(recipe: Any) -> Any:
    """Law, derivative and curvature of the networks, and the energy if there is one, at many inputs."""

    def at(net: Any, x: Any, T: Any) -> Any:
        others = (T,) * recipe.secondary
        derivative = jax.grad(lambda x: law_of(net)(x, *others))
        curvature = jax.grad(derivative)
        return law_of(net)(x, *others), derivative(x), curvature(x), net(x, *others)

    return eqx.filter_jit(
        lambda nets, x, T: eqx.filter_vmap(lambda net: jax.vmap(lambda a, b: at(net, a, b))(x, T))(
            nets
        )
    )


def magnitude(recipe: Any, net: Any, x: Any) -> Any:
    """A bound, for each input, on the numbers that are added up in a network: rounding errors are relative to it."""
    power = 3 if recipe.extrapolation == "cubic" else 1
    bound = (1 + np.abs(x.astype(float)) / SCALE) ** power
    for leaf in jax.tree.leaves(eqx.filter(net, eqx.is_inexact_array)):
        bound = bound * (1 + np.max(np.sum(np.abs(np.asarray(leaf, float)), axis=-1)))
    return OUT * bound


weights = st.tuples(
    st.integers(0, 2**16),
    st.floats(-3, 3),
    st.sampled_from(["normal", "normal", "alike", "sparse", "none"]),
)
inputs = st.lists(
    st.one_of(st.floats(-3, 3), st.floats(-HUGE, HUGE), st.sampled_from(PLACES)),
    min_size=8,
    max_size=8,
)


def points(drawn: list[float]) -> np.ndarray:
    """Inputs in ascending order, with their mirror images and the adversarial ones."""
    return np.unique(np.concatenate([drawn, np.negative(drawn), PLACES]))


def padded(x: np.ndarray, n: int = 32) -> np.ndarray:
    """As many inputs as there is a program for."""
    return np.concatenate([x, np.full(n - len(x), x[-1])])


def looked_at(recipe: Any, nets: Any, drawn: list[float], T: float, dtype: str) -> Any:
    """Inputs, law, derivative, curvature and energy there; bounds of rounding errors."""
    x = padded(points(drawn)).astype(dtype)
    found = [np.asarray(a) for a in compiled(recipe)(nets, x, np.full_like(x, T))]
    assert all(a.dtype == dtype for a in found)
    assert all(np.isfinite(a).all() for a in found)
    return x, *found, 10 * np.finfo(dtype).eps * magnitude(recipe, nets, x)


def check_symmetry_and_zero(recipe: Any, nets: Any, x: Any, F: Any, T: float, noise: Any) -> None:
    if recipe.odd:
        mirrored = np.asarray(compiled(recipe)(nets, -x, np.full_like(x, T))[0])
        assert (np.abs(F + mirrored) <= noise).all()
    if recipe.vanishes:
        assert (np.abs(F) <= noise)[:, x == 0].all()


@pytest.mark.cases(fast=5)
@pytest.mark.parametrize(("name", "dtype"), tried(LAWS))
def test_laws(name: str, dtype: str) -> None:
    recipe = LAWS[name]

    @settings(max_examples=15)
    @given(weights=weights, drawn=inputs, T=st.floats(-1e3, 1e3))
    def check(weights: Any, drawn: Any, T: float) -> None:
        nets = weighted(recipe, dtype, *weights)
        x, F, derivative, _, _, noise = looked_at(recipe, nets, drawn, T, dtype)
        check_symmetry_and_zero(recipe, nets, x, F, T, noise)
        exact = recipe.passive or recipe.zero_crossing == "exact"
        assert not exact or (F[:, x == 0] == 0).all()
        if recipe.passive:
            assert (F * x >= 0).all()
        if recipe.monotone:
            assert (derivative >= recipe.floor * OUT / SCALE * (np.abs(x) <= HUGE / 2)).all()
            assert (np.diff(F, axis=1) >= -noise[1:] - noise[:-1]).all()

    check()


@pytest.mark.cases(fast=3)
@pytest.mark.parametrize(("name", "dtype"), tried(ENERGIES))
def test_energies(name: str, dtype: str) -> None:
    recipe = ENERGIES[name]

    @settings(max_examples=15)
    @given(weights=weights, drawn=inputs, T=st.floats(-1e3, 1e3))
    def check(weights: Any, drawn: Any, T: float) -> None:
        nets = weighted(recipe, dtype, *weights)
        x, F, derivative, _, W, noise = looked_at(recipe, nets, drawn, T, dtype)
        check_symmetry_and_zero(recipe, nets, x, F, T, noise)
        uncertain = noise * (SCALE + np.abs(x))
        assert (np.abs(W) <= uncertain)[:, x == 0].all()
        if recipe.passive:
            assert (-uncertain <= W).all()
            assert (F[:, x == 0] == 0).all() or recipe.convex
        if recipe.convex:
            assert (derivative >= recipe.floor * OUT / SCALE).all()
            assert (np.diff(F, axis=1) >= -noise[1:] - noise[:-1]).all()
            if recipe.vanishes:
                assert (F * x >= -uncertain).all()

    check()


def test_what_promises_nothing_keeps_nothing() -> None:
    """The checks above can fail."""
    net = weighted(LAWS["free"], "float64", 0, 0.0, "normal")
    x = np.linspace(-3, 3, 32)
    F, derivative, *_ = (np.asarray(a) for a in compiled(LAWS["free"])(net, x, x))
    noise = 10 * np.finfo(float).eps * magnitude(LAWS["free"], net, x)
    assert (F * x < -noise).any()
    assert (derivative < 0).any()
    assert (np.diff(F, axis=1) < -noise[1:] - noise[:-1]).any()
    assert (np.abs(F + F[:, ::-1]) > noise).any()
