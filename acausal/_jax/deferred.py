"""Functions that are traced when a program is compiled, and only if it calls them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import jax
from jax import Array
from jax.core import ShapedArray
from jax.extend.core import Primitive
from jax.interpreters import batching, mlir
from jaxtyping import PyTree

Function = Callable[..., Sequence[Array]]


def deferred(function: Function, like: Sequence[Any]) -> Callable[..., list[Array]]:
    """The same function of pytrees of arrays, as one operation of a program until that is compiled.

    JAX traces both a linear function and its transpose, and maps both, whichever of them a program calls in the end.
    Of a long function this takes many seconds. It must not close over values that JAX traces, and has no derivatives;
    its results have the shapes and types of ``like``.
    """
    shapes = tuple(jax.ShapeDtypeStruct(a.shape, a.dtype) for a in like)

    def call(*args: PyTree) -> list[Array]:
        values, tree = jax.tree.flatten(args)
        of_values = lambda *values: function(*jax.tree.unflatten(tree, values))  # noqa: E731
        return _call.bind(*values, function=of_values, like=shapes)

    return call


_call = Primitive("deferred")
_call.multiple_results = True


@_call.def_impl
def _now(*values: Array, function: Function, like: Sequence[Any]) -> Sequence[Array]:
    del like
    return jax.jit(function)(*values)


@_call.def_abstract_eval
def _shapes(*values: Any, function: Function, like: Sequence[Any]) -> list[Any]:
    del values, function
    return [ShapedArray(a.shape, a.dtype) for a in like]


def _mapped(
    values: Sequence[Array], axes: Sequence[Any], *, function: Function, like: Sequence[Any]
) -> tuple[list[Array], list[int]]:
    (size,) = {v.shape[a] for v, a in zip(values, axes, strict=True) if a is not None}
    mapped = jax.vmap(function, tuple(axes), axis_size=size)
    shapes = [jax.ShapeDtypeStruct((size, *a.shape), a.dtype) for a in like]
    found = deferred(mapped, shapes)(*values)
    return found, [0] * len(found)


def _lowered(context: Any, *values: Any, function: Function, like: Sequence[Any]) -> Any:
    del like
    return mlir.lower_fun(function, multiple_results=True)(context, *values)


batching.primitive_batchers[_call] = _mapped
mlir.register_lowering(_call, _lowered)
