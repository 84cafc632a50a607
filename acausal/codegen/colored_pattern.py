"""The pattern of a sparse Jacobian, and its entries from few derivatives of a function."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal.codegen.reading import taken
from acausal.flattening import Integers, LeavesCaches
from acausal.structure import color_columns, long_rows


@dataclass(frozen=True, eq=False)
class ColoredPattern(LeavesCaches):
    """Positions of the entries of a square Jacobian, and colours of its columns.

    Attributes:
        size: number of rows.
        rows, columns: positions of the entries, row by row.
        long_rows: rows that are found by a reverse derivative each.
        colors: of every column, shape (size,); columns of one colour share none of the other rows.
    """

    size: int
    rows: Integers
    columns: Integers
    long_rows: Integers
    colors: Integers

    @classmethod
    def of(cls, size: int, rows: Integers, columns: Integers) -> ColoredPattern:
        """A pattern with its colours."""
        above = long_rows(rows, size)
        short = ~np.isin(rows, above)
        colors = color_columns(rows[short], columns[short], size, size)
        return cls(size, rows, columns, above, colors)

    @cached_property
    def n_colors(self) -> int:
        """How many products with a vector give all entries but those of long rows."""
        return int(self.colors.max(initial=-1)) + 1

    def entries(
        self,
        function: Callable[[Float[Array, " size"]], Float[Array, " size"]],
        x: Float[Array, " size"],
    ) -> Float[Array, " n_entries"]:
        """The entries of the Jacobian of ``function`` at ``x``, by a forward derivative for each colour.

        They are computed in turn: side by side they take longer to compile and are slower for many rows.
        """
        push = jax.linearize(function, x)[1]

        def column_sum(color: Array) -> Array:
            return push((self.colors == color).astype(x.dtype))

        found = jax.lax.map(column_sum, jnp.arange(self.n_colors)).ravel()
        if len(self.long_rows):
            pull = jax.linear_transpose(push, x)

            def row(number: Array) -> Array:
                return pull(jax.nn.one_hot(number, self.size, dtype=x.dtype))[0]

            rows = jax.lax.map(row, jnp.asarray(self.long_rows))
            found = jnp.concatenate([found, rows.ravel()])
        return taken(found, self._places)

    @cached_property
    def _places(self) -> Integers:
        """Where each entry lies among the derivatives."""
        above = np.full(self.size, -1)
        above[self.long_rows] = np.arange(len(self.long_rows))
        forward = self.colors[self.columns] * self.size + self.rows
        reverse = (self.n_colors + above[self.rows]) * self.size + self.columns
        return np.where(above[self.rows] < 0, forward, reverse)
