"""Faults while files are written: no room, killed processes, two at once. A reader always sees a whole file."""

from __future__ import annotations

import random
import resource
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

import acausal as ac
from tests.support.paths import ROOT
from tests.test_files import WRITERS

pytestmark = pytest.mark.slow
SIZES, KILLS = 10, 2


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """What every writer writes, by the name of the file."""
    pytest.importorskip("onnx")
    folder = tmp_path_factory.mktemp("whole")
    write(folder, [*WRITERS])
    return read(folder)


def write(folder: Path, names: list[str]) -> None:
    for name in names:
        WRITERS[name](folder / name)


def read(folder: Path) -> dict[str, bytes]:
    """The files of a folder; hidden ones are parts of what was killed."""
    return {f.name: f.read_bytes() for f in folder.iterdir() if not f.name.startswith(".")}


def alike(found: bytes, whole: bytes) -> bool:
    """Whether a file is whole; safetensors orders the entries of its header by chance."""
    return found == whole or sorted(found) == sorted(whole)


@contextmanager
def room(size: int) -> Generator[None]:
    """Files cannot grow beyond so many bytes."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, limits[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)


def test_a_disk_that_is_full_after_any_number_of_bytes(
    whole: dict[str, bytes], tmp_path: Path, record_property: Any
) -> None:
    chance, counts = random.Random("full"), Counter[str]()
    for name in WRITERS:
        for _ in range(SIZES):
            size = chance.randrange(len(whole[name]) * 5 // 4)
            old = dict.fromkeys(whole, b"old")
            for n, content in old.items():
                (tmp_path / n).write_bytes(content)
            try:
                with room(size):
                    write(tmp_path, [name])
                counts["written" if alike(read(tmp_path)[name], whole[name]) else "silent"] += 1
            except ac.AcausalError as error:
                counts["sentences" if "cannot be written: " in str(error) else "unclear"] += 1
            found = read(tmp_path)
            assert all(y == b"old" or alike(y, whole[n]) for n, y in found.items()), (name, size)
            assert not [f for f in tmp_path.iterdir() if f.name.startswith(".")], "parts are left"
    record_property(
        "mutants", ("writes on full disks", [f"{n:>6} {what}" for what, n in counts.items()])
    )
    assert set(counts) == {"sentences", "written"}


def test_writers_that_are_killed_and_others_beside_them(
    whole: dict[str, bytes], tmp_path: Path, record_property: Any
) -> None:
    chance, counts = random.Random("killed"), Counter[str]()
    for _ in range(KILLS):
        writers = [
            subprocess.Popen(
                [sys.executable, "-m", "tests.fuzz.test_writing", str(tmp_path)],
                cwd=ROOT,
                stdout=subprocess.PIPE,
                text=True,
            )
            for _ in range(2)
        ]
        for writer in writers:
            assert writer.stdout is not None
            assert writer.stdout.readline() == "all written once\n"
        for writer in writers:
            end = time.monotonic() + chance.uniform(0.1, 2.0)
            while time.monotonic() < end:
                for name, content in read(tmp_path).items():
                    assert alike(content, whole[name]), name
                    counts["whole files read"] += 1
            writer.send_signal(signal.SIGKILL)
            assert writer.wait() == -signal.SIGKILL
            writer.stdout.close()
            counts["writers killed"] += 1
    assert read(tmp_path).keys() == whole.keys()
    counts["parts left"] = sum(f.name.endswith(".part") for f in tmp_path.iterdir())
    record_property("mutants", ("killed writers", [f"{n:>6} {what}" for what, n in counts.items()]))


if __name__ == "__main__":
    folder, order = Path(sys.argv[1]), random.Random()
    write(folder, [*WRITERS])
    print("all written once", flush=True)  # noqa: T201 (for the process that waits)
    while True:
        write(folder, order.sample([*WRITERS], len(WRITERS)))
