"""Loops and branches of instances that `jax.vmap` puts side by side.

`jax.vmap` of a loop with an end of its own for each instance chooses between the whole new state and the old one, for
every instance and after every pass: it copies all that a loop has collected. Here a loop's body is told which instances
still run and leaves the others alone, so that nothing needs to be chosen. They have derivatives in forward mode.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TypeVar

import jax
import jax.numpy as jnp
from jax import lax
from jax.custom_batching import custom_vmap, sequential_vmap
from jaxtyping import Array, Bool

from acausal._jax.xla import compiles_small_loops

State = TypeVar("State")


@custom_vmap
def any_of(flag: Bool[Array, ""]) -> Bool[Array, ""]:
    """Whether a flag is set in any of the instances side by side."""
    return flag


@any_of.def_vmap
def _any_of(size: int, in_batched: list[bool], flag: Array) -> tuple[Array, bool]:
    del size
    return any_of(jnp.any(flag, axis=0) if in_batched[0] else flag), False


@custom_vmap
def own(flag: Bool[Array, ""]) -> Bool[Array, ""]:
    """Where `any_of` a flag is true, the flag of this instance: true, and known to be, where it is the only one."""
    return jnp.ones_like(flag)


@own.def_vmap
def _own(size: int, in_batched: list[bool], flag: Array) -> tuple[Array, bool]:
    del size
    return (flag, True) if in_batched[0] else (own(flag), False)


def one_by_one(function: Callable[..., State]) -> Callable[..., State]:
    """The same function; mapped by `jax.vmap`, its instances are computed one after the other where that is faster.

    It is where XLA compiles the loops of an instance as a whole, and instances need not wait for each other in them.
    The function is one of pytrees of arrays, and must not close over values that JAX traces.
    """
    if not compiles_small_loops():
        return function
    return sequential_vmap(jax.jit(function, inline=True))  # mapping it traces it again and again


def while_any(
    goes_on: Callable[[State], Bool[Array, ""]],
    body: Callable[[State, Bool[Array, ""]], State],
    start: State,
) -> State:
    """`lax.while_loop` of instances that end one by one.

    Arguments:
        goes_on: whether an instance does, by its state.
        body: one pass, by the state and whether the instance still runs; if it does not, the state must stay as it is.
        start: the first state.
    """
    return lax.while_loop(lambda s: any_of(goes_on(s)), lambda s: body(s, own(goes_on(s))), start)


def either(condition: Bool[Array, ...], one: State, other: State) -> State:
    """`jnp.where` of the leaves of two pytrees of one form."""
    return jax.tree.map(partial(_where, condition), one, other)


def _where(condition: Bool[Array, ...], one: Array, other: Array) -> Array:
    """`jnp.where`, as one operation where nothing need be converted: programs have hundreds of them."""
    one, other = jnp.asarray(one), jnp.asarray(other)
    as_it_is = condition.ndim == 0 and one.shape == other.shape and one.dtype == other.dtype
    return lax.select(condition, one, other) if as_it_is else jnp.where(condition, one, other)


def cond_any(
    flag: Bool[Array, ""], then: Callable[[], State], otherwise: Callable[[], State]
) -> State:
    """`lax.cond` whose first branch is computed only if one of the instances needs it."""

    def chosen() -> State:
        mine = own(flag)
        return either(mine, then(), otherwise())

    return lax.cond(any_of(flag), chosen, otherwise)
