"""Rules: loops and choices, whose bodies are blocks of their own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from jax.extend.core import ClosedJaxpr

from acausal._jax import scan_of
from acausal.export.c_text.arrays import CArray, Index, linear, stored
from acausal.export.c_text.expressions import Apply, Read, add, integer, reads, times, variable
from acausal.export.c_text.lowering import Lowering
from acausal.export.c_text.statements import BreakUnless, Buffer, Choose, Declare, For, Repeat
from acausal.export.traced import TracedOperation, TracedValue, traced_block


def _written(low: Lowering, closed: ClosedJaxpr, args: Sequence[CArray]) -> list[CArray]:
    """The results of a block within this one, for arguments that cost nothing to read."""
    inner = Lowering(low.rules, low.memory, low.statements)
    inner.depth = low.depth
    return inner.lower(traced_block(closed), args)


def _variables(low: Lowering, starts: Sequence[CArray]) -> list[Buffer]:
    """Variables with these values at first."""
    buffers: list[Buffer] = []
    for array in starts:
        buffer = _variable(low, array.shape, array.kind)
        low.store(array, buffer)
        buffers.append(buffer)
    return buffers


def _variable(low: Lowering, shape: tuple[int, ...], kind: str) -> Buffer:
    if shape:
        return low.new(shape, kind)
    buffer = Buffer(low.memory.name("c"), kind, None)
    low.emit(Declare(buffer))
    return buffer


def _carry_on(low: Lowering, found: Sequence[CArray], buffers: Sequence[Buffer]) -> None:
    """Give variables their next values, all at once."""
    names = {b.name for b in buffers}
    moved: list[tuple[CArray, Buffer]] = []
    for array, buffer in zip(found, buffers, strict=True):
        if not _is(array, buffer):
            moved.append((array if _apart(array, names) else low.keep(array), buffer))
    for array, buffer in moved:
        low.store(array, buffer)


def _is(array: CArray, buffer: Buffer) -> bool:
    """Whether an array is just what a variable holds already."""
    if array.parts is not None or array.cost:
        return False
    if buffer.size is None:
        return array.shape == () and array.at(()) == Read(buffer.name, None, buffer.kind)
    return array.stored is buffer and array.offset == 0


def _apart(array: CArray, names: set[str]) -> bool:
    """Whether an array reads no variable of these."""
    if array.parts is not None:
        return all(_apart(part, names) for _, part in array.parts[1])
    return reads(array.at(tuple(integer(0) for _ in array.shape))).isdisjoint(names)


def _while(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    params = operation.params
    n_condition, n_body = params["cond_nconsts"], params["body_nconsts"]
    condition_consts, rest = args[:n_condition], args[n_condition:]
    body_consts, starts = rest[:n_body], rest[n_body:]
    buffers = _variables(low, starts)
    carried = [stored(b, a.shape) for b, a in zip(buffers, starts, strict=True)]
    repeat = Repeat()
    low.emit(repeat)
    with low.within(repeat.body):
        (holds,) = _written(low, params["cond_jaxpr"], [*condition_consts, *carried])
        low.emit(BreakUnless(holds.at(())))
        found = _written(low, params["body_jaxpr"], [*body_consts, *carried])
        _carry_on(low, found, buffers)
    return carried


def _scan(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    scan = scan_of(operation.params)
    n, n_carry = scan.n_constants, scan.n_carry
    length = int(scan.options["length"])
    consts, starts, rows = args[:n], args[n : n + n_carry], args[n + n_carry :]
    buffers = _variables(low, starts)
    carried = [stored(b, a.shape) for b, a in zip(buffers, starts, strict=True)]
    outputs = operation.outputs[n_carry:]
    collected = [low.new(o.shape, o.kind) for o in outputs]
    loop = For(f"i{low.depth}", length)
    low.emit(loop)
    low.depth += 1
    with low.within(loop.body):
        count = variable(loop.index)
        place = add(times(count, -1), integer(length - 1)) if scan.options["reverse"] else count

        def row(source: CArray) -> CArray:
            def at(index: Index) -> Any:
                return source.at((place, *index))

            return CArray(source.shape[1:], source.kind, at, source.cost)

        found = _written(low, scan.body, [*consts, *carried, *map(row, rows)])
        for array, buffer, output in zip(found[n_carry:], collected, outputs, strict=True):
            array = low.keep(array) if array.parts is not None else array
            for index in low.over(output.shape[1:]):
                low.write(buffer, linear((place, *index), output.shape), array.at(index))
        _carry_on(low, found[:n_carry], buffers)
    low.depth -= 1
    rows_found = [stored(b, o.shape) for b, o in zip(collected, outputs, strict=True)]
    return [*carried, *rows_found]


def _cond(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    which, *rest = args
    branches: Sequence[ClosedJaxpr] = operation.params["branches"]
    outputs: Sequence[TracedValue] = operation.outputs
    buffers = [_variable(low, o.shape, o.kind) for o in outputs]
    _branch(low, which, branches, 0, rest, buffers)
    return [stored(b, o.shape) for b, o in zip(buffers, outputs, strict=True)]


def _branch(
    low: Lowering,
    which: CArray,
    branches: Sequence[ClosedJaxpr],
    number: int,
    args: Sequence[CArray],
    buffers: Sequence[Buffer],
) -> None:
    """The branches from a number on, as ``if ... else if ... else``."""

    def write(k: int) -> None:
        for array, buffer in zip(_written(low, branches[k], args), buffers, strict=True):
            low.store(array, buffer)

    if number == len(branches) - 1:
        write(number)
        return
    chosen = which.at(())
    holds = (
        Apply("!", (chosen,), "bool")
        if which.kind == "bool"
        else Apply("<=", (chosen, integer(number)), "bool")
    )
    choose = Choose(holds)
    low.emit(choose)
    with low.within(choose.yes):
        write(number)
    with low.within(choose.no):
        _branch(low, which, branches, number + 1, args, buffers)


RULES: Mapping[str, Any] = {"while": _while, "scan": _scan, "cond": _cond}

READ_OFTEN = frozenset(RULES)
