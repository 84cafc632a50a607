"""Run the tests with other versions of the dependencies than those of requirements.lock.

    python .ci/dependencies.py newest       newest.lock, on the newest Python that is found
    python .ci/dependencies.py lowest       lowest.lock: the lowest that pyproject.toml admits, on the lowest Python
    python .ci/dependencies.py uv           what `uv run`, which reads no lock of ours, chose on newest.lock's day
    python .ci/dependencies.py today        the newest of today; its failures say what is to come, they stop nothing
    python .ci/dependencies.py lock         write newest.lock and lowest.lock

``--sample`` after `newest` or `lowest` takes one file of tests a room; further arguments are pytest's. Each run makes a
new environment, `.venv-newest` and so on. Where no suitable Python is found, a line that begins with "Skipped" says so.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
NEWEST, LOWEST = ROOT / ".ci/newest.lock", ROOT / ".ci/lowest.lock"
OLDEST, NEWER = (3, 11), (3, 12)
EXTRA = "dev"

# A warning of a dependency is an error with the locked versions; later ones may announce changes.
TOLERATED = ("DeprecationWarning", "PendingDeprecationWarning", "FutureWarning")
TESTS = ["-n", "auto", "--maxprocesses", "8", "--dist", "loadfile"]

# One file a room, and the pages of the README: what a dependency could break, in a few minutes.
SAMPLE = (
    "tests/_jax/test_scan.py",
    "tests/_jax/test_primitives.py",
    "tests/_jax/test_lanes.py",
    "tests/analysis/test_linearization.py",
    "tests/codegen/test_generate.py",
    "tests/codegen/test_sparse.py",
    "tests/command/test_command.py",
    "tests/components/test_translational.py",
    "tests/data/test_record.py",
    "tests/drawing/test_diagram.py",
    "tests/export/test_onnx.py",
    "tests/export/test_stablehlo.py",
    "tests/flattening/test_flatten.py",
    "tests/initialization/test_initialize.py",
    "tests/modeling/test_component.py",
    "tests/netlist/test_netlist.py",
    "tests/networks/test_promises.py",
    "tests/pages/test_page.py",
    "tests/reporting/test_builder.py",
    "tests/simulation/test_vocabulary.py",
    "tests/structure/test_rank.py",
    "tests/training/test_ensemble.py",
    "tests/units/test_si.py",
)

ASK = """
import ensurepip, json, platform, sys, venv
released = sys.version_info[3] == "final" and platform.python_implementation() == "CPython"
print(json.dumps([sys.version_info[:2], released]))
"""


class Interpreter(NamedTuple):
    """A Python, and where it lies."""

    version: tuple[int, int]
    path: Path


def main() -> int:
    which, *arguments = sys.argv[1:] or [""]
    runs = {"newest": newest, "lowest": lowest, "uv": uv_run, "today": today, "lock": lock}
    if which not in runs:
        print(__doc__, file=sys.stderr)
        return 2
    return runs[which](arguments)


def newest(arguments: list[str]) -> int:
    python = newest_python()
    if python is None:
        return skipped("newest", "no Python above 3.11 was found")
    return tests(locked("newest", python, NEWEST), python, arguments)


def lowest(arguments: list[str]) -> int:
    python = next((found for found in interpreters() if found.version == OLDEST), None)
    if python is None:
        return skipped("lowest", "no Python 3.11 was found")
    return tests(locked("lowest", python, LOWEST), python, arguments)


def today(arguments: list[str]) -> int:
    python = newest_python()
    if python is None:
        return skipped("today", "no Python above 3.11 was found")
    own = environment("today", python)
    uv("pip", "install", "--quiet", "--upgrade", "--python", own, "--editable", f".[{EXTRA}]")
    return tests(own, python, arguments)


def uv_run(arguments: list[str]) -> int:
    """`uv run` in a copy of the checkout: the README's example, and the demonstrator's options."""
    python = max(interpreters())
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "acausal"
        copy_checkout(copy)
        clean = {name: value for name, value in os.environ.items() if name != "VIRTUAL_ENV"}
        start = (
            "run",
            "--quiet",
            "--exclude-newer",
            day(),
            "--python",
            python.path,
            "python",
            "-m",
        )
        uv(*start, "examples.qvm", "--help", cwd=copy, env=clean)
        page = "tests/test_docs.py"
        chosen = arguments or ["-k", "README"]
        uv(*start, "pytest", *tolerant(), page, *chosen, cwd=copy, env=clean)
    return 0


def lock(arguments: list[str]) -> int:
    """Both locks, for every platform and every Python that they are meant for."""
    for path, python, chosen in (
        (NEWEST, NEWER, ("--upgrade",)),
        (LOWEST, OLDEST, ("--resolution", "lowest-direct")),
    ):
        version = ".".join(map(str, python))
        form = ("--quiet", "--universal", "--generate-hashes", "--no-header", "--no-emit-index-url")
        into = ("--output-file", path, "--extra", EXTRA, "--python-version", version)
        uv("pip", "compile", "pyproject.toml", *form, *into, *chosen, *arguments)
        when = f"# The choice of {datetime.now(UTC):%Y-%m-%d}; `make lock-newest` makes another.\n"
        path.write_text(when + path.read_text(encoding="utf-8"), encoding="utf-8")
    return 0


def day() -> str:
    """The day on which newest.lock was made, from its first line."""
    first = NEWEST.read_text(encoding="utf-8").partition("\n")[0]
    return first.removeprefix("# The choice of ").partition(";")[0]


def newest_python() -> Interpreter | None:
    """The newest Python that is found, if newest.lock is meant for it."""
    python = max(interpreters())
    return python if python.version >= NEWER else None


def interpreters() -> Iterator[Interpreter]:
    """Released CPythons of 3.11 and newer that can make environments, each version once."""
    seen: set[tuple[int, int]] = set()
    for path in candidates():
        done = subprocess.run([path, "-c", ASK], capture_output=True, text=True, check=False)
        if done.returncode:
            continue
        version, released = json.loads(done.stdout)
        found = Interpreter((version[0], version[1]), path)
        if released and found.version >= OLDEST and found.version not in seen:
            seen.add(found.version)
            yield found


def candidates() -> Iterator[Path]:
    """Where Pythons are kept: on the path, by pyenv and by uv."""
    for minor in range(20, OLDEST[1] - 1, -1):
        found = shutil.which(f"python3.{minor}")
        if found:
            yield Path(found)
    home = Path.home()
    for kept in (
        Path(os.environ.get("PYENV_ROOT", home / ".pyenv")) / "versions",
        Path(os.environ.get("UV_PYTHON_INSTALL_DIR", home / ".local/share/uv/python")),
    ):
        yield from sorted(kept.glob("*/bin/python3"))
    yield Path(sys.executable)


def environment(name: str, python: Interpreter) -> Path:
    """A new environment; returns its interpreter."""
    folder = ROOT / f".venv-{name}"
    shutil.rmtree(folder, ignore_errors=True)
    uv("venv", "--quiet", "--python", python.path, folder)
    return folder / "bin" / "python"


def locked(name: str, python: Interpreter, lock: Path) -> Path:
    """A new environment with what a lock lists; returns its interpreter."""
    own = environment(name, python)
    into = ("pip", "install", "--quiet", "--python", own)
    uv(*into, "--compile-bytecode", "--require-hashes", "--requirement", lock)
    uv(*into, "--no-deps", "--no-build-isolation", "--editable", ".")
    return own


def tests(python: Path, made_with: Interpreter, arguments: list[str]) -> int:
    """The tests, after a line that says what they run with."""
    names = (
        "jax",
        "diffrax",
        "equinox",
        "optax",
        "optimistix",
        "numpy",
        "scipy",
        "sympy",
        "networkx",
    )
    say = f"from importlib.metadata import version as v; print(*(n + ' ' + v(n) for n in {names!r}), sep=', ')"
    print(f"Python {'.'.join(map(str, made_with.version))} with", end=" ", flush=True)
    run(python, "-c", say)
    chosen = [part for one in arguments for part in (SAMPLE if one == "--sample" else (one,))]
    command = [python, "-m", "pytest", *tolerant(), *TESTS, *chosen]
    return subprocess.call([str(part) for part in command], cwd=ROOT)


def tolerant() -> list[str]:
    return [part for warning in TOLERATED for part in ("-W", f"ignore::{warning}")]


def copy_checkout(into: Path) -> None:
    """The files of the checkout that git does not ignore."""
    listed = subprocess.check_output(
        ("git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"), cwd=ROOT, text=True
    )
    for name in filter(None, listed.split("\0")):
        source = ROOT / name
        if source.exists() or source.is_symlink():
            (into / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source, into / name, follow_symlinks=False)


def uv(*arguments: str | Path, cwd: Path = ROOT, env: dict[str, str] | None = None) -> None:
    run(sys.executable, "-m", "uv", *arguments, cwd=cwd, env=env)


def run(*command: str | Path, cwd: Path = ROOT, env: dict[str, str] | None = None) -> None:
    """Run a command; end with its status if it fails."""
    line = [str(part) for part in command]
    done = subprocess.run(line, cwd=cwd, env=env, check=False)
    if done.returncode:
        print(f"{' '.join(line)} failed", file=sys.stderr)
        sys.exit(done.returncode)


def skipped(name: str, why: str) -> int:
    print(f"Skipped: the tests with the {name} dependencies, because {why}.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
