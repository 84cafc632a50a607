"""The same in C, written by hand and compiled for this machine, on one core: `adjoint.c` takes the gradient,
`forward.c` simulates.
"""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

import numpy as np

from benchmarks.qvm.task import VEHICLE, Gradient, Task, flat, layers
from examples.qvm.record import SAMPLE_TIME

FLAGS = ("-O3", "-march=native", "-shared", "-fPIC")
HERE = Path(__file__).parent


def compiled(*sources: Path) -> ctypes.CDLL:
    """Files of C, compiled to one library.

    Raises:
        ImportError: without gcc.
    """
    if shutil.which("gcc") is None:
        raise ImportError("there is no gcc")
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder, "library.so")
        subprocess.run(["gcc", *FLAGS, "-o", target, *sources, "-lm"], check=True)
        return ctypes.CDLL(str(target))


@cache
def library(name: str) -> ctypes.CDLL:
    """A file of this folder, compiled."""
    return compiled(HERE / name)


def gradient(task: Task) -> Callable[[], Gradient]:
    function = library("adjoint.c").gradient
    function.restype = ctypes.c_double
    vehicle, weights = _constants(task)
    data = [np.ascontiguousarray(a) for a in (task.x0, task.u0, task.u1, task.y, task.sigma)]
    count, n = task.u0.shape

    def run() -> Gradient:
        by = np.empty_like(weights)
        loss = function(
            *pointers(vehicle, weights),
            count,
            n,
            ctypes.c_double(SAMPLE_TIME),
            *pointers(*data, by),
        )
        return loss, by

    return run


def forward(task: Task) -> Callable[[], np.ndarray]:
    """Simulates the first sequence of a task; gives the states at its end."""
    function = library("forward.c").forward_steps
    vehicle, weights = _constants(task)
    u0, u1 = (np.ascontiguousarray(u[0]) for u in (task.u0, task.u1))

    def run() -> np.ndarray:
        x = np.array(task.x0[0])
        function(
            *pointers(vehicle, weights), len(u0), ctypes.c_double(SAMPLE_TIME), *pointers(x, u0, u1)
        )
        return x

    return run


def pointers(*arrays: np.ndarray) -> Sequence[ctypes.c_void_p]:
    """Arrays as C takes them."""
    return [a.ctypes.data_as(ctypes.c_void_p) for a in arrays]


def _constants(task: Task) -> tuple[np.ndarray, np.ndarray]:
    """Physical parameters and weights."""
    return np.array(list(VEHICLE.values())), flat(layers(task.params))
