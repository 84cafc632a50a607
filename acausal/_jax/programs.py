"""Functions that JAX compiles, of whose programs those that were used last are kept.

`jax.jit` remembers a program for every model and every shape as long as the function lives. In a notebook of a day, or
a server of a week, models come and go; their programs would be 2 MB each that nobody can use again.
"""

from __future__ import annotations

import gc
from collections import OrderedDict
from collections.abc import Callable, Generator
from contextlib import contextmanager, nullcontext
from functools import wraps
from typing import Any, ParamSpec, TypeVar

import jax
import numpy as np

P = ParamSpec("P")
Result = TypeVar("Result")

MOST = 128
"""So many programs are kept, of all functions together."""

ARRAYS = jax.Array, np.ndarray, np.generic

_programs: OrderedDict[tuple[Any, ...], Callable[[list[Any]], Any]] = OrderedDict()


def compiled(function: Callable[P, Result]) -> Callable[P, Result]:
    """The function, compiled by `jax.jit`: arrays are traced, and what else there is in its arguments is constant.

    Arguments:
        function: pure, of pytrees whose other leaves can be hashed; its result consists of arrays.
    """
    untyped: Callable[..., Result] = function

    @wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> Result:
        leaves, tree = jax.tree.flatten((args, kwargs))
        kinds = tuple(map(_kind, leaves))
        key = function, tree, kinds
        arrays = [leaf for leaf in leaves if isinstance(leaf, ARRAYS)]
        program = _programs.pop(key, None)
        is_new = program is None
        if program is None:
            constants = [None if isinstance(leaf, ARRAYS) else leaf for leaf in leaves]

            def of_arrays(arrays: list[Any]) -> Result:
                rest = iter(arrays)
                given = [next(rest) if leaf is None else leaf for leaf in constants]
                positional, named = jax.tree.unflatten(tree, given)
                return untyped(*positional, **named)

            of_arrays.__name__ = function.__name__
            program = jax.jit(of_arrays)
        _programs[key] = program
        while len(_programs) > MOST:
            _programs.popitem(last=False)
        with collection_paused() if is_new else nullcontext():
            return program(arrays)

    return call


@contextmanager
def collection_paused() -> Generator[None]:
    """No search for cyclic garbage while a model or a program is built: of all that is made there, next to none is."""
    if not gc.isenabled():
        yield
        return
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def _kind(leaf: Any) -> Any:
    """What makes another program: an array's shape and type, or what else it is."""
    if isinstance(leaf, ARRAYS):
        return leaf.shape, leaf.dtype, getattr(leaf, "weak_type", False)
    return type(leaf), leaf
