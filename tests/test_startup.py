"""What a user does not wait for: modules that nobody has asked for."""

from __future__ import annotations

import ast
import pkgutil
import subprocess
import sys
from pathlib import Path

import pytest

import acausal as ac

ROOT = Path(__file__).parents[1]
SLOW = (
    *("diffrax", "equinox", "matplotlib", "networkx", "optax"),
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


def test_simulating_needs_nothing_for_training_or_drawing():
    found = loaded("import acausal as ac; ac.compile, ac.simulate")
    assert not {"matplotlib", "networkx", "optax", "pandas", "rich"}.intersection(found)


def imported_for_type_checkers():
    """Where type checkers are told that the public names live."""
    tree = ast.parse(Path(ac.__file__).read_text(encoding="utf-8"))
    (block,) = (node for node in tree.body if isinstance(node, ast.If))
    return {
        alias.name: node.module
        for node in block.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }


def test_type_checkers_are_told_the_truth():
    homes = {name: f"acausal.{module}" for name, module in ac._HOME.items()}
    assert imported_for_type_checkers() == {**homes, "networks": "acausal"}
    assert sorted(ac.__all__) == sorted([*ac._HOME, "networks"])


@pytest.mark.parametrize("name", ac.__all__)
def test_every_public_name_is_there(name):
    assert name in dir(ac)
    home = getattr(getattr(ac, name), "__module__", "acausal")
    assert home.startswith(("acausal", "sympy"))


def test_no_public_name_is_a_modules():
    """Importing ``acausal.fit`` would put the module in the place of the function."""
    modules = {m.name for m in pkgutil.iter_modules(ac.__path__)}
    assert modules.intersection(ac.__all__) == {"networks"}


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="'acausal' has no attribute 'nonsense'"):
        _ = ac.nonsense
