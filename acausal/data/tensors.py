"""Files of named arrays: written completely or not at all, checked when read, free of code.

The format is safetensors: a JSON header, then raw arrays. A file also holds a description in JSON, and a checksum of
all its content.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeGuard

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import PyTree

from acausal.errors import DataError, listing, reason
from acausal.files import replace_file

Arrays = dict[str, np.ndarray]


def write_arrays(path: Path, arrays: Mapping[str, np.ndarray], about: Mapping[str, Any]) -> None:
    """Write arrays by name and a description, of values that JSON can hold: completely or not at all.

    Raises:
        OSError: if it cannot be written.
    """
    from safetensors.numpy import save

    stored = {name: np.asarray(a, order="C") for name, a in arrays.items()}
    text = json.dumps(about)
    replace_file(path, save(stored, {"about": text, "sha256": _checksum(stored, text)}))


def read_arrays(path: Path) -> tuple[Arrays, dict[str, Any]]:
    """The arrays of a file, and its description.

    Raises:
        DataError: if it cannot be read, or has changed since it was written.
    """
    from safetensors import SafetensorError, safe_open

    if path.is_dir():
        raise DataError(f"'{path}' is a folder; give the path of a file.")
    try:
        with safe_open(path, framework="numpy") as file:
            metadata = file.metadata() or {}
            arrays: Arrays = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118
    except OSError as error:
        raise DataError(f"'{path}' cannot be read: {reason(error)}.") from error
    except (AttributeError, TypeError) as error:  # of types that NumPy lacks
        raise DataError(f"'{path}' has numbers of a type that NumPy lacks: {error}.") from error
    except SafetensorError as error:
        raise DataError(f"'{path}' is damaged or not a safetensors file: {error}.") from error
    if "about" not in metadata or "sha256" not in metadata:
        raise DataError(f"'{path}' was not written by acausal: it has no description.")
    if _checksum(arrays, metadata["about"]) != metadata["sha256"]:
        raise DataError(
            f"'{path}' was changed after it was written: its checksum does not fit. Use another copy of it."
        )
    try:
        about = json.loads(metadata["about"])
    except (ValueError, RecursionError):
        about = None
    if not isinstance(about, dict):
        raise DataError(f"'{path}' was not written by acausal: its description is not an object.")
    return arrays, about


def named_arrays(tree: PyTree) -> Arrays:
    """The arrays and numbers of a pytree, by their place in it."""
    leaves, _ = jax.tree_util.tree_flatten_with_path(eqx.filter(tree, eqx.is_array_like))
    return {_place(path): _stored(leaf) for path, leaf in leaves}


def filled_like(like: PyTree, arrays: Mapping[str, np.ndarray], where: str) -> PyTree:
    """A pytree like another one with the arrays that `named_arrays` gave; ``where`` names it in messages.

    Raises:
        DataError: if they are not the arrays of such a tree.
    """
    numbers, others = eqx.partition(like, eqx.is_array_like)
    leaves, structure = jax.tree_util.tree_flatten_with_path(numbers)
    places = [_place(path) for path, _ in leaves]
    if lacking := [place for place in places if place not in arrays]:
        raise DataError(f"{where} lacks {listing(lacking)}: it belongs to another model.")
    if superfluous := sorted(arrays.keys() - set(places)):
        raise DataError(f"{where} also has {listing(superfluous)}: it belongs to another model.")
    for place, (_, leaf) in zip(places, leaves, strict=True):
        here, there = _stored(leaf), arrays[place]
        if (here.shape, here.dtype) != (there.shape, there.dtype):
            raise DataError(
                f"{where} has '{place}' as {there.dtype}{list(there.shape)}, but here it is "
                f"{here.dtype}{list(here.shape)}: it belongs to another model."
            )
    new = [_restored(leaf, arrays[p]) for p, (_, leaf) in zip(places, leaves, strict=True)]
    return eqx.combine(jax.tree.unflatten(structure, new), others)


def _place(path: tuple[jax.tree_util.KeyEntry, ...]) -> str:
    """Where a leaf is, such as ``extra.net.weights[0]``, without the quotes of keys of a dict at the top."""
    top, rest = path[:1], path[1:]
    if top and isinstance(top[0], jax.tree_util.DictKey):
        first = str(top[0].key)
    else:
        first = jax.tree_util.keystr(top).removeprefix(".")
    return first + jax.tree_util.keystr(rest)


def _stored(leaf: ArrayLike) -> np.ndarray:
    return np.asarray(jax.random.key_data(leaf) if _is_key(leaf) else leaf)


def _restored(like: ArrayLike, array: np.ndarray) -> ArrayLike:
    if _is_key(like):
        return jax.random.wrap_key_data(jnp.asarray(array), impl=jax.random.key_impl(like))
    if isinstance(like, np.ndarray):
        return array
    return jnp.asarray(array) if isinstance(like, jax.Array) else type(like)(array.item())


def _is_key(leaf: object) -> TypeGuard[jax.Array]:
    return isinstance(leaf, jax.Array) and jnp.issubdtype(leaf.dtype, jax.dtypes.prng_key)


def _checksum(arrays: Mapping[str, np.ndarray], text: str) -> str:
    total = hashlib.sha256(text.encode())
    for name in sorted(arrays):
        array = arrays[name]
        total.update(json.dumps([name, str(array.dtype), array.shape]).encode())
        total.update(array.tobytes())
    return total.hexdigest()
