"""Race: two functions in turn, so that what else the machine does meets both."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any, NamedTuple

PATIENCE, MOST = 8.0, 31
"""Seconds for one pair of contestants, and rounds at most."""


class Result(NamedTuple):
    """Medians over the rounds: seconds of the first, and its time over the second's in the same round."""

    seconds: float
    ratio: float
    rounds: int


def race(one: Callable[[], Any], other: Callable[[], Any]) -> Result:
    """Let both run in turn until patience ends, at least once; both are compiled already."""
    times: list[tuple[float, float]] = []
    end = time.perf_counter() + PATIENCE
    while not times or (time.perf_counter() < end and len(times) < MOST):
        times.append((_seconds(other), _seconds(one)))
    mine = [b for _, b in times]
    return Result(statistics.median(mine), statistics.median(b / a for a, b in times), len(times))


def _seconds(function: Callable[[], Any]) -> float:
    start = time.perf_counter()
    function()
    return time.perf_counter() - start
