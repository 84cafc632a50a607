"""Fingerprints: digests of the inputs of a training, the same in every process.

Arrays, numbers, words and names count by value. A function counts as the program that JAX makes of it (StableHLO),
so that a checkpoint is refused where a constant or a helper that the function uses has changed, and accepted where only
names or places of code have.

Measured on the quarter vehicle with both networks, three segments and a regularizer (JAX 0.10.2): 0.3 to 0.5 s of
processor time, once per training with a checkpoint. Hashing bytecode took 0.1 s, but saw neither helpers nor
constants outside of a function, and changed with the version of Python. The text of a jaxpr takes half of the time,
but lacks the values of constants.
"""

from __future__ import annotations

import dataclasses
import functools
import hashlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from types import NoneType
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import sympy as sp

from acausal.data import Data, named_arrays
from acausal.system import System
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable
from acausal.training.strategy import Segment, Stage

DERIVED = (
    "context", "shooting", "weighting", "mesh", "first_states", "start_prior", "streamed", "direct"
)  # fmt: skip
"""Fields of a problem that follow from the others, or only choose the devices or the mode of derivatives."""

ARGUMENTS = {
    "networks": "train", "records": "data", "substeps": "dt", "timing": "delays or lags",
    "sequences": "sequence_length, batch_size or subsample",
}  # fmt: skip
"""Arguments of `acausal.fit` by the fields of a problem, where their names differ."""


def fingerprint(
    problem: Problem,
    segments: Sequence[Segment],
    seeds: Sequence[int],
    others: Sequence[Trainable],
    held: Problem | None,
    data: Mapping[str, Data],
) -> dict[str, str]:
    """A digest of everything that determines the course of trainings, by argument of `acausal.fit`.

    Arguments:
        problem: the problem, with the start of the first training. others: where the others start.
        data: all signals of the records; the start of trained states may follow from one that is not a target.
    """
    fields = {f.name: getattr(problem, f.name) for f in dataclasses.fields(problem)}
    named = {ARGUMENTS.get(n, n): field for n, field in fields.items() if n not in DERIVED}
    system, targets, records = problem.system, problem.targets, problem.records
    t, x, u = jnp.zeros(()), jnp.zeros(len(system.states)), jnp.zeros(len(system.inputs))
    point = t, x, u, problem.params
    planned = {
        "system": (system, program(system.vector_field, *point)),
        "targets": (targets, program(functools.partial(system.observe, targets), *point)),
        "loss": ([segment.trainer.limit for segment in segments], _loss(problem)),
        "regularizers": {n: _regularizer(problem, r) for n, r in problem.regularizers.items()},
        "record_weights or sample_weights": (problem.weighting, records.weight),
        "data": (
            dataclasses.replace(records, weight=jnp.where(records.weight > 0, 1.0, 0.0)),
            {n: dict(d.signals) for n, d in data.items()},
            problem.streamed,
        ),
        "modifiers": (problem.modifiers.names, problem.modifiers.kinds),
        "x0": (problem.first_states, problem.start_prior, problem.shooting is None),
        "strategy": [_stage(segment.stage) for segment in segments],
        "epochs": [segment.epochs for segment in segments],
        "evaluate_every": [segment.evaluate_every for segment in segments],
        "patience": [segment.patience for segment in segments],
        "validation": held and (held.records, held.first_states),
        "optimizer": [_optimizer(segment) for segment in segments],
        "seed": seeds,
        "members": others,
    }
    return {name: digest(part) for name, part in {**named, **planned}.items()}


def _stage(stage: Stage) -> str | Stage:
    """What a stage is besides its number of updates; of one that the user has named, its kind."""
    bare = stage._replace(epochs=0, title="")
    return stage.kind if bare == Stage(stage.kind, 0) else bare


# -- functions ---------------------------------------------------------------------------------------


def program(function: Callable[..., Any], *arguments: Any) -> str:
    """The program that JAX makes of a function, as text; of arrays among its arguments only the shapes count."""
    arrays, rest = eqx.partition(arguments, eqx.is_array)

    def of_arrays(arrays: Any) -> Any:
        return eqx.filter(function(*eqx.combine(arrays, rest)), eqx.is_array)

    # of one platform, wherever this runs: a checkpoint may move to a machine with another accelerator
    return jax.jit(of_arrays).trace(arrays).lower(lowering_platforms=("cpu",)).as_text()


def _loss(problem: Problem) -> str:
    """The loss and its gradient, for which a function may have rules of its own."""
    y, sigma = jnp.zeros((2, len(problem.targets))), jnp.zeros(len(problem.targets))
    return program(jax.value_and_grad(problem.loss), y, y, sigma, jnp.ones_like(y))


def _regularizer(problem: Problem, regularizer: Callable[..., Any]) -> str:
    gradient = eqx.filter_value_and_grad(lambda params, context: regularizer(params, context))
    return program(gradient, problem.params, problem.context)


def _optimizer(segment: Segment) -> str:
    """The start of a segment's optimizer, and one update.

    Both depend on the shapes of the trained arrays: if these change, so does the digest.
    """
    optimizer = segment.trainer.optimizer

    def first(trainable: Any, gradient: Any) -> Any:
        count = sum(leaf.size for leaf in jax.tree.leaves(trainable))
        return optimizer.update(
            gradient,
            optimizer.init(trainable),
            trainable,
            value=_squares(trainable),
            grad=gradient,
            value_fn=_squares,
            hessian=jnp.zeros((count, count)),
        )

    start = segment.objective.start()
    return program(first, start, start)


def _squares(tree: Any) -> jax.Array:
    """A loss for an optimizer: the sum of squares."""
    return sum((jnp.sum(leaf**2) for leaf in jax.tree.leaves(tree)), jnp.zeros(()))


# -- everything else ---------------------------------------------------------------------------------


def digest(thing: Any) -> str:
    """A digest of a thing's parts, down to numbers and arrays."""
    total = hashlib.sha256()
    for piece in _pieces(thing, ()):
        total.update(len(piece).to_bytes(8, "little"))
        total.update(piece)
    return total.hexdigest()[:16]


def _pieces(thing: Any, above: tuple[int, ...]) -> Iterator[bytes]:
    """The pieces of a thing, after its type; ``above`` are the ids of the things that hold it."""
    if isinstance(thing, int | float | np.integer | np.floating):
        yield _number(thing)
        return
    if isinstance(thing, np.ndarray | jax.Array):
        (array,) = named_arrays(thing).values()
        yield f"{array.dtype}{array.shape}".encode()
        yield array.tobytes()
        return
    yield type(thing).__qualname__.encode()  # without its module, which may move
    if id(thing) in above:  # it holds itself
        return
    parts = _parts(thing)
    if isinstance(parts, str):
        yield parts.encode()
        return
    yield str(len(parts)).encode()
    for part in parts:
        yield from _pieces(part, (*above, id(thing)))


def _number(number: Any) -> bytes:
    """A number by its value: 1 and 1.0 are the same."""
    whole = isinstance(number, int | np.integer) or float(number).is_integer()
    return repr(int(number) if whole else float(number)).encode()


@functools.singledispatch
def _parts(thing: Any) -> Sequence[Any] | str:
    """The parts of a thing: other things, or a text. For a function this is its name; `program` covers its content."""
    if dataclasses.is_dataclass(thing) and not isinstance(thing, type):
        return [(f.name, getattr(thing, f.name)) for f in dataclasses.fields(thing)]
    if callable(thing) and hasattr(thing, "__qualname__"):
        return thing.__qualname__
    return sorted(vars(thing).items()) if hasattr(thing, "__dict__") else ""


@_parts.register(complex | str | np.generic | np.dtype | NoneType)
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
def _(thing: System) -> Sequence[Any]:
    statements = [
        (str(group.template), group.variables, group.parameters, group.modules)
        for group in (*thing.flat.groups, *thing.flat.initial)
    ]
    names = (thing.variables, thing.states, thing.inputs, thing.layout.names)
    flat = thing.flat
    return (*names, flat.start, flat.starts, flat.value, flat.folded, flat.bindings, statements)
