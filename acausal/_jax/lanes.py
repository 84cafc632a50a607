"""Lanes: evaluate a function for several instances side by side, the instances along the last axis.

`jax.vmap` puts instances first. A processor's vector registers hold neighbours, and with the instances last every
operation on one number, or on one element of an array, becomes an operation on neighbours: here a small network
is four times as fast. A function is traced and its equations are evaluated one by one, from a table of rules; an
operation without a rule goes through `jax.vmap`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jax import Array, lax
from jax.extend.core import ClosedJaxpr

Flat = Callable[..., Sequence[Array]]
"""A function of arrays that returns several."""


SUM = 2048
"""Elements in a sum that XLA still compiles itself; more go to a library."""


class Value(NamedTuple):
    """An array, and whether its last axis is that of the lanes; if not, all lanes share it."""

    array: Any
    laned: bool


def lanes(function: Flat, laned: Sequence[bool], width: int) -> Flat:
    """The function for ``width`` instances.

    Arguments:
        function: of arrays; returns several arrays.
        laned: per argument, whether it gets a last axis for the instances.
        width: number of instances.

    Returns:
        A function of the same arguments with that axis; all of its results have it.
    """

    def side_by_side(*args: Array) -> list[Array]:
        shapes = [a.shape[:-1] if has else a.shape for a, has in zip(args, laned, strict=True)]
        one = [jax.ShapeDtypeStruct(s, a.dtype) for s, a in zip(shapes, args, strict=True)]
        traced = jax.make_jaxpr(function)(*one)
        values = [Value(a, has) for a, has in zip(args, laned, strict=True)]
        return _spread_all(_evaluate(traced, values, width), traced.jaxpr.outvars, width)

    return side_by_side


def _evaluate(closed: Any, args: Sequence[Value], width: int) -> list[Value]:
    """The results of a closed jaxpr."""
    jaxpr = closed.jaxpr
    known = dict(zip(jaxpr.constvars, (Value(c, False) for c in closed.consts), strict=True))
    known |= dict(zip(jaxpr.invars, args, strict=True))

    def read(atom: Any) -> Value:
        return Value(atom.val, False) if hasattr(atom, "val") else known[atom]

    for equation in jaxpr.eqns:
        inputs = [read(atom) for atom in equation.invars]
        known |= dict(zip(equation.outvars, _apply(equation, inputs, width), strict=True))
    return [read(atom) for atom in jaxpr.outvars]


def _apply(equation: Any, inputs: list[Value], width: int) -> list[Value]:
    name = equation.primitive.name
    if name in CALLS:
        return _evaluate(called(equation), inputs, width)
    if not any(v.laned for v in inputs):
        return [Value(a, False) for a in _bind(equation, [v.array for v in inputs])]
    rule = _elementwise if name in ELEMENTWISE else RULES.get(name, _vmapped)
    return [Value(a, True) for a in rule(equation, inputs, width)]


def _bind(equation: Any, arrays: Sequence[Any], **changed: Any) -> list[Any]:
    results = equation.primitive.bind(*arrays, **{**equation.params, **changed})
    return list(results) if equation.primitive.multiple_results else [results]


def called(equation: Any) -> Any:
    """The closed jaxpr that an equation calls."""
    inner = next(equation.params[k] for k in CALLED if k in equation.params)
    return inner if hasattr(inner, "consts") else ClosedJaxpr(inner, ())


def _spread(value: Value, shape: tuple[int, ...], width: int) -> Any:
    """The value with lanes and of that shape; a single number fills it."""
    array = jnp.asarray(value.array)
    target = (*shape, width)
    if array.shape == target and value.laned:
        return array
    own = array.ndim - value.laned
    kept = tuple(range(own)) + ((len(shape),) if value.laned else ())
    return lax.broadcast_in_dim(array, target, kept)


def _spread_all(values: Sequence[Value], atoms: Sequence[Any], width: int) -> list[Any]:
    return [_spread(v, atom.aval.shape, width) for v, atom in zip(values, atoms, strict=True)]


# -- rules: (equation, inputs, width) -> arrays with lanes; at least one input has lanes -------------------


def _elementwise(equation: Any, inputs: list[Value], width: int) -> list[Any]:
    shape = equation.outvars[0].aval.shape
    return _bind(equation, [_spread(v, shape, width) for v in inputs])


def _same_axes(equation: Any, inputs: list[Value], width: int) -> list[Any]:
    """What names axes from the front does not see the last one."""
    return _bind(equation, _spread_all(inputs, equation.invars, width))


def _vmapped(equation: Any, inputs: list[Value], width: int) -> list[Any]:
    axes = [-1 if v.laned else None for v in inputs]
    call = jax.vmap(lambda *a: _bind(equation, a), axes, -1, axis_size=width)
    return call(*(v.array for v in inputs))


def _broadcast(equation: Any, inputs: list[Value], width: int) -> list[Any]:
    shape, kept = equation.params["shape"], equation.params["broadcast_dimensions"]
    return [lax.broadcast_in_dim(inputs[0].array, (*shape, width), (*kept, len(shape)))]


def _reshape(equation: Any, inputs: list[Value], width: int) -> list[Any]:
    return [lax.reshape(inputs[0].array, (*equation.params["new_sizes"], width))]


def _slice(equation: Any, inputs: list[Value], width: int) -> list[Any]:
    p = equation.params
    strides = None if p["strides"] is None else (*p["strides"], 1)
    return [
        lax.slice(inputs[0].array, (*p["start_indices"], 0), (*p["limit_indices"], width), strides)
    ]


def _transpose(equation: Any, inputs: list[Value], width: int) -> list[Any]:
    order = equation.params["permutation"]
    return [lax.transpose(inputs[0].array, (*order, len(order)))]


def _pad(equation: Any, inputs: list[Value], width: int) -> list[Any]:
    array, filler = inputs
    if filler.laned:
        return _vmapped(equation, inputs, width)
    return [lax.pad(array.array, filler.array, (*equation.params["padding_config"], (0, 0, 0)))]


def _dot(equation: Any, inputs: list[Value], width: int) -> list[Any]:
    """A product of matrices or vectors as sums of products of elements."""
    (left_sum, right_sum), (left_batch, _) = equation.params["dimension_numbers"]
    if left_batch:
        return _vmapped(equation, inputs, width)
    shape = (*equation.outvars[0].aval.shape, width)
    left, right = _matrix(inputs[0], left_sum), _matrix(inputs[1], right_sum)
    if left.shape[1] == 1:
        return [jnp.reshape(left * jnp.swapaxes(right, 0, 1), shape)]
    if left.shape[0] < right.shape[0]:
        return [jnp.reshape(jnp.swapaxes(_sums(right, left), 0, 1), shape)]
    return [jnp.reshape(_sums(left, right), shape)]


def _sums(left: Any, right: Any) -> Any:
    """(rows of left, rows of right, lanes), summed over their second axis, some rows at a time.

    A single row is taken twice: its factor is then used twice, and XLA does not fuse the sums that the factor was
    made of into these, as a loop of many sums within each sum.
    """
    n = left.shape[0]
    if n == 1:
        left = jnp.broadcast_to(left, (2, *left.shape[1:]))
    some = max(2, SUM // (right.size * left.shape[-1] // min(left.shape[-1], right.shape[-1])))
    rows = [left[i : i + some, None] for i in range(0, len(left), some)]
    return jnp.concatenate([jnp.sum(row * right, axis=2) for row in rows])[:n]


def _matrix(value: Value, summed: tuple[int, ...]) -> Any:
    """(rows, summed, lanes or 1) of an array, one of whose axes may be summed over."""
    array = value.array if value.laned else jnp.expand_dims(value.array, -1)
    free = [i for i in range(array.ndim - 1) if i not in summed]
    array = lax.transpose(array, (*free, *summed, array.ndim - 1))
    columns = math.prod(array.shape[len(free) : -1])
    return array.reshape(-1, columns, array.shape[-1])


def _scan(equation: Any, inputs: list[Value], width: int) -> list[Any]:
    p = equation.params
    body, n, m = p["jaxpr"], p["num_consts"], p["num_carry"]
    constants, start, rows = inputs[:n], inputs[n : n + m], inputs[n + m :]

    def step(carry: list[Any], row: list[Any]) -> tuple[list[Any], list[Any]]:
        args = [
            *constants,
            *(Value(a, True) for a in carry),
            *(Value(a, v.laned) for a, v in zip(row, rows, strict=True)),
        ]
        results = _spread_all(_evaluate(body, args, width), body.jaxpr.outvars, width)
        return results[:m], results[m:]

    first = _spread_all(start, equation.invars[n : n + m], width)
    options = {k: p[k] for k in ("length", "reverse", "unroll")}
    end, outputs = lax.scan(step, first, [v.array for v in rows], **options)
    return [*end, *outputs]


def _names(text: str) -> frozenset[str]:
    return frozenset(text.split())


CALLED = ("jaxpr", "call_jaxpr", "fun_jaxpr")
CALLS = _names(
    "jit pjit closed_call core_call checkpoint remat remat2 "
    "custom_jvp_call custom_vjp_call custom_vjp_call_jaxpr"
)
"""Operations that call a jaxpr: it is evaluated in their place. (Rules for derivatives have done their work.)"""

ELEMENTWISE = _names(
    "abs acos acosh add add_any and asin asinh atan atan2 atanh cbrt ceil clamp convert_element_type copy cos cosh "
    "div eq erf exp exp2 expm1 floor ge gt integer_pow is_finite le log log1p logistic lt max min mul ne neg not or "
    "pow rem round rsqrt select_n sign sin sinh sqrt square stop_gradient sub tan tanh xor"
)
"""Operations on each element of arrays of one shape, among which there may be single numbers."""

RULES: dict[str, Callable[[Any, list[Value], int], list[Any]]] = {
    "broadcast_in_dim": _broadcast,
    "concatenate": _same_axes,
    "dot_general": _dot,
    "pad": _pad,
    "reduce_and": _same_axes,
    "reduce_max": _same_axes,
    "reduce_min": _same_axes,
    "reduce_or": _same_axes,
    "reduce_prod": _same_axes,
    "reduce_sum": _same_axes,
    "reshape": _reshape,
    "rev": _same_axes,
    "scan": _scan,
    "slice": _slice,
    "split": _same_axes,
    "squeeze": _same_axes,
    "stack": _same_axes,
    "transpose": _transpose,
    "unstack": _same_axes,
}
