"""Extrapolation of laws and energies beyond the range of their data."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Literal

import equinox as eqx
import jax
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal.errors import DeclarationError, shown
from acausal.networks.law_parts import Wrapper

Extrapolation = Literal["saturating", "linear", "cubic"]
"""Constant beyond the limit, along the tangent there, or along a cubic."""

ScalarFunction = Callable[[Array], Array]


class _Extrapolated(Wrapper):
    low: float = eqx.field(static=True)
    high: float = eqx.field(static=True)
    extrapolation: Extrapolation = eqx.field(static=True, default="linear")

    def __check_init__(self) -> None:
        check_limits(self.low, self.high, self.extrapolation)


class Continued(_Extrapolated):
    """A law of ``x`` within limits, and beyond each of them a polynomial about that limit.

    A law that is odd or monotone within symmetric limits stays so everywhere; with ``rising`` also one that is passive.

    - ``"saturating"``: constant.
    - ``"linear"``: along its tangent.
    - ``"cubic"``: along the ``F(0) + a x + b x³`` that has its value and derivative at the limit ``L``, so that
      ``2 L² b = F'(L) − (F(L) − F(0)) / L``. Where that is negative, for a law that softens, along its tangent.

    Attributes:
        low, high: the limits of the first input, with zero between them for a cubic extrapolation.
        extrapolation: the kind of extrapolation.
        rising: whether a falling tangent is replaced by a constant, which keeps a passive law passive.

    Raises:
        DeclarationError: for limits that do not enclose an interval, or zero where a cubic needs it.
    """

    rising: bool = eqx.field(static=True, default=False)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        x, near, limit = _places(inputs[0], self.low, self.high)

        def law(y: Array) -> Array:
            return self.net(y, *inputs[1:])

        derivatives = DERIVATIVES[self.extrapolation](law, near, limit, self.rising)
        return _polynomial(derivatives, x - near)


class ContinuedEnergy(_Extrapolated):
    """An energy within limits, extrapolated so that its derivative is extrapolated as a `Continued` law.

    An energy that is even or convex within symmetric limits stays so everywhere. Attributes, errors: see `Continued`.
    """

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        x, near, limit = _places(inputs[0], self.low, self.high)

        def energy(y: Array) -> Array:
            return self.net(y, *inputs[1:])

        derivatives = DERIVATIVES[self.extrapolation](
            lambda y: _tangent(energy, y)[1], near, limit, False
        )
        return _polynomial([energy(near), *derivatives], x - near)


def check_limits(low: float, high: float, extrapolation: Extrapolation) -> None:
    """Check that a law can be extrapolated beyond these limits.

    Raises:
        DeclarationError: if it cannot.
    """
    if extrapolation not in DERIVATIVES:
        raise DeclarationError(
            f"extrapolation={shown(extrapolation)} must be one of {', '.join(map(repr, DERIVATIVES))}"
        )
    if not -math.inf < low < high < math.inf:
        raise DeclarationError(f"limits={low:g}, {high:g}: the first must be less than the second")
    if extrapolation == "cubic" and not low < 0 < high:
        raise DeclarationError(
            f"limits={low:g}, {high:g}: a cubic extrapolation is about zero, which must lie between its limits"
        )


def _places(x: ArrayLike, low: float, high: float) -> tuple[Array, Array, Array]:
    """The input, the nearest value within the limits, and the limit on its side."""
    given = jnp.asarray(x)
    return given, jnp.clip(given, low, high), jnp.where(given < 0, low, high)


def _straight(law: ScalarFunction, near: Array, limit: Array, rising: bool) -> Sequence[Array]:
    value, derivative = _tangent(law, near)
    return [value, jnp.maximum(derivative, 0) if rising else derivative]


def _cube(law: ScalarFunction, near: Array, limit: Array, rising: bool) -> Sequence[Array]:
    value, derivative = _straight(law, near, limit, rising)
    secant = (value - law(jnp.zeros_like(near))) / limit
    b = jnp.maximum((derivative - secant) / (2 * limit**2), 0)
    return [value, derivative, 6 * b * limit, 6 * b]


DERIVATIVES: dict[
    Extrapolation, Callable[[ScalarFunction, Array, Array, bool], Sequence[Array]]
] = {
    "saturating": lambda law, near, limit, rising: [law(near)],
    "linear": _straight,
    "cubic": _cube,
}
"""The value and the derivatives of a law's extrapolation at a limit."""


def _tangent(function: ScalarFunction, x: Array) -> tuple[Array, Array]:
    """The value and the derivative at a point."""
    return jax.jvp(function, (x,), (jnp.ones_like(x),))


def _polynomial(derivatives: Sequence[Array], distance: Array) -> Array:
    """The polynomial with these derivatives at a point, at a distance from there."""
    value, *others = derivatives
    power = jnp.ones_like(distance)
    for n, derivative in enumerate(others, start=1):
        power = power * distance / n
        value = value + derivative * power
    return value
