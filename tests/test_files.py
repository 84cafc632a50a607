"""Files: whatever happens while one is written, the old one or the new one is there."""

from __future__ import annotations

import errno
import json
import os
import resource
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Generator
from contextlib import closing, contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import acausal as ac
from acausal.command.simulate import _plot
from acausal.files import Lock, write_files
from acausal.reporting import Page, write_json
from tests.support.oscillator import Oscillator, learned, plain
from tests.support.paths import ROOT


@cache
def run() -> ac.Solution:
    return ac.simulate(plain(), (0.0, 1.0), dt=0.1, inputs={"push.f": 1.0})


@contextmanager
def full_disk() -> Generator[None]:
    """Files cannot grow beyond 100 bytes, as the system really does it."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, limits[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)


WRITERS: dict[str, Callable[[Path], Any]] = {
    "save.json": lambda path: ac.save(Oscillator(), path),
    "run.csv": lambda path: run().to_csv(path),
    "plot.png": lambda path: _plot(run(), ["mass.s"], str(path)),
    "params.safetensors": lambda path: ac.save_params(plain().parameters(), path),
    "page.html": lambda path: ac.page(plain(), path),
    "report.html": lambda path: Page("Report", "x" * 100).write(path),
    "figures.json": lambda path: write_json(path, list(range(100))),
    "drawing.svg": lambda path: ac.diagram(plain()).save(path),
    "export.c": lambda path: ac.export.c(plain(), path.parent, name="export"),
    "export.fmu": lambda path: ac.export.fmu(plain(), path, binary=False),
    "net.onnx": lambda path: ac.export.onnx(learned(), path, network="extra.net"),
    "net.mlir": lambda path: ac.export.stablehlo(learned(), path, network="extra.net"),
    "export.mo": lambda path: ac.export.modelica(plain(), path),
}
"""What writes files, each by the name of one that it writes."""


@pytest.mark.parametrize("name", WRITERS)
def test_every_writer_leaves_the_old_file_where_the_disk_is_full(name: str, tmp_path: Path):
    if name.endswith(".onnx"):
        pytest.importorskip("onnx")
    WRITERS[name](tmp_path / name)
    before = {path: path.read_bytes() for path in tmp_path.iterdir()}
    full = os.strerror(errno.EFBIG)
    with full_disk(), pytest.raises(ac.AcausalError, match=rf"' cannot be written: {full}\.$"):
        WRITERS[name](tmp_path / name)
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == before


@pytest.mark.parametrize("name", WRITERS)
def test_every_writer_keeps_a_link_and_the_mode_of_its_target(name: str, tmp_path: Path):
    if name.endswith(".onnx"):
        pytest.importorskip("onnx")
    (tmp_path / "store").mkdir()
    target, link = tmp_path / "store" / "file", tmp_path / name
    target.write_text("old")
    target.chmod(0o640)
    link.symlink_to(Path("store", "file"))
    WRITERS[name](link)
    assert link.is_symlink()
    assert target.read_bytes() != b"old"
    assert target.stat().st_mode & 0o777 == 0o640
    assert list(target.parent.iterdir()) == [target]


TAKING_A_PATH: dict[str, Callable[[Any], Any]] = {
    "load": ac.load,
    "save": lambda path: ac.save(Oscillator(), path),
    "save_params": lambda path: ac.save_params({}, path),
    "load_params": lambda path: ac.load_params(path, {}),
    "from_csv": ac.Data.from_csv,
    "to_csv": lambda path: run().to_csv(path),
    "page": lambda path: ac.page(plain(), path),
    "--plot": lambda path: _plot(run(), ["mass.s"], path),
    "diagram.save": lambda path: ac.diagram(plain()).save(path),
    "export.c": lambda path: ac.export.c(plain(), path),
    "export.fmu": lambda path: ac.export.fmu(plain(), path),
    "export.modelica": lambda path: ac.export.modelica(plain(), path),
    "checkpoint": lambda path: ac.fit(plain(), {}, "mass.a", checkpoint=path),
    "CsvLog": ac.CsvLog,
    "use_compilation_cache": ac.use_compilation_cache,
}


@pytest.mark.parametrize("function", TAKING_A_PATH)
def test_what_no_file_can_be_called_is_refused(function: str):
    for path, flaw in (
        ("", "it is empty"),
        ("a\0b.svg", "it has a null character"),
        ("a\ud800.svg", "it has a character that no file name can have"),
    ):
        with pytest.raises(ac.AcausalError) as error:
            TAKING_A_PATH[function](path)
        assert str(error.value) == f"{function}: {path!r} is not a path; {flaw}."
    with pytest.raises(ac.AcausalError, match=r"is not a path; it is too long\.$"):
        TAKING_A_PATH[function]("x" * 5000)


def test_a_tilde_is_the_users_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    ac.diagram(plain()).save("~/drawings/a.svg")
    assert [path.name for path in tmp_path.iterdir()] == ["drawings"]
    with pytest.raises(
        ac.DataError, match=r"a\.svg/index.html' cannot be written: Not a directory"
    ):
        ac.page(plain(), "~/drawings/a.svg")


def test_a_pipe_is_written_to_and_a_folder_or_protected_file_is_not(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    pipe, folder, protected = tmp_path / "pipe", tmp_path / "folder", tmp_path / "protected"
    os.mkfifo(pipe)
    written = threading.Thread(target=write_files, args=({pipe: "all of it"},))
    written.start()
    assert pipe.read_text() == "all of it"
    written.join()
    assert pipe.is_fifo()
    folder.mkdir()
    with pytest.raises(ac.DataError, match=r"folder' cannot be written: Is a directory\.$"):
        write_files({folder: "x"})
    protected.write_text("old")
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(ac.DataError, match=r"protected' cannot be written: Permission denied\.$"):
        write_files({protected: "x"})
    assert protected.read_text() == "old"


def test_of_several_files_all_are_written_or_none(tmp_path: Path):
    header, source = tmp_path / "a.h", tmp_path / "a.c"
    write_files({header: "old", source: "old"})
    with full_disk(), pytest.raises(ac.DataError, match=r"a\.c' cannot be written: "):
        write_files({header: "new", source: "x" * 101})
    assert [path.read_text() for path in (header, source)] == ["old", "old"]


def test_names_may_be_as_long_and_texts_as_odd_as_the_system_allows(tmp_path: Path):
    path = tmp_path / ("ä" * 127)
    write_files({path: '"half a pair: \ud800"'})
    assert json.loads(path.read_text()) == "half a pair: \ud800"
    with closing(Lock(path)) as lock:
        lock.hold()
    assert list(tmp_path.iterdir()) == [path]


def other(code: str, path: Path) -> subprocess.Popen[str]:
    """Another process, in which ``path`` is a path."""
    begin = f"import os, signal; from acausal.files import *; path = Path({str(path)!r}); "
    return subprocess.Popen(
        [sys.executable, "-c", begin + code], cwd=ROOT, stdout=subprocess.PIPE, text=True
    )


KILLED = "os.fsync = lambda _: os.kill(os.getpid(), signal.SIGKILL); "


def test_a_killed_process_leaves_the_old_file_and_no_lock(tmp_path: Path):
    path = tmp_path / "a[1].txt"
    path.write_text("old")
    with other(KILLED + "lock = Lock(path); lock.hold(); replace_file(path, b'new')", path) as done:
        assert done.wait() == -signal.SIGKILL
    assert path.read_text() == "old"
    assert len(list(tmp_path.iterdir())) == 3, "a part and a lock are left"
    with closing(Lock(path)) as lock:
        lock.hold()
        assert len(list(tmp_path.iterdir())) == 2, "the part is removed"
    assert list(tmp_path.iterdir()) == [path]


def test_a_lock_names_the_process_that_holds_it(tmp_path: Path):
    path = tmp_path / "a.txt"
    code = "signal.alarm(20); lock = Lock(path); lock.hold(); print(os.getpid(), flush=True); signal.pause()"
    link = tmp_path / "link"
    link.symlink_to(path)
    with other(code, path) as holder, closing(Lock(link)) as lock:
        assert holder.stdout is not None
        process = holder.stdout.readline().strip()
        with pytest.raises(BlockingIOError, match=rf"^.*process {process} on .* is writing it;"):
            lock.hold()
        holder.kill()
        holder.wait()
        lock.hold()


def test_a_lock_that_was_removed_is_taken_again_unless_another_process_was_quicker(tmp_path: Path):
    path = tmp_path / "a.txt"
    with closing(Lock(path)) as first, closing(Lock(path)) as second:
        first.hold()
        (tmp_path / ".a.txt.lock").unlink()
        first.hold()
        with pytest.raises(BlockingIOError):
            second.hold()
        (tmp_path / ".a.txt.lock").unlink()
        second.hold()
        with pytest.raises(BlockingIOError):
            first.hold()
        first.close()
        assert (tmp_path / ".a.txt.lock").exists(), "it is the other one's"


def test_two_processes_that_write_one_file_do_not_damage_it(tmp_path: Path):
    path = tmp_path / "a.txt"
    short, long = b"a" * 10_000, b"b" * 1_000_000
    code = "[replace_file(path, {!r} * {}) for _ in range(50)]"
    seen = 0
    with (
        other(code.format(b"a", 10_000), path) as one,
        other(code.format(b"b", 1_000_000), path) as two,
    ):
        while one.poll() is None or two.poll() is None:
            if path.exists():
                assert path.read_bytes() in (short, long)
                seen += 1
    assert (one.returncode, two.returncode) == (0, 0)
    assert seen > 0
    assert list(tmp_path.iterdir()) == [path]
