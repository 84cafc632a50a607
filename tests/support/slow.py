"""Cases of a test of which some are slow."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import Any

import pytest


def some_slow(cases: Iterable[Any], slow: Collection[Any]) -> list[Any]:
    """The cases for ``parametrize``; those that stand in ``slow``, too, run with the slow tests."""
    return [pytest.param(c, marks=pytest.mark.slow) if c in slow else c for c in cases]


def all_slow_but(quick: str, cases: Iterable[str]) -> list[Any]:
    """The cases for ``parametrize``; all but one run with the slow tests."""
    cases = list(cases)
    return some_slow(cases, [c for c in cases if c != quick])


def in_turn(cases: Iterable[str], n: int, first: int = 0) -> list[Any]:
    """The cases for ``parametrize``; one in n runs with the slow tests, the others with `make test-machines`."""
    return [
        pytest.param(c, marks=pytest.mark.slow if k % n == first else pytest.mark.machines)
        for k, c in enumerate(cases)
    ]
