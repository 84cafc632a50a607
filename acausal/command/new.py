"""``acausal new``: a library of components, with tests that pass."""

from __future__ import annotations

import keyword
import sys
from argparse import Namespace
from importlib.resources import files
from pathlib import Path
from string import Template

import acausal as ac
from acausal.command.arguments import Parsers, add_command
from acausal.command.exit_codes import UsageError
from acausal.command.output import CommandOutput
from acausal.files import write_files

FILES = {
    "pyproject.toml": "pyproject.toml.template",
    "README.md": "readme.md.template",
    ".gitignore": "gitignore.template",
    "src/{name}/__init__.py": "init.py.template",
    "src/{name}/springs.py": "springs.py.template",
    "src/{name}/py.typed": None,
    "tests/test_springs.py": "test_springs.py.template",
    "models/oscillator.json": "oscillator.json.template",
}
"""The files of a new library, each with its template; None for an empty one."""


def add(parsers: Parsers) -> None:
    """The command's arguments."""
    parser = add_command(
        parsers,
        "new",
        run,
        "begin a library of components, with tests",
        "Begin a library of components: a package with a spring, a model that uses it, and tests that pass.",
        """
        acausal new mylib
        cd mylib && pip install -e '.[dev]' && pytest
        """,
    )
    parser.add_argument("name", help="of the package, such as mylib")
    parser.add_argument(
        "--into", default=".", metavar="FOLDER", help="where its folder is made (.)"
    )


def run(args: Namespace, out: CommandOutput) -> None:
    """Write the files."""
    name, folder = args.name, Path(args.into) / args.name
    _check_name(name)
    if folder.exists():
        raise ac.DataError(f"'{folder}' exists; choose another name, or --into another folder.")
    written = {folder / p.format(name=name): _filled(t, name) for p, t in FILES.items()}
    write_files(written, make_folders=True)
    out.say(f"wrote {folder}:")
    for file in written:
        out.say(f"  {file.relative_to(folder)}")
    out.say(f"next: cd {folder} && pip install -e '.[dev]' && pytest")
    out.result({"name": name, "files": [str(file) for file in written]})


def _check_name(name: str) -> None:
    """Refuse what cannot be imported, and names that are taken."""
    if keyword.iskeyword(name):
        raise UsageError(f"'{name}' is a word of Python's own; choose another name.")
    if not name.isidentifier() or not name.isascii():
        raise UsageError(
            f"'{name}' is not a name of a package; use small letters, digits and underscores."
        )
    if name in sys.stdlib_module_names or name in ("acausal", "tests"):
        raise UsageError(f"'{name}' is the name of another package; choose your own.")


def _filled(template: str | None, name: str) -> str:
    if template is None:
        return ""
    text = files("acausal.command").joinpath("new_library", template).read_text("utf-8")
    return Template(text).substitute(name=name)
