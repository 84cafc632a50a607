"""`sweep`: many variants of a simulation at once, over values of parameters, inputs and initial states."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from math import prod
from typing import TYPE_CHECKING, Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from numpy.typing import ArrayLike

from acausal._jax import is_real
from acausal.codegen import asserted, failures
from acausal.errors import (
    DataError,
    nearest,
    need_compiled,
    need_flag,
    need_package,
    need_text,
    need_whole,
    shown,
    warn,
)
from acausal.jobs import Workers, blocks, need_workers, on_workers
from acausal.modeling import ByName, by_name, names_in, names_matching
from acausal.simulation.simulate import simulate
from acausal.simulation.small_states import sizes_at_start, with_small_states
from acausal.simulation.solution import Solution
from acausal.simulation.step_grid import in_bytes, memory

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from xarray import Dataset

    from acausal.system import System

VARIANT = "variant"
"""The axis of variants that are not a grid."""


@dataclass(frozen=True, eq=False, repr=False)
class Sweep(ByName):
    """Variants of a simulation. ``result["c.v"]`` has an axis for each value that was varied, and time last.

    Attributes:
        runs: the simulations, with a leading axis of all variants, the last value varying fastest.
        over: the values that were varied, by name.
        grid: whether every value meets every other; else they vary together, along one axis.
    """

    runs: Solution
    over: Mapping[str, Float[np.ndarray, " n"]]
    grid: bool = True
    _columns: dict[str, Array] = field(default_factory=dict[str, Array], init=False)

    @property
    def t(self) -> Float[Array, " n"]:
        """Times, in seconds."""
        return self.runs.t[0]

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the axes: those that were varied, or ``"variant"``, and ``"time"``."""
        return (*self.over, "time") if self.grid else (VARIANT, "time")

    @property
    def shape(self) -> tuple[int, ...]:
        """Sizes of the axes."""
        sizes = tuple(map(len, self.over.values()))
        return (*(sizes if self.grid else sizes[:1]), len(self.t))

    @property
    def names(self) -> tuple[str, ...]:
        """The names that can be asked for."""
        return self.runs.names

    def unit(self, name: str) -> str:
        """Unit of a variable, in Modelica's spelling; ``"s"`` for ``time``."""
        return self.runs.unit(name)

    def sel(self, values: Mapping[str, float]) -> Sweep | Solution:
        """The variants nearest to some values: a `Solution` if one is left, else those along the other axes.

        Arguments:
            values: by name, such as ``{"r.R": 47.0}``.

        Raises:
            DataError: for a name that was not varied, or what is not a number.
        """
        values = by_name(values, "sel", "{'spring.c': ...}")
        for name, value in values.items():
            if name not in self.over:
                raise DataError(f"'{name}' was not varied; {nearest(name, self.over)}")
            if not is_real(value) or np.ndim(value):
                raise DataError(f"sel: '{name}' is {shown(value)}; give a number.")
        if not self.grid:
            spans = {n: np.ptp(self.over[n]) or 1.0 for n in values}
            far = sum(((self.over[n] - v) / spans[n]) ** 2 for n, v in values.items())
            return self.isel({VARIANT: int(np.argmin(far))})
        return self.isel({n: int(np.argmin(np.abs(self.over[n] - v))) for n, v in values.items()})

    def isel(self, indices: Mapping[str, int]) -> Sweep | Solution:
        """The same as `sel` by positions along the axes, counted from 0.

        Raises:
            DataError: for a name that is no axis, or a position outside.
        """
        indices = by_name(indices, "isel", "{'spring.c': ...}")
        for name, index in indices.items():
            if name not in self.dims[:-1]:
                raise DataError(f"isel: {nearest(name, self.dims[:-1])}")
            size = self.shape[self.dims.index(name)]
            if not -size <= need_whole(index, f"isel: '{name}'") < size:
                raise DataError(
                    f"isel: '{name}' has {size} values, counted from 0; there is no {index}."
                )
        rows = np.arange(prod(self.shape[:-1])).reshape(self.shape[:-1])
        rows = rows[tuple(indices.get(name, slice(None)) for name in self.dims[:-1])]
        runs = jax.tree.map(lambda leaf: leaf[rows.ravel() if rows.ndim else int(rows)], self.runs)
        if not rows.ndim:
            return runs
        return Sweep(runs, {n: v for n, v in self.over.items() if n not in indices}, self.grid)

    def to_xarray(self, names: str | Iterable[str] | None = None) -> Dataset:
        """An xarray Dataset of some variables (by default the states; patterns as for `Solution.plot`), with units.

        Raises:
            DataError: if xarray is not installed.
        """
        xr = need_package("xarray", "A dataset", "xarray")
        chosen = self.runs.system.states if names is None else names_matching(names, self.names)
        axes = {n: (n if self.grid else VARIANT,) for n in self.over} | {"time": ("time",)}
        units = {n: self.unit(n) for n in axes}
        values = {**self.over, "time": np.asarray(self.t)}
        return xr.Dataset(
            {n: (self.dims, np.asarray(self[n]), {"units": self.unit(n)}) for n in chosen},
            {n: (axis, values[n], {"units": units[n]}) for n, axis in axes.items()},
        )

    def plot(self, name: str, *, ax: Axes | None = None) -> Figure:
        """Draw one variable over time, with a line for each variant, coloured by the first value that was varied.

        Arguments:
            name: of the variable.
            ax: matplotlib axes; by default a new figure's.

        Returns:
            The matplotlib figure.
        """
        from acausal.reporting import plot_variants

        first, values = next(iter(self.over.items()))
        lines = np.asarray(self._column(need_text(name, "name"))).reshape(-1, len(self.t))
        levels = np.repeat(values, len(lines) // len(values))
        labels = (_label(name, self.unit(name)), _label(first, self.unit(first)))
        return plot_variants(np.asarray(self.t), lines, levels, labels, ax=ax)

    def _column(self, name: str) -> Float[Array, ...]:
        return self._read((name,))[name]

    def _side_by_side(self, names: tuple[str, ...]) -> Float[Array, "... n_names"]:
        found = self._read(names)
        columns = [found[name] for name in names]
        return jnp.stack(columns, axis=-1) if columns else jnp.zeros((*self.shape, 0))

    def _read(self, names: tuple[str, ...]) -> dict[str, Array]:
        new = tuple(name for name in names if name not in self._columns)
        if new:
            values = jax.vmap(lambda run: run[new])(self.runs)
            for i, name in enumerate(new):
                self._columns[name] = values[..., i].reshape(self.shape)
        return self._columns

    def __repr__(self) -> str:
        sizes = ", ".join(f"{n}: {size}" for n, size in zip(self.dims, self.shape, strict=True))
        return f"Sweep({sizes}; {len(self.names)} variables)"


def sweep(
    system: System,
    over: Mapping[str, ArrayLike],
    t: float | tuple[float, float],
    *,
    grid: bool = True,
    inputs: Any = None,
    params: Mapping[str, Any] | None = None,
    x0: Any = None,
    executor: Workers | None = None,
    **options: Any,
) -> Sweep:
    """Simulate many variants of a model at once, in one compiled program.

    The first call compiles; another with as many variants of the same names does not.

    Arguments:
        system: a compiled model.
        over: values by name, each a sequence of numbers: of parameters, of inputs that are constant, or of states at
            the start.
        t: start and end in seconds, or the end.
        grid: whether every value meets every other, with an axis for each name. Otherwise they vary together, and all
            have the same length.
        inputs, params, x0: what all variants have in common, as of `simulate`.
        executor: whose workers simulate the variants, some dozens of blocks of them: any
            `concurrent.futures.Executor`, or a function that makes one. By default this process does.
        options: the other arguments of `simulate`, such as ``dt`` and ``solver``.

    Returns:
        The trajectories, any variable of them by name.

    Raises:
        ModelError: for a model that is not compiled.
        DataError: for an unknown name, values that are no numbers or outside of a parameter's range, and as `simulate`;
            for what cannot be sent to workers, and for workers that are lost again and again.

    Warns:
        UserWarning: if variants did not reach the end; their values are not finite.
    """
    need_compiled(system, "sweep")
    if not isinstance(over, Mapping) or not over:
        raise DataError(
            f"over={shown(over)} are not values by name, such as {{'r.R': [1.0, 2.0]}}."
        )
    values = {name: _values(system, name, over[name]) for name in names_in(over, "over")}
    _check_size(system, values, need_flag(grid, "sweep: grid"), options.get("saveat"))
    columns = _variants(values, grid)
    roles = {name: _role(system, name) for name in values}
    common = {"params": params, "inputs": inputs, "x0": x0}
    for role, argument in common.items():
        if role in roles.values() and not (argument is None or isinstance(argument, Mapping)):
            raise DataError(f"{role}: give a mapping by name, to which sweep adds what it varies.")
    if "params" in roles.values() and params is None:
        common["params"] = system.parameters()

    make = _runs if executor is None else partial(_on_workers, executor)

    def made(**finer: Any) -> Solution:
        return make(_Shared(system, t, roles, common, {**options, **finer}), columns)

    if options.get("dt") is None and options.get("atol") is None:
        named = {n: np.min(np.abs(v)) for n, v in values.items() if roles[n] == "x0"}
        named |= x0 if isinstance(x0, Mapping) else {}
        begins = options.get("saveat") is None
        runs = with_small_states(
            lambda atol: made(atol=atol),
            len(system.states),
            lambda found: sizes_at_start(
                system, system.pack(None), named, found.x[:, 0] if begins else None
            ),
        )
    else:
        runs = made()
    _warn_of_broken(runs, columns)
    return Sweep(runs, values, grid)


class _Shared(NamedTuple):
    """What all variants share: `simulate`'s arguments, and by name which of these takes what is varied."""

    system: System
    t: float | tuple[float, float]
    roles: Mapping[str, str]
    common: Mapping[str, Any]
    options: Mapping[str, Any]


def _runs(shared: _Shared, columns: Mapping[str, Float[np.ndarray, " n_variants"]]) -> Solution:
    """The variants, in one compiled program."""

    def one(varied: dict[str, Array]) -> Solution:
        given = dict(shared.common)
        for role in dict.fromkeys(shared.roles.values()):
            own = {name: value for name, value in varied.items() if shared.roles[name] == role}
            given[role] = {**(shared.common[role] or {}), **own}
        return simulate(shared.system, shared.t, **given, **shared.options)

    return jax.vmap(one)({name: jnp.asarray(column) for name, column in columns.items()})


def _leaves(
    shared: _Shared, columns: Mapping[str, Float[np.ndarray, " n_variants"]]
) -> list[np.ndarray]:
    """The arrays of `_runs`: a worker need not send the model back."""
    return list(map(np.asarray, jax.tree.leaves(_runs(shared, columns))))


def _on_workers(
    executor: Workers, shared: _Shared, columns: Mapping[str, Float[np.ndarray, " n_variants"]]
) -> Solution:
    """The variants in blocks of one length, so that a worker compiles once; the last one is filled up."""
    need_workers(executor, "sweep")
    total = len(next(iter(columns.values())))
    every = blocks(total)
    rows = [np.minimum(np.arange(len(every[0])) + block.start, total - 1) for block in every]
    tasks = [{name: column[own] for name, column in columns.items()} for own in rows]
    kind = jax.tree.structure(jax.eval_shape(partial(_runs, shared), tasks[0]))
    parts = zip(*on_workers(executor, _leaves, shared, tasks, "sweep"), strict=True)
    return jax.tree.unflatten(kind, [jnp.asarray(np.concatenate(part)[:total]) for part in parts])


def _role(system: System, name: str) -> str:
    """The argument of `simulate` that takes the values of a name."""
    starts = (*system.states, *system.remembered)
    for role, known in (
        ("params", system.layout.names), ("inputs", system.inputs), ("x0", starts),
    ):  # fmt: skip
        if name in known:
            return role
    reason = system.layout.why_not_free(name)
    known = (*system.layout.names, *system.inputs, *starts)
    raise DataError(
        f"over: {reason}." if reason
        else f"over: '{name}' is no parameter, input or state; {nearest(name, known)}"
    )  # fmt: skip


def _values(system: System, name: str, given: ArrayLike) -> Float[np.ndarray, " n"]:
    role = _role(system, name)
    if not is_real(given):
        raise DataError(f"over: '{name}' is {shown(given)}; give numbers.")
    values = np.atleast_1d(np.asarray(given, float))
    if values.ndim != 1 or not len(values) or not np.isfinite(values).all():
        raise DataError(f"over: '{name}' has shape {values.shape}; give a row of finite numbers.")
    if role == "params":
        low, high = system.layout.range_of(name)
        outside = values[(values < low) | (values > high)]
        if len(outside):
            limit = f"at least {low:g}" if outside[0] < low else f"at most {high:g}"
            unit = system.unit(name)
            raise DataError(
                f"over: '{name}' has {outside[0]:g}, but must be {limit} {unit}".rstrip() + "."
            )
    return values


def _check_size(
    system: System, values: Mapping[str, Float[np.ndarray, " n"]], grid: bool, saveat: Any
) -> None:
    """Refuse more variants than this machine's memory holds.

    Raises:
        DataError: for them.
    """
    lengths = list(map(len, values.values()))
    count, rows = prod(lengths) if grid else max(lengths), 2 if saveat is None else np.size(saveat)
    needed = 8.0 * count * (len(values) + (1 + len(system.states)) * rows)
    if needed > memory():
        raise DataError(
            f"over: {count:.3g} variants need {in_bytes(needed)} of memory or more where there are "
            f"{in_bytes(memory())}; vary fewer values."
        )


def _variants(
    values: Mapping[str, Float[np.ndarray, " n"]], grid: bool
) -> dict[str, Float[np.ndarray, " n_variants"]]:
    """The value of every name in every variant."""
    if grid:
        meshes: Sequence[np.ndarray] = np.meshgrid(*values.values(), indexing="ij")
        return {name: mesh.ravel() for name, mesh in zip(values, meshes, strict=True)}
    lengths = {name: len(column) for name, column in values.items()}
    if len(set(lengths.values())) > 1:
        differ = ", ".join(f"'{name}' has {n}" for name, n in lengths.items())
        raise DataError(f"over: values that vary together are equally many, but {differ}.")
    return dict(values)


def _failures(runs: Solution, count: int) -> list[str]:
    """For each variant the first assertion that does not hold; empty where all do."""
    system = runs.system
    if not system.flat.assertions:
        return [""] * count
    names = asserted(system.flat)
    values, t = np.asarray(runs.packed.values), np.asarray(runs.t)
    columns = None if not names else np.asarray(jax.vmap(lambda run: run[names])(runs))

    def first(k: int) -> str:
        value = system.layout.by_number(values[k] if values.ndim > 1 else values)
        found = failures(system.flat, value)
        if names is not None:
            own = {} if columns is None else dict(zip(names, columns[k].T, strict=True))
            found |= failures(system.flat, value, {"time": t[k] if t.ndim > 1 else t, **own})
        return next(iter(found), "")

    return list(map(first, range(count)))


def _warn_of_broken(runs: Solution, columns: Mapping[str, Float[np.ndarray, " n"]]) -> None:
    broken = ~np.all(np.isfinite(np.asarray(runs.x)), axis=(1, 2))
    endless, span = np.zeros_like(broken), float(np.ptp(runs.t))
    if runs.log is not None:
        every = jax.tree.map(np.asarray, runs.log)  # whose rows cost nothing
        logs = (jax.tree.map(lambda a, k=k: a[k], every) for k in range(len(broken)))
        endless |= [log.without_end(span) is not None for log in logs]
    failed = _failures(runs, len(broken))
    first_failed = next((text for text in failed if text), "")
    for which, what, why in (
        (broken, "did not reach the end", "their values are not finite"),
        (endless, "went on behind events without end", "they slide or bounce for ever"),
        (np.asarray(list(map(bool, failed))), "are not as their model asserts", first_failed),
    ):
        if which.any():
            first = int(np.argmax(which))
            where = ", ".join(f"{name} = {column[first]:g}" for name, column in columns.items())
            warn(
                f"{np.sum(which)} of {which.size} variants {what}, the first with {where}: {why}. Simulate that one "
                "alone to see why."
            )


def _label(name: str, unit: str) -> str:
    return f"{name} in {unit or '1'}"
