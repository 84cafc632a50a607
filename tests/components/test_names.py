"""What packages of components export: each class that their modules define, and nothing that these import."""

import ast
import importlib
import inspect
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

from acausal import components
from acausal.components import electrical, translational as tl

PACKAGES = [importlib.import_module(f"acausal.components.{name}") for name in components.PACKAGES]


def imported_by_star(package: ModuleType) -> list[ModuleType]:
    """The modules that a package imports by ``*``."""
    tree = ast.parse(inspect.getsource(package))
    stars = [n for n in tree.body if isinstance(n, ast.ImportFrom) and n.names[0].name == "*"]
    paths = [f"{package.__name__}.{n.module}" if n.level else n.module for n in stars]
    return [importlib.import_module(path) for path in paths if path]


def defined(module: ModuleType) -> set[str]:
    """The public names that stand in a module's text, other than those that it imports."""
    found: set[str] = set()
    for node in ast.parse(Path(str(module.__file__)).read_text(encoding="utf-8")).body:
        if isinstance(node, ast.ClassDef | ast.FunctionDef):
            found.add(node.name)
        elif isinstance(node, ast.Assign):
            found |= {target.id for target in node.targets if isinstance(target, ast.Name)}
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            found.add(node.target.id)
    return {name for name in found if not name.startswith("_")}


@pytest.mark.parametrize("package", PACKAGES, ids=components.PACKAGES)
def test_a_package_exports_what_its_modules_define(package: ModuleType) -> None:
    written = set[str]().union(*map(defined, imported_by_star(package)))
    exported = {name for name in package.__all__ if not inspect.ismodule(getattr(package, name))}
    further = {"Nand", "NonlinearResistor", "Transistor"} if package is electrical else set[str]()
    assert exported == written | further


@pytest.mark.parametrize("package", PACKAGES, ids=components.PACKAGES)
def test_nothing_else_is_seen(package: ModuleType) -> None:
    assert dir(package) == sorted(package.__all__)
    assert not {"ac", "Any", "Iterator", "export"} & set(vars(package))
    assert not [name for name in package.__all__ if name.startswith("_")]


def test_a_name_stands_for_one_class() -> None:
    assert tl.Mass.__module__ == "acausal.components.translational.components"
    assert tl.Spring is not tl.utilities.Spring
    assert {"Spring", "DirectMass"} <= set(tl.utilities.__all__)


@pytest.mark.slow
def test_rotational_mechanics_does_not_import_translational_mechanics() -> None:
    program = "import sys, acausal.components.rotational as r; print('acausal.components.translational' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "False"


def test_a_prompt_completes_the_packages_alone() -> None:
    assert dir(components) == sorted(components.PACKAGES)
    assert {"rotational", "blocks", "neural"} <= set(dir(components))
