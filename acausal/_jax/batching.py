"""Batch: compute a few instances of a loop side by side, one such group after the other.

`jax.vmap` widens every operation of a loop to the whole batch, and its arrays then go through memory. A loop over
`WIDTH` instances in `lanes` fits into a processor's first caches and is compiled as a whole (`acausal._jax.xla`).
"""

from __future__ import annotations

from collections.abc import Sequence

import jax
import jax.numpy as jnp
from jax import Array, lax
from jax.custom_batching import custom_vmap
from jax.extend.core import Jaxpr

from acausal._jax import primitives
from acausal._jax.lanes import Flat, lanes
from acausal._jax.primitives import Equation, UnknownEquationError
from acausal._jax.xla import compiles_small_loops

WIDTH = 8
"""Instances side by side: as many numbers as a vector register holds, or a few."""

LARGEST = 16_384
"""Most elements of an array in a loop whose instances are put side by side; larger arrays keep libraries busy."""

MOST = 4_000
"""The most operations in a loop that is compiled as a whole: the time to compile grows with them."""


def batched(function: Flat) -> Flat:
    """The same function; mapped by `jax.vmap`, it is computed for a few instances at a time where that pays.

    It can be differentiated, and its derivatives are mapped as usual. It takes arrays and returns a list of arrays, and
    must not close over values that JAX traces.
    """

    @custom_vmap
    def call(*args: Array) -> list[Array]:
        return list(function(*args))

    @call.def_vmap
    def mapped(size: int, in_batched: list[bool], *args: Array) -> tuple[list[Array], list[bool]]:
        results = _in_groups(function, size, in_batched, args)
        if results is None:
            axes = [0 if has else None for has in in_batched]
            results = list(jax.vmap(function, axes, axis_size=size)(*args))
        return results, [True] * len(results)

    @jax.custom_jvp
    def differentiable(*args: Array) -> list[Array]:
        return call(*args)

    @differentiable.defjvp
    def derivative(
        args: tuple[Array, ...], tangents: tuple[Array, ...]
    ) -> tuple[list[Array], list[Array]]:
        return jax.jvp(lambda *a: list(function(*a)), args, tangents)

    return differentiable


def _in_groups(
    function: Flat, size: int, in_batched: Sequence[bool], args: Sequence[Array]
) -> list[Array] | None:
    """The results of a batch, `WIDTH` instances at a time; None if that does not pay or a jaxpr cannot be read."""
    width = min(size, WIDTH)
    groups = -(-size // width)

    def cut(array: Array) -> Array:
        """(size, ...) -> (groups, ..., width); the last instance is repeated to fill the last group."""
        rest = jnp.broadcast_to(array[-1:], (groups * width - size, *array.shape[1:]))
        rows = jnp.concatenate([array, rest]).reshape(groups, width, *array.shape[1:])
        return jnp.moveaxis(rows, 1, -1)

    def join(array: Array) -> Array:
        rows = jnp.moveaxis(array, -1, 1)
        return rows.reshape(groups * width, *rows.shape[2:])[:size]

    def filled(group: Sequence[Array]) -> list[Array]:
        own = iter(group)
        return [next(own) if has else a for a, has in zip(args, in_batched, strict=True)]

    side_by_side = lanes(function, in_batched, width)
    rows = [cut(a) for a, has in zip(args, in_batched, strict=True) if has]
    try:
        traced = jax.make_jaxpr(side_by_side)(*filled([r[0] for r in rows]))
    except UnknownEquationError:
        return None
    if not is_small(traced.jaxpr):
        return None
    one_group = primitives.as_function(traced, traced.consts)
    return [join(r) for r in lax.map(lambda group: one_group(*filled(group)), rows)]


def is_small(jaxpr: Jaxpr, in_loop: bool = False) -> bool:
    """Whether XLA will compile the loops of a jaxpr, which may be part of a loop itself, as a whole."""
    equations = list(primitives.all_equations(jaxpr, in_loop))
    return (
        len(equations) <= MOST
        and all(_is_small(*found) for found in equations)
        and compiles_small_loops()
    )


def operations(jaxpr: Jaxpr) -> int:
    """How many operations a jaxpr has, including those of its inner ones."""
    return sum(1 for _ in primitives.all_equations(jaxpr))


def _is_small(equation: Equation, in_loop: bool) -> bool:
    name = primitives.name_of(equation)
    if name not in primitives.COMPILED or not primitives.is_readable(equation):
        return False
    if name == primitives.DOT and min(map(len, primitives.shapes(equation.invars))) > 1:
        return False
    return not in_loop or primitives.largest(equation) <= LARGEST
