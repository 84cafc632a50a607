"""The inputs of a simulation: checked, then functions of time, or samples on a grid of steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, TypeAlias, cast

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal._jax import traced
from acausal.data import FRACTIONS, Signal, polynomial_coefficients
from acausal.errors import DataError, listing, nearest
from acausal.simulation.step_grid import ON_GRID

TimeFunction: TypeAlias = Callable[[ArrayLike], Array]
"""One input as a function of time: time in seconds -> scalar."""

Ends: TypeAlias = Float[np.ndarray, " n_ends"]
"""The ends of n steps, with the first one's start: n + 1 times in seconds."""


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
            DataError: for a function that JAX cannot trace, or that does not return a scalar.
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
                f"Input '{self.name}' is a function that returns shape {value.shape}, not a scalar."
            )
        return value


class Samples(eqx.Module):
    """Inputs over n steps.

    Attributes:
        start: values at the steps' starts, shape (n, number of inputs).
        end: values at their ends.
        functions: per input, the function to evaluate at stage times instead of the samples, or ``None``.
        coefficients: of the polynomials by which inputs deviate from the line in between
            (`acausal.data.band_limited.deviation_from_line`); ``None`` where all are linear.
    """

    start: Float[Array, "n n_inputs"]
    end: Float[Array, "n n_inputs"]
    functions: tuple[TimeFunction | None, ...] = ()
    coefficients: Float[Array, "n n_coefficients n_inputs"] | None = None


def functions_of_time(
    names: tuple[str, ...], given: Mapping[str, Any], ends: Ends | None
) -> tuple[TimeFunction, ...]:
    """One function of time for each of the model's inputs.

    Arguments:
        names: the model's inputs.
        given: by name, a number; samples at ``ends``; a pair (times, samples); a `Signal`; a function of time.
        ends: ends of the fixed steps, for samples without times.

    Raises:
        DataError: for an input that is missing, unknown or malformed.
    """
    unknown = [n for n in given if n not in names]
    if unknown:
        raise DataError(f"The model has no input {listing(unknown)}: {nearest(unknown[0], names)}")
    missing = [n for n in names if n not in given]
    if missing:
        raise DataError(
            f"No value for the model's input {listing(missing)}: give inputs={{'{missing[0]}': ...}}."
        )
    return tuple(_function(name, given[name], ends) for name in names)


def _function(name: str, value: object, ends: Ends | None) -> TimeFunction:
    if isinstance(value, Signal | Constant):
        return value
    if callable(value):
        return Function(cast(Callable[[ArrayLike], ArrayLike], value), name)
    if isinstance(value, tuple) and len(cast(tuple[Any, ...], value)) == 2:
        times, samples = cast(tuple[ArrayLike, ArrayLike], value)
        return Signal(times, samples, name=name)
    samples = cast(ArrayLike, value)
    if np.ndim(samples) == 0:
        if not traced(samples) and not np.isfinite(samples):
            raise DataError(f"Input '{name}' is {samples}.")
        return Constant(jnp.asarray(samples, float))
    if ends is None:
        raise DataError(
            f"Input '{name}' has samples but no times: give (times, samples), or dt for fixed steps."
        )
    if np.shape(samples) != ends.shape:
        raise DataError(
            f"Input '{name}' has samples of shape {np.shape(samples)}; "
            f"the {len(ends) - 1} steps from {ends[0]:g} to {ends[-1]:g} s need {len(ends)}."
        )
    return Signal(ends, samples, name=name)


def evaluate(functions: tuple[TimeFunction, ...], t: ArrayLike) -> Float[Array, " n_inputs"]:
    """All inputs at one time."""
    return jnp.stack([f(t) for f in functions]) if functions else jnp.zeros(0)


@eqx.filter_jit
def evaluate_all(
    functions: tuple[TimeFunction, ...], t: Float[Array, " n"]
) -> Float[Array, "n n_inputs"]:
    """All inputs at n times."""
    return jax.vmap(lambda t: evaluate(functions, t))(t)


class _Sampled(NamedTuple):
    """One input over n steps: values at starts and ends, and the coefficients of its deviation from the line."""

    start: ArrayLike
    end: ArrayLike
    coefficients: Float[Array, "n_coefficients n"] | None = None


def over_steps(functions: tuple[TimeFunction, ...], ends: Ends) -> Samples:
    """The inputs over fixed steps.

    An input that is a polynomial within every step becomes samples, which a scan reads at no cost.
    Any other one stays a function, which is evaluated at the stages of every step.
    """
    sampled = [_on_grid(f, ends) for f in functions]
    nothing = jnp.zeros(len(ends) - 1)
    columns = [_Sampled(nothing, nothing) if c is None else c for c in sampled]
    left = tuple(f if c is None else None for f, c in zip(functions, sampled, strict=True))
    if not columns:
        empty = jnp.zeros((len(ends) - 1, 0))
        return Samples(empty, empty)
    at_starts, at_ends, coefficients = zip(*columns, strict=True)
    return Samples(
        jnp.stack(at_starts, axis=1), jnp.stack(at_ends, axis=1), left, _side_by_side(coefficients)
    )


def _side_by_side(
    columns: tuple[Float[Array, "n_coefficients n"] | None, ...],
) -> Float[Array, "n n_coefficients n_inputs"] | None:
    some = [c for c in columns if c is not None]
    if not some:
        return None
    straight = jnp.zeros_like(some[0])
    return jnp.stack([straight if c is None else c for c in columns], axis=-1).swapaxes(0, 1)


def _on_grid(function: TimeFunction, ends: Ends) -> _Sampled | None:
    """An input over every step; ``None`` if it is not a polynomial there."""
    if isinstance(function, Constant):
        value = jnp.broadcast_to(function.value, (len(ends) - 1,))
        return _Sampled(value, value)
    if not isinstance(function, Signal) or traced(function.ts):
        return None
    ts, values = np.asarray(function.ts), function.values
    if not traced(values):
        values = np.asarray(values)  # spares the compilation of every operation below
    if function.extrapolation != "hold" or not _samples_on(ends, ts):
        return None
    if function.interpolation in ("cubic", "band-limited"):
        return _curved(function, ends)
    if function.interpolation == "previous":
        value = values[np.maximum(np.searchsorted(ts, (ends[1:] + ends[:-1]) / 2) - 1, 0)]
        return _Sampled(value, value)
    i = np.clip(np.searchsorted(ts, ends, side="right") - 1, 0, len(ts) - 2)
    w = np.clip((ends - ts[i]) / (ts[i + 1] - ts[i]), 0.0, 1.0)
    w = np.where(np.abs(w - np.round(w)) < ON_GRID, np.round(w), w)
    value = values[i] + w * (values[i + 1] - values[i])
    return _Sampled(value[:-1], value[1:])


def _curved(signal: Signal, ends: Ends) -> _Sampled:
    """A part of a polynomial is a polynomial of the same degree, determined by as many points."""
    steps = ends[:-1, None] + np.diff(ends)[:, None] * FRACTIONS
    at_ends, inner = _at(signal, ends), _at(signal, steps.ravel())
    start, end = at_ends[:-1], at_ends[1:]
    return _Sampled(start, end, polynomial_coefficients(start, end, inner.reshape(steps.shape)))


@eqx.filter_jit
def _at(signal: Signal, t: ArrayLike) -> Float[Array, " n"]:
    """A signal at many times."""
    return jax.vmap(signal)(jnp.asarray(t))


def _samples_on(ends: Ends, ts: Float[np.ndarray, " n"]) -> bool:
    """Whether all samples within the span are at ends of steps."""
    inner = ts[(ts > ends[0]) & (ts < ends[-1])]
    near = np.clip(np.searchsorted(ends, inner), 1, len(ends) - 1)
    distance = np.minimum(np.abs(inner - ends[near]), np.abs(inner - ends[near - 1]))
    return bool(np.all(distance <= ON_GRID * (ends[near] - ends[near - 1])))


def jumps(
    functions: tuple[TimeFunction, ...], start: float, end: float
) -> Float[np.ndarray, " n_jumps"]:
    """Times between ``start`` and ``end`` at which an input is known to jump."""
    held = [f for f in functions if isinstance(f, Signal) and f.interpolation == "previous"]
    known = [np.asarray(f.ts) for f in held if not traced(f.ts)]
    ts = np.unique(np.concatenate(known)) if known else np.zeros(0)
    return ts[(ts > start) & (ts < end)]
