"""The program of a model: instructions in solving order, as data that can be run, written down or counted.

Its size depends on the number of distinct formulas, not of components. Values live in a list of arrays: the
states, the inputs, a zero, the discrete variables, then those that the instructions fill.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from acausal.codegen.gather import Elements, Gather, gather
from acausal.codegen.instructions import ExplicitInstruction, Instruction
from acausal.errors import listing
from acausal.flattening import Integers, LeavesCaches

FEW = 12
"""Instructions at most of rates that are compiled in no time."""

STATES, INPUTS, ZERO, DISCRETE = 0, 1, 2, 3
"""The first arrays of every program."""


@dataclass(frozen=True)
class Program(LeavesCaches):
    """The instructions that compute the values of a model.

    Attributes:
        nodes: for every array, the nodes whose values lie in it.
        instructions: in order; ``first[i]`` is the array that instruction i fills first.
        state_rates: where the derivatives of the states are read, and their signs; None without states.
        input_signs: what inputs are multiplied by before they are read.
        discrete_start: values of the discrete variables before the first event.
    """

    nodes: tuple[Integers, ...]
    instructions: tuple[Instruction, ...]
    first: tuple[int, ...]
    state_rates: Gather | None
    rate_signs: Integers
    input_signs: Integers
    discrete_start: np.ndarray

    @cached_property
    def traces(self) -> dict[tuple[int, ...], Any]:
        """What JAX has traced of it, by the arrays that are wanted."""
        return {}

    @cached_property
    def sizes(self) -> tuple[int, ...]:
        """Lengths of all arrays."""
        return tuple(map(len, self.nodes))

    @cached_property
    def positions(self) -> tuple[Integers, Integers]:
        """For every node, the array and the place in it where its value lies (-1: nowhere)."""
        count = 1 + max((int(nodes.max()) for nodes in self.nodes if len(nodes)), default=-1)
        source, index = (np.full(count, -1, dtype=np.int64) for _ in range(2))
        for array, nodes in enumerate(self.nodes):
            source[nodes], index[nodes] = array, np.arange(len(nodes))
        return source, index

    @property
    def all_nodes(self) -> list[int]:
        """The nodes that have values."""
        return [node for nodes in self.nodes for node in nodes.tolist() if node >= 0]

    @property
    def rate_sources(self) -> tuple[int, ...]:
        """The arrays in which the derivatives of the states are read."""
        return () if self.state_rates is None else self.state_rates.sources

    def gather(self, nodes: Sequence[int], copy: int = 0) -> Elements:
        """How the values of some nodes are read, in one of several copies of the arrays, one behind the other."""
        chosen = np.asarray(nodes, dtype=np.int64)
        source, index = self.positions
        first = copy * len(self.nodes)
        return gather(first + source[chosen], index[chosen], self.sizes * (copy + 1))

    def nodes_of(self, gather: Gather) -> list[int]:
        """The nodes whose values a gather reads."""
        source, index = gather.positions(self.sizes)
        return [int(self.nodes[s][i]) for s, i in zip(source, index, strict=True)]

    def in_copy(self, sources: Iterable[int], copy: int) -> set[int]:
        """The arrays among some sources that are read in one of the copies."""
        n = len(self.nodes)
        return {source % n for source in sources if source // n == copy}

    def needed(self, arrays: Iterable[int], known: Collection[int] = ()) -> list[int]:
        """The instructions, in order, that some arrays depend on; of what is known, none."""
        wanted, active = set(arrays).difference(known), list[int]()
        for i in range(len(self.instructions) - 1, -1, -1):
            instruction, first = self.instructions[i], self.first[i]
            if wanted.intersection(range(first, first + instruction.outputs)):
                active.append(i)
                wanted.update(set(instruction.sources).difference(known))
        return active[::-1]

    def filled(self, arrays: Iterable[int], known: Collection[int] = ()) -> tuple[int, ...]:
        """The arrays that are computed where some are, if others are known."""
        pairs = [(self.first[i], self.instructions[i].outputs) for i in self.needed(arrays, known)]
        return tuple(first + k for first, count in pairs for k in range(count))

    def iterates(self, arrays: Iterable[int], known: Collection[int] = ()) -> bool:
        """Whether some arrays depend on loops that are not linear, if others are known."""
        some = [self.instructions[i] for i in self.needed(arrays, known)]
        return any(not isinstance(one, ExplicitInstruction) and not one.is_linear for one in some)

    @cached_property
    def is_long(self) -> bool:
        """Whether XLA takes long for the rates: they are of many instructions, or there are loops to solve."""
        some = [self.instructions[i] for i in self.needed(self.rate_sources)]
        simple = all(isinstance(one, ExplicitInstruction) for one in some)
        return len(some) > FEW or not simple

    @cached_property
    def searches(self) -> bool:
        """Whether the rates follow from nonlinear loops."""
        some = (self.instructions[i] for i in self.needed(self.rate_sources))
        return any(not isinstance(o, ExplicitInstruction) and not o.is_linear for o in some)

    @cached_property
    def filled_by(self) -> dict[int, int]:
        """For every array that is computed, the instruction that fills it."""
        pairs = enumerate(zip(self.first, self.instructions, strict=True))
        return {a: i for i, (first, one) in pairs for a in range(first, first + one.outputs)}


def described(program: Program, number: int, name: Callable[[int], str]) -> str:
    """The variables that an instruction gives, by the names of nodes, and their formula."""
    instruction, first = program.instructions[number], program.first[number]
    rows = program.nodes[first : first + instruction.outputs]
    names = [_all(name, row) for row in rows]
    if isinstance(instruction, ExplicitInstruction):
        return f"{names[0]}{instruction.text}"
    return f"{listing(names, 6)}: {'linear ' if instruction.is_linear else ''}equations"


def _all(name: Callable[[int], str], nodes: Integers) -> str:
    """The name of the only node, or the first and the last."""
    found = [int(node) for node in nodes if node >= 0]
    if not found:
        return "an auxiliary value"
    return name(found[0]) if len(found) == 1 else f"{name(found[0])} ... {name(found[-1])}"
