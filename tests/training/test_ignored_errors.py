"""What the standard deviations of a confidence do not count, and that it says so."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from tests.support.oscillator import plain, record


def fitted(cubic: float, solver: str) -> ac.Fit:
    clean = record(cubic=cubic, end=10.0)
    signals = dict(clean.signals)
    noise = np.random.default_rng(3).standard_normal(len(clean.time))
    signals["mass.s"] = clean["mass.s"] + 0.01 * np.std(clean["mass.s"]) * noise
    return ac.fit(
        plain(), ac.Data(clean.time, signals), ["mass.s"], modifiers=["mass.m", "spring.c"],
        strategy="gauss_newton", solver=solver, progress=False,
    )  # fmt: skip


@pytest.mark.slow
def test_the_error_of_steps_is_told_where_it_moves_parameters_by_deviations():
    """Heun's steps err here as much as the noise lets one see; those of rk4 do not."""
    coarse, fine = (fitted(0.0, solver) for solver in ("heun", "rk4"))
    said = coarse.confidence()
    moved = abs(coarse.params["mass.m"] - fine.params["mass.m"]) / 2.0
    assert moved > 0.5 * said.parameters["mass.m"]
    assert said.step_move > moved / said.parameters["mass.m"]  # it is the most that anything moves
    assert said.step_move < 20 * moved / said.parameters["mass.m"]
    assert "The error of the integration's steps moves" in "\n".join(said.summary())
    assert fine.confidence().step_move < 0.1
    assert "integration's steps" not in "\n".join(fine.confidence().summary())
    assert fine.confidence().unexplained["mass.s"] < 0.005


def test_bad_residuals_are_told_beside_what_they_make_of_the_deviations():
    sure = fitted(80.0, "rk4").confidence()
    assert sure.unexplained["mass.s"] == pytest.approx(0.15, abs=0.05)
    assert "unexplained beside noise: the deviations tell" in "\n".join(sure.summary())
