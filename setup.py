"""What pyproject.toml cannot say by itself: the project's addresses, which are left out while they are not set."""

import tomllib
from pathlib import Path

from setuptools import setup

SETTINGS = tomllib.loads(Path(__file__).with_name("pyproject.toml").read_text(encoding="utf-8"))
ADDRESSES = SETTINGS["tool"]["acausal"]
REPOSITORY, DOCUMENTATION = ADDRESSES["repository"], ADDRESSES["documentation"]
LINKS = {
    "Repository": REPOSITORY,
    "Issues": REPOSITORY and f"{REPOSITORY}/issues",
    "Documentation": DOCUMENTATION,
}

setup(project_urls={name: link for name, link in LINKS.items() if link})
