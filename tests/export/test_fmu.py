"""Models as FMUs: what fmpy, CasADi, a compiler and acausal itself say of them."""

from __future__ import annotations

import json
import subprocess
import zipfile
from collections.abc import Callable, Iterator
from ctypes import POINTER, c_double
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.components import translational as tl
from acausal.export import fmu_file
from acausal.export.fmu_text.variables import element, leaf, legal, unused
from examples.qvm.model import with_networks
from tests.components.test_neural_elements import Piezo
from tests.export.test_c import Chain, Rectifier
from tests.support.exported_c import STRICT, compiler_named, need_compiler
from tests.support.fmus import Unpacked, need_fmpy
from tests.support.starting import Redundant, Sagging

VERSIONS = ("2.0", "3.0")


@dataclass(frozen=True)
class Case:
    """A model and what acausal itself says of it; found once for all versions of FMI.

    Attributes:
        make: the model. outputs: of the FMU. solver, dt: of co-simulation.
    """

    make: Callable[[], ac.Component]
    outputs: tuple[str, ...]
    solver: str = "rk4"
    dt: float = 1e-3

    @cached_property
    def system(self) -> ac.System:
        return ac.compile(self.make())

    @cached_property
    def params(self) -> dict[str, Any]:
        return self.system.parameters(1)

    @cached_property
    def start(self) -> np.ndarray:
        return start_of(self.system)

    @property
    def inputs(self) -> dict[str, float]:
        return dict.fromkeys(self.system.inputs, 0.1)

    @cached_property
    def after_20_steps(self) -> np.ndarray:
        run = ac.simulate(
            self.system, (0.0, 20 * self.dt), dt=self.dt, solver=self.solver, inputs=self.inputs,
            params=self.params, x0=self.start,
        )  # fmt: skip
        return np.array([run[n][-1] for n in self.outputs])

    @cached_property
    def adaptive(self) -> np.ndarray:
        """Outputs at six times up to 0.05 s, shape (6, n_outputs)."""
        run = ac.simulate(
            self.system, (0.0, 0.05), saveat=np.linspace(0, 0.05, 6), inputs=self.inputs,
            params=self.params, x0=self.start, rtol=1e-10, atol=1e-12,
        )  # fmt: skip
        return np.stack([run[n] for n in self.outputs], axis=1)

    @cached_property
    def matrix(self) -> np.ndarray:
        """Derivatives of rates and outputs by states and inputs."""
        u = np.full(len(self.system.inputs), 0.3)
        at = ac.linearize(
            self.system, x=self.start, inputs=u, outputs=self.outputs, params=self.params
        )
        return np.block([[at.A, at.B], [at.C, at.D]])


def start_of(system: ac.System) -> np.ndarray:
    """A state where nothing rests."""
    return np.random.default_rng(0).uniform(0.01, 0.05, len(system.states))


CASES = {
    "vehicle": Case(with_networks, ("body.a", "body.s", "tyre.f")),
    "rectifier": Case(Rectifier, ("capacitor.v", "diode.i"), "kvaerno3", 1e-4),
    "chain": Case(lambda: Chain(20), ("mass[3].s", "mass[20].v")),
    "multiport": Case(Piezo, ("mass.v", "stack.E")),
}


@pytest.fixture(scope="module", params=[(c, v) for c in CASES for v in VERSIONS], ids="-".join)
def exported(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[tuple[Case, Unpacked]]:
    need_fmpy()
    name, fmi = request.param
    case = CASES[name]
    path = tmp_path_factory.mktemp(name) / "model.fmu"
    ac.export.fmu(
        case.system, path, case.params, fmi=fmi, outputs=case.outputs, solver=case.solver, step=case.dt
    )  # fmt: skip
    unpacked = Unpacked(path, fmi)
    yield case, unpacked
    unpacked.remove()


Exported = tuple[Case, Unpacked]


@pytest.mark.cases(fast=1, slow=4)
def test_fmpy_finds_no_problems(exported: Exported) -> None:
    _, fmu = exported
    assert fmu.fmpy.validation.validate_fmu(str(fmu.path)) == []


@pytest.mark.cases(fast=1, slow=5)
def test_cosimulation_has_the_steps_of_simulate(exported: Exported) -> None:
    case, fmu = exported
    with fmu.instance("CoSimulation") as model:
        _set_start(model, case.system, fmu)
        model.set([*case.inputs], [*case.inputs.values()])
        model.steps(5 * case.dt, 4)
        found, time = model.get(case.outputs), model.get(["time"])
    assert time == pytest.approx(20 * case.dt, rel=1e-12)
    expected = case.after_20_steps
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


@pytest.mark.cases(fast=1, slow=5)
def test_model_exchange_agrees_with_simulate(exported: Exported) -> None:
    case, fmu = exported
    states, _, order = _states_of(case.system, fmu)
    first = np.split(case.start[order], len(states))  # lists are of one length
    start = {
        n: v.tolist() if v.size > 1 else float(v[0]) for n, v in zip(states, first, strict=True)
    }
    result = fmu.fmpy.simulate_fmu(
        str(fmu.folder), fmi_type="ModelExchange", stop_time=0.05, output_interval=0.01, output=case.outputs,
        relative_tolerance=1e-10, start_values={**start, **case.inputs},
    )  # fmt: skip
    for name, expected in zip(case.outputs, case.adaptive.T, strict=True):
        np.testing.assert_allclose(
            result[name], expected, rtol=1e-5, atol=1e-5 * np.abs(expected).max()
        )


@pytest.mark.cases(fast=1, slow=5)
def test_directional_and_adjoint_derivatives_are_those_of_linearize(exported: Exported) -> None:
    case, fmu = exported
    system, names, n = case.system, case.outputs, len(case.system.states)
    states, rates, order = _states_of(system, fmu)
    with fmu.instance("ModelExchange") as model:
        _set_start(model, system, fmu)
        model.set(system.inputs, [0.3] * len(system.inputs))
        unknowns, knowns = [*rates, *names], [*states, *system.inputs]
        sizes = case.matrix.shape
        found = model.jacobian(unknowns, knowns, *sizes)
        turned = model.adjoint(unknowns, knowns, *sizes) if fmu.fmi == "3.0" else found
    expected = case.matrix[np.ix_([*order, *range(n, sizes[0])], [*order, *range(n, sizes[1])])]
    for ours in (found, turned):
        np.testing.assert_allclose(ours, expected, rtol=1e-10, atol=1e-10 * np.abs(expected).max())


@pytest.mark.cases(fast=3, slow=5)
def test_states_are_kept_and_restored_bit_for_bit(exported: Exported) -> None:
    case, fmu = exported
    names, dt = case.outputs, case.dt
    with fmu.instance("CoSimulation") as model:
        _set_start(model, case.system, fmu)
        model.steps(dt, 2)
        kept = model.fmu.getFMUState()
        stored = _serialize(model.fmu, kept)
        model.fmu.doStep(2 * dt, dt)
        first = model.get(names)
        model.fmu.setFMUState(kept)
        model.fmu.doStep(2 * dt, dt)
        second = model.get(names)
        model.fmu.freeFMUState(kept)
        model.fmu.reset()
        again = _deserialize(model.fmu, stored)
        model.fmu.setFMUState(again)
        model.fmu.doStep(2 * dt, dt)
        third = model.get(names)
        model.fmu.freeFMUState(again)
    np.testing.assert_array_equal(first, second)
    np.testing.assert_array_equal(first, third)


def _serialize(fmu: Any, state: Any) -> bytes:
    return (getattr(fmu, "serializeFMUState", None) or fmu.serializeFMUstate)(state)


def _deserialize(fmu: Any, stored: bytes) -> Any:
    return (getattr(fmu, "deserializeFMUState", None) or fmu.deSerializeFMUstate)(stored)


def _states_of(system: ac.System, fmu: Unpacked) -> tuple[list[str], list[str], list[int]]:
    """Names of states and their derivatives in the FMU, and where their numbers lie in the model's vector."""
    if fmu.fmi == "2.0" or not any("[" in n for n in system.states):
        return [*system.states], [f"der({n})" for n in system.states], [*range(len(system.states))]
    names = [n for n in fmu.references if f"der({n})" in fmu.references]
    members = [
        i
        for n in names
        for i, s in enumerate(system.states)
        if n in (s, s.split("[")[0] + s.partition("]")[2])
    ]
    return names, [f"der({n})" for n in names], members


def _set_start(model: Any, system: ac.System, fmu: Unpacked) -> None:
    names, _, order = _states_of(system, fmu)
    model.set(names, start_of(system)[order])


# -- the quarter vehicle ---------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def vehicle() -> ac.System:
    return ac.compile(with_networks())


@pytest.mark.slow
@pytest.mark.parametrize("fmi", VERSIONS)
def test_parameters_that_are_set_first_move_the_starts(tmp_path: Path, fmi: str) -> None:
    fmpy = need_fmpy()
    system = ac.compile(Sagging())
    path = str(ac.export.fmu(system, tmp_path / "s.fmu", fmi=fmi))
    assert fmpy.validation.validate_fmu(path) == []

    def first(kind: str, **start: float) -> float:
        run = fmpy.simulate_fmu(
            path, fmi_type=kind, stop_time=0.01, start_values=start, output=["s"]
        )
        return float(run["s"][0])

    exported = float(system.initial_state()[0])
    loaded = float(system.initial_state({**system.parameters(), "load": 8.0})[0])
    for kind in ("ModelExchange", "CoSimulation"):
        assert first(kind) == exported
        assert first(kind, load=8.0) == pytest.approx(loaded, rel=1e-12)
        assert first(kind, load=8.0, s=0.3) == 0.3


@pytest.mark.slow
def test_starts_that_cannot_be_found_are_logged(tmp_path: Path) -> None:
    fmu = Unpacked(ac.export.fmu(ac.compile(Redundant()), tmp_path / "r.fmu"), "3.0")
    messages: list[str] = []
    with (
        pytest.raises(Exception, match="discard"),
        fmu.instance("CoSimulation", messages, square=-1.0),
    ):
        pass
    assert "no start values satisfy the initial conditions" in messages[0]


@pytest.mark.slow
@pytest.mark.parametrize("fmi", VERSIONS)
def test_casadi_reads_it_and_differentiates_it(
    vehicle: ac.System, tmp_path: Path, fmi: str
) -> None:
    casadi = pytest.importorskip("casadi", reason="CasADi is not installed")
    names = ["body.a", "tyre.f"]
    fmu = Unpacked(ac.export.fmu(vehicle, tmp_path / "v.fmu", fmi=fmi, outputs=names), fmi)
    model = casadi.DaeBuilder("model", str(fmu.folder))
    assert (model.x(), model.u(), model.y()) == ([*vehicle.states], [*vehicle.inputs], names)
    function = model.create("function", ["x", "u"], ["ode", "y"])
    wanted = ["jac:ode:x", "jac:ode:u", "jac:y:x", "jac:y:u"]
    x, u = start_of(vehicle), np.array([0.3])
    found = function.factory("jacobian", ["x", "u"], wanted)(x, u)
    there = ac.linearize(vehicle, x=x, inputs=u, outputs=names)
    for ours, theirs in zip(found, (there.A, there.B, there.C, there.D), strict=True):
        scale = max(1.0, float(np.abs(theirs).max()))
        np.testing.assert_allclose(np.array(ours), theirs, atol=1e-10 * scale, rtol=1e-10)


@pytest.mark.slow
def test_weights_are_tunable_arrays(vehicle: ac.System, tmp_path: Path) -> None:
    fmu = Unpacked(ac.export.fmu(vehicle, tmp_path / "v.fmu"), "3.0")
    other = vehicle.parameters(3)
    weights = np.asarray(other["spring_nn.net"].weights[1], float)
    with fmu.instance("ModelExchange") as model:
        _set_start(model, vehicle, fmu)
        rates = [f"der({s})" for s in vehicle.states]
        before = model.get(rates)
        name = "spring_nn.net.weights[2]"
        own = model.get([name], weights.size)
        model.set([name], weights.ravel())
        np.testing.assert_array_equal(model.get([name], weights.size), weights.ravel())
        assert not np.array_equal(model.get(rates), before)
        model.set([name], own)
        np.testing.assert_array_equal(model.get(rates), before)
    described = {v.name: v for v in fmu.description.modelVariables}[name]
    assert [int(d.start) for d in described.dimensions] == [*weights.shape]
    assert described.variability == "tunable"


@pytest.mark.slow
def test_value_references_outlive_a_training(vehicle: ac.System, tmp_path: Path) -> None:
    for fmi in VERSIONS:
        both = [
            Unpacked(
                ac.export.fmu(vehicle, tmp_path / f"{fmi[0]}{s}.fmu", vehicle.parameters(s), fmi=fmi), fmi
            )
            for s in (0, 1)
        ]  # fmt: skip
        assert both[0].references == both[1].references
        assert len(set(both[0].references.values())) == len(both[0].references)
        assert both[0].description.guid != both[1].description.guid


@pytest.mark.slow
def test_exports_are_reproducible(vehicle: ac.System, tmp_path: Path) -> None:
    need_compiler()
    files = [ac.export.fmu(vehicle, tmp_path / f"{i}.fmu").read_bytes() for i in range(2)]
    assert files[0] == files[1]


@pytest.mark.slow
def test_outputs_know_what_they_read(vehicle: ac.System, tmp_path: Path) -> None:
    fmu = Unpacked(ac.export.fmu(vehicle, tmp_path / "v.fmu", outputs=["body.a", "tyre.f"]), "3.0")
    read = {o.variable.name: {v.name for v in o.dependencies} for o in fmu.description.outputs}
    assert "road.v_ref" not in read["body.a"]  # no direct feedthrough
    assert "road.v_ref" in read["tyre.f"]


@pytest.mark.slow
def test_inputs_that_are_left_out_are_parameters(vehicle: ac.System, tmp_path: Path) -> None:
    fmu = Unpacked(ac.export.fmu(vehicle, tmp_path / "v.fmu", inputs=[]), "3.0")
    (held,) = (v for v in fmu.description.modelVariables if v.name == "road.v_ref")
    assert (held.causality, held.variability) == ("parameter", "tunable")
    assert fmu.fmpy.validation.validate_fmu(str(fmu.path)) == []


@pytest.mark.slow
def test_failures_are_logged_and_discarded(vehicle: ac.System, tmp_path: Path) -> None:
    fmu = Unpacked(ac.export.fmu(vehicle, tmp_path / "v.fmu"), "3.0")
    messages: list[str] = []
    with fmu.instance("CoSimulation", messages) as model:
        _set_start(model, vehicle, fmu)
        model.steps(0.01, 1)
        before = model.get(vehicle.states)
        model.set(["body.m"], [0.0])
        with pytest.raises(Exception, match="discard"):
            model.fmu.doStep(0.01, 0.01)
        np.testing.assert_array_equal(model.get(vehicle.states), before)
        with pytest.raises(Exception, match="discard"):
            model.get(["der(body.v)"])
        with pytest.raises(Exception, match="error"):
            model.set(["der(body.v)"], [0.0])
    assert "a state is no finite number after t = 0.01 s" in messages[0]
    assert "'der(body.v)' is no finite number at t = 0.01 s" in messages[1]


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("fmi", VERSIONS)
def test_the_sources_fit_the_standard(vehicle: ac.System, tmp_path: Path, fmi: str) -> None:
    """The functions compile strictly, also against the standard's own headers."""
    fmpy = need_fmpy()
    folder = tmp_path / "fmu"
    fmpy.extract(
        str(ac.export.fmu(vehicle, tmp_path / "v.fmu", fmi=fmi, binary=False)), str(folder)
    )
    sources, number = folder / "sources", fmi[0]
    names = [sources / f"fmi{number}_functions.c", sources / "quarter_vehicle.c"]
    assert not (folder / "binaries").exists()
    _compile([*names, f"-DFMI{number}_FUNCTION_PREFIX=quarter_vehicle_"], tmp_path)
    (sources / f"fmi{number}_interface.h").write_text(
        f'#include "fmi{number}Functions.h"\n#define FMI(name) fmi{number}##name\n#define FMI_EXPORT\n'
    )
    _compile([*names, f"-I{Path(fmpy.__file__).parent / 'c-code'}"], tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize("fmi", VERSIONS)
def test_compilers_find_nothing_to_warn_of(
    vehicle: ac.System, tmp_path: Path, fmi: str, compiler: str
) -> None:
    command = compiler_named(compiler)
    path = ac.export.fmu(vehicle, tmp_path / "v.fmu", fmi=fmi, binary=False)
    zipfile.ZipFile(path).extractall(tmp_path)
    for name in (f"fmi{fmi[0]}_functions", "quarter_vehicle"):
        done = subprocess.run(
            [*command, *STRICT, "-O2", "-c", f"{name}.c", "-o", f"{name}.o"],
            cwd=tmp_path / "sources",
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stderr[:3000]


LIFE = """
#include "fmi3_functions.c"
static void log_it(void *e, fmi3Status s, fmi3String c, fmi3String m) { (void)e; (void)s; (void)c; (void)m; }
int main(void) {
    double y = 0, again = 0, reached, seed[20] = {1}, sum[20];
    bool a, b, c;
    void *kept = NULL, *other = NULL;
    const unsigned speed = STATES << 24, rate = DERIVATIVES << 24, weights = (PARAMETERS << 24) + 2, none = 99u << 24;
    if (fmi3InstantiateCoSimulation("", "wrong", "", 0, 0, 0, 0, NULL, 0, NULL, log_it, NULL)) return 1;
    void *m = fmi3InstantiateCoSimulation("", TOKEN, "", 0, 0, 0, 0, NULL, 0, NULL, log_it, NULL);
    fmi3EnterInitializationMode(m, 0, 0, 0, 0, 0);
    if (fmi3SetFloat64(m, &weights, 1, seed, 20) || fmi3DoStep(m, 0, 0.01, 0, &a, &b, &c, &reached)) return 2;
    if (fmi3GetFMUState(m, &kept) || fmi3DoStep(m, 0.01, 0.01, 0, &a, &b, &c, &reached)) return 3;
    fmi3GetFloat64(m, &rate, 1, sum, 20);
    size_t size;
    fmi3SerializedFMUStateSize(m, kept, &size);
    fmi3Byte *bytes = malloc(size);
    fmi3SerializeFMUState(m, kept, bytes, size);
    fmi3Reset(m);
    fmi3DeserializeFMUState(m, bytes, size, &other);
    fmi3SetFMUState(m, other);
    if (fmi3DoStep(m, 0.01, 0.01, 0, &a, &b, &c, &reached) || reached != 0.02) return 4;
    y = sum[3];
    fmi3GetFloat64(m, &rate, 1, sum, 20);
    again = sum[3];
    if (fmi3GetDirectionalDerivative(m, &rate, 1, &speed, 1, seed, 20, sum, 20)) return 5;
    if (fmi3GetAdjointDerivative(m, &rate, 1, &weights, 1, seed, 20, sum, 20)) return 6;
    if (fmi3GetFloat64(m, &none, 1, sum, 1) != fmi3Error || fmi3SetFloat64(m, &rate, 1, sum, 20) != fmi3Error) return 7;
    fmi3FreeFMUState(m, &kept);
    fmi3FreeFMUState(m, &other);
    free(bytes);
    fmi3FreeInstance(m);
    return y != again;
}
"""


@pytest.mark.slow
def test_sanitizers_find_nothing(tmp_path: Path) -> None:
    """A life of an instance: steps, copies of the state, derivatives, wrong calls."""
    need_compiler()
    path = ac.export.fmu(ac.compile(Chain(20)), tmp_path / "c.fmu", binary=False)
    zipfile.ZipFile(path).extractall(tmp_path)
    sources = tmp_path / "sources"
    (sources / "main.c").write_text(LIFE)
    flags = ["-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    command = [need_compiler(), *STRICT, *flags, "main.c", "chain.c", "-o", "life", "-lm"]
    built = subprocess.run(command, cwd=sources, capture_output=True, text=True)
    if "cannot find" in built.stderr:
        pytest.skip("the compiler has no sanitizers")
    assert built.returncode == 0, built.stderr
    done = subprocess.run([sources / "life"], capture_output=True, text=True)
    assert done.returncode == 0, (done.returncode, done.stderr)


def _compile(arguments: list[Any], folder: Path) -> None:
    command = [
        need_compiler(),
        *STRICT,
        "-fPIC",
        "-shared",
        "-o",
        folder / "out.so",
        *arguments,
        "-lm",
    ]
    done = subprocess.run([str(a) for a in command], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[:3000]


def test_without_a_compiler_there_are_sources(
    vehicle: ac.System, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fmu_file, "compiler", lambda: None)
    with pytest.warns(UserWarning, match="there is no C compiler, so the FMU holds sources only"):
        path = ac.export.fmu(vehicle, tmp_path / "v.fmu")
    with zipfile.ZipFile(path) as archive:
        names = archive.namelist()
    assert "sources/buildDescription.xml" in names
    assert not [n for n in names if n.startswith("binaries")]


KINDS_OF_FILE = {".so": b"\x7fELF", ".dll": b"MZ", ".dylib": b"\xcf\xfa\xed\xfe"}


@pytest.mark.slow
@pytest.mark.parametrize("fmi", VERSIONS)
def test_libraries_for_other_platforms(vehicle: ac.System, tmp_path: Path, fmi: str) -> None:
    """The Linux one is by this computer's own compiler where this is one."""
    pytest.importorskip("ziglang", reason="ziglang is not installed")
    need_compiler()
    names = ["x86_64-linux", "x86_64-windows", "aarch64-darwin"]
    path = ac.export.fmu(vehicle, tmp_path / "v.fmu", fmi=fmi, platforms=names)
    with zipfile.ZipFile(path) as archive:
        found = {Path(n) for n in archive.namelist() if n.startswith("binaries/")}
        folders = names if fmi == "3.0" else ["linux64", "win64", "darwin64"]
        assert sorted(p.parent.name for p in found) == sorted(folders)
        for library in found:
            content = archive.read(library.as_posix())
            assert content.startswith(KINDS_OF_FILE[library.suffix])
            wanted = b"fmi3GetFloat64" if fmi == "3.0" else b"fmi2GetReal"
            assert wanted in content


def test_platforms_are_checked(
    vehicle: ac.System, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def export(fmi: str, *platforms: str) -> None:
        ac.export.fmu(vehicle, tmp_path / "v.fmu", fmi=fmi, platforms=platforms)

    with pytest.raises(ac.DataError, match=r"no platform 'x86-windows': .*x86_64-windows"):
        export("3.0", "x86-windows")
    with pytest.raises(ac.DataError, match=r"FMI 2\.0 has no name for 'aarch64-linux'"):
        export("2.0", "aarch64-linux")
    with pytest.raises(ac.DataError, match="one folder for 'x86_64-darwin' and 'aarch64-darwin'"):
        export("2.0", "x86_64-darwin", "aarch64-darwin")
    monkeypatch.setattr(fmu_file, "cross_compiler", lambda place: None)
    with pytest.raises(ac.ExportError, match="for 'aarch64-windows' needs the package ziglang"):
        export("3.0", "aarch64-windows")


class Bodies(ac.Component):
    """Two masses on springs whose positions are typically of different size."""

    def __init__(self) -> None:
        super().__init__()
        self.wall = tl.Fixed()
        self.mass = [tl.Mass(m=1.0, s=ac.Start(nominal=nominal)) for nominal in (1e-3, 1e-2)]
        self.leg = [tl.SpringDamper(c=1.0, d=1.0) for _ in self.mass]
        for leg, mass in zip(self.leg, self.mass, strict=True):
            self.connect(self.wall.flange, leg.flange_a)
            self.connect(leg.flange_b, mass.flange_a)


@pytest.mark.slow
@pytest.mark.parametrize("fmi", VERSIONS)
def test_typical_magnitudes_are_known(tmp_path: Path, fmi: str) -> None:
    need_fmpy()
    system = ac.compile(Bodies())
    fmu = Unpacked(ac.export.fmu(system, tmp_path / "b.fmu", fmi=fmi), fmi)
    found = np.zeros(4)
    with fmu.instance("ModelExchange") as model:
        model.fmu.getNominalsOfContinuousStates(found.ctypes.data_as(POINTER(c_double)), 4)
    states = [n for n in fmu.references if f"der({n})" in fmu.references]
    positions = [n for n in states if n.endswith(".s")]
    assert sorted(found) == [1e-3, 1e-2, 1, 1]
    assert found[states.index(positions[0]) * 4 // len(states)] == 1e-3
    assert fmu.fmpy.validation.validate_fmu(str(fmu.path)) == []


# -- many components -------------------------------------------------------------------------------------


@pytest.mark.slow
def test_ten_thousand_masses_are_a_few_arrays(tmp_path: Path) -> None:
    fmpy = need_fmpy()
    path = ac.export.fmu(ac.compile(Chain(10_000)), tmp_path / "chain.fmu")
    assert fmpy.validation.validate_fmu(str(path)) == []
    assert len(fmpy.read_model_description(str(path)).modelVariables) <= 20
    with zipfile.ZipFile(path) as archive:
        assert archive.getinfo("modelDescription.xml").file_size <= 300_000


# -- names, wrong calls ------- ---------------------------------------------------------------------------


def test_names_are_legal() -> None:
    assert legal("mass[1].s") == "mass[1].s"
    assert legal("der(mass[1].s)") == "der(mass[1].s)"
    assert legal("cell[1][2].v") == "cell[1,2].v"
    assert legal("der(der(body.s))") == "'der(der(body.s))'"
    assert legal("α.s") == "'#3b1.s'"
    assert element("nn.weights[1]", (0, 2)) == "nn.weights[1,1,3]"
    assert leaf("nn[1].net['a'].weights[0]", "nn[1]") == "nn[1].net.a.weights[1]"
    used = {"a"}
    assert [unused(["a", "b"], used), unused(["a", "b"], used)] == ["b", "'b 2'"]


def test_wrong_calls_are_refused(vehicle: ac.System, tmp_path: Path) -> None:
    path = tmp_path / "v.fmu"

    def refused(error: type[Exception], match: str, **options: Any) -> None:
        with pytest.raises(error, match=match):
            ac.export.fmu(vehicle, path, binary=False, **options)

    refused(ac.DataError, "there is no fmi='1.0'; give '3.0' or '2.0'", fmi="1.0")
    refused(
        ac.DataError, "there is no kind 'modelexchange': .*model_exchange", kinds="modelexchange"
    )
    refused(ac.DataError, r"kinds=\(\) leaves nothing to write", kinds=())
    refused(ac.DataError, "no input 'road.v': .*road.v_ref", inputs=["road.v"])
    refused(ac.DataError, "no variable 'body.b'", outputs=["body.b"])
    refused(ac.DataError, "is an input; leave it out", outputs=["road.v_ref"])
    refused(ac.DataError, "is no length of a step", step=0)
    refused(ac.DataError, "is kept for FMI's files", name="fmu_instance")
    refused(ac.ExportError, "has no steps in C", solver="bdf")


def test_the_file_of_a_model_names_it_and_its_times(tmp_path: Path) -> None:
    """A time constant of 10 us also shortens the default step; a long one of one's own is warned of."""
    document = {
        "model": "Lab.Circuits.Filter",
        "stop_time": 0.25,
        "components": {
            "source": {"class": "Modelica.Electrical.Analog.Sources.ConstantVoltage", "with": {"V": 1.0}},
            "r": {"class": "Modelica.Electrical.Analog.Basic.Resistor", "with": {"R": 10.0}},
            "c": {"class": "Modelica.Electrical.Analog.Basic.Capacitor", "with": {"C": 1e-6}},
            "ground": {"class": "Modelica.Electrical.Analog.Basic.Ground"},
        },
        "connections": [["source.p", "r.p"], ["r.n", "c.p"], ["c.n", "source.n"], ["c.n", "ground.p"]],
    }  # fmt: skip
    (tmp_path / "filter.json").write_text(json.dumps(document))
    system = ac.compile(ac.load(tmp_path / "filter.json"))
    with zipfile.ZipFile(ac.export.fmu(system, tmp_path / "f.fmu", binary=False)) as archive:
        text = archive.read("modelDescription.xml").decode()
        page = archive.read("documentation/index.html").decode()
    assert 'modelName="Lab.Circuits.Filter"' in text
    assert 'modelIdentifier="filter"' in text
    assert 'stopTime="0.25"' in text
    assert 'stepSize="1e-05"' in text
    assert "<h1>Lab.Circuits.Filter</h1>" in page
    with pytest.warns(UserWarning, match=r"too long for 'rk4'.* 1e\+05 1/s at the start"):
        ac.export.fmu(system, tmp_path / "g.fmu", binary=False, step=1e-3)
