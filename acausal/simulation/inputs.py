"""The inputs of a simulation: checked, then functions of time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias, cast

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Bool, Float

from acausal._jax import array, compiled, is_real, traced
from acausal.data import (
    Data,
    Interpolation,
    Signal,
    counts_rows,
    differentiate,
    is_data_frame,
    is_series,
    read_series,
)
from acausal.errors import DataError, listing, nearest, shortened, shown, warn
from acausal.modeling import antiderivatives, by_element, by_name
from acausal.simulation.host_function import on_host
from acausal.units import convert

if TYPE_CHECKING:
    from acausal.system import System

TimeFunction: TypeAlias = Callable[[ArrayLike], Array]
"""One input as a function of time: time in seconds -> scalar."""

Span: TypeAlias = tuple[float, float]
"""Start and end, in seconds."""

FORMS = "a number, samples, (times, samples), an acausal.Signal, or a function of time"

KINKS = 10_000
"""Adaptive steps end at the samples of inputs that are interpolated linearly; of more than so many, at rough ones."""

ROUGH = 1e-4
"""A kink is rough if the slope changes by more than this part of the signal's range over a sample time."""

STRAIGHT = 1e-9
"""A change of slope that is not a corner, relative to the largest slope."""

REACHES = 0.01
"""Samples reach a time that lies beyond them by less than this part of a sample time: times are rounded."""


class Constant(eqx.Module):
    """An input that does not change."""

    value: Array

    def __call__(self, t: ArrayLike) -> Array:
        """The value, whatever the time."""
        return self.value


class Function(eqx.Module):
    """A user's function of time, as an input; one that JAX can trace."""

    function: Callable[[ArrayLike], ArrayLike]
    name: str = eqx.field(static=True)

    def __call__(self, t: ArrayLike) -> Array:
        """The function's value as a scalar array.

        Raises:
            DataError: for a function that cannot be called with the time alone, or that does not return a real scalar.
        """
        try:
            value = self.function(t)
        except TypeError as error:
            if error.__traceback__ and error.__traceback__.tb_next:  # from inside of it
                raise
            raise DataError(
                f"Input '{self.name}' is a function that cannot be called with the time alone "
                f"({shortened(error)}); give one of a single argument: lambda t: ..."
            ) from error
        if not is_real(value):
            raise DataError(
                f"Input '{self.name}' is a function that returns {_short(value)}, not a real number."
            )
        value = jnp.asarray(value, jnp.result_type(t))
        if value.shape != ():
            raise DataError(
                f"Input '{self.name}' is a function that returns shape {value.shape}, not a scalar."
            )
        return value


class Derivative(eqx.Module):
    """The derivative of a function of time, which JAX finds."""

    function: TimeFunction
    times: int = eqx.field(static=True)

    def __call__(self, t: ArrayLike) -> Array:
        """Its value."""
        return differentiate(self.function, self.times)(jnp.asarray(t))


def inputs_by_name(system: System, given: Any) -> Mapping[str, Any] | Data:
    """The inputs as a user gives them, by name; those of a record or of pandas in the model's units.

    A pandas Series becomes a pair (times, samples), unless its index only counts the rows.

    Raises:
        DataError: for what has no names.
    """
    known = {form for name in system.inputs for form in antiderivatives(name)}
    if isinstance(given, Data) or is_data_frame(given):
        record = Data.of(given)
        return record.select([n for n in record.signals if n in known]).for_system(system)
    first = system.inputs[0] if system.inputs else "name"
    found = by_name(given, "inputs", f"inputs={{'{first}': ...}}, with {FORMS} for each")
    series = {
        n: v for n, v in found.items() if n in known and is_series(v) and not counts_rows(v.index)
    }
    pairs = {
        n: (ts, samples if unit is None else convert(samples, unit, system.unit(n), f"'{n}'"))
        for n, (ts, samples, unit) in read_series(series).items()
    }
    return by_element({**found, **pairs}, known, "inputs", sampled=True)


def functions_of_time(
    system: System,
    given: Mapping[str, Any] | Data,
    span: Span,
    ends: Float[np.ndarray, " n_ends"] | None = None,
) -> tuple[TimeFunction, ...]:
    """One function of time for each of the model's inputs.

    Where the model differentiates an input and its derivative is not given, the function is differentiated. What is not
    given is the input's default, if it has one.

    Arguments:
        system: the model. Its held inputs keep each sample until the next, unless something else is said.
        given: by name, a number; samples at ``ends``; a pair (times, samples); a `Signal`; any function of time. Or
            a record that holds them, in the model's units.
        span: the time for which they are needed.
        ends: ends of the fixed steps, for samples without times.

    Raises:
        DataError: for an input that is missing, unknown or malformed, that has no derivative where the model needs
            one, or whose samples do not reach from start to end.
    """
    sources, defaults = _sources(system, given), system.input_defaults
    differentiated = [source for name, source in sources.items() if source != name]
    functions: dict[str, TimeFunction] = {}
    for source in dict.fromkeys(sources.values()):
        kind: Interpolation = "cubic" if source in differentiated else "linear"
        kind = "previous" if source in system.held_inputs else kind
        if source not in given:
            function = Constant(array(defaults[source]))
        elif isinstance(given, Data):
            function = given.signal(source, kind)
        else:
            function = _function(source, given[source], ends, kind, span[0])
        if source in system.followed_inputs and not _changes_at_instants(function):
            raise DataError(
                f"A discrete variable follows input '{source}', which must then change at known instants alone: give a "
                "number, or samples that are held, as ac.Signal(times, values, 'previous')."
            )
        functions[source] = _reaching(source, function, span)
    return tuple(_derived(name, source, functions[source]) for name, source in sources.items())


def announce_inputs(system: System, given: Mapping[str, Any] | Data) -> None:
    """Warn that records lack inputs, which are their defaults, and that they are differentiated, once for each.

    Other functions have exact derivatives. Arguments as of `functions_of_time`.
    """
    sources, defaults = _sources(system, given), system.input_defaults
    lacking = [n for n in dict.fromkeys(sources.values()) if n not in given]
    if lacking and isinstance(given, Data):
        values = ", ".join(f"'{n}' is {defaults[n]:g}" for n in lacking)
        warn(f"The data lack {listing(lacking)}: {values} throughout, the start value.")
    differentiated = dict.fromkeys(s for name, s in sources.items() if s != name and s in given)
    for name in differentiated:
        value = given.signal(name, "cubic") if isinstance(given, Data) else given[name]
        if isinstance(value, Signal):
            kind = value.interpolation
        elif callable(value) or np.isscalar(value) or getattr(value, "shape", None) == ():
            continue
        else:
            kind = "cubic"
        warn(
            f"The model differentiates input '{name}': its derivative is that of the record's {kind} "
            f"interpolation, noise included. If it was measured, give 'der({name})', too."
        )


def _changes_at_instants(function: TimeFunction) -> bool:
    return isinstance(function, Constant) or (
        isinstance(function, Signal) and function.interpolation == "previous"
    )


def _sources(system: System, given: Mapping[str, Any] | Data) -> dict[str, str]:
    """By input, the name of what is given for it, or is its default: itself, or what it is a derivative of."""
    names, defaults = system.inputs, system.input_defaults
    known = {form for name in names for form in antiderivatives(name)}
    unknown = [n for n in given if n not in known]
    if unknown and not isinstance(given, Data):
        raise DataError(f"The model has no input {listing(unknown)}: {nearest(unknown[0], names)}")
    sources: dict[str, str] = {}
    missing: list[str] = []
    for name in names:
        forms = antiderivatives(name)
        found = [form for form in forms if form in given]
        found += [form for form in forms if form in defaults]
        sources.update({name: found[0]} if found else {})
        missing += [] if found or forms[-1] in missing else [forms[-1]]
    if missing and isinstance(given, Data):
        raise DataError(f"The data lack {listing(missing)}, an input of the model.")
    if missing:
        raise DataError(
            f"No value for the model's input {listing(missing)}: give inputs={{'{missing[0]}': ...}}."
        )
    return sources


def _function(
    name: str,
    value: object,
    ends: Float[np.ndarray, " n_ends"] | None,
    interpolation: Interpolation,
    start: float,
) -> TimeFunction:
    if isinstance(value, Signal | Constant):
        return value
    if callable(value) and not isinstance(value, type):
        return on_host(value, name, start) or Function(
            cast(Callable[[ArrayLike], ArrayLike], value), name
        )
    if isinstance(value, tuple) and len(cast(tuple[Any, ...], value)) == 2:
        times, samples = cast(tuple[Any, Any], value)
        return Signal(times, samples, interpolation, name=name)
    if not is_real(value):
        raise DataError(f"Input '{name}' is {_short(value)}; give {FORMS}.")
    samples = jnp.asarray(value) if traced(value) else np.asarray(value)
    if samples.ndim == 0:
        if not traced(samples) and not np.isfinite(samples):
            raise DataError(f"Input '{name}' is {samples}.")
        return Constant(array(cast(ArrayLike, value)))
    if ends is None:
        rows = (
            " The index of its pandas Series only counts the rows; name it 'time' if it does not."
            if is_series(value)
            else ""
        )
        raise DataError(
            f"Input '{name}' has samples but no times: give (times, samples), or dt for fixed steps.{rows}"
        )
    if samples.shape != ends.shape:
        raise DataError(
            f"Input '{name}' has samples of shape {samples.shape}; "
            f"the {len(ends) - 1} steps from {ends[0]:g} to {ends[-1]:g} s need {len(ends)}."
        )
    return Signal(ends, samples, interpolation, name=name)


def _short(value: object) -> str:
    """A wrong value, for a message."""
    dtype, shape = getattr(value, "dtype", None), getattr(value, "shape", ())
    return f"an array of {dtype}, shape {shape}" if shape or traced(value) else shown(value)


def _reaching(name: str, function: TimeFunction, span: Span) -> TimeFunction:
    """The function, if its samples reach from start to end, or if it says what it is beyond them.

    Where JAX traces their times nothing can be refused; the input is then NaN.
    """
    if not isinstance(function, Signal):
        return function
    ts = function.ts if traced(function.ts) else np.asarray(function.ts)
    slack = REACHES * (ts[-1] - ts[0]) / (len(ts) - 1)
    late = function.before_start == "refuse" and ts[0] - slack > span[0]
    early = function.after_end == "refuse" and ts[-1] + slack < span[1]
    if traced(late, early):
        values = jnp.where(jnp.logical_or(late, early), jnp.nan, function.values)
        return eqx.tree_at(lambda signal: signal.values, function, values)
    if early:
        raise DataError(
            f"Input '{name}' has samples up to {ts[-1]:.9g} s, but the simulation ends at {span[1]:.9g} s: end it "
            "there, give more samples, or say after_end='hold' in its ac.Signal or ac.Data."
        )
    if late:
        raise DataError(
            f"Input '{name}' has samples from {ts[0]:.9g} s on, but the simulation starts at {span[0]:.9g} s: start it "
            "there, give more samples, or say before_start='hold' in its ac.Signal or ac.Data."
        )
    return function


def _derived(name: str, source: str, function: TimeFunction) -> TimeFunction:
    """An input: the given function, or a derivative of it."""
    times = antiderivatives(name).index(source)
    if not times:
        return function
    if isinstance(function, Constant):
        return Constant(array(0.0))
    if not isinstance(function, Signal):
        return Derivative(function, times)
    try:
        return function.differentiated(times, name=source)
    except DataError as error:
        raise DataError(f"The model differentiates an input, '{name}': {error}") from None


def evaluate(
    functions: tuple[TimeFunction, ...], t: ArrayLike, until: ArrayLike | None = None
) -> Float[Array, " n_inputs"]:
    """All inputs at one time; those that jump stay what they are at ``until``, if that is given."""
    early = t if until is None else jnp.minimum(t, until)
    jump = [isinstance(f, Signal) and f.jumps for f in functions]
    values = [f(early if j else t) for f, j in zip(functions, jump, strict=True)]
    return jnp.stack(values) if functions else jnp.zeros(0)


def evaluate_all(
    functions: tuple[TimeFunction, ...], t: Float[Array, " n"]
) -> Float[Array, "n n_inputs"]:
    """All inputs at n times."""
    constant = [np.asarray(f.value) for f in functions if isinstance(f, Constant) and not traced(f)]
    if len(constant) == len(functions):
        return array(np.broadcast_to(np.asarray(constant, float), (len(t), len(functions))))
    return _evaluate_all(functions, t)


@compiled
def _evaluate_all(
    functions: tuple[TimeFunction, ...], t: Float[Array, " n"]
) -> Float[Array, "n n_inputs"]:
    return jax.vmap(lambda t: evaluate(functions, t))(t)


def breaks(
    functions: tuple[TimeFunction, ...], start: float, end: float
) -> tuple[Float[np.ndarray, " n_breaks"], Bool[np.ndarray, " n_breaks"]]:
    """Times between ``start`` and ``end`` at which an input is known to jump, or to have a kink; and which jump.

    Of lines with more than `KINKS` kinks, only the `ROUGH` ones: a smooth signal of many samples is passed over faster
    in steps that an estimate of their error chooses.
    """
    signals = [f for f in functions if isinstance(f, Signal) and not traced(f.ts)]
    jumping = _times([f for f in signals if f.jumps], start, end, _jumps)
    lines = [f for f in signals if f.interpolation == "linear"]
    bent = _times(lines, start, end, _corners)
    if len(bent) > KINKS:
        bent = _times(lines, start, end, partial(_corners, rough=True))
    ts = np.union1d(jumping, bent)
    return ts, np.isin(ts, jumping)


def _jumps(signal: Signal) -> Float[np.ndarray, " n"]:
    """The times at which a signal that is held changes; all samples where its values are not known."""
    ts = np.asarray(signal.ts)
    if signal.derivative or traced(signal.values):
        return ts
    changes = np.diff(np.asarray(signal.values), prepend=np.nan) != 0
    changes[-1] |= signal.after_end != "hold"
    return ts[changes]


def _corners(signal: Signal, *, rough: bool = False) -> Float[np.ndarray, " n"]:
    """The times at which the slope changes, much if ``rough``; else all samples where JAX traces their values."""
    ts = np.asarray(signal.ts)
    if traced(signal.values):
        return ts[[0, -1]] if rough else ts
    values, lengths = np.asarray(signal.values), np.diff(ts)
    slopes = np.diff(values) / lengths
    change = np.abs(np.diff(slopes))
    corners = change > STRAIGHT * np.max(np.abs(slopes), initial=0.0)
    if rough:
        corners &= change * np.minimum(lengths[1:], lengths[:-1]) > ROUGH * np.ptp(values)
    return ts[np.concatenate([[True], corners, [True]])]


def _times(
    signals: list[Signal],
    start: float,
    end: float,
    of: Callable[[Signal], Float[np.ndarray, " n"]] = lambda signal: np.asarray(signal.ts),
) -> Float[np.ndarray, " n"]:
    """Times of some signals within a span."""
    known = [of(f) for f in signals]
    ts = np.unique(np.concatenate(known)) if known else np.zeros(0)
    return ts[(ts > start) & (ts < end)]
