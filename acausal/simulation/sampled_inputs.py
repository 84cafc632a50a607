"""The inputs over fixed steps: samples at their ends and polynomials in between, which a scan reads at no cost."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal._jax import array, compiled, numpy_or_jax, traced
from acausal.data import FRACTIONS, Signal, polynomial_coefficients
from acausal.simulation.inputs import Constant, TimeFunction, evaluate_all
from acausal.simulation.step_grid import ON_GRID

Ends: TypeAlias = Float[np.ndarray, " n_ends"]
"""The ends of n steps, with the first one's start: n + 1 times in seconds."""


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
    nothing = np.zeros(len(ends) - 1)
    columns = [_Sampled(nothing, nothing) if c is None else c for c in sampled]
    left = tuple(f if c is None else None for f, c in zip(functions, sampled, strict=True))
    return _together(columns, left, ends)


def polynomials_over_steps(functions: tuple[TimeFunction, ...], ends: Ends) -> Samples:
    """The inputs over fixed steps, all as samples: one that is not a polynomial within a step is replaced by one.

    It passes through the input at both ends of the step and at `FRACTIONS` of it.
    """
    sampled = [_on_grid(f, ends) or _through_points(f, ends) for f in functions]
    return _together(sampled, (), ends)


def _together(
    columns: Sequence[_Sampled], functions: tuple[TimeFunction | None, ...], ends: Ends
) -> Samples:
    if not columns:
        empty = array(np.zeros((len(ends) - 1, 0)))
        return Samples(empty, empty)
    at_starts, at_ends, curves = zip(*columns, strict=True)
    stack, coefficients = numpy_or_jax(columns).stack, None
    if some := [c for c in curves if c is not None]:
        straight = jnp.zeros_like(some[0])
        every = [straight if c is None else c for c in curves]
        coefficients = jnp.stack(every, axis=-1).swapaxes(0, 1)
    start, end = (array(stack(side, axis=1)) for side in (at_starts, at_ends))
    return Samples(start, end, functions, coefficients)


def _on_grid(function: TimeFunction, ends: Ends) -> _Sampled | None:
    """An input over every step; ``None`` if it is not a polynomial there."""
    if isinstance(function, Constant):
        value = numpy_or_jax(function).broadcast_to(function.value, (len(ends) - 1,))
        return _Sampled(value, value)
    if not isinstance(function, Signal) or traced(function.ts):
        return None
    ts, values = np.asarray(function.ts), function.values
    if not traced(values):
        values = np.asarray(values)  # spares the compilation of every operation below
    held = {function.before_start, function.after_end} <= {"refuse", "hold"}
    if not held or not _samples_on(ends, ts):
        return None
    if function.interpolation not in ("linear", "previous"):
        return _curved(function, ends)
    middle = (ends[1:] + ends[:-1]) / 2
    if function.derivative:
        value = _pieces(function, middle, middle)
        return _Sampled(value, value)
    if function.interpolation == "previous":
        value = values[np.maximum(np.searchsorted(ts, middle) - 1, 0)]
        return _Sampled(value, value)
    i = np.clip(np.searchsorted(ts, ends, side="right") - 1, 0, len(ts) - 2)
    w = np.clip((ends - ts[i]) / (ts[i + 1] - ts[i]), 0.0, 1.0)
    w = np.where(np.abs(w - np.round(w)) < ON_GRID, np.round(w), w)
    value = values[i] + w * (values[i + 1] - values[i])
    return _Sampled(value[:-1], value[1:])


def _curved(signal: Signal, ends: Ends) -> _Sampled:
    """A part of a polynomial is a polynomial of the same degree, determined by as many points."""
    points = _points(ends)
    middle = np.broadcast_to((ends[1:] + ends[:-1])[:, None] / 2, points.shape)
    return _through(_pieces(signal, middle.ravel(), points.ravel()).reshape(points.shape))


def _through_points(function: TimeFunction, ends: Ends) -> _Sampled:
    """The polynomial through a function's values in every step."""
    points = _points(ends)
    return _through(evaluate_all((function,), jnp.asarray(points.ravel())).reshape(points.shape))


def _points(ends: Ends) -> Float[np.ndarray, "n n_points"]:
    """The times in every step that determine a polynomial."""
    fractions = np.concatenate([[0.0], FRACTIONS, [1.0]])
    return ends[:-1, None] + np.diff(ends)[:, None] * fractions


def _through(values: Float[Array, "n n_points"]) -> _Sampled:
    start, inner, end = values[:, 0], values[:, 1:-1], values[:, -1]
    return _Sampled(start, end, polynomial_coefficients(start, end, inner))


@compiled
def _pieces(signal: Signal, around: ArrayLike, t: ArrayLike) -> Float[Array, " n"]:
    """A signal's pieces around many times, at as many others."""
    return jax.vmap(signal.piece)(jnp.asarray(around), jnp.asarray(t))


def _samples_on(ends: Ends, ts: Float[np.ndarray, " n"]) -> bool:
    """Whether all samples within the span are at ends of steps."""
    inner = ts[(ts > ends[0]) & (ts < ends[-1])]
    near = np.clip(np.searchsorted(ends, inner), 1, len(ends) - 1)
    distance = np.minimum(np.abs(inner - ends[near]), np.abs(inner - ends[near - 1]))
    return bool(np.all(distance <= ON_GRID * (ends[near] - ends[near - 1])))
