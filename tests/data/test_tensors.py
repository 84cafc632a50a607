"""Files of named arrays, and parameters in them."""

from __future__ import annotations

import errno
import math
import os
import re
from pathlib import Path
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
import safetensors.numpy

import acausal as ac
from acausal.data import params_file, tensors
from tests.support.oscillator import learned, plain


def test_trees_come_back_as_they_were():
    tree = {
        "numbers": (1, 2.5, True), "key": jax.random.key(3), "function": np.sin, "none": None,
        "arrays": [np.zeros((2, 0)), jax.numpy.arange(3), np.float64(1 / 3)], "infinite": np.inf,
    }  # fmt: skip
    back = tensors.filled_like(tree, tensors.named_arrays(tree), "it")
    assert jax.tree.structure(back) == jax.tree.structure(tree)
    for a, b in zip(jax.tree.leaves(back), jax.tree.leaves(tree), strict=True):
        assert type(a) is type(b)
        assert a is b or np.array_equal(*(tensors._stored(x) for x in (a, b)))
    with pytest.raises(ac.DataError, match=r"^it lacks 'x':"):
        tensors.filled_like({"x": 1.0}, {}, "it")
    with pytest.raises(ac.DataError, match=r"^it also has '.*':"):
        tensors.filled_like({}, {"x": np.zeros(1)}, "it")
    with pytest.raises(ac.DataError, match=r"as float64\[2\], but here it is float64\[3\]"):
        tensors.filled_like({"x": np.zeros(3)}, {"x": np.zeros(2)}, "it")


@pytest.fixture(scope="module")
def saved(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("saved") / "trained.safetensors"
    ac.save_params(learned().parameters(3) | {"mass.m": 1.5}, path)
    return path


def test_parameters_come_back_as_they_were(saved: Path):
    params, back = learned().parameters(3) | {"mass.m": 1.5}, ac.load_params(saved, learned())
    assert list(back) == list(params)
    assert back["mass.m"] == 1.5
    assert back["extra.net"](0.3) == params["extra.net"](0.3)
    assert jax.tree.structure(back) == jax.tree.structure(params)


class Line(eqx.Module):
    factor: float
    layers: list[Any]
    function: Any = eqx.field(static=True)

    def __call__(self, x: Any) -> Any:
        return self.factor * x


def test_networks_of_the_users_own(tmp_path: Path):
    path, like = tmp_path / "own.safetensors", {"net": Line(0.0, [np.tanh], np.sin), "a": 0.0}
    ac.save_params({"net": Line(2.0, [np.tanh], np.sin), "a": 1.0}, path)
    back = ac.load_params(path, like)
    assert back["net"](3.0) == 6.0
    assert back["a"] == 1.0
    with pytest.raises(ac.DataError, match=r"has 'net\.function' as sin, but here it is cos"):
        ac.load_params(path, like | {"net": Line(0.0, [np.tanh], np.cos)})
    with pytest.raises(ac.DataError, match=r"has 'net\.layers\[0\]' as tanh, but here it is exp"):
        ac.load_params(path, like | {"net": Line(0.0, [np.exp], np.sin)})


@pytest.mark.parametrize(
    ("model", "sentence"),
    [
        (lambda: plain(), "also has 'extra.net.biases[0]', "),
        (lambda: learned().parameters() | {"spring.k": 1.0}, "lacks 'spring.k': it belongs to another model."),
        (lambda: learned().parameters() | {"extra.net": ac.MLP(width=4, key=0)},
         "has 'extra.net.weights[0]' as float64[8, 1], but here it is float64[4, 1]: it belongs to another model."),
        (lambda: learned().parameters() | {"extra.net": ac.MLP(width=8, input_scale=0.5, output_scale=20.0, key=0)},
         "has 'extra.net.activation' as 'tanh', but here it is 'relu': it belongs to another network."),
    ],
    ids=["no network", "another parameter", "another width", "another activation"],
)  # fmt: skip
def test_parameters_of_another_model_are_refused(saved: Path, model: Any, sentence: str):
    with pytest.raises(ac.DataError) as error:
        ac.load_params(saved, model())
    assert str(error.value).startswith(f"'{saved}' {sentence}")


def test_swapped_arguments_get_one_sentence(tmp_path: Path):
    path: Any = str(tmp_path / "a.safetensors")
    params: Any = plain().parameters()
    wrong = (
        (path, params, "'.*' and a dict"),
        (params, 3, "a dict and a int"),
        ([1.0], path, "a list and '.*'"),
    )
    for first, second, told in wrong:
        with pytest.raises(ac.DataError, match=rf"^save_params takes .* a path, not {told}\.$"):
            ac.save_params(first, second)
    swapped: Any = plain()
    with pytest.raises(ac.DataError, match=r"^load_params takes a path and .* not a System and '"):
        ac.load_params(swapped, path)
    ac.save_params({np.str_("mass.m"): 3.0}, path)
    assert ac.load_params(path, {"mass.m": 2.0}) == {"mass.m": 3.0}


def test_files_that_cannot_be_read_or_written(
    tmp_path: Path, saved: Path, monkeypatch: pytest.MonkeyPatch
):
    missing = os.strerror(errno.ENOENT)
    with pytest.raises(ac.DataError, match=f"cannot be read: {re.escape(missing)}"):
        ac.load_params(tmp_path / "none.safetensors", learned())
    with pytest.raises(ac.DataError, match=rf"cannot be written: {re.escape(missing)}\.$"):
        ac.save_params({}, tmp_path / "none" / "a.safetensors")
    tensors.write_arrays(tmp_path / "a.safetensors", {}, {"kind": "something else"})
    with pytest.raises(
        ac.DataError, match=r"does not hold parameters of a model, .* but: something else"
    ):
        ac.load_params(tmp_path / "a.safetensors", learned())

    def fail(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    before = saved.read_bytes()
    monkeypatch.setattr(os, "fsync", fail)
    with pytest.raises(ac.DataError, match=r"cannot be written: No space left on device\.$"):
        ac.save_params(plain().parameters(), saved)
    assert saved.read_bytes() == before
    assert [p.name for p in saved.parent.iterdir()] == [saved.name]


@pytest.mark.parametrize(
    ("value", "told"),
    [
        (1j, "'mass.m' is of type complex128; give real numbers"),
        (jnp.zeros(2, jnp.float8_e4m3fn), "'mass.m' is of type float8_e4m3fn"),
        (np.array([None]), "'mass.m' is of type object"),
        (object(), "'mass.m' is <object .*; give real numbers or networks"),
        ("heavy", "'mass.m' is 'heavy'; give real numbers"),
        (math.nan, "'mass.m' has NaN, with which no model runs"),
    ],
)
def test_what_is_no_parameter_is_not_saved(value: Any, told: str, tmp_path: Path):
    with pytest.raises(ac.DataError, match=rf"^save_params: {told}"):
        ac.save_params({"mass.m": value}, tmp_path / "a.safetensors")
    assert not list(tmp_path.iterdir())


def test_values_with_which_no_model_runs_are_not_loaded(tmp_path: Path):
    path, params = tmp_path / "a.safetensors", plain().parameters()
    about = {"kind": params_file.KIND, "settings": {}}
    for value, told in (
        (math.nan, "'mass.m' is not finite"),
        (math.inf, "'mass.m' is not finite"),
    ):
        tensors.write_arrays(path, tensors.named_arrays({**params, "mass.m": value}), about)
        with pytest.raises(ac.DataError, match=f"a.safetensors': {told}"):
            ac.load_params(path, plain())
    ac.save_params({**params, "mass.m": -1.0}, path)  # to which a training may lead
    with pytest.warns(
        UserWarning, match="'mass.m' is -1, but must be at least 0 kg; no simulation"
    ):
        assert ac.load_params(path, plain())["mass.m"] == -1.0
    for same in (2, True, np.float32(2.0)):
        ac.save_params({**params, "mass.m": same}, path)
        assert ac.load_params(path, plain())["mass.m"] == same
    ac.save_params({"limit": math.inf}, path)
    assert ac.load_params(path, {"limit": np.inf}) == {"limit": np.inf}


@pytest.mark.parametrize(
    ("about", "told"),
    [
        ("[1]", "its description is not an object"),
        ("{", "its description is not an object"),
        ("[" * 100_000, "its description is not an object"),
        (f'{{"kind": "{params_file.KIND}"}}', "does not say which settings"),
    ],
)
def test_a_wrong_description_is_refused(about: str, told: str, tmp_path: Path):
    path, arrays = tmp_path / "a.safetensors", {"mass.m": np.array(1.0)}
    told_of = {"about": about, "sha256": tensors._checksum(arrays, about)}
    path.write_bytes(safetensors.numpy.save(arrays, told_of))
    with pytest.raises(ac.DataError, match=told):
        ac.load_params(path, plain())
