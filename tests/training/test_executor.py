"""Calls with an executor find the same as without: each sends its tasks to two processes that all tests share."""

from __future__ import annotations

import re
from collections.abc import Iterator
from concurrent.futures import Executor, Future
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.jobs import on_workers
from tests.support.oscillator import learned, plain, record
from tests.support.workers import killed_once, spawned

SHORT: dict[str, Any] = {"strategy": "whole_record", "epochs": 4, "progress": False}
OVER = {"spring.c": np.linspace(40.0, 80.0, 35), "push.f": [5.0, 10.0]}


@pytest.fixture(scope="module")
def pool() -> Iterator[Executor]:
    with spawned() as found:
        yield found


class LostOnce(Executor):
    """Does every task here; what the first one has returned is lost."""

    def __init__(self) -> None:
        self.count = 0

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        self.count += 1
        result = fn(*args, **kwargs)
        if self.count == 1:
            future.set_exception(OSError("the node is gone"))
        else:
            future.set_result(result)
        return future


def parts() -> dict[str, ac.Data]:
    every = record(cubic=0.0, end=6.0, dt=0.02)
    return {"a": every.between(0, 2), "b": every.between(2, 4), "c": every.between(4, 6)}


@pytest.mark.slow
def test_a_sweep_is_the_same(pool: Executor) -> None:
    found = ac.sweep(plain(), OVER, 1.0, dt=0.02, executor=pool)
    here = ac.sweep(plain(), OVER, 1.0, dt=0.02)
    assert found.shape == here.shape == (35, 2, 51)
    for name in ("mass.s", "spring.f", "push.f"):
        np.testing.assert_allclose(found[name], here[name], rtol=1e-12, atol=1e-15)
    adaptive = [
        ac.sweep(plain(), {"spring.d": [0.1, 1.0, 2.0]}, 1.0, inputs={"push.f": 5.0}, executor=e)
        for e in (pool, None)
    ]
    np.testing.assert_allclose(adaptive[0].t, adaptive[1].t)
    np.testing.assert_allclose(adaptive[0]["mass.s"], adaptive[1]["mass.s"], rtol=1e-9, atol=1e-12)


@pytest.mark.slow
def test_an_ensemble_is_the_same(pool: Executor) -> None:
    data = record(end=2.0)
    given: dict[str, Any] = {"members": 2, "modifiers": ["mass.m"], **SHORT}
    found = ac.ensemble(learned(), data, "mass.a", executor=pool, **given)
    here = ac.ensemble(learned(), data, "mass.a", **given)
    assert found.fits[0].system is found.fits[1].system
    for one, other in zip(found.fits, here.fits, strict=True):
        assert one.loss == pytest.approx(other.loss, rel=1e-6)
        assert one.modifiers["mass.m"] == pytest.approx(other.modifiers["mass.m"], rel=1e-5)
        np.testing.assert_allclose(one.history.loss, other.history.loss, rtol=1e-6)


@pytest.mark.slow
def test_folds_are_the_same(pool: Executor) -> None:
    given: dict[str, Any] = {"modifiers": ["mass.m", "spring.d"], "gamma": 0.9, **SHORT}
    found = ac.cross_validate(plain(), parts(), "mass.s", executor=pool, **given)
    here = ac.cross_validate(plain(), parts(), "mass.s", **given)
    assert [fold.name for fold in found.folds] == ["a", "b", "c"]
    for one, other in zip(found.folds, here.folds, strict=True):
        assert one.held_out_loss == pytest.approx(other.held_out_loss, rel=1e-6)
        assert one.parameters == pytest.approx(other.parameters, rel=1e-6)


@pytest.mark.slow
def test_starts_all_go_to_the_end(pool: Executor) -> None:
    given: dict[str, Any] = {"modifiers": {"spring.c": ac.Bounded(5.0, 500.0)}, **SHORT}
    found, here = (
        ac.fit(plain(), parts()["a"], "mass.s", starts=5, executor=e, **given) for e in (pool, None)
    )
    assert found.starts is not None
    assert here.starts is not None
    np.testing.assert_allclose(found.starts.values, here.starts.values)
    assert found.starts.finished.all()
    assert not here.starts.finished.all()
    own = here.starts.finished
    np.testing.assert_allclose(found.starts.loss[own], here.starts.loss[own], rtol=1e-6)
    assert found.loss == pytest.approx(here.loss, rel=1e-6)


@pytest.mark.slow
def test_predictions_are_the_same(pool: Executor) -> None:
    fit = ac.fit(plain(), parts()["a"], "mass.s", modifiers=["mass.m"], **SHORT)
    x0: Any = {"a": "data", "b": {"mass.s": 0.1, "mass.v": 0.0}, "c": "auto"}
    for start in ("auto", x0):
        found, here = fit.predict(parts(), start, executor=pool), fit.predict(parts(), start)
        assert list(found) == list(here)
        for name, one in here.items():
            np.testing.assert_allclose(found[name].predicted, one.predicted, rtol=1e-6, atol=1e-9)
            sigma = found[name].bands["mass.s"].sigma
            np.testing.assert_allclose(sigma, one.bands["mass.s"].sigma, rtol=1e-4)
    errors = fit.evaluate(parts(), executor=pool)
    assert list(errors.index) == ["a: mass.s", "b: mass.s", "c: mass.s"]


@pytest.mark.slow
def test_errors_of_workers_are_those_of_the_call(pool: Executor) -> None:
    with pytest.raises(ac.AcausalError) as here:
        ac.sweep(plain(), OVER, -1.0, dt=0.02)
    with pytest.raises(type(here.value), match=re.escape(str(here.value)[:60])):
        ac.sweep(plain(), OVER, -1.0, dt=0.02, executor=pool)


@pytest.mark.slow
def test_a_pool_with_a_killed_worker_is_made_again(tmp_path: Path) -> None:
    assert on_workers(spawned, killed_once, tmp_path / "killed", range(6), "double") == [
        0, 2, 4, 6, 8, 10,
    ]  # fmt: skip


@pytest.mark.machines
def test_a_training_whose_worker_is_lost_goes_on_from_its_own_checkpoint(tmp_path: Path) -> None:
    given: dict[str, Any] = {
        "members": 2, "modifiers": ["mass.m"], "checkpoint": tmp_path / "run.safetensors", **SHORT
    }  # fmt: skip
    lost = LostOnce()
    found = ac.ensemble(learned(), record(end=2.0), "mass.a", executor=lost, **given)
    assert lost.count == 3
    assert sorted(p.name for p in tmp_path.glob("*.safetensors")) == [
        "run-0.safetensors", "run-1.safetensors"
    ]  # fmt: skip
    with pytest.raises(ac.TrainingError, match=r"run-0.*already: resume=True"):
        ac.ensemble(learned(), record(end=2.0), "mass.a", executor=lost, **given)
    again = ac.ensemble(
        learned(), record(end=2.0), "mass.a", executor=LostOnce(), resume=True, **given
    )
    for one, other in zip(found.fits, again.fits, strict=True):
        assert one.history.seconds[-1] == other.history.seconds[-1]  # nothing was trained again
        assert one.loss == other.loss


@pytest.mark.parametrize(
    ("given", "match"),
    [
        ({"observers": [print]}, "observers= needs a training in this process"),
        ({"executor": 2}, "neither an executor nor"),
    ],
)
def test_what_does_not_go_together_is_refused(given: dict[str, Any], match: str) -> None:
    with pytest.raises(ac.TrainingError, match=match):
        ac.fit(plain(), parts(), "mass.s", **{"executor": LostOnce(), **given})
