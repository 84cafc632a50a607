"""Logs of a training, read back as other programs read them."""

from __future__ import annotations

import struct
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.training.history import Divergence
from acausal.training.progress import Progress


def report(epoch: int, loss: float = 1 / 3) -> Progress:
    divergences = (Divergence(epoch, 0.0, 1, False),) * (epoch % 2)
    return Progress(epoch, 100, loss, 0.1, 0.5 * epoch, 0.01, divergences)


def read(path: Path) -> np.ndarray:
    return np.genfromtxt(path, delimiter=",", names=True)


def test_a_csv_file_has_a_line_for_every_report(tmp_path: Path):
    path = tmp_path / "new" / "log.csv"
    log = ac.CsvLog(path)
    for epoch in (1, 5, 9):
        log(report(epoch))
    table = read(path)
    assert table.dtype.names == (
        "epoch",
        "loss",
        "best",
        "seconds",
        "seconds_per_epoch",
        "diverged",
    )
    assert table["epoch"].tolist() == [1, 5, 9]
    assert table["loss"].tolist() == [1 / 3] * 3
    assert table["seconds"].tolist() == [0.5, 2.5, 4.5]
    assert table["diverged"].tolist() == [1, 1, 1]


def test_two_writers_of_a_csv_file_are_said(tmp_path: Path):
    one, other = (ac.CsvLog(tmp_path / "log.csv") for _ in range(2))
    one(report(1))
    other(report(1))
    other(report(2))
    with pytest.warns(
        UserWarning, match=r"log.csv' was changed by something else at epoch 2: lines"
    ):
        one(report(2))
    one(report(3))  # once


def test_a_csv_file_goes_on_after_a_break(tmp_path: Path):
    path = tmp_path / "log.csv"
    log = ac.CsvLog(path)
    for epoch in (1, 5, 9, 12):
        log(report(epoch, 1.0))
    path.write_text(path.read_text()[:-20])  # killed while it wrote the last line
    resumed = ac.CsvLog(path)
    for epoch in (8, 10):
        resumed(report(epoch, 2.0))
    assert read(path)["epoch"].tolist() == [1, 5, 8, 10]
    assert read(path)["loss"].tolist() == [1, 1, 2, 2]
    anew = ac.CsvLog(path)
    anew(report(1))
    anew(report(2))
    assert read(path)["epoch"].tolist() == [1, 2]


def test_other_files_are_not_overwritten(tmp_path: Path):
    path = tmp_path / "data.csv"
    path.write_text("time,x\n0,1\n")
    with pytest.raises(
        ac.DataError, match=r"data.csv' is not the log of a training: name another file\."
    ):
        ac.CsvLog(path)
    assert path.read_text() == "time,x\n0,1\n"
    with pytest.raises(ac.TrainingError, match=r"cannot be written: Is a directory\."):
        ac.CsvLog(tmp_path)
    for log in (ac.CsvLog, ac.TensorBoardLog):
        with pytest.raises(ac.DataError, match=rf"^{log.__name__}: 3.5 is not a path"):
            log(3.5)  # type: ignore[arg-type]


def test_a_csv_file_that_cannot_grow_stops_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    log = ac.CsvLog(tmp_path / "log.csv")
    log(report(1))

    def fail(*arguments: Any, **named: Any) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(Path, "open", fail)
        with pytest.warns(UserWarning, match=r"at epoch 2: No space left on device\. The training"):
            log(report(2))
        log(report(3))  # one warning
    log(report(4))
    assert read(tmp_path / "log.csv")["epoch"].tolist() == [1, 4]


def events(folder: Path) -> list[Any]:
    """The events of all files of a folder: each a length, its checksum, the message and its checksum."""
    from tensorboardX.proto.event_pb2 import Event

    found = []
    for path in sorted(folder.glob("events.*")):
        content, at = path.read_bytes(), 0
        while at < len(content):
            (length,) = struct.unpack_from("<Q", content, at)
            found.append(Event.FromString(content[at + 12 : at + 12 + length]))
            at += 16 + length
    return found


def test_tensorboard_gets_scalars(tmp_path: Path):
    log = ac.TensorBoardLog(tmp_path)
    for epoch in (3, 7):
        log(report(epoch))
    log.close()
    found = {
        (value.tag, event.step): value.simple_value
        for event in events(tmp_path)
        for value in event.summary.value
    }
    assert found["loss", 3] == pytest.approx(1 / 3)
    assert found["seconds", 7] == 3.5
    assert {tag for tag, _ in found} == {"loss", "best", "seconds", "seconds_per_epoch", "diverged"}
    assert [e.step for e in events(tmp_path) if e.HasField("session_log")] == [
        3
    ]  # what was later is void


def test_without_tensorboard_one_sentence_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(sys.modules, "tensorboardX", None)
    with pytest.raises(ac.TrainingError) as error:
        ac.TensorBoardLog("logs")
    assert str(error.value) == (
        "TensorBoardLog needs tensorboardX: pip install 'acausal[tensorboard]'."
    )
