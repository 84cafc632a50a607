"""Kalman filters: one loop over the rows of a record, whatever carries a mean and its covariance through the model.

A model is linearized at a belief by its derivatives (the extended filter) or by points of equal weight, two for each
direction (the unscented filter whose central point has no weight: the cubature filter of I. Arasaratnam and S. Haykin,
Cubature Kalman filters, IEEE TAC 54, 2009); or an ensemble carries both (G. Evensen, Data assimilation, Springer 2009,
with perturbed observations). Covariances are corrected in Joseph's form, so that they stay symmetric and positive.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, Protocol

import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, PRNGKeyArray

from acausal._jax import cholesky, solve_lower, solve_upper, value_and_jacobian

ROUNDING = 1e-13
"""What is smaller than this, relative to the variances, is rounding."""

NOTHING = 1e-200
"""The variance of what is certain, where a root is needed: far below that of any state."""

Function = Callable[[Float[Array, " m"]], Float[Array, " p"]]


class Belief(NamedTuple):
    """What is known of m numbers: their mean and covariance, and an ensemble that has them, if there is one."""

    mean: Float[Array, " m"]
    covariance: Float[Array, "m m"]
    members: Float[Array, "N m"] | None = None


class Measured(NamedTuple):
    """The p measurements of an instant.

    Attributes:
        y: their values; any number where nothing is known.
        known: which of them exist.
        sigma: standard deviations of their noise.
    """

    y: Float[Array, " p"]
    known: Bool[Array, " p"]
    sigma: Float[Array, " p"]


class Innovation(NamedTuple):
    """Measured less expected (zero where nothing is measured), its covariance, and its log likelihood."""

    value: Float[Array, " p"]
    covariance: Float[Array, "p p"]
    log_likelihood: Float[Array, ""]


class Linear(NamedTuple):
    """A function near a belief: its mean, its slope, and the covariance that a line does not explain."""

    mean: Float[Array, " p"]
    slope: Float[Array, "p m"]
    rest: Float[Array, "p p"]


def by_derivatives(function: Function, belief: Belief) -> Linear:
    """The tangent at the mean."""
    value, slope = value_and_jacobian(function, belief.mean, axis=-1)
    return Linear(value, slope, jnp.zeros((len(value), len(value))))


def by_points(function: Function, belief: Belief) -> Linear:
    """The regression line through two points for each column of a root of the covariance."""
    mean, covariance, _ = belief
    m, root = len(mean), _root(covariance)
    apart = jnp.sqrt(m) * root.T
    y = jax.vmap(function)(jnp.concatenate([mean + apart, mean - apart]))
    spread = (y[:m] - y[m:]) / (2 * jnp.sqrt(m))
    slope = solve_upper(root, spread).T
    bent = (y[:m] + y[m:]) / 2 - jnp.mean(y, axis=0)
    return Linear(jnp.mean(y, axis=0), slope, bent.T @ bent / m)


class Linearized(NamedTuple):
    """The extended and the unscented filter, whose line is `by_derivatives` or `by_points`."""

    line: Callable[[Function, Belief], Linear]

    def forecast(
        self, belief: Belief, step: Function, noise: Float[Array, "m m"], key: PRNGKeyArray | None
    ) -> tuple[Belief, Float[Array, "m m"]]:
        """The belief after a step that adds noise of a covariance, and its covariance with that before."""
        mean, slope, rest = self.line(step, belief)
        shared = belief.covariance @ slope.T
        return Belief(mean, _symmetric(slope @ shared + rest) + noise), shared

    def correct(
        self, belief: Belief, observe: Function, measured: Measured, key: PRNGKeyArray | None
    ) -> tuple[Belief, Innovation]:
        """The belief after a measurement, in Joseph's form."""
        y, slope, rest = self.line(observe, belief)
        slope = jnp.where(measured.known[:, None], slope, 0.0)
        own = _own_noise(rest, measured)
        shared = belief.covariance @ slope.T
        found = _innovation(y, slope @ shared + own, measured)
        gain = _gain(shared, found)
        left = jnp.eye(len(belief.mean)) - gain @ slope
        covariance = left @ belief.covariance @ left.T + gain @ own @ gain.T
        return Belief(belief.mean + gain @ found.value, _symmetric(covariance)), found


class EnsembleFilter(NamedTuple):
    """The ensemble filter: each member sees measurements with noise of its own."""

    def forecast(
        self, belief: Belief, step: Function, noise: Float[Array, "m m"], key: PRNGKeyArray
    ) -> tuple[Belief, Float[Array, "m m"]]:
        """As of `Linearized`."""
        members = belief.members
        assert members is not None
        moved = jax.vmap(step)(members) + jax.random.normal(key, members.shape) @ _root(noise).T
        return _of(moved), _covariance(members, moved)

    def correct(
        self, belief: Belief, observe: Function, measured: Measured, key: PRNGKeyArray
    ) -> tuple[Belief, Innovation]:
        """As of `Linearized`."""
        members = belief.members
        assert members is not None
        y = jnp.where(measured.known, jax.vmap(observe)(members), 0.0)
        spread = _covariance(y, y) + _own_noise(jnp.zeros_like(_covariance(y, y)), measured)
        found = _innovation(jnp.mean(y, axis=0), spread, measured)
        seen = measured.y + measured.sigma * jax.random.normal(key, y.shape)
        moves = jnp.where(measured.known, seen - y, 0.0) @ _gain(_covariance(members, y), found).T
        return _of(members + moves), found


Filter = Linearized | EnsembleFilter
"""A way to carry a belief through a model."""


class Filtered(NamedTuple):
    """A filter's way through n rows.

    Attributes:
        mean, covariance: after each row's measurements.
        innovation: of each row.
        forecast: before the measurements of each row but the first.
        shared: its covariance with the row before.
    """

    mean: Float[Array, "n m"]
    covariance: Float[Array, "n m m"]
    innovation: Innovation
    forecast: Belief
    shared: Float[Array, "n-1 m m"]


Settle = Callable[[Belief, Belief | None], Belief]
"""(belief, that before its correction or None after a step) -> the belief with what is certain in it."""


class Path(Protocol):
    """A model along the rows of a record."""

    def step(self, row: Array) -> Function:
        """From a row to the next one."""
        ...

    def observe(self, row: Array) -> Function:
        """What is measured at a row."""
        ...

    def noise(
        self, row: Array, z: Float[Array, " m"], sigma: Float[Array, " m"]
    ) -> Float[Array, "m m"]:
        """The covariance that white noise, of these deviations over the step, adds from a row to the next one."""
        ...


def run(
    filter: Filter,  # noqa: A002 (the field's word)
    path: Path,
    start: Belief,
    measured: Measured,
    sigma: Float[Array, "n-1 m"],
    key: PRNGKeyArray,
    settle: Settle = lambda belief, _before: belief,
) -> Filtered:
    """Filter n rows in one scan; it can be differentiated in reverse mode.

    Arguments:
        start: before the first measurement. measured: of all rows, shapes (n, p).
        sigma: standard deviations of the random walks over every step.
        settle: restores what is certain, such as the modes of a model with events.
    """

    def corrected(belief: Belief, row: Array) -> tuple[Belief, Innovation]:
        here = Measured(measured.y[row], measured.known[row], measured.sigma)
        own = jax.random.fold_in(key, 2 * row)
        after, found = filter.correct(belief, path.observe(row), here, own)
        return settle(after, belief), found

    def advance(belief: Belief, row: Array) -> tuple[Belief, tuple[Any, ...]]:
        own = jax.random.fold_in(key, 2 * row + 1)
        noise = path.noise(row, belief.mean, sigma[row])
        ahead, shared = filter.forecast(belief, path.step(row), noise, own)
        belief, found = corrected(settle(ahead, None), row + 1)
        return belief, (belief.mean, belief.covariance, found, Belief(*ahead[:2]), shared)

    first, found = corrected(start, jnp.asarray(0))
    _, (mean, covariance, later, ahead, shared) = jax.lax.scan(
        advance, first, jnp.arange(len(measured.y) - 1)
    )
    innovation: Innovation = jax.tree.map(lambda a, b: jnp.concatenate([a[None], b]), found, later)
    return Filtered(
        jnp.concatenate([first.mean[None], mean]),
        jnp.concatenate([first.covariance[None], covariance]),
        innovation, ahead, shared,
    )  # fmt: skip


def smoothed(
    filtered: Filtered,
) -> tuple[Float[Array, "n m"], Float[Array, "n m m"]]:
    """Means and covariances given all measurements, also later ones.

    H. Rauch, F. Tung, C. Striebel: Maximum likelihood estimates of linear dynamic systems, AIAA Journal 3, 1965.
    """

    def back(later: Belief, row: tuple[Array, ...]) -> tuple[Belief, Belief]:
        mean, covariance, ahead_mean, ahead_covariance, shared = row
        gain = shared @ inverse(ahead_covariance)
        mean = mean + gain @ (later.mean - ahead_mean)
        covariance = covariance + gain @ (later.covariance - ahead_covariance) @ gain.T
        belief = Belief(mean, _symmetric(covariance))
        return belief, belief

    last = Belief(filtered.mean[-1], filtered.covariance[-1])
    ahead = filtered.forecast
    rows = (
        filtered.mean[:-1], filtered.covariance[:-1], ahead.mean, ahead.covariance, filtered.shared,
    )  # fmt: skip
    _, found = jax.lax.scan(back, last, rows, reverse=True)
    return (
        jnp.concatenate([found.mean, last.mean[None]]),
        jnp.concatenate([found.covariance, last.covariance[None]]),
    )


def gathered(
    slope: Float[Array, "m m"], sigma: Float[Array, " m"], doublings: int
) -> Float[Array, "m m"]:
    """What random walks add up to along a linear model: ``∫ exp(A s) diag(sigma²) exp(A s)ᵀ ds`` from 0 to 1.

    A step of 2**-doublings by Taylor's series, doubled again and again. Where A is too large for it, or not finite, the
    walks alone.
    """
    walks, part = jnp.diag(sigma**2), 0.5**doublings
    small = part * slope
    half = jnp.eye(len(slope)) + small / 2
    forward = jnp.eye(len(slope)) + small @ half

    def double(_: Array, found: tuple[Array, Array]) -> tuple[Array, Array]:
        added, forward = found
        return added + forward @ added @ forward.T, forward @ forward

    added, _ = jax.lax.fori_loop(0, doublings, double, (part * half @ walks @ half.T, forward))
    return jnp.where(jnp.isfinite(added).all(), _symmetric(added), walks)


def _own_noise(rest: Float[Array, "p p"], measured: Measured) -> Float[Array, "p p"]:
    """The covariance of measurements that the state does not explain; 1 for those that do not exist."""
    both = measured.known[:, None] & measured.known
    return jnp.where(both, rest, 0.0) + jnp.diag(jnp.where(measured.known, measured.sigma**2, 1.0))


def _innovation(
    y: Float[Array, " p"], covariance: Float[Array, "p p"], measured: Measured
) -> Innovation:
    value = jnp.where(measured.known, measured.y - y, 0.0)
    root = cholesky(covariance)
    white = solve_lower(root, value[:, None])
    size = 2 * jnp.sum(jnp.log(jnp.diag(root)))
    constant = jnp.sum(measured.known) * jnp.log(2 * jnp.pi)
    return Innovation(value, covariance, -0.5 * (jnp.sum(white**2) + size + constant))


def _gain(shared: Float[Array, "m p"], found: Innovation) -> Float[Array, "m p"]:
    root = cholesky(found.covariance)
    return solve_upper(root, solve_lower(root, shared.T)).T


def _of(members: Float[Array, "N m"]) -> Belief:
    return Belief(jnp.mean(members, axis=0), _covariance(members, members), members)


def _covariance(a: Float[Array, "N m"], b: Float[Array, "N p"]) -> Float[Array, "m p"]:
    apart = a - jnp.mean(a, axis=0)
    return apart.T @ (b - jnp.mean(b, axis=0)) / (len(a) - 1)


def _root(covariance: Float[Array, "m m"]) -> Float[Array, "m m"]:
    """A lower root of a covariance, of which some may be certain."""
    least = ROUNDING * jnp.maximum(jnp.diag(covariance), NOTHING)
    return cholesky(covariance + jnp.diag(least))


def _symmetric(a: Float[Array, "m m"]) -> Float[Array, "m m"]:
    return (a + a.T) / 2


def inverse(a: Float[Array, "m m"]) -> Float[Array, "m m"]:
    """The inverse of a covariance; of what is known exactly, zero."""
    size = jnp.sqrt(jnp.diag(a))
    scale = jnp.where(size > 0, 1 / jnp.where(size > 0, size, 1.0), 0.0)
    return jnp.linalg.pinv(a * jnp.outer(scale, scale), rtol=ROUNDING, hermitian=True) * jnp.outer(
        scale, scale
    )
