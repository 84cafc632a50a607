"""The result of a simulation: a trajectory with its model, so that any variable can be read by name."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, cast

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal._jax import traced
from acausal.by_name import ByName, names_in
from acausal.codegen import Packed, Values
from acausal.errors import DataError, nearest, need_path, reason
from acausal.simulation.finite import warn_of_nonfinite
from acausal.simulation.statistics import Statistics

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from pandas import DataFrame

    from acausal.system import System

AXES = Values(0, 0, 0, None)  # pyright: ignore[reportArgumentType]
"""Which of the values in a trajectory have an axis of time."""


@partial(
    jax.tree_util.register_dataclass,
    data_fields=["values", "statistics"],
    meta_fields=["system"],
    drop_fields=["_observed"],
)
@dataclass(frozen=True, eq=False)
class Solution(ByName):
    """A trajectory. ``solution["body.a"]`` is any variable of the model over ``t``, by its dotted name.

    ``solution[["body.v", "body.a"]]`` has one column for each, shape (n, 2); ``"body.a" in solution`` asks whether the
    model has it; iteration goes through the names.

    Variables other than states are computed when they are first asked for; ask for many at once, in a list or by
    `to_dict`. One that is not finite everywhere is then warned of, with the first time and the equation; but nothing is
    said while JAX traces (`jax.jit`, `jax.grad`): there, ask with ``equinox.error_if(y, ~jnp.isfinite(y), "...")``, or
    return the solution and read it outside.

    Attributes:
        values: times, states and inputs with a leading axis of n points, and parameters.
        system: the model.
        statistics: what the steps have cost; ``None`` for fixed ones.
    """

    values: Values
    system: System
    statistics: Statistics | None = None
    _observed: dict[str, Float[Array, " n"]] = field(
        default_factory=dict[str, Array], init=False, repr=False
    )

    @property
    def t(self) -> Float[Array, " n"]:
        """Times, in seconds."""
        return cast(Array, self.values.t)

    @property
    def x(self) -> Float[Array, "n n_states"]:
        """States."""
        return self.values.x

    @property
    def u(self) -> Float[Array, "n n_inputs"]:
        """Inputs."""
        return self.values.u

    @property
    def packed(self) -> Packed:
        """The model's parameters, `system.pack(params)`."""
        return self.values.packed

    def _column(self, name: str) -> Float[Array, " n"]:
        self._observe((name,))
        return self._observed[name]

    def _side_by_side(self, names: tuple[str, ...]) -> Float[Array, "n n_names"]:
        self._observe(names)
        columns = [self._observed[n] for n in names]
        return jnp.stack(columns, axis=1) if columns else jnp.zeros((self.t.shape[0], 0))

    @property
    def names(self) -> tuple[str, ...]:
        """The names that can be asked for."""
        return tuple(dict.fromkeys((*self.system.variables, *self.system.inputs)))

    def to_dict(self, names: Iterable[str] | None = None) -> dict[str, Float[np.ndarray, " n"]]:
        """Time and variables (by default all) as arrays, under ``time`` and their names."""
        names = self.names if names is None else names_in(names)
        return {"time": np.asarray(self.t), **self._columns(names)}

    def to_dataframe(self, names: Iterable[str] | None = None) -> DataFrame:
        """A pandas DataFrame of the variables (by default all), indexed by time.

        Raises:
            DataError: if pandas is not installed.
        """
        try:
            import pandas as pd
        except ImportError:
            raise DataError(
                "A data frame needs pandas: pip install 'acausal[dataframe]'."
            ) from None
        return pd.DataFrame(self.to_dict(names)).set_index("time")

    def to_csv(self, path: str | Path, names: Iterable[str] | None = None) -> None:
        """Write the variables (by default all) as columns ``name [unit]``, as `Data.from_csv` reads them.

        Raises:
            DataError: for an unknown name, or if the file cannot be written.
        """
        path, columns = need_path(path, "to_csv"), self.to_dict(names)
        units = ("s" if n == "time" else self.system.unit(n) for n in columns)
        try:
            with path.open("w", newline="", encoding="utf-8") as file:
                writer = csv.writer(file)
                writer.writerow(f"{n} [{unit}]" for n, unit in zip(columns, units, strict=True))
                writer.writerows(zip(*(c.tolist() for c in columns.values()), strict=True))
        except OSError as error:
            raise DataError(f"'{path}' cannot be written: {reason(error)}.") from error

    def plot(self, *names: str, axes: Sequence[Axes] | None = None) -> Figure:
        """Plot variables over time, those of one unit in one diagram.

        Arguments:
            names: the variables; without any, the states.
            axes: matplotlib axes, one for each unit; by default a new figure's.

        Returns:
            The matplotlib figure.
        """
        from acausal.reporting import plot_over_time

        chosen = names_in(names[0] if len(names) == 1 else names)
        curves = self._columns(chosen or self.system.states)
        units = {n: self.system.unit(n) for n in curves}
        return plot_over_time(np.asarray(self.t), curves, units, axes=axes)

    def _columns(self, names: Sequence[str]) -> dict[str, Float[np.ndarray, " n"]]:
        self._observe(names)
        return {n: np.asarray(self._observed[n]) for n in names}

    def _observe(self, names: Sequence[str]) -> None:
        unread = new = tuple(n for n in names if n not in self._observed)
        for source, values in ((self.system.states, self.x), (self.system.inputs, self.u)):
            self._observed.update({n: values[:, source.index(n)] for n in new if n in source})
        new = tuple(n for n in new if n not in self._observed)
        for name in new:
            if name not in self.system.variables:
                raise DataError(f"The model has no variable '{name}': {nearest(name, self.names)}")
        if new:
            values = _read_all(self.system, new, self.values)
            self._observed.update(zip(new, values, strict=True))
        warn_of_nonfinite(self.system, self.values, {n: self._observed[n] for n in unread})

    def __repr__(self) -> str:
        shape = f"{self.t.shape[0]} points"
        if not traced(self.t):
            shape += f" from {float(self.t[0]):g} to {float(self.t[-1]):g} s"
        return f"Solution({shape}, {len(self.names)} variables)"


@eqx.filter_jit
def _read_all(system: System, names: tuple[str, ...], values: Values) -> list[Float[Array, " n"]]:
    def at(values: Values) -> Float[Array, " n_names"]:
        return system.read(names, values)

    return list(jax.vmap(at, (AXES,), 1)(values))
