"""Start values of models with events in C and FMUs: those of `acausal.simulate`, with other parameters and inputs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.export.c_text import starts
from acausal.export.vector import ParameterVector
from tests.support.exported_c import ExportedC
from tests.support.fmus import Unpacked, need_fmpy
from tests.support.starting import Filling, Kicked, Pressed, Sagging

END = 0.2


@dataclass(frozen=True)
class Case:
    """A model, its states and discrete variables, and other parameters and inputs for it."""

    model: type[ac.Component]
    names: tuple[str, ...]
    changes: tuple[dict[str, float], ...]

    @cached_property
    def system(self) -> ac.System:
        return ac.compile(self.model())

    def params(self, change: dict[str, float]) -> dict[str, Any]:
        return {**self.system.parameters(), **{n: v for n, v in change.items() if n != "u"}}

    def ends(self, change: dict[str, float]) -> np.ndarray:
        """The variables at the start and at the end of a simulation, shape (2, n_names)."""
        run = ac.simulate(
            self.system,
            END,
            inputs={"u": change.get("u", 0.0)},
            params=self.params(change),
            saveat=[0.0, END],
            rtol=1e-9,
            atol=1e-9,
        )
        return np.stack([np.asarray(run[name]) for name in self.names], 1)


FILLING = Case(
    Filling,
    ("x", "n"),
    ({}, {"x0": 0.8, "n0": 5.0}, {"x0": 0.55, "u": 4.0, "k": 1.0}),
)
PRESSED = Case(
    Pressed,
    ("s", "v", "n"),
    (
        {"u": 4.0},
        {"u": 4.0, "c": 80.0, "s0": -0.05},
        {"u": 5.0, "n0": 3.0, "fast": 7.0},
        {"u": -2.0, "s0": 0.3},
    ),
)
CASES = {"filling": FILLING, "pressed": PRESSED}


VERSIONS = ("2.0", "3.0")


@pytest.fixture(scope="module", params=[(c, v) for c in CASES for v in VERSIONS], ids="-".join)
def exported(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[tuple[Case, Unpacked]]:
    need_fmpy()
    name, fmi = request.param
    path = tmp_path_factory.mktemp(name) / "model.fmu"
    ac.export.fmu(CASES[name].system, path, fmi=fmi, outputs=CASES[name].names)
    unpacked = Unpacked(path, fmi)
    yield CASES[name], unpacked
    unpacked.remove()


Exported = tuple[Case, Unpacked]


@pytest.mark.slow
def test_the_cases_start_in_several_modes() -> None:
    speeds = [PRESSED.ends(change)[0, 1] for change in PRESSED.changes]
    assert min(speeds) < 0 < 1 < max(speeds)
    assert FILLING.ends(FILLING.changes[1])[0] == pytest.approx([0.8, 5.0])


def test_they_follow_from_parameters_and_inputs_in_fmpy(exported: Exported) -> None:
    case, fmu = exported
    assert fmu.fmpy.validation.validate_fmu(str(fmu.path)) == []
    for change in case.changes:
        for kind in ("ModelExchange", "CoSimulation"):
            run = fmu.fmpy.simulate_fmu(
                str(fmu.folder),
                model_description=fmu.description,
                fmi_type=kind,
                start_values=change,
                stop_time=END,
                output_interval=END / 4,
                output=case.names,
                relative_tolerance=1e-9,
            )
            found = np.array([[run[name][k] for name in case.names] for k in (0, -1)])
            np.testing.assert_allclose(found, case.ends(change), atol=1e-5, err_msg=str(change))


def test_instances_start_by_their_own_parameters(exported: Exported) -> None:
    case, fmu = exported
    first, second = ({"u": 0.0, **change} for change in case.changes[-2:])
    with (
        fmu.instance("CoSimulation", None, **first) as one,
        fmu.instance("CoSimulation", None, **second) as other,
    ):
        for instance, change in ((one, first), (other, second)):
            expected = case.ends(change)[0]
            np.testing.assert_allclose(instance.get(case.names), expected, atol=1e-9)


def test_what_changes_during_initialization_counts(exported: Exported) -> None:
    case, fmu = exported
    change, state = {"u": 0.0, **case.changes[1]}, case.names[0]
    with fmu.instance("CoSimulation") as instance:
        instance.fmu.reset()
        if fmu.fmi == "2.0":
            instance.fmu.setupExperiment(startTime=0.0)
        instance.fmu.enterInitializationMode()
        before = instance.get(case.names)
        instance.set([*change], [*change.values()])
        np.testing.assert_allclose(instance.get(case.names), case.ends(change)[0], atol=1e-9)
        instance.set([state], [0.15])
        assert instance.get([state]) == [0.15]
        assert before[0] == pytest.approx(float(case.system.initial_state()[0]))
        instance.fmu.exitInitializationMode()


@pytest.mark.slow
def test_a_jump_at_the_start_happens_once(tmp_path: Path) -> None:
    need_fmpy()
    fmu = Unpacked(ac.export.fmu(ac.compile(Kicked()), tmp_path / "kicked.fmu"), "3.0")
    with fmu.instance("CoSimulation") as instance:
        instance.fmu.reset()
        instance.fmu.enterInitializationMode()
        for name, value, expected in (
            ("k", 1.0, 0.6),
            ("x0", 0.7, 1.4),
            ("k", 3.0, 1.4),
            ("x", 0.1, 0.2),
            ("x0", 0.5, 0.2),
        ):
            instance.set([name], [value])
            assert instance.get(["x"]) == [expected]
        instance.fmu.exitInitializationMode()
        assert instance.get(["x"]) == [0.2]


@pytest.mark.slow
@pytest.mark.parametrize(
    "exported", [("filling", v) for v in VERSIONS], indirect=True, ids="-".join
)
def test_an_fmu_in_a_model_starts_by_its_parameters(exported: Exported) -> None:
    case, fmu = exported

    class Two(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.a, self.b = ac.FMU(fmu.path, {"x0": 0.8}), ac.FMU(fmu.path, {"x0": 0.1})

    system = ac.compile(Two())
    given = {"a.u": 0.0, "b.u": 0.0}
    run = ac.simulate(system, END, inputs=given, saveat=[0.0, END])
    np.testing.assert_allclose(run["a.x"], case.ends({"x0": 0.8})[:, 0], atol=1e-5)
    np.testing.assert_allclose(run["b.x"], case.ends({"x0": 0.1})[:, 0], atol=1e-5)
    other = {**system.parameters(), "a.x0": 0.5}
    run = ac.simulate(system, END, inputs=given, saveat=[0.0, END], params=other)
    np.testing.assert_allclose(run["a.x"], case.ends({"x0": 0.5})[:, 0], atol=1e-5)


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("name", CASES)
def test_start_and_begin_find_them_in_c(name: str, tmp_path: Path) -> None:
    case = CASES[name]
    model = ExportedC(case.system, tmp_path, outputs=case.names)
    for change in case.changes:
        model.call("init")
        model.p[:] = ParameterVector(case.system, case.params(change)).values
        model.u[:] = change.get("u", 0.0)
        assert [model.call(f) for f in ("recalibrate", "start", "begin")] == [0, 0, 0]
        np.testing.assert_allclose(model.outputs(), case.ends(change)[0], atol=1e-9)


def test_starts_that_do_not_depend_on_modes_are_found_once(tmp_path: Path) -> None:
    (header, source) = ac.export.c(FILLING.system, tmp_path)
    assert "guesses(" not in source.read_text()
    assert "m.x at the start, from m.time, m.u, m.p" in header.read_text()


@pytest.mark.cases(fast=1, slow=3)
@pytest.mark.parametrize(
    ("model", "named"),
    [(Sagging, "'s'"), (Pressed, "'s', 'v'"), (Filling, "'x'"), (Filling, "'n'")],
)
@pytest.mark.filterwarnings("ignore:export. the start values")
def test_starts_that_stay_as_exported_are_named(
    model: type[ac.Component], named: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(starts, "MOST_FOR_STARTS", -1)
    says = f"start values of {named} follow from parameters or inputs, but stay as exported"
    with pytest.warns(UserWarning, match=says):
        header, _ = ac.export.c(ac.compile(model()), tmp_path)
    assert "as exported: whatever m.p" in header.read_text()
