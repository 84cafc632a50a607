"""Exported FMUs, unpacked and driven by fmpy."""

from __future__ import annotations

import importlib
import shutil
from collections.abc import Generator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import numpy as np
import pytest

from acausal.fmu.archive import ENDING, PLATFORMS
from tests.support.exported_c import compile_c, need_compiler


def need_fmpy() -> Any:
    """The package fmpy, or the test is skipped; so it is without a compiler."""
    need_compiler()
    fmpy = pytest.importorskip("fmpy", reason="fmpy is not installed")
    importlib.import_module("fmpy.validation")
    return fmpy


def compiled_fmu(folder: Path, name: str, description: str) -> Path:
    """An FMU in a folder, of the source ``name.c`` beside this file, with a description."""
    headers = Path(need_fmpy().__file__).parent / "c-code"
    library, path = folder / f"{name}{ENDING}", folder / f"{name}.fmu"
    compile_c([Path(__file__).with_name(f"{name}.c")], library, "-isystem", str(headers))
    with ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", description)
        archive.write(library, f"binaries/{PLATFORMS[-1]}/{name}{ENDING}")
    return path


class Unpacked:
    """An FMU in a folder.

    Attributes:
        path: of the FMU. fmi: "2.0" or "3.0". references: value references by name. description: as fmpy reads it.
    """

    def __init__(self, path: Path, fmi: str) -> None:
        self.fmpy = need_fmpy()
        self.path, self.fmi, self.folder = path, fmi, path.with_suffix("")
        self.fmpy.extract(str(path), str(self.folder))
        self.description = self.fmpy.read_model_description(str(self.folder))
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}

    def of(self, names: Sequence[str]) -> list[int]:
        """Value references of some variables."""
        return [self.references[n] for n in names]

    @contextmanager
    def instance(
        self, kind: str, messages: list[str] | None = None, **start: float
    ) -> Generator[Instance]:
        """An instance after its initialization.

        Arguments:
            kind: "ModelExchange" or "CoSimulation". messages: where log messages are put.
            start: values that are set before.
        """

        def log(*arguments: Any) -> None:
            if messages is not None:
                messages.append(arguments[-1].decode() if self.fmi == "3.0" else "")

        logger = log if self.fmi == "3.0" else None
        made = self.fmpy.instantiate_fmu(self.folder, self.description, kind, logger=logger)
        if self.fmi == "2.0":
            made.setupExperiment(startTime=0.0)
        Instance(self, made).set([*start], [*start.values()])
        made.enterInitializationMode()
        made.exitInitializationMode()
        try:
            yield Instance(self, made)
        finally:
            made.terminate()
            made.freeInstance()

    def remove(self) -> None:
        """Remove the folder."""
        shutil.rmtree(self.folder)


class Instance:
    """A running FMU; variables by name."""

    def __init__(self, of: Unpacked, fmu: Any) -> None:
        self.of, self.fmu = of, fmu

    def get(self, names: Sequence[str], size: int | None = None) -> np.ndarray:
        """Values of some variables.

        Arguments:
            size: how many numbers they have together, where they are arrays.
        """
        if self.of.fmi == "2.0":
            return np.array(self.fmu.getReal(self.of.of(names)))
        return np.array(self.fmu.getFloat64(self.of.of(names), nValues=size or len(names)))

    def set(self, names: Sequence[str], values: Sequence[float] | np.ndarray) -> None:
        """Set some variables."""
        put = self.fmu.setReal if self.of.fmi == "2.0" else self.fmu.setFloat64
        put(self.of.of(names), list(values))

    def update(self) -> Any:
        """Update discrete states, in event mode; what fmpy gives."""
        made = self.fmu
        return made.newDiscreteStates() if self.of.fmi == "2.0" else made.updateDiscreteStates()

    def jacobian(
        self, unknowns: Sequence[str], knowns: Sequence[str], rows: int, columns: int
    ) -> np.ndarray:
        """Column by column, by directional derivatives."""
        to, by = self.of.of(unknowns), self.of.of(knowns)
        more = () if self.of.fmi == "2.0" else (rows,)
        return np.stack(
            [
                self.fmu.getDirectionalDerivative(to, by, list(seed), *more)
                for seed in np.eye(columns)
            ],
            axis=1,
        )

    def adjoint(
        self, unknowns: Sequence[str], knowns: Sequence[str], rows: int, columns: int
    ) -> np.ndarray:
        """Row by row, by adjoint derivatives."""
        to, by = self.of.of(unknowns), self.of.of(knowns)
        return np.stack(
            [self.fmu.getAdjointDerivative(to, by, list(s), columns) for s in np.eye(rows)]
        )

    def steps(self, h: float, n: int) -> None:
        """Some communication steps from time 0."""
        for k in range(n):
            self.fmu.doStep(k * h, h)
