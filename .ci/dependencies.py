"""Run the tests with other versions of the dependencies than the locked ones.

    python .ci/dependencies.py newest       the newest of everything, on the newest Python that is found
    python .ci/dependencies.py lowest       the lowest that pyproject.toml admits, on the lowest Python
    python .ci/dependencies.py uv           what `uv run` chooses, which does not read our lock

Further arguments are pytest's. An environment is made anew each time, in `.venv-newest` and so on. Where no suitable
Python is found, a line says that the tests were skipped.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
LOWEST = (3, 11)
EXTRA = "dev"

# A warning of a dependency is an error with the locked versions; later ones may announce changes.
TOLERATED = ("DeprecationWarning", "PendingDeprecationWarning", "FutureWarning")
TESTS = ["-n", "auto", "--maxprocesses", "8", "--dist", "loadfile"]

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
    runs = {"newest": newest, "lowest": lowest, "uv": uv_run}
    if which not in runs:
        print(__doc__, file=sys.stderr)
        return 2
    return runs[which](arguments)


def newest(arguments: list[str]) -> int:
    """What `pip install .` takes today."""
    python = max(interpreters(), default=None)
    if python is None or python.version == LOWEST:
        return skipped(
            "newest", "no Python above 3.11 was found; the locked versions are tested there"
        )
    own = environment("newest", python)
    run(own, "-m", "pip", "install", "--quiet", "--editable", f".[{EXTRA}]")
    return tests(own, python, arguments)


def lowest(arguments: list[str]) -> int:
    """The versions that the bounds in pyproject.toml name."""
    python = next((found for found in interpreters() if found.version == LOWEST), None)
    if python is None:
        return skipped("lowest", "no Python 3.11 was found")
    own = environment("lowest", python)
    run(own, "-m", "pip", "install", "--quiet", "uv")
    chosen = own.parent.parent / "requirements.txt"
    resolve = ("--quiet", "--resolution", "lowest-direct", "--no-header", "--extra", EXTRA)
    run(own, "-m", "uv", "pip", "compile", *resolve, "--output-file", chosen, "pyproject.toml")
    run(own, "-m", "uv", "pip", "install", "--quiet", "--python", own, "--requirement", chosen)
    run(own, "-m", "pip", "install", "--quiet", "--no-deps", "--editable", ".")
    return tests(own, python, arguments)


def uv_run(arguments: list[str]) -> int:
    """`uv run` in a copy of the checkout: the README's example, and the demonstrator's options."""
    python = max(interpreters(), default=None)
    if python is None:
        return skipped("uv", "no Python was found that can make environments")
    own = environment("uv", python)
    run(own, "-m", "pip", "install", "--quiet", "uv")
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "acausal"
        copy_checkout(copy)
        start = (own, "-m", "uv", "run", "--quiet", "--python", python.path)
        clean = {name: value for name, value in os.environ.items() if name != "VIRTUAL_ENV"}
        run(*start, "python", "-m", "examples.qvm", "--help", cwd=copy, env=clean)
        command = ("python", "-m", "pytest", *tolerant(), "tests/test_docs.py", *arguments)
        return subprocess.call([str(part) for part in (*start, *command)], cwd=copy, env=clean)


def interpreters() -> Iterator[Interpreter]:
    """Released CPythons of 3.11 and newer that can make environments, each version once."""
    seen: set[tuple[int, int]] = set()
    for path in candidates():
        done = subprocess.run([path, "-c", ASK], capture_output=True, text=True, check=False)
        if done.returncode:
            continue
        version, released = json.loads(done.stdout)
        found = Interpreter((version[0], version[1]), path)
        if released and found.version >= LOWEST and found.version not in seen:
            seen.add(found.version)
            yield found


def candidates() -> Iterator[Path]:
    """Where Pythons are kept: on the path, by pyenv and by uv."""
    for minor in range(20, LOWEST[1] - 1, -1):
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
    run(python.path, "-m", "venv", folder)
    return folder / "bin" / "python"


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
    command = [python, "-m", "pytest", *tolerant(), *TESTS, *arguments]
    return subprocess.call([str(part) for part in command], cwd=ROOT)


def tolerant() -> list[str]:
    return [part for warning in TOLERATED for part in ("-W", f"ignore::{warning}")]


def copy_checkout(into: Path) -> None:
    """The files of the checkout that git does not ignore."""
    listed = run(
        "git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", capture=True
    )
    for name in filter(None, listed.split("\0")):
        source = ROOT / name
        if source.exists() or source.is_symlink():
            (into / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source, into / name, follow_symlinks=False)


def run(
    *command: str | Path,
    cwd: Path = ROOT,
    env: dict[str, str] | None = None,
    capture: bool = False,
) -> str:
    """Run a command; end with its status if it fails."""
    done = subprocess.run(
        [str(part) for part in command],
        cwd=cwd,
        env=env,
        stdout=subprocess.PIPE if capture else None,
        text=True,
        check=False,
    )
    if done.returncode:
        print(f"{' '.join(str(part) for part in command)} failed", file=sys.stderr)
        sys.exit(done.returncode)
    return done.stdout or ""


def skipped(name: str, why: str) -> int:
    print(f"Skipped: the tests with the {name} dependencies, because {why}.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
