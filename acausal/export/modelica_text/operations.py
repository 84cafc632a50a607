"""The table of operations of networks, as texts of Modelica."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from acausal._jax import Equation, name_of
from acausal.export.modelica_text.elementwise import ELEMENTWISE, Rule, refuse, shape_of
from acausal.export.modelica_text.lines import BlockTerm, Body, Index, elements, named, shifted
from acausal.export.traced import places


def _moved(place: Callable[[Equation, tuple[int, ...], Index], Index]) -> Rule:
    """Elements at other places."""

    def rule(block: Body, equation: Equation, terms: Sequence[BlockTerm]) -> list[BlockTerm]:
        x = terms[0]
        return [
            BlockTerm(
                block,
                shape_of(equation, i),
                lambda index, i=i: x.at(place(equation, x.shape, (str(i), *index))),
                truth=x.truth,
                plain=x.is_plain,
            )
            for i in range(len(equation.outvars))
        ]

    return rule


def _broadcast(equation: Equation, shape: tuple[int, ...], index: Index) -> Index:
    axes = equation.params["broadcast_dimensions"]
    return tuple("1" if n == 1 else index[1 + int(d)] for d, n in zip(axes, shape, strict=True))


def _reshape(equation: Equation, shape: tuple[int, ...], index: Index) -> Index:
    """Axes of one element come and go."""
    new = shape_of(equation)
    if [n for n in shape if n != 1] != [n for n in new if n != 1]:
        raise refuse(equation)
    kept = iter([i for i, n in zip(index[1:], new, strict=True) if n != 1])
    return tuple("1" if n == 1 else next(kept) for n in shape)


def _transpose(equation: Equation, shape: tuple[int, ...], index: Index) -> Index:
    order = [int(p) for p in equation.params["permutation"]]
    return tuple(index[1 + order.index(axis)] for axis in range(len(shape)))


def _slice(equation: Equation, shape: tuple[int, ...], index: Index) -> Index:
    starts, steps = equation.params["start_indices"], equation.params["strides"]
    steps = steps or (1,) * len(shape)
    return tuple(
        shifted(i, int(start), int(step))
        for i, start, step in zip(index[1:], starts, steps, strict=True)
    )


def _split(equation: Equation, shape: tuple[int, ...], index: Index) -> Index:
    axis, which = int(equation.params["axis"]), int(index[0])
    before = sum(int(n) for n in equation.params["sizes"][:which])
    return tuple(shifted(i, before) if d == axis else i for d, i in enumerate(index[1:]))


def _unstack(equation: Equation, shape: tuple[int, ...], index: Index) -> Index:
    axis, own = int(equation.params["axis"]), list(index[1:])
    own.insert(axis, str(int(index[0]) + 1))
    return tuple(own)


def _rev(equation: Equation, shape: tuple[int, ...], index: Index) -> Index:
    turned = [int(d) for d in equation.params["dimensions"]]
    return tuple(
        str(n + 1 - int(i))
        if d in turned and i.isdigit()
        else f"{n + 1} - {i}"
        if d in turned
        else i
        for d, (i, n) in enumerate(zip(index[1:], shape, strict=True))
    )


def _joined(block: Body, equation: Equation, terms: Sequence[BlockTerm]) -> list[BlockTerm]:
    """Arrays one behind the other, or numbers side by side, along the first axis."""
    stacked = name_of(equation) == "stack"
    if int(equation.params["axis" if stacked else "dimension"]) != 0 or terms[0].truth:
        raise refuse(equation)
    new, shape = int(stacked), shape_of(equation)
    if len(terms) == 1:
        (term,) = terms
        return [BlockTerm(block, shape, lambda index: term.at(index[new:]), plain=term.is_plain)]
    name, at = block.declare(shape), 0
    for term in terms:
        inner = (1,) * new + term.shape
        block.assign(name, inner, lambda index, term=term: term.at(index[new:]), at)
        at += inner[0]
    return [named(block, name, shape)]


def _pad(block: Body, equation: Equation, terms: Sequence[BlockTerm]) -> list[BlockTerm]:
    """A vector with the filling before and behind it."""
    (x, filling), config = terms, equation.params["padding_config"]
    if len(config) != 1 or config[0][2] or min(config[0][:2]) < 0:
        raise refuse(equation)
    low, high, _ = map(int, config[0])
    name = block.declare(shape_of(equation))
    for n, at, term in ((low, 0, filling), (x.shape[0], low, x), (high, low + x.shape[0], filling)):
        if n:
            block.assign(name, (n,), lambda index, t=term: t.at(index if t.shape else ()), at)
    return [named(block, name, shape_of(equation))]


def _gathered(block: Body, equation: Equation, terms: Sequence[BlockTerm]) -> list[BlockTerm]:
    """Elements at places that are known."""
    x, where = terms
    if where.value is None or not x.shape:
        raise refuse(equation)
    (chosen,) = places(equation, [x, where.value], (0,))
    sources = np.stack(np.unravel_index(chosen.ravel(), x.shape), axis=-1) + 1
    name = block.declare(shape_of(equation))
    for target, source in zip(np.ndindex(*shape_of(equation)), sources, strict=True):
        left = elements(name)(tuple(str(i + 1) for i in target))
        block.equations.append(f"{left} = {x.at(tuple(map(str, source)))};")
    return [named(block, name, shape_of(equation))]


def _dot(block: Body, equation: Equation, terms: Sequence[BlockTerm]) -> list[BlockTerm]:
    """Products of matrices and vectors; of two vectors without a common axis, of their elements."""
    (left, right), batch = equation.params["dimension_numbers"]
    if any(len(b) for b in batch) or len(left) > 1:
        raise refuse(equation)
    a, b = terms
    if not len(left):
        n = len(a.shape)
        return [
            BlockTerm(
                block, shape_of(equation), lambda index: f"({a.at(index[:n])}*{b.at(index[n:])})"
            )
        ]
    if max(len(a.shape), len(b.shape)) > 2:
        raise refuse(equation)
    first, second = a.name(), b.name()
    if left[0] != len(a.shape) - 1:
        first = f"transpose({first})"
    if right[0] != 0:
        second = f"transpose({second})"
    product = f"{first}*{second}"
    if not shape_of(equation):
        return [BlockTerm(block, (), lambda _: f"({product})")]
    return [BlockTerm(block, shape_of(equation), None, whole=product)]


def _reduce(function: str) -> Rule:
    """Of all elements, or along one axis."""

    def rule(block: Body, equation: Equation, terms: Sequence[BlockTerm]) -> list[BlockTerm]:
        (x,), axes = terms, [int(a) for a in equation.params["axes"]]
        if x.truth or not (len(axes) == 1 or len(axes) == len(x.shape)):
            raise refuse(equation)
        name = x.name()
        if len(axes) == len(x.shape):
            return [BlockTerm(block, (), lambda _: f"{function}({name})")]

        def element(index: Index) -> str:
            own = list(index)
            own.insert(axes[0], ":")
            return f"{function}({name}[{', '.join(own)}])"

        return [BlockTerm(block, shape_of(equation), element)]

    return rule


RULES: dict[str, Rule] = {
    **ELEMENTWISE,
    "broadcast_in_dim": _moved(_broadcast),
    "concatenate": _joined,
    "dot_general": _dot,
    "expand_dims": _moved(_reshape),
    "gather": _gathered,
    "pad": _pad,
    "reduce_max": _reduce("max"),
    "reduce_min": _reduce("min"),
    "reduce_sum": _reduce("sum"),
    "reshape": _moved(_reshape),
    "rev": _moved(_rev),
    "slice": _moved(_slice),
    "split": _moved(_split),
    "squeeze": _moved(_reshape),
    "stack": _joined,
    "transpose": _moved(_transpose),
    "unstack": _moved(_unstack),
}
"""By operation, how its results are written."""
