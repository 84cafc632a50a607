"""The campaign: its runs are measured as told, and the drive train is learned from them."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from examples.campaign import figures, study
from examples.campaign.model import GAUGE, INPUT, OFFSET, SPEED, TRAINED, learning, truth
from examples.campaign.runs import EVERY, LATE, RUNS, campaign
from tests.support.counted import compilations


@pytest.mark.slow
def test_runs_differ_in_length_rates_and_gaps() -> None:
    records = campaign()
    assert list(records) == list(RUNS)
    assert len({len(record) for record in records.values()}) == 4
    for name, record in records.items():
        run = RUNS[name]
        assert record.time[-1] == pytest.approx(run.seconds)
        speed, gauge = (np.isfinite(record.signals[n]) for n in (SPEED, GAUGE))
        assert speed.mean() == pytest.approx(1 - run.lost, abs=0.01)
        missing = 0.0 if run.gap is None else (run.gap[1] - run.gap[0]) / run.seconds
        assert gauge.mean() == pytest.approx((1 - missing) / EVERY, abs=0.005)


def test_the_learner_has_the_states_of_the_truth_and_trains_what_it_has() -> None:
    assert learning().states == truth().states
    assert {*TRAINED, OFFSET, "friction.net", "cogging.net"} <= set(learning().parameters())


def test_true_laws_are_those_of_the_components() -> None:
    """At rest of all but the motor or the load, the accelerations are the torques over the inertias."""
    system = truth()
    params = system.parameters()
    turned = 0.3
    x = np.array([{"motor.phi": turned, "load.phi": turned}.get(n, 0.0) for n in system.states])
    rate = dict(
        zip(
            system.states, np.asarray(system.vector_field(0.0, x, np.zeros(1), params)), strict=True
        )
    )
    assert -params["motor.J"] * rate["motor.w"] == pytest.approx(
        study.true_cogging(np.array([turned]))[0]
    )
    x = np.array([{"motor.w": 2.0, "load.w": 2.0}.get(n, 0.0) for n in system.states])
    rate = dict(
        zip(
            system.states, np.asarray(system.vector_field(0.0, x, np.zeros(1), params)), strict=True
        )
    )
    assert -params["load.J"] * rate["load.w"] == pytest.approx(
        study.true_friction(np.array([2.0]))[0]
    )


@cache
def compiled_and_studied() -> tuple[list[str], study.Study]:
    with compilations() as compiled:
        found = study.study(updates=40, progress=False)
    return compiled, found


def short() -> study.Study:
    return compiled_and_studied()[1]


@pytest.mark.slow
def test_a_short_training_is_better_than_none_in_every_fold() -> None:
    found = short()
    assert [fold.name for fold in found.crossed.folds] == list(RUNS)
    assert found.fit.loss < 0.5 * found.fit.loss_before
    assert all(fit.loss < 0.5 * fit.loss_before for fit in found.crossed.fits)


@pytest.mark.slow
def test_the_page_shows_all_of_it(tmp_path: Path) -> None:
    page = figures.page(short(), tmp_path)
    text = page.read_text()
    assert "Five runs of a drive train" in text
    assert all(name in text for name in (*RUNS, *TRAINED))
    for part in ("training", "cross-validation"):
        assert (tmp_path / part / "index.html").exists()


@pytest.mark.slow
def test_folds_share_the_program_of_the_training() -> None:
    compiled, _ = compiled_and_studied()
    assert compiled.count("jit(advance)") == 1


@pytest.mark.machines
def test_laws_parameters_and_offsets_are_found() -> None:
    found = study.study(progress=False)
    assert study.errors_of_laws(found.fit)["friction"] < 0.01
    assert study.errors_of_laws(found.fit)["cogging"] < 0.002
    exact = truth().parameters()
    for name in TRAINED:
        assert found.fit.params[name] == pytest.approx(float(exact[name]), rel=0.01)
    assert found.fit.delays[INPUT] == pytest.approx(LATE, abs=2e-4)
    for name, run in RUNS.items():
        assert found.fit.records[name].parameters[OFFSET] == pytest.approx(run.offset, abs=0.003)
    assert found.crossed.rms[SPEED].mean < 0.4
