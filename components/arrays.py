"""Functions that expressions in files may call to write vectors and matrices, as in Modelica."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

MAX_SIZE = 10_000


def fill(value: Any, *sizes: int) -> Any:
    """An array of one value."""
    if not sizes or any(s < 0 or s != int(s) for s in sizes) or math.prod(sizes) > MAX_SIZE:
        raise ValueError(f"fill needs sizes with a product of at most {MAX_SIZE}")
    for size in reversed(sizes):
        value = [value] * int(size)
    return value


def transpose(matrix: list[list[Any]]) -> list[list[Any]]:
    """Rows as columns."""
    return [list(row) for row in zip(*matrix, strict=True)]


def identity(n: int) -> list[list[float]]:
    """The identity matrix."""
    return (np.array(fill(0.0, n, n)) + np.eye(int(n))).tolist()


def linspace(first: float, last: float, n: int) -> list[float]:
    """Equally spaced numbers."""
    return np.linspace(first, last, len(fill(0.0, n))).tolist()


def size(array: Any, axis: float = 1) -> int:
    """The length of an array along an axis, counted from 1."""
    shape = np.shape(array)
    if axis not in range(1, len(shape) + 1):
        raise ValueError(f"size of axis {axis:g} of an array of {len(shape)} dimensions")
    return shape[int(axis) - 1]


ARRAYS: dict[str, Callable[..., Any]] = {
    "fill": fill,
    "zeros": lambda *sizes: fill(0, *sizes),
    "ones": lambda *sizes: fill(1, *sizes),
    "transpose": transpose,
    "identity": identity,
    "linspace": linspace,
    "size": size,
    "vector": lambda array: np.ravel(array).tolist(),
}
"""Name -> function."""
