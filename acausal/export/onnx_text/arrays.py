"""Rules of operations that move elements or add them up, and of products of matrices."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from acausal._jax import bind
from acausal.export.onnx_text.builder import WHOLE, Rule, Site, Tensor, Value
from acausal.export.traced import places, subscripts


def _axes(site: Site, *axes: int) -> str:
    return site.graph.integers(*(int(a) for a in axes))


def _broadcast(site: Site) -> list[str]:
    """Axes of size one where there are none, then copies."""
    g, x, shape = site.graph, site.names[0], site.params["shape"]
    own = [int(d) for d in site.params["broadcast_dimensions"]]
    new = [d for d in range(len(shape)) if d not in own]
    if new:
        x = g.add("Unsqueeze", x, _axes(site, *new))
    widened = [1] * len(shape)
    for d, n in zip(own, site.shapes[0], strict=True):
        widened[d] = n
    return [x if widened == list(shape) else g.add("Expand", x, g.sizes(shape))]


def _reshape(site: Site) -> list[str]:
    if site.params.get("dimensions") is not None:
        raise site.refuse("with a permutation")
    return [site.graph.add("Reshape", site.names[0], site.graph.sizes(site.params["new_sizes"]))]


def _on_axes(operation: str) -> Rule:
    """Axes of size one come or go."""
    return lambda site: [
        site.graph.add(operation, site.names[0], _axes(site, *site.params["dimensions"]))
    ]


def _transpose(site: Site) -> list[str]:
    order = [int(i) for i in site.params["permutation"]]
    return [site.graph.add("Transpose", site.names[0], perm=order)]


def _slice(site: Site) -> list[str]:
    p, shape = site.params, site.shapes[0]
    strides = p["strides"] or (1,) * len(shape)
    cut = [
        (axis, start, WHOLE if end == n else end, step)
        for axis, (start, end, step, n) in enumerate(
            zip(p["start_indices"], p["limit_indices"], strides, shape, strict=True)
        )
        if not (start == 0 and end == n and step == 1)
    ]
    return [_cut(site, site.names[0], cut)]


def _cut(site: Site, x: str, cut: Sequence[tuple[int, int, int, int]]) -> str:
    if not cut:
        return x
    axes, starts, ends, steps = zip(*cut, strict=True)
    g = site.graph
    vectors = [g.integers(*map(int, v)) for v in (starts, ends, axes, steps)]
    return g.add("Slice", x, *vectors)


def _rev(site: Site) -> list[str]:
    cut = [(int(axis), -1, -WHOLE, -1) for axis in site.params["dimensions"]]
    return [_cut(site, site.names[0], cut)]


def _concatenate(site: Site) -> list[str]:
    return [site.graph.add("Concat", *site.names, axis=int(site.params["dimension"]))]


def _stack(site: Site) -> list[str]:
    axis = int(site.params["axis"])
    parts = [site.graph.add("Unsqueeze", x, _axes(site, axis)) for x in site.names]
    return [site.graph.add("Concat", *parts, axis=axis)]


def _split(site: Site) -> list[str]:
    sizes, axis = [int(n) for n in site.params["sizes"]], int(site.params["axis"])
    g, x = site.graph, site.names[0]
    return g.add_several("Split", x, g.integers(*sizes), outputs=len(sizes), axis=axis)


def _unstack(site: Site) -> list[str]:
    axis, count = int(site.params["axis"]), len(site.equation.outvars)
    g, x = site.graph, site.names[0]
    parts = g.add_several("Split", x, g.integers(*[1] * count), outputs=count, axis=axis)
    return [g.add("Squeeze", part, _axes(site, axis)) for part in parts]


def _pad(site: Site) -> list[str]:
    config = site.params["padding_config"]
    if any(inner for _, _, inner in config):
        raise site.refuse("between elements")
    widths = [int(low) for low, _, _ in config] + [int(high) for _, high, _ in config]
    x, filling = site.names
    return [site.graph.add("Pad", x, site.graph.integers(*widths), filling, mode="constant")]


def _gather(site: Site) -> list[str]:
    """Along one axis; else, where the indices are known, from the numbered elements."""
    operand, indices = site.values
    numbers, sizes = site.params["dimension_numbers"], site.params["slice_sizes"]
    mapped = tuple(numbers.start_index_map)
    batching = getattr(numbers, "operand_batching_dims", ())
    whole = all(
        size == n
        for a, (size, n) in enumerate(zip(sizes, operand.shape, strict=True))
        if a not in mapped
    )
    if (
        len(mapped) == 1
        and tuple(numbers.collapsed_slice_dims) == mapped
        and whole
        and not batching
    ):
        return [_take(site, int(mapped[0]), numbers.offset_dims)]
    if isinstance(indices, np.ndarray) and _is_fixed(operand):
        return [_renumbered(site, 0)]
    raise site.refuse("with indices that are computed")


def _take(site: Site, axis: int, offset: Sequence[int]) -> str:
    g, (x, indices) = site.graph, site.names
    shape: Any = site.values[1].shape
    indices = g.add("Squeeze", indices, g.integers(len(shape) - 1))
    if isinstance(site.values[1], Tensor):  # JAX keeps indices within the array
        last = site.shapes[0][axis] - 1
        indices = g.add("Max", g.add("Min", indices, _like(site, last)), _like(site, 0))
    found = g.add("Gather", x, indices, axis=axis)
    batch = len(shape) - 1
    rank = len(site.shapes[0]) - 1 + batch
    own = [d for d in range(rank) if d not in offset]
    present = [("o", i) for i in range(axis)] + [("b", i) for i in range(batch)]
    present += [("o", i) for i in range(axis, rank - batch)]
    wanted = [
        ("b", own.index(d)) if d in own else ("o", list(offset).index(d)) for d in range(rank)
    ]
    order = [present.index(w) for w in wanted]
    return found if order == sorted(order) else g.add("Transpose", found, perm=order)


def _like(site: Site, number: int) -> str:
    return site.graph.constant(number, site.values[1].dtype)


def _scatter(site: Site) -> list[str]:
    """Where the indices are known, a choice among the elements of both arrays."""
    operand, indices, updates = site.values
    if isinstance(indices, np.ndarray) and _is_fixed(operand) and _is_fixed(updates):
        return [_renumbered(site, 0, 2)]
    raise site.refuse("with indices that are computed")


def _renumbered(site: Site, *moved: int) -> str:
    """Elements of some arguments that an operation moves."""
    g, values = site.graph, [site.values[k] for k in moved]
    (chosen,) = places(site.equation, site.values, moved)
    count = sum(int(np.prod(v.shape, dtype=int)) for v in values)
    if chosen.size and not 0 <= chosen.min() <= chosen.max() < count:
        raise site.refuse("with indices outside of the array")
    flat = [g.add("Reshape", g.read(v), g.integers(-1)) for v in values]
    every = flat[0] if len(flat) == 1 else g.add("Concat", *flat, axis=0)
    return g.add("Gather", every, g.constant(chosen, np.int64), axis=0)


def _is_fixed(value: Value) -> bool:
    return all(isinstance(n, int | np.integer) for n in value.shape)


def _starts(site: Site, first: int, sizes: Sequence[int]) -> str:
    """Where a block begins, within the array."""
    g = site.graph
    given = [g.add("Cast", g.read(v), to=g.kind(np.int64)) for v in site.values[first:]]
    parts = [g.add("Unsqueeze", name, g.integers(0)) for name in given]
    starts = parts[0] if len(parts) == 1 else g.add("Concat", *parts, axis=0)
    last = [n - size for n, size in zip(site.shapes[0], sizes, strict=True)]
    zero = g.integers(*[0] * len(sizes))
    return g.add("Max", g.add("Min", starts, g.integers(*last)), zero)


def _dynamic_slice(site: Site) -> list[str]:
    g, sizes = site.graph, [int(n) for n in site.params["slice_sizes"]]
    starts = _starts(site, 1, sizes)
    ends = g.add("Add", starts, g.integers(*sizes))
    return [g.add("Slice", site.names[0], starts, ends)]


def _dynamic_update(site: Site) -> list[str]:
    """What lies before the block, the block, what lies behind it; along one axis."""
    g, (x, block, *_) = site.graph, site.names
    whole, sizes = site.shapes[0], site.shapes[1]
    axes = [a for a, (n, size) in enumerate(zip(whole, sizes, strict=True)) if n != size]
    if len(axes) > 1:
        raise site.refuse("along several axes")
    if not axes:
        return [block]
    (axis,) = axes
    starts = g.add("Gather", _starts(site, 2, sizes), g.integers(axis), axis=0)
    ends = g.add("Add", starts, g.integers(sizes[axis]))
    where = g.integers(axis)
    before = g.add("Slice", x, g.integers(0), starts, where)
    behind = g.add("Slice", x, ends, g.integers(WHOLE), where)
    return [g.add("Concat", before, block, behind, axis=axis)]


def _iota(site: Site) -> list[Value]:
    (value,) = bind(site.equation, [])
    return [np.asarray(value)]


def _reduce(operation: str) -> Rule:
    def rule(site: Site) -> list[str]:
        axes = _axes(site, *site.params["axes"])
        return [site.graph.add(operation, site.names[0], axes, keepdims=0)]

    return rule


def _reduce_truth(operation: str) -> Rule:
    """All or any: the least or greatest of zeros and ones."""

    def rule(site: Site) -> list[str]:
        g, axes = site.graph, _axes(site, *site.params["axes"])
        number = g.cast(site.names[0], np.int32)
        return [g.cast(g.add(operation, number, axes, keepdims=0), bool)]

    return rule


def _arg(operation: str) -> Rule:
    def rule(site: Site) -> list[str]:
        (axis,) = site.params["axes"]
        found = site.graph.add(operation, site.names[0], axis=int(axis), keepdims=0)
        return [site.graph.cast(found, site.params["index_dtype"])]

    return rule


def _cumsum(site: Site) -> list[str]:
    axis = site.graph.constant(int(site.params["axis"]), np.int64)
    return [site.graph.add("CumSum", site.names[0], axis, reverse=int(site.params["reverse"]))]


def _dot(site: Site) -> list[str]:
    """``MatMul`` of constants with vectors; ``Gemm`` of matrices, which turns them itself; else ``Einsum``.

    onnxruntime (1.32) loses the transposition of a matrix that ``MatMul`` takes beside a vector.
    """
    g, (one, two) = site.graph, site.values
    (left, right), (batch, _) = site.params["dimension_numbers"]
    ranks = [len(shape) for shape in site.shapes]
    if not len(batch) and len(left) == 1 and max(ranks) <= 2:
        turned = left[0] != ranks[0] - 1, right[0] != 0
        matrices = [v for v, rank in zip((one, two), ranks, strict=True) if rank == 2]
        if len(matrices) < 2 and not any(isinstance(m, Tensor) for m in matrices):
            a, b = (
                g.read(v) if isinstance(v, Tensor) or not turn else g.constant(v.T)
                for v, turn in zip((one, two), turned, strict=True)
            )
            return [g.add("MatMul", a, b)]
        vectors = [axis for axis, rank in enumerate(ranks) if rank == 1]
        a, b = (
            g.add("Unsqueeze", name, g.integers(axis)) if axis in vectors else name
            for axis, name in enumerate(site.names)
        )
        product = g.add("Gemm", a, b, transA=int(turned[0]), transB=int(turned[1]))
        return [g.add("Squeeze", product, g.integers(*vectors)) if vectors else product]
    equation = subscripts(site.params["dimension_numbers"], ranks)
    return [g.add("Einsum", *site.names, equation=equation)]


RULES: dict[str, Rule] = {
    "argmax": _arg("ArgMax"),
    "argmin": _arg("ArgMin"),
    "broadcast_in_dim": _broadcast,
    "concatenate": _concatenate,
    "cumsum": _cumsum,
    "dot_general": _dot,
    "dynamic_slice": _dynamic_slice,
    "dynamic_update_slice": _dynamic_update,
    "expand_dims": _on_axes("Unsqueeze"),
    "gather": _gather,
    "iota": _iota,
    "pad": _pad,
    "reduce_and": _reduce_truth("ReduceMin"),
    "reduce_max": _reduce("ReduceMax"),
    "reduce_min": _reduce("ReduceMin"),
    "reduce_or": _reduce_truth("ReduceMax"),
    "reduce_prod": _reduce("ReduceProd"),
    "reduce_sum": _reduce("ReduceSum"),
    "reshape": _reshape,
    "rev": _rev,
    "scatter": _scatter,
    "slice": _slice,
    "split": _split,
    "squeeze": _on_axes("Squeeze"),
    "stack": _stack,
    "transpose": _transpose,
    "unstack": _unstack,
}
"""By operation, how its nodes are made."""
