"""Cases of a test of which some are slow."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import Any

import pytest


def some_slow(
    cases: Iterable[Any], slow: Collection[Any], machines: Collection[Any] = ()
) -> list[Any]:
    """The cases for ``parametrize``, tuples for several names: those in ``slow`` run with the slow tests.

    Those in ``machines`` run with `make test-machines` alone.
    """
    marks = dict.fromkeys(slow, pytest.mark.slow) | dict.fromkeys(machines, pytest.mark.machines)
    return [
        pytest.param(*(c if isinstance(c, tuple) else (c,)), marks=marks.get(c, ())) for c in cases
    ]


def in_turn(
    cases: Iterable[str], n: int, first: int = 0, machines: Collection[str] = ()
) -> list[Any]:
    """The cases for ``parametrize``; one in n runs with the slow tests, the others with `make test-machines`.

    So do those that stand in ``machines``.
    """
    cases = list(cases)
    slow = [c for c in cases[first::n] if c not in machines]
    return some_slow(cases, slow, [c for c in cases if c not in slow])
