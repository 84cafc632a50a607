"""What a release needs to know.

python .ci/release.py check v1.2.3      refuse a tag that is not the version, or that the changelog does not know
python .ci/release.py settings          the addresses of pyproject.toml, as lines name=value

The version stands in acausal/__init__.py and nowhere else.
"""

from __future__ import annotations

import ast
import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def main() -> int:
    match sys.argv[1:]:
        case ["check", tag]:
            return check(tag)
        case ["settings"]:
            print(*(f"{name}={value}" for name, value in settings().items()), sep="\n")
            return 0
        case _:
            print(__doc__, file=sys.stderr)
            return 2


def check(tag: str, root: Path = ROOT) -> int:
    """Compare a tag with the version, the changelog and what was built."""
    now = version(root)
    wrong: list[str] = []
    if tag != f"v{now}":
        wrong.append(f"The tag is {tag}, but acausal/__init__.py has the version {now}.")
    changes = (root / "CHANGELOG.md").read_text(encoding="utf-8")
    if not re.search(rf"^## \[{re.escape(now)}\] - \d{{4}}-\d\d-\d\d$", changes, re.MULTILINE):
        wrong.append(f"CHANGELOG.md has no section '## [{now}] - YYYY-MM-DD'.")
    built = sorted(path.name for path in (root / "dist").glob("*"))
    if [name for name in built if not name.startswith(f"acausal-{now}")] or len(built) != 2:
        wrong.append(f"dist/ holds {built}, not one sdist and one wheel of {now}: make wheel.")
    print(*(wrong or [f"{tag} can be released."]), sep="\n")
    return 1 if wrong else 0


def version(root: Path = ROOT) -> str:
    """The version, from the one place that has it."""
    tree = ast.parse((root / "acausal" / "__init__.py").read_text(encoding="utf-8"))
    for node in tree.body:
        match node:
            case ast.Assign(targets=[ast.Name("__version__")], value=ast.Constant(str(found))):
                return found
            case _:
                continue
    raise SystemExit("acausal/__init__.py has no __version__.")


def settings() -> dict[str, str]:
    """The addresses of the project; those that are not set are empty."""
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["acausal"]


if __name__ == "__main__":
    sys.exit(main())
