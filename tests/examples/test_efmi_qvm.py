"""The example on the eFMI test case: its networks, its sweep, the C it writes, and the whole of it."""

from pathlib import Path

import jax
import numpy as np
import pytest

import acausal as ac
from examples.efmi_qvm import model, study
from examples.efmi_qvm.controller import Controller
from examples.qvm.record import INPUT, STATES
from tests.support.exported_c import need_compiler


def test_the_networks_are_those_of_the_test_case() -> None:
    params = ac.compile(model.with_networks()).parameters(0)
    for name in ("spring_nn.net", "damper_nn.net"):
        assert [w.shape for w in params[name].weights] == [(16, 1), (16, 16), (16, 16), (1, 16)]
        assert params[name].activation == "relu"
        assert sum(a.size for a in jax.tree.leaves(params[name])) == 593


def test_the_sweep_gets_faster_and_the_road_integrates_it() -> None:
    data = study.record(2.0)
    u, height = data[INPUT], data["road.s"]
    amplitude, offset, slope = 0.08, 0.5, 9.5 / model.DURATION
    phase = 2 * np.pi * (offset * data.time + slope * data.time**2 / 2)
    np.testing.assert_allclose(u, amplitude * np.sin(phase), atol=1e-9)
    heights = np.concatenate([[0.0], np.cumsum((u[1:] + u[:-1]) / 2)]) * model.SAMPLE_TIME
    np.testing.assert_allclose(height, heights, atol=1e-6)


@pytest.mark.parametrize("solver", study.SOLVERS)
def test_the_controller_is_measured_and_computes_what_simulate_does(
    tmp_path: Path, solver: str
) -> None:
    command = need_compiler()
    system = ac.compile(model.with_networks())
    params = system.parameters(0)
    files = ac.export.c(
        system, tmp_path, params, name="vehicle", outputs=("body.v", "tyre.f"), solver=solver,
        derivatives=False,
    )  # fmt: skip
    controller = Controller(*files, command)
    sizes = controller.sizes()
    assert sizes["parameters"] == len(params) - 2 + 2 * 593
    assert 0 < sizes["source_of_steps"] < sizes["source_without_values"] < sizes["source"]
    assert 1000 < sizes["machine_code"] < 5000
    u = 0.1 * np.sin(np.arange(50.0))
    ts = model.SAMPLE_TIME * np.arange(50)
    run = ac.simulate(
        system, (0.0, ts[-1]), dt=model.SAMPLE_TIME, solver=solver, params=params,
        inputs={INPUT: ac.Signal(ts, u)}, x0=dict.fromkeys(STATES, 0.0),
    )  # fmt: skip
    expected = np.stack([run["body.v"], run["tyre.f"]], axis=1)
    np.testing.assert_allclose(
        controller.drive(u, model.SAMPLE_TIME), expected, rtol=1e-9, atol=1e-12
    )


@pytest.mark.slow
def test_the_study_ships_a_vehicle_as_good_as_its_method(tmp_path: Path) -> None:
    need_compiler()
    report = study.run(0, tmp_path)
    assert max(report["heun"]["errors"].values()) < 0.03
    assert max(report["euler"]["errors"].values()) < 0.5  # of the method: the truth has no less
    for solver in study.SOLVERS:
        assert report[solver]["off"] < 1e-9
        assert report[solver]["source_of_steps"] < 5500
    assert (tmp_path / "report.json").is_file()
