"""Parameters in files: numbers and trained networks, to be loaded into the model they belong to."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Iterator, Mapping, Sequence
from functools import singledispatch
from typing import TYPE_CHECKING, Any

import equinox as eqx
import numpy as np

from acausal._jax import need_known
from acausal.data.tensors import filled_like, named_arrays, read_arrays, write_arrays
from acausal.errors import DataError, reason, shortened, shown, warn
from acausal.files import need_path
from acausal.modeling import names_in

if TYPE_CHECKING:
    from acausal.system import System

KIND = "parameters of a model, version 1"

REAL = "biuf"
"""The kinds of NumPy's types that are real numbers or truth values."""


def save_params(params: Mapping[str, Any], path: str | os.PathLike[str]) -> None:
    """Save parameters, as `System.parameters` or a `Fit` gives them, in a safetensors file.

    The file is written completely or not at all: if that fails, the old file stays.

    Arguments:
        params: numbers and networks by name.
        path: the file, usually ``….safetensors``.

    Raises:
        DataError: if the file cannot be written, these are not parameters by name and a path, or a value is neither
            numbers nor a network, or is NaN.
    """
    if not isinstance(params, Mapping) or not isinstance(path, str | os.PathLike):
        raise DataError(
            "save_params takes parameters by name, such as fit.params, and then a path, "
            f"not {_kind(params)} and {_kind(path)}."
        )
    file = need_path(path, "save_params")
    need_known("save_params", dict(params), computes=False)
    for name in names_in(params, "save_params"):
        if not (callable(params[name]) or eqx.is_array_like(params[name])):
            raise DataError(
                f"save_params: '{name}' is {shown(params[name])}; give real numbers or networks."
            )
    arrays = named_arrays(dict(params))
    for place, array in arrays.items():
        if array.dtype.kind not in REAL:
            raise DataError(
                f"save_params: '{place}' is of type {array.dtype}; give real numbers or networks."
            )
        if np.isnan(array).any():
            raise DataError(f"save_params: '{place}' has NaN, with which no model runs.")
    about = {"kind": KIND, "settings": dict(_settings(dict(params), ""))}
    try:
        write_arrays(file, arrays, about)
    except OSError as error:
        raise DataError(f"'{path}' cannot be written: {reason(error)}.") from error


def load_params(path: str | os.PathLike[str], model: System | Mapping[str, Any]) -> dict[str, Any]:
    """Load parameters that `save_params` wrote.

    Arguments:
        path: the file.
        model: the model they belong to; or, if networks were replaced by others than the model's own,
            parameters like those that were saved.

    Raises:
        DataError: if the file cannot be read, is damaged, or belongs to another model; or if its numbers are NaN, or
            infinite where the model's own are not.

    Warns:
        UserWarning: of values outside of the bounds that the model declares, to which a training may lead.
    """
    if not isinstance(path, str | os.PathLike) or not (
        isinstance(model, Mapping) or hasattr(model, "parameters")
    ):
        raise DataError(
            "load_params takes a path and then a compiled model, or parameters by name, "
            f"not {_kind(path)} and {_kind(model)}."
        )
    file = need_path(path, "load_params")
    like: dict[str, Any] = dict(model) if isinstance(model, Mapping) else model.parameters()
    arrays, about = read_arrays(file)
    if about.get("kind") != KIND:
        raise DataError(
            f"'{path}' does not hold {KIND}, but: {about.get('kind', 'something unnamed')}."
        )
    settings: Any = about.get("settings")
    if not isinstance(settings, Mapping):
        raise DataError(f"'{path}' does not say which settings its networks have: it is damaged.")
    for name in sorted(
        arrays.keys() & like.keys()
    ):  # a user may have given a whole number, or one in single precision
        if not callable(like[name]) and (own := np.asarray(like[name]).dtype).kind == "f":
            arrays[name] = arrays[name].astype(own)
    like = {n: like_saved(leaf, _settings_of(n, settings)) for n, leaf in like.items()}
    params = filled_like(like, arrays, f"'{path}'")
    for place, here in _settings(like, ""):
        there = settings.get(place, here)
        if there != here:
            raise DataError(
                f"'{path}' has '{place}' as {there}, but here it is {here}: it belongs to another network."
            )
    own = named_arrays(like)
    for place, array in arrays.items():
        if (np.isnan(array) | (np.isinf(array) & ~np.isinf(own[place]))).any():
            raise DataError(f"'{path}': '{place}' is not finite; no model runs with that.")
    params = {name: params[name] for name in like}  # JAX sorts them
    if not isinstance(model, Mapping):
        numbers = np.asarray([params[name] for name in model.layout.names], float)
        if clause := model.layout.out_of_range(numbers):
            warn(f"'{path}': {clause}; no simulation takes that.")
    return params


def _settings_of(name: str, settings: Mapping[str, str]) -> dict[str, str]:
    """The settings of one network, by field."""
    own = f"{name}."
    return {n.removeprefix(own): s for n, s in settings.items() if n.startswith(own)}


@singledispatch
def like_saved(leaf: Any, settings: Mapping[str, str]) -> Any:
    """The model's network with the settings of a saved one that a training chooses; others as they are."""
    return leaf


def _kind(thing: object) -> str:
    """What something is, for a message."""
    return repr(shortened(thing)) if isinstance(thing, str) else f"a {type(thing).__name__}"


def _settings(thing: object, place: str) -> Iterator[tuple[str, str]]:
    """The settings of a network besides its arrays, such as its activation, by place."""
    if isinstance(thing, eqx.Module):
        for field in dataclasses.fields(thing):
            inner, value = f"{place}.{field.name}", getattr(thing, field.name)
            if field.metadata.get("static", False):
                yield inner, _described(value)
            else:
                yield from _settings(value, inner)
    elif isinstance(thing, Mapping):
        for name, value in thing.items():
            yield from _settings(value, f"{place}['{name}']" if place else name)
    elif isinstance(thing, Sequence) and not isinstance(thing, str):
        for i, value in enumerate(thing):
            yield from _settings(value, f"{place}[{i}]")
    elif callable(thing):
        yield place, _described(thing)


def _described(value: object) -> str:
    """A text that is the same in every process."""
    if callable(value):
        return getattr(value, "__name__", type(value).__name__)
    return repr(value)
