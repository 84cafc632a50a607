"""A training as one of several processes, or on several devices of one: ``python -m tests.support.distributed ...``."""

import sys

import jax
import numpy as np

import acausal as ac
from tests.support.oscillator import learned, record


def trained(devices):
    """A short training on two records whose sequences the devices share."""
    return ac.fit(
        learned(),
        {"whole": record(), "part": record().between(3.0, 8.0)},
        "mass.a",
        sequence_length=0.25,
        batch_size=4,
        strategy=("sequences", "whole_record"),
        epochs=(12, 3),
        evaluate_every=5,
        modifiers=["mass.m"],
        per_record={"spring.c": 2.0},
        devices=devices,
        progress=False,
    )


def weights(fit):
    """All that was trained, as one vector."""
    leaves = jax.tree.leaves(fit.params["extra.net"])
    return np.concatenate([np.ravel(a) for a in leaves] + [[fit.modifiers["mass.m"], fit.loss]])


if __name__ == "__main__":
    target, address, count, number = sys.argv[1:]
    if int(count) > 1:
        jax.distributed.initialize(address, int(count), int(number))
    assert len(jax.devices()) == 2
    found = weights(trained(jax.devices()))
    if number == "0":
        np.save(target, found)
