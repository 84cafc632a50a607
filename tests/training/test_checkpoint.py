"""Checkpoints: nothing is lost, whatever happens."""

from __future__ import annotations

import os
import platform
import re
import resource
import shutil
import signal
import subprocess
import sys
import warnings
from contextlib import ExitStack, closing
from functools import cache, partial
from pathlib import Path
from typing import Any

import equinox as eqx
import jax
import numpy as np
import optax
import pytest

import acausal as ac
from acausal.data import tensors
from acausal.files import Lock
from acausal.training import checkpoint as checkpoints
from acausal.training.fingerprint import digest, program
from acausal.training.history import TrainingLog
from acausal.training.objective.records import Places
from tests.support.interrupted import EPOCHS, train
from tests.support.oscillator import learned, plain, record
from tests.support.paths import ROOT
from tests.support.slow_machine import slow_down

NAME = "checkpoint.safetensors"


@cache
def uninterrupted() -> ac.Fit:
    return train()


def same(one: ac.Fit, other: ac.Fit) -> None:
    """Bit for bit, all but the clock."""
    a, b = (eqx.filter(fit.params, eqx.is_array_like) for fit in (one, other))
    jax.tree.map(np.testing.assert_array_equal, a, b)
    for name in ("loss", "full_loss"):
        np.testing.assert_array_equal(getattr(one.history, name), getattr(other.history, name))
    for name in ("penalties", "modifiers"):
        jax.tree.map(
            np.testing.assert_array_equal, getattr(one.history, name), getattr(other.history, name)
        )
    assert one.history.divergences == other.history.divergences
    assert (one.loss, one.best_epoch, one.x0) == (other.loss, other.best_epoch, other.x0)


def stop(epoch: int, error: type[BaseException] = KeyboardInterrupt) -> Any:
    def observer(progress: Any) -> None:
        if progress.epoch >= epoch:
            raise error

    return observer


@pytest.fixture
def one_by_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """A report after every update."""
    slow_down(monkeypatch)


@pytest.fixture(scope="module")
def interrupted(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A checkpoint of a training that was interrupted at epoch 10."""
    folder = tmp_path_factory.mktemp("interrupted")
    with pytest.MonkeyPatch.context() as patch:
        slow_down(patch)
        fit = train(checkpoint=folder, observers=[stop(10)])
    assert fit.interrupted
    assert fit.history.epochs == 10
    return folder / NAME


# -- going on ----------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.usefixtures("one_by_one")
def test_a_training_goes_on_after_every_kind_of_break(tmp_path: Path):
    """Ctrl-C in the first segment, an error of the user's in the second, and once more in the third run."""
    fit = train(checkpoint=tmp_path, resume=True, observers=[stop(12)])  # none there: it begins
    assert (fit.interrupted, fit.history.epochs) == (True, 12)
    with pytest.raises(ZeroDivisionError):
        train(checkpoint=tmp_path, resume=True, observers=[stop(33, ZeroDivisionError)])
    assert train(checkpoint=tmp_path, resume=True, observers=[stop(38)]).history.epochs == 38
    last = train(checkpoint=tmp_path, resume=True)
    same(last, uninterrupted())
    assert np.all(np.diff(last.history.seconds) > 0)
    assert not last.interrupted


@pytest.mark.slow
def test_a_training_that_has_ended_goes_on_to_where_it_is(tmp_path: Path):
    fit = train(checkpoint=tmp_path / "run.safetensors", checkpoint_every=1e9)
    same(fit, uninterrupted())
    seen: list[Any] = []
    again = train(checkpoint=tmp_path / "run.safetensors", resume=True, observers=[seen.append])
    same(again, fit)
    assert not seen
    assert [p.name for p in tmp_path.iterdir()] == ["run.safetensors"]


def killed(path: Path, at: int, never: int | None = None) -> None:
    """Train in a process of its own that waits at an epoch, and kill it there; or it kills itself while writing."""
    environment = os.environ | {
        "JAX_COMPILATION_CACHE_DIR": str(path.parent / "cache"),
        "JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS": "0",
    }
    command = [sys.executable, "-m", "tests.support.interrupted", str(path), str(at)]
    command += [] if never is None else [str(never)]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, text=True, env=environment, cwd=ROOT
    ) as process:  # fmt: skip
        assert process.stdout is not None
        if process.stdout.readline():
            process.kill()
        assert process.wait() == -signal.SIGKILL


@pytest.mark.slow
def test_a_killed_training_goes_on(tmp_path: Path, pytestconfig: pytest.Config):
    """Killed between updates of the first segment, half-way through a writing, and in the second segment."""
    if pytestconfig.getoption("last_bits", None) is not None:
        pytest.skip("another process trains on the record with the bits that it has")
    path = tmp_path / NAME
    killed(path, 1)
    killed(path, sum(EPOCHS), never=12)
    assert list(tmp_path.glob(f".{NAME}.*.part"))  # killed while writing
    killed(path, EPOCHS[0] + 2)
    same(train(checkpoint=path, resume=True), uninterrupted())
    assert not list(tmp_path.glob(f".{NAME}.*"))


# -- what goes wrong ---------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_checkpoint_is_not_overwritten_by_another_training(interrupted: Path):
    before = interrupted.read_bytes()
    with pytest.raises(ac.TrainingError) as error:
        train(checkpoint=interrupted)
    assert str(error.value) == (
        f"There is a checkpoint '{interrupted}' already: resume=True goes on from it; "
        "to start again, remove it or name another file."
    )
    assert interrupted.read_bytes() == before


@pytest.mark.slow
def test_nothing_to_resume():
    with pytest.raises(ac.TrainingError, match=r"^resume=True needs a checkpoint to go on from"):
        train(resume=True)


@pytest.mark.parametrize(
    ("chosen", "names"),
    [
        ({"seed": 1}, "'params', 'seed'"),
        ({"epochs": (30, 21)}, "'epochs'"),
        ({"optimizer": optax.adam(0.02)}, "'optimizer'"),
        ({"regularizers": [ac.ZeroCrossing(0.02)]}, "'regularizers'"),
        ({"modifiers": {"mass.m": 0.1}}, "'modifiers'"),
        ({"batch_size": 2}, "'sequence_length, batch_size or subsample'"),
        ({"params": learned().parameters(0) | {"mass.m": 1.0}}, "'params'"),
        ({"loss": lambda p, q, sigma: ((p - q) ** 2).mean()}, "'loss'"),
        ({"solver": "rk4"}, "'solver'"),
    ],
)
def test_a_checkpoint_of_another_training_is_refused(
    interrupted: Path, chosen: dict[str, Any], names: str
):
    with pytest.raises(ac.DataError) as error:
        train(checkpoint=interrupted, resume=True, **chosen)
    assert str(error.value) == (
        f"Checkpoint '{interrupted}' is of another training: {names} differ. "
        "Resume with the arguments it was started with, or name another file."
    )


@pytest.mark.slow
def test_states_that_are_no_targets_are_part_of_the_data(tmp_path: Path):
    """Trained states begin where measured ones were, and move relative to that."""
    data = record(end=2.0).select(["mass.a", "mass.s", "push.f"])
    chosen: dict[str, Any] = {
        "x0": "fit", "modifiers": ["mass.m"], "strategy": "sequences", "epochs": 2, "checkpoint": tmp_path,
        "resume": True, "progress": False,
    }  # fmt: skip
    ac.fit(plain(), data, "mass.a", **chosen)
    moved = ac.Data(data.time, {**data.signals, "mass.s": data["mass.s"] + 0.1})
    with pytest.raises(ac.DataError, match=r"is of another training: 'data' differ\."):
        ac.fit(plain(), moved, "mass.a", **chosen)


def tampered(path: Path) -> bytes:
    content = bytearray(path.read_bytes())
    content[-5] ^= 1
    return bytes(content)


@pytest.mark.parametrize(
    ("spoil", "sentence"),
    [
        (lambda path: path.read_bytes()[:-100], "is damaged or not a safetensors file"),
        (lambda path: path.read_bytes()[:5], "is damaged or not a safetensors file"),
        (lambda path: b"", "is damaged or not a safetensors file"),
        (lambda path: b"weights: 1, 2, 3, ...", "is damaged or not a safetensors file"),
        (tampered, "was changed after it was written: its checksum does not fit."),
    ],
    ids=["truncated", "cut off", "empty", "text", "tampered"],
)
def test_a_damaged_checkpoint_is_refused(
    interrupted: Path, tmp_path: Path, spoil: Any, sentence: str
):
    path = tmp_path / NAME
    path.write_bytes(spoil(interrupted))
    with pytest.raises(ac.DataError) as error:
        train(checkpoint=path, resume=True)
    assert str(error.value).startswith(f"'{path}' {sentence}")


def test_files_of_other_kinds_are_refused(tmp_path: Path):
    from safetensors.numpy import save_file

    path = tmp_path / NAME
    save_file({"weights": np.zeros(3)}, path)
    with pytest.raises(ac.DataError, match="was not written by acausal"):
        train(checkpoint=path, resume=True)
    tensors.write_arrays(path, {"weights": np.zeros(3)}, {"kind": "parameters"})
    with pytest.raises(
        ac.DataError, match=r"is not a checkpoint of a training, .* but: parameters"
    ):
        train(checkpoint=path, resume=True)


def failing(error: OSError) -> Any:
    def fail(*arguments: Any, **named: Any) -> None:
        raise error

    return fail


def test_where_nothing_can_be_written_training_does_not_begin(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(os, "fsync", failing(OSError(28, "No space left on device")))
    with pytest.raises(ac.TrainingError) as error:
        train(checkpoint=tmp_path)
    assert str(error.value) == (
        f"Checkpoint '{tmp_path / NAME}' cannot be written: No space left on device. Nothing was trained."
    )
    assert list(tmp_path.iterdir()) == []
    monkeypatch.setattr(Path, "open", failing(PermissionError(13, "Permission denied")))
    with pytest.raises(ac.TrainingError, match=r"cannot be written: Permission denied\."):
        train(checkpoint=tmp_path)
    monkeypatch.setattr(Path, "mkdir", failing(OSError(30, "Read-only file system")))
    with pytest.raises(ac.TrainingError, match=r"cannot be created: Read-only file system\."):
        train(checkpoint=tmp_path / "run")


@pytest.mark.slow
@pytest.mark.usefixtures("one_by_one")
def test_training_survives_a_disk_that_is_full(tmp_path: Path):
    """Files cannot grow any more, as the system really does it: one warning on the way, one at the end."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)

    def fill(progress: Any) -> None:
        if progress.epoch == 10:
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, limits[1]))

    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        try:
            fit = train(checkpoint=tmp_path, observers=[fill])
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    same(fit, uninterrupted())
    texts = [str(w.message) for w in told]  # without those of JAX's cache, whose disk is full, too
    first, last = (text for text in texts if "compilation cache" not in text)
    path = tmp_path / NAME
    assert first == (
        f"Checkpoint '{path}' cannot be written at epoch 11: File too large; that of epoch 10 is still there. "
        "The training goes on."
    )
    assert last == (
        f"Checkpoint '{path}' cannot be written at epoch {fit.history.epochs}: File too large; "
        "that of epoch 10 is still there. The training has ended: save its result elsewhere, "
        "ac.save_params(fit.params, ...)."
    )
    same(train(checkpoint=path, resume=True), uninterrupted())


def test_two_trainings_with_one_checkpoint_are_refused(tmp_path: Path):
    with closing(Lock(tmp_path / NAME)) as lock:
        lock.hold()
        with pytest.raises(ac.TrainingError) as error:
            train(checkpoint=tmp_path)
    assert str(error.value) == (
        f"Checkpoint '{tmp_path / NAME}' cannot be written: process {os.getpid()} on {platform.node()} is writing it; "
        "wait until that ends, or name another file. Nothing was trained."
    )


def snapshots() -> tuple[checkpoints.Snapshot, checkpoints.Logs]:
    log = TrainingLog(Places(np.zeros(1), np.zeros(3, int), ("record",)), (), ())
    return checkpoints.Snapshot(0, 0, None, (), 0, 0.0, 0.0, 0.0), (log.rows(),)


@pytest.mark.parametrize("again", [False, True], ids=["removed", "made again by another training"])
def test_a_checkpoint_whose_folder_is_removed_is_not_said_to_be_there(tmp_path: Path, again: bool):
    path = tmp_path / "run" / NAME
    path.parent.mkdir()
    with ExitStack() as other, warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        with checkpoints.keeping(path, 0.0, {}) as keep:
            keep(*snapshots())
            shutil.rmtree(path.parent)
            if again:
                path.parent.mkdir()
                other.enter_context(checkpoints.keeping(path, 0.0, {}))(*snapshots())
            keep(*snapshots())
    for warning in told:
        assert re.match(
            rf"Checkpoint '.*' cannot be written at epoch 0: {'process' if again else 'No such file or directory'}.*; "
            r"that of epoch 0 is no longer there\. The training ",
            str(warning.message),
        )
    assert len(told) == 2
    assert path.exists() is again


# -- parts -------------------------------------------------------------------------------------------


def test_checkpoints_are_written_at_intervals(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    now, written = [0.0], []
    monkeypatch.setattr(checkpoints.time, "monotonic", lambda: now[0])
    monkeypatch.setattr(
        "acausal.training.checkpoint.write_arrays", lambda *arguments: written.append(now[0])
    )
    with checkpoints.keeping(tmp_path / NAME, 60.0, {}) as keep:
        for now[0] in np.arange(0.0, 200.0, 25.0):
            keep(*snapshots())
    assert written == [0.0, 75.0, 150.0, 175.0]


@pytest.mark.slow
def test_a_loss_whose_helper_has_changed_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """The loss itself is the same function."""
    chosen: dict[str, Any] = {"loss": scaled, "checkpoint": tmp_path, "epochs": 1, "resume": True}
    train(**chosen)
    assert train(**chosen).history.epochs == 2
    monkeypatch.setitem(SCALE, "a", 2.0)
    with pytest.raises(ac.DataError, match=r"is of another training: 'loss' differ\."):
        train(**chosen)


SCALE = {"a": 1.0}


def scaled(predicted: Any, measured: Any, sigma: Any) -> Any:
    return SCALE["a"] * ((predicted - measured) ** 2).mean()


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (np.zeros(3), np.zeros((3, 1))),
        (np.zeros(3), np.zeros(3, np.float32)),
        ({"a": 1}, {"b": 1}),
        (1, 1.5),
        (2**60, 2**60 + 1),
        (np.inf, -np.inf),
        (np.nan, 0.0),
        ((1, (2, 3)), ((1, 2), 3)),
        (ac.MLP(activation="tanh", key=0), ac.MLP(activation="relu", key=0)),
        (jax.numpy.sin, jax.numpy.cos),
    ],
)
def test_digests_tell_things_apart(one: Any, other: Any):
    assert digest(one) != digest(other)
    assert digest(one) == digest(one)


def test_a_digest_is_that_of_the_value():
    assert digest([1, np.float64(2.0)]) == digest([1.0, 2])


CONSTANT = np.arange(5000.0)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (lambda x: x + 1, lambda x: x + 2),
        (lambda x: x + 1.0, lambda x: x + np.nextafter(1.0, 2.0)),
        (lambda x: x[0] * CONSTANT, lambda x: x[0] * np.where(CONSTANT == 2000, 0, CONSTANT)),
        (jax.jit(lambda x: x[:2] * np.array([1.0, 2.0])), jax.jit(lambda x: x[:2] * np.array([1.0, 3.0]))),
        (partial(jax.numpy.sum, axis=0), partial(jax.numpy.sum, axis=0, keepdims=True)),
    ],
)  # fmt: skip
def test_programs_tell_functions_apart(one: Any, other: Any):
    x = jax.numpy.zeros(3)
    assert program(one, x) != program(other, x)
    assert program(one, x) == program(one, x + 1)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (lambda: optax.adam(1e-2), lambda: optax.adam(1e-3)),
        (lambda: optax.adam(1e-2), lambda: optax.adabelief(1e-2)),
        (lambda: optax.add_noise(0.1, 0.1, 0), lambda: optax.add_noise(0.1, 0.1, 1)),
        (
            lambda: optax.sgd(optax.exponential_decay(1e-2, 300, 0.01)),
            lambda: optax.sgd(optax.exponential_decay(2e-2, 300, 0.01)),
        ),
    ],
)
def test_programs_tell_optimizers_apart(one: Any, other: Any):
    def first_update(optimizer: Any) -> str:
        return program(lambda x: optimizer.update(x, optimizer.init(x), x), jax.numpy.zeros(3))

    assert first_update(one()) != first_update(other())
    assert first_update(one()) == first_update(one())


def test_use_does_not_change_the_program_of_an_optimizer():
    """optax's schedule makes a float of its integer."""
    schedule = optax.cosine_decay_schedule(1e-2, 60)
    before = program(schedule, jax.numpy.zeros((), int))
    schedule(3)
    assert program(schedule, jax.numpy.zeros((), int)) == before


def test_a_digest_of_something_that_holds_itself_ends():
    recursive: list[Any] = [1]
    recursive.append(recursive)
    assert digest(recursive) == digest(recursive)
