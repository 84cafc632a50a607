"""Units of FMUs: a model has SI units, whatever the FMU has inside."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from tests.support.fmus import need_fmpy


class Bench(ac.Component):
    """A tank that cools, and a slide, in the units of a workshop."""

    T0 = ac.Parameter(20.0, unit="degC", doc="of the room")
    heat = ac.Input(unit="mm")
    T = ac.Variable(start=80.0, fixed=True, unit="degC")
    x = ac.Output(unit="mm")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.T), (self.T0 - self.T) / 2)
        yield ac.Eq(self.x, 3 * self.heat)


STEP = {"me": None, "cs": 0.05}


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize("kind", ["me", "cs"])
def test_a_model_has_si_units(tmp_path: Path, kind: Any) -> None:
    need_fmpy()
    path = ac.export.fmu(ac.compile(Bench()), tmp_path / "a.fmu", fmi="2.0", outputs=["T", "x"])
    model = ac.FMU(path, {"heat": 0.002, "T": 353.15}, kind=kind, step=STEP[kind])
    assert "T0 = 293.15 K" in repr(model)
    system = ac.compile(model)
    assert system.parameters()["T0"] == 293.15

    def run(room: Any) -> Any:
        return ac.simulate(system, 0.2, saveat=[0.2], dt=0.05, params={"T0": room})

    np.testing.assert_allclose(run(283.15)["T"], 283.15 + 70 * np.exp(-0.1), rtol=1e-6)
    np.testing.assert_allclose(run(283.15)["x"], 0.006, rtol=1e-12)
    slope = jax.grad(lambda room: run(room)["T"][0])(283.15)
    np.testing.assert_allclose(slope, 1 - np.exp(-0.1), rtol=1e-4)
