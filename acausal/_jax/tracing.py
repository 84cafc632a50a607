"""Whether JAX is tracing: values are then unknown, and their checks are skipped. What it traces within a trace."""

from __future__ import annotations

from typing import Any, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array
from jax.core import Tracer
from jax.typing import ArrayLike as JaxArrayLike
from numpy.typing import ArrayLike

from acausal.errors import AcausalError, DataError

Tree = TypeVar("Tree")

# `jax.jit(f, inline=INLINED)` puts the equations of f into what is being traced, not a call. JAX 0.12 does so only for
# a name that earlier versions lack: there, `inline=True` waits until the whole is lowered.
_inline: Any = getattr(jax, "Inline", None)
INLINED: Any = True if _inline is None else _inline.JAX_EARLY


def traced(*trees: object) -> bool:
    """Whether any leaf stands for a value that is not known yet."""
    return any(isinstance(leaf, Tracer) for leaf in jax.tree.leaves(trees))


def differentiated(*trees: object) -> bool:
    """Whether derivatives by any leaf may be wanted: JAX traces it, and not only to map.

    JAX does not document how its tracers hold values. Where it changes that, derivatives may be wanted.
    """
    return any(isinstance(_unmapped(leaf), Tracer) for leaf in jax.tree.leaves(trees))


def _unmapped(leaf: Any) -> object:
    while isinstance(leaf, Tracer) and hasattr(leaf, "batch_dim") and hasattr(leaf, "val"):
        leaf = leaf.val
    return leaf


def need_known(
    function: str, *given: object, error: type[AcausalError] = DataError, computes: bool = True
) -> None:
    """Refuse to work where JAX traces: for functions that need numbers, or write files.

    Arguments:
        function: that was called, for the message.
        given: what must be known.
        error: the class of the error.
        computes: whether the function computes with JAX, so that within `jax.jit` all that it finds is traced.

    Raises:
        AcausalError: of the class ``error``.
    """
    if traced(given) or (computes and traced(jnp.zeros(()))):
        raise error(
            f"{function} needs numbers, which JAX does not know while it traces: call it outside of jax.jit, jax.vmap "
            "and jax.grad."
        )


def known(tree: Tree) -> Tree | None:
    """The values that JAX differentiates at, where it does so step by step; ``None`` where it compiles or maps.

    JAX does not document how its tracers hold these values. Where it changes that, they are not known.
    """

    def value(leaf: object) -> object:
        while isinstance(leaf, Tracer) and hasattr(leaf, "primal"):
            leaf = leaf.primal
        return leaf

    found = jax.tree.map(value, tree)
    return None if traced(found) else found


def without_derivatives(tree: Tree) -> Tree:
    """The same values, whose derivatives do not count; what is not an array stays as it is."""
    return jax.tree.map(lambda v: jax.lax.stop_gradient(v) if eqx.is_array(v) else v, tree)


def array(value: ArrayLike | JaxArrayLike, dtype: Any = float) -> Array:
    """A value as an array; where it is known, it stays so within what JAX traces.

    `jnp.asarray` compiles a program for every new shape that it is given outside of `jax.jit`, this does not.
    """
    if traced(value):
        return jnp.asarray(value, dtype)
    with jax.ensure_compile_time_eval():
        if isinstance(value, Array):
            return jnp.asarray(value, dtype)
        return jax.device_put(np.asarray(value, dtype))


def select(values: Array, index: Any) -> Array:
    """``values[index]``; JAX compiles a program for it, unless the values are known."""
    return values[index] if traced(values) else array(np.asarray(values)[index], values.dtype)


def numpy_or_jax(*trees: object) -> Any:
    """The module whose functions compute with some values: NumPy where they are known, JAX where it traces.

    JAX compiles each operation for every new shape that it is given outside of `jax.jit`.
    """
    return jnp if traced(*trees) else np
