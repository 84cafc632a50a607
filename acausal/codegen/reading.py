"""Fill and compute formulas with JAX: elements of arrays as slices where they lie evenly, parameters, modules."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import jax.numpy as jnp
import numpy as np
import sympy as sp
from jax import Array, lax
from jax.typing import ArrayLike

from acausal.codegen.gather import Gather, IndexRuns, Interleaved, One, Signed, Take
from acausal.codegen.instructions import Accumulate, Arguments, ArrayFormula
from acausal.codegen.lower import ModuleValue, collect, evaluate
from acausal.codegen.values import Packed
from acausal.modeling import INITIAL, time

Arrays = Sequence[Array]

ELEMENTS = lax.GatherDimensionNumbers(
    offset_dims=(), collapsed_slice_dims=(0,), start_index_map=(0,)
)
"""Single elements of an array of one axis."""


def read_elements(gather: Gather, arrays: Arrays) -> Array:
    """The elements that a gather selects, shape (n,); a scalar where all instances share one."""
    return _READ[type(gather)](gather, arrays)


def fill(
    arguments: Arguments, packed: Packed, arrays: Arrays = (), t: ArrayLike = 0.0
) -> dict[sp.Symbol, Any]:
    """The values in the slots of a formula, from parameters, the arrays that its variables are read in, and time."""
    filled: dict[sp.Symbol, Any] = {time: t}
    filled |= {symbol: read_elements(g, arrays) for symbol, g in arguments.variables}
    filled |= {symbol: read_parameters(g, packed) for symbol, g in arguments.parameters}
    for symbol, chosen in arguments.modules:
        modules = [packed.modules[i] for i in chosen]
        same, one = len(set(chosen)) == 1, modules[0]
        own = one if isinstance(one, ModuleValue) else ModuleValue(one)
        filled[symbol] = own if same else collect(modules)
    return filled


def compute(
    formula: ArrayFormula,
    packed: Packed,
    arrays: Arrays = (),
    t: ArrayLike = 0.0,
    initial: ArrayLike = 0.0,
) -> Array:
    """The value of a formula, shape (size,), or a scalar; ``initial`` is 1 while initial values are being found."""
    filled = {**fill(formula.arguments, packed, arrays, t), INITIAL: initial}
    value = jnp.asarray(evaluate(formula.expression, filled))
    return value if formula.size == 1 else jnp.broadcast_to(value, (formula.size,))


def add_up(one: Accumulate, terms: ArrayLike) -> Array:
    """A sum, shape (size,), or a scalar, from all its terms."""
    found = jnp.broadcast_to(terms, (one.terms * one.size,)).reshape(one.terms, one.size)
    total = (found * jnp.asarray(one.weights, found.dtype)).sum(axis=0)
    return total[0] if one.size == 1 else total


def read_parameters(gather: Gather, packed: Packed) -> Array:
    """Values of parameters; zero for those that are folded out of the equations."""
    folded = [jnp.zeros((), packed.values.dtype)] if 1 in gather.sources else []
    return read_elements(gather, [packed.values, *folded])


def _one(gather: One, arrays: Arrays) -> Array:
    array = arrays[gather.source]
    return array if jnp.ndim(array) == 0 else array[gather.index]


def _runs(gather: IndexRuns, arrays: Arrays) -> Array:
    pieces = [
        _slice(arrays[source], start, step, length) for source, start, step, length in gather.runs
    ]
    if not pieces:
        return jnp.zeros(0)
    return pieces[0] if len(pieces) == 1 else jnp.concatenate(pieces)


def _slice(array: Array, start: int, step: int, length: int) -> Array:
    if jnp.ndim(array) == 0:
        return array[None]
    if step == 1 and start == 0 and length == array.shape[0]:
        return array
    return array[start : start + step * (length - 1) + 1 : step]


def _interleaved(gather: Interleaved, arrays: Arrays) -> Array:
    return jnp.stack([_runs(column, arrays) for column in gather.columns], axis=1).ravel()


def _take(gather: Take, arrays: Arrays) -> Array:
    pieces = [jnp.atleast_1d(arrays[s]) for s in gather.sources]
    whole = pieces[0] if len(pieces) == 1 else jnp.concatenate(pieces)
    return taken(whole, gather.index)


def taken(whole: Array, index: np.ndarray) -> Array:
    """``whole[index]`` in one operation, where JAX would write five: it knows of no index that it is not negative."""
    return lax.gather(
        whole,
        index[:, None].astype(np.int32),
        ELEMENTS,
        slice_sizes=(1,),
        unique_indices=len(np.unique(index)) == len(index),
        mode="promise_in_bounds",
    )


def _signed(gather: Signed, arrays: Arrays) -> Array:
    return read_elements(gather.elements, arrays) * gather.signs


_READ: dict[type, Callable[[Any, Arrays], Array]] = {
    One: _one,
    IndexRuns: _runs,
    Interleaved: _interleaved,
    Take: _take,
    Signed: _signed,
}
