"""Read arguments with JAX: elements of arrays as slices where they lie evenly, parameters, modules."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import jax.numpy as jnp
import numpy as np
import sympy as sp
from jax import Array

from acausal.codegen.gather import Gather, Interleaved, One, Runs, Take
from acausal.codegen.instructions import Arguments
from acausal.codegen.lower import ModuleValue, collect
from acausal.codegen.parameters import ParameterLayout
from acausal.codegen.values import Packed, Values
from acausal.flattening import Integers
from acausal.modeling import time

Arrays = Sequence[Array]


def read_elements(gather: Gather, arrays: Arrays) -> Array:
    """The elements that a gather selects, shape (n,); a scalar where all instances share one."""
    return _READ[type(gather)](gather, arrays)


def read_arguments(arguments: Arguments, values: Values, arrays: Arrays) -> dict[sp.Symbol, Any]:
    """The values in the slots of a formula."""
    packed = values.packed
    filled: dict[sp.Symbol, Any] = {time: values.t}
    filled |= {symbol: read_elements(g, arrays) for symbol, g in arguments.variables}
    filled |= {symbol: read_elements(g, [packed.values]) for symbol, g in arguments.parameters}
    filled |= {symbol: chosen_module(packed, chosen) for symbol, chosen in arguments.modules}
    return filled


def read_parameters(layout: ParameterLayout, parameters: Integers | int, packed: Packed) -> Array:
    """Values of parameters, in the shape of their numbers; zero for those that are folded out of the equations."""
    position = layout.position[parameters]
    if not (position >= 0).any():
        return jnp.zeros(np.shape(parameters), packed.values.dtype)
    return jnp.where(position >= 0, packed.values[position], 0.0)


def chosen_module(packed: Packed, chosen: Sequence[int]) -> ModuleValue:
    """The module of one instance or of all; those of several instances side by side."""
    if len(set(chosen)) == 1:
        return ModuleValue(packed.modules[chosen[0]])
    return collect([packed.modules[i] for i in chosen])


def _one(gather: One, arrays: Arrays) -> Array:
    array = arrays[gather.source]
    return array if jnp.ndim(array) == 0 else array[gather.index]


def _runs(gather: Runs, arrays: Arrays) -> Array:
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
    unique = len(np.unique(gather.index)) == len(gather.index)
    return whole.at[gather.index].get(mode="promise_in_bounds", unique_indices=unique)


_READ: dict[type, Callable[[Any, Arrays], Array]] = {
    One: _one,
    Runs: _runs,
    Interleaved: _interleaved,
    Take: _take,
}
