"""Rules: sums, products and extremes of arrays, products of matrices, and their factors."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from acausal.errors import ExportError
from acausal.export.c_text.arrays import CArray, Index, linear, stored, uniform
from acausal.export.c_text.expressions import (
    Apply,
    Expr,
    Number,
    Read,
    add,
    convert,
    integer,
    times,
)
from acausal.export.c_text.lowering import Lowering
from acausal.export.c_text.statements import Assign, Buffer, Call, Choose, Declare
from acausal.export.traced import TracedOperation

Combine = Callable[[Expr, Expr], Expr]


def operator(op: str, kind: str | None = None) -> Combine:
    """An operator of two numbers; its result is of a kind, by default that of the first."""
    return lambda a, b: Apply(op, (a, b), kind or a.kind)


def _extreme(name: str) -> Callable[[Lowering, str], Combine]:
    def of(low: Lowering, kind: str) -> Combine:
        function = name if kind == "real" else f"{name}_int"
        low.memory.prelude.add(function)
        return lambda a, b: Apply(function, (a, b), kind)

    return of


_COMBINE: Mapping[str, tuple[Callable[[Lowering, str], Combine], float]] = {
    "reduce_sum": (lambda low, kind: operator("+"), 0),
    "reduce_prod": (lambda low, kind: operator("*"), 1),
    "reduce_max": (_extreme("maximum"), -np.inf),
    "reduce_min": (_extreme("minimum"), np.inf),
    "reduce_and": (lambda low, kind: operator("&&", "bool"), 1),
    "reduce_or": (lambda low, kind: operator("||", "bool"), 0),
    "reduce_xor": (lambda low, kind: operator("!=", "bool"), 0),
}


def _first(value: float, kind: str) -> Number:
    if kind == "real":
        return Number(float(value), kind)
    if np.isinf(value):
        return integer(-(2**31 - 1) if value < 0 else 2**31 - 1)
    return Number(int(value), kind)


def _reduce(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    (source,) = args
    axes = tuple(int(a) for a in operation.params["axes"])
    shape, kind = operation.outputs[0].shape, operation.outputs[0].kind
    make, start = _COMBINE[operation.name]
    combine = make(low, kind)
    if source.size == 0:
        return [uniform(_first(start, kind), shape)]
    rest = [a for a in range(len(source.shape)) if a not in axes]
    lengths = [source.shape[a] for a in axes]

    def element(outer: Index, inside: Index) -> Expr:
        index: list[Any] = [None] * len(source.shape)
        for a, i in zip(rest, outer, strict=True):
            index[a] = i
        for a, i in zip(axes, inside, strict=True):
            index[a] = i
        return source.at(tuple(index))

    if int(np.prod(lengths, dtype=np.int64)) == 1:  # nothing is combined
        zeros = tuple(integer(0) for _ in axes)
        return [CArray(shape, kind, lambda i: element(i, zeros), source.cost)]
    buffer = low.new(shape, kind)
    for outer in low.over(shape):
        total = _variable(low, _first(start, kind), kind)
        for inside in low.over(lengths):
            low.emit(Assign(total, combine(total, element(outer, inside))))
        low.write(buffer, linear(outer, shape), total)
    return [stored(buffer, shape)]


def _argument(op: str) -> Any:
    """The place of the largest or smallest element along an axis; of the first, or of the first NaN."""

    def rule(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
        (source,) = args
        (axis,) = operation.params["axes"]
        shape = operation.outputs[0].shape
        buffer = low.new(shape, "int")
        for outer in low.over(shape):

            def at(i: Expr, outer: Index = outer) -> Expr:
                return source.at((*outer[:axis], i, *outer[axis:]))

            best = _variable(low, at(integer(0)), source.kind)
            place = linear(outer, shape)
            low.write(buffer, place, integer(0))
            for (inside,) in low.over((source.shape[axis],)):
                value = at(inside)
                better: Expr = Apply(op, (value, best), "bool")
                if source.kind == "real":
                    nan = Apply(
                        "&&",
                        (Apply("!=", (value, value), "bool"), Apply("==", (best, best), "bool")),
                        "bool",
                    )
                    better = Apply("||", (better, nan), "bool")
                found = Choose(better)
                low.emit(found)
                with low.within(found.yes):
                    low.emit(Assign(best, value))
                    low.write(buffer, place, inside)
        return [stored(buffer, shape)]

    return rule


def _variable(low: Lowering, start: Expr, kind: str) -> Read:
    """A number that is declared with a value and changes later."""
    variable = Read(low.memory.name("s"), None, kind)
    low.emit(Declare(Buffer(variable.name, kind, None)))
    low.emit(Assign(variable, start))
    return variable


def _cumulative(reduce: str) -> Any:
    def rule(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
        (source,) = args
        axis, reverse = int(operation.params["axis"]), bool(operation.params["reverse"])
        shape, kind = source.shape, operation.outputs[0].kind
        combine_in, start = _COMBINE[reduce]
        combine = combine_in(low, kind)
        rest = (*shape[:axis], *shape[axis + 1 :])
        buffer = low.new(shape, kind)
        for outer in low.over(rest):
            total = _variable(low, _first(start, kind), kind)
            for (i,) in low.over((shape[axis],)):
                k = add(times(i, -1), integer(shape[axis] - 1)) if reverse else i
                index = (*outer[:axis], k, *outer[axis:])
                low.emit(Assign(total, combine(total, source.at(index))))
                low.write(buffer, linear(index, shape), total)
        return [stored(buffer, shape)]

    return rule


def _dot(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    """Products of matrices: the longest run of memory is read in the innermost loop."""
    a, b = args
    (ca, cb), (ba, bb) = operation.params["dimension_numbers"]
    shape, kind = operation.outputs[0].shape, operation.outputs[0].kind
    free_a = [k for k in range(len(a.shape)) if k not in (*ca, *ba)]
    free_b = [k for k in range(len(b.shape)) if k not in (*cb, *bb)]
    batch, lengths = len(ba), [a.shape[k] for k in ca]

    def term(out: Index, inside: Index) -> Expr:
        ia: list[Any] = [None] * len(a.shape)
        ib: list[Any] = [None] * len(b.shape)
        for k, (p, q) in enumerate(zip(ba, bb, strict=True)):
            ia[p] = ib[q] = out[k]
        for k, (p, q) in enumerate(zip(ca, cb, strict=True)):
            ia[p] = ib[q] = inside[k]
        for k, p in enumerate(free_a):
            ia[p] = out[batch + k]
        for k, p in enumerate(free_b):
            ib[p] = out[batch + len(free_a) + k]
        left, right = (convert(x.at(tuple(i)), kind) for x, i in ((a, ia), (b, ib)))
        return Apply("*", (left, right), kind)

    if int(np.prod(lengths, dtype=np.int64)) == 1:  # nothing is added up
        zeros = tuple(integer(0) for _ in lengths)
        return [CArray(shape, kind, lambda out: term(out, zeros), 1 + a.cost + b.cost)]
    buffer = low.new(shape, kind)
    if _rows_last(a, ca) and (_rows_last(b, cb) or not free_b):
        for out in low.over(shape):
            total = _variable(low, _first(0, kind), kind)
            for inside in low.over(lengths):
                low.emit(Assign(total, term(out, inside), op="+="))
            low.write(buffer, linear(out, shape), total)
        return [stored(buffer, shape)]
    low.store(uniform(_first(0, kind), shape), buffer)
    for inside in low.over(lengths):
        for out in low.over(shape):
            low.write(buffer, linear(out, shape), term(out, inside), op="+=")
    return [stored(buffer, shape)]


def _rows_last(array: CArray, contracted: tuple[int, ...]) -> bool:
    return bool(contracted) and contracted[-1] == len(array.shape) - 1


def _svd(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    """Singular values and both factors of one matrix, as the least steps of initialization need them."""
    (matrix,) = args
    if len(operation.outputs) != 3 or len(matrix.shape) != 2 or operation.params["full_matrices"]:
        raise ExportError(
            "C: 'svd' of several matrices, or without its factors, has no C; take it of one matrix."
        )
    rows, columns = matrix.shape
    values, left, right = buffers = [low.new(o.shape, o.kind) for o in operation.outputs]
    low.store(matrix, right if columns > rows else left)
    low.memory.prelude.add("svd")
    names = (values.name, left.name, right.name)
    low.emit(Call("svd", (*names, integer(rows), integer(columns))))
    return [stored(b, o.shape) for b, o in zip(buffers, operation.outputs, strict=True)]


RULES: Mapping[str, Any] = {
    **dict.fromkeys(_COMBINE, _reduce),
    "argmax": _argument(">"),
    "argmin": _argument("<"),
    "cumsum": _cumulative("reduce_sum"),
    "cumprod": _cumulative("reduce_prod"),
    "cummax": _cumulative("reduce_max"),
    "cummin": _cumulative("reduce_min"),
    "dot_general": _dot,
    "svd": _svd,
}

READ_OFTEN = frozenset({"dot_general", "argmax", "argmin"})
