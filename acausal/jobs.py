"""Jobs: tasks of one call on the workers of an executor. Tasks of lost workers are repeated.

Any `concurrent.futures.Executor` serves: a pool of processes, Dask (``Client.get_executor()``), MPI, loky. Workers get
bytes and return bytes. What all tasks share is unpickled once by each worker, so that what it has compiled for one task
serves the next. The bytes come from this program, not from files, and go to workers that the user has started.
"""

from __future__ import annotations

import gc
import logging
import pickle
import traceback
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future, as_completed
from contextlib import contextmanager
from functools import lru_cache
from importlib import import_module
from typing import Any, TypeVar

from acausal.errors import AcausalError, DataError, shortened, shown

LOGGER = logging.getLogger(__name__)

Workers = Executor | Callable[[], Executor]
"""An executor; or a function that makes one, called again where a lost worker has broken it, and closed at the end."""

REPEATS = 3
"""How often a task whose worker was lost is given to another one."""

BLOCKS = 32
"""Tasks of many alike things, such as variants: enough that no worker waits long for the last one."""

Common = TypeVar("Common")
Task = TypeVar("Task")
Result = TypeVar("Result")


def need_workers(given: object, function: str, error: type[AcausalError] = DataError) -> None:
    """Refuse what runs no tasks, and processes that are forked: JAX's threads do not survive it.

    Raises:
        AcausalError: of the class ``error``.
    """
    if not (hasattr(given, "submit") or callable(given)):
        raise error(
            f"{function}: executor={shown(given)} is neither an executor nor a function that makes one; give a "
            "concurrent.futures.ProcessPoolExecutor, for example."
        )
    context = getattr(given, "_mp_context", None)
    if context is not None and context.get_start_method() == "fork":
        raise error(
            f"{function}: the executor forks its processes, in which JAX can hang; give a "
            "ProcessPoolExecutor(mp_context=multiprocessing.get_context('spawn'))."
        )


def on_workers(
    executor: Workers,
    work: Callable[[Common, Task], Result],
    common: Common,
    tasks: Sequence[Task],
    name: str,
    *,
    progress: bool = True,
) -> list[Result]:
    """The result of ``work(common, task)`` for every task, in their order.

    Arguments:
        executor: whose workers do them.
        work: a function of a module, which workers import.
        common: what all tasks share. tasks: the rest. Both are pickled, by cloudpickle where that is installed.
        name: of the call, for messages and progress.
        progress: whether a terminal shows how many tasks are done; they are logged in any case.

    Raises:
        DataError: for what cannot be pickled here or unpickled there, and for a task whose worker was lost once more
            than `REPEATS` times.
        Exception: what a task has raised. Tasks that have not begun are given up then, and after Ctrl-C.
    """
    shared, sent = _packed(common, name), [_packed((work, task), name) for task in tasks]
    found: dict[int, Result] = {}
    lost: dict[int, Exception] = {}
    with _shown(name, len(tasks), progress) as advance:
        for _ in range(REPEATS + 1):
            left = [i for i in range(len(tasks)) if i not in found]
            with _open(executor, name) as pool:
                lost = _round(pool, shared, {i: sent[i] for i in left}, found, advance)
            if not lost:
                return [found[i] for i in range(len(tasks))]
            first, reason = next(iter(lost.items()))
            LOGGER.warning(
                "%s: %d workers or tasks were lost, the first of task %d: %r",
                name, len(lost), first + 1, reason,
            )  # fmt: skip
    first, reason = next(iter(lost.items()))
    renewed = "" if not isinstance(reason, BrokenExecutor) or not hasattr(executor, "submit") else (
        " A pool that a lost worker has broken stays so: give a function that makes one, executor=lambda: ..."
    )  # fmt: skip
    raise DataError(
        f"{name}: the worker of task {first + 1} of {len(tasks)} was lost {REPEATS + 1} times, at last by "
        f"{type(reason).__name__}: {shortened(reason, 200)}.{renewed}"
    ) from reason


def blocks(count: int) -> list[range]:
    """Places of so many things in at most `BLOCKS` blocks, all of one length but the last."""
    size = max(1, -(-count // BLOCKS))
    return [range(first, min(first + size, count)) for first in range(0, count, size)]


def _round(
    pool: Executor,
    shared: bytes,
    sent: dict[int, bytes],
    found: dict[int, Any],
    advance: Callable[[], None],
) -> dict[int, Exception]:
    """Let workers do some tasks; returns those whose worker was lost.

    A task's own error comes back as its result, so whatever a future raises is the loss of its worker.
    """
    lost: dict[int, Exception] = {}
    futures: dict[Future[bytes], int] = {}
    try:
        for i, task in sent.items():
            try:
                futures[pool.submit(_done, shared, task)] = i
            except BrokenExecutor as error:
                lost[i] = error
        for future in as_completed(futures):
            try:
                result, error = pickle.loads(future.result())
            except Exception as gone:
                lost[futures[future]] = gone
                continue
            if error is not None:
                raise error
            found[futures[future]] = result
            advance()
    finally:
        for future in futures:
            future.cancel()
    return lost


def _done(shared: bytes, sent: bytes) -> bytes:
    """On a worker: the result of a task and its error, pickled."""
    try:
        common, (work, task) = _received(shared), _unpacked(sent)
        return _dumps((work(common, task), None))
    except Exception as error:
        if not isinstance(error, AcausalError):
            error.add_note(f"On a worker:\n{traceback.format_exc()}")
        try:
            pickle.loads(pickle.dumps(error))
        except Exception:
            error = RuntimeError(f"{type(error).__name__} on a worker:\n{traceback.format_exc()}")
        return pickle.dumps((None, error))


def _unpacked(sent: bytes) -> Any:
    try:
        return pickle.loads(sent)
    except (AttributeError, ImportError) as error:
        raise DataError(
            f"A worker cannot read its task: {error}. Define the model's classes and functions in a module that "
            "workers can import."
        ) from error


_received = lru_cache(maxsize=2)(_unpacked)


def _packed(thing: object, name: str) -> bytes:
    try:
        return _dumps(thing)
    except (AttributeError, TypeError, pickle.PicklingError) as error:
        raise DataError(
            f"{name}: the task cannot be sent to workers: {error}. Define functions and classes in a module, or "
            "install cloudpickle."
        ) from error


def _dumps(thing: object) -> bytes:
    try:
        found: Any = import_module("cloudpickle")  # which also takes functions of a notebook
    except ImportError:
        found = pickle
    return found.dumps(thing)


@contextmanager
def _open(executor: Workers, name: str) -> Generator[Executor]:
    """The executor; one that is made here is closed."""
    if not callable(executor):
        yield executor
        return
    pool = executor()
    need_workers(pool, name)
    try:
        yield pool
    finally:
        pool.shutdown()  # its futures are done or cancelled


@contextmanager
def _shown(name: str, count: int, progress: bool) -> Generator[Callable[[], None]]:
    """A bar of the tasks that are done, in a terminal."""
    from rich.console import Console
    from rich.progress import Progress

    console, done = Console(stderr=True), 0
    with Progress(console=console, disable=not (progress and console.is_terminal)) as bar:
        task = bar.add_task(name, total=count)

        def advance() -> None:
            nonlocal done
            done += 1
            bar.advance(task)
            LOGGER.debug("%s: %d of %d tasks done", name, done, count)

        yield advance


@contextmanager
def collection_paused() -> Generator[None]:
    """No search for cyclic garbage while a model or a program is built: of all that is made there, next to none is."""
    if not gc.isenabled():
        yield
        return
    gc.disable()
    try:
        yield
    finally:
        gc.enable()
