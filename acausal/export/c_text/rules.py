"""Rules: JAX's operations as C, in one table."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from acausal.export.c_text import indexed, loops, reductions
from acausal.export.c_text.arrays import (
    CArray,
    Index,
    converted,
    linear,
    reshaped,
    stored,
    uniform,
    viewed,
)
from acausal.export.c_text.expressions import (
    Apply,
    Expr,
    Number,
    add,
    convert,
    integer,
    select,
    times,
)
from acausal.export.c_text.lowering import Lowering, Rule, Rules
from acausal.export.traced import TracedOperation, kind_of

# -- operations on elements --------------------------------------------------------------------------


def _on_elements(write: Callable[..., Expr], cost: int = 1) -> Rule:
    def rule(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
        shape = operation.outputs[0].shape

        def at(index: Index) -> Expr:
            return write(*(_element(a, index) for a in args))

        kind = operation.outputs[0].kind
        return [CArray(shape, kind, at, cost + sum(a.cost for a in args))]

    return rule


def _element(array: CArray, index: Index) -> Expr:
    """An element of an array, or of one that has lengths of one (or none) instead."""
    if not array.shape:
        return array.at(())
    own = zip(index, array.shape, strict=True)
    return array.at(tuple(integer(0) if n == 1 else i for i, n in own))


def _operator(op: str, kind: str | None = None) -> Rule:
    return _on_elements(reductions.operator(op, kind))


def _logical(op: str) -> Rule:
    def write(a: Expr, b: Expr) -> Expr:
        for one, other in ((a, b), (b, a)):
            if isinstance(one, Number):
                return (
                    (other if one.value else one) if op == "&&" else (one if one.value else other)
                )
        return Apply(op, (a, b), "bool")

    return _on_elements(write)


def _function(name: str, cost: int = 10) -> Rule:
    return _on_elements(lambda *args: Apply(name, args, args[0].kind), cost)


def _prelude(name: str, cost: int) -> Rule:
    write = _function(name, cost)

    def rule(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
        low.memory.prelude.add(name)
        return write(low, operation, args)

    return rule


def _real_or_int(real: str, whole: str, cost: int) -> Rule:
    def rule(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
        chosen = real if operation.outputs[0].kind == "real" else whole
        return _prelude(chosen, cost)(low, operation, args)

    return rule


def _integer_pow(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    y = int(operation.params["y"])
    if y == 0:
        return [uniform(Number(1.0, "real"), operation.outputs[0].shape)]
    (base,) = args
    if base.cost:
        base = low.kept(operation.inputs[0])
    whole = _on_elements(lambda a: _power(a, abs(y)), abs(y))(low, operation, [base])
    if y > 0:
        return whole
    return _on_elements(lambda a: Apply("/", (Number(1.0, "real"), a), "real"))(
        low, operation, whole
    )


def _power(a: Expr, n: int) -> Expr:
    """By repeated squaring, as XLA computes it."""
    if n == 1:
        return a
    half = _power(a, n // 2)
    square = Apply("*", (half, half), a.kind)
    return Apply("*", (square, a), a.kind) if n % 2 else square


def _convert(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    return [converted(args[0], kind_of(operation.params["new_dtype"]))]


def _select_n(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    which, *cases = args
    shape, kind = operation.outputs[0].shape, operation.outputs[0].kind

    def at(index: Index) -> Expr:
        chosen = _element(which, index)
        values = [_element(c, index) for c in cases]
        if which.kind == "bool":
            no, yes = values
            return select(chosen, yes, no)
        found = values[-1]
        for number, value in reversed(list(enumerate(values[:-1]))):
            found = select(Apply("==", (chosen, integer(number)), "bool"), value, found)
        return found

    return [CArray(shape, kind, at, 1 + sum(a.cost for a in args))]


def _clamp(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    rules = _real_or_int("maximum", "maximum_int", 2), _real_or_int("minimum", "minimum_int", 2)
    low_end, value, high_end = args
    found = rules[0](low, operation, [value, low_end])
    return rules[1](low, operation, [found[0], high_end])


# -- the same elements elsewhere ---------------------------------------------------------------------


def _broadcast(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    (source,) = args
    shape = tuple(operation.params["shape"])
    places = tuple(operation.params["broadcast_dimensions"])

    def moved(index: Index) -> Index:
        return tuple(
            integer(0) if n == 1 else index[p] for n, p in zip(source.shape, places, strict=True)
        )

    if source.size == len(source.shape) == 0 or shape == source.shape:
        return [viewed(source, shape, moved)]
    if [n for n in shape if n != 1] == [n for n in source.shape if n != 1]:
        return [reshaped(source, shape)]
    return [viewed(source, shape, moved)]


def _reshape(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    return [reshaped(args[0], operation.outputs[0].shape)]


def _transpose(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    order = tuple(operation.params["permutation"])

    def moved(index: Index) -> Index:
        found: list[Any] = [None] * len(order)
        for position, axis in enumerate(order):
            found[axis] = index[position]
        return tuple(found)

    return [viewed(args[0], operation.outputs[0].shape, moved)]


def _rev(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    axes, shape = set(operation.params["dimensions"]), args[0].shape

    def moved(index: Index) -> Index:
        return tuple(
            add(integer(n - 1), times(i, -1)) if axis in axes else i
            for axis, (i, n) in enumerate(zip(index, shape, strict=True))
        )

    return [viewed(args[0], shape, moved)]


def _slice(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    params = operation.params
    starts = tuple(int(s) for s in params["start_indices"])
    strides = tuple(int(s) for s in params["strides"] or (1,) * len(starts))
    return [_sliced(low, operation, args[0], starts, strides, operation.outputs[0].shape)]


def _sliced(
    low: Lowering,
    operation: TracedOperation,
    source: CArray,
    starts: tuple[int, ...],
    strides: tuple[int, ...],
    shape: tuple[int, ...],
) -> CArray:
    if source.parts is not None:
        axis, parts = source.parts
        last = starts[axis] + strides[axis] * (shape[axis] - 1)
        for start, part in parts:
            if start <= starts[axis] and last < start + part.shape[axis]:
                moved = (*starts[:axis], starts[axis] - start, *starts[axis + 1 :])
                return _sliced(low, operation, part, moved, strides, shape)
        source = low.kept(operation.inputs[0])
    if source.stored is not None and source.stored.table is None and source.stored.size is not None:
        rows = source.shape[1:] == shape[1:] and all(s == 1 for s in strides)
        if len(shape) >= 1 and rows and not any(starts[1:]):
            below = 1
            for n in shape[1:]:
                below *= n
            return stored(source.stored, shape, source.offset + starts[0] * below)
    return viewed(
        source,
        shape,
        lambda index: tuple(
            add(times(i, stride), integer(start))
            for i, start, stride in zip(index, starts, strides, strict=True)
        ),
    )


def _split(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    axis, start, found = int(operation.params["axis"]), 0, list[CArray]()
    for output in operation.outputs:
        starts = tuple(start if a == axis else 0 for a in range(len(output.shape)))
        strides = (1,) * len(output.shape)
        found.append(_sliced(low, operation, args[0], starts, strides, output.shape))
        start += output.shape[axis]
    return found


def _concatenate(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    axis, start = int(operation.params["dimension"]), 0
    parts: list[tuple[int, CArray]] = []
    for array in args:
        if array.size:
            parts.append((start, array))
        start += array.shape[axis]
    return [_in_parts(operation.outputs[0].shape, axis, parts, operation.outputs[0].kind)]


def _in_parts(
    shape: tuple[int, ...], axis: int, parts: list[tuple[int, CArray]], kind: str
) -> CArray:
    if len(parts) == 1:
        return parts[0][1]

    def at(index: Index) -> Expr:
        raise AssertionError("an array in parts has no one expression")

    return CArray(
        shape, kind, at, max((p.cost for _, p in parts), default=0), parts=(axis, tuple(parts))
    )


def _stack(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    shape = operation.outputs[0].shape
    axis = int(operation.params.get("axis", operation.params.get("dimension", 0)))
    one = (*shape[:axis], 1, *shape[axis + 1 :])
    parts = [
        (k, reshaped(low.kept(atom) if a.parts else a, one))
        for k, (a, atom) in enumerate(zip(args, operation.inputs, strict=True))
    ]
    return [_in_parts(shape, axis, parts, operation.outputs[0].kind)]


def _unstack(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    axis, shape = int(operation.params.get("axis", 0)), args[0].shape
    one = (*shape[:axis], 1, *shape[axis + 1 :])
    found: list[CArray] = []
    for k, output in enumerate(operation.outputs):
        starts = tuple(k if a == axis else 0 for a in range(len(shape)))
        row = _sliced(low, operation, args[0], starts, (1,) * len(shape), one)
        found.append(reshaped(row, output.shape))
    return found


def _pad(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    source, value = args
    config = operation.params["padding_config"]
    shape, kind = operation.outputs[0].shape, operation.outputs[0].kind
    buffer = low.new(shape, kind)
    low.store(uniform(value.at(()), shape), buffer)
    for index in low.over(source.shape):
        moved = tuple(
            add(times(i, inside + 1), integer(before))
            for i, (before, _, inside) in zip(index, config, strict=True)
        )
        low.write(buffer, linear(moved, shape), source.at(index))
    return [stored(buffer, shape)]


def _iota(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    axis, kind = int(operation.params["dimension"]), operation.outputs[0].kind
    return [CArray(operation.outputs[0].shape, kind, lambda i: convert(i[axis], kind))]


# -- the table ---------------------------------------------------------------------------------------

SAME = """acos acosh asin asinh atan atan2 atanh cbrt cos cosh erf erfc exp exp2 expm1 lgamma log log1p pow sin sinh
sqrt tan tanh"""
"""Functions that C has under JAX's names."""

ON_ELEMENTS: Mapping[str, Rule] = {
    "add": _operator("+"), "add_any": _operator("+"), "sub": _operator("-"), "mul": _operator("*"),
    "neg": _on_elements(lambda a: Apply("neg", (a,), a.kind)),
    "div": _operator("/"), "rem": _real_or_int("fmod", "remainder_int", 4),
    "max": _real_or_int("maximum", "maximum_int", 2), "min": _real_or_int("minimum", "minimum_int", 2),
    "abs": _real_or_int("fabs", "absolute_int", 1), "sign": _real_or_int("signum", "signum_int", 2),
    "eq": _operator("==", "bool"), "ne": _operator("!=", "bool"), "gt": _operator(">", "bool"),
    "lt": _operator("<", "bool"), "le": _operator("<=", "bool"), "ge": _operator(">=", "bool"),
    "lt_to": _operator("<", "bool"), "le_to": _operator("<=", "bool"),
    "and": _logical("&&"), "or": _logical("||"), "xor": _operator("!=", "bool"),
    "not": _on_elements(lambda a: Apply("!", (a,), "bool")),
    "is_finite": _on_elements(lambda a: convert(Apply("isfinite", (a,), "int"), "bool")),
    "integer_pow": _integer_pow, "square": _prelude("square", 1),
    "logistic": _prelude("logistic", 10), "rsqrt": _prelude("inverse_sqrt", 10),
    "one_minus_square": _prelude("one_minus_square", 2),
    "round": _prelude("round_even", 3), "floor": _function("floor", 2), "ceil": _function("ceil", 2),
    "nextafter": _function("nextafter", 3), **{name: _function(name) for name in SAME.split()},
    "clamp": _clamp, "convert_element_type": _convert, "select_n": _select_n,
}  # fmt: skip

MOVED: Mapping[str, Rule] = {
    "broadcast_in_dim": _broadcast, "reshape": _reshape, "squeeze": _reshape, "expand_dims": _reshape,
    "transpose": _transpose, "rev": _rev, "slice": _slice, "split": _split,
    "concatenate": _concatenate, "stack": _stack, "unstack": _unstack, "pad": _pad, "iota": _iota,
}  # fmt: skip

RULES = Rules(
    table={
        **ON_ELEMENTS,
        **MOVED,
        **reductions.RULES,
        **indexed.RULES,
        **loops.RULES,
    },
    joined=frozenset({"slice", "split", "concatenate", "stack", "unstack"}),
    read_often=reductions.READ_OFTEN | indexed.READ_OFTEN | loops.READ_OFTEN,
)
"""All that is known of JAX's operations."""
