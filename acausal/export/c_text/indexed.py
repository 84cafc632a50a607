"""Rules: reading and writing elements at computed places."""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce
from typing import Any

import numpy as np

from acausal.errors import ExportError
from acausal.export.c_text.arrays import CArray, Index, linear, stored
from acausal.export.c_text.expressions import (
    Apply,
    Expr,
    Number,
    Read,
    add,
    integer,
    select,
    variable,
)
from acausal.export.c_text.lowering import Lowering
from acausal.export.c_text.statements import Assign, Call, Choose
from acausal.export.traced import TracedOperation


def _clamped(low: Lowering, place: Expr, highest: int) -> Expr:
    """A place within 0 ... highest."""
    if isinstance(place, Number):
        return integer(min(max(int(place.value), 0), highest))
    if highest == 0:
        return integer(0)
    low.memory.prelude.add("within")
    return Apply("within", (place, integer(highest)), "int")


def _inside(place: Expr, highest: int) -> Expr | bool:
    """Whether a place is within 0 ... highest."""
    if isinstance(place, Number):
        return 0 <= int(place.value) <= highest
    above = Apply(">=", (place, integer(0)), "bool")
    return Apply("&&", (above, Apply("<=", (place, integer(highest)), "bool")), "bool")


def _all(conditions: list[Expr | bool]) -> Expr | bool:
    """Whether all hold; True or False where that is known."""
    if False in conditions:
        return False
    unknown = [c for c in conditions if not isinstance(c, bool)]
    return reduce(lambda a, b: Apply("&&", (a, b), "bool"), unknown) if unknown else True


def _mode(operation: TracedOperation) -> str:
    name = str(operation.params.get("mode")).lower()
    if "clip" in name:
        return "clip"
    return "fill" if "fill" in name else "promise"


def _gather(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    operand, indices = args
    numbers, sizes = operation.params["dimension_numbers"], operation.params["slice_sizes"]
    shape, kind, mode = operation.outputs[0].shape, operation.outputs[0].kind, _mode(operation)
    gone = (*numbers.collapsed_slice_dims, *numbers.operand_batching_dims)
    kept = [d for d in range(len(operand.shape)) if d not in gone]
    batch_axes = [d for d in range(len(shape)) if d not in numbers.offset_dims]

    def at(index: Index) -> Expr:
        batch = tuple(index[d] for d in batch_axes)
        place: list[Expr] = [integer(0)] * len(operand.shape)
        conditions: list[Expr | bool] = []
        for k, d in enumerate(numbers.start_index_map):
            start, highest = indices.at((*batch, integer(k))), operand.shape[d] - sizes[d]
            if mode == "fill":
                conditions.append(_inside(start, highest))
            place[d] = _clamped(low, start, highest) if mode != "promise" else start
        for d, b in zip(
            numbers.operand_batching_dims, numbers.start_indices_batching_dims, strict=True
        ):
            place[d] = batch[b]
        for d, offset in zip(kept, numbers.offset_dims, strict=True):
            place[d] = add(place[d], index[offset])
        value = operand.at(tuple(place))
        if indices.stored is not None and indices.stored.table is not None:
            return value  # a table's entries are known to lie inside
        holds = _all(conditions)
        fill = Number(float("nan"), "real") if kind == "real" else Number(0, kind)
        if isinstance(holds, bool):
            return value if holds else fill
        return select(holds, value, fill)

    return [CArray(shape, kind, at, 1 + indices.cost)]


def _scatter(op: str, function: str | None = None) -> Any:
    def rule(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
        operand, indices, updates = args
        numbers, mode = operation.params["dimension_numbers"], _mode(operation)
        gone = (*numbers.inserted_window_dims, *numbers.operand_batching_dims)
        kept = [d for d in range(len(operand.shape)) if d not in gone]
        window = {
            d: updates.shape[w] for d, w in zip(kept, numbers.update_window_dims, strict=True)
        }
        batch_axes = [d for d in range(len(updates.shape)) if d not in numbers.update_window_dims]
        buffer = low.new(operand.shape, operand.kind)
        low.store(operand, buffer)
        for index in low.over(updates.shape):
            batch = tuple(index[d] for d in batch_axes)
            place: list[Expr] = [integer(0)] * len(operand.shape)
            conditions: list[Expr | bool] = []
            for k, d in enumerate(numbers.scatter_dims_to_operand_dims):
                start, highest = (
                    indices.at((*batch, integer(k))),
                    operand.shape[d] - window.get(d, 1),
                )
                if mode == "clip":
                    start = _clamped(low, start, highest)
                elif mode == "fill":
                    conditions.append(_inside(start, highest))
                place[d] = start
            for d, b in zip(
                numbers.operand_batching_dims, numbers.scatter_indices_batching_dims, strict=True
            ):
                place[d] = batch[b]
            for d, w in zip(kept, numbers.update_window_dims, strict=True):
                place[d] = add(place[d], index[w])
            target, value = linear(tuple(place), operand.shape), updates.at(index)
            if function:
                low.memory.prelude.add(function)
                value = Apply(
                    function, (stored(buffer, operand.shape).at(tuple(place)), value), operand.kind
                )
            holds = _all(conditions)
            if isinstance(holds, bool):
                if holds:
                    low.write(buffer, target, value, op=op)
                continue
            choose = Choose(holds)
            low.emit(choose)
            with low.within(choose.yes):
                low.write(buffer, target, value, op=op)
        return [stored(buffer, operand.shape)]

    return rule


def _starts(
    low: Lowering, args: list[CArray], shape: tuple[int, ...], sizes: tuple[int, ...]
) -> list[Expr]:
    found: list[Expr] = []
    for array, length, size in zip(args, shape, sizes, strict=True):
        start = array.at(())
        if length == size:
            found.append(integer(0))
            continue
        if not isinstance(start, Number):
            # JAX counts from the end where an index is negative before it comes here
            start = _clamped(low, start, length - size)
            name = low.memory.name("k")
            low.emit(Assign(Read(name, None, "int"), start, declares=True))
            start = variable(name)
        found.append(_clamped(low, start, length - size) if isinstance(start, Number) else start)
    return found


def _dynamic_slice(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    source, *places = args
    sizes = operation.outputs[0].shape
    starts = _starts(low, places, source.shape, sizes)

    def at(index: Index) -> Expr:
        return source.at(tuple(add(s, i) for s, i in zip(starts, index, strict=True)))

    return [CArray(sizes, source.kind, at, source.cost)]


def _dynamic_update_slice(
    low: Lowering, operation: TracedOperation, args: list[CArray]
) -> list[CArray]:
    operand, update, *places = args
    starts = _starts(low, places, operand.shape, update.shape)
    buffer = low.new(operand.shape, operand.kind)
    low.store(operand, buffer)
    for index in low.over(update.shape):
        place = tuple(add(s, i) for s, i in zip(starts, index, strict=True))
        low.write(buffer, linear(place, operand.shape), update.at(index))
    return [stored(buffer, operand.shape)]


def _sort(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    """By insertion, stable; NaN last."""
    axis, keys = int(operation.params["dimension"]), int(operation.params["num_keys"])
    shape = args[0].shape
    buffers = [low.new(shape, a.kind) for a in args]
    for array, buffer in zip(args, buffers, strict=True):
        low.store(array, buffer)
    if keys != 1 or int(np.prod(shape, dtype=np.int64)) != shape[axis] or len(args) > 2:
        raise ExportError("C: 'sort' of several keys or rows has no C; sort one vector.")
    names = ["sort_real", "sort_with"]
    if args[0].kind != "real" or (len(args) == 2 and args[1].kind != "int"):
        raise ExportError("C: 'sort' of whole numbers has no C; sort real numbers.")
    name = names[len(args) - 1]
    low.memory.prelude.add(name)
    low.emit(Call(name, (*(b.name for b in buffers), integer(shape[axis]))))
    return [stored(b, shape) for b in buffers]


RULES: Mapping[str, Any] = {
    "gather": _gather,
    "scatter": _scatter("="),
    "scatter-add": _scatter("+="),
    "scatter_add": _scatter("+="),
    "scatter-mul": _scatter("*="),
    "scatter_mul": _scatter("*="),
    "scatter-max": _scatter("=", "maximum"),
    "scatter-min": _scatter("=", "minimum"),
    "dynamic_slice": _dynamic_slice,
    "dynamic_update_slice": _dynamic_update_slice,
    "sort": _sort,
}

READ_OFTEN = frozenset({"gather", "sort"})
