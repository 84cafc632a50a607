"""Tables of one and two arguments."""

from collections.abc import Iterator
from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np

import acausal as ac
from acausal.components import icons

from .interfaces import MI2MO, SI2SO, MIMOs
from .tables import PartialColumns

__modelica__ = "Modelica.Blocks.Tables"


class CombiTable1Ds(PartialColumns):
    """Interpolation in rows ``[u, y2, y3, ...]``: output ``y[i]`` is column ``columns[i]`` at ``u``.

    See `PartialColumns` for the kinds of interpolation and extrapolation.
    """

    ICON = icons.LOOKUP

    u = ac.Input(doc="argument")
    y = ac.Output(shape="nout", doc="values")

    @property
    def nout(self) -> int:
        """Number of outputs."""
        return len(self._columns)

    def equations(self) -> Iterator[ac.Eq]:
        for y, column in zip(self.y, self.column, strict=True):
            yield ac.Eq(y, column(self.u))


class CombiTable1Dv(PartialColumns, MIMOs):
    """Interpolation in rows ``[u, y2, y3, ...]``: output ``y[i]`` is column ``columns[i]`` at ``u[i]``.

    See `PartialColumns` for the kinds of interpolation and extrapolation.
    """

    ICON = icons.LOOKUP

    @property
    def n(self) -> int:
        """Number of inputs and of outputs."""
        return len(self._columns)

    def equations(self) -> Iterator[ac.Eq]:
        for y, u, column in zip(self.y, self.u, self.column, strict=True):
            yield ac.Eq(y, column(u))


class _Surface(eqx.Module):
    """Values on a rectangular grid as a function of two arguments.

    Attributes:
        x, y: grid, shapes (n,) and (m,), ascending. values: shape (n, m).
        smooth: whether to interpolate, bilinearly; else the value at the lower corner holds.
        hold: whether the values at the border hold outside; else the cells at the border continue.
    """

    x: Any
    y: Any
    values: Any
    smooth: bool = eqx.field(static=True)
    hold: bool = eqx.field(static=True)

    def __call__(self, x: Any, y: Any) -> Any:
        """The value at two scalars."""
        (i, a), (j, b) = self._place(self.x, x), self._place(self.y, y)
        corners = (
            self.values[i, j],
            self.values[i + 1, j],
            self.values[i, j + 1],
            self.values[i + 1, j + 1],
        )
        below, above = (
            corners[0] + a * (corners[1] - corners[0]),
            corners[2] + a * (corners[3] - corners[2]),
        )
        return below + b * (above - below)

    def _place(self, grid: Any, x: Any) -> tuple[Any, Any]:
        """The cell of an argument, and how far in it the argument lies."""
        if self.hold:
            x = jnp.clip(x, grid[0], grid[-1])
        i = jnp.clip(jnp.searchsorted(grid, x, side="right") - 1, 0, len(grid) - 2)
        part = (x - grid[i]) / (grid[i + 1] - grid[i])
        return i, part if self.smooth else jnp.where(part < 1, 0.0, 1.0)


class _Table2D(ac.Component):
    """What tables of two arguments share.

    The first column of ``table``, but for its first element, holds the values of ``u1``, the first row those
    of ``u2``. ``smoothness``: ``LinearSegments`` (bilinear) or ``ConstantSegments``. ``extrapolation``:
    ``LastTwoPoints``, or ``HoldLastPoint`` and ``NoExtrapolation``, which both hold the values at the border.
    The values are a module, ``surface``, among the model's parameters.
    """

    ICON = icons.LOOKUP

    table = ac.Option(None, doc="grid and values")
    smoothness = ac.Option(
        "LinearSegments",
        choices=("LinearSegments", "ConstantSegments"),
        doc="kind of interpolation",
    )
    extrapolation = ac.Option(
        "LastTwoPoints",
        choices=("HoldLastPoint", "LastTwoPoints", "NoExtrapolation"),
        doc="what holds outside of the table",
    )
    tableOnFile = ac.Option(False, choices=(False,), doc="tables on files are not read")
    verboseRead = ac.Option(True, doc="without effect")
    verboseExtrapolation = ac.Option(False, doc="without effect")
    surface = ac.Module("_surface")

    def _surface(self, key: Any) -> _Surface:
        table = np.asarray(self.table, dtype=float)
        if table.ndim != 2 or min(table.shape) < 2:
            raise ac.DeclarationError(
                f"{type(self).__name__} needs table=[[0, u2, ...], [u1, y, ...], ...], got {self.table!r}"
            )
        for axis in (0, 1):  # a single line of values goes on as it is
            if table.shape[axis] == 2:
                table = np.concatenate([table, np.take(table, [1], axis)], axis)
                table[(2, 0) if axis == 0 else (0, 2)] += 1
        x, y = table[1:, 0], table[0, 1:]
        if (np.diff(x) <= 0).any() or (np.diff(y) <= 0).any():
            raise ac.DeclarationError(f"{type(self).__name__}: the arguments in table must ascend")
        smooth, hold = self.smoothness == "LinearSegments", self.extrapolation != "LastTwoPoints"
        return _Surface(jnp.asarray(x), jnp.asarray(y), jnp.asarray(table[1:, 1:]), smooth, hold)


class CombiTable2Ds(SI2SO, _Table2D):
    """Interpolation in a table of two arguments: ``y`` is its value at ``u1``, ``u2``.

    The first column of ``table``, but for its first element, holds the values of ``u1``, the first row those
    of ``u2``. ``smoothness``: ``LinearSegments`` (bilinear) or ``ConstantSegments``. ``extrapolation``:
    ``LastTwoPoints``, or ``HoldLastPoint`` and ``NoExtrapolation``, which both hold the values at the border.
    """

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.surface(self.u1, self.u2))


class CombiTable2Dv(MI2MO, _Table2D):
    """The same table for ``n`` pairs of arguments: ``y[i]`` is its value at ``u1[i]``, ``u2[i]``.

    See `CombiTable2Ds`.
    """

    def equations(self) -> Iterator[ac.Eq]:
        for y, u1, u2 in zip(self.y, self.u1, self.u2, strict=True):
            yield ac.Eq(y, self.surface(u1, u2))
