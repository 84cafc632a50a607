"""Functions of two arguments from values on a grid."""

from typing import Any, Literal

import equinox as eqx
import jax.numpy as jnp

Smoothness = Literal["LinearSegments", "ConstantSegments", "ContinuousDerivative"]
Extrapolation = Literal["HoldLastPoint", "LastTwoPoints", "Periodic", "NoExtrapolation"]


class Surface(eqx.Module):
    """Values on a rectangular grid as a function of two arguments.

    Along each axis a value is ``h[0] z[i] + h[1] z[i + 1] + g[0] z'[i] + g[1] z'[i + 1]`` in the cell ``i``, with
    derivatives of Akima's surface (1974, doi:10.1145/360767.360779) where it is smooth.

    Attributes:
        x, y: grid, shapes (n,) and (m,), ascending, n, m >= 2. values: shape (n, m).
        smoothness, extrapolation: as the options of `CombiTable2Ds`.
    """

    x: Any
    y: Any
    values: Any
    smoothness: Smoothness = eqx.field(static=True)
    extrapolation: Extrapolation = eqx.field(static=True)

    def __call__(self, x: Any, y: Any) -> Any:
        """The value at two scalars."""
        if self.extrapolation == "Periodic":
            x, y = _repeated(self.x, x), _repeated(self.y, y)
        inside = _within(self.x, x) & _within(self.y, y)
        (i, h, g), (j, k, l) = self._cell(self.x, x, inside), self._cell(self.y, y, inside)
        at = lambda table: jnp.array([[table[i + a, j + b] for b in (0, 1)] for a in (0, 1)])  # noqa: E731
        value = h @ at(self.values) @ k
        if self.smoothness == "ContinuousDerivative":
            by_x, by_y, by_both = self._derivatives()
            value += g @ at(by_x) @ k + h @ at(by_y) @ l + g @ at(by_both) @ l
        return value

    def _cell(self, grid: Any, x: Any, inside: Any) -> tuple[Any, Any, Any]:
        """The cell of an argument, and the weights of its ends' values and of their derivatives."""
        if self.extrapolation in ("HoldLastPoint", "NoExtrapolation"):
            x, inside = jnp.clip(x, grid[0], grid[-1]), True
        i = jnp.clip(jnp.searchsorted(grid, x, side="right") - 1, 0, len(grid) - 2)
        width = grid[i + 1] - grid[i]
        s = (x - grid[i]) / width
        if self.smoothness == "ConstantSegments":
            s = jnp.where(inside, jnp.where(s < 1, 0.0, 1.0), s)
        if self.smoothness != "ContinuousDerivative":
            return i, jnp.array([1 - s, s]), None
        r = jnp.clip(s, 0, 1)
        beyond = s - r
        h = r * r * (3 - 2 * r)
        ends = width * jnp.array([r * (1 - r) ** 2, r * r * (r - 1)])
        tangents = width * jnp.array([jnp.minimum(beyond, 0), jnp.maximum(beyond, 0)])
        return i, jnp.array([1 - h, h]), ends + tangents

    def _derivatives(self) -> tuple[Any, Any, Any]:
        """Those by x, by y and by both at the points of the grid."""
        z = jnp.asarray(self.values)
        along_x, along_y = _secants(self.x, z), _secants(self.y, z.T)
        across = _secants(self.y, along_x.T)
        u, v = _weights(along_x), _weights(along_y)
        by_x = u[0] * along_x[1:-2] + u[1] * along_x[2:-1]
        by_y = v[0] * along_y[1:-2] + v[1] * along_y[2:-1]
        both = [
            v[b].T * across[1 + b : -2 + b, :].T[1 + a : -2 + a] * u[a]
            for a in (0, 1)
            for b in (0, 1)
        ]
        return by_x, by_y.T, sum(both)


def _secants(grid: Any, z: Any) -> Any:
    """Slopes between neighbours along the first axis; at both ends two more, on a line with the others."""
    d = jnp.diff(z, axis=0) / jnp.diff(grid)[:, None]
    if len(d) == 1:
        return jnp.concatenate([d] * 5)
    first, last = d[0] - d[1], d[-1] - d[-2]
    return jnp.concatenate([d[:1] + 2 * first, d[:1] + first, d, d[-1:] + last, d[-1:] + 2 * last])


def _weights(d: Any) -> tuple[Any, Any]:
    """Akima's weights of the slopes before and after each point."""
    before, after = jnp.abs(d[3:] - d[2:-1]), jnp.abs(d[1:-2] - d[:-3])
    even = before + after == 0
    total = jnp.where(even, 2.0, before + after)
    return jnp.where(even, 1.0, before) / total, jnp.where(even, 1.0, after) / total


def _within(grid: Any, x: Any) -> Any:
    return (grid[0] <= x) & (x <= grid[-1])


def _repeated(grid: Any, x: Any) -> Any:
    outside = ~_within(grid, x)
    return jnp.where(outside, grid[0] + (x - grid[0]) % (grid[-1] - grid[0]), x)
