"""The C of a model: what it computes, as functions over one struct."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import jax
import jax.numpy as jnp

from acausal.codegen import INSTRUCTION, Values, described
from acausal.errors import shortened
from acausal.events import Events
from acausal.export.c_text.calibration import split
from acausal.export.c_text.events import ARGUMENTS as OF_EVENTS, event_functions
from acausal.export.c_text.functions import CArgument, CFunction, write_function
from acausal.export.c_text.lowering import Workspace
from acausal.export.c_text.starts import start_functions
from acausal.export.c_text.statements import Buffer
from acausal.export.ranges import Watch
from acausal.export.traced import TracedBlock, TracedValue, trace
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

    functions: dict[str, CFunction]
    memory: Workspace
    sizes: Sizes
    events: Events | None


EXCESS = "excess"
"""The function that tells by how far an argument of a network lies outside of its range: positive where one does."""

ARGUMENTS = ("t", "x", "u", "p", "d")
"""What a model's functions read: time, states, inputs, parameters, discrete variables."""


def write_code(
    vector: ParameterVector,
    outputs: Sequence[str],
    *,
    derivatives: bool,
    column: bool,
    watch: Watch | None,
) -> Code:
    """The functions of a model.

    Arguments:
        vector: its parameters. outputs: the variables to compute.
        derivatives: whether directional derivatives are written, too.
        column: whether derivatives of the rates along states are written, for implicit steps.
        watch: the ranges of networks' arguments, for the function that tells whether one is left.
    """
    system, events = vector.system, vector.system.events
    n_discrete = len(system.flat.discrete)
    n_states, n_inputs = len(system.states), len(system.inputs)
    n_conditions = 0 if events is None else events.n_guards
    sizes = {
        "t": None, "x": n_states, "u": n_inputs, "p": vector.size, "d": n_discrete,
        "apart": None, "initial": None, "holds": n_conditions,
    }  # fmt: skip

    def given(*names: str) -> list[CArgument]:
        """Arrays of real numbers, or single ones, by names such as ``x``, ``x_before`` and ``seed_x``."""
        lengths = [sizes[re.sub("^seed_|^along_|_before$", "", name)] for name in names]
        pairs = zip(names, lengths, strict=True)
        return [CArgument(Buffer(a, "real", n), () if n is None else (n,)) for a, n in pairs]

    common = given(*ARGUMENTS)
    file = Workspace(describe=partial(_origin, system))
    known = _Known()
    functions: dict[str, CFunction] = {}

    def values(t: Any, x: Any, u: Any, p: Any, d: Any) -> Values:
        return Values(t, x, u, vector.packed(p), d if n_discrete else None)

    def block_of(function: Callable[..., Any], more: Sequence[CArgument] = ()) -> TracedBlock:
        return known.split(trace(function, *(jnp.zeros(a.shape) for a in (*common, *more))))

    def write(
        name: str, block: TracedBlock, results: Sequence[str], more: Sequence[CArgument] = ()
    ) -> None:
        pairs = zip(results, block.outputs, strict=True)
        into = [(Buffer(result, "real", o.shape[0]), 0) for result, o in pairs]
        functions[name] = write_function(
            block, known.arguments(block, [*common, *more]), into, file
        )

    def add(name: str, function: Callable[..., Any], results: Sequence[str], *names: str) -> None:
        """Trace and write a function of `ARGUMENTS` and of more arguments with these names."""
        more = given(*names)
        write(name, block_of(function, more), results, more)

    def evaluate(t: Any, x: Any, u: Any, p: Any, d: Any) -> Any:
        return system.rates_and_read(tuple(outputs), values(t, x, u, p, d))

    whole = block_of(evaluate)
    for name, result, which in (("rates", "dx", 0), ("outputs", "y", 1)):
        write(name, whole.part([whole.outputs[which]]), [result])
    if derivatives:

        def tangent(t: Any, x: Any, u: Any, p: Any, d: Any, *seeds: Any) -> Any:
            return jax.jvp(lambda t, x, u, p: evaluate(t, x, u, p, d), (t, x, u, p), seeds)[1]

        add("tangent", tangent, ["ddx", "dy"], "seed_t", "seed_x", "seed_u", "seed_p")
    if column:

        def along_state(t: Any, x: Any, u: Any, p: Any, d: Any, seed: Any) -> Any:
            now = values(t, x, u, p, d)
            return jax.jvp(lambda x: system.rates(now._replace(x=x)), (x,), (seed,))[1:]

        add("jacobian_column", along_state, ["ddx"], "seed_x")
    if watch is not None:
        add(EXCESS, lambda *now: jnp.reshape(watch.excess(values(*now)), (1,)), [EXCESS])
    if system.edges:

        def ahead(t: Any, x: Any, u: Any, p: Any, d: Any, apart: Any) -> Any:
            edges = system.edges.ahead(vector.packed(p), t, apart, d if n_discrete else None)
            return jnp.stack([edges.jump, edges.bend])

        add("ahead", ahead, ["edge"], "apart")
    if events is not None:
        for name, function in event_functions(events, vector).items():
            names, result = OF_EVENTS[name]
            add(name, function, [result], *names)
    functions["recalibrate"] = known.function(common[ARGUMENTS.index("p")], file)
    functions |= start_functions(vector, dict(zip(ARGUMENTS, common, strict=True)), file)
    lengths = Sizes(
        n_states, n_inputs, len(outputs), vector.size, n_discrete, n_conditions, known.size,
        max(f.real for f in functions.values()), max(f.whole for f in functions.values()),
    )  # fmt: skip
    return Code(functions, file, lengths, events)


def _origin(system: System, stack: str) -> str:
    """The equation from which an operation came, by JAX's names around it."""
    found = re.findall(rf"{INSTRUCTION}(\d+)", stack)
    if not found:
        return ""
    words = described(system.program, int(found[-1]), system.reduced.name)
    return f"{'along the seeds: ' if 'jvp' in stack else ''}{shortened(words, 100)}".replace(
        "*/", "* /"
    )


class _Known:
    """What depends on parameters alone: computed by ``recalibrate``, kept in the array ``known``."""

    def __init__(self) -> None:
        self.blocks: list[TracedBlock] = []
        self.places: dict[TracedValue, int] = {}
        self.size = 0

    def split(self, block: TracedBlock) -> TracedBlock:
        """The part of a block that depends on more than parameters; its further inputs are known values."""
        early, late = split(block, [block.inputs[ARGUMENTS.index("p")]])
        self.blocks.append(early)
        for value in early.outputs:
            assert isinstance(value, TracedValue)
            if value not in self.places:
                self.places[value] = self.size
                self.size += value.size
        return late

    def arguments(self, block: TracedBlock, own: Sequence[CArgument]) -> list[CArgument]:
        """The arguments of a block: its own, then the known values."""
        buffer = Buffer("known", "real", self.size)
        rest = block.inputs[len(own) :]
        return [*own, *(CArgument(buffer, v.shape, self.places[v]) for v in rest)]

    def function(self, parameters: CArgument, memory: Workspace) -> CFunction:
        """The function that computes the known values."""
        joined = TracedBlock(
            tuple(i for b in self.blocks for i in b.inputs),
            tuple(o for b in self.blocks for o in b.operations),
            tuple(o for b in self.blocks for o in b.outputs),
        )
        buffer = Buffer("known", "real", self.size)
        into = [(buffer, self.places[v]) for v in joined.outputs if isinstance(v, TracedValue)]
        return write_function(joined, [parameters] * len(joined.inputs), into, memory)
