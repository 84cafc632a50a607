"""Networks are called with as many scalars as they have inputs; nothing is broadcast."""

import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac

LAWS = [
    {},
    {"passive": True},
    {"monotone": True},
    {"passive": True, "input_scale": (1.0, 2.0)},
    {"monotone": True, "input_scale": (1.0, 2.0)},
    {"extrapolation": "linear", "odd": True},
]
ENERGIES = [{}, {"passive": True}, {"convex": True}, {"convex": True, "input_scale": (1.0, 2.0)}]
NETWORKS = [ac.networks.Law(secondary=1, **options)(0) for options in LAWS]
NETWORKS += [ac.networks.Energy(secondary=1, **options)(0) for options in ENERGIES]


@pytest.mark.parametrize("network", NETWORKS)
def test_missing_and_further_inputs_are_refused(network):
    assert jnp.shape(network(0.5, 1.0)) == ()
    law = getattr(network, "law", network)
    for call in (network, law):
        with pytest.raises(ac.DeclarationError, match=r"of 2 inputs is called with 1; give the o"):
            call(0.5)
        with pytest.raises(ac.DeclarationError, match=r"of 2 inputs is called with 3; leave out"):
            call(0.5, 1.0, 2.0)


@pytest.mark.parametrize("spec", [ac.networks.Law, ac.networks.Energy])
@pytest.mark.parametrize("scale", [0.4, (0.4, 2.5)])
def test_integers_are_numbers(spec, scale):
    """A fit scales each input by itself: integer scales would be zero."""
    network = spec(secondary=1, input_scale=scale, output_scale=2.0)(0)
    law = getattr(network, "law", network)
    for call in (network, law):
        assert call(1, -2) == call(1.0, -2.0) != call(0, 0) == call(0.0, 0.0)


@pytest.mark.parametrize("network", NETWORKS)
def test_a_law_of_several_inputs_is_not_distilled(network):
    with pytest.raises(ac.TrainingError, match=r"^distill: the network is not a law of one vari"):
        ac.distill(network, -1.0, 1.0, terms=1)


@pytest.mark.parametrize(
    "network",
    [
        ac.networks.Law(monotone=True)(0),
        ac.networks.Energy(convex=True)(0),
        ac.networks.Fourier(1.0),
        ac.Formula(("linear",), jnp.ones(1), jnp.ones(1)),
    ],
)
def test_a_second_input_of_a_law_of_one_is_not_ignored(network):
    with pytest.raises(ac.DeclarationError, match=r"of 1 input is called with 2; leave out the o"):
        network(0.5, 1.0)
    with pytest.raises(ac.DeclarationError, match=r"scalars, not an array of shape \(3,\); use"):
        network(jnp.ones(3))
    with pytest.raises(ac.DeclarationError, match="takes real numbers, not '1'"):
        network("1")


@pytest.mark.parametrize(
    "scales", [{"input_scale": "1"}, {"input_scale": 0.0}, {"output_scale": np.inf}]
)
def test_scales_are_positive_numbers(scales):
    with pytest.raises(ac.DeclarationError, match="are magnitudes; give positive numbers"):
        ac.MLP(**scales, key=0)


def test_a_network_without_a_key_says_where_keys_come_from():
    with pytest.raises(ac.DataError, match=r"give key=0.*ac\.Module\(lambda key: "):
        ac.networks.MLP()
