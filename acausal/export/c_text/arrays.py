"""Arrays that are not stored: how to compute one element from its index.

An operation on elements becomes part of the expression that reads its result. Only what is read more than once is
stored, by `Lowering.keep`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from acausal.export.c_text.expressions import (
    Expr,
    Number,
    Read,
    add,
    convert,
    integer,
    quotient,
    remainder,
    times,
)
from acausal.export.c_text.statements import Buffer
from acausal.export.traced import kind_of

Index: TypeAlias = tuple[Expr, ...]


@dataclass(frozen=True, eq=False)
class CArray:
    """An array, element by element.

    Attributes:
        shape: its lengths. kind: "real", "int" or "bool".
        at: the expression of an element, from its index.
        cost: operations that one element takes; 0 where it is only read.
        stored: the buffer that holds it contiguously from ``offset`` on, if one does.
        parts: (axis, [(first index, part)]) of arrays joined along an axis; their elements have no one expression.
    """

    shape: tuple[int, ...]
    kind: str
    at: Callable[[Index], Expr]
    cost: int = 0
    stored: Buffer | None = None
    offset: int = 0
    parts: tuple[int, tuple[tuple[int, CArray], ...]] | None = None

    @property
    def size(self) -> int:
        """The number of its elements."""
        return int(np.prod(self.shape, dtype=np.int64))


def linear(index: Index, shape: Sequence[int]) -> Expr:
    """The place of an element in an array that is stored row by row."""
    place: Expr = integer(0)
    for i, length in zip(index, shape, strict=True):
        place = add(times(place, length), i)
    return place


def unravelled(place: Expr, shape: Sequence[int]) -> Index:
    """The index of the element at a place."""
    found: list[Expr] = []
    below = int(np.prod(shape, dtype=np.int64))
    for position, length in enumerate(shape):
        below //= max(length, 1)
        part = quotient(place, below)
        found.append(remainder(part, length) if position and length > 0 else part)
        if length == 1:
            found[-1] = integer(0)
    return tuple(found)


def stored(buffer: Buffer, shape: tuple[int, ...], offset: int = 0) -> CArray:
    """An array that lies in a buffer."""
    if buffer.size is None:
        return CArray(shape, buffer.kind, lambda i: Read(buffer.name, None, buffer.kind))

    def at(index: Index) -> Expr:
        return Read(buffer.name, add(linear(index, shape), integer(offset)), buffer.kind)

    return CArray(shape, buffer.kind, at, 0, buffer, offset)


def uniform(value: Expr, shape: tuple[int, ...]) -> CArray:
    """An array of equal elements."""
    return CArray(shape, value.kind, lambda i: value)


def constant(array: np.ndarray, table: Callable[[np.ndarray], Buffer]) -> CArray:
    """A known array: one number, a formula of the index, or ``table``, a constant buffer that holds these values."""
    kind = kind_of(array.dtype)
    flat = array.reshape(-1)
    if flat.size and (flat == flat[0]).all():
        return uniform(_number(flat[0], kind), array.shape)
    if flat.size and np.isnan(flat.astype(float)).all():
        return uniform(_number(flat[0], kind), array.shape)
    if kind == "int" and array.ndim and flat.size > 1:
        flat = flat.astype(np.int64)
        stride = int(flat[1] - flat[0])
        if (np.diff(flat) == stride).all():
            first = int(flat[0])
            return CArray(
                array.shape,
                "int",
                lambda i: add(times(linear(i, array.shape), stride), integer(first)),
            )

    def at(index: Index) -> Expr:
        place = linear(index, array.shape)
        if isinstance(place, Number):
            return _number(array.reshape(-1)[int(place.value)], kind)
        return lying.at(index)

    lying = stored(table(array), array.shape) if flat.size else uniform(integer(0), array.shape)
    return CArray(array.shape, kind, at, 0, lying.stored)


def _number(value: float, kind: str) -> Number:
    return Number({"real": float, "int": int, "bool": bool}[kind](value), kind)


def viewed(source: CArray, shape: Sequence[int], index: Callable[[Index], Index]) -> CArray:
    """The same elements under other indices."""
    return CArray(tuple(shape), source.kind, lambda i: source.at(index(i)), source.cost)


def reshaped(source: CArray, shape: tuple[int, ...]) -> CArray:
    """The same elements, row by row, in another shape."""
    if source.stored is not None and source.stored.table is None:
        return stored(source.stored, shape, source.offset)
    longer = [n for n in source.shape if n != 1]
    if longer == [n for n in shape if n != 1]:  # only lengths of one come or go

        def moved(i: Index) -> Index:
            rest = iter([e for e, n in zip(i, shape, strict=True) if n != 1])
            return tuple(next(rest) if n != 1 else integer(0) for n in source.shape)

        return viewed(source, shape, moved)
    return viewed(source, shape, lambda i: unravelled(linear(i, shape), source.shape))


def converted(source: CArray, kind: str) -> CArray:
    """The same numbers as another kind."""
    if source.kind == kind:
        return source
    return CArray(source.shape, kind, lambda i: convert(source.at(i), kind), source.cost)
