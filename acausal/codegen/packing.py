"""Pack parameters: a flat dict for the user, a few arrays for the program.

`pack` turns ``{"body.m": 350.0, ..., "spring_nn.net": module}`` into a `Packed`, in which equal parameters of equal
components lie side by side and bound parameters are computed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array
from jax.core import Tracer
from jaxtyping import Float

from acausal._jax import array, as_key, compiled, traced
from acausal.codegen.parameters import ParameterLayout
from acausal.codegen.reading import compute
from acausal.codegen.values import Packed
from acausal.errors import DataError, DeclarationError, listing, shown
from acausal.modeling import by_element

FEW = 64
"""Formulas that are compiled as one program. Of more, each operation is one: in long chains these are the same ones."""


def default_parameters(layout: ParameterLayout, key: Array | None) -> dict[str, Any]:
    """The model's own parameter values; modules are made with keys split from ``key`` (``None``: there are none)."""
    values: dict[str, Any] = dict(zip(layout.names, layout.model.value[layout.free], strict=True))
    own = layout.own_modules
    keys = [] if key is None or not len(own) else jax.random.split(key, len(own))
    for name, index, k in zip(layout.module_names, own, keys, strict=False):
        values[name] = _make(name, layout.model.module_values[index], k)
    return values


def _make(name: str, value: Any, key: Array) -> Any:
    if isinstance(value, eqx.Module):
        return value
    try:
        module = value(key)
    except TypeError as error:
        raise DeclarationError(
            f"'{name}': a function is called with a key and gives a module, but this one fails "
            f"({str(error).splitlines()[0]}); give a law of your own as an equinox module"
        ) from error
    if not callable(module):
        raise DeclarationError(
            f"'{name}': the function gave {type(module).__name__}, not a callable module"
        )
    return module


def pack(layout: ParameterLayout, params: Mapping[str, Any] | Packed) -> Packed:
    """Collect a parameter dict into arrays; what it lacks is the model's own, networks those of key 0.

    Raises:
        DataError: for an unknown name, what is not a number or is outside of its declared range.
    """
    if isinstance(params, Packed):
        return params
    if not isinstance(params, Mapping):
        raise DataError(f"params are numbers and networks by name, not {shown(params)}")
    params = _by_element(layout, params)
    layout.check_names(params)
    if any(name not in params for name in layout.module_names):
        params = {**default_parameters(layout, as_key(0)), **params}
    own = layout.model.value[layout.free]
    given = [params.get(name, value) for name, value in zip(layout.names, own, strict=True)]
    wrong = [n for n, v in zip(layout.names, given, strict=True) if not _is_number(v)]
    if wrong:
        raise DataError(f"params: {listing(wrong)} must be numbers, got {shown(params[wrong[0]])}")
    known = np.asarray([np.nan if isinstance(v, Tracer) else v for v in given], dtype=float)
    unknown = np.flatnonzero(np.isnan(known)).tolist()
    if nan := [layout.names[i] for i in unknown if not isinstance(given[i], Tracer)]:
        raise DataError(f"params: {listing(nan)} must be numbers, got nan.")
    if clause := layout.out_of_range(known):
        raise DataError(f"params: {clause}.")
    values = bind(layout, _as_array([given[i] for i in layout.order], known[layout.order]))
    laws = [n for n in layout.module_names if not callable(params[n])]
    if laws:
        raise DataError(f"params: {listing(laws)} must be networks, got {shown(params[laws[0]])}")
    modules = layout.fixed_modules | {
        i: params[name] for i, name in zip(layout.own_modules, layout.module_names, strict=True)
    }
    # one that many components share stands once, at its own place
    return Packed(values, tuple(modules.get(i) for i in range(len(layout.module_of))))


def _by_element(layout: ParameterLayout, params: Mapping[str, Any]) -> Mapping[str, Any]:
    """Parameters, with arrays by their elements, but for those that are folded and given as the zeros they are."""
    if layout.all_names.issuperset(params):
        return params
    model = layout.model
    folded = {model.layout.parameter(int(i)) for i in np.flatnonzero(model.folded)}
    found = by_element(params, layout.all_names | folded, "params")
    zeros = {
        name
        for name in folded & (found.keys() - params.keys())
        if not traced(found[name]) and np.array_equal(found[name], 0)
    }
    return {name: value for name, value in found.items() if name not in zeros}


def _as_array(given: Sequence[Any], known: Float[np.ndarray, " n_free"]) -> Float[Array, " n_free"]:
    """Numbers as an array, in which neighbours that are known are one constant, however many they are."""
    if not any(isinstance(value, Tracer) for value in given):
        return array(known)
    runs = groupby(range(len(given)), lambda i: isinstance(given[i], Tracer))
    pieces = [
        jnp.stack([jnp.asarray(given[i], dtype=float) for i in run])
        if traced
        else array(known[list(run)])
        for traced, run in runs
    ]
    return jnp.concatenate(pieces)


def bind(layout: ParameterLayout, free: Array) -> Array:
    """All parameters and constants, shape (n_values,), from those that are free, in the program's order."""
    at_once = 0 < len(layout.bound) <= FEW and not traced(free)
    return (compiled(_bind) if at_once else _bind)(layout, free)


def _bind(layout: ParameterLayout, free: Array) -> Array:
    arrays = [free]
    none = Packed(free, ())
    for formula in layout.bound:
        arrays.append(compute(formula, none, arrays))
    if len(layout.constants):
        arrays.append(jnp.asarray(layout.constants, free.dtype))
    return jnp.concatenate([jnp.atleast_1d(a) for a in arrays]) if len(arrays) > 1 else free


def _is_number(value: Any) -> bool:
    if isinstance(value, float | int):
        return isinstance(value, float) or abs(value) < 2**1023
    return isinstance(value, np.ndarray | np.number | jax.Array) and np.ndim(value) == 0
