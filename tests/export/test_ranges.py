"""The flag that a network is used outside of the range in which it was trained: in C, and in FMUs by fmpy."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.components import neural, translational as tl
from acausal.export.ranges import watched
from examples.qvm.model import with_networks
from tests.support.exported_c import ExportedC
from tests.support.fmus import Unpacked

RANGES = {"spring_nn.net": (-0.02, 0.01), "damper_nn.net": [(-0.3, 0.4)]}
FLAG = "outside_training_range"


@pytest.fixture(scope="module")
def vehicle() -> ac.System:
    return ac.compile(with_networks())


def points(n: int = 200) -> np.ndarray:
    """States, some within the ranges."""
    size = np.array([0.01, 0.2, 0.01, 0.2, 0.01])
    return np.random.default_rng(0).normal(size=(n, 5)) * size


def is_outside(x: np.ndarray) -> bool:
    travel, speed = x[2] - x[0], x[3] - x[1]
    return not (-0.02 <= travel <= 0.01 and -0.3 <= speed <= 0.4)


def test_c_tells_whether_an_argument_has_left_its_range(vehicle: ac.System, tmp_path: Path) -> None:
    model = ExportedC(vehicle, tmp_path, ranges=RANGES)
    found: list[bool] = []
    for x in points():
        model.x[:] = x
        found.append(bool(model.call("outside")))
    expected = [is_outside(x) for x in points()]
    assert found == expected
    assert 20 < sum(expected) < 180
    model.x[:] = [0.0, 0.0, 0.01, 0.4, 0.0]  # the ends belong to the ranges
    assert model.call("outside") == 0
    model.x[0] = np.nan
    assert model.call("outside") == 1


def test_without_ranges_there_is_no_flag(vehicle: ac.System, tmp_path: Path) -> None:
    header, _ = ac.export.c(vehicle, tmp_path)
    assert "outside" not in header.read_text()
    header, _ = ac.export.c(vehicle, tmp_path, ranges={})
    assert "outside" not in header.read_text()


class Row(ac.Component):
    """Masses between learned springs, each with a network of its own."""

    def __init__(self, n: int) -> None:
        super().__init__()
        self.wall = tl.Fixed()
        self.spring = [neural.Compliance(input_scale=0.1, output_scale=5.0) for _ in range(n)]
        self.mass = [tl.Mass(m=1.0) for _ in range(n)]
        left = self.wall.flange
        for spring, mass in zip(self.spring, self.mass, strict=True):
            self.connect(left, spring.flange_a)
            self.connect(spring.flange_b, mass.flange_a)
            left = mass.flange_b


def test_lists_of_networks_are_loops_with_ranges_of_their_own(tmp_path: Path) -> None:
    system = ac.compile(Row(4))
    names = system.layout.module_names
    ranges = {n: (-0.1 * k, 0.1 * k) for k, n in enumerate(names[1:], start=1)}
    watch = watched(system, ranges, "c")
    assert watch is not None
    assert [len(call.targets) for call in watch.calls] == [3]
    model = ExportedC(system, tmp_path, ranges=ranges)
    places = [system.states.index(f"mass[{i}].s") for i in (1, 2, 3, 4)]
    for stretched, outside in (([9, 0, 0, 0], 0), ([0, 0.15, 0, 0], 1), ([0, 0.05, 0.15, 0.25], 0)):
        model.x[:] = 0
        model.x[places] = np.cumsum(stretched)
        assert model.call("outside") == outside


@pytest.fixture(scope="module", params=["2.0", "3.0"])
def fmu(
    request: pytest.FixtureRequest, vehicle: ac.System, tmp_path_factory: pytest.TempPathFactory
) -> Unpacked:
    path = tmp_path_factory.mktemp("flag") / "v.fmu"
    ac.export.fmu(vehicle, path, fmi=request.param, outputs=["body.a"], ranges=RANGES)
    return Unpacked(path, request.param)


@pytest.mark.slow
def test_fmpy_finds_no_problems_with_the_flag(fmu: Unpacked) -> None:
    assert fmu.fmpy.validation.validate_fmu(str(fmu.path)) == []
    flag = {v.name: v for v in fmu.description.modelVariables}[FLAG]
    assert (flag.type, flag.causality, flag.variability) == ("Boolean", "output", "discrete")
    read = {o.variable.name: o.dependencies for o in fmu.description.outputs}[FLAG]
    assert {v.name for v in read} == {"body.s", "body.v", "wheel.s", "wheel.v"}


def test_the_flag_is_that_of_the_point(fmu: Unpacked, vehicle: ac.System) -> None:
    reference = fmu.of([FLAG])
    with fmu.instance("CoSimulation") as model:
        for x in points(40):
            model.set(vehicle.states, x)
            assert bool(model.fmu.getBoolean(reference)[0]) == is_outside(x)
        with pytest.raises(Exception, match="error"):
            model.fmu.setBoolean(reference, [True])


@pytest.mark.parametrize("kind", ["ModelExchange", "CoSimulation"])
def test_a_simulation_shows_where_it_extrapolates(fmu: Unpacked, kind: str) -> None:
    """The body falls on its suspension: first outside, at rest within the range."""
    result = fmu.fmpy.simulate_fmu(
        str(fmu.folder), fmi_type=kind, stop_time=1.5, output_interval=0.01, relative_tolerance=1e-8,
        start_values={"body.s": 0.05}, output=["body.s", "wheel.s", "body.v", "wheel.v", FLAG],
    )  # fmt: skip
    travel, speed = result["wheel.s"] - result["body.s"], result["wheel.v"] - result["body.v"]
    margin = np.maximum(np.abs(travel + 0.005) - 0.015, np.abs(speed - 0.05) - 0.35)
    clear = np.abs(margin) > 1e-4
    if kind == "ModelExchange":  # fmpy records a point before the event at the end of a step
        clear[1:] &= (margin[1:] > 0) == (margin[:-1] > 0)
    np.testing.assert_array_equal(result[FLAG][clear].astype(bool), margin[clear] > 0)
    assert result[FLAG][0]
    assert not result[FLAG][-1]


class Bouncing(ac.Component):
    """A ball that bounces, with a learned drag that depends on how often it has."""

    drag = ac.Module(lambda key: ac.networks.Law(passive=True, secondary=1)(key))
    h = ac.Variable(start=1.0, unit="m", fixed=True)
    v = ac.Variable(unit="m/s", state="always", fixed=True)
    n = ac.Discrete(0, kind="int")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.h), self.v)
        yield ac.Eq(ac.der(self.v), -9.81 - self.drag(self.v, self.n))
        bounces = ac.Reinit(self.v, -0.8 * ac.pre(self.v)), ac.Eq(self.n, ac.pre(self.n) + 1)
        yield ac.When(self.h < 0, *bounces)


@pytest.mark.slow
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_the_flag_of_a_model_with_events(tmp_path: Path, fmi: str) -> None:
    """Steps that end because of the flag are no events of the model; the second argument changes at events."""
    system = ac.compile(Bouncing(), check_units=False)
    path = ac.export.fmu(
        system, tmp_path / "b.fmu", fmi=fmi, ranges={"drag": [(-3.0, 9.0), (0, 1)]}, step=1e-3
    )
    fmu = Unpacked(path, fmi)
    assert fmu.fmpy.validation.validate_fmu(str(path)) == []
    run = ac.simulate(system, (0, 1.2), saveat=np.linspace(0, 1.2, 121), rtol=1e-9, atol=1e-11)
    outside = (np.asarray(run["v"]) < -3) | (np.asarray(run["n"]) > 1)
    clear = np.ones(121, bool)
    for t in (*(event.t for event in run.events), *run.t[1:][outside[1:] != outside[:-1]]):
        clear &= np.abs(run.t - t) > 0.011
    assert 10 < (outside & clear).sum() < 100
    for kind in ("ModelExchange", "CoSimulation"):
        found = fmu.fmpy.simulate_fmu(
            str(fmu.folder), fmi_type=kind, stop_time=1.2, output_interval=0.01, relative_tolerance=1e-9,
            output=["h", FLAG],
        )  # fmt: skip
        at = np.abs(found["time"][:, None] - run.t).argmin(axis=0)
        np.testing.assert_array_equal(found[FLAG][at][clear].astype(bool), outside[clear])
        np.testing.assert_allclose(found["h"][at][clear], run["h"][clear], atol=1e-5)


def test_casadi_reads_an_fmu_with_the_flag(fmu: Unpacked, vehicle: ac.System) -> None:
    casadi = pytest.importorskip("casadi", reason="CasADi is not installed")
    model = casadi.DaeBuilder("model", str(fmu.folder))
    function = model.create("function", ["x", "u"], ["ode"])
    x = points(1)[0]
    found = np.array(function(x, [0.3])).ravel()
    expected = vehicle.vector_field(0.0, x, [0.3], vehicle.parameters())
    np.testing.assert_allclose(found, expected, rtol=1e-10)


def test_wrong_ranges_are_refused(vehicle: ac.System, tmp_path: Path) -> None:
    for ranges, match in (
        ({"spring_nn.nut": (0, 1)}, r"no network 'spring_nn\.nut': did you mean 'spring_nn\.net'"),
        (
            {"spring_nn.net": (1, 0)},
            r"\(1, 0\) of 'spring_nn\.net' is no interval; give \(low, high\)",
        ),
        ({"spring_nn.net": (0, np.nan)}, "is no interval"),
        ({"spring_nn.net": "wide"}, "is no interval"),
        ({"spring_nn.net": [(0, 1), (0, 2)]}, "takes 1 argument; give as many intervals, not 2"),
        ((0, 1), "are no intervals by network"),
    ):
        with pytest.raises(ac.DataError, match=match):
            ac.export.c(vehicle, tmp_path, ranges=ranges)  # type: ignore[arg-type]
