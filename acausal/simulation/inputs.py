"""What drives a model: a user's inputs, checked, as functions of time or as samples on a grid of steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, cast

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array
from jax.typing import ArrayLike

from acausal._jax import traced
from acausal.data import FRACTIONS, Data, Signal, bends
from acausal.errors import DataError, listing, nearest

Drive = Callable[[ArrayLike], Array]
"""One input as a function of time: time in seconds -> scalar."""

ON_GRID = 1e-6
"""A sample lies on the grid of steps if it is within this fraction of a step of a step's end."""


class Constant(eqx.Module):
    """An input that does not change."""

    value: Array

    def __call__(self, t: ArrayLike) -> Array:
        """The value, whatever the time."""
        return self.value


class Function(eqx.Module):
    """A user's function of time, as an input."""

    function: Callable[[ArrayLike], ArrayLike]
    name: str = eqx.field(static=True)

    def __call__(self, t: ArrayLike) -> Array:
        """The function's value as a scalar array.

        Raises:
            DataError: for a function that JAX cannot trace, or that returns no scalar.
        """
        try:
            value = jnp.asarray(self.function(t), jnp.result_type(t))
        except jax.errors.JAXTypeError as error:
            raise DataError(
                f"Input '{self.name}' is a function that JAX cannot trace; write it with jax.numpy "
                "(jnp.sin, jnp.where), or give samples: (times, values)."
            ) from error
        if value.shape != ():
            raise DataError(
                f"Input '{self.name}' is a function that returns shape {value.shape}, no scalar."
            )
        return value


class Samples(eqx.Module):
    """Inputs over a row of n steps.

    Attributes:
        start: values at the steps' starts, shape (n, number of inputs).
        end: values at their ends.
        functions: per input, what is evaluated at stage times instead of the samples, or ``None``.
        bends: how inputs deviate from the line between, the coefficients of `acausal.data.band_limited.bow`, shape
            (n, coefficients, number of inputs); ``None`` where all are linear.
    """

    start: Array
    end: Array
    functions: tuple[Drive | None, ...] = ()
    bends: Array | None = None


def read(
    names: tuple[str, ...], given: Mapping[str, Any] | Data | None, grid: np.ndarray | None
) -> tuple[Drive, ...]:
    """One function of time for each of the model's inputs.

    Arguments:
        names: the model's inputs.
        given: by name, a number; samples on ``grid``; a pair (times, samples); a `Signal`; a function of
            time. Or a record that holds the inputs among other signals.
        grid: ends of the fixed steps, for samples without times.

    Raises:
        DataError: for an input that is missing, unknown or malformed.
    """
    if isinstance(given, Data):
        given = {n: given.signal(n) for n in names if n in given.signals}
    given = given or {}
    unknown = [n for n in given if n not in names]
    if unknown:
        raise DataError(f"The model has no input {listing(unknown)}: {nearest(unknown[0], names)}")
    missing = [n for n in names if n not in given]
    if missing:
        raise DataError(
            f"No value for the model's input {listing(missing)}: give inputs={{'{missing[0]}': ...}}."
        )
    return tuple(_drive(name, given[name], grid) for name in names)


def _drive(name: str, value: Any, grid: np.ndarray | None) -> Drive:
    if isinstance(value, Signal | Constant):
        return value
    if callable(value):
        return Function(cast(Callable[[ArrayLike], ArrayLike], value), name)
    if isinstance(value, tuple) and len(cast(tuple[Any, ...], value)) == 2:
        times, samples = cast(tuple[ArrayLike, ArrayLike], value)
        return Signal(times, samples, name=name)
    if np.ndim(value) == 0:
        if not traced(value) and not np.isfinite(value):
            raise DataError(f"Input '{name}' is {value}.")
        return Constant(jnp.asarray(value, float))
    if grid is None:
        raise DataError(
            f"Input '{name}' has samples but no times: give (times, samples), or dt for fixed steps."
        )
    if np.shape(value) != grid.shape:
        raise DataError(
            f"Input '{name}' has samples of shape {np.shape(value)}; "
            f"the {len(grid) - 1} steps from {grid[0]:g} to {grid[-1]:g} s need {len(grid)}."
        )
    return Signal(grid, cast(ArrayLike, value), name=name)


def evaluate(drives: tuple[Drive, ...], t: ArrayLike) -> Array:
    """All inputs at one time, shape (number of inputs,)."""
    return jnp.stack([d(t) for d in drives]) if drives else jnp.zeros(0)


@eqx.filter_jit
def evaluate_all(drives: tuple[Drive, ...], t: Array) -> Array:
    """All inputs at n times, shape (n, number of inputs)."""
    return jax.vmap(lambda t: evaluate(drives, t))(t)


def over_steps(drives: tuple[Drive, ...], grid: np.ndarray) -> Samples:
    """The inputs over fixed steps.

    An input that is a polynomial within every step becomes samples, which a scan reads at no cost;
    any other stays a function and is evaluated at the stages of every step.
    """
    columns = [_on_grid(d, grid) for d in drives]
    nothing = jnp.zeros(len(grid) - 1)
    pairs = [(nothing, nothing, None) if c is None else c for c in columns]
    functions = tuple(d if c is None else None for d, c in zip(drives, columns, strict=True))
    if not pairs:
        empty = jnp.zeros((len(grid) - 1, 0))
        return Samples(empty, empty)
    starts, ends, bent = zip(*pairs, strict=True)
    return Samples(jnp.stack(starts, axis=1), jnp.stack(ends, axis=1), functions, _bends(bent))


def _bends(columns: tuple[Array | None, ...]) -> Array | None:
    """The coefficients side by side, shape (n, coefficients, number of inputs)."""
    some = [c for c in columns if c is not None]
    if not some:
        return None
    straight = jnp.zeros_like(some[0])
    return jnp.stack([straight if c is None else c for c in columns], axis=-1).swapaxes(0, 1)


def _on_grid(drive: Drive, grid: np.ndarray) -> tuple[ArrayLike, ArrayLike, Array | None] | None:
    """An input at both ends of every step, and how it bends in between; ``None`` if it is no polynomial there."""
    if isinstance(drive, Constant):
        value = jnp.broadcast_to(drive.value, (len(grid) - 1,))
        return value, value, None
    if not isinstance(drive, Signal) or traced(drive.ts):
        return None
    ts, values = np.asarray(drive.ts), drive.values
    if not traced(values):
        values = np.asarray(values)  # spares the compilation of every operation below
    if drive.extrapolation != "hold" or not _knots_on(grid, ts):
        return None
    if drive.interpolation in ("cubic", "band-limited"):
        return _curved(drive, grid)
    if drive.interpolation == "previous":
        value = values[np.maximum(np.searchsorted(ts, (grid[1:] + grid[:-1]) / 2) - 1, 0)]
        return value, value, None
    i = np.clip(np.searchsorted(ts, grid, side="right") - 1, 0, len(ts) - 2)
    w = np.clip((grid - ts[i]) / (ts[i + 1] - ts[i]), 0.0, 1.0)
    w = np.where(np.abs(w - np.round(w)) < ON_GRID, np.round(w), w)
    value = values[i] + w * (values[i + 1] - values[i])
    return value[:-1], value[1:], None


def _curved(signal: Signal, grid: np.ndarray) -> tuple[Array, Array, Array]:
    """Of a polynomial between knots a part between them is one of the same degree, fixed by as many points."""
    steps = grid[:-1, None] + np.diff(grid)[:, None] * FRACTIONS
    at_ends, inner = _at(signal, grid), _at(signal, steps.ravel())
    start, end = at_ends[:-1], at_ends[1:]
    return start, end, bends(start, end, inner.reshape(steps.shape))


@eqx.filter_jit
def _at(signal: Signal, t: ArrayLike) -> Array:
    """A signal at many times."""
    return jax.vmap(signal)(jnp.asarray(t))


def _knots_on(grid: np.ndarray, ts: np.ndarray) -> bool:
    knots = ts[(ts > grid[0]) & (ts < grid[-1])]
    near = np.clip(np.searchsorted(grid, knots), 1, len(grid) - 1)
    distance = np.minimum(np.abs(knots - grid[near]), np.abs(knots - grid[near - 1]))
    return bool(np.all(distance <= ON_GRID * (grid[near] - grid[near - 1])))


def jumps(drives: tuple[Drive, ...], start: float, end: float) -> np.ndarray:
    """Times between ``start`` and ``end`` at which an input is known to jump."""
    held = [d for d in drives if isinstance(d, Signal) and d.interpolation == "previous"]
    known = [np.asarray(d.ts) for d in held if not traced(d.ts)]
    ts = np.unique(np.concatenate(known)) if known else np.zeros(0)
    return ts[(ts > start) & (ts < end)]
