"""Race: two functions in turn, so that what else the machine does meets both."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any, NamedTuple

PATIENCE, MOST, TURN = 8.0, 31, 0.1
"""Seconds for one pair of contestants, rounds at most, and seconds that a contestant runs in a row.

In a row as in a training: threads that slept while the other ran take a few calls to find a core of their own again.
"""


class Result(NamedTuple):
    """Medians over the rounds: seconds of the first, and its time over the second's in the same round.

    ``cpu`` is the same ratio of processor time, of all cores together: what else runs on them disturbs it less.
    """

    seconds: float
    ratio: float
    cpu: float
    rounds: int


def race(one: Callable[[], Any], other: Callable[[], Any]) -> Result:
    """Let both run in turn until patience ends, at least once; both are compiled already."""
    times: list[tuple[float, ...]] = []
    end = time.perf_counter() + PATIENCE
    while not times or (time.perf_counter() < end and len(times) < MOST):
        times.append((*_in_a_row(one), *_in_a_row(other)))
    return Result(
        statistics.median(wall for wall, *_ in times),
        statistics.median(a / b for a, _, b, _ in times),
        statistics.median(a / b for _, a, _, b in times),
        len(times),
    )


def _in_a_row(function: Callable[[], Any]) -> tuple[float, float]:
    """Mean over a turn's calls, of wall and of processor."""
    calls: list[tuple[float, float]] = []
    while sum(wall for wall, _ in calls) < TURN:
        calls.append(seconds(function))
    walls, cpus = zip(*calls, strict=True)
    return statistics.fmean(walls), statistics.fmean(cpus)


def seconds(function: Callable[[], Any]) -> tuple[float, float]:
    """That a call takes, of wall and of processor."""
    wall, cpu = time.perf_counter(), time.process_time()
    function()
    return time.perf_counter() - wall, time.process_time() - cpu
