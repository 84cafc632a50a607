"""Race: two functions in turn, so that what else the machine does meets both."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any, NamedTuple

PATIENCE, MOST = 5.0, 31
"""Seconds for one pair of contestants, and rounds at most."""


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
        times.append((*seconds(one), *seconds(other)))
    return Result(
        statistics.median(wall for wall, *_ in times),
        statistics.median(a / b for a, _, b, _ in times),
        statistics.median(a / b for _, a, _, b in times),
        len(times),
    )


def seconds(function: Callable[[], Any]) -> tuple[float, float]:
    """That a call takes, of wall and of processor."""
    wall, cpu = time.perf_counter(), time.process_time()
    function()
    return time.perf_counter() - wall, time.process_time() - cpu
