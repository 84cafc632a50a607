"""Trained parameters besides networks: how each changes with a free variable δ, which starts at 0."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from numbers import Real
from typing import Any, ClassVar, cast

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from scipy.special import ndtri

from acausal._jax import is_real, traced
from acausal.errors import TrainingError, nearest, shown
from acausal.modeling import names_in

REACHED, GAMMA_REACHED = 0.99, 0.95
"""A parameter has reached a bound, or a factor's limit ±γ, when it has gone this fraction of the way."""

ALL_BUT_ALL = 1 - 1e-6
"""The same for a parameter that is free to move by a factor: it has all but vanished."""

DECADE = 10 * (1 - 1e-9)
"""Positive bounds with such a ratio, or a larger one, leave the magnitude of a parameter open."""

FROM_ZERO = (
    "Parameter '{0}' is 0, and a modifier multiplies; give it a value to start from, "
    "or let it move by a sum: modifiers={{'{0}': ac.Shift(...)}}."
)
"""Why a change that is relative cannot begin at 0."""

VANISHED = "it is zero, and would have to change its sign:"
FURTHER = "let it move further, or"
"""What is to be done about a parameter that has run into a limit."""

Scalar = Float[Array, ""]
Number = Any
"""A float, or a scalar array where JAX traces."""


class Modifier(ABC):
    """How a parameter p may change.

    Attributes:
        unit: what changes are counted in: ``"%"`` of p, or nothing, in the unit of p.
    """

    unit: ClassVar[str] = ""

    @abstractmethod
    def change(self, value: Scalar, delta: Scalar) -> Scalar:
        """The change of a parameter that began at a value, for a free variable."""

    def changed(self, value: Number, change: Number) -> Number:
        """The parameter after a change: ``(1 + change) p`` of one that is relative, else ``p + change``."""
        return (1 + change) * value if self.unit else value + change

    def prior_deviation(self, value: float) -> float:
        """The prior standard deviation of the change; of one that is relative, the whole parameter."""
        return 1.0

    @abstractmethod
    def free(self, value: float, share: float) -> float:
        """The free variable below which a share of starting points lies, for a share in (0, 1)."""

    def limit(self, value: float, change: float) -> float | None:
        """The limit that this change has practically reached, or ``None``."""
        return None

    @abstractmethod
    def refusal(self, value: float) -> str | None:
        """Why a parameter cannot change this way, and what to do instead; ``None`` if it can."""


@dataclass(frozen=True)
class Factor(Modifier):
    """``p̃ = (1 + γ tanh δ) p``, the paper's (7) and (8): the change is relative, and smaller than γ.

    Attributes:
        gamma: between 0 and 1.
    """

    gamma: float
    unit: ClassVar[str] = "%"

    def change(self, value: Scalar, delta: Scalar) -> Scalar:
        """``γ tanh δ``."""
        return self.gamma * jnp.tanh(delta)

    def free(self, value: float, share: float) -> float:
        """Starting points are spread evenly over the range."""
        return float(np.arctanh(2 * share - 1))

    def limit(self, value: float, change: float) -> float | None:
        """``±γ``."""
        return _reached(change, -self.gamma, self.gamma, GAMMA_REACHED)

    def refusal(self, value: float) -> str | None:
        """A γ that is too large, or a parameter that is 0."""
        if not 0 < self.gamma < 1:
            return f"The modifier of '{{}}' has gamma={self.gamma}; choose it between 0 and 1."
        if value == 0.0:
            return FROM_ZERO
        return None


@dataclass(frozen=True)
class Shift(Modifier):
    """A parameter moves by a sum, ``p̃ = p + scale · δ``, also from zero, and without a bound.

    Attributes:
        scale: the size of a change to expect, in the parameter's unit.
    """

    scale: float

    def change(self, value: Scalar, delta: Scalar) -> Scalar:
        """``scale · δ``."""
        return self.scale * delta

    def prior_deviation(self, value: float) -> float:
        """The scale."""
        return self.scale

    def free(self, value: float, share: float) -> float:
        """Starting points are normally distributed, with the scale as standard deviation."""
        return float(ndtri(share))

    def refusal(self, value: float) -> str | None:
        """A scale that is not a positive and finite number."""
        if _is_real(self.scale) and 0 < self.scale < np.inf:
            return None
        scale = shown(self.scale).replace("{", "{{").replace("}", "}}")
        return f"The shift of '{{}}' has scale={scale}; give a positive size in its unit."


@dataclass(frozen=True)
class Bounded(Modifier):
    """A parameter stays between bounds whatever the training does; one of them may be infinite.

    Between two bounds it moves along a logistic curve, ``p̃ = low + (high − low) / (1 + e^−(δ₀ + δ))``; beyond one, by a
    factor of its distance to it, ``p̃ = low + (p − low) e^δ``: so ``Bounded(0, inf)`` is positive.

    Attributes:
        low, high: the bounds, in the parameter's unit; where it starts lies between them.
    """

    low: float
    high: float

    def __post_init__(self) -> None:
        if not (_is_real(self.low) and _is_real(self.high) and self.low < self.high):
            raise TrainingError(
                f"{type(self).__name__}({shown(self.low)}, {shown(self.high)}): the lower bound comes first, and "
                "is less than the upper one."
            )

    def change(self, value: Scalar, delta: Scalar) -> Scalar:
        """``p̃ − p``."""
        below, above = value - self.low, self.high - value
        if np.isinf(self.high):
            return below * jnp.expm1(delta)
        if np.isinf(self.low):
            return -above * jnp.expm1(-delta)
        start = jnp.log(below / above)
        return (self.high - self.low) * (jax.nn.sigmoid(start + delta) - jax.nn.sigmoid(start))

    def changed(self, value: Number, change: Number) -> Number:
        """``p + change``, and not a rounding error beyond the bounds."""
        return jnp.clip(value + change, self.low, self.high)

    def prior_deviation(self, value: float) -> float:
        """Half the way from bound to bound; where one is infinite, the way to the other."""
        way = self.high - self.low
        return min(value - self.low, self.high - value) if np.isinf(way) else way / 2

    def free(self, value: float, share: float) -> float:
        """Starting points are spread evenly between the bounds, or over decades where these are a decade apart.

        With one bound, the logarithm of the distance to it is normally distributed; one sigma is a factor of e.
        """
        low, high = self.low, self.high
        if np.isinf(high - low):
            return float(ndtri(share))
        decades = high >= DECADE * low > 0
        point = low * (high / low) ** share if decades else low + (high - low) * share
        return float(_logit(low, point, high) - _logit(low, value, high))

    def limit(self, value: float, change: float) -> float | None:
        """The way to a bound."""
        return _reached(change, self.low - value, self.high - value, REACHED)

    def refusal(self, value: float) -> str | None:
        """A start outside of the bounds, or no bounds."""
        if np.isinf(self.low) and np.isinf(self.high):
            return "The bounds of '{}' are both infinite; give one of them, or take ac.Shift(...)."
        if self.low < value < self.high:
            return None
        return f"Parameter '{{}}' starts at {value:g}, not between its bounds {self.low:g} and {self.high:g}."


@dataclass(frozen=True)
class Free(Modifier):
    """A parameter is free within the bounds that it declares: a positive one by any factor.

    It moves as `Bounded` does, or as a `Shift` by its own size where it declares no bounds; the change is relative.

    Attributes:
        low, high: the declared bounds, which may both be infinite.
    """

    low: float
    high: float
    unit: ClassVar[str] = "%"

    def _within(self, value: Number) -> Bounded | Shift:
        free = np.isinf(self.low) and np.isinf(self.high)
        return Shift(abs(value)) if free else Bounded(self.low, self.high)

    def change(self, value: Scalar, delta: Scalar) -> Scalar:
        """That of `Bounded` or `Shift`, over the parameter."""
        return self._within(value).change(value, delta) / value

    def free(self, value: float, share: float) -> float:
        """As of `Bounded` or `Shift`."""
        return self._within(value).free(value, share)

    def limit(self, value: float, change: float) -> float | None:
        """The way to a declared bound; of a factor, which comes ever nearer to its only one, all but all of it."""
        ends = self.low / value - 1, self.high / value - 1
        return _reached(change, *ends, ALL_BUT_ALL if np.isinf(ends).any() else REACHED)

    def refusal(self, value: float) -> str | None:
        """A parameter that is 0, or begins at one of its bounds."""
        if value == 0.0:
            return FROM_ZERO
        return self._within(value).refusal(value)


def _is_real(value: object) -> bool:
    """Whether a value is one real number that is known; it may be infinite."""
    return is_real(value) and np.ndim(cast(Any, value)) == 0 and not traced(value)


def _logit(low: float, point: float, high: float) -> float:
    return float(np.log((point - low) / (high - point)))


def _reached(change: float, low: float, high: float, part: float) -> float | None:
    """The limit to which a change from 0 has gone more than this part of the way."""
    return next((end for end in (low, high) if change / end > part), None)


class Modifiers(eqx.Module):
    """Which parameters may move and how.

    Attributes:
        names: the parameters.
        kinds: how each moves.
        values: where each begins.
    """

    names: tuple[str, ...] = eqx.field(static=True)
    kinds: tuple[Modifier, ...] = eqx.field(static=True)
    values: tuple[Scalar, ...]

    def joined(self, other: Modifiers) -> Modifiers:
        """These and others."""
        return Modifiers(
            self.names + other.names, self.kinds + other.kinds, self.values + other.values
        )

    def start(self) -> dict[str, Scalar]:
        """The free variables δ where training starts: zero, which changes nothing."""
        return {name: jnp.zeros(()) for name in self.names}

    def changes(self, deltas: Mapping[str, Scalar]) -> dict[str, Scalar]:
        """The changes of the parameters, each as its modifier counts them."""
        rows = zip(self.names, self.kinds, self.values, strict=True)
        return {name: kind.change(value, deltas[name]) for name, kind, value in rows}

    def apply(self, params: Mapping[str, Any], deltas: Mapping[str, Scalar]) -> dict[str, Any]:
        """The parameters with their changes applied."""
        return self.changed(params, self.changes(deltas))

    def changed(self, params: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
        """The parameters after changes."""
        kinds = zip(self.names, self.kinds, strict=True)
        return {**params, **{n: kind.changed(params[n], changes[n]) for n, kind in kinds}}

    def at_limit(self, changes: Mapping[str, Any], unit: Callable[[str], str]) -> dict[str, str]:
        """A sentence about every parameter whose change has run into a limit, by name; ``unit`` gives its unit."""
        rows = zip(self.names, self.kinds, self.values, strict=True)
        found = {n: kind.limit(float(value), float(changes[n])) for n, kind, value in rows}
        return {
            n: f"'{n}' has run into the limit of its modifier, {self.written(n, end, '+.3g', unit(n))}: "
            f"{VANISHED if self.relative(n) and end == -1 else FURTHER} look for what else the model lacks."
            for n, end in found.items()
            if end is not None
        }

    def relative(self, name: str) -> bool:
        """Whether a parameter's change is a part of it."""
        return bool(self.kinds[self.names.index(name)].unit)

    def written(self, name: str, change: float, digits: str, unit: str) -> str:
        """A change as text, such as ``"+3.1 %"``; ``digits`` is a format, ``unit`` that of the parameter."""
        if self.relative(name):
            return f"{100 * change:{digits}} %"
        return f"{change:{digits}}" if unit in ("", "1") else f"{change:{digits}} {unit}"


def modifiers(
    given: Mapping[str, float | Modifier] | Iterable[str] | None,
    gamma: float | None,
    params: Mapping[str, Any],
    why_not_free: Callable[[str], str | None],
    declared: Callable[[str], tuple[float, float]],
) -> Modifiers:
    """Check a user's choice: names with a modifier or a γ each, or names that share ``gamma``.

    Arguments:
        given: the choice.
        gamma: of names without a modifier; ``None`` leaves them free within their declared bounds.
        params: all parameters where training starts.
        why_not_free: why a parameter is not among them, see `ParameterLayout.why_not_free`.
        declared: the bounds that a parameter declares.

    Raises:
        TrainingError: for a name that is not a numeric parameter, or a modifier that does not fit its value.
    """
    names = () if given is None else names_in(given, "modifiers")
    by_name = given if isinstance(given, Mapping) else {}
    chosen: dict[str, Any] = {name: by_name.get(name, gamma) for name in names}
    numbers = [n for n, leaf in params.items() if not callable(leaf)]
    kinds: list[Modifier] = []
    for name, wanted in chosen.items():
        if name not in numbers:
            raise TrainingError(
                f"There is no parameter '{name}' to train: {why_not_free(name) or nearest(name, numbers)}"
            )
        kind: Any = Factor(float(wanted)) if isinstance(wanted, Real) else wanted
        if wanted is None and name not in by_name:
            kind = Free(*declared(name))
        if isinstance(kind, type) or not hasattr(kind, "refusal"):
            raise TrainingError(
                f"The modifier of '{name}' is {shown(wanted)}; give a gamma, ac.Shift(...) or ac.Bounded(...)."
            )
        refusal = kind.refusal(float(params[name]))
        if refusal is not None:
            raise TrainingError(refusal.format(name))
        kinds.append(kind)
    return Modifiers(
        tuple(chosen), tuple(kinds), tuple(jnp.asarray(params[n], float) for n in chosen)
    )
