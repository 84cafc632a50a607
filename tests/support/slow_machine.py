"""A machine on which every update takes a second, as its clock says: a training reports after each one."""

import itertools
import time

import pytest


def slow_down(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a second go by between two looks at the clock."""
    now, seconds = time.perf_counter, itertools.count()
    monkeypatch.setattr(time, "perf_counter", lambda: now() + next(seconds))
