"""The C of a model: what it computes, as functions over one struct."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from acausal.codegen import INSTRUCTION, Events, Values, described
from acausal.errors import ExportError, shortened
from acausal.export.c_text.calibration import split
from acausal.export.c_text.event_functions import (
    ARGUMENTS as OF_EVENTS,
    event_buffers,
    event_functions,
)
from acausal.export.c_text.functions import Argument, Function, write_function
from acausal.export.c_text.lowering import Memory
from acausal.export.c_text.outside import FUNCTION as EXCESS
from acausal.export.c_text.statements import Buffer
from acausal.export.ranges import Watch
from acausal.export.traced import Block, Value, trace
from acausal.export.vector import ParameterVector
from acausal.system import System


@dataclass(frozen=True)
class Sizes:
    """How long the arrays of a model's struct are."""

    states: int
    inputs: int
    outputs: int
    parameters: int
    discrete: int
    conditions: int
    known: int
    work: int
    whole_work: int


@dataclass(frozen=True, eq=False)
class Code:
    """Functions of C for a model.

    Attributes:
        functions: by name. memory: tables and helper functions of all. sizes: of the struct.
        events: of the model, if it has any.
    """

    functions: dict[str, Function]
    memory: Memory
    sizes: Sizes
    events: Events | None


MOST_FOR_STARTS = 10_000
"""Most numbers of working memory that start values may take."""

ARGUMENTS = ("t", "x", "u", "p", "d")
"""What a model's functions read: time, states, inputs, parameters, discrete variables."""


def write_code(
    vector: ParameterVector,
    outputs: Sequence[str],
    *,
    derivatives: bool,
    column: bool = False,
    watch: Watch | None = None,
) -> Code:
    """The functions of a model.

    Arguments:
        vector: its parameters. outputs: the variables to compute.
        derivatives: whether directional derivatives are written, too.
        column: whether derivatives of the rates along states are written, for implicit steps.
        watch: the ranges of networks' arguments, for the function that tells whether one is left.
    """
    system = vector.system
    n_discrete = len(system.flat.discrete)
    shapes = {"t": (), "x": (len(system.states),), "u": (len(system.inputs),), "p": (vector.size,),
              "d": (n_discrete,)}  # fmt: skip
    zeros = [jnp.zeros(shapes[a]) for a in ARGUMENTS]

    def evaluate(t: Any, x: Any, u: Any, p: Any, d: Any) -> Any:
        values = Values(t, x, u, vector.packed(p), d if n_discrete else None)
        return system.rates_and_read(tuple(outputs), values)

    file = Memory(describe=partial(_origin, system))
    known = _Known()
    functions: dict[str, Function] = {}
    whole = known.split(trace(evaluate, *zeros))
    results = [Buffer("dx", "real", None), Buffer("y", "real", None)]
    for name, wanted in (("rates", (0,)), ("outputs", (1,))):
        block = _part(whole, wanted)
        into = [
            (Buffer(results[k].name, "real", block.outputs[i].shape[0]), 0)
            for i, k in enumerate(wanted)
        ]
        functions[name] = write_function(
            block, known.arguments(block, _arguments(shapes)), into, file
        )
    if derivatives:

        def tangent(t: Any, x: Any, u: Any, p: Any, d: Any, *seeds: Any) -> Any:
            return jax.jvp(lambda t, x, u, p: evaluate(t, x, u, p, d), (t, x, u, p), seeds)[1]

        block = known.split(trace(tangent, *zeros, *zeros[:4]))
        seeds = [
            Argument(Buffer(f"seed_{a}", "real", _length(shapes[a])), shapes[a]) for a in "txup"
        ]
        into = [
            (Buffer(f"d{b.name}", "real", o.shape[0]), 0)
            for b, o in zip(results, block.outputs, strict=True)
        ]
        arguments = known.arguments(block, [*_arguments(shapes), *seeds])
        functions["tangent"] = write_function(block, arguments, into, file)
    if column:

        def along_state(t: Any, x: Any, u: Any, p: Any, d: Any, seed: Any) -> Any:
            values = Values(t, x, u, vector.packed(p), d if n_discrete else None)
            return jax.jvp(lambda x: system.rates(values._replace(x=x)), (x,), (seed,))[1:]

        block = known.split(trace(along_state, *zeros, zeros[1]))
        seed = Argument(Buffer("seed_x", "real", _length(shapes["x"])), shapes["x"])
        into = [(Buffer("ddx", "real", len(system.states)), 0)]
        functions["column"] = write_function(
            block, known.arguments(block, [*_arguments(shapes), seed]), into, file
        )
    if watch is not None:

        def excess(t: Any, x: Any, u: Any, p: Any, d: Any) -> Any:
            values = Values(t, x, u, vector.packed(p), d if n_discrete else None)
            return jnp.reshape(watch.excess(values), (1,))

        block = known.split(trace(excess, *zeros))
        arguments = known.arguments(block, _arguments(shapes))
        functions[EXCESS] = write_function(block, arguments, [(Buffer(EXCESS, "real", 1), 0)], file)
    if system.edges:

        def ahead(t: Any, x: Any, u: Any, p: Any, d: Any, apart: Any) -> Any:
            found = system.edges.ahead(vector.packed(p), t, apart, d if n_discrete else None)
            return jnp.stack([found.jump, found.bend])

        block = known.split(trace(ahead, *zeros, zeros[0]))
        own = [*_arguments(shapes), Argument(Buffer("apart", "real", None), ())]
        into = [(Buffer("edge", "real", 2), 0)]
        functions["ahead"] = write_function(block, known.arguments(block, own), into, file)
    if (events := system.events) is not None:
        buffers = event_buffers(events, len(system.states), len(system.inputs))
        for name, function in event_functions(events, vector).items():
            own, result = OF_EVENTS[name]
            shaped = [Argument(b := buffers[a], () if b.size is None else (b.size,)) for a in own]
            block = known.split(trace(function, *zeros, *(jnp.zeros(a.shape) for a in shaped)))
            arguments = known.arguments(block, [*_arguments(shapes), *shaped])
            functions[name] = write_function(block, arguments, [(buffers[result], 0)], file)
    functions["recalibrate"] = known.function(
        Argument(Buffer("p", "real", vector.size), shapes["p"]), file
    )
    starts = _starts(vector, shapes, file) if events is None else None
    if starts is not None:
        functions["starts"] = starts
    sizes = Sizes(
        len(system.states), len(system.inputs), len(outputs), vector.size, n_discrete,
        events.n_guards if events is not None else 0, known.size,
        max(f.real for f in functions.values()), max(f.whole for f in functions.values()),
    )  # fmt: skip
    return Code(functions, file, sizes, events)


def _starts(
    vector: ParameterVector, shapes: dict[str, tuple[int, ...]], file: Memory
) -> Function | None:
    """The states at the start, from time, inputs and parameters; None if they depend on none of these, or have no C."""
    system = vector.system

    def evaluate(t: Any, u: Any, p: Any) -> Any:
        return (system.initializer.start_or_nan(vector.packed(p), u, t),)

    block = trace(evaluate, *(jnp.zeros(shapes[a]) for a in "tup"))
    arguments = [Argument(Buffer(a, "real", _length(shapes[a])), shapes[a]) for a in "tup"]
    try:
        found = write_function(
            block, arguments, [(Buffer("x", "real", len(system.states)), 0)], file
        )
    except ExportError:
        return None
    reads = re.search(r"\b[pu]\[|\bt\b", "\n".join(found.lines))
    return found if reads and found.real <= MOST_FOR_STARTS else None


def _origin(system: System, stack: str) -> str:
    """The equation from which an operation came, by JAX's names around it."""
    found = re.findall(rf"{INSTRUCTION}(\d+)", stack)
    if not found:
        return ""
    words = described(system.program, int(found[-1]), system.reduced.name)
    return f"{'along the seeds: ' if 'jvp' in stack else ''}{shortened(words, 100)}".replace(
        "*/", "* /"
    )


def _length(shape: tuple[int, ...]) -> int | None:
    return int(np.prod(shape)) if shape else None


def _arguments(shapes: dict[str, tuple[int, ...]]) -> list[Argument]:
    return [Argument(Buffer(a, "real", _length(shapes[a])), shapes[a]) for a in ARGUMENTS]


def _part(block: Block, wanted: Sequence[int]) -> Block:
    """A block that gives some of the results only."""
    needed = {block.outputs[i] for i in wanted}
    kept = []
    for operation in reversed(block.operations):
        if any(o in needed for o in operation.outputs):
            kept.append(operation)
            needed.update(operation.inputs)
    return Block(block.inputs, tuple(reversed(kept)), tuple(block.outputs[i] for i in wanted))


class _Known:
    """What depends on parameters alone: computed by ``recalibrate``, kept in the array ``known``."""

    def __init__(self) -> None:
        self.blocks: list[Block] = []
        self.places: dict[Value, int] = {}
        self.size = 0

    def split(self, block: Block) -> Block:
        """The part of a block that depends on more than parameters; its further inputs are known values."""
        early, late = split(block, [block.inputs[ARGUMENTS.index("p")]])
        self.blocks.append(early)
        for value in early.outputs:
            assert isinstance(value, Value)
            if value not in self.places:
                self.places[value] = self.size
                self.size += value.size
        return late

    def arguments(self, block: Block, own: Sequence[Argument]) -> list[Argument]:
        """The arguments of a block: its own, then the known values."""
        buffer = Buffer("known", "real", self.size)
        rest = block.inputs[len(own) :]
        return [*own, *(Argument(buffer, v.shape, self.places[v]) for v in rest)]

    def function(self, parameters: Argument, memory: Memory) -> Function:
        """The function that computes the known values."""
        joined = Block(
            tuple(i for b in self.blocks for i in b.inputs),
            tuple(o for b in self.blocks for o in b.operations),
            tuple(o for b in self.blocks for o in b.outputs),
        )
        buffer = Buffer("known", "real", self.size)
        into = [(buffer, self.places[v]) for v in joined.outputs if isinstance(v, Value)]
        return write_function(joined, [parameters] * len(joined.inputs), into, memory)
