"""StableHLO files, read back by JAX alone."""

import sys
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from examples.qvm import model as qvm


@pytest.mark.slow
def test_round_trip_with_a_derivative(tmp_path):
    pytest.importorskip("flatbuffers", reason="flatbuffers, which writes .jax, is not installed")
    system = ac.compile(qvm.with_networks())
    params = system.parameters(0)
    path = ac.export.stablehlo(system, tmp_path / "v.jax", params, outputs=["body.a"])
    again = jax.export.deserialize(bytearray(path.read_bytes()))
    x, u = jnp.arange(5.0) / 100, jnp.zeros(1)
    dx, _ = again.call(0.0, x, u)
    np.testing.assert_allclose(dx, system.vector_field(0.0, x, u, params), rtol=1e-12)
    expected = jax.grad(lambda x: system.observe("body.a", 0.0, x, u, params))(x)
    found = jax.grad(lambda x: again.call(0.0, x, u)[1][0])(x)
    np.testing.assert_allclose(found, expected, rtol=1e-12)
    text = ac.export.stablehlo(system, tmp_path / "v.mlir", params).read_text()
    assert text.count("%arg") >= text.count("// argument") > 0
    assert all(
        f"%arg{i}:" in text for i in range(text.count("// argument"))
    )  # also what is not used
    assert str(Path(__file__).parents[2]) not in text
    assert "body.s" in text
    assert "stablehlo." in text


def test_a_batch_of_any_size(tmp_path):
    pytest.importorskip("flatbuffers", reason="flatbuffers, which writes .jax, is not installed")
    network = ac.MLP(key=0)
    path = ac.export.stablehlo(network, tmp_path / "n.jax", batch="N", derivatives=0)
    again = jax.export.deserialize(bytearray(path.read_bytes()))
    x = jnp.linspace(-1, 1, 7)
    np.testing.assert_allclose(again.call(x)[0], jax.vmap(network)(x), rtol=1e-12)


def test_an_ending_that_is_no_form_is_refused(tmp_path):
    with pytest.raises(ac.DataError, match=r"end the path in \.mlir, \.mlirbc, \.jax"):
        ac.export.stablehlo(ac.MLP(key=0), tmp_path / "v.txt")
    with pytest.raises(ac.DataError, match="there is no platform 'gpu'"):
        ac.export.stablehlo(ac.MLP(key=0), tmp_path / "v.mlir", platforms=["cpu", "gpu"])


def test_a_host_callback_is_refused(tmp_path):
    def law(x):
        return jax.pure_callback(np.sin, jax.ShapeDtypeStruct((), float), x)

    with pytest.raises(ac.DataError, match=r"JAX cannot export it .* without host callbacks"):
        ac.export.stablehlo(law, tmp_path / "v.mlirbc")


def test_a_missing_package_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "flatbuffers", None)
    with pytest.raises(ac.DataError, match=r"needs flatbuffers: pip install "):
        ac.export.stablehlo(ac.MLP(key=0), tmp_path / "v.jax")
