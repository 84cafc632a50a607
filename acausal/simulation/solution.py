"""The result of a simulation: a trajectory that knows its model, so that any variable can be read by name."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax
import numpy as np
from jax import Array

from acausal._jax import traced
from acausal.errors import DataError, nearest

if TYPE_CHECKING:
    from acausal.system import System


@partial(
    jax.tree_util.register_dataclass,
    data_fields=["t", "x", "u", "packed"],
    meta_fields=["system"],
    drop_fields=["_observed"],
)
@dataclass(frozen=True, eq=False)
class Solution:
    """A trajectory. ``solution["body.a"]`` is any variable of the model over ``t``, by its dotted name.

    Variables that are no states are computed when they are first asked for.

    Attributes:
        t: times, shape (n,), in seconds.
        x: states, shape (n, number of states).
        u: inputs, shape (n, number of inputs).
        system: the model.
        packed: its parameters, `system.pack(params)`.
    """

    t: Array
    x: Array
    u: Array
    system: System
    packed: Any = field(repr=False)
    _observed: dict[str, Array] = field(default_factory=dict[str, Array], init=False, repr=False)

    def __getitem__(self, name: str) -> Array:
        """The variable's values, shape (n,).

        Raises:
            DataError: for a name that the model has not.
        """
        self._observe((name,))
        return self._observed[name]

    @property
    def names(self) -> tuple[str, ...]:
        """The names that can be asked for."""
        return tuple(dict.fromkeys((*self.system.variables, *self.system.inputs)))

    def to_dict(self, names: Iterable[str] | None = None) -> dict[str, np.ndarray]:
        """Time and variables (by default all) as arrays, under ``time`` and their names."""
        names = self.names if names is None else tuple(names)
        self._observe(names)
        return {"time": np.asarray(self.t), **{n: np.asarray(self._observed[n]) for n in names}}

    def to_dataframe(self, names: Iterable[str] | None = None) -> Any:
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
        """Write the variables (by default all) as columns ``name [unit]``, as `Data.from_csv` reads them."""
        columns = self.to_dict(names)
        with Path(path).open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(f"{n} [{self._unit(n)}]" for n in columns)
            writer.writerows(zip(*(c.tolist() for c in columns.values()), strict=True))

    def plot(self, *names: str, axes: Sequence[Any] | None = None) -> Any:
        """Plot variables over time, those of one unit in one diagram.

        Arguments:
            names: the variables; without any, the states.
            axes: matplotlib axes, one for each unit; by default a new figure's.

        Returns:
            The matplotlib figure.
        """
        from matplotlib import pyplot as plt

        names = names or self.system.states
        self._observe(names)
        groups: dict[str, list[str]] = {}
        for name in names:
            groups.setdefault(self._unit(name), []).append(name)
        if axes is None:
            size = (7.0, 1.0 + 2.0 * len(groups))
            _, grid = plt.subplots(
                len(groups), 1, sharex=True, squeeze=False, figsize=size, layout="constrained"
            )
            axes = list(grid[:, 0])
        for ax, (unit, members) in zip(axes, groups.items(), strict=True):
            for name in members:
                ax.plot(self.t, self._observed[name], label=name)
            ax.set_ylabel(
                f"{members[0]} in {unit or '1'}" if len(members) == 1 else f"in {unit or '1'}"
            )
            if len(members) > 1:
                ax.legend()
        axes[-1].set_xlabel("time in s")
        return axes[0].figure

    def _unit(self, name: str) -> str:
        return "s" if name == "time" else self.system.unit(name)

    def _observe(self, names: Sequence[str]) -> None:
        new = tuple(n for n in names if n not in self._observed)
        for source, values in ((self.system.states, self.x), (self.system.inputs, self.u)):
            self._observed.update({n: values[:, source.index(n)] for n in new if n in source})
        new = tuple(n for n in new if n not in self._observed)
        for name in new:
            if name not in self.system.variables:
                raise DataError(f"The model has no variable '{name}': {nearest(name, self.names)}")
        if new:
            values = _observe_all(self.system, new, self.t, self.x, self.u, self.packed)
            self._observed.update(zip(new, values, strict=True))

    def __repr__(self) -> str:
        shape = f"{self.t.shape[0]} points"
        if not traced(self.t):
            shape += f" from {float(self.t[0]):g} to {float(self.t[-1]):g} s"
        return f"Solution({shape}, {len(self.names)} variables)"


@eqx.filter_jit
def _observe_all(
    system: System, names: tuple[str, ...], t: Array, x: Array, u: Array, packed: Any
) -> list[Array]:
    def at(t: Array, x: Array, u: Array) -> Array:
        return system.observe(names, t, x, u, packed)

    return list(jax.vmap(at, out_axes=1)(t, x, u))
