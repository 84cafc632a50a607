"""A training as one of several processes, or on several devices of one: ``python -m tests.support.distributed ...``."""

import sys
from functools import partial

import jax
import numpy as np

import acausal as ac
from acausal.training.objective.streamed import Streamed
from tests.support.oscillator import learned, record


def trained(devices, *, streamed=False):
    """A short training on two records whose sequences the devices share; records in memory, or read when needed."""
    records = {"whole": record(), "part": record().between(3.0, 8.0)}
    sources = {name: partial(records.__getitem__, name) for name in records}
    parts = ("sequences",) if streamed else ("sequences", "whole_record")
    return ac.fit(
        learned(),
        ac.Data.stream(sources) if streamed else records,
        "mass.a",
        sequence_length=0.25,
        batch_size=4,
        strategy=parts,
        epochs=(12, 3)[: len(parts)],
        evaluate_every=5,
        modifiers=["mass.m"],
        per_record={"spring.c": 2.0},
        devices=devices,
        progress=False,
    )


def sequences_read(devices):
    """The same of a stream, and how many sequences this process has read."""
    read, counts = Streamed.windows, []

    def counted(self, training, number, first, length):
        counts.append(len(first))
        return read(self, training, number, first, length)

    Streamed.windows = counted
    return trained(devices, streamed=True), sum(counts)


def weights(fit):
    """All that was trained, as one vector."""
    leaves = jax.tree.leaves(fit.params["extra.net"])
    return np.concatenate([np.ravel(a) for a in leaves] + [[fit.modifiers["mass.m"], fit.loss]])


if __name__ == "__main__":
    target, address, count, number = sys.argv[1:]
    if int(count) > 1:
        jax.distributed.initialize(address, int(count), int(number))
    assert len(jax.devices()) == 2
    streamed, read = sequences_read(jax.devices())
    assert read == 12 * 4 // int(count)
    found = np.stack([weights(trained(jax.devices())), weights(streamed)])
    if number == "0":
        np.save(target, found)
