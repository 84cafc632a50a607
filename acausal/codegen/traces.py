"""What JAX has traced of a program is kept: a run with events and its derivative evaluate a model dozens of times.

Each evaluation would take JAX as long as the first. A kept one is copied: the whole is what it would be without.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable
from functools import partial
from typing import Any

import equinox as eqx
import jax
from jax import Array

from acausal._jax import INLINED, known
from acausal.codegen.program import Program
from acausal.codegen.values import Values

Function = Callable[[Program, tuple[int, ...], Values], list[Any]]


class Fixed:
    """What is not an array in a pytree, with None in the place of arrays, as a part of JAX's keys."""

    def __init__(self, tree: Any) -> None:
        self.tree = tree
        leaves, structure = jax.tree.flatten(tree)
        self._key = structure, tuple((type(leaf), leaf) for leaf in leaves)

    def __hash__(self) -> int:
        return hash(self._key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Fixed) and self._key == other._key


def is_array(leaf: object) -> bool:
    """Whether JAX takes it as an array: one of its own, or NumPy's."""
    return hasattr(leaf, "dtype")


def with_kept_traces(function: Function) -> Function:
    """The same function; where JAX traces, it is traced once for a program, what is wanted of it, and kinds of values.

    Where values are known, or what is not an array in them cannot be compared with earlier ones, nothing is kept. The
    function gives some arrays of a program, by the program, their numbers, and the values.
    """

    def call(program: Program, wanted: tuple[int, ...], values: Values) -> list[Any]:
        if known(values) is not None:
            return function(program, wanted, values)
        arrays, rest = eqx.partition(values, is_array)
        fixed = Fixed(rest)
        try:
            hash(fixed)
        except TypeError:
            return function(program, wanted, values)
        if wanted not in program.traces:
            program.traces[wanted] = _jitted(function, weakref.ref(program), wanted)
        return program.traces[wanted](arrays, fixed)

    return call


def _jitted(
    function: Function, program: Callable[[], Program | None], wanted: tuple[int, ...]
) -> Callable[[Values, Fixed], list[Any]]:
    @partial(jax.jit, static_argnums=1, inline=INLINED)
    def evaluate(arrays: Values, fixed: Fixed) -> list[Array | None]:
        own = program()
        assert own is not None, "it is traced while it is used"
        return function(own, wanted, eqx.combine(arrays, fixed.tree))

    return evaluate
