"""What is shipped, and that it works away from the checkout."""

import ast
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

import acausal as ac
from tests.support.bare import environment, requirements_of
from tests.support.paths import ROOT
from tests.support.scripts import script
from tests.test_docs import blocks

FOLDERS = {"acausal": ROOT / "acausal", "acausal/components": ROOT / "components"}
DATA = ("*.c", "*.h", "*.pyi", "*.schema.json", "*.template", "document/page.*s")
BUILT = {"build", "dist", "site"}
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))

VERSION = ac.__version__

WHERE_FROM = """
import importlib.util
for name in ("acausal", "acausal.components"):
    print(importlib.util.find_spec(name).origin)
print([name for name in ("components", "examples", "tests") if importlib.util.find_spec(name)])
"""

NOT_THERE = """
print([name for name in ("matplotlib", "pandas", "pytest", "onnx") if importlib.util.find_spec(name)])
"""


def run(*command: str | Path, cwd: Path) -> str:
    """Run a command and return its standard output; fail with all that it printed."""
    done = subprocess.run(
        [str(part) for part in command], cwd=cwd, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, f"{command} failed:\n{done.stdout}\n{done.stderr}"
    return done.stdout


def build(kind: str, source: Path, into: Path) -> Path:
    """Build ``kind`` ("sdist" or "wheel") of the tree ``source`` and return the file."""
    run(sys.executable, "-m", "build", f"--{kind}", "--no-isolation", "-o", into, ".", cwd=source)
    (built,) = into.iterdir()
    return built


def modules(wheel: Path) -> list[str]:
    """The files of a wheel, sorted, without its metadata."""
    with zipfile.ZipFile(wheel) as archive:
        return sorted(name for name in archive.namelist() if ".dist-info/" not in name)


def python_files(folder: Path = ROOT) -> Iterator[Path]:
    """Every Python file below ``folder``, outside hidden, built and linked folders."""
    for path in sorted(folder.iterdir()):
        if path.name.startswith(".") or path.name in BUILT or path.is_symlink():
            continue
        if path.is_dir():
            yield from python_files(path)
        elif path.suffix == ".py":
            yield path


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of what packaging reads, symlink included, free of what earlier builds left."""
    copy = tmp_path_factory.mktemp("tree")
    for name in (
        "pyproject.toml",
        "setup.py",
        "README.md",
        "LICENSE",
        "CHANGELOG.md",
        "MANIFEST.in",
    ):
        if (ROOT / name).exists():
            shutil.copy(ROOT / name, copy)
    for name in ("acausal", "components", "examples", "tests", "docs"):
        if (ROOT / name).exists():
            skip = shutil.ignore_patterns("__pycache__")
            shutil.copytree(ROOT / name, copy / name, symlinks=True, ignore=skip)
    return copy


@pytest.fixture(scope="module")
def wheel(tree: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel of ``tree``."""
    return build("wheel", tree, tmp_path_factory.mktemp("wheel"))


def test_wheel_holds_each_module_once_and_nothing_else(wheel: Path) -> None:
    expected = sorted(
        f"{package}/{path.relative_to(folder).as_posix()}"
        for package, folder in FOLDERS.items()
        for path in (
            *python_files(folder),
            folder / "py.typed",
            *(path for kind in DATA for path in folder.rglob(kind)),
        )
    )
    assert modules(wheel) == expected


def test_no_package_is_left_out() -> None:
    packages = {
        ".".join((package.replace("/", "."), *path.parent.relative_to(folder).parts))
        for package, folder in FOLDERS.items()
        for path in python_files(folder)
    }
    listed = PROJECT["tool"]["setuptools"]["packages"]
    assert sorted(packages) == listed, "list every package in pyproject.toml, in order"


def test_wheel_names_its_license_and_python(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        (metadata,) = (name for name in names if name.endswith(".dist-info/METADATA"))
        text = archive.read(metadata).decode()
    assert "License-Expression: Apache-2.0" in text
    assert "Requires-Python: >=3.11" in text
    assert any(name.endswith("/licenses/LICENSE") for name in names)


@pytest.mark.slow
def test_sdist_gives_the_same_wheel(tree: Path, wheel: Path, tmp_path: Path) -> None:
    sdist = build("sdist", tree, tmp_path / "sdist")
    with tarfile.open(sdist) as archive:
        assert not [member.name for member in archive if member.issym() or member.islnk()]
    run(sys.executable, "-m", "tarfile", "--extract", sdist, tmp_path, cwd=tmp_path)
    unpacked = tmp_path / sdist.name.removesuffix(".tar.gz")
    assert not (unpacked / "acausal" / "components").exists()
    assert not (unpacked / "tests").exists()
    assert modules(build("wheel", unpacked, tmp_path / "wheel")) == modules(wheel)


def test_the_symlink_leads_to_the_library() -> None:
    link = ROOT / "acausal" / "components"
    assert link.is_symlink()
    assert str(link.readlink()) == "../components"


@pytest.mark.slow
def test_nothing_imports_the_top_level_folder() -> None:
    offenders: list[str] = []
    for path in python_files():
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"), filename=str(path))):
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom) and node.level == 0:
                names = [node.module or ""]
            else:
                continue
            if any(name.split(".")[0] == "components" for name in names):
                offenders.append(f"{path.relative_to(ROOT)}:{node.lineno}")
    assert not offenders, "import acausal.components instead"


def test_the_development_install_shows_what_the_wheel_would(tmp_path: Path) -> None:
    acausal, components, others = run(
        sys.executable, "-I", "-c", WHERE_FROM, cwd=tmp_path
    ).splitlines()
    assert Path(acausal) == ROOT / "acausal" / "__init__.py"
    assert Path(components).resolve() == ROOT / "components" / "__init__.py"
    assert others == "[]"


@pytest.mark.slow
def test_the_installed_wheel_runs_the_readme_in_a_bare_environment(
    wheel: Path, tmp_path: Path
) -> None:
    """With nothing but what the wheel says it needs: no matplotlib, no pandas, no pytest."""
    pytest.importorskip("ensurepip", reason="this Python cannot make environments")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path / "wheel")
    (metadata,) = (tmp_path / "wheel").glob("*.dist-info")
    python = environment(tmp_path / "env", requirements_of(metadata))
    run(python, "-m", "pip", "install", "--no-index", "--no-deps", wheel, cwd=tmp_path)
    assert run(python.with_name("acausal"), "--version", cwd=tmp_path) == f"acausal {VERSION}\n"

    example = next(blocks(ROOT / "README.md"))
    (tmp_path / "readme.py").write_text(example + WHERE_FROM + NOT_THERE, encoding="utf-8")
    *_, acausal, components, others, extras = run(python, "readme.py", cwd=tmp_path).splitlines()
    installed = Path(sysconfig.get_path("purelib", vars={"base": str(tmp_path / "env")}))
    assert Path(acausal) == installed / "acausal" / "__init__.py"
    assert Path(components) == installed / "acausal" / "components" / "__init__.py"
    assert others == "[]"
    assert extras == "[]"


def test_the_version_stands_in_one_place(wheel: Path) -> None:
    release = script(".ci/release.py")
    assert release.version() == ac.__version__ == VERSION
    assert wheel.name.startswith(f"acausal-{ac.__version__}-")
    assert "version" not in PROJECT["project"]
    for name in ("CITATION.cff", "README.md", "mkdocs.yml"):
        assert VERSION not in (ROOT / name).read_text(encoding="utf-8")


@pytest.mark.slow
def test_links_are_left_out_until_they_are_set(tree: Path, wheel: Path, tmp_path: Path) -> None:
    assert links(wheel) == []
    shutil.copytree(tree, tmp_path / "tree", symlinks=True)
    project = (tree / "pyproject.toml").read_text(encoding="utf-8")
    there = project.replace('repository = ""', 'repository = "https://example.org/acausal"')
    (tmp_path / "tree" / "pyproject.toml").write_text(there, encoding="utf-8")
    assert links(build("wheel", tmp_path / "tree", tmp_path / "dist")) == [
        "Project-URL: Repository, https://example.org/acausal",
        "Project-URL: Issues, https://example.org/acausal/issues",
    ]


def links(wheel: Path) -> list[str]:
    """The addresses in a wheel's metadata."""
    with zipfile.ZipFile(wheel) as archive:
        (metadata,) = (n for n in archive.namelist() if n.endswith(".dist-info/METADATA"))
        lines = archive.read(metadata).decode().splitlines()
    return [line for line in lines if line.startswith("Project-URL: ")]
