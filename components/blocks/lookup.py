"""Tables of one and two arguments."""

from collections.abc import Iterator
from typing import Any, get_args

import jax.numpy as jnp
import numpy as np

import acausal as ac
from acausal.components import icons

from . import surfaces
from .interfaces import MI2MO, SI2SO, MIMOs
from .interpolation import check_order, rows
from .tables import PartialColumns, TableData

__modelica__ = "Modelica.Blocks.Tables"


class CombiTable1Ds(PartialColumns):
    """Interpolation in rows ``[u, y2, y3, ...]``: output ``y[i]`` is column ``columns[i]`` at ``u``.

    See `PartialColumns` for the kinds of interpolation and extrapolation.
    """

    ICON = icons.marked(icons.LOOKUP, "1s")

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

    ICON = icons.marked(icons.LOOKUP, "1v")

    @property
    def n(self) -> int:
        """Number of inputs and of outputs."""
        return len(self._columns)

    def equations(self) -> Iterator[ac.Eq]:
        for y, u, column in zip(self.y, self.u, self.column, strict=True):
            yield ac.Eq(y, column(u))


class _Table2D(TableData):
    """What tables of two arguments share.

    The first column of ``table``, but for its first element, holds the values of ``u1``, the first row those
    of ``u2``. The values are a module, ``surface``, among the model's parameters.
    """

    ICON = icons.LOOKUP

    FORM = ("[[0, u2, ...], [u1, y, ...], ...]", (2, 2))

    smoothness = ac.Option(
        "LinearSegments", choices=get_args(surfaces.Smoothness), doc="kind of interpolation"
    )
    extrapolation = ac.Option(
        "LastTwoPoints",
        choices=get_args(surfaces.Extrapolation),
        doc="what holds outside of the table",
    )
    surface = ac.Module("_surface", data=True)

    def _rows(self) -> np.ndarray:
        table = rows(self)
        check_order(
            self, table[1:, 0], "the first column of table, from its second row on,", twice=False
        )
        check_order(
            self, table[0, 1:], "the first row of table, from its second column on,", twice=False
        )
        return table

    def _surface(self, _key: Any) -> surfaces.Surface:
        table = self._rows()
        for axis in (0, 1):  # a single line of values goes on as it is
            if table.shape[axis] == 2:
                table = np.concatenate([table, np.take(table, [1], axis)], axis)
                table[(2, 0) if axis == 0 else (0, 2)] += 1
        x, y = table[1:, 0], table[0, 1:]
        values = jnp.asarray(table[1:, 1:])
        return surfaces.Surface(
            jnp.asarray(x), jnp.asarray(y), values, self.smoothness, self.extrapolation
        )

    @property
    def u_min(self) -> Any:
        """Least arguments of the table."""
        return self._rows()[[1, 0], [0, 1]]

    @property
    def u_max(self) -> Any:
        """Greatest arguments of the table."""
        return self._rows()[[-1, 0], [0, -1]]


class CombiTable2Ds(SI2SO, _Table2D):
    """Interpolation in a table of two arguments: ``y`` is its value at ``u1``, ``u2``.

    The first column of ``table``, but for its first element, holds the values of ``u1``, the first row those
    of ``u2``. ``smoothness``: ``LinearSegments`` (bilinear), ``ConstantSegments``, or ``ContinuousDerivative``
    (Akima's surface). ``extrapolation``: ``LastTwoPoints``, ``Periodic``, or ``HoldLastPoint`` and
    ``NoExtrapolation``, which both hold the values at the border.
    """

    ICON = icons.marked(icons.LOOKUP, "2s")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.surface(self.u1, self.u2))


class CombiTable2Dv(MI2MO, _Table2D):
    """The same table for ``n`` pairs of arguments: ``y[i]`` is its value at ``u1[i]``, ``u2[i]``.

    See `CombiTable2Ds`.
    """

    ICON = icons.marked(icons.LOOKUP, "2v")

    def equations(self) -> Iterator[ac.Eq]:
        for y, u1, u2 in zip(self.y, self.u1, self.u2, strict=True):
            yield ac.Eq(y, self.surface(u1, u2))
