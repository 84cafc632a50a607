"""Derivatives of what an FMU computes, column by column: by difference quotients where the FMU has no others."""

from __future__ import annotations

import ctypes as C
import math
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, suppress
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal._jax import register_host
from acausal.fmu.library import DiscardError

STEP = 1e-7
"""Of a difference quotient, relative to the nominal value or the value, whichever is larger."""

SECOND_STEP = 1e-4
"""The same for the derivatives of derivatives, which are less exact than values."""

Numbers = np.ndarray[Any, np.dtype[np.float64]]

Function = Callable[[int, int], int]
"""A function of two addresses, which returns how far an event had to be shifted."""

Look = Callable[[Numbers, Numbers, Numbers], None]
"""Looks at some arguments, and what a function gives for them and for others close to them."""

Fast = Callable[[Numbers, list[int], Numbers], dict[int, int]]
"""Fills rows of some columns of a Jacobian without difference quotients; by column, how many, from the first."""


def no_columns(given: Numbers, wanted: list[int], matrix: Numbers) -> dict[int, int]:
    """Where difference quotients are all that there is."""
    return {}


@dataclass(frozen=True)
class Differentiated:
    """A function with its Jacobian and its second derivatives.

    These two take, before the arguments, which of them derivatives are wanted for: the other columns are zero.

    Attributes:
        function: of ``width`` numbers, which gives ``height``. scales: sizes of arguments.
        columns: arguments that it depends on. lock: held while the FMU is called. fast: knows some columns.
        look: at what quotients are made of.
        central: whether quotients are central: an indicator of events may jump where it changes its sign, and whether
            that is before or behind the present values is chance. The instant's derivative is the ratio of two.
    """

    function: Function
    width: int
    height: int
    columns: Sequence[int]
    scales: Numbers
    lock: AbstractContextManager[Any]
    fast: Fast = no_columns
    central: bool = False
    look: Look | None = None

    def register(self) -> int:
        """The number of the function; the next two are those of its first and second derivatives."""
        number = register_host(self.function)
        register_host(self.jacobian)
        register_host(self.second)
        return number

    def jacobian(self, at: int, into: int) -> None:
        """The Jacobian, from address to address."""
        height, width = self.height, self.width
        (marks, given), matrix = _array(at, 2, width).copy(), _array(into, height, width)
        wanted = [column for column in self.columns if marks[column]]
        matrix[:] = 0.0
        with self.lock:
            first = np.zeros(height)
            shifts = self.function(given.ctypes.data, first.ctypes.data)
            done = self.fast(given, wanted, matrix)
            for column in wanted:
                rows = slice(done.get(column, 0), height)
                if rows.start < height:
                    matrix[rows, column] = self.quotient(given, first, column, shifts)[rows]

    def second(self, at: int, into: int) -> None:
        """The derivatives of the Jacobian, from address to address."""
        height, width = self.height, self.width
        both, found = _array(at, 2, width).copy(), _array(into, height, width, width)
        given, place = both[1], both.ctypes.data
        first, there = np.zeros((height, width)), np.zeros((height, width))
        found[:] = 0.0
        self.jacobian(place, first.ctypes.data)
        for column in self.columns:
            value = given[column]
            given[column] += SECOND_STEP * max(self.scales[column], abs(value))
            self.jacobian(place, there.ctypes.data)
            found[:, :, column] = (there - first) / (given[column] - value)
            given[column] = value

    def quotient(self, given: Numbers, first: Numbers, column: int, shifts: int) -> Numbers:
        """The derivative by one argument: to the side on which an event need not be shifted farther."""
        value, step = given[column], STEP * max(self.scales[column], abs(given[column]))
        found: list[tuple[int, float, Numbers]] = []
        for h in (step, -step):
            given[column] = value + h
            with suppress(DiscardError):
                there = np.zeros(len(first))
                shifted = self.function(given.ctypes.data, there.ctypes.data)
                found.append((shifted, given[column], there))
            if found and found[0][0] <= shifts and not self.central:
                break
        given[column] = value
        if not found:
            return np.full(len(first), np.nan)
        if len(found) == 2 and self.central:
            (_, high, above), (_, low, below) = found
            return (above - below) / (high - low)
        _, place, there = min(found, key=lambda f: f[0])
        if self.look is not None:
            self.look(given, first, there)
        return (there - first) / (place - value)


def _array(address: int, *shape: int) -> Numbers:
    """The numbers at an address."""
    return np.ctypeslib.as_array((C.c_double * math.prod(shape)).from_address(address)).reshape(
        shape
    )
