"""ONNX files, run by onnxruntime."""

import json
import sys

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from examples.qvm import model as qvm
from tests.support.hybrid import Thermostat

onnx = pytest.importorskip("onnx", reason="onnx, which writes the files, is not installed")

T, X, U = np.array(0.5), np.linspace(-0.02, 0.03, 5), np.array([0.1])


@pytest.fixture(scope="module")
def vehicle():
    return ac.compile(qvm.with_networks())


@pytest.fixture
def run():
    """Runs a file with arrays by name."""
    why = "onnxruntime, which runs the files, is not installed"
    onnxruntime = pytest.importorskip("onnxruntime", reason=why)

    def run(path, **arrays):
        session = onnxruntime.InferenceSession(str(path), providers=["CPUExecutionProvider"])
        return session.run(None, arrays)

    return run


def same(found, expected):
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)


@pytest.mark.slow
def test_the_right_hand_side_is_that_of_jax(vehicle, run, tmp_path):
    params = vehicle.parameters(3)
    path = ac.export.onnx(vehicle, tmp_path / "v.onnx", params, outputs=["body.a"])
    dx, y = run(path, t=T, x=X, u=U)
    expected = vehicle.vector_field_and_observe(["body.a"], T, X, U, params)
    same(dx, expected[0])
    same(y, expected[1])
    notes = {p.key: json.loads(p.value) for p in onnx.load(path).metadata_props}
    assert notes["acausal.x"]["names"] == list(vehicle.states)


def test_parameters_and_weights_are_inputs_with_defaults(vehicle, run, tmp_path):
    params = vehicle.parameters(3)
    path = ac.export.onnx(vehicle, tmp_path / "v.onnx", params, parameters=True)
    same(run(path, t=T, x=X, u=U)[0], vehicle.vector_field(T, X, U, params))
    others = {**vehicle.parameters(4), "body.m": 411.0, "tyre.c": 2e5}
    leaves = jax.tree.leaves(eqx.filter(others, eqx.is_inexact_array_like))
    names = [given.name for given in onnx.load(path).graph.input][3:]
    changed = {n: np.asarray(a, float) for n, a in zip(names, leaves, strict=True)}
    assert {"body.m", "spring_nn.net.weights[1]"} <= set(changed)
    same(run(path, t=T, x=X, u=U, **changed)[0], vehicle.vector_field(T, X, U, others))


def test_discrete_variables_are_an_input(run, tmp_path):
    path = ac.export.onnx(ac.compile(Thermostat()), tmp_path / "d.onnx")
    notes = {p.key: json.loads(p.value) for p in onnx.load(path).metadata_props}
    place = notes["acausal.d"]["names"].index("on")
    for on in (0.0, 1.0):
        d = np.zeros(len(notes["acausal.d"]["names"]))
        d[place] = on
        (dx,) = run(path, t=np.array(0.0), x=np.array([20.0]), d=d)
        same(dx, [(30 * on - 10) / 10])


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize(
    "law",
    [
        ac.networks.Law(monotone=True, odd=True, passive=True, extrapolation="linear"),
        ac.networks.Law(passive=True, activation="gelu"),
        ac.networks.Energy(convex=True, passive=True),
    ],
    ids=["monotone", "passive", "energy"],
)
def test_laws_in_batches(law, run, tmp_path):
    network = law(0)
    path = ac.export.onnx(network, tmp_path / "law.onnx", inputs=["s_rel"], batch="N")
    x = np.linspace(-4, 4, 9)
    (y,) = run(path, s_rel=x)
    same(y, jax.jit(jax.vmap(ac.networks.law_of(network)))(x))


def test_a_network_of_a_system_has_its_names(vehicle, tmp_path):
    path = ac.export.onnx(vehicle, tmp_path / "n.onnx", network="spring_nn.net", dtype="float32")
    graph = onnx.load(path).graph
    assert [i.name for i in graph.input] == ["spring_nn.s_rel"]
    assert [o.name for o in graph.output] == ["spring_nn.f"]


def loop(x):
    """A loop over rows, from the last to the first, whose rows are results."""
    rows = jnp.arange(6.0).reshape(3, 2)

    def body(c, row):
        return jnp.tanh(c * row[0] + x), c * row[1]

    end, each = jax.lax.scan(body, x, rows, reverse=True)
    return end + each[0] + 2 * each[1] + 4 * each[2]


def choice(x):
    """One of three branches, and one of two."""
    case = jnp.clip(x, 0, 2).astype(int)
    found = jax.lax.switch(case, [jnp.sin, jnp.exp, lambda x: x**3], x)
    return jax.lax.cond(x > 1, lambda a: a + 1, lambda a: 2 * a, found)


def search(x):
    """Newton's method, as often as it takes."""

    def step(y):
        return y - (y**3 + y - x) / (3 * y**2 + 1)

    return jax.lax.while_loop(lambda y: jnp.abs(y**3 + y - x) > 1e-12, step, x)


@pytest.mark.parametrize("network", [loop, choice, search], ids=lambda f: f.__name__)
def test_loops_and_branches(network, run, tmp_path):
    path = ac.export.onnx(network, tmp_path / "loop.onnx")
    for x in (-0.5, 0.3, 1.4, 2.6):
        same(run(path, x=np.array(x))[0], network(jnp.asarray(x)))


FUNCTIONS = [
    jnp.cos, jnp.tan, jnp.sinh, jnp.cosh, jnp.arctan, jnp.log1p, jnp.expm1, jnp.arcsinh, jnp.cbrt,
]  # fmt: skip


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda f: f.__name__)
def test_functions_that_run_times_lack_are_composed(function, run, tmp_path):
    path = ac.export.onnx(lambda x: function(x), tmp_path / "f.onnx", batch="N")
    x = np.array([1e-9, 0.1, 0.7, 1.5, 20.0])
    (y,) = run(path, x=x)
    np.testing.assert_allclose(y, function(x), rtol=1e-12)


def test_what_has_no_counterpart_is_named(vehicle, tmp_path):
    path = tmp_path / "s.onnx"
    with pytest.raises(ac.DataError, match="'sort' has no counterpart in ONNX"):
        ac.export.onnx(lambda x, y: jnp.sort(jnp.stack([x, y]))[0], path)
    with pytest.raises(ac.DataError, match=r"did you mean 'spring_nn\.net'"):
        ac.export.onnx(vehicle, path, network="spring_n.net")
    with pytest.raises(ac.DataError, match="the network calls Python \\(a host callback\\)"):
        ac.export.onnx(
            lambda x: jax.pure_callback(np.sin, jax.ShapeDtypeStruct((), float), x), path
        )
    with pytest.raises(ac.ModelError, match=r"export\.onnx needs a compiled model, got Thermostat"):
        ac.export.onnx(Thermostat(), path)
    assert not path.exists()


@pytest.mark.parametrize("form", ["onnx", "stablehlo", "modelica"])
def test_networks_that_are_not_given_are_missed(vehicle, form, tmp_path):
    """None is exported with untrained weights in its place."""
    write, path = getattr(ac.export, form), tmp_path / "v.mlir"
    with pytest.raises(ac.DataError, match=r"params lacks 'spring_nn\.net', 'damper_nn\.net'"):
        write(vehicle, path, {"tyre.c": 2e5})
    with pytest.raises(ac.DataError, match=r"numbers and networks by name, not \[1\]"):
        write(vehicle, path, [1])


def test_a_missing_package_is_named(vehicle, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "onnx", None)
    with pytest.raises(ac.DataError, match=r"export\.onnx needs onnx: pip install "):
        ac.export.onnx(vehicle, tmp_path / "v.onnx")
