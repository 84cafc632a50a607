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
from acausal.codegen.parameters import Packed
from acausal.codegen.sparse_loop import SolveMesh
from acausal.flattening import Integers

Instruction = Evaluate | Accumulate | SolveLoop | SolveMesh


@dataclass(frozen=True)
class Program:
    """Array code of a model.

    Attributes:
        source, index: (n_nodes,) in which array, and where in it, a node's value lies (-1: nowhere).
        instructions: in order; ``first[i]`` is the array that instruction i fills first.
        sizes: lengths of all arrays.
        rates: where the derivatives of the states are read, and their signs; ``input_signs`` those of the inputs.
    """

    source: Integers
    index: Integers
    instructions: tuple[Instruction, ...]
    first: tuple[int, ...]
    sizes: tuple[int, ...]
    rates: Gather | None
    rate_signs: np.ndarray
    input_signs: np.ndarray

    def vector_field(self, t: Any, x: Any, u: Any, packed: Packed) -> Any:
        """Derivatives of the states, shape (n_states,)."""
        if self.rates is None:
            return jnp.zeros_like(x)
        arrays = self._run(self.rates.sources, t, x, u, packed)
        rates = jnp.broadcast_to(self.rates.read(arrays), x.shape)
        return rates if (self.rate_signs == 1).all() else rates * self.rate_signs

    def values(self, nodes: Sequence[int], t: Any, x: Any, u: Any, packed: Packed) -> Any:
        """Values of some nodes, shape (len(nodes),)."""
        chosen = np.asarray(nodes, dtype=np.int64)
        wanted = gather(self.source[chosen], self.index[chosen], self.sizes)
        arrays = self._run(wanted.sources, t, x, u, packed)
        return jnp.broadcast_to(wanted.read(arrays), (len(nodes),))

    def both(self, nodes: Sequence[int], t: Any, x: Any, u: Any, packed: Packed) -> tuple[Any, Any]:
        """Derivatives of the states and values of some nodes, what they share computed once."""
        chosen = np.asarray(nodes, dtype=np.int64)
        wanted = gather(self.source[chosen], self.index[chosen], self.sizes)
        rates = self.rates
        arrays = self._run({*wanted.sources, *(rates.sources if rates else ())}, t, x, u, packed)
        dx = jnp.broadcast_to(rates.read(arrays), x.shape) if rates else jnp.zeros_like(x)
        dx = dx if (self.rate_signs == 1).all() else dx * self.rate_signs
        return dx, jnp.broadcast_to(wanted.read(arrays), (len(nodes),))

    def _run(self, wanted: Iterable[int], t: Any, x: Any, u: Any, packed: Packed) -> list[Any]:
        """Run the instructions that the wanted arrays depend on."""
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
