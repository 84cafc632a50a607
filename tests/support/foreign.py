"""FMUs that other tools have made: they lie in a folder of the machine, and never in this repository."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

FOLDER = Path(os.environ.get("ACAUSAL_FMUS") or Path.home() / ".cache/acausal/fmus")
"""`pip download --no-deps gemseo-fmu==3.1.1`, and its ``gemseo_fmu/problems/fmu_files/linux`` unpacked there."""


def foreign_fmu(name: str) -> Path:
    """An FMU of the package gemseo-fmu, or the test is skipped."""
    pytest.importorskip("fmpy", reason="fmpy is not installed")
    path = FOLDER / f"{name}.fmu"
    if not path.is_file():
        pytest.skip(
            f"there is no {path}: unpack those of gemseo-fmu 3.1.1 there, or set ACAUSAL_FMUS"
        )
    return path
