"""Functions that JAX compiles, of whose programs those that were used last are kept.

`jax.jit` remembers a program for every model and every shape as long as the function lives. In a notebook of a day, or
a server of a week, models come and go; their programs would be 2 MB each that nobody can use again.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from contextlib import nullcontext, suppress
from dataclasses import dataclass
from functools import wraps
from inspect import unwrap
from threading import Thread
from typing import Any, ParamSpec, TypeVar

import jax
import numpy as np

from acausal.jobs import collection_paused

P = ParamSpec("P")
Result = TypeVar("Result")

MOST = 128
"""So many programs are kept, of all functions together."""

ARRAYS = jax.Array, np.ndarray, np.generic


@dataclass
class KeptProgram:
    """A function for arguments of some kinds, and the thread that compiles it ahead of its first call."""

    jitted: Any
    is_new: bool = True
    compiling: Thread | None = None


_programs: OrderedDict[tuple[Any, ...], KeptProgram] = OrderedDict()


def compiled(function: Callable[P, Result]) -> Callable[P, Result]:
    """The function, compiled by `jax.jit`: arrays are traced, and what else there is in its arguments is constant.

    What is constant can be hashed; the function is pure, and its result consists of arrays.
    """

    @wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> Result:
        program, arrays = _program(function, args, kwargs)
        if program.compiling is not None:
            program.compiling.join()
            program.compiling = None
        with collection_paused() if program.is_new else nullcontext():
            program.is_new = False
            return program.jitted(arrays)

    return call


def compile_ahead(function: Callable[P, Any], *args: P.args, **kwargs: P.kwargs) -> None:
    """Begin to compile what a `compiled` function needs for such arguments, in a thread; a call waits for it.

    JAX then finds the compiled program. Where another version of it should not, the call compiles once more.
    """
    program, arrays = _program(unwrap(function), args, kwargs)
    if program.is_new and program.compiling is None:
        with collection_paused():
            lowered = program.jitted.lower(arrays)
        program.compiling = Thread(target=_compile, args=(lowered,))
        program.compiling.start()


def _program(function: Callable[..., Any], args: Any, kwargs: Any) -> tuple[KeptProgram, list[Any]]:
    """The program of a function for some arguments, and those of them that it takes."""
    leaves, tree = jax.tree.flatten((args, kwargs))
    key = function, tree, tuple(map(_kind, leaves))
    program = _programs.pop(key, None)
    if program is None:
        constants = [None if isinstance(leaf, ARRAYS) else leaf for leaf in leaves]

        def of_arrays(arrays: list[Any]) -> Any:
            rest = iter(arrays)
            given = [next(rest) if leaf is None else leaf for leaf in constants]
            positional, named = jax.tree.unflatten(tree, given)
            return function(*positional, **named)

        of_arrays.__name__ = function.__name__
        program = KeptProgram(jax.jit(of_arrays))
    _programs[key] = program
    while len(_programs) > MOST:
        _programs.popitem(last=False)
    return program, [leaf for leaf in leaves if isinstance(leaf, ARRAYS)]


def _compile(lowered: Any) -> None:
    with suppress(Exception):  # the call says what is wrong
        lowered.compile()


def _kind(leaf: Any) -> Any:
    """What makes another program: an array's shape and type, or what else it is."""
    if isinstance(leaf, ARRAYS):
        return leaf.shape, leaf.dtype, getattr(leaf, "weak_type", False)
    return type(leaf), leaf
