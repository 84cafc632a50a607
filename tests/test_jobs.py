"""Jobs on workers: results in order, errors as they were raised, lost workers replaced a few times."""

from __future__ import annotations

import logging
import multiprocessing
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from typing import Any

import pytest

import acausal as ac
from acausal.jobs import BLOCKS, REPEATS, blocks, need_workers, on_workers


class Here(Executor):
    """Does every task at once in this process; of some submissions the worker is lost."""

    def __init__(self, *lost: int) -> None:
        self.lost, self.count = lost, 0

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        if self.count in self.lost:
            future.set_exception(OSError("the node is gone"))
        else:
            future.set_result(fn(*args, **kwargs))
        self.count += 1
        return future


class Plain(Here):
    """Closes without options, as loky's pools do."""

    closed = False

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        assert not cancel_futures
        self.closed = True


class Broken(Executor):
    """A pool that a lost worker has broken: it takes no further task."""

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        raise BrokenProcessPool("a worker was lost")


def added(common: int, task: int) -> int:
    return common + task


def wrong(common: int, task: int) -> int:
    raise (ac.DataError("no such thing.") if task else KeyError(common))


class StubbornError(Exception):
    """An error that cannot be made of its message alone."""

    def __init__(self, one: int, other: int) -> None:
        super().__init__(f"{one} {other}")


def stubborn(common: int, task: int) -> int:
    raise StubbornError(common, task)


def test_results_are_in_the_order_of_the_tasks() -> None:
    with ThreadPoolExecutor(2) as pool:
        assert on_workers(pool, added, 10, [3, 1, 2], "sum") == [13, 11, 12]


def test_the_task_of_a_lost_worker_is_repeated_and_others_are_not(
    caplog: pytest.LogCaptureFixture,
) -> None:
    pool = Here(1)
    with caplog.at_level(logging.WARNING):
        assert on_workers(pool, added, 10, [1, 2, 3], "sum") == [11, 12, 13]
    assert pool.count == 4
    assert "task 2: OSError('the node is gone')" in caplog.text


def test_a_task_that_loses_every_worker_ends_the_call() -> None:
    with pytest.raises(ac.DataError, match=r"worker of task 1 of 1 was lost 4 times.*the node is"):
        on_workers(Here(*range(REPEATS + 1)), added, 10, [1], "sum")


def test_a_broken_pool_is_made_again() -> None:
    pools: list[Executor] = [Broken(), Here()]
    assert on_workers(lambda: pools.pop(0), added, 10, [1, 2], "sum") == [11, 12]
    with pytest.raises(ac.DataError, match="give a function that makes one, executor=lambda"):
        on_workers(Broken(), added, 10, [1, 2], "sum")


def test_a_pool_that_was_made_is_closed() -> None:
    made = Plain()
    assert on_workers(lambda: made, added, 10, [1], "sum") == [11]
    assert made.closed
    given = Plain()
    on_workers(given, added, 10, [1], "sum")
    assert not given.closed


def test_errors_of_tasks_are_raised_as_they_were() -> None:
    with pytest.raises(ac.DataError, match=r"^no such thing\.$"):
        on_workers(Here(), wrong, 10, [1], "sum")
    with pytest.raises(KeyError) as raised:
        on_workers(Here(), wrong, 10, [0], "sum")
    assert "in wrong" in raised.value.__notes__[0]
    with pytest.raises(RuntimeError, match="StubbornError on a worker"):
        on_workers(Here(), stubborn, 10, [1], "sum")


def test_what_cannot_be_sent_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "cloudpickle", None)
    shared: dict[str, Any] = {"common": lambda: 1}
    with pytest.raises(ac.DataError, match=r"sum: the task cannot be sent to workers: .*lambda"):
        on_workers(Here(), added, tasks=[1], name="sum", **shared)


@pytest.mark.parametrize("given", [2, "processes"])
def test_what_is_no_executor_is_refused(given: Any) -> None:
    with pytest.raises(ac.DataError, match=r"sweep: executor=.* is neither an executor nor"):
        need_workers(given, "sweep")


def test_processes_that_fork_are_refused() -> None:
    forked, spawned = (
        ProcessPoolExecutor(1, mp_context=multiprocessing.get_context(method))
        for method in ("fork", "spawn")
    )
    with pytest.raises(ac.DataError, match="forks its processes, in which JAX can hang"):
        need_workers(forked, "sweep")
    need_workers(spawned, "sweep")


@pytest.mark.parametrize("count", [1, BLOCKS, BLOCKS + 1, 1000])
def test_blocks_hold_everything_once(count: int) -> None:
    found = blocks(count)
    assert [i for block in found for i in block] == list(range(count))
    assert len(found) <= BLOCKS
    assert len({len(block) for block in found[:-1]} | {len(found[0])}) == 1
