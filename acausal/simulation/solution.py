"""The result of a simulation: a trajectory with its model, so that any variable can be read by name."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal._jax import array, compiled, select, traced
from acausal.codegen import Packed, Values, read_and_keep
from acausal.errors import DataError, known_name, need_package
from acausal.files import csv_text, need_path, write_files
from acausal.modeling import ByName, names_in, names_matching
from acausal.simulation.finite import warn_of_nonfinite
from acausal.simulation.inputs import TimeFunction, evaluate_all
from acausal.simulation.log import EVENTS_UNKNOWN, EventList, Log
from acausal.simulation.motion import animation, has_shapes
from acausal.simulation.statistics import Statistics

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from pandas import DataFrame
    from xarray import Dataset

    from acausal.reporting import Animation
    from acausal.system import System

MOST_KEPT = 1_000_000
"""So many numbers of a program's arrays, at most, are kept beside a variable that is asked for."""

CURVES_VIEWED, PLOTS_VIEWED, CURVES_EACH = 12, 4, 6
"""Variables in the view that a notebook shows; its small plots, one for each unit, and curves in each."""


@partial(
    jax.tree_util.register_dataclass,
    data_fields=["values", "statistics", "log"],
    meta_fields=["system"],
    drop_fields=["functions", "_observed", "_arrays"],
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
        values: times, states and inputs with a leading axis of n points, and parameters; with that axis, too, where
            they drift.
        system: the model.
        statistics: what the steps have cost; ``None`` for fixed ones.
        log: times of the events and what came first, as arrays; `events` has them in words.
        functions: the inputs as functions of time; not part of what JAX sees, nor of a copy in another process.
    """

    values: Values
    system: System
    statistics: Statistics | None = None
    log: Log | None = None
    functions: tuple[TimeFunction, ...] | None = field(default=None, repr=False)
    _observed: dict[str, Float[Array, " n"]] = field(
        default_factory=dict[str, Array], init=False, repr=False
    )
    _arrays: dict[int, Array] = field(default_factory=dict[int, Array], init=False, repr=False)

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

    @property
    def d(self) -> Float[Array, "n n_discrete"]:
        """Discrete variables: those of watched conditions first."""
        empty = jnp.zeros((self.t.shape[0], 0))
        return empty if self.values.d is None else self.values.d

    @property
    def events(self) -> EventList:
        """What has happened, in order of time: instants, the condition that changed there first, and what it changed.

        It prints a line for each of the first.

        Raises:
            DataError: while JAX traces, and for runs side by side (`jax.vmap`).
        """
        log = self._known_log
        return EventList() if log is None else log.events(self.system)

    @cached_property
    def before(self) -> Solution:
        """All variables just before each event, as far as they are kept: ``run.before["motor.i"]``.

        Raises:
            DataError: as for `events`; and for a model with inputs, if JAX has returned the solution.
        """
        return self._beside(after=False)

    @cached_property
    def after(self) -> Solution:
        """All variables just after each event; as `before`."""
        return self._beside(after=True)

    @property
    def _known_log(self) -> Log | None:
        """The log; it is refused where derivatives are taken, as it has none."""
        if self.log is not None and traced(self.values):
            raise DataError(EVENTS_UNKNOWN)
        return self.log

    def _beside(self, *, after: bool) -> Solution:
        known_log, n = self._known_log, len(self.system.states)
        log = None if known_log is None else known_log.kept()
        if log is None:
            nothing = self.values._replace(t=self.t[:0], x=self.x[:0], u=self.u[:0])
            return Solution(nothing, self.system)
        side = log.after if after else log.before
        t = np.asarray(log.t)[: len(side)]
        if self.functions is None and self.system.inputs:
            raise DataError(
                "The inputs at events are not known of a solution that JAX has returned, or that was copied; "
                "simulate outside of jax.jit."
            )
        at = jnp.asarray(t if after else np.nextafter(t, -np.inf))
        u = evaluate_all(self.functions or (), at)
        values = self.values._replace(t=jnp.asarray(t), x=side[:, :n], u=u, d=side[:, n:])
        return Solution(values, self.system)

    def __getstate__(self) -> dict[str, Any]:
        """Without inputs: they may be functions that cannot be pickled."""
        return {**self.__dict__, "functions": None}

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

    def unit(self, name: str) -> str:
        """Unit of a variable, in Modelica's spelling; ``"s"`` for ``time``."""
        return "s" if isinstance(name, str) and name == "time" else self.system.unit(name)

    def to_dict(self, names: Iterable[str] | None = None) -> dict[str, Float[np.ndarray, " n"]]:
        """Time and variables (by default all) as arrays, under ``time`` and their names; patterns as for `plot`."""
        names = self.names if names is None else names_matching(names, self.names)
        return {"time": np.asarray(self.t), **self._columns(names)}

    def to_dataframe(self, names: Iterable[str] | None = None) -> DataFrame:
        """A pandas DataFrame of the variables (by default all), indexed by time.

        Raises:
            DataError: if pandas is not installed.
        """
        pd = need_package("pandas", "A data frame", "dataframe")
        return pd.DataFrame(self.to_dict(names)).set_index("time")

    def to_csv(self, path: str | Path, names: Iterable[str] | None = None) -> None:
        """Write the variables (by default all) as columns ``name [unit]``, as `Data.from_csv` reads them.

        Raises:
            DataError: for an unknown name, or if the file cannot be written.
        """
        path, columns = need_path(path, "to_csv"), self.to_dict(names)
        write_files({path: csv_text({f"{n} [{self.unit(n)}]": c for n, c in columns.items()})})

    def to_xarray(self, names: Iterable[str] | None = None) -> Dataset:
        """An xarray Dataset of the variables (by default all) over ``time``, with their units as attributes.

        Raises:
            DataError: if xarray is not installed.
        """
        xr = need_package("xarray", "A dataset", "xarray")
        time, columns = np.asarray(self.t), self.to_dict(names)
        del columns["time"]
        variables = {n: ("time", c, {"units": self.unit(n)}) for n, c in columns.items()}
        return xr.Dataset(variables, {"time": ("time", time, {"units": "s"})})

    def plot(self, *names: str | Iterable[str], axes: Sequence[Axes] | None = None) -> Figure:
        """Plot variables over time, those of one unit in one diagram.

        Where events happened, both sides are drawn: what jumps is a vertical line at its instant, and discrete
        variables are steps.

        Arguments:
            names: the variables, or lists of them; without any, the states. In a pattern, ``*`` stands for a word
                between dots and ``**`` for any: ``"c.*"`` are the variables of ``c``, ``"**.v"`` all voltages.
            axes: matplotlib axes, one for each unit; by default a new figure's.

        Returns:
            The matplotlib figure.
        """
        from acausal.reporting import plot_over_time

        given = [name for some in names for name in names_in(some)]
        chosen = names_matching(given, self.names) or self.system.states
        time, curves = self._with_both_sides(chosen)
        units = {n: self.system.unit(n) for n in curves}
        steps = [n for n in curves if self.system.is_discrete(n)]
        return plot_over_time(time, curves, units, axes=axes, steps=steps)

    @property
    def groups(self) -> dict[str, tuple[str, ...]]:
        """The variables that a page shows, by heading; states first."""
        return {"States": self.system.states, "Inputs": self.system.inputs}

    def deviations(self, names: Sequence[str]) -> dict[str, Float[np.ndarray, " n"]]:
        """The standard deviations of some variables over time, where they are known: of estimates."""
        return {}

    def animation(self, *, trace: str | None = None, caption: str = "") -> Animation:
        """The mechanism in motion, a part of a page: ``page.add(solution.animation(trace="coupler"))``.

        Bodies, rods and joints are drawn to scale as the method ``shapes`` of their classes says, and `acausal.page`
        shows the same.

        Arguments:
            trace: the component whose way is shown at first; by default the one that moves farthest.
            caption: what is shown.

        Raises:
            DataError: if no component has a shape, or ``trace`` is none that has a way.
        """
        t = np.asarray(self.t, float)
        return animation(
            self.system, self.packed.last, t, self._columns, trace=trace, caption=caption
        )

    def _with_both_sides(
        self, names: Sequence[str]
    ) -> tuple[Float[np.ndarray, " n"], dict[str, Float[np.ndarray, " n"]]]:
        """Times and variables, with two more points for each event within the times, where these are known."""
        time, curves = np.asarray(self.t), self._columns(names)
        known = self.functions is not None or not self.system.inputs
        if self.log is None or not len(time) or not known or not len(self.before.t):
            return time, curves
        events = np.asarray(self.before.t)
        inside = np.repeat((events >= time[0]) & (events <= time[-1]), 2)
        both = np.repeat(events, 2)[inside]
        order = np.argsort(np.concatenate([both, time]), kind="stable")
        before, after = self.before._columns(names), self.after._columns(names)
        sides = {n: np.stack([before[n], after[n]], axis=1).ravel()[inside] for n in names}
        merged = {n: np.concatenate([sides[n], curves[n]])[order] for n in names}
        return np.concatenate([both, time])[order], merged

    def _columns(self, names: Sequence[str]) -> dict[str, Float[np.ndarray, " n"]]:
        self._observe(names)
        return {n: np.asarray(self._observed[n]) for n in names}

    def _observe(self, names: Sequence[str]) -> None:
        unread = new = tuple(n for n in names if n not in self._observed)
        exact = self.system.reduced.exact.tolist()
        states = [n if own else "" for n, own in zip(self.system.states, exact, strict=True)]
        for source, values in ((states, self.x), (self.system.inputs, self.u)):
            column = {n: i for i, n in enumerate(source)}
            found = {n: select(values, (..., column[n])) for n in new if n in column}
            self._observed.update(found)
        new = tuple(n for n in new if n not in self._observed)
        if unknown := set(new).difference(self.system.variables):
            first = next(n for n in new if n in unknown)
            known_name(first, self.system.variables, "The model has no variable")
        if new:
            self._compute(new)
        warn_of_nonfinite(self.system, self.values, {n: self._observed[n] for n in unread})

    def _compute(self, names: tuple[str, ...]) -> None:
        """Read variables that are computed, and keep the arrays of the program that they were computed with."""
        program, (nodes, signs) = self.system.program, self.system.nodes_of(names)
        places = list(zip(*(side[nodes].tolist() for side in program.positions), strict=True))
        if any(a not in self._arrays for a, _ in places):
            sources = {source for source, _ in places}.difference(self._arrays)
            filled = program.filled(sources, self._arrays)
            few = sum(program.sizes[a] for a in filled) * self.t.size <= MOST_KEPT
            keep = filled if few else ()
            # of an array that is kept one number is enough: XLA is slow to give thousands of results
            own = {n: a for n, (a, _) in zip(names, places, strict=True) if a not in self._arrays}
            of_kept = {a: n for n, a in own.items() if a in keep}
            wanted = (*(n for n, a in own.items() if a not in keep), *of_kept.values())
            found, kept = _read_all(self.system, wanted, self.values, self._arrays, keep)
            self._observed.update(zip(wanted, found, strict=True))
            self._arrays.update(kept)
        for name, (source, index), sign in zip(names, places, signs.tolist(), strict=True):
            if name not in self._observed:
                whole = self._arrays[source]
                column = whole if whole.ndim == self.t.ndim else select(whole, (..., index))
                turned = column if traced(column) else np.asarray(column)
                self._observed[name] = column if sign == 1 else array(-turned, column.dtype)

    @property
    def _about(self) -> list[str]:
        """Facts for a view."""
        return []

    def _repr_html_(self) -> str:
        from acausal.reporting import Curve, View, small_plot, still

        title = f"{type(self).__name__} of {self.system.flat.name}"
        if traced(self.t) or self.t.ndim != 1 or not len(self.t):
            return str(View(title, f"shape {self.t.shape}"))
        states, *others = self.groups.values()
        names = (*states, *self.system.discrete, *(n for some in others for n in some))
        names = names[:CURVES_VIEWED]
        time, curves = self._with_both_sides(names or self.names[:CURVES_VIEWED])
        about = [f"{len(self.t)} points from {float(self.t[0]):g} to {float(self.t[-1]):g} s"]
        about += [f"{len(self.names)} variables, by name: solution['{self.names[0]}']"]
        about += self._about
        about += [f"{len(self.events)} events"] if self.log is not None else []
        about += [str(self.statistics)] if self.statistics is not None else []
        view, sigma = View(title, ", ".join(about)), self.deviations(names)
        if has_shapes(self.system):
            view.html(still(self.animation()))
        units = {n: self.system.unit(n) for n in curves}
        groups: dict[str, list[Curve]] = {}
        for n, y in curves.items():
            steps = self.system.is_discrete(n)
            curve = Curve(n, time, y, sigma=sigma.get(n), steps=steps)
            groups.setdefault(units[n], []).append(curve)
        for unit, lines in list(groups.items())[:PLOTS_VIEWED]:
            plot = small_plot(lines[:CURVES_EACH], across="time in s", upwards=unit or "1")
            view.html(plot)
        rows = [
            (name, y[0], y[-1], np.nanmin(y), np.nanmax(y), units[name])
            for name, y in curves.items()
            if len(y) and not np.isnan(y).all()
        ]
        if rows:
            view.table(("", "at the start", "at the end", "least", "largest", "unit"), rows)
        return str(view)

    def __repr__(self) -> str:
        shape = f"{self.t.shape[0]} points"
        if not traced(self.t):
            shape += f" from {float(self.t[0]):g} to {float(self.t[-1]):g} s"
        return f"Solution({shape}, {len(self.names)} variables)"


@compiled
def _read_all(
    system: System,
    names: tuple[str, ...],
    values: Values,
    known: dict[int, Array],
    kept: tuple[int, ...],
) -> tuple[list[Float[Array, " n"]], dict[int, Array]]:
    """Variables, and arrays of the program to keep, over all points; ``known``: arrays that were kept earlier."""
    drift = values.packed.values.ndim == 2
    numbers = values.packed.values if drift else None
    points = (values.t, values.x, values.u, values.d, numbers, known)
    nodes, signs = system.nodes_of(names)

    def at(point: tuple[Any, ...]) -> tuple[Float[Array, " n_names"], dict[int, Array]]:
        t, x, u, d, numbers, known = point
        packed = Packed(numbers, values.packed.modules) if drift else values.packed
        found, own = read_and_keep(system.program, nodes, Values(t, x, u, packed, d), known, kept)
        return found * signs, own

    # One after the other, each point iterates as often as it needs, and XLA compiles one of them.
    sources = system.program.gather(nodes).sources
    iterates = system.program.iterates(sources, known)
    rows, arrays = jax.lax.map(at, points) if iterates else jax.vmap(at)(points)
    return list(rows.T), arrays
