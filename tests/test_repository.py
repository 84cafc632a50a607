"""What a project needs besides code: workflows, templates, policies, and no address until there is one."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest

from acausal.command import EXIT_CODES
from tests.support.paths import ROOT
from tests.support.scripts import script

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
FORMS = sorted((ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml"))
MORE = [ROOT / name for name in ("CITATION.cff", ".pre-commit-config.yaml", "mkdocs.yml")]


def document(path: Path) -> Any:
    """A YAML file."""
    yaml = pytest.importorskip("yaml", reason="YAML is read where the pages can be built")
    return yaml.safe_load(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("path", [*WORKFLOWS, *FORMS, *MORE], ids=lambda path: path.name)
def test_files_are_read(path: Path) -> None:
    assert document(path)


def test_workflows_run_targets_that_exist() -> None:
    targets = re.findall(
        r"^([a-z-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE
    )
    found = {path.name: document(path)["jobs"] for path in WORKFLOWS}
    assert set(found) == {"checks.yml", "nightly.yml", "release.yml"}
    ran: list[str] = []
    for jobs in found.values():
        for job in jobs.values():
            choices = job.get("strategy", {}).get("matrix", {}).get("target", [""])
            for step in job["steps"]:
                for choice in choices:
                    text = step.get("run", "").replace("${{ matrix.target }}", choice)
                    ran += [text] if text.startswith(".ci/run") else []
    assert ".ci/run" in ran
    assert all(word in targets for text in ran for word in text.split()[1:])
    asked = {word for text in ran for word in text.split()[1:]}
    whole = re.search(r"^all=\((.*)\)$", (ROOT / ".ci" / "run").read_text(), re.MULTILINE)
    assert whole is not None
    checks = set(whole[1].replace('"', "").split())
    assert asked == checks | {"test-today"}, "every check runs in some workflow"


def test_every_supported_python_is_checked() -> None:
    pythons = document(ROOT / ".github/workflows/checks.yml")["jobs"]["checks"]["strategy"]
    found = pythons["matrix"]["python"]
    assert f">={found[0]}" == PROJECT["project"]["requires-python"]
    minors = [int(version.partition(".")[2]) for version in found]
    assert minors == list(range(minors[0], minors[-1] + 1))
    about = "Programming Language :: Python :: 3."
    named = [c for c in PROJECT["project"]["classifiers"] if c.startswith(about)]
    assert named == [f"{about}{minor}" for minor in minors]


def test_hooks_call_tools_of_the_environment() -> None:
    repos = document(ROOT / ".pre-commit-config.yaml")["repos"]
    assert [repo["repo"] for repo in repos] == ["local"]
    for hook in repos[0]["hooks"]:
        assert hook["language"] == "system"
        assert hook["entry"].startswith(".venv/bin/")


def test_forms_have_what_is_asked() -> None:
    for path in FORMS:
        if path.name != "config.yml":
            form = document(path)
            assert {"name", "description", "body"} <= set(form)
            assert len({part["id"] for part in form["body"]}) == len(form["body"])


def test_no_address_is_known_until_it_is_set() -> None:
    assert set(PROJECT["tool"]["acausal"]) == {"repository", "documentation", "package-index"}
    assert "urls" not in PROJECT["project"]
    if any(PROJECT["tool"]["acausal"].values()):
        pytest.skip("an address is set")
    for path in [*WORKFLOWS, *FORMS, *MORE, ROOT / "SECURITY.md", ROOT / "pyproject.toml"]:
        assert "://" not in path.read_text(encoding="utf-8"), path.name


def test_pages_have_the_addresses() -> None:
    with_addresses = script("docs/addresses.py").with_addresses
    empty = {"repository": "", "documentation": ""}
    assert with_addresses({"extra": {}}, empty) == {"extra": {}}
    known = {"repository": "https://example.org/a/acausal", "documentation": "https://example.org/"}
    assert with_addresses({"extra": {}}, known) == {
        "repo_url": "https://example.org/a/acausal",
        "repo_name": "acausal",
        "site_url": "https://example.org/",
        "extra": {"version": {"provider": "mike"}},
    }


def test_a_release_is_checked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    release = script(".ci/release.py")
    (tmp_path / "acausal").mkdir()
    (tmp_path / "dist").mkdir()
    (tmp_path / "acausal" / "__init__.py").write_text('__version__ = "1.2.3"\n')
    (tmp_path / "CHANGELOG.md").write_text("## [Unreleased]\n")
    assert release.check("v1.2", tmp_path) == 1
    printed = capsys.readouterr().out
    assert "The tag is v1.2, but acausal/__init__.py has the version 1.2.3." in printed
    assert "CHANGELOG.md has no section '## [1.2.3] - YYYY-MM-DD'." in printed
    assert "dist/ holds []" in printed

    (tmp_path / "CHANGELOG.md").write_text("## [Unreleased]\n\n## [1.2.3] - 2030-01-31\n")
    for name in ("acausal-1.2.3.tar.gz", "acausal-1.2.3-py3-none-any.whl"):
        (tmp_path / "dist" / name).touch()
    assert release.check("v1.2.3", tmp_path) == 0


def test_the_page_lists_the_exit_codes() -> None:
    page = (ROOT / "docs" / "command-line.md").read_text(encoding="utf-8")
    table = dict(re.findall(r"^\| (\d+) \| (.*) \|$", page, re.MULTILINE))
    assert table == {str(code): meaning for code, meaning in EXIT_CODES.items()}


@pytest.mark.slow
def test_what_is_skipped_for_a_reason_that_is_not_listed_fails(tmp_path: Path) -> None:
    (tmp_path / "test_all.py").write_text(
        "import pytest\n"
        "def test_listed(): pytest.skip('there is no C compiler')\n"
        "def test_unlisted(): pytest.skip('too hard')\n"
        "@pytest.mark.xfail(strict=False)\n"
        "def test_that_may_fail(): assert False\n"
    )
    (tmp_path / "test_none.py").write_text(
        "import pytest\npytest.importorskip('no_such_package')\n"
    )
    (tmp_path / "pytest.ini").write_text("[pytest]\n")
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "tests.support.skips", "--continue-on-collection-errors",
         "--rootdir", tmp_path, "-c", tmp_path / "pytest.ini", "-p", "no:cacheprovider", tmp_path],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert "1 failed, 1 skipped, 1 xfailed, 1 error" in done.stdout, done.stdout
    assert "too hard (tests/support/skips.py lists no such reason)" in done.stdout


def test_the_sample_for_other_versions_is_there() -> None:
    names = re.findall(r'"(tests/\S+\.py)"', (ROOT / ".ci" / "dependencies.py").read_text("utf-8"))
    assert len(names) > 20
    assert [name for name in names if not (ROOT / name).is_file()] == []


def test_what_is_built_is_not_in_the_repository() -> None:
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    if listed.returncode:
        pytest.skip("there is no git history")
    built = {".fmu", ".so", ".dll", ".o", ".onnx", ".npz", ".pkl", ".whl", ".zip"}
    assert [name for name in listed.stdout.split("\0") if Path(name).suffix in built] == []


@pytest.mark.slow
def test_a_sample_has_one_of_eight_slow_tests(tmp_path: Path) -> None:
    slow = "".join(f"def test_{i}(): pass\n" for i in range(16))
    text = f"import pytest\npytestmark = pytest.mark.slow\n{slow}"
    (tmp_path / "test_one.py").write_text(text)
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "tests.conftest", "--sample", "-m", "slow", "--collect-only",
         "--rootdir", tmp_path, "-c", "/dev/null", "-p", "no:cacheprovider", "-q", tmp_path],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    listed = (line for line in done.stdout.splitlines() if "::" in line)
    first, second = (int(line.rpartition("test_")[2]) for line in listed)
    assert second - first == 8, done.stdout + done.stderr
