"""What networks say that they promise, against what was asked of them."""

import equinox as eqx
import jax
import pytest

import acausal as ac
from acausal.networks import Energy, Law, promises_of
from acausal.networks.promises import WORDS

KEY = jax.random.key(0)

LAWS = [
    ({}, set()),
    ({"odd": True}, {"odd", "zero"}),
    ({"monotone": True}, {"monotone"}),
    ({"passive": True}, {"passive", "zero"}),
    ({"passive": True, "odd": True}, {"passive", "odd", "zero"}),
    ({"monotone": True, "odd": True}, {"monotone", "odd", "zero"}),
    ({"monotone": True, "passive": True, "floor": 0.1}, {"monotone", "passive", "zero"}),
    ({"monotone": True, "passive": True, "odd": True}, {"monotone", "passive", "odd", "zero"}),
    ({"zero_crossing": "exact"}, {"zero"}),
    ({"zero_crossing": "offset"}, {"zero"}),
    ({"odd": True, "extrapolation": "linear"}, {"odd", "zero"}),
    ({"passive": True, "extrapolation": "linear"}, {"passive", "zero"}),
]

ENERGIES = [
    ({}, {"energy"}),
    ({"odd": True}, {"energy", "odd", "zero"}),
    ({"passive": True}, {"energy", "passive", "zero"}),
    ({"zero_crossing": "exact"}, {"energy", "zero"}),
    ({"convex": True}, {"energy", "monotone"}),
    ({"convex": True, "passive": True}, {"energy", "monotone", "passive", "zero"}),
    ({"convex": True, "odd": True, "floor": 0.1}, {"energy", "monotone", "passive", "odd", "zero"}),
    ({"convex": True, "passive": True, "inputs": 2}, {"energy", "passive", "zero"}),
]


def named(network):
    words = {text: name for name, text in WORDS.items()}
    return {words[text] for text in promises_of(network)}


@pytest.mark.parametrize(("options", "promised"), LAWS)
def test_laws(options, promised):
    assert named(Law(**options)(KEY)) == promised


@pytest.mark.parametrize(("options", "promised"), ENERGIES)
def test_energies(options, promised):
    assert named(Energy(**options)(KEY)) == promised


def test_the_removed_offset_is_told():
    net = ac.MLP(key=KEY)
    assert named(net) == set()
    assert named(ac.remove_offset({"net": net})["net"]) == {"zero"}


def test_a_wrapper_of_your_own_promises_nothing():
    class Mine(eqx.Module):
        net: eqx.Module

        def __call__(self, x):
            return self.net(x) + x**2

    assert named(Mine(Law(odd=True)(KEY))) == set()
