"""Records that are read while training: the same batches, and so the same laws, as with all of them in memory."""

from __future__ import annotations

import warnings
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import Any

import jax
import numpy as np
import pytest
from scipy.io import savemat

import acausal as ac
from acausal.training import read_ahead
from acausal.training.objective import streamed
from tests.support.oscillator import plain
from tests.training.test_records import run

KEPT = ("mass.s", "mass.v", "mass.a", "push.f")


@cache
def records() -> dict[str, ac.Data]:
    """Four runs of unequal lengths; the states of one are not measured at times, and targets of another neither."""
    found = {f"run {i}": run(2.0 + 0.5 * i, i) for i in range(4)}
    found["run 2"] = with_gaps(found["run 2"], "mass.v", slice(100, 120))
    found["run 3"] = with_gaps(found["run 3"], "mass.a", slice(50, 60))
    return found


def with_gaps(record: ac.Data, name: str, rows: slice) -> ac.Data:
    signals = {n: record[n].copy() for n in record.names}
    signals[name][rows] = np.nan
    return ac.Data(record.time, signals, missing="nan")


@pytest.fixture(scope="module")
def stream(tmp_path_factory):
    """The same runs in files."""
    folder = tmp_path_factory.mktemp("runs")
    for name, record in records().items():
        columns = {n.replace(".", "_"): record[n] for n in KEPT}
        savemat(folder / f"{name}.mat", {"time": record.time, **columns})
    names = {n.replace(".", "_"): n for n in KEPT}
    return ac.Data.stream(f"{folder}/*.mat", rename=names, missing="nan")


def train(data: Any, **chosen: Any) -> ac.Fit:
    defaults: dict[str, Any] = {
        "strategy": "sequences", "sequence_length": 0.2, "batch_size": 3, "epochs": 12, "modifiers": ["mass.m"],
        "per_record": {"spring.c": 2.0}, "subsample": 0.7, "evaluate_every": 5, "progress": False,
    }  # fmt: skip
    return ac.fit(plain(), data, "mass.a", **(defaults | chosen))


def assert_same(one: ac.Fit, other: ac.Fit) -> None:
    np.testing.assert_allclose(one.history.loss, other.history.loss, rtol=1e-10)
    for a, b in zip(jax.tree.leaves(one.trained), jax.tree.leaves(other.trained), strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-9, atol=1e-11)


@cache
def in_memory() -> ac.Fit:
    return train(records())


def test_a_stream_describes_and_reads_one_record(stream):
    assert repr(stream) == "Stream(4 records, read when needed: 'run 0', 'run 1', 'run 2', ...)"
    np.testing.assert_array_equal(stream["run 1"]["mass.s"], records()["run 1"]["mass.s"])
    assert list(dict(stream)) == list(records())
    with pytest.raises(ac.DataError, match="no record 'run 7'"):
        stream["run 7"]


@pytest.mark.slow
def test_the_training_is_that_of_the_same_records_in_memory(stream, monkeypatch):
    monkeypatch.setattr(read_ahead, "BYTES", 20_000)  # a few updates at a time
    found = train(stream)
    assert_same(found, in_memory())
    assert found.loss == pytest.approx(in_memory().loss, rel=1e-10)
    assert found.problem.records.count == 4


@pytest.mark.slow
def test_it_is_evaluated_over_the_beginnings_of_records(stream, monkeypatch):
    monkeypatch.setattr(streamed, "SAMPLES_IN_MEMORY", 4 * 60)
    others = {"other": run(1.5, 9)}
    found = train(stream, validation=others)
    assert {len(record.time) for record in found.records.values()} == {60}
    assert_same(found, train(records(), validation=others))
    assert "the first 240 of 1104 samples" in str(found)


@pytest.mark.slow
def test_a_training_goes_on_from_its_checkpoint(stream, tmp_path, monkeypatch):
    monkeypatch.setattr(read_ahead, "BYTES", 40_000)
    monkeypatch.setattr(streamed, "SAMPLES_IN_MEMORY", 4 * 60)
    chosen: dict[str, Any] = {"checkpoint": tmp_path / "run.safetensors", "checkpoint_every": 0.0}

    def interrupt(progress: Any) -> None:
        if progress.epoch >= 5:
            raise KeyboardInterrupt

    part = train(stream, observers=[interrupt], **chosen)
    assert part.interrupted
    assert part.history.epochs < 12
    whole = train(stream, resume=True, **chosen)
    np.testing.assert_allclose(whole.history.loss, in_memory().history.loss, rtol=1e-10)
    with pytest.raises(ac.DataError, match=r"another training:.*'data'"):
        train(
            ac.Data.stream({n: stream.sources[n] for n in list(stream)[1:]}), resume=True, **chosen
        )


@pytest.mark.slow
def test_sequences_that_diverge_are_named_by_record_and_time(stream):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        fit = train(stream, params={"spring.c": 1e30}, epochs=2)
    first = fit.history.divergences[0]
    assert first.record in stream.sources
    assert 0 <= first.time <= stream[first.record].time[-1]


def test_any_source_will_do(tmp_path):
    frames = {n: d.to_dataframe() for n, d in list(records().items())[:2]}
    for name, frame in frames.items():
        frame.reset_index().to_csv(tmp_path / f"{name}.csv", index=False)
    sources = {n: d.to_xarray() for n, d in list(records().items())[:2]}
    for given in (f"{tmp_path}/*.csv", sources, {n: lambda f=f: f for n, f in frames.items()}):
        for name, record in dict(ac.Data.stream(given)).items():
            np.testing.assert_allclose(record["mass.a"], records()[name]["mass.a"], rtol=1e-12)


@pytest.mark.parametrize(
    ("chosen", "named"),
    [
        (
            {"strategy": "auto", "sequence_length": None, "batch_size": None, "subsample": None},
            "strategy='auto'",
        ),
        ({"strategy": ("sequences", "whole_record"), "epochs": 3}, "strategy='whole_record'"),
        ({"sequence_length": None}, "sequence_length=None"),
        ({"x0": "fit"}, "x0='fit'"),
        ({"delays": {"push.f": 0.1}}, "delays="),
        ({"validation": 0.2}, "validation= of a part"),
        ({"record_weights": "records"}, "record_weights="),
    ],
)
def test_what_needs_whole_records_refuses_a_stream(stream, chosen, named):
    with pytest.raises(
        ac.TrainingError, match=f"{named} needs whole records in memory.* dict.stream. to read all"
    ):
        train(stream, **chosen)


@pytest.mark.slow
def test_members_are_trained_on_workers(stream):
    found = ac.ensemble(
        plain(), stream, "mass.a", members=2, executor=ThreadPoolExecutor, progress=False, epochs=2,
        modifiers=["mass.m"], strategy="sequences", sequence_length=0.2,
    )  # fmt: skip
    alone = train(stream, seed=1, per_record=None, subsample=None, batch_size=None, epochs=2)
    np.testing.assert_allclose(found.fits[1].history.loss, alone.history.loss, rtol=1e-10)


def test_other_refusals_say_what_to_do(stream, tmp_path):
    with pytest.raises(ac.TrainingError, match="give executor="):
        ac.ensemble(plain(), stream, "mass.a", members=2, strategy="sequences")
    given: Any = stream
    for call in (
        lambda: ac.cross_validate(plain(), given, "mass.a"),
        lambda: in_memory().predict(given),
    ):
        with pytest.raises(ac.DataError, match=r"give some, such as \[stream\['run 7'\]\]"):
            call()
    with pytest.raises(ac.DataError, match=r"'run 1': The data have 'x'"):
        train(ac.Data.stream({"run 1": lambda: {"time": [0, 1], "x": [1, 2]}}))
    (tmp_path / "a.csv").write_text("")
    (tmp_path / "b.mat").write_text("")
    with pytest.raises(ac.DataError, match="several kinds"):
        ac.Data.stream(f"{tmp_path}/*")
    with pytest.raises(ac.DataError, match="there are no records"):
        ac.Data.stream({})
