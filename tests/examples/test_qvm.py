"""The quarter vehicle: the paper's equations, its data, and a short training from end to end."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

import acausal as ac
from examples.qvm import demo, experiments, promises
from examples.qvm.judge import DAMPER, SPRING, loss, true_forces
from examples.qvm.model import linear, truth, with_networks
from examples.qvm.record import INPUT, Ride, ride, rough_road

SHORT = {
    "body.s": "z_b", "body.v": "v_b", "wheel.s": "z_w", "wheel.v": "v_w", "road.s": "z_r", "road.v_ref": "u",
    "body.m": "m_b", "wheel.m": "m_w", "suspension.c": "c_s", "suspension.d": "d_s", "tyre.c": "c_t", "tyre.d": "d_t",
}  # fmt: skip
z_b, v_b, z_w, v_w, z_r, u, m_b, m_w, c_s, d_s, c_t, d_t = sp.symbols(" ".join(SHORT.values()))


@pytest.fixture(scope="module")
def measured() -> Ride:
    return ride(0.02)


def right_hand_sides(system: ac.System) -> list[sp.Expr]:
    names = {sp.Symbol(long): sp.Symbol(short) for long, short in SHORT.items()}
    return [equation.rhs.xreplace(names) for equation in system.equations]


@pytest.mark.parametrize("learned", [False, True], ids=["physics", "with networks"])
def test_the_equations_are_those_of_the_paper(learned: bool) -> None:
    system = ac.compile(with_networks() if learned else linear())
    assert system.states == ("body.s", "body.v", "wheel.s", "wheel.v", "road.s")
    assert system.inputs == ("road.v_ref",)
    extra = sp.Function(SPRING)(z_w - z_b) + sp.Function(DAMPER)(v_w - v_b) if learned else 0
    force = c_s * (z_w - z_b) + d_s * (v_w - v_b) + extra
    tyre = c_t * (z_r - z_w) + d_t * (u - v_w)
    expected = [v_b, force / m_b, v_w, (tyre - force) / m_w, u]
    assert [
        sp.simplify(a - b) for a, b in zip(right_hand_sides(system), expected, strict=True)
    ] == [0] * 5


@pytest.mark.slow
def test_the_road_is_rough_as_the_norm_says() -> None:
    time, velocity = rough_road(1, scale=1.0)
    height = np.cumsum(velocity) * (time[1] - time[0])
    power = np.abs(np.fft.rfft(height * np.hanning(len(height)))) ** 2
    frequency = np.fft.rfftfreq(len(height), time[1] - time[0])
    band = (frequency > 0.5) & (frequency < 20)
    exponent = np.polyfit(np.log(frequency[band]), np.log(power[band]), 1)[0]
    assert exponent == pytest.approx(-2.0, abs=0.3)


def test_the_ride_is_the_papers(measured: Ride) -> None:
    clean = measured.clean
    assert (clean["wheel.v"] - clean["body.v"]).std() == pytest.approx(0.14, abs=0.005)
    assert (clean["wheel.s"] - clean["body.s"]).std() == pytest.approx(5.9e-3, abs=0.6e-3)
    base = ac.compile(linear())
    assert loss(base, base.parameters(), measured.measured, measured) == pytest.approx(
        0.44, abs=0.01
    )


def test_a_perfect_model_is_left_with_the_noise(measured: Ride) -> None:
    system = ac.compile(truth())
    left = loss(system, system.parameters(), measured.measured, measured)
    assert left == pytest.approx(0.02 * np.sqrt(2), rel=0.05)


def test_true_forces_are_the_formulas() -> None:
    forces = true_forces()
    z, v = np.linspace(-0.015, 0.015, 7), np.linspace(-0.4, 0.4, 9)
    np.testing.assert_allclose(
        forces[SPRING](z), (607 * (z + 0.0078)) ** 2 - (607 * 0.0078) ** 2, atol=1e-12
    )
    stribeck = v / (np.sqrt(2) * 0.02)
    friction = (
        np.sqrt(2 * np.e) * 10 * np.exp(-(stribeck**2)) * stribeck
        + 30 * np.tanh(v / 0.002)
        + 150 * v
    )
    np.testing.assert_allclose(forces[DAMPER](v), friction, atol=1e-12)


def test_wrong_parameters_and_their_modifiers_meet() -> None:
    right, wrong = (ac.compile(with_networks(wrong=w)).parameters() for w in (False, True))
    for name, modifier in experiments.UNCERTAIN.items():
        assert float(wrong[name]) * (1 + modifier) == pytest.approx(float(right[name]))
    assert all(wrong[n] == right[n] for n in ("suspension.c", "suspension.d"))


@pytest.mark.slow
def test_a_short_demo_writes_its_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    settings = {**experiments.DEMO.settings, "sequence_length": 0.25, "batch_size": 8}
    monkeypatch.setattr(demo, "DEMO", replace(experiments.DEMO, epochs=60, settings=settings))
    report = demo.run(0.0, out=tmp_path)
    assert report["loss"] < 0.6 * report["loss_linear"]
    written = json.loads((tmp_path / "report.json").read_text())
    assert {"loss", "loss_linear", "seconds", "seconds_to_paper_loss"} <= set(written)
    assert written["loss"] == report["loss"]
    for name in ("model.svg", "forces.png", "trajectories.png", "losses.png"):
        assert (tmp_path / name).stat().st_size > 5000
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert f"{report['loss']:.4f}" in page
    assert INPUT not in page


@pytest.mark.parametrize("way", promises.WAYS, ids=lambda way: way.name)
def test_networks_made_in_every_way_fit_the_vehicle(way: promises.Way) -> None:
    system = ac.compile(promises.vehicle(way))
    params = system.parameters(0)
    still = system.observe(["spring_nn.f", "damper_nn.f"], 0.0, [0.0] * 5, [0.0], params)
    assert (np.abs(still) < 1e-9).tolist() == [bool(way.spring), bool(way.damper)]
