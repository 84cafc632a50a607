"""What a user does not wait for: modules that nobody has asked for."""

from __future__ import annotations

import ast
import pkgutil
import subprocess
import sys

import pytest

import acausal as ac
from tests.support.paths import ROOT

SLOW = (
    *("diffrax", "equinox", "jax", "matplotlib", "networkx", "optax"),
    *("pandas", "pint", "rich", "scipy", "sympy"),
)


def loaded(code):
    """Which of the slow modules a fresh process has loaded after some code."""
    code += f"\nimport sys; print([m for m in {SLOW} if m in sys.modules])"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return ast.literal_eval(done.stdout.splitlines()[-1])


def test_importing_acausal_imports_no_slow_module():
    assert loaded("import acausal") == []


def test_declaring_needs_sympy_alone():
    assert loaded("import acausal as ac\nclass A(ac.Component): x = ac.Variable()") == ["sympy"]


@pytest.mark.slow
def test_simulating_needs_nothing_for_training_or_drawing():
    found = loaded("import acausal as ac; ac.compile, ac.simulate")
    assert not {"matplotlib", "networkx", "optax", "pandas", "rich"}.intersection(found)


def test_packages_of_the_library_are_completed_before_their_import():
    loaded(
        "import sys, acausal.components as c\n"
        "assert {'rotational', 'electrical'} <= set(dir(c))\n"
        "assert 'acausal.components.rotational' not in sys.modules"
    )


@pytest.mark.slow
def test_single_precision_of_the_environment_is_kept_and_refused_with_a_sentence():
    code = """import os; os.environ['JAX_ENABLE_X64'] = '0'
import acausal as ac
class A(ac.Component): x = ac.Variable()
try: ac.compile(A())
except ac.AcausalError as error: assert 'JAX_ENABLE_X64' in str(error)
else: raise SystemExit(1)"""
    assert "jax" in loaded(code)


def test_public_names_stand_once():
    assert len(ac.__all__) == len(set(ac.__all__)) > 50


def test_dir_lists_the_public_names_only():
    assert sorted(dir(ac)) == sorted(ac.__all__)


@pytest.mark.parametrize("name", ac.__all__)
def test_every_public_name_is_there(name):
    assert name in dir(ac)
    home = getattr(getattr(ac, name), "__module__", "acausal")
    assert home.startswith(("acausal", "sympy"))


def test_no_public_name_is_a_modules():
    """Importing ``acausal.fit`` would put the module in the place of the function."""
    modules = {m.name for m in pkgutil.iter_modules(ac.__path__)}
    assert modules.intersection(ac.__all__) == {"control", "export", "networks"}


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="nonsense"):
        _ = ac.nonsense


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("first", ["ac.export.modelica", "ac.use_compilation_cache(None)"])
def test_any_name_may_be_the_first_that_needs_jax(first: str):
    assert "jax" in loaded(f"import acausal as ac; {first}")
