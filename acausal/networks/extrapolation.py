"""How laws and energies go on beyond what is known of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Literal

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import Array
from jax.typing import ArrayLike

from acausal.errors import DeclarationError

Extrapolation = Literal["saturating", "linear", "cubic"]
"""Held at the limit, along the tangent there, or along a cube."""

Function = Callable[[Array], Array]


class Continued(eqx.Module):
    """A law of ``x`` within limits, and beyond each of them a polynomial about that limit.

    What is odd or monotone within symmetric limits is so everywhere, and what is passive, with ``rising``.

    - ``"saturating"``: held at its value.
    - ``"linear"``: along its tangent.
    - ``"cubic"``: along the ``F(0) + a x + b x³`` that has its value and slope at the limit ``L``, so that
      ``2 L² b = F'(L) − (F(L) − F(0)) / L``. Where that is negative, for a law that softens, along its tangent.

    Attributes:
        low, high: the limits of the first input, with zero between them if the law goes on along a cube.
        extrapolation: how it goes on.
        rising: whether a tangent that falls is replaced by a level line, which keeps a passive law passive.

    Raises:
        DeclarationError: for limits that leave nothing to go on from.
    """

    net: Callable[..., Array]
    low: float = eqx.field(static=True)
    high: float = eqx.field(static=True)
    extrapolation: Extrapolation = eqx.field(static=True, default="linear")
    rising: bool = eqx.field(static=True, default=False)

    def __check_init__(self) -> None:
        check_limits(self.low, self.high, self.extrapolation)

    def __call__(self, *inputs: ArrayLike) -> Array:
        """The output for scalar inputs."""
        x, near, limit = _places(inputs[0], self.low, self.high)

        def law(y: Array) -> Array:
            return self.net(y, *inputs[1:])

        ahead = AHEAD[self.extrapolation](law, near, limit, self.rising)
        return _polynomial(ahead, x - near)


class ContinuedEnergy(eqx.Module):
    """An energy within limits, and beyond them what makes its slope go on as a `Continued` law.

    What is even or convex within symmetric limits is so everywhere. Attributes and errors are those of `Continued`.
    """

    net: Callable[..., Array]
    low: float = eqx.field(static=True)
    high: float = eqx.field(static=True)
    extrapolation: Extrapolation = eqx.field(static=True, default="linear")

    def __check_init__(self) -> None:
        check_limits(self.low, self.high, self.extrapolation)

    def __call__(self, *inputs: ArrayLike) -> Array:
        """The output for scalar inputs."""
        x, near, limit = _places(inputs[0], self.low, self.high)

        def energy(y: Array) -> Array:
            return self.net(y, *inputs[1:])

        ahead = AHEAD[self.extrapolation](lambda y: _tangent(energy, y)[1], near, limit, False)
        return _polynomial([energy(near), *ahead], x - near)


def check_limits(low: float, high: float, extrapolation: Extrapolation) -> None:
    """Whether a law can go on beyond these limits.

    Raises:
        DeclarationError: if it can't.
    """
    if extrapolation not in AHEAD:
        raise DeclarationError(
            f"extrapolation={extrapolation!r} is none of {', '.join(map(repr, AHEAD))}"
        )
    if not -math.inf < low < high < math.inf:
        raise DeclarationError(f"limits={low:g}, {high:g}: the first must be less than the second")
    if extrapolation == "cubic" and not low < 0 < high:
        raise DeclarationError(
            f"limits={low:g}, {high:g}: a law goes on along a cube about zero, which must lie between its limits"
        )


def _places(x: ArrayLike, low: float, high: float) -> tuple[Array, Array, Array]:
    """The input, the nearest one within the limits, and the limit on its side."""
    given = jnp.asarray(x)
    return given, jnp.clip(given, low, high), jnp.where(given < 0, low, high)


def _held(law: Function, near: Array, limit: Array, rising: bool) -> Sequence[Array]:
    return [law(near)]


def _straight(law: Function, near: Array, limit: Array, rising: bool) -> Sequence[Array]:
    value, slope = _tangent(law, near)
    return [value, jnp.maximum(slope, 0) if rising else slope]


def _cube(law: Function, near: Array, limit: Array, rising: bool) -> Sequence[Array]:
    value, slope = _straight(law, near, limit, rising)
    secant = (value - law(jnp.zeros_like(near))) / limit
    b = jnp.maximum((slope - secant) / (2 * limit**2), 0)
    return [value, slope, 6 * b * limit, 6 * b]


AHEAD: dict[Extrapolation, Callable[[Function, Array, Array, bool], Sequence[Array]]] = {
    "saturating": _held,
    "linear": _straight,
    "cubic": _cube,
}
"""The value and the derivatives with which a law goes on from a limit."""


def _tangent(function: Function, x: Array) -> tuple[Array, Array]:
    """The value and the slope at a point."""
    return jax.jvp(function, (x,), (jnp.ones_like(x),))


def _polynomial(derivatives: Sequence[Array], beyond: Array) -> Array:
    """The polynomial with these derivatives, so far from where it has them."""
    value, *slopes = derivatives
    power = jnp.ones_like(beyond)
    for n, slope in enumerate(slopes, start=1):
        power = power * beyond / n
        value = value + slope * power
    return value
