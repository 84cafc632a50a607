"""The same in C, with the discrete adjoint written by hand: `adjoint.c`, compiled for this machine, on one core."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np

from benchmarks.qvm.task import VEHICLE, Gradient, Task, flat, layers
from examples.qvm.record import SAMPLE_TIME

FLAGS = ("-O3", "-march=native", "-shared", "-fPIC")


@cache
def library() -> ctypes.CDLL:
    """The compiled file.

    Raises:
        ImportError: without gcc.
    """
    if shutil.which("gcc") is None:
        raise ImportError("there is no gcc")
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder, "adjoint.so")
        source = Path(__file__).with_name("adjoint.c")
        subprocess.run(["gcc", *FLAGS, "-o", target, source, "-lm"], check=True)
        loaded = ctypes.CDLL(str(target))
    loaded.gradient.restype = ctypes.c_double
    return loaded


def gradient(task: Task) -> Callable[[], Gradient]:
    function = library().gradient
    vehicle, weights = np.array(list(VEHICLE.values())), flat(layers(task.params))
    data = [np.ascontiguousarray(a) for a in (task.x0, task.u0, task.u1, task.y, task.sigma)]
    count, n = task.u0.shape

    def run() -> Gradient:
        by = np.empty_like(weights)
        loss = function(
            *(_pointer(a) for a in (vehicle, weights)),
            count,
            n,
            ctypes.c_double(SAMPLE_TIME),
            *(_pointer(a) for a in (*data, by)),
        )
        return loss, by

    return run


def _pointer(array: np.ndarray) -> ctypes.c_void_p:
    return array.ctypes.data_as(ctypes.c_void_p)
