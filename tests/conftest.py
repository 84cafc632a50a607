"""Settings for all tests, made before JAX or matplotlib are imported."""

import gc
import os
import shutil
import sys
import tempfile
import zlib
from collections import defaultdict
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import hypothesis
import pytest

CACHE = "ACAUSAL_COMPILATION_CACHE"
os.environ.setdefault("JAX_PLATFORMS", "cpu")
os.environ.setdefault("MPLBACKEND", "Agg")

# The same examples in every run, and no deadline: the first one compiles. `search` looks further.
hypothesis.settings.register_profile("acausal", deadline=None, derandomize=True, max_examples=30)
hypothesis.settings.register_profile(
    "search", deadline=None, database=None, print_blob=True, max_examples=500
)
hypothesis.settings.load_profile("acausal")


MAPS = 8_000
"""Memory maps from which on compiled programs are let go: each takes some, and Linux allows a process 65,530."""


@pytest.fixture(autouse=True, scope="module")
def lets_go_of_compiled_programs() -> Iterator[None]:
    """After a file of tests, where there are many: small ones are needed again by the next file."""
    yield
    if "jax" in sys.modules and maps() > MAPS:
        sys.modules["jax"].clear_caches()
        leave_alone_what_stays()


def maps() -> int:
    """The memory maps of this process; above `MAPS` where the system does not tell."""
    try:
        return Path("/proc/self/maps").read_bytes().count(b"\n")
    except OSError:
        return MAPS + 1


ONE_OF = 8
"""Of the slow tests every so many-th is in a sample. Which ones depends on CHANGELOG.md: others have their turn after a
change."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """An option for fewer slow tests."""
    parser.addoption("--sample", action="store_true", help=f"of the slow tests one of {ONE_OF}")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Choose what is fast, slow and for `machines`, and a sample of the slow ones where that is asked for."""
    by_cases(items)
    if config.getoption("sample"):
        left_out = set(beside_sample(items))
        config.hook.pytest_deselected(items=[item for item in items if item in left_out])
        items[:] = [item for item in items if item not in left_out]


def beside_sample(items: Iterable[pytest.Item]) -> list[pytest.Item]:
    """The slow tests that are not in the sample; which ones are follows from the list of changes."""
    changes = Path(__file__).parent.parent / "CHANGELOG.md"
    turn = zlib.crc32(changes.read_bytes())
    slow = [item for item in items if tier(item) == "slow"]
    return [item for i, item in enumerate(slow, start=turn) if i % ONE_OF]


def by_cases(items: Iterable[pytest.Item]) -> None:
    """Of a test with the mark ``cases(fast=2, slow=5)`` two cases are fast, five slow, and the others for `machines`.

    They are spread evenly over the cases. Without a number of fast ones none is moved to the slow ones; without one of
    slow ones as many stay as are fast.
    """
    groups = defaultdict[str, list[pytest.Item]](list)
    for item in items:
        if item.get_closest_marker("cases"):
            groups[item.nodeid.partition("[")[0]].append(item)
    for group in groups.values():
        counts: Any = next(group[0].iter_markers("cases")).kwargs
        for here, there in (("fast", "slow"), ("slow", "machines")):
            found = [item for item in group if tier(item) == here]
            count = min(counts.get(here, counts.get("fast", len(found))), len(found))
            stay = {i * len(found) // count for i in range(count)}
            for i in set(range(len(found))) - stay:
                found[i].add_marker(there)


def tier(item: pytest.Item) -> str:
    """Which tests one belongs to: fast, slow or machines."""
    marks = [m for m in ("machines", "slow") if item.get_closest_marker(m)]
    return (*marks, "fast")[0]


def pytest_collection_finish() -> None:
    """Tracing makes many objects: look for cycles less often, and not among all modules each time."""
    gc.set_threshold(20_000, 20, 20)
    leave_alone_what_stays()


def leave_alone_what_stays() -> None:
    """What is alive where programs have been let go stays: modules, and what they keep."""
    gc.unfreeze()
    gc.collect()
    gc.freeze()


def pytest_configure(config: pytest.Config) -> None:
    """One cache of programs for all files and processes of a run: half of what they compile is the same.

    In CI with the locked packages, tests are skipped for known reasons only.
    """
    if CACHE not in os.environ:
        os.environ[CACHE] = tempfile.mkdtemp(prefix="acausal-tests-")
        config.add_cleanup(lambda: shutil.rmtree(os.environ.pop(CACHE), ignore_errors=True))
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
