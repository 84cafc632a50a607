"""All parameters of a model in one vector: numbers first, then the arrays of its networks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array
from jax.typing import ArrayLike

from acausal.codegen import Packed, bind
from acausal.system import System


@dataclass(frozen=True)
class VectorEntry:
    """A parameter, or an array of a network.

    Attributes:
        name: dotted. first: where it begins in the vector. shape: its lengths.
        unit, doc: as declared; empty for weights.
    """

    name: str
    first: int
    shape: tuple[int, ...]
    unit: str
    doc: str

    @property
    def size(self) -> int:
        """The number of its elements."""
        return int(np.prod(self.shape, dtype=np.int64))


@dataclass(frozen=True, eq=False)
class ParameterVector:
    """Where every parameter lies in one vector, in the program's order.

    Attributes:
        system: the model. params: values by name, as from `System.parameters`.
    """

    system: System
    params: Mapping[str, Any]

    @cached_property
    def _modules(self) -> list[tuple[str, Any, Any]]:
        """Name, arrays and the rest of every network."""
        names = self.system.layout.module_names
        return [(n, *eqx.partition(self.params[n], eqx.is_inexact_array)) for n in names]

    @cached_property
    def entries(self) -> tuple[VectorEntry, ...]:
        """All that the vector holds, in its order."""
        layout = self.system.layout
        found: list[VectorEntry] = []
        for place in layout.order:
            declared = layout.model.layout.parameter_declaration(int(layout.free[place]))
            found.append(
                VectorEntry(layout.names[int(place)], len(found), (), declared.unit, declared.doc)
            )
        first = len(found)
        for name, arrays, _ in self._modules:
            for path, leaf in jax.tree_util.tree_flatten_with_path(arrays)[0]:
                entry = VectorEntry(
                    f"{name}{jax.tree_util.keystr(path)}", first, leaf.shape, "", ""
                )
                found.append(entry)
                first += entry.size
        return tuple(found)

    @cached_property
    def size(self) -> int:
        """The length of the vector."""
        return sum(e.size for e in self.entries)

    @cached_property
    def values(self) -> np.ndarray:
        """The vector, shape (size,)."""
        layout = self.system.layout
        free = np.asarray([self.params[n] for n in layout.names], dtype=float)[layout.order]
        leaves = [
            np.ravel(leaf) for _, arrays, _ in self._modules for leaf in jax.tree.leaves(arrays)
        ]
        return np.concatenate([free, *leaves]).astype(float)

    def packed(self, vector: ArrayLike) -> Packed:
        """The model's parameters, from a vector."""
        vector = jnp.asarray(vector)
        layout, first = self.system.layout, len(self.system.layout.free)
        values = bind(layout, vector[:first])
        modules: dict[int, Any] = {}
        for index, (_, arrays, rest) in zip(layout.own_modules, self._modules, strict=True):
            leaves, tree = jax.tree.flatten(arrays)
            filled: list[Array] = []
            for leaf in leaves:
                filled.append(jnp.reshape(vector[first : first + leaf.size], leaf.shape))
                first += leaf.size
            modules[index] = eqx.combine(jax.tree.unflatten(tree, filled), rest)
        return Packed(values, tuple(modules.get(i) for i in range(len(layout.module_of))))
