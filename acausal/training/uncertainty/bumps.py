"""Laws that may change by small bumps over their networks' arguments in training."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax.scipy.special import erf
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal._jax import array, compiled, numpy_or_jax, traced
from acausal.networks import EnergyLaw, WithLaw, kept_promises, law_at, law_of, over_points, rise_of
from acausal.training.objective.problem import Problem
from acausal.training.objective.regularizers import Network

BUMPS, SIGMAS = 12, 3.0
"""Bumps over the first argument of each law, evenly over so many sigmas to either side."""

BESIDE, ALL, ALIKE = 6, 192, 1e-9
"""The most bumps over each further argument, and about how many there are in all at most. They are as wide as its own
size over an argument that changes by less than this part of it.
"""

STEEP, GRID, MOST = 0.3, 4001, 48
"""A law is steep where it changes by more than this part of its range over the width of a bump. So many points tell,
and there are so many bumps at most then: closer by the square of how much too steep it is."""


class Stretched(eqx.Module):
    """A coordinate in place of a law's argument that runs faster where the law is steep.

    Attributes:
        x: values of the argument, increasing. s: the coordinate there.
    """

    x: Float[Array, " points"]
    s: Float[Array, " points"]

    def __call__(self, x: Array) -> Array:
        """The coordinate."""
        inside = jnp.clip(x, self.x[0], self.x[-1])
        return jnp.interp(inside, self.x, self.s) + x - inside

    def back(self, s: ArrayLike) -> Array:
        """The argument."""
        return numpy_or_jax(s, self.s, self.x).interp(s, self.s, self.x)


class Bumped(WithLaw):
    """A network whose law may change by bumps, ``F(x, y) + Σ a_k φ_k(x) ψ_k(y)``, and keeps its promises.

    x is its first argument, and y are the others, if there are any, over each of which ψ is a bump. φ is
    ``exp(−(x − c_k)²/2w²)``, with a stretched coordinate in place of x where the law is steep. Where the law is zero at
    zero it is multiplied with ``1 − exp(−x²/2h²)``; where the law is odd or even, its mirror image is subtracted or
    added.

    Attributes:
        net: the network.
        heights: of the bumps, for each centre over x those over y.
        centres: of the bumps over x; ``width``: of all.
        beside: centres of the bumps over y; ``widths``: of all, by argument.
        hole: the width h; ``None`` where the law need not be zero at zero.
        mirrored: −1 for an odd law, 1 for an even one, else 0.
        stretched: the coordinate; ``None`` for x itself.
    """

    net: Network
    heights: Float[Array, " n_bumps"]
    centres: Float[Array, " n_x"]
    width: Float[Array, ""]
    beside: Float[Array, "n_y n_others"]
    widths: Float[Array, " n_others"]
    hole: Float[Array, ""] | None = None
    mirrored: int = eqx.field(static=True, default=0)
    stretched: Stretched | None = None

    def points(self, count: int) -> Float[Array, " count"]:
        """Values of the argument from the first to the last bump, closer where the law is steep."""
        centres = self.centres if traced(self.centres) else np.asarray(self.centres)
        even = numpy_or_jax(centres).linspace(centres[0], centres[-1], count)
        return array(even if self.stretched is None else self.stretched.back(even))

    def __call__(self, *inputs: Float[Array, ""]) -> Float[Array, ""]:
        """The law, or the energy whose derivative it is."""
        shapes = self.areas if isinstance(self.net, EnergyLaw) else self.bumps
        return self.net(*inputs) + jnp.sum(self.heights * shapes(*inputs))

    def law(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The law."""
        bumps = self.bumps(*map(jnp.asarray, inputs))
        return law_of(self.net)(*inputs) + jnp.sum(self.heights * bumps)

    def bumps(self, x: Float[Array, ""], *others: Float[Array, ""]) -> Float[Array, " n_bumps"]:
        """The bumps at x, and at the other arguments."""
        found = self._one_side(x, _bump)
        found = found + self.mirrored * self._one_side(-x, _bump) if self.mirrored else found
        return self._beside(found, others)

    def areas(self, x: Float[Array, ""], *others: Float[Array, ""]) -> Float[Array, " n_bumps"]:
        """The energies whose derivatives by x the bumps are."""
        found = self._one_side(x, _area)
        found = found - self.mirrored * self._one_side(-x, _area) if self.mirrored else found
        return self._beside(found, others)

    def _beside(
        self, found: Float[Array, " n_x"], others: tuple[Float[Array, ""], ...]
    ) -> Float[Array, " n_bumps"]:
        """Products with the bumps over the other arguments."""
        off = (jnp.asarray(others) - self.beside) / self.widths
        return jnp.outer(found, jnp.exp(-0.5 * jnp.sum(off**2, axis=1))).ravel()

    def _one_side(self, x: Float[Array, ""], shape: Shape) -> Float[Array, " n_bumps"]:
        """A bump less its product with the bump at zero, which is a bump again, or the areas of both."""
        x = x if self.stretched is None else self.stretched(x)
        whole = shape(x, self.centres, self.width)
        if self.hole is None:
            return whole
        both = self.width**2 + self.hole**2
        share, narrow = self.hole**2 / both, self.width * self.hole / jnp.sqrt(both)
        product = jnp.exp(-0.5 * self.centres**2 / both)
        return whole - product * shape(x, share * self.centres, narrow)


Shape = Callable[[Array, Array, Array], Array]


def _bump(
    x: Float[Array, ""], centres: Float[Array, " n"], width: Float[Array, ""]
) -> Float[Array, " n"]:
    return jnp.exp(-0.5 * ((x - centres) / width) ** 2)


def _area(
    x: Float[Array, ""], centres: Float[Array, " n"], width: Float[Array, ""]
) -> Float[Array, " n"]:
    return width * jnp.sqrt(jnp.pi / 2) * erf((x - centres) / width / jnp.sqrt(2.0))


def bumped_law(network: Network, seen: Float[np.ndarray, "n_calls n_arguments"]) -> Bumped:
    """A network with bumps of height 0 over the values that its arguments had."""
    first, kept = seen[:, 0], kept_promises(network)
    spread = float(first.std()) or 1.0
    centres = first.mean() + spread * np.linspace(-SIGMAS, SIGMAS, BUMPS)
    width = jnp.asarray(centres[1] - centres[0])
    mirrored = -1 if "odd" in kept else 1 if "even" in kept else 0
    hole = jnp.minimum(width, rise_of(network)) if "zero" in kept and mirrored >= 0 else None
    stretched = None if isinstance(network, EnergyLaw) else _stretched(network, seen, centres)
    if stretched is not None:
        first, last = np.asarray(stretched.s)[[0, -1]]
        count = min(int((last - first) / width) + 2, MOST)
        centres = np.linspace(first, last, count)
        width = jnp.asarray(centres[1] - centres[0])
    together = network.inputs - 1 if isinstance(network, EnergyLaw) else 0
    beside, widths = _beside(seen[:, 1:], len(centres), together)
    heights, centres, beside, widths = map(
        jnp.asarray, (np.zeros(len(centres) * len(beside)), centres, beside, widths)
    )
    return Bumped(network, heights, centres, width, beside, widths, hole, mirrored, stretched)


def _beside(
    seen: Float[np.ndarray, "n_calls n_others"], count: int, together: int
) -> tuple[Float[np.ndarray, "n_y n_others"], Float[np.ndarray, " n_others"]]:
    """Centres and widths of bumps over further arguments, beside so many over the first; at least two for each.

    Those that a law is a derivative by, `together` with the first, have none, nor have others beyond `ALL`: they are
    infinitely wide.
    """
    n = seen.shape[1]
    own = np.arange(together, n)[: int(np.log2(max(1.0, ALL / count)))]
    each = int(np.clip((ALL / count) ** (1 / max(1, len(own))), 2, BESIDE))
    spread, size = seen.std(axis=0), np.abs(seen).max(axis=0)
    spread = np.where(spread > ALIKE * size, spread, np.where(size > 0, size, 1.0))
    grid, widths = np.linspace(-SIGMAS, SIGMAS, each), np.full(n, np.inf)
    widths[own] = spread[own] * (grid[1] - grid[0])
    steps = np.zeros((each ** len(own), n))
    steps[:, own] = [*itertools.product(grid, repeat=len(own))]
    return seen.mean(axis=0) + spread * steps, widths


def _stretched(
    network: Network,
    seen: Float[np.ndarray, "n_calls n_arguments"],
    centres: Float[np.ndarray, " n_bumps"],
) -> Stretched | None:
    """The coordinate in which a law is nowhere steep, if it is anywhere; zero stays zero."""
    x = np.linspace(centres[0], centres[-1], GRID)
    law = np.asarray(law_at(network, x, seen[:, 1:].mean(axis=0)))
    within = (x >= seen[:, 0].min()) & (x <= seen[:, 0].max())
    size = float(np.ptp(law[within])) if within.any() else 0.0
    change = np.abs(np.diff(law)) * (centres[1] - centres[0]) / (x[1] - x[0])
    change = np.where(within[1:] & within[:-1], change, 0.0)
    if not change.max() > STEEP * size > 0:
        return None
    rate = np.maximum(1.0, (change / (STEEP * size)) ** 2)
    s = np.concatenate([[0.0], np.cumsum(rate * np.diff(x))])
    origin = 0.0 if x[0] < 0 < x[-1] else x[0]
    return Stretched(jnp.asarray(x), jnp.asarray(s - np.interp(origin, x, s) + origin))


def split(bumped: Mapping[str, Bumped], rows: Any) -> tuple[dict[str, Any], Any]:
    """By law, the rows of its bumps; and what follows them."""
    found, first = dict[str, Any](), 0
    for name, law in bumped.items():
        last = first + len(law.heights)
        found[name], first = rows[first:last], last
    return found, rows[first:]


@compiled
def bumps_at(
    law: Bumped,
    points: Float[Array | np.ndarray, " points"],
    rest: Float[Array | np.ndarray, "*points n_others"],
) -> Float[Array, "points n_bumps"]:
    """The bumps of a law at some points; arguments as of `law_at`."""
    return over_points(law.bumps, points, rest)


def with_changes(
    problem: Problem,
    params: Mapping[str, Any],
    bumped: Mapping[str, Bumped],
    changes: Float[Array, " n"],
) -> dict[str, Any]:
    """Parameters after changes: heights of the bumps of all laws, then the changes of trained parameters."""
    heights, rest = split(bumped, changes)
    laws = {name: replace(law, heights=heights[name]) for name, law in bumped.items()}
    moved = dict(zip(problem.modifiers.names, rest, strict=True))
    return problem.modifiers.changed({**params, **laws}, moved)
