"""The program of a model: array operations in solving order, run while JAX traces.

Its size depends on the number of distinct formulas, not of components. Values live in a list of arrays: the
state, the input, a zero, then those that the instructions fill.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import jax.numpy as jnp
import numpy as np

from acausal.codegen.dense_loop import SolveLoop
from acausal.codegen.gather import Gather, gather
from acausal.codegen.instructions import Accumulate, Evaluate
from acausal.codegen.sparse_loop import SolveMesh
from acausal.codegen.values import Values
from acausal.flattening import Integers

Instruction = Evaluate | Accumulate | SolveLoop | SolveMesh


@dataclass(frozen=True)
class Program:
    """Array code of a model.

    Attributes:
        source, index: (n_nodes,) in which array, and where in it, a node's value lies (-1: nowhere).
        instructions: in order; ``first[i]`` is the array that instruction i fills first.
        sizes: lengths of all arrays.
        state_rates: where the derivatives of the states are read, and their signs; ``input_signs`` those of the inputs.
    """

    source: Integers
    index: Integers
    instructions: tuple[Instruction, ...]
    first: tuple[int, ...]
    sizes: tuple[int, ...]
    state_rates: Gather | None
    rate_signs: np.ndarray
    input_signs: np.ndarray

    def rates(self, values: Values) -> Any:
        """Derivatives of the states, shape (n_states,)."""
        if self.state_rates is None:
            return jnp.zeros_like(values.x)
        return self._rates(values, self._run(self.state_rates.sources, values))

    def read(self, nodes: Sequence[int], values: Values) -> Any:
        """Values of some nodes, shape (len(nodes),)."""
        wanted = self.gather(nodes)
        return jnp.broadcast_to(wanted.read(self._run(wanted.sources, values)), (len(nodes),))

    def rates_and_read(self, nodes: Sequence[int], values: Values) -> tuple[Any, Any]:
        """Derivatives of the states and values of some nodes, what they share computed once."""
        wanted = self.gather(nodes)
        rates = self.state_rates.sources if self.state_rates else ()
        arrays = self._run({*wanted.sources, *rates}, values)
        return self._rates(values, arrays), jnp.broadcast_to(wanted.read(arrays), (len(nodes),))

    def gather(self, nodes: Sequence[int]) -> Gather:
        """How nodes are read."""
        chosen = np.asarray(nodes, dtype=np.int64)
        return gather(self.source[chosen], self.index[chosen], self.sizes)

    def _rates(self, values: Values, arrays: list[Any]) -> Any:
        if self.state_rates is None:
            return jnp.zeros_like(values.x)
        rates = jnp.broadcast_to(self.state_rates.read(arrays), values.x.shape)
        return rates if (self.rate_signs == 1).all() else rates * self.rate_signs

    def _run(self, wanted: Iterable[int], values: Values) -> list[Any]:
        """Run the instructions that the wanted arrays depend on."""
        t, x, u, packed = values
        u = u if (self.input_signs == 1).all() else u * self.input_signs
        arrays: list[Any] = [x, u, jnp.zeros((), x.dtype), *[None] * (len(self.sizes) - 3)]
        needed = set(wanted)
        active: list[int] = []
        for i in range(len(self.instructions) - 1, -1, -1):
            filled = range(self.first[i], self.first[i] + self.instructions[i].outputs)
            if needed.intersection(filled):
                active.append(i)
                needed.update(self.instructions[i].sources)
        for i in reversed(active):
            results = self.instructions[i].run(t, arrays, packed)
            arrays[self.first[i] : self.first[i] + len(results)] = results
        return arrays
