"""Delays and lags: times that belong to what is measured, not to the model; they are trained like parameters.

Each is a parameter such as ``delay(force)`` or ``lag(mass.a)`` beside those of the model, with bounds. So logs, limits,
Gauss-Newton steps and `Fit.confidence` treat it as they treat any other; only `Timing.split` tells them apart.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import KW_ONLY, dataclass
from typing import Any, cast

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal._jax import is_number
from acausal.data import Data
from acausal.errors import TrainingError, known_name, need_flag, shown
from acausal.modeling import antiderivatives
from acausal.training.objective.modifiers import Bounded, Modifier, Modifiers

SAMPLES = 20
"""The default limit of delays and lags, in sample times."""

INSIDE = 0.05
"""A time that starts at a bound is trained from this part of the way to the other one: at a bound it could not move."""

Scalar = Float[Array, ""]


@dataclass(frozen=True)
class Delay:
    """An exact delay, in seconds, of an input or of a target's sensor.

    Arguments:
        start: where training starts; a twentieth of the way between the bounds where that is nearer to one of them.
        min, max: bounds. A negative delay is a clock that is ahead. By default `max` is 20 sample times of the data,
            or twice the start if that is more.
        train: whether it is trained; otherwise ``start`` is the delay.
    """

    start: float = 0.0
    _: KW_ONLY
    min: float = 0.0
    max: float | None = None
    train: bool = True


@dataclass(frozen=True)
class Lag:
    """A first-order lag ``T dy/dt = x - y`` of a target's sensor, which is at rest where a record starts.

    Arguments:
        T: the time constant in seconds where training starts; a twentieth of the limit where that is more.
        max: its limit; by default 20 sample times of the data, or twice ``T`` if that is more.
        train: whether it is trained; otherwise it stays ``T``.
    """

    T: float
    _: KW_ONLY
    max: float | None = None
    train: bool = True


GIVEN_AS: dict[str, tuple[type[Delay] | type[Lag], str]] = {
    "delay": (Delay, "seconds, or ac.Delay(...) to train them"),
    "lag": (Lag, "a time constant in seconds, or ac.Lag(...) to train it"),
}
"""What a time is given as, besides a number, and the same in words."""


@dataclass(frozen=True)
class Time(Bounded):
    """A time between bounds; that it becomes zero is no limit, but a result."""

    def limit(self, value: float, change: float) -> float | None:
        """The way to the upper bound, or to a lower one that is not zero."""
        found = super().limit(value, change)
        return None if found == -value else found


def delay_of(name: str) -> str:
    """What the delay of an input or target is called."""
    return f"delay({name})"


def lag_of(name: str) -> str:
    """What the lag of a target is called."""
    return f"lag({name})"


class Timing(eqx.Module):
    """The delays and lags of a training.

    Attributes:
        values: where they start, in seconds, by name: ``delay(force)``, ``lag(mass.a)``.
        delays: the inputs and targets with a delay.
        lags: the targets with a lag.
        trained: the names of those that are trained.
    """

    values: dict[str, Scalar]
    delays: tuple[str, ...] = eqx.field(static=True)
    lags: tuple[str, ...] = eqx.field(static=True)
    trained: tuple[str, ...] = eqx.field(static=True)

    def split(self, params: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Scalar]]:
        """The model's own parameters, and the times."""
        own = {n: leaf for n, leaf in params.items() if n not in self.values}
        return own, {n: params[n] for n in self.values}


def timing(
    delays: Mapping[str, float | Delay] | None,
    lags: Mapping[str, float | Lag] | None,
    data: Iterable[Data],
    inputs: Iterable[str],
    targets: Iterable[str],
) -> tuple[Timing, Modifiers]:
    """Check a user's choice; the times, and how those that are trained may move.

    The sample time of the records gives the default limits.

    Raises:
        TrainingError: for a name that is neither an input nor a target, or a time that is none.
    """
    limit = SAMPLES * float(np.median([np.diff(d.time).mean() for d in data]))
    late, slow = dict(delays or {}), dict(lags or {})
    targets = list(targets)
    for what, chosen, known in (
        ("delays", late, [*(antiderivatives(n)[-1] for n in inputs), *targets]),
        ("lags", slow, targets),
    ):
        for name in chosen:
            kinds = "input or target" if what == "delays" else "target"
            known_name(name, known, f"{what}: there is no {kinds}", TrainingError)
    named = {delay_of(n): _time("delay", n, value, limit) for n, value in late.items()}
    named |= {lag_of(n): _time("lag", n, value, limit) for n, value in slow.items()}
    starts = {n: jnp.asarray(value, float) for n, (value, _) in named.items()}
    trained = {n: kind for n, (_, kind) in named.items() if kind is not None}
    found = Timing(starts, tuple(late), tuple(slow), tuple(trained))
    return found, Modifiers(
        tuple(trained), tuple(trained.values()), tuple(starts[n] for n in trained)
    )


def _time(kind: str, name: str, given: object, limit: float) -> tuple[float, Modifier | None]:
    """Where a delay or lag starts, and how it may move."""
    of_kind, mend = GIVEN_AS[kind]
    if is_number(given):
        given = of_kind(float(cast(Any, given)), train=False)
    if not isinstance(given, of_kind):
        raise TrainingError(f"{kind}s: '{name}' has {shown(given)}; give {mend}.")
    what, train, high = f"The {kind} of '{name}'", given.train, given.max
    start, low = (given.T, 0.0) if isinstance(given, Lag) else (given.start, given.min)
    if high is None:
        high = max(limit, 2 * start if is_number(start) else 0.0)
    if not all(is_number(v) and math.isfinite(v) for v in (start, low, high)):
        raise TrainingError(
            f"{what} is {shown(start)} s, from {shown(low)} to {shown(high)} s; give finite numbers."
        )
    if low > high:
        raise TrainingError(
            f"{what} has bounds from {low:g} to {high:g} s; the lower one comes first."
        )
    if not need_flag(train, f"{what}: train", TrainingError):
        if start < 0 and kind == "lag":
            raise TrainingError(f"{what} is {start:g} s; a time constant is not negative.")
        return float(start), None
    if not low <= start <= high or low == high:
        raise TrainingError(
            f"{what} starts at {start:g} s, which is not between its bounds, {low:g} and {high:g} s."
        )
    inside = INSIDE * (high - low)
    return float(np.clip(start, low + inside, high - inside)), Time(low, high)
