"""A plugin of pytest under which a test fails that is skipped for a reason that `REASONS` does not list."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest

REASONS = (
    # what lies beside the repository
    r"the (reference trajectories|published examples) lie .*in \.\./shared/oracles",
    r"the measured data.* are (not here|absent)",
    r"there is no .*\.fmu: unpack those of gemseo-fmu .* there, or set ACAUSAL_FMUS",
    r"there is no git history",
    # programs that are no Python packages
    r"There is no chromium: pages are not tried in a browser\.",
    r"no chromium is installed",
    r"Graphviz' dot is not installed; with it, crossings are compared",
    r"there is no (C compiler|gcc|clang)",
    r"the compiler has no (thread sanitizer|sanitizers)",
    r"the thread sanitizer does not run on this kernel",
    # packages that requirements.lock leaves out
    r"(asammdf|distributed|pyarrow|pymoca|ziglang) is not installed",
    # nothing to test
    r"a saw tooth has one",
    r"an address is set",
    r"has no events, or needs shorter steps",
)


def is_listed(reason: str) -> bool:
    """Whether a test may be skipped for a reason."""
    return any(re.fullmatch(known, reason.removeprefix("Skipped: ")) for known in REASONS)


def _checked(report: Any) -> Any:
    if report.skipped and isinstance(report.longrepr, tuple) and not is_listed(report.longrepr[2]):
        report.outcome = "failed"
        report.longrepr = f"{report.longrepr[2]} (tests/support/skips.py lists no such reason)"
    return report


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport() -> Iterator[Any]:
    """Of a test that is skipped as it runs."""
    return _checked((yield))


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report() -> Iterator[Any]:
    """Of a file that is skipped as a whole."""
    return _checked((yield))
