"""Settings for all tests, made before JAX or matplotlib are imported."""

import os
from typing import Any

import hypothesis

os.environ.setdefault("ACAUSAL_COMPILATION_CACHE", "off")
os.environ.setdefault("JAX_PLATFORMS", "cpu")
os.environ.setdefault("MPLBACKEND", "Agg")

# The same examples in every run, and no deadline: the first one compiles. `search` looks further.
hypothesis.settings.register_profile("acausal", deadline=None, derandomize=True, max_examples=30)
hypothesis.settings.register_profile(
    "search", deadline=None, database=None, print_blob=True, max_examples=500
)
hypothesis.settings.load_profile("acausal")


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """A table of what tests have measured: errors against the reference trajectories."""
    reports = [r for kind in ("passed", "failed") for r in terminalreporter.getreports(kind)]
    rows = [value for r in reports for key, value in r.user_properties if key == "oracle"]
    if rows:
        terminalreporter.section(
            "largest errors against reference trajectories, relative to the range"
        )
        for name, column, error in sorted(map(tuple, rows)):
            terminalreporter.write_line(f"{name:<52} {column:<30} {error:.1e}")
