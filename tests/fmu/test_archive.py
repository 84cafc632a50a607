"""Archives from anybody: read, or refused in one sentence; nothing is written outside of a folder of their own."""

from __future__ import annotations

import gc
import stat
import zipfile
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from acausal.fmu import archive
from tests.support.fmus import need_fmpy
from tests.support.hybrid import Ball

Change = Callable[[str, bytes], bytes | None]


@pytest.fixture(scope="module")
def ball(tmp_path_factory: pytest.TempPathFactory) -> Path:
    need_fmpy()
    return ac.export.fmu(ac.compile(Ball()), tmp_path_factory.mktemp("fmu") / "ball.fmu", fmi="2.0")


def changed(path: Path, target: Path, change: Change, **more: bytes) -> Path:
    """A copy with other contents; None leaves a file out."""
    with zipfile.ZipFile(path) as source, zipfile.ZipFile(target, "w") as sink:
        for name in source.namelist():
            if (content := change(name, source.read(name))) is not None:
                sink.writestr(name, content)
        for name, content in more.items():
            sink.writestr(name, content)
    return target


def in_description(old: bytes, new: bytes) -> Change:
    def change(name: str, content: bytes) -> bytes:
        return content.replace(old, new, 1) if name == "modelDescription.xml" else content

    return change


def in_binary(new: Callable[[bytes], bytes | None]) -> Change:
    return lambda name, content: new(content) if name.startswith("binaries/") else content


def same(_: str, content: bytes) -> bytes:
    return content


def sentence(path: Path) -> str:
    """The error of an FMU, which is one sentence."""
    with pytest.raises(ac.AcausalError) as caught:
        ac.simulate(ac.compile(ac.FMU(path)), 0.1, dt=0.1)
    message = str(caught.value)
    assert "\n" not in message
    assert len(message) < 400
    return message


CHANGES: dict[str, tuple[Change, str]] = {
    "no description": (lambda n, c: None if n.endswith(".xml") else c, "it is not an FMU"),
    "entities": (in_description(b"<fmi", b'<!DOCTYPE a [<!ENTITY b "c">]><fmi'), "has entities"),
    "other version": (in_description(b'fmiVersion="2.0"', b'fmiVersion="1.0"'), "not sound|FMI 1"),
    "broken": (in_description(b"</fmiModel", b"<fmiModel"), "is not sound"),
    "a derivative of nothing": (in_description(b'derivative="', b'derivative="9'), "is not sound"),
    "wrong GUID": (in_description(b'guid="', b'guid="0'), "gives no instance"),
    "no binary": (in_binary(lambda _: None), "has no binary for this platform"),
    "cut off": (in_binary(lambda c: c[: len(c) // 2]), "is cut off"),
    "no library": (in_binary(lambda _: b"hello" * 99), "is cut off or no library"),
}


@pytest.mark.parametrize("name", CHANGES)
def test_what_is_wrong_is_said_in_one_sentence(ball: Path, tmp_path: Path, name: str) -> None:
    change, expected = CHANGES[name]
    message = sentence(changed(ball, tmp_path / "changed.fmu", change))
    assert any(part in message for part in expected.split("|"))


def test_paths_that_climb_and_links_are_refused(ball: Path, tmp_path: Path) -> None:
    for name in ("../climbed", "/climbed", "resources/../../climbed", "resources\\..\\..\\climbed"):
        path = changed(ball, tmp_path / "a.fmu", same, **{name: b"x"})
        assert "a path that leads out of it" in sentence(path)
    link = zipfile.ZipInfo("resources/link")
    link.external_attr = (stat.S_IFLNK | 0o777) << 16
    with zipfile.ZipFile(path := changed(ball, tmp_path / "b.fmu", same), "a") as sink:
        sink.writestr(link, "/etc/hostname")
    assert "a link" in sentence(path)
    assert not [
        *tmp_path.parent.rglob("climbed"),
        *Path(archive.tempfile.gettempdir()).glob("climbed"),
    ]


def test_what_grows_without_end_is_refused(ball: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(
        path := changed(ball, tmp_path / "bomb.fmu", same), "a", zipfile.ZIP_DEFLATED
    ) as sink:
        sink.writestr("resources/zeros", bytes(2**25))
    assert "so much is not unpacked" in sentence(path)


@pytest.mark.parametrize("seed", [7, *(pytest.param(s, marks=pytest.mark.slow) for s in range(5))])
def test_mutated_archives_are_read_or_refused(
    ball: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    monkeypatch.setattr(archive.tempfile, "tempdir", str(tmp_path))
    kept, key = ball.read_bytes(), np.random.default_rng(seed)
    with zipfile.ZipFile(ball) as source:
        description = source.read("modelDescription.xml")
    for k in range(60):
        content = bytearray(kept if k % 2 else description)
        for _ in range(int(key.integers(1, 8))):
            at = int(key.integers(len(content)))
            if key.random() < 0.2:
                del content[at:]
                break
            content[at] = int(key.integers(256))
        path = tmp_path / f"{k}.fmu"
        if k % 2:
            path.write_bytes(content)
        else:
            changed(ball, path, lambda n, c, new=bytes(content): new if n.endswith(".xml") else c)
        with suppress(ac.AcausalError):  # any other error is a defect
            _shown(path)
    gc.collect()  # errors refer to the frames that they went through
    assert not any(p.is_dir() for p in tmp_path.iterdir())  # none is left


def _shown(path: Path) -> None:
    """Read it without running its code."""
    from acausal.fmu.archive import read
    from acausal.fmu.description import read_description

    read_description(read(path)[1], path, {})


def test_an_fmu_shows_what_it_is(ball: Path) -> None:
    text = repr(ac.FMU(ball))
    for part in ("Ball, FMI 2.0", "acausal", "h m", "e = 0.8", "directional derivatives"):
        assert part in text
    assert "<table>" in ac.FMU(ball)._repr_html_()
    with pytest.raises(ac.DeclarationError, match="no variable 'hh': did you mean 'h'"):
        ac.FMU(ball, {"hh": 1.0})
