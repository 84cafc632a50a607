"""Moving-horizon estimation: at every row the most likely way through a window of rows, given what was known before it.

With a belief (m, P) before the window, noise of steps Q and of sensors R, the way minimizes

    ½ ‖z₀ - m‖² by P⁻¹ + ½ Σ ‖zᵢ₊₁ - f(zᵢ)‖² by Q⁻¹ + ½ Σ ‖yᵢ - h(zᵢ)‖² by R⁻¹.

Along the tangent of the model at such a way this is a linear problem, which the Kalman filter and its smoother solve: a
step of Gauss and Newton is one pass of both (B. Bell: The iterated Kalman smoother as a Gauss-Newton method, SIAM J.
Optimization 4, 1994). Damping it divides P and Q by 1 + λ and moves their means towards the way (S. Särkkä,
L. Svensson: Levenberg-Marquardt and line-search extended Kalman smoothers, ICASSP 2020). The arrival cost is the
filter's belief (C. Rao, J. Rawlings, D. Mayne: Constrained state estimation for nonlinear discrete-time systems, IEEE
TAC 48, 2003), linearized at the way that the window has found, without its bounds. For a linear model all of it is the
Kalman filter. Bounds are tied where a step meets them (M. Hintermüller, K. Ito, K. Kunisch: The primal-dual active set
strategy as a semismooth Newton method, SIAM J. Optimization 13, 2002).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float

from acausal._jax import Damped, after_trial, as_key, before_trials, either, value_and_jacobian
from acausal.analysis.filtering import (
    Belief,
    Filtered,
    Function,
    Linearized,
    Measured,
    Path,
    by_derivatives,
    inverse,
    run,
    smoothed,
)

Tree = TypeVar("Tree")

TRIALS = 20
"""Steps for the way of a window, at most."""

MEETINGS = 4
"""How often a step is repeated with the bounds that it meets."""

SOFT = 1e-3
"""How far a bound may be exceeded, about: in standard deviations at the start."""


class Bounds(NamedTuple):
    """What the numbers of an estimate lie within, infinite where nothing is known; a bound is a steep hinge."""

    low: Float[Array, " m"]
    high: Float[Array, " m"]
    sigma: Float[Array, " m"]

    def within(self, z: Float[Array, "*W m"]) -> Float[Array, "*W m"]:
        """The nearest numbers that lie within them."""
        return jnp.clip(z, self.low, self.high)

    def excess(self, z: Float[Array, " m"]) -> Float[Array, " m"]:
        """By how much they lie outside."""
        return jnp.maximum(z - self.high, 0.0) - jnp.maximum(self.low - z, 0.0)


class MovingHorizon(NamedTuple):
    """How to estimate by a moving horizon.

    Attributes:
        window: its rows, at least two.
        bounds: of the numbers to estimate, if there are some.
    """

    window: int = 20
    bounds: Bounds | None = None

    def run(
        self, path: Path, start: Belief, measured: Measured, sigma: Float[Array, "n-1 m"]
    ) -> Filtered:
        """Estimate n rows, each by all measurements of the window that ends there; arguments as of `filtering.run`.

        Innovations and likelihood are those of forecasts, before the row's own measurement was used.
        """
        count, m = min(self.window, len(measured.y)), len(start.mean)

        def at(carry: tuple[Belief, Array], row: Array) -> tuple[tuple[Belief, Array], Filtered]:
            arrival, noise = carry
            first = jnp.maximum(row - count + 1, 0)
            here, before = row - first, jnp.maximum(row - first - 1, 0)

            def part(a: Array, size: int = count) -> Array:
                return jax.lax.dynamic_slice_in_dim(a, first, size)

            # rows after this one are not measured yet
            known = part(measured.known) & (first + jnp.arange(count) <= row)[:, None]
            own = Measured(part(measured.y), known, measured.sigma)
            window = _Window(arrival, own, part(sigma, count - 1), self.bounds)

            expected = _Tangent.along(path, first, window, noise).filtered()
            found, converged = _most_likely(path, first, window, noise)
            after = found.filtered()
            exact = converged & (self.bounds is None)
            estimate = Filtered(
                jnp.where(exact, after.mean[here], found.z[here]),
                after.covariance[here],
                jax.tree.map(lambda a: a[here], expected.innovation),
                jax.tree.map(lambda a: a[before], expected.forecast),
                expected.shared[before],
            )
            later = jax.tree.map(lambda a: a[0], after.forecast)
            moved = jnp.concatenate(
                [(found.z[1] - later.mean)[None], found.noise[2:], jnp.zeros((1, m))]
            )
            full = here == count - 1
            return either(full, (later, moved), (arrival, found.noise)), estimate

        begin = Belief(start.mean, start.covariance), jnp.zeros((count, m))
        _, found = jax.lax.scan(at, begin, jnp.arange(len(measured.y)))
        ahead = jax.tree.map(lambda a: a[1:], found.forecast)
        return found._replace(forecast=ahead, shared=found.shared[1:])


class _Window(NamedTuple):
    """What is known of W rows.

    Attributes:
        arrival: the belief before the first row's measurement. measured: of all rows. sigma: of walks over steps.
    """

    arrival: Belief
    measured: Measured
    sigma: Float[Array, "W-1 m"]
    bounds: Bounds | None


class _Line(eqx.Module):
    """Linear functions along rows, a `Path`: steps and what is observed, by values at points and slopes.

    ``spread`` is the covariance of the noise of every step.
    """

    z: Float[Array, "W m"]
    ahead: Float[Array, "W-1 m"]
    slope: Float[Array, "W-1 m m"]
    y: Float[Array, "W p"]
    read: Float[Array, "W p m"]
    spread: Float[Array, "W-1 m m"]

    def noise(self, row: Array, z: Float[Array, " m"], sigma: Float[Array, " m"]) -> Array:
        """The covariance of a step's noise, whatever ``z`` and ``sigma``."""
        return self.spread[row]

    def step(self, row: Array) -> Function:
        """From a row to the next one."""
        return lambda z: self.ahead[row] + self.slope[row] @ (z - self.z[row])

    def observe(self, row: Array) -> Function:
        """What is measured at a row."""
        return lambda z: self.y[row] + self.read[row] @ (z - self.z[row])


class _Tangent(eqx.Module):
    """The model of a window, linear at a way through it: a `LocalModel` of its cost.

    Attributes:
        noise: of the way, which follows from it: first the difference from the arrival's mean, then from forecasts.
        line: the linear model.
    """

    window: _Window
    noise: Float[Array, "W m"]
    line: _Line

    @classmethod
    def along(
        cls, path: Path, first: Array, window: _Window, noise: Float[Array, "W m"]
    ) -> _Tangent:
        """The model along the way with this noise, which begins at a row of the path."""
        rows = first + jnp.arange(len(noise))

        def advance(z: Float[Array, " m"], row: tuple[Array, ...]) -> tuple[Array, Any]:
            index, own, sigma = row
            ahead, slope = value_and_jacobian(path.step(index), z, axis=-1)
            return ahead + own, (z, ahead, slope, path.noise(index, z, sigma))

        begin = window.arrival.mean + noise[0]
        last, found = jax.lax.scan(advance, begin, (rows[:-1], noise[1:], window.sigma))
        z, ahead, slope, spread = found
        z = jnp.concatenate([z, last[None]])
        y, read = jax.vmap(lambda r, z: value_and_jacobian(path.observe(r), z, axis=-1))(rows, z)
        return cls(window, noise, _Line(z, ahead, slope, y, read, spread))

    @property
    def z(self) -> Float[Array, "W m"]:
        """The way."""
        return self.line.z

    def filtered(self) -> Filtered:
        """The filter's way along the line, without bounds."""
        window = self.window
        return run(EKF, self.line, window.arrival, window.measured, window.sigma, as_key(0))

    def cost(self) -> Float[Array, ""]:
        """What the way minimizes."""
        line, bounds = self.line, self.window.bounds
        excess = None if bounds is None else bounds.excess(line.z)
        return self._cost(self.noise, line.y, excess)

    def gradient(self) -> Float[Array, "W m"]:
        """The cost's, by the noise that may differ from zero; for the rest the noise itself."""
        window, line = self.window, self.line

        def cost(more: Float[Array, "W m"]) -> Float[Array, ""]:
            def advance(z: Array, row: tuple[Array, Array]) -> tuple[Array, Array]:
                slope, own = row
                return (after := slope @ z + own), after

            _, later = jax.lax.scan(advance, more[0], (line.slope, more[1:]))
            off = jnp.concatenate([more[:1], later])
            y, bounds = line.y + jnp.einsum("wpi,wi->wp", line.read, off), window.bounds
            excess = None if bounds is None else bounds.excess(line.z + off)
            return self._cost(self.noise + more, y, excess)

        every = jnp.concatenate([window.arrival.covariance[None], line.spread])
        slope = jax.grad(cost)(jnp.zeros_like(self.noise))
        return jnp.where(jnp.diagonal(every, axis1=1, axis2=2) > 0, slope, self.noise)

    @property
    def scale(self) -> Float[Array, ""]:
        """As of `LocalModel`: noise is measured by its own deviation."""
        return jnp.ones(())

    def trial(self, damping: Float[Array, ""]) -> tuple[Float[Array, " n"], Float[Array, ""]]:
        """As of `LocalModel`; the step is one of the noise."""
        bounds, line = self.window.bounds, self.line
        z = self._passed(damping, None) if bounds is None else self._meeting(damping, bounds)
        off, window = z - line.z, self.window
        first = jnp.where(jnp.diag(window.arrival.covariance) > 0, z[0] - window.arrival.mean, 0.0)
        rest = z[1:] - line.ahead - jnp.einsum("wij,wj->wi", line.slope, off[:-1])
        is_free = jnp.diagonal(line.spread, axis1=1, axis2=2) > 0
        noise = jnp.concatenate([first[None], jnp.where(is_free, rest, 0.0)])
        y = line.y + jnp.einsum("wpi,wi->wp", line.read, off)
        excess = None if bounds is None else bounds.excess(z)
        return (noise - self.noise).ravel(), self.cost() - self._cost(noise, y, excess)

    def _meeting(self, damping: Float[Array, ""], bounds: Bounds) -> Float[Array, "W m"]:
        """The way after a step that is tied to the bounds which it meets."""

        def goes_on(carry: tuple[Array, Array, Array]) -> Bool[Array, ""]:
            z, which, count = carry
            return (count == 0) | ((count < MEETINGS) & ((bounds.excess(z) != 0) != which).any())

        def again(carry: tuple[Array, Array, Array]) -> tuple[Array, Array, Array]:
            z, _, count = carry
            which = bounds.excess(z) != 0
            return self._passed(damping, (which, bounds.within(z))), which, count + 1

        begin = self.line.z, jnp.zeros(self.line.z.shape, bool), jnp.zeros((), int)
        return jax.lax.while_loop(goes_on, again, begin)[0]

    def _passed(
        self, damping: Float[Array, ""], tied: tuple[Array, Array] | None
    ) -> Float[Array, "W m"]:
        """The way after a damped step, some of whose numbers are tied to others like measurements."""
        window, line, measured = self.window, self.line, self.window.measured
        part, arrival = damping / (1 + damping), window.arrival
        nearer = eqx.tree_at(lambda a: a.ahead, line, line.ahead + part * self.noise[1:])
        if tied is not None and window.bounds is not None:
            which, to = tied
            seen = jnp.concatenate([line.y, jnp.where(which, line.z - to, 0.0)], axis=1)
            read = jnp.concatenate([line.read, jax.vmap(jnp.diag)(which.astype(float))], axis=1)
            nearer = eqx.tree_at(lambda a: (a.y, a.read), nearer, (seen, read))
            measured = Measured(
                jnp.concatenate([measured.y, jnp.zeros_like(line.z)], axis=1),
                jnp.concatenate([measured.known, which], axis=1),
                jnp.concatenate([measured.sigma, window.bounds.sigma]),
            )
        prior = Belief(arrival.mean + part * self.noise[0], arrival.covariance / (1 + damping))
        nearer = eqx.tree_at(lambda a: a.spread, nearer, line.spread / (1 + damping))
        return smoothed(run(EKF, nearer, prior, measured, window.sigma, as_key(0)))[0]

    def _cost(
        self,
        noise: Float[Array, "W m"],
        y: Float[Array, "W p"],
        excess: Float[Array, "W m"] | None,
    ) -> Float[Array, ""]:
        window, measured = self.window, self.window.measured
        cost = noise[0] @ inverse(window.arrival.covariance) @ noise[0]
        weights = jax.vmap(inverse)(self.line.spread)
        cost += jnp.einsum("wi,wij,wj->", noise[1:], weights, noise[1:])
        cost += jnp.sum(jnp.where(measured.known, (measured.y - y) / measured.sigma, 0.0) ** 2)
        if excess is not None and window.bounds is not None:
            cost += jnp.sum(_relative(excess, window.bounds.sigma) ** 2)
        return cost / 2


EKF = Linearized(by_derivatives)


def _most_likely(
    path: Path, first: Array, window: _Window, noise: Float[Array, "W m"]
) -> tuple[_Tangent, Bool[Array, ""]]:
    """The most likely way of a window, sought from a noise on, and whether the steps to it have converged.

    Its derivatives are those of a way at which the gradient of the cost vanishes.
    """

    def along(noise: Float[Array, "W m"], path: Path = path, window: _Window = window) -> _Tangent:
        return _Tangent.along(path, first, window, noise)

    def solve(linear: Callable[[Array], Array], y: Float[Array, " n"]) -> Float[Array, " n"]:
        return jnp.linalg.solve(jax.jacobian(linear)(y), y)

    fixed = jax.tree.map(_constant, (path, window))
    found, converged = _sought(partial(along, path=fixed[0], window=fixed[1]), _constant(noise))
    root = jax.lax.custom_root(
        lambda n: along(n.reshape(noise.shape)).gradient().ravel(),
        found.noise.ravel(),
        lambda function, root: root,
        solve,
    )
    exact = along(root.reshape(noise.shape))
    return _Tangent(
        window, *_with_derivatives((found.noise, found.line), (exact.noise, exact.line))
    ), converged


@jax.custom_jvp
def _with_derivatives(values: Tree, same: Tree) -> Tree:
    """Some values with the derivatives of others, which need not be computed where nobody asks for them."""
    return values


@_with_derivatives.defjvp
def _(primals: tuple[Tree, Tree], tangents: tuple[Tree, Tree]) -> tuple[Tree, Tree]:
    return primals[0], tangents[1]


def _constant(leaf: Any) -> Any:
    return jax.lax.stop_gradient(leaf) if eqx.is_array(leaf) else leaf


def _sought(
    along: Callable[[Float[Array, "W m"]], _Tangent], noise: Float[Array, "W m"]
) -> tuple[_Tangent, Bool[Array, ""]]:
    """The most likely way, by damped steps from a noise on, and whether they have converged."""
    begin = along(noise)

    def goes_on(carry: tuple[Damped, Array]) -> Bool[Array, ""]:
        state, count = carry
        return ~state.converged & (count < TRIALS)

    def trial(carry: tuple[Damped, Array]) -> tuple[Damped, Array]:
        state, count = carry
        point = state.point + state.step
        tangent = along(point.reshape(noise.shape))
        return after_trial(state, point, tangent.cost(), tangent), count + 1

    start = before_trials(noise.ravel(), begin, damping=0.0)
    first = after_trial(start, start.point, begin.cost(), begin)
    state, _ = jax.lax.while_loop(goes_on, trial, (first, jnp.zeros((), int)))
    return state.model, state.converged


def _relative(a: Float[Array, " ..."], sigma: Float[Array, " ..."]) -> Float[Array, " ..."]:
    return jnp.where(sigma > 0, a / jnp.where(sigma > 0, sigma, 1.0), 0.0)
