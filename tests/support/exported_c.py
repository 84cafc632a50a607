"""Exported C, compiled and run in this process."""

from __future__ import annotations

import ctypes
import importlib.util
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac

STRICT = ("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror")

COMPILER = shutil.which("cc") or shutil.which("gcc")

ACCESS = """
#include "NAME.h"
#include <stdlib.h>
NAME *make(void) { return calloc(1, sizeof(NAME)); }
NAME_real *time_of(NAME *m) { return &m->time; }
NAME_real *x_of(NAME *m) { return m->x; }
NAME_real *u_of(NAME *m) { return m->u; }
NAME_real *y_of(NAME *m) { return m->y; }
NAME_real *p_of(NAME *m) { return m->p; }
NAME_real *dx_of(NAME *m) { return m->dx; }
size_t size(void) { return sizeof(NAME); }
NAME_status one_step(NAME *m, double h, const NAME_real *u_end) { return NAME_step(m, (NAME_real)h, u_end); }
"""


def need_compiler() -> str:
    """The C compiler, or the test is skipped."""
    if COMPILER is None:
        pytest.skip("there is no C compiler")
    return COMPILER


def compiler_named(name: str) -> list[str]:
    """The command of "gcc" or "clang", which the package ziglang has, too; or the test is skipped."""
    found = shutil.which(name)
    if found:
        return [found]
    if name == "clang" and importlib.util.find_spec("ziglang"):
        return [sys.executable, "-m", "ziglang", "cc"]
    pytest.skip(f"there is no {name}")


def compile_c(sources: Sequence[Path], target: Path, *flags: str) -> None:
    """Compile a shared library, strictly."""
    command = [need_compiler(), *STRICT, "-O1", "-shared", "-fPIC", *flags, "-o", str(target)]
    done = subprocess.run([*command, *map(str, sources), "-lm"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[:3000]


class ExportedC:
    """A model that is exported, compiled and initialized; its arrays are views of the struct.

    Attributes:
        x, u, y, p, dx, time: fields of the struct. library: the compiled functions. header: its text.
    """

    def __init__(self, system: ac.System, folder: Path, **options: Any) -> None:
        header, source = ac.export.c(system, folder, **options)
        self.name, self.files = header.stem, (header, source)
        access = folder / "access.c"
        access.write_text(ACCESS.replace("NAME", self.name))
        compile_c([source, access], folder / "model.so", f"-I{folder}")
        self.library = ctypes.CDLL(str(folder / "model.so"))
        self.library.make.restype = ctypes.c_void_p
        self.library.one_step.argtypes = [ctypes.c_void_p, ctypes.c_double, ctypes.c_void_p]
        self.number = ctypes.c_float if options.get("dtype") is np.float32 else ctypes.c_double
        self.m = ctypes.c_void_p(self.library.make())
        self.call("init")
        n = len(system.states)
        self.time, self.x, self.dx = self._view("time", 1), self._view("x", n), self._view("dx", n)
        self.u = self._view("u", len(system.inputs))
        self.y = self._view("y", len(options.get("outputs", system.states)))
        self.header = header.read_text()
        self.p = self._view("p", int(self.header.split("_PARAMETERS = ")[1].split()[0].strip(",")))

    def _view(self, field: str, size: int) -> np.ndarray:
        function = getattr(self.library, f"{field}_of")
        function.restype, function.argtypes = ctypes.POINTER(self.number), [ctypes.c_void_p]
        return np.ctypeslib.as_array(function(self.m), shape=(max(size, 1),))[:size]

    def call(self, function: str, *arguments: Any) -> int:
        """A function of the model; gives its status."""
        return getattr(self.library, f"{self.name}_{function}")(self.m, *arguments)

    def step(self, h: float, u_end: np.ndarray | None = None) -> int:
        """One step, with the inputs held, or on their way to some values."""
        if u_end is None or not u_end.size:
            return self.library.one_step(self.m, h, None)
        end = np.ascontiguousarray(u_end, dtype=self.number)
        return self.library.one_step(self.m, h, end.ctypes.data_as(ctypes.c_void_p))

    def derivatives(self) -> np.ndarray:
        """Derivatives of the states."""
        assert self.call("derivatives") == 0
        return self.dx.copy()

    def outputs(self) -> np.ndarray:
        """The outputs."""
        assert self.call("outputs") == 0
        return self.y.copy()

    def directional(
        self, t: float, x: np.ndarray, u: np.ndarray, p: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Directional derivatives of the states' derivatives and of the outputs."""
        of_dx, of_y = np.zeros(max(len(self.x), 1)), np.zeros(max(len(self.y), 1))
        seeds = [np.ascontiguousarray(a, dtype=float) for a in (x, u, p)]
        pointers = [a.ctypes.data_as(ctypes.c_void_p) for a in (*seeds, of_dx, of_y)]
        assert self.call("directional", ctypes.c_double(t), *pointers) == 0
        return of_dx[: len(self.x)], of_y[: len(self.y)]
