"""Slopes of cubic interpolations at a sample, from the lines to its neighbours.

A rule gets the slopes of four lines, the two before the sample and the two after it, and the widths of the inner two.
At an end the missing slopes continue those that are there by a straight line, or the last is repeated.
"""

from collections.abc import Callable
from dataclasses import dataclass

import jax.numpy as jnp
from jaxtyping import Array

Rule = Callable[[Array, Array, Array, Array, Array, Array], Array]


@dataclass(frozen=True)
class Slopes:
    """How the slope at a sample follows from its neighbours.

    Attributes:
        rule: from the slopes of four lines and the widths of the inner two.
        continued: whether missing slopes continue the others by a straight line; else the last is repeated.
    """

    rule: Rule
    continued: bool


def _parabola(_a: Array, b: Array, c: Array, _d: Array, left: Array, right: Array) -> Array:
    return (b * right + c * left) / (left + right)


def _akima(a: Array, b: Array, c: Array, d: Array, _left: Array, _right: Array) -> Array:
    return _weighted(b, c, jnp.abs(d - c), jnp.abs(b - a), (b + c) / 2)


def _modified_akima(a: Array, b: Array, c: Array, d: Array, _left: Array, _right: Array) -> Array:
    after = jnp.abs(d - c) + jnp.abs(d + c) / 2
    before = jnp.abs(b - a) + jnp.abs(b + a) / 2
    return _weighted(b, c, after, before, jnp.zeros_like(b))


def _weighted(b: Array, c: Array, of_b: Array, of_c: Array, without: Array) -> Array:
    total = of_b + of_c
    some = total > 0
    return jnp.where(some, (of_b * b + of_c * c) / jnp.where(some, total, 1), without)


def _fritsch_butland(_a: Array, b: Array, c: Array, _d: Array, left: Array, right: Array) -> Array:
    same = b * c > 0
    one = jnp.ones_like(b)
    b, c = jnp.where(same, b, one), jnp.where(same, c, one)
    mean = 3 * (left + right) / ((left + 2 * right) / b + (right + 2 * left) / c)
    return jnp.where(same, mean, 0)


def _steffen(a: Array, b: Array, c: Array, d: Array, left: Array, right: Array) -> Array:
    most = 2 * jnp.minimum(jnp.abs(b), jnp.abs(c))
    return jnp.where(b * c > 0, jnp.clip(_parabola(a, b, c, d, left, right), -most, most), 0)


SLOPES: dict[str, Slopes] = {
    "cubic": Slopes(_parabola, continued=True),
    "akima": Slopes(_akima, continued=True),
    "modified-akima": Slopes(_modified_akima, continued=True),
    "monotone": Slopes(_fritsch_butland, continued=False),
    "steffen": Slopes(_steffen, continued=False),
}
"""By interpolation: Akima (1970, doi:10.1145/321607.321609), Ionita (2019), Fritsch and Butland (1984,
doi:10.1137/0905021), Steffen (1990, A&A 239, 443)."""
