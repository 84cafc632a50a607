"""Implicit fixed steps in C where plain corrections fail: stiff contacts, steep diodes; and steps at known edges."""

from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, electrical as el, translational as tl
from acausal.export.c_text import source
from tests.simulation.test_small_states import Steep
from tests.support.exported_c import ExportedC
from tests.support.fmus import need_fmpy

SOLVERS = ("implicit_euler", "kvaerno3", "kvaerno5")


class OvervoltageProtection(ac.Component):
    """Two Zener diodes against each other hold a peak of 10 V from a load."""

    def __init__(self) -> None:
        super().__init__()
        self.source = el.SineVoltage(V=10.0, f=50.0)
        self.r, self.load = el.Resistor(R=20.0), el.Resistor(R=2000.0)
        self.z1, self.z2 = el.ZDiode(Maxexp=80.0), el.ZDiode(Maxexp=80.0)
        self.c = el.Capacitor(C=1e-7, v=ac.Start(0.0, fixed=True))
        self.ground = el.Ground()
        self.connect(self.source.p, self.r.p)
        self.connect(self.r.n, self.z1.n, self.c.p, self.load.p)
        self.connect(self.z1.p, self.z2.p)
        self.connect(self.z2.n, self.source.n, self.c.n, self.load.n, self.ground.p)


class PreLoad(ac.Component):
    """A spool that is pushed between two plates, each with contacts on both sides and a spring between them."""

    def __init__(self) -> None:
        super().__init__()
        self.wave, self.force = blocks.Sine(amplitude=150.0, f=1.0), tl.Force()
        self.spool = tl.Mass(m=0.15, s=ac.Start(0.0, fixed=True), v=ac.Start(0.0, fixed=True))
        at = {"v": ac.Start(0.0, fixed=True)}
        self.plates = [tl.Mass(m=0.01, s=ac.Start(s, fixed=True), **at) for s in (-0.041, 0.041)]
        self.spring = tl.Spring(c=20e3, s_rel0=0.09)
        self.walls = [tl.Fixed(s0=s) for s in (-0.045, 0.045)]
        self.outer = [tl.ElastoGap(c=500e3, d=100.0, s_rel0=0.0035) for _ in range(2)]
        self.inner = [tl.ElastoGap(c=1e6, d=250.0, s_rel0=0.0405) for _ in range(2)]
        self.connect(self.wave.y, self.force.f)
        self.connect(self.force.flange, self.spool.flange_a)
        self.connect(self.plates[0].flange_b, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.plates[1].flange_a)
        chain = (
            (self.walls[0].flange, self.plates[0].flange_a),
            (self.plates[1].flange_b, self.walls[1].flange),
        )
        for gap, (low, high) in zip(self.outer, chain, strict=True):
            self.connect(low, gap.flange_a)
            self.connect(gap.flange_b, high)
        middle = (
            (self.plates[0].flange_b, self.spool.flange_a),
            (self.spool.flange_b, self.plates[1].flange_a),
        )
        for gap, (low, high) in zip(self.inner, middle, strict=True):
            self.connect(low, gap.flange_a)
            self.connect(gap.flange_b, high)


@pytest.mark.cases(fast=0, slow=4)
@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize(
    ("make", "end", "dt"), [(OvervoltageProtection, 0.02, 2e-4), (PreLoad, 0.2, 2e-4)]
)
def test_stiff_models_are_solved_as_here(
    make: type[ac.Component], end: float, dt: float, solver: str, tmp_path: Path
) -> None:
    system = ac.compile(make())
    there, rows = ExportedC(system, tmp_path, solver=solver), round(end / dt)
    found = [there.x.copy()]
    for _ in range(rows):
        assert there.step(dt) == 0
        found.append(there.x.copy())
    here = ac.simulate(system, (0, end), dt=dt, solver=solver).x
    scale = np.abs(here).max(axis=0)
    assert (np.abs(np.array(found) - here).max(axis=0) <= 1e-5 * scale).all()


def test_a_small_state_is_found_as_exactly_as_a_large_one(tmp_path: Path) -> None:
    there, found = ExportedC(ac.compile(Steep(size=1e-12)), tmp_path, solver="kvaerno3"), [0.0]
    for _ in range(10):
        assert there.step(0.01) == 0
        found.append(there.x[0] / 1e-12)
    whole = ac.simulate(ac.compile(Steep()), 0.1, dt=0.01, solver="kvaerno3")
    np.testing.assert_allclose(found, whole["x"], rtol=1e-9)


class Pulsed(ac.Component):
    """A short pulse in each period, summed up."""

    def __init__(self) -> None:
        super().__init__()
        self.pulse = blocks.Pulse(period=5.0, width=2.0)
        self.sum = blocks.Integrator()
        self.connect(self.pulse.y, self.sum.u)


@pytest.mark.slow
def test_steps_end_at_edges(tmp_path: Path) -> None:
    there = ExportedC(ac.compile(Pulsed()), tmp_path, solver="rk4")
    for _ in range(10):
        assert there.step(1.0) == 0
    np.testing.assert_allclose(there.x, 0.2, rtol=1e-9)


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_fmus_have_time_events_at_edges(fmi: str, tmp_path: Path) -> None:
    fmpy = need_fmpy()
    path = ac.export.fmu(ac.compile(Pulsed()), tmp_path / "p.fmu", fmi=fmi, outputs=["sum.y"])
    assert fmpy.validation.validate_fmu(str(path)) == []
    for kind in ("ModelExchange", "CoSimulation"):
        found = fmpy.simulate_fmu(
            str(path), fmi_type=kind, stop_time=10.0, output=["sum.y"], output_interval=0.5,
            relative_tolerance=1e-8,
        )  # fmt: skip
        assert abs(found["sum.y"][-1] - 0.2) < 1e-6


def test_tolerances_of_newton_are_those_of_simulate(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    system = ac.compile(OvervoltageProtection())
    monkeypatch.setattr(source, "STAGE_TOLERANCE", {"float64": 1.25e-7})
    monkeypatch.setattr(source, "STAGE_STEPS", 123)
    text = ac.export.c(system, tmp_path, solver="implicit_euler")[1].read_text()
    assert "#define TOLERANCE R(1.25e-07)" in text
    assert "STAGE_STEPS = 123" in text
