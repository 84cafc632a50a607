"""Read sequences ahead: those of the next updates, from records that do not fit in memory."""

from __future__ import annotations

import math
from collections.abc import Generator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from threading import Event
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jax.sharding import NamedSharding, PartitionSpec
from jaxtyping import Array, Bool, Int, PRNGKeyArray

from acausal._jax import compiled
from acausal.training.objective.problem import Problem
from acausal.training.objective.sequences import ReadSequences, any_of
from acausal.training.objective.sharding import SEQUENCES, replicate
from acausal.training.optimizers.trainer import update_key

BYTES = 2**26
"""What the sequences that are read at a time may take. They are those of as many updates as that is, so that every file
is read once for all of them."""


class Ready(NamedTuple):
    """A problem whose batches can be drawn, and the update until which they can."""

    problem: Problem
    until: float


def read_ahead(
    problem: Problem, key: PRNGKeyArray, since: int, epochs: int
) -> Generator[Ready, None, None]:
    """The problem with the sequences of its next updates, again and again; a thread reads those after them meanwhile.

    Arguments:
        problem: of a part of a training. With its records in memory, it is ready for all updates.
        key: source of its batches.
        since: updates done; ``epochs``: all of them.

    Raises:
        DataError: for a record that can be read no more.
    """
    streamed = problem.streamed
    if streamed is None:
        yield Ready(problem, math.inf)
        return
    size, stop = _updates_at_a_time(problem, epochs), Event()

    def read(since: int) -> Ready:
        updates = jnp.arange(since, since + size)
        count = int(streamed.counts(problem.sequences.length).sum())
        chosen = np.asarray(_chosen(key, updates, count, problem.sequences.batch_size))
        sequences = replace(problem.sequences, read=_read(problem, since, chosen, stop))
        return Ready(replace(problem, sequences=sequences), since + size)

    with ThreadPoolExecutor(1) as thread:
        try:
            coming = thread.submit(read, since)
            while since < epochs:
                ready = coming.result()
                since += size
                if since < epochs:
                    coming = thread.submit(read, since)
                yield ready
        finally:
            stop.set()


def _updates_at_a_time(problem: Problem, epochs: int) -> int:
    """As many as take `BYTES`, in parts of one size, because a program is compiled for each."""
    records, sequences = problem.records, problem.sequences
    laid_out = sum(a.nbytes for a in jax.tree.leaves((records.steps, records.y, records.weight)))
    an_update = laid_out / len(records) * sequences.length * sequences.batch_size
    return math.ceil(epochs / math.ceil(epochs / max(1, int(BYTES / an_update))))


@compiled
def _chosen(
    key: PRNGKeyArray, updates: Int[Array, " n_updates"], count: int, batch_size: int
) -> Int[Array, "n_updates batch"]:
    """Which of so many starts the sequences of updates have, as `Sequences.draw` draws them."""

    def one(update: Int[Array, ""]) -> Int[Array, " batch"]:
        return any_of(count, jax.random.split(update_key(key, update))[0], batch_size)

    return jax.vmap(one)(updates)


def _read(
    problem: Problem, since: int, chosen: Int[np.ndarray, "n_updates batch"], stop: Event
) -> ReadSequences:
    """The sequences of updates, file by file; of several processes, each reads those of its own devices."""
    streamed, length, mesh = problem.streamed, problem.sequences.length, problem.mesh
    assert streamed is not None
    ends = np.cumsum(streamed.counts(length))
    record = np.searchsorted(ends, chosen, side="right")
    nth, mine = chosen - np.append(0, ends)[record], np.flatnonzero(_own_columns(problem))
    start = np.zeros_like(chosen)
    found: Any = None
    shape = len(chosen), len(mine)
    for k in np.unique(record).tolist():
        if stop.is_set():
            break
        at = np.nonzero(record == k)
        first = streamed.starts(k, length)[nth[at]]
        start[at] = streamed.first[k] + first
        own = np.isin(at[1], mine)
        if not own.any():
            continue
        part = streamed.windows(problem, k, first[own], length)
        if found is None:
            found = jax.tree.map(lambda a: np.zeros((*shape, *a.shape[1:]), a.dtype), part)
        columns = np.searchsorted(mine, at[1][own])
        jax.tree.map(partial(_fill, (at[0][own], columns)), found, part)
    if mesh is None:
        return ReadSequences(*jax.tree.map(jnp.asarray, (since, start, found)))
    shares = NamedSharding(mesh, PartitionSpec(None, SEQUENCES))
    found = jax.tree.map(partial(jax.make_array_from_process_local_data, shares), found)
    return ReadSequences(*replicate((jnp.asarray(since), jnp.asarray(start)), mesh), found)


def _fill(at: tuple[np.ndarray, np.ndarray], whole: np.ndarray, part: np.ndarray) -> None:
    whole[at] = part


def _own_columns(problem: Problem) -> Bool[np.ndarray, " batch"]:
    """The sequences of a batch that devices of this process compute."""
    if problem.mesh is None:
        return np.ones(problem.sequences.batch_size, bool)
    here = [d.process_index == jax.process_index() for d in problem.mesh.devices.flat]
    return np.repeat(here, problem.sequences.batch_size // len(here))
