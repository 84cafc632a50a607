"""Lanes: evaluate a function for several instances side by side, with the instances along the last axis.

`jax.vmap` puts instances first. A processor's vector registers hold neighbours in memory. With the instances last,
every operation on one number, or on one element of an array, becomes an operation on neighbours: a small network
is four times as fast. A function is traced and its equations are evaluated one by one by a table of rules; an
operation without a rule goes through `jax.vmap`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

import jax
import jax.numpy as jnp
from jax import Array, lax
from jax.extend.core import ClosedJaxpr, Literal, Var

from acausal._jax import primitives
from acausal._jax.primitives import Equation, UnknownEquationError, bind

Flat = Callable[..., Sequence[Array]]
"""A function of arrays that returns several."""

Shape = tuple[int, ...]

SUM = 2048
"""Elements in a sum that XLA still compiles itself; more go to a library."""


class LaneValue(NamedTuple):
    """An array, and whether its last axis is that of the lanes; if not, all lanes share it."""

    array: Array
    laned: bool


LaneRule: TypeAlias = Callable[[Equation, list[LaneValue], int], list[Array]]
"""(equation, inputs, width) -> arrays with lanes; at least one input has lanes."""


def lanes(function: Flat, laned: Sequence[bool], width: int) -> Flat:
    """The function for ``width`` instances.

    Arguments:
        function: of arrays; returns several arrays.
        laned: per argument, whether it gets a last axis for the instances.
        width: number of instances.

    Returns:
        A function of the same arguments with that axis; all of its results have it. It raises
        `UnknownEquationError` while it is traced if this version of JAX writes an operation in an unknown way; map the
        function by `jax.vmap` then.
    """

    def side_by_side(*args: Array) -> list[Array]:
        one = [
            jax.ShapeDtypeStruct(a.shape[:-1] if has else a.shape, a.dtype)
            for a, has in zip(args, laned, strict=True)
        ]
        traced = jax.make_jaxpr(function)(*one)
        values = [LaneValue(a, has) for a, has in zip(args, laned, strict=True)]
        try:
            results = _evaluate(traced, values, width)
            return _widen_all(results, primitives.shapes(traced.jaxpr.outvars), width)
        except UnknownEquationError:
            raise
        except (
            Exception
        ) as error:  # the function itself could be traced: its jaxpr is what was misread
            raise UnknownEquationError(f"{type(error).__name__}: {error}") from error

    return side_by_side


def _evaluate(closed: ClosedJaxpr, args: Sequence[LaneValue], width: int) -> list[LaneValue]:
    """The results of a closed jaxpr."""
    jaxpr = closed.jaxpr
    known: dict[Var, LaneValue] = dict(
        zip(jaxpr.constvars, (LaneValue(c, False) for c in closed.consts), strict=True)
    )
    known |= dict(zip(jaxpr.invars, args, strict=True))

    def read(atom: Var | Literal) -> LaneValue:
        return LaneValue(atom.val, False) if isinstance(atom, Literal) else known[atom]

    for equation in jaxpr.eqns:
        inputs = [read(atom) for atom in equation.invars]
        known |= dict(zip(equation.outvars, _apply(equation, inputs, width), strict=True))
    return [read(atom) for atom in jaxpr.outvars]


def _apply(equation: Equation, inputs: list[LaneValue], width: int) -> list[LaneValue]:
    name = primitives.name_of(equation)
    if name in primitives.CALLS:
        return _evaluate(primitives.called(equation), inputs, width)
    if not any(v.laned for v in inputs):
        return [LaneValue(a, False) for a in bind(equation, [v.array for v in inputs])]
    results = RULES.get(name, _vmapped)(equation, inputs, width)
    expected = [(*shape, width) for shape in primitives.shapes(equation.outvars)]
    if [a.shape for a in results] != expected:
        raise UnknownEquationError(f"'{name}' has results of other shapes than {expected}")
    return [LaneValue(a, True) for a in results]


def _widen(value: LaneValue, shape: Shape, width: int) -> Array:
    """The value with lanes and of that shape; a single number fills it."""
    array = jnp.asarray(value.array)
    target = (*shape, width)
    if array.shape == target and value.laned:
        return array
    own = array.ndim - value.laned
    kept = tuple(range(own)) + ((len(shape),) if value.laned else ())
    return lax.broadcast_in_dim(array, target, kept)


def _widen_all(values: Sequence[LaneValue], shapes: Sequence[Shape], width: int) -> list[Array]:
    return [_widen(v, shape, width) for v, shape in zip(values, shapes, strict=True)]


# -- rules -------------------------------------------------------------------------------------------


def _elementwise(equation: Equation, inputs: list[LaneValue], width: int) -> list[Array]:
    (shape,) = primitives.shapes(equation.outvars)
    return bind(equation, [_widen(v, shape, width) for v in inputs])


def _same_axes(equation: Equation, inputs: list[LaneValue], width: int) -> list[Array]:
    """Parameters that count axes from the front stay right with one more at the end."""
    return bind(equation, _widen_all(inputs, primitives.shapes(equation.invars), width))


def _vmapped(equation: Equation, inputs: list[LaneValue], width: int) -> list[Array]:
    axes = [-1 if v.laned else None for v in inputs]
    call = jax.vmap(lambda *a: bind(equation, a), axes, -1, axis_size=width)
    return call(*(v.array for v in inputs))


def _broadcast(equation: Equation, inputs: list[LaneValue], width: int) -> list[Array]:
    shape, kept = primitives.parameters(equation)
    return [lax.broadcast_in_dim(inputs[0].array, (*shape, width), (*kept, len(shape)))]


def _reshape(equation: Equation, inputs: list[LaneValue], width: int) -> list[Array]:
    (sizes,) = primitives.parameters(equation)
    return [lax.reshape(inputs[0].array, (*sizes, width))]


def _slice(equation: Equation, inputs: list[LaneValue], width: int) -> list[Array]:
    starts, limits, strides = primitives.parameters(equation)
    strides = None if strides is None else (*strides, 1)
    return [lax.slice(inputs[0].array, (*starts, 0), (*limits, width), strides)]


def _transpose(equation: Equation, inputs: list[LaneValue], width: int) -> list[Array]:
    (order,) = primitives.parameters(equation)
    return [lax.transpose(inputs[0].array, (*order, len(order)))]


def _pad(equation: Equation, inputs: list[LaneValue], width: int) -> list[Array]:
    array, filler = inputs
    if filler.laned:
        return _vmapped(equation, inputs, width)
    (config,) = primitives.parameters(equation)
    return [lax.pad(array.array, filler.array, (*config, (0, 0, 0)))]


def _dot(equation: Equation, inputs: list[LaneValue], width: int) -> list[Array]:
    """A product of matrices or vectors as sums of products of elements."""
    (((left_sum, right_sum), (left_batch, _)),) = primitives.parameters(equation)
    if left_batch:
        return _vmapped(equation, inputs, width)
    (own,) = primitives.shapes(equation.outvars)
    shape = (*own, width)
    left, right = _matrix(inputs[0], left_sum), _matrix(inputs[1], right_sum)
    if left.shape[1] == 1:
        return [jnp.reshape(left * jnp.swapaxes(right, 0, 1), shape)]
    if left.shape[0] < right.shape[0]:
        return [jnp.reshape(jnp.swapaxes(_sums(right, left), 0, 1), shape)]
    return [jnp.reshape(_sums(left, right), shape)]


def _sums(left: Array, right: Array) -> Array:
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


def _matrix(value: LaneValue, summed: Shape) -> Array:
    """(rows, summed, lanes or 1) of an array, one of whose axes may be summed over."""
    array = value.array if value.laned else jnp.expand_dims(value.array, -1)
    free = [i for i in range(array.ndim - 1) if i not in summed]
    array = lax.transpose(array, (*free, *summed, array.ndim - 1))
    columns = math.prod(array.shape[len(free) : -1])
    return array.reshape(-1, columns, array.shape[-1])


def _scan(equation: Equation, inputs: list[LaneValue], width: int) -> list[Array]:
    body, n, m, options = primitives.scan_of(equation.params)
    constants, start, rows = inputs[:n], inputs[n : n + m], inputs[n + m :]

    def step(carry: list[Array], row: list[Array]) -> tuple[list[Array], list[Array]]:
        args = [
            *constants,
            *(LaneValue(a, True) for a in carry),
            *(LaneValue(a, v.laned) for a, v in zip(row, rows, strict=True)),
        ]
        shapes = primitives.shapes(body.jaxpr.outvars)
        results = _widen_all(_evaluate(body, args, width), shapes, width)
        return results[:m], results[m:]

    first = _widen_all(start, primitives.shapes(equation.invars[n : n + m]), width)
    end, outputs = lax.scan(step, first, [v.array for v in rows], **options)
    return [*end, *outputs]


RULES: dict[str, LaneRule] = {
    primitives.BARRIER: _same_axes,
    primitives.BROADCAST: _broadcast,
    primitives.DOT: _dot,
    primitives.PAD: _pad,
    primitives.RESHAPE: _reshape,
    primitives.SCAN: _scan,
    primitives.SLICE: _slice,
    primitives.TRANSPOSE: _transpose,
    **dict.fromkeys(primitives.ELEMENTWISE, _elementwise),
    **dict.fromkeys(primitives.AXES_FROM_THE_FRONT, _same_axes),
}
"""How operations are evaluated with lanes; any other goes through `jax.vmap`."""
