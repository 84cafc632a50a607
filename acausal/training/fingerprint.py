"""Fingerprints: what a training is made of, as digests that are the same in every process."""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import types
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import jax
import numpy as np
import sympy as sp

from acausal.data import named_arrays
from acausal.system import System
from acausal.training.objective.held_out import HeldOut
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable
from acausal.training.strategy import Leg

ASIDE = ("context", "shooting", "mesh")
"""Parts of a problem that follow from the others, or say only where to compute it."""

ARGUMENTS = {
    "system": "system", "networks": "train", "records": "data", "substeps": "dt",
    "sequences": "sequence_length, batch_size or subsample",
}  # fmt: skip
"""What parts of a problem are called by those who pose it, where they have another name."""


def fingerprint(
    problem: Problem,
    legs: Sequence[Leg],
    seeds: Sequence[int],
    others: Sequence[Trainable],
    held: HeldOut | None,
    signals: Mapping[str, np.ndarray],
) -> dict[str, str]:
    """A digest of everything that decides how trainings go, by argument of `acausal.fit`.

    Arguments:
        problem: with what the first one starts from.
        legs: how they go.
        seeds: one for each.
        others: where all but the first start.
        held: what is held out, if anything is.
        signals: all that is in the record: where trained states begin may follow from what is no target.
    """
    parts = {f.name: getattr(problem, f.name) for f in dataclasses.fields(problem)}
    posed = {ARGUMENTS.get(n, n): part for n, part in parts.items() if n not in ASIDE}
    planned = {
        "data": (problem.records, signals),
        "modifiers": (problem.modifiers.names, problem.modifiers.kinds),
        "x0": (problem.x0, problem.shooting is None),
        "strategy": [leg.name for leg in legs],
        "epochs": [leg.epochs for leg in legs],
        "evaluate_every": [leg.evaluate_every for leg in legs],
        "patience": [leg.patience for leg in legs],
        "validation": held and (held.problem.records, held.problem.x0, held.first),
        "optimizer": [leg.trainer for leg in legs],
        "seed": seeds,
        "members": others,
    }
    return {name: digest(part) for name, part in {**posed, **planned}.items()}


def digest(thing: Any) -> str:
    """A digest of what a thing is made of, down to arrays and the code of functions."""
    total = hashlib.sha256()
    for piece in _pieces(thing, ()):
        total.update(len(piece).to_bytes(8, "little"))
        total.update(piece)
    return total.hexdigest()[:16]


def _pieces(thing: Any, above: tuple[int, ...]) -> Iterator[bytes]:
    """The pieces of a thing, after its type; ``above`` are the things that hold it, by id."""
    if isinstance(thing, int | float | np.integer | np.floating):
        yield _number(thing)
        return
    yield f"{type(thing).__module__}.{type(thing).__qualname__}".encode()
    if id(thing) in above:  # a function that calls itself holds itself
        return
    if isinstance(thing, np.ndarray | jax.Array):
        (array,) = named_arrays(thing).values()
        yield f"{array.dtype}{array.shape}".encode()
        yield array.tobytes()
        return
    parts = _parts(thing)
    if isinstance(parts, str):
        yield parts.encode()
        return
    yield str(len(parts)).encode()
    for part in parts:
        yield from _pieces(part, (*above, id(thing)))


def _number(number: Any) -> bytes:
    """A number by its value: optax's schedules turn their integers into floats when first called."""
    whole = isinstance(number, int | np.integer) or float(number).is_integer()
    return repr(int(number) if whole else float(number)).encode()


@functools.singledispatch
def _parts(thing: Any) -> Sequence[Any] | str:
    """What a thing is made of: other things, or a text."""
    if dataclasses.is_dataclass(thing) and not isinstance(thing, type):
        return [(f.name, getattr(thing, f.name)) for f in dataclasses.fields(thing)]
    wrapped = getattr(thing, "__wrapped__", None)
    if wrapped is not None:
        return (wrapped,)
    if hasattr(thing, "__dict__") and vars(thing):
        return sorted(vars(thing).items())
    return str(getattr(thing, "__name__", ""))


@_parts.register(complex | str | np.generic | np.dtype | types.NoneType)
def _(thing: Any) -> str:
    return repr(thing)


@_parts.register
def _(thing: bytes) -> str:
    return thing.hex()


@_parts.register(sp.Basic)
def _(thing: sp.Basic) -> str:
    return str(thing)


@_parts.register(tuple | list)
def _(thing: Sequence[Any]) -> Sequence[Any]:
    return thing


@_parts.register(Mapping)
def _(thing: Mapping[Any, Any]) -> Sequence[Any]:
    return list(thing.items())


@_parts.register
def _(thing: type) -> str:
    return f"{thing.__module__}.{thing.__qualname__}"


@_parts.register
def _(thing: types.ModuleType) -> str:
    return thing.__name__


@_parts.register(functools.partial)
def _(thing: functools.partial[Any]) -> Sequence[Any]:
    return (thing.func, thing.args, thing.keywords)


@_parts.register
def _(thing: types.MethodType) -> Sequence[Any]:
    return (thing.__func__, thing.__self__)


@_parts.register
def _(thing: types.FunctionType) -> Sequence[Any]:
    held = [_content(cell) for cell in thing.__closure__ or ()]
    return (thing.__module__, thing.__qualname__, thing.__code__, thing.__defaults__, held)


def _content(cell: types.CellType) -> Any:
    """What a function has from the one around it; ``None`` for a variable that was never set."""
    try:
        return cell.cell_contents
    except ValueError:
        return None


@_parts.register
def _(thing: types.CodeType) -> Sequence[Any]:
    return (thing.co_code, thing.co_names, thing.co_consts)


@_parts.register
def _(thing: System) -> Sequence[Any]:
    statements = [
        (str(group.template), group.variables, group.parameters, group.modules)
        for group in (*thing.flat.groups, *thing.flat.initial)
    ]
    names = (thing.variables, thing.states, thing.inputs, thing.layout.names)
    flat = thing.flat
    return (*names, flat.start, flat.starts, flat.value, flat.folded, flat.bindings, statements)
