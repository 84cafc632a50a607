"""Settings for all tests, made before JAX or matplotlib are imported."""

import gc
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import hypothesis
import pytest

os.environ.setdefault("ACAUSAL_COMPILATION_CACHE", "off")
os.environ.setdefault("JAX_PLATFORMS", "cpu")
os.environ.setdefault("MPLBACKEND", "Agg")

# The same examples in every run, and no deadline: the first one compiles. `search` looks further.
hypothesis.settings.register_profile("acausal", deadline=None, derandomize=True, max_examples=30)
hypothesis.settings.register_profile(
    "search", deadline=None, database=None, print_blob=True, max_examples=500
)
hypothesis.settings.load_profile("acausal")


@pytest.fixture(autouse=True, scope="module")
def lets_go_of_compiled_programs() -> Iterator[None]:
    """After a file of tests; each program takes memory maps, of which Linux allows a process 65,530."""
    yield
    if "jax" in sys.modules:
        sys.modules["jax"].clear_caches()
        leave_alone_what_stays()


def pytest_collection_finish() -> None:
    """Tracing makes many objects: look for cycles less often, and not among all modules each time."""
    gc.set_threshold(20_000, 20, 20)
    leave_alone_what_stays()


def leave_alone_what_stays() -> None:
    """What is alive between two files of tests stays: modules, and what they keep."""
    gc.collect()
    gc.freeze()


def pytest_configure(config: pytest.Config) -> None:
    """In CI with the locked packages, tests are skipped for known reasons only."""
    if os.environ.get("CI") and Path(sys.prefix).name == ".venv":
        config.pluginmanager.import_plugin("tests.support.skips")


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Tables of what tests have measured: errors against references and differences, and what became of mutants."""
    reports = [r for kind in ("passed", "failed") for r in terminalreporter.getreports(kind)]

    def measured(kind: str) -> list[Any]:
        return sorted(value for r in reports for key, value in r.user_properties if key == kind)

    def write(title: str, lines: list[str]) -> None:
        if lines:
            terminalreporter.section(title)
            for line in lines:
                terminalreporter.write_line(line)

    oracles = [f"{name:<52} {column:<30} {e:.1e}" for name, column, e in measured("oracle")]
    write("largest errors against reference trajectories, relative to the range", oracles)
    gradients = measured("gradient")
    lines = []
    for path in dict.fromkeys(path for path, *_ in gradients):
        errors = [(e, name) for p, e, name in gradients if p == path]
        worst, name = max(errors)
        lines.append(f"{path:<42} {len(errors):>3} models, worst {worst:.1e}: {name}")
    if gradients:
        e, path, name = max((e, p, n) for p, e, n in gradients)
        lines.append(f"{len(gradients)} gradients compared, worst {e:.1e}: {name}, {path}")
    write("gradients against central differences, relative to the largest component", lines)
    for name, lines in measured("mutants"):
        write(f"what became of wrong {name}", lines)
