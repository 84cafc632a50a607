"""Derivatives: Jacobians, and functions with one implementation for reverse mode and another for forward mode."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array, lax
from jax.custom_derivatives import SymbolicZero
from jaxtyping import Float, PyTree

from acausal._jax.deferred import deferred
from acausal.errors import DataError

Result = TypeVar("Result")
Tree = TypeVar("Tree")
Linear = Callable[[list[Array]], list[Array]]


def two_modes(
    reverse: Callable[[PyTree], Result], forward: Callable[[PyTree], Result]
) -> Callable[[PyTree], Result]:
    """A function of a pytree that JAX differentiates in both modes, where no single implementation allows it.

    Derivatives in reverse mode cost what those of ``reverse`` cost. Those in forward mode cost an evaluation of
    ``reverse`` besides those of ``forward``, the same function. There are no second derivatives.
    """

    @jax.custom_jvp
    def call(args: PyTree) -> Result:
        return reverse(args)

    def derivative(primals: tuple[PyTree], tangents: tuple[PyTree]) -> tuple[Result, Any]:
        values, tree = jax.tree.flatten(primals[0])
        directions = jax.tree.leaves(tangents[0], is_leaf=is_zero)
        moved = [not is_zero(d) for d in directions]

        def of(function: Callable[[PyTree], Result], values: Sequence[Array]) -> Any:
            """The function of the arguments that move, and these."""

            def of_moved(some: list[Array]) -> tuple[list[Array], Result]:
                result = function(jax.tree.unflatten(tree, merged(values, moved, some)))
                return jax.tree.leaves(eqx.filter(result, eqx.is_inexact_array)), result

            return of_moved, picked(values, moved)

        found, pull, result = jax.vjp(*of(reverse, values), has_aux=True)
        arrays, fixed = eqx.partition((values, pull), eqx.is_array)
        saved = _differentiated_once(arrays)
        given = picked(directions, moved)

        def push(saved: PyTree, directions: list[Array]) -> list[Array]:
            values, _ = eqx.combine(saved, fixed)
            of_moved, some = of(forward, values)
            return jax.jvp(lambda some: of_moved(some)[0], (some,), (directions,))[1]

        def pull_back(saved: PyTree, cotangents: list[Array]) -> list[Array]:
            return eqx.combine(saved, fixed)[1](cotangents)[0]

        pushed = partial(deferred(push, found), saved)
        pulled = partial(deferred(pull_back, given), saved)
        change = iter(_linear(pushed, pulled, given, found))
        return result, jax.tree.map(
            lambda a: (
                next(change) if eqx.is_inexact_array(a) else np.zeros(a.shape, jax.dtypes.float0)
            ),
            result,
        )

    call.defjvp(derivative, symbolic_zeros=True)
    return call


def is_zero(tangent: object) -> bool:
    """Whether JAX knows a derivative to be zero."""
    return isinstance(tangent, SymbolicZero)


def picked(values: Sequence[Array], chosen: Sequence[bool]) -> list[Array]:
    """Those of some values that are chosen."""
    return [v for v, is_chosen in zip(values, chosen, strict=True) if is_chosen]


def scattered(chosen: Sequence[bool], values: Iterable[Array]) -> list[Array | None]:
    """Values in the chosen places, ``None`` in the others."""
    own = iter(values)
    return [next(own) if is_chosen else None for is_chosen in chosen]


def merged(values: Sequence[Array], chosen: Sequence[bool], new: Iterable[Array]) -> list[Array]:
    """The values, with new ones in the chosen places."""
    pairs = zip(values, scattered(chosen, new), strict=True)
    return [v if own is None else own for v, own in pairs]


def _linear(push: Linear, pull: Linear, given: list[Array], like: list[Array]) -> list[Array]:
    """``push(given)`` for JAX, whose transpose is ``pull``: the solution of ``result - push(given) = 0``."""

    def solve(_: object, b: tuple[list[Array], list[Array]]) -> tuple[list[Array], list[Array]]:
        return b[0], _sums(b[1], push(b[0]))

    def transposed(
        _: object, b: tuple[list[Array], list[Array]]
    ) -> tuple[list[Array], list[Array]]:
        return _sums(b[0], pull(b[1])), b[1]

    none = 0.0 * sum(
        (jnp.sum(d) for d in given), jnp.zeros(())
    )  # JAX wants it linear in what is given
    nothing = [jnp.broadcast_to(none.astype(a.dtype), a.shape) for a in like]
    # `symmetric`, although it is not: so JAX does not derive the transpose, which is given, from the first argument
    solved: Any = lax.custom_linear_solve(
        lambda b: b, (given, nothing), solve, transposed, symmetric=True
    )
    return solved[1]


def _sums(left: list[Array], right: list[Array]) -> list[Array]:
    return [a + b for a, b in zip(left, right, strict=True)]


@jax.custom_jvp
def _differentiated_once(tree: Tree) -> Tree:
    return tree


@_differentiated_once.defjvp
def _refuse(primals: tuple[Tree], tangents: tuple[Tree]) -> tuple[Tree, Tree]:
    raise DataError(
        "Adaptive steps have no second derivatives: give dt for fixed steps, "
        "or adjoint=diffrax.ForwardMode() and take derivatives in forward mode only."
    )


def value_and_jacobian(
    function: Callable[[Float[Array, " P"]], Result], at: Float[Array, " P"], axis: int
) -> tuple[Result, Result]:
    """A function's value, of one or more arrays, and Jacobian, in forward mode.

    ``axis`` of the Jacobian belongs to the arguments.
    """

    def push(direction: Float[Array, " P"]) -> tuple[Result, Result]:
        return jax.jvp(function, (at,), (direction,))

    return jax.vmap(push, out_axes=(None, axis))(jnp.eye(len(at), dtype=at.dtype))
