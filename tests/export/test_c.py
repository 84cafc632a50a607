"""Models as C: what compilers and JAX say of them."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.codegen import Values
from acausal.components import electrical as el, translational as tl
from acausal.export.vector import ParameterVector
from examples.qvm.model import with_networks
from tests.support.exported_c import STRICT, ExportedC, compiler_named, need_compiler
from tests.support.starting import Redundant, Sagging, Sharing


class Rectifier(ac.Component):
    """A source, a resistor and a diode: a nonlinear loop, beside a capacitor and an inductor."""

    def __init__(self) -> None:
        super().__init__()
        self.source = el.SineVoltage(V=5.0, f=50.0)
        self.diode, self.resistor = el.Diode(), el.Resistor(R=10.0)
        self.capacitor, self.load = el.Capacitor(C=1e-4), el.Resistor(R=100.0)
        self.ground = el.Ground()
        self.connect(self.source.p, self.resistor.p)
        self.connect(self.resistor.n, self.diode.p)
        self.connect(self.diode.n, self.capacitor.p, self.load.p)
        self.connect(self.source.n, self.capacitor.n, self.load.n, self.ground.p)


class Chain(ac.Component):
    """Masses and springs in a row."""

    def __init__(self, n: int) -> None:
        super().__init__()
        self.wall = tl.Fixed()
        self.leg = [tl.SpringDamper(c=100.0 + i % 7, d=1.0) for i in range(n)]
        self.mass = [tl.Mass(m=1.0 + 0.1 * (i % 3)) for i in range(n)]
        below = self.wall.flange
        for leg, mass in zip(self.leg, self.mass, strict=True):
            self.connect(below, leg.flange_a)
            self.connect(leg.flange_b, mass.flange_a)
            below = mass.flange_b


MODELS: dict[str, tuple[Callable[[], ac.Component], dict[str, Any]]] = {
    "vehicle": (with_networks, {"outputs": ["body.a", "tyre.f"]}),
    "rectifier": (Rectifier, {"solver": "kvaerno3", "outputs": ["diode.i"]}),
    "chain": (lambda: Chain(200), {"solver": "tsit5"}),
}


@pytest.fixture(scope="module", params=MODELS)
def exported(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> tuple[ac.System, ExportedC, dict[str, Any]]:
    need_compiler()
    model, options = MODELS[request.param]
    system = ac.compile(model())
    folder = tmp_path_factory.mktemp(request.param)
    params = system.parameters(1)
    return (
        system,
        ExportedC(system, folder, params=params, **options),
        {**options, "params": params},
    )


def test_values_and_directional_derivatives_are_those_of_jax(
    exported: tuple[ac.System, ExportedC, dict[str, Any]],
) -> None:
    system, model, options = exported
    vector = ParameterVector(system, options["params"])
    names = tuple(options.get("outputs", system.states))
    rng = np.random.default_rng(0)
    point = [0.3, *(rng.uniform(0.1, 0.9, len(v)) for v in (system.states, system.inputs))]
    point.append(vector.values)
    seed: list[Any] = [rng.normal(size=np.shape(a)) for a in point]

    @jax.jit
    def both(point: Any, seed: Any) -> Any:
        def evaluate(t: Any, x: Any, u: Any, p: Any) -> Any:
            return system.rates_and_read(names, Values(t, x, u, vector.packed(p)))

        return jax.jvp(evaluate, point, seed)

    as_jax = (tuple(map(jnp.asarray, a)) for a in (point, seed))
    (dx, y), (of_dx, of_y) = both(*as_jax)
    model.time[0], model.x[:], model.u[:] = point[0], point[1], point[2]
    found = [model.derivatives(), model.outputs(), *model.directional(*seed)]
    for ours, theirs in zip(found, (dx, y, of_dx, of_y), strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=1e-11, atol=1e-11 * np.abs(theirs).max())


@pytest.mark.cases(fast=1, slow=2)
def test_steps_are_those_of_simulate(
    exported: tuple[ac.System, ExportedC, dict[str, Any]],
) -> None:
    system, model, options = exported
    model.call("init")
    model.u[:] = 0.1
    n, dt = 20, 1e-4
    run = ac.simulate(
        system,
        (0.0, n * dt),
        dt=dt,
        solver=options.get("solver", "rk4"),
        inputs=dict.fromkeys(system.inputs, 0.1),
        params=options["params"],
        x0=model.x.copy(),
    )
    for _ in range(n):
        assert model.step(dt) == 0
    assert float(model.time[0]) == pytest.approx(n * dt)
    end = np.array([run[name][-1] for name in system.states])
    np.testing.assert_allclose(model.x, end, rtol=1e-9, atol=1e-9 * np.abs(end).max())


@pytest.mark.cases(fast=1, slow=2)
def test_a_parameter_is_changed_in_place(
    exported: tuple[ac.System, ExportedC, dict[str, Any]],
) -> None:
    system, model, options = exported
    vector = ParameterVector(system, options["params"])
    model.call("init")
    before, kept = model.derivatives(), model.p.copy()
    np.testing.assert_array_equal(kept, vector.values)
    model.p[:] = vector.values * 1.01
    assert model.call("recalibrate") == 0
    values = Values(0.0, jnp.asarray(model.x), jnp.asarray(model.u), vector.packed(model.p.copy()))
    np.testing.assert_allclose(model.derivatives(), system.rates(values), rtol=1e-9, atol=1e-9)
    model.p[:] = kept
    assert model.call("recalibrate") == 0
    np.testing.assert_array_equal(model.derivatives(), before)  # bit for bit


def test_nothing_is_allocated_or_shared(
    exported: tuple[ac.System, ExportedC, dict[str, Any]],
) -> None:
    _, model, _ = exported
    target = model.files[1].with_suffix(".o")
    subprocess.run(
        [need_compiler(), *STRICT, "-O2", "-c", model.files[1], "-o", target], check=True
    )
    symbols = subprocess.run(["nm", target], capture_output=True, text=True, check=True).stdout
    kinds = {(line.split()[-2], line.split()[-1]) for line in symbols.splitlines()}
    assert not [name for kind, name in kinds if kind in "bBdDcC"], "static memory that changes"
    assert not {"malloc", "calloc", "free"} & {name for kind, name in kinds if kind == "U"}


@pytest.mark.slow
@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_compilers_find_nothing_to_warn_of(
    exported: tuple[ac.System, ExportedC, dict[str, Any]], compiler: str, tmp_path: Path
) -> None:
    _, model, _ = exported
    target = str(tmp_path / "model.o")
    command = [*compiler_named(compiler), *STRICT, "-O2", "-c", str(model.files[1]), "-o", target]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[:3000]


THREADS = """
#include "rectifier.h"
#include <pthread.h>
#include <stddef.h>
static void *run(void *given) {
    rectifier *m = given;
    rectifier_init(m);
    for (int i = 0; i < 300; i++)
        if (rectifier_step(m, 1e-4, NULL) || rectifier_derivatives(m)) return m;
    return NULL;
}
int main(void) {
    static rectifier alone, pair[2];
    pthread_t threads[2];
    if (run(&alone)) return 1;
    for (int k = 0; k < 2; k++)
        if (pthread_create(&threads[k], NULL, run, &pair[k])) return 2;
    for (int k = 0; k < 2; k++) {
        void *failed;
        pthread_join(threads[k], &failed);
        if (failed) return 3;
    }
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < RECTIFIER_STATES; i++)
            if (pair[k].x[i] != alone.x[i] || pair[k].dx[i] != alone.dx[i]) return 4;
    return 0;
}
"""


@pytest.mark.slow
def test_two_instances_run_in_two_threads(tmp_path: Path) -> None:
    need_compiler()
    _, source = ac.export.c(ac.compile(Rectifier()), tmp_path, solver="kvaerno3")
    (tmp_path / "threads.c").write_text(THREADS)
    command = [need_compiler(), *STRICT, "-g", "-O1", "-fsanitize=thread", f"-I{tmp_path}"]
    files = [tmp_path / "threads.c", source, "-o", tmp_path / "threads", "-lm", "-pthread"]
    built = subprocess.run([*command, *files], capture_output=True, text=True)
    if "cannot find" in built.stderr:
        pytest.skip("the compiler has no thread sanitizer")
    assert built.returncode == 0, built.stderr
    done = subprocess.run([tmp_path / "threads"], capture_output=True, text=True)
    if "unexpected memory mapping" in done.stderr:
        pytest.skip("the thread sanitizer does not run on this kernel")
    assert done.returncode == 0, (done.returncode, done.stderr)


@pytest.mark.slow
def test_sanitizers_find_nothing(tmp_path: Path) -> None:
    system = ac.compile(Rectifier())
    header, source = ac.export.c(system, tmp_path, solver="kvaerno3")
    main = tmp_path / "main.c"
    main.write_text(
        f'#include "{header.name}"\n#include <stddef.h>\nint main(void) {{ static rectifier m, n;\n'
        "rectifier_init(&m); for (int i = 0; i < 50; i++) if (rectifier_step(&m, 1e-4, NULL)) return 2;\n"
        "n = m; rectifier_derivatives(&m); rectifier_derivatives(&n); return m.dx[0] != n.dx[0]; }\n"
    )
    flags = ["-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    program = tmp_path / "main"
    built = subprocess.run(
        [need_compiler(), *STRICT, *flags, f"-I{tmp_path}", main, source, "-o", program, "-lm"],
        capture_output=True,
        text=True,
    )
    if "cannot find" in built.stderr:
        pytest.skip("the compiler has no sanitizers")
    assert built.returncode == 0, built.stderr
    done = subprocess.run([program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_many_components_are_a_loop(tmp_path: Path) -> None:
    sizes = []
    for n in (100, 2000):
        files = ac.export.c(ac.compile(Chain(n)), tmp_path / str(n), derivatives=False)
        sizes.append(sum(f.stat().st_size for f in files))
    values = 9 * 3 * 1900  # the table of the parameters' values grows
    assert sizes[1] - sizes[0] < 2 * values
    assert (tmp_path / "2000" / "chain.c").read_text().count("for (int") < 60


def test_single_precision(tmp_path: Path) -> None:
    need_compiler()
    system = ac.compile(with_networks())
    model = ExportedC(system, tmp_path, dtype=np.float32)
    model.x[:] = 0.01
    exact = system.vector_field(0.0, np.full(5, 0.01), np.zeros(1), system.parameters())
    np.testing.assert_allclose(model.derivatives(), exact, rtol=2e-4)


@pytest.mark.cases(fast=1, slow=3)
@pytest.mark.parametrize("make", [Sagging, Sharing, Redundant])
@pytest.mark.parametrize("factor", [1.0, 1.7])
def test_start_values_follow_from_parameters(
    tmp_path: Path, make: type[ac.Component], factor: float
) -> None:
    need_compiler()
    system = ac.compile(make())
    own = system.parameters()
    params = {name: value * factor ** (k + 1) for k, (name, value) in enumerate(own.items())}
    model = ExportedC(system, tmp_path)
    np.testing.assert_array_equal(model.x, system.initial_state())
    model.p[:] = ParameterVector(system, params).values
    assert [model.call("recalibrate"), model.call("start")] == [0, 0]
    np.testing.assert_allclose(model.x, system.initial_state(params), rtol=1e-12, atol=1e-12)


@pytest.mark.slow
def test_start_values_that_cannot_be_found_are_reported(tmp_path: Path) -> None:
    need_compiler()
    model = ExportedC(ac.compile(Redundant()), tmp_path)
    model.p[:] = -1.0
    assert model.call("start") == 1  # REDUNDANT_NOT_FINITE


def test_start_values_that_nothing_changes_are_those_exported(tmp_path: Path) -> None:
    need_compiler()
    model = ExportedC(ac.compile(Chain(3)), tmp_path)
    model.x[:], model.p[:] = 1.0, 2.0
    assert model.call("start") == 0
    np.testing.assert_array_equal(model.x, 0.0)
    assert "as exported: whatever m.p" in model.files[0].read_text()


@pytest.mark.cases(fast=1, slow=2)
@pytest.mark.parametrize("solver", ["euler", "heun", "implicit_euler"])
def test_every_method_compiles_strictly_and_steps_as_simulate_does(
    tmp_path: Path, solver: str
) -> None:
    need_compiler()
    system = ac.compile(Chain(2))
    start = np.array([0.1, 0.0, 0.0, -0.2])
    model = ExportedC(system, tmp_path, solver=solver, derivatives=False)
    model.x[:] = start
    run = ac.simulate(system, (0.0, 0.03), dt=0.01, solver=solver, x0=start)
    assert [model.step(0.01) for _ in range(3)] == [0, 0, 0]
    np.testing.assert_allclose(model.x, run.x[-1], rtol=1e-9, atol=1e-12)


def test_the_header_names_variables_and_units(tmp_path: Path) -> None:
    header, source = ac.export.c(ac.compile(with_networks()), tmp_path, name="vehicle")
    text = header.read_text()
    assert "[1] body.v in m/s" in text
    assert "suspension.c in N/m" in text
    assert '{"tyre.d", "N.s/m", 4, 1, 1}' in source.read_text()


@pytest.mark.parametrize("solver", ["rk4", "implicit_euler"])
def test_states_that_have_run_away_are_refused(tmp_path: Path, solver: str) -> None:
    class Growing(ac.Component):
        x, y = ac.Variable(start=1.0, fixed=True), ac.Variable(start=1.0, fixed=True)

        def equations(self) -> Any:
            yield ac.Eq(ac.der(self.x), -self.x)
            yield ac.Eq(ac.der(self.y), 500 * self.y)

    model = ExportedC(ac.compile(Growing()), tmp_path, solver=solver)
    statuses = [model.step(1e-3) for _ in range(200)]
    assert set(statuses[:60]) == {0}
    assert statuses[-1] == 6
    assert np.isfinite(model.x).all()


def test_wrong_calls_are_refused(tmp_path: Path) -> None:
    system = ac.compile(Rectifier())
    with pytest.raises(ac.DataError, match="is no name in C"):
        ac.export.c(system, tmp_path, name="2 fast")
    with pytest.raises(ac.DataError, match="name='double' is a word of C"):
        ac.export.c(system, tmp_path, name="double")
    with pytest.raises(ac.ModelError, match="diode"):
        ac.export.c(system, tmp_path, outputs=["dioda.i"])
    with pytest.raises(ac.ExportError, match="has no steps in C"):
        ac.export.c(system, tmp_path, solver="bdf")
    with pytest.raises(ac.DataError, match="dtype="):
        ac.export.c(system, tmp_path, dtype=np.int32)


@pytest.mark.slow
def test_a_model_may_be_called_like_a_word_of_c(tmp_path: Path) -> None:
    class Switch(Rectifier):
        pass

    model = ExportedC(ac.compile(Switch()), tmp_path)
    assert model.name == "switch_model"
    assert np.isfinite(model.derivatives()).all()
