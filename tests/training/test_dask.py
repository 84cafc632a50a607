"""Dask's workers, of which one is killed in the middle: the result is that of this process."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from concurrent.futures import Executor, Future
from typing import Any

import numpy as np
import pytest

import acausal as ac
from tests.support.oscillator import plain

distributed: Any = pytest.importorskip("distributed", reason="distributed is not installed")

OVER = {"spring.c": np.linspace(40.0, 80.0, 64), "push.f": [5.0, 10.0]}


class Killing(Executor):
    """Another executor, of whose workers one is killed as soon as a task is done."""

    def __init__(self, other: Executor, worker: int) -> None:
        self.other, self.worker = other, worker
        self.killed = False

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        future = self.other.submit(fn, *args, **kwargs)
        future.add_done_callback(self.kill)
        return future

    def kill(self, done: Future[Any]) -> None:
        if not self.killed:
            self.killed = True
            os.kill(self.worker, signal.SIGKILL)


@pytest.fixture
def client() -> Iterator[Any]:
    given: dict[str, Any] = {"threads_per_worker": 1, "dashboard_address": None}
    with (
        distributed.LocalCluster(n_workers=2, processes=True, **given) as cluster,
        distributed.Client(cluster) as found,
    ):
        yield found


@pytest.mark.slow
def test_a_sweep_outlives_a_worker(client: Any) -> None:
    workers = client.run(os.getpid)
    assert len(workers) == 2
    killing = Killing(client.get_executor(), next(iter(workers.values())))
    found = ac.sweep(plain(), OVER, 1.0, dt=0.02, executor=killing)
    assert killing.killed
    here = ac.sweep(plain(), OVER, 1.0, dt=0.02)
    np.testing.assert_allclose(found["spring.f"], here["spring.f"], rtol=1e-12, atol=1e-12)
