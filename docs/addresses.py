"""A hook of mkdocs: the addresses of the project on its pages, from `[tool.acausal]` in pyproject.toml.

While they are empty, the pages have no link to a repository and no choice of versions.
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent


def on_config(config: Any) -> Any:
    """Set the addresses."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    return with_addresses(config, settings["tool"]["acausal"])


def with_addresses(config: Any, addresses: dict[str, str]) -> Any:
    """The configuration with a link to the repository, and versions where the pages are served."""
    if addresses["repository"]:
        config["repo_url"] = addresses["repository"]
        config["repo_name"] = addresses["repository"].rstrip("/").rpartition("/")[2]
    if addresses["documentation"]:
        config["site_url"] = addresses["documentation"]
        config["extra"]["version"] = {"provider": "mike"}
    return config
