"""Compiled programs on disk: found again, never in the user's way."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import jax
import pytest
from jax.experimental.compilation_cache.compilation_cache import reset_cache

import acausal as ac
from acausal._jax.compilation_cache import (
    ENABLED,
    FOLDER,
    SECOND,
    SHORTEST,
    VARIABLE,
    begin,
    default_folder,
)
from tests.support.paths import ROOT


@pytest.fixture
def setting():
    """A function that changes settings of JAX, at first those of a process without a cache; they are restored."""
    before = {name: getattr(jax.config, name) for name in (FOLDER, ENABLED, SHORTEST)}
    for name, value in ((FOLDER, None), (SHORTEST, SECOND)):
        jax.config.update(name, value)
    yield lambda name, value: jax.config.update(name, value)
    for name, value in before.items():
        jax.config.update(name, value)
    reset_cache()


def folder():
    return getattr(jax.config, FOLDER)


SCRIPT = """
import jax
import numpy as np
import acausal as ac
from acausal.structure import blocks
from tests.support.oscillator import plain
from tests.structure.test_sparse_loops import MODELS, arguments

road = np.sin(np.arange(101.0))
ride = ac.simulate(plain(), (0, 1), dt=0.01, inputs={n: road for n in plain().inputs})
print(float(ride.x[-1, 0]))
blocks.LARGE = blocks.WRITTEN = 10
mesh = ac.compile(MODELS["nonlinear"]())
print(float(jax.jit(mesh.vector_field)(0.3, *arguments(mesh))[0]))
"""


@pytest.mark.slow
def test_a_second_process_compiles_nothing_anew(tmp_path):
    def run():
        done = subprocess.run(
            [sys.executable, "-c", SCRIPT],
            cwd=ROOT,
            env={**os.environ, VARIABLE: str(tmp_path)},
            capture_output=True,
            text=True,
            check=True,
        )
        return done.stdout, sorted(p.name for p in tmp_path.iterdir())

    printed, kept = run()
    assert any("scan" in name for name in kept)
    # Whether a program that calls Python is kept depends on JAX; it must not be called in the process that is gone.
    assert run() == (printed, kept)


@pytest.mark.usefixtures("setting")
def test_by_default_programs_are_kept_in_the_users_cache_folder(tmp_path):
    begin({"XDG_CACHE_HOME": str(tmp_path)})
    assert folder() == str(default_folder({"XDG_CACHE_HOME": str(tmp_path)}))
    assert Path(folder()).parent == tmp_path / "acausal"
    assert Path(folder()).stat().st_mode & 0o077 == 0
    assert getattr(jax.config, SHORTEST) == 0.0


@pytest.mark.usefixtures("setting")
@pytest.mark.parametrize("word", ["off", "OFF", "0", ""])
def test_it_can_be_switched_off(word, tmp_path):
    begin({"XDG_CACHE_HOME": str(tmp_path), VARIABLE: word})
    assert folder() is None
    assert not list(tmp_path.iterdir())


def test_a_cache_that_the_user_has_set_up_is_left_alone(setting, tmp_path):
    setting(FOLDER, "theirs")
    setting(SHORTEST, 3.0)
    begin({VARIABLE: str(tmp_path / "ours")})
    assert folder() == "theirs"
    assert getattr(jax.config, SHORTEST) == 3.0
    assert not list(tmp_path.iterdir())


def test_a_cache_that_the_user_has_disabled_stays_so(setting, tmp_path):
    setting(ENABLED, False)
    begin({VARIABLE: str(tmp_path)})
    assert folder() is None


@pytest.mark.usefixtures("setting")
def test_where_nothing_can_be_written_nothing_is_kept(tmp_path):
    file = tmp_path / "file"
    file.write_text("")
    begin({"XDG_CACHE_HOME": str(file)})
    assert folder() is None
    with pytest.raises(ac.DataError, match=r"no compiled programs can be written to .*file/below"):
        ac.use_compilation_cache(file / "below")
    with pytest.raises(ac.DataError, match=r"^use_compilation_cache: 3.5 is not a path"):
        ac.use_compilation_cache(3.5)


def test_another_folder_and_none_from_now_on(setting, tmp_path):
    setting(SHORTEST, 1.0)
    one, other = tmp_path / "one", tmp_path / "other"
    for chosen, constant in ((one, 1.5), (other, 2.5), (None, 3.5)):
        ac.use_compilation_cache(chosen)
        jax.jit(lambda x, c=constant: c * x)(1.0)
    assert folder() is None
    kept = [[p.name for p in f.iterdir() if "lambda" in p.name] for f in (one, other)]
    assert [len(names) for names in kept] == [1, 1]
    assert kept[0] != kept[1]
