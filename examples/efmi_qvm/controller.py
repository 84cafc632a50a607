"""The exported C as a controller has it: how large it is, and what it computes."""

from __future__ import annotations

import ctypes
import re
import shutil
import subprocess
import time
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

DRIVER = """
#include "vehicle.h"
int memory(void) { return (int)sizeof(vehicle); }
int drive(vehicle *m, int n, double h, const double *u, double *y) {
    int failed = 0;
    vehicle_init(m);
    for (int k = 0; k < n; k++) {
        m->u[0] = u[k];
        failed |= vehicle_outputs(m);
        for (int i = 0; i < VEHICLE_OUTPUTS; i++) *y++ = m->y[i];
        failed |= vehicle_step(m, h, &u[k + 1 < n ? k + 1 : k]);
    }
    return failed;
}
"""
"""Reads inputs, writes outputs, takes a step: again and again."""


def compiler() -> str | None:
    """The C compiler; None, with a sentence, where there is none."""
    found = shutil.which("gcc") or shutil.which("cc")
    if found is None:
        print("There is no C compiler here: the C is written, but neither measured nor run.")
    return found


class Controller:
    """The exported files.

    Attributes:
        header, source: paths. command: the compiler, or None.
    """

    def __init__(self, header: Path, source: Path, command: str | None) -> None:
        self.header, self.source, self.command = header, source, command

    def sizes(self) -> dict[str, int]:
        """Bytes of text, and of machine code where there is a compiler.

        ``source``: header and source. ``source_without_values``: less the table of parameters' values.
        ``source_of_steps``: of that, what a step runs: the equations and the method, without names and units.
        ``machine_code``: without that table, too.
        """
        header, source = (p.read_text("utf-8") for p in (self.header, self.source))
        table = re.search(r"static const real start_p\[\] = \{.*?\n\};\n", source, re.DOTALL)
        values = table.group() if table else ""
        run = "".join(_function(source, name) for name in ("rates", "recalibrate", "vehicle_step"))
        found = {
            "source": len((header + source).encode()),
            "source_without_values": len((header + source.replace(values, "")).encode()),
            "source_of_steps": len(run.encode()),
            "parameters": values.count("R("),
        }
        if self.command is not None:
            found |= {"machine_code": self._machine_code(), "memory": self._library.memory()}
        return found

    def drive(self, inputs: np.ndarray, step: float) -> np.ndarray:
        """Outputs at the start of every step, shape (steps, outputs), for one input.

        Raises:
            RuntimeError: if a step fails.
        """
        u = np.ascontiguousarray(inputs, float)
        y = np.empty((len(u), 2))
        vehicle = ctypes.create_string_buffer(self._library.memory())
        arrays = [a.ctypes.data_as(ctypes.c_void_p) for a in (u, y)]
        if self._library.drive(vehicle, len(u), ctypes.c_double(step), *arrays):
            raise RuntimeError("the exported vehicle failed; its outputs are not finite")
        return y

    def microseconds(self, inputs: np.ndarray, step: float) -> float:
        """Of processor time for a step and its outputs; the fastest of a few drives."""
        spent: list[float] = []
        for _ in range(5):
            begin = time.process_time()
            self.drive(inputs, step)
            spent.append(time.process_time() - begin)
        return 1e6 * min(spent) / len(inputs)

    def _machine_code(self) -> int:
        """Bytes of instructions, by ``size``: sections of text, without tables of constants."""
        with TemporaryDirectory() as folder:
            target = Path(folder) / "vehicle.o"
            self._compile("-Os", "-c", str(self.source), "-o", str(target))
            done = subprocess.run(
                ["size", "-A", str(target)], capture_output=True, text=True, check=True
            )
        return sum(
            int(size) for size in re.findall(r"^\.text\S*\s+(\d+)", done.stdout, re.MULTILINE)
        )

    @cached_property
    def _library(self) -> ctypes.CDLL:
        with TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "driver.c").write_text(DRIVER, encoding="utf-8")
            target, sources = folder / "vehicle.so", (folder / "driver.c", self.source)
            self._compile("-O2", "-shared", "-fPIC", *map(str, sources), "-o", str(target), "-lm")
            return ctypes.CDLL(str(target))

    def _compile(self, *arguments: str) -> None:
        assert self.command is not None
        strict = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror"]
        subprocess.run([self.command, *strict, f"-I{self.header.parent}", *arguments], check=True)


def _function(source: str, name: str) -> str:
    """The text of a function; "" where there is none."""
    found = re.search(
        rf"^[^\n;]*\b{name}\([^;{{]*\{{\n.*?\n\}}\n", source, re.DOTALL | re.MULTILINE
    )
    return found.group() if found else ""
