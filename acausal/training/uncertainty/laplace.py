"""Confidence: how well the record determines learned laws and parameters.

A law may change by small bumps over the ranges of its arguments in training; trained parameters may change, too, and so
may what each record has for itself: a trained initial state, parameters of its own. The sensitivity of the whole
simulation to all of them gives the Fisher information, whose inverse is their covariance: a Laplace approximation in
the space of functions, independent of the number of weights of a network. It does not resolve details of a law that are
narrower than a bump: half a standard deviation of its input, less where the learned law is steep. Where the records ask
for another law, as after a training that has not come to its end, the band counts how far that is, too. The changes
keep what the law promises: zero at zero, odd or even, and bands stay where the sign is promised. Samples with
correlated residuals count for less than one each.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from acausal._jax import compiled, value_and_jacobian
from acausal.errors import TrainingError
from acausal.networks import bounds_of, kept_promises, law_at
from acausal.reporting import Band
from acausal.simulation import Adaptive
from acausal.training.objective.error_laws import LogLikelihood
from acausal.training.objective.prior import LawPrior, Prior
from acausal.training.objective.problem import Problem
from acausal.training.objective.records import Records
from acausal.training.objective.trainable import Trainable
from acausal.training.uncertainty.bumps import bumps_at, split
from acausal.training.uncertainty.changes import Changes, changes
from acausal.training.uncertainty.confidence import BAND_POINTS, INDISTINGUISHABLE, Confidence
from acausal.training.uncertainty.record_elimination import (
    RecordJacobian,
    move,
    posterior_covariance,
)
from acausal.training.uncertainty.residuals import correlation_time, unexplained
from acausal.training.uncertainty.tangents import correlation_with

UNKNOWN = 0.9
"""The data say nothing about a parameter whose standard deviation is above this part of the prior one."""

POINTS_EACH = 4
"""Points for each bump at which a later training compares a law with what is known."""

FREE = 10.0
"""So many of their deviations laws may change to take what a parameter or a start changes."""

TAKEN = 0.5
"""A law takes a parameter of which then more than this part of its prior deviation is left."""

OPEN = 0.1
"""The smallest part of its prior deviation that is left of a start to be reported,"""

SHARE = 0.3
"""and the smallest part of a law's deviation that it must change."""

LEAST_NOISE = 1e-12
"""The smallest noise that is considered possible, relative to a target's standard deviation."""


def confidence(
    problem: Problem,
    trainable: Trainable,
    seen: dict[str, Float[np.ndarray, "n_calls n_arguments"]],
) -> Confidence:
    """How well records determine the laws and parameters that were trained on them.

    Residuals that are correlated over τ neighbouring samples have at low frequencies τ times the spectrum of white
    noise, so that each sample counts 1/τ.

    Arguments:
        problem: what was trained.
        trainable: its result.
        seen: by network, the arguments it was called with over the records.

    Raises:
        TrainingError: if the model diverges over a record.
    """
    change = changes(problem, trainable, seen)
    left, jacobian = residuals_and_jacobian(problem, change)
    if not (np.isfinite(left).all() and np.isfinite(jacobian).all()):
        raise TrainingError(
            "The trained model diverges over the record; its confidence cannot be computed."
        )
    noise = _noise(problem, left)
    effects = noise.relative(jacobian).reshape(left.size, len(change.scale))
    blocks = by_record(change, effects)
    onward = change.deviations * move(blocks, noise.relative(left).ravel())[0]
    error = noise.relative(_step_error(problem, trainable))
    step_move = move(blocks, error.ravel())[1] if np.isfinite(error).all() else np.inf
    rows = _earlier(change)
    earlier = [RecordJacobian(rows[:, change.common], np.zeros((len(rows), len(change.of_record))))]
    samples = noise.samples + len(rows)
    alike = float(noise.count @ noise.alike / noise.count.sum())  # over all targets
    found = posterior_covariance([*blocks, *earlier], samples)
    covariance = found.common * np.outer(change.deviations, change.deviations)
    between = _between(change, effects, rows, noise.samples)
    sigma = np.sqrt(np.diag(between))
    each = np.sqrt([np.diag(c) for c in found.own[: problem.records.count]]) * change.of_record
    of_records, variance = problem.per_record.names, np.diag(covariance)
    with_laws = _with_laws(change, effects)
    beside = _beside_laws(change, effects, rows)
    places = split(change.bumped, np.arange(len(onward)))[0]
    known = {
        n: np.sqrt(np.diag(_between(change, effects, rows, noise.samples, np.r_[own, along])))
        for (n, own), along in zip(places.items(), change.places_along.values(), strict=True)
    }
    taken = _taken(with_laws, known, np.where(sigma > TAKEN * change.of_parameters, sigma, 0.0))
    bands = {
        name: _band(change, name, onward[own], covariance[np.ix_(own, own)], beside.moves[:, own])
        for name, own in places.items()
    }
    return Confidence(
        bands,
        dict(zip(with_laws, sigma.tolist(), strict=True)),
        between / np.maximum(np.outer(sigma, sigma), 1e-300),
        with_laws,
        {
            n: np.hypot(
                each[:, i], beside.unknown.get(n, 0.0) * change.of_record[i] / np.sqrt(len(each))
            )
            for i, n in enumerate(of_records)
        },
        dict(zip(problem.targets, noise.size.tolist(), strict=True)),
        dict(zip(problem.targets, noise.alike.tolist(), strict=True)),
        _unexplained(problem, left),
        step_move,
        _about(change, sigma, taken),
        taken | _taken_by(beside, of_records, TAKEN, places, variance),
        _taken_by(beside, problem.system.states, OPEN, places, variance),
        _as_prior(change, found.root / change.deviations, alike),
    )


def residuals_and_jacobian(
    problem: Problem, change: Changes
) -> tuple[Float[np.ndarray, "N n_targets"], Float[np.ndarray, "N n_targets n"]]:
    """The residuals, and the Jacobian of the predictions."""

    @compiled
    def run(problem: Problem) -> tuple[Array, Array]:
        def predicted(z: Float[Array, " n"]) -> Float[Array, "N n_targets"]:
            return problem.predict(*change(z))

        at, jacobian = value_and_jacobian(predicted, jnp.zeros(len(change.scale)), axis=-1)
        return problem.residuals(at), jacobian

    left, jacobian = run(problem)
    return np.asarray(left), np.asarray(jacobian)


def by_record(
    change: Changes,
    effects: Float[np.ndarray, "rows n"],
    places: Int[np.ndarray, " n_common"] | None = None,
) -> list[RecordJacobian]:
    """The Jacobian of each record, of that of all rows and targets, one after the other.

    ``places`` are those of what all records have in common, unless `Changes.common`.
    """
    common = change.common if places is None else places
    ends = len(change.problem.targets) * np.asarray(change.problem.records.first)[1:]
    return [
        RecordJacobian(part[:, common], part[:, change.own]) for part in np.split(effects, ends)
    ]


@dataclass(frozen=True, eq=False)
class _Noise:
    """The noise of the residuals, and what they count.

    Attributes:
        size: of every target, its standard deviation.
        alike: by target, how many neighbouring residuals are worth one independent sample.
        count: by target, how many residuals count, at least 1.
        unit: 1 over the deviation that each residual counts with; 0 where it does not count.
    """

    size: Float[np.ndarray, " n_targets"]
    alike: Float[np.ndarray, " n_targets"]
    count: Float[np.ndarray, " n_targets"]
    unit: Float[np.ndarray, "N n_targets"]

    @property
    def samples(self) -> float:
        """How many independent samples all residuals are worth."""
        return float(np.sum(self.count / self.alike))

    def relative(
        self, values: Float[np.ndarray, "N n_targets *n"]
    ) -> Float[np.ndarray, "N n_targets *n"]:
        """Changes of the predictions in standard deviations of the residuals; zero where nothing counts."""
        unit = self.unit.reshape(*self.unit.shape, *(1,) * (values.ndim - 2))
        return np.where(unit > 0, values * unit, 0.0)


def _noise(problem: Problem, left: Float[np.ndarray, "N n_targets"]) -> _Noise:
    """That of the residuals; an outlier counts less."""
    records = problem.records
    counts = np.asarray(records.weight) > 0
    n = np.maximum(counts.sum(axis=0), 1)
    size, factor = np.sqrt(np.sum(left**2, axis=0) / n), np.ones_like(left)
    if isinstance(problem.loss, LogLikelihood):
        size = np.asarray(
            problem.loss.levels(records.y - left, records.y, records.sigma, records.weight)
        )
        factor = np.sqrt(problem.loss.law.weight(jnp.asarray(left) / size))
    alike = _alike(records, factor * left, counts)
    least = np.maximum(size, LEAST_NOISE * np.asarray(records.sigma)) * np.sqrt(alike)
    return _Noise(size, alike, n, np.where(counts, factor / least, 0.0))


def _alike(
    records: Records,
    left: Float[np.ndarray, "N n_targets"],
    counts: Bool[np.ndarray, "N n_targets"],
) -> Float[np.ndarray, " n_targets"]:
    """By target, how many neighbouring residuals are worth one independent sample: the mean over all records."""
    of = np.asarray(records.of)

    def one(column: Float[np.ndarray, " N"], count: Bool[np.ndarray, " N"]) -> float:
        parts = [column[count & (of == k)] for k in range(records.count)]
        times = [(correlation_time(part), len(part)) for part in parts if len(part) > 1]
        total = sum(n for _, n in times)
        return sum(time * n for time, n in times) / total if total else 1.0

    return np.array([one(*pair) for pair in zip(left.T, counts.T, strict=True)])


def _step_error(problem: Problem, trainable: Trainable) -> Float[np.ndarray, "N n_targets"]:
    """What shorter steps change in the predictions; zero for adaptive steps, which know their error.

    Nothing is known where inputs are delayed by a time that is trained, as they are laid out for these steps: zero.
    """
    if isinstance(problem.solver, Adaptive) or problem.timing.delays:
        return np.zeros(problem.records.y.shape)
    fine, known = (of.simulate(trainable).y for of in (problem.finer(), problem))
    return np.asarray(fine) - np.asarray(known)


def _earlier(change: Changes) -> Float[np.ndarray, "rows n"]:
    """The Jacobian of what the training knew before, which is one more record; no rows if that is nothing."""
    start = jnp.zeros(len(change.scale))
    if (prior := change.problem.prior) is None:
        return np.zeros((0, len(start)))
    return np.asarray(jax.jit(jax.jacfwd(lambda z: prior.misfit(change(z)[1])))(start))


def _between(
    change: Changes,
    effects: Float[np.ndarray, "rows n"],
    earlier: Float[np.ndarray, "rows_before n"],
    samples: float,
    held: Int[np.ndarray, " n_held"] | slice = slice(0),
) -> Float[np.ndarray, "n_parameters n_parameters"]:
    """The covariance of parameters where laws may change freely, but for what is held.

    They can by bumps and along their own weights. They take a parameter's part by all bumps at once: unlikely by the
    prior of single ones, but nothing speaks against it.
    """
    free = np.full(effects.shape[1], FREE)
    free[change.parameters] = free[change.own] = 1.0
    free[held] = 0.0
    places = np.delete(np.arange(len(free)), change.own)
    before = (earlier * free)[:, places]
    blocks = by_record(change, effects * free, places)
    blocks.append(RecordJacobian(before, np.zeros((len(before), len(change.of_record)))))
    found = posterior_covariance(blocks, samples + len(before)).common
    found = found[change.parameters, change.parameters]
    return found * np.outer(change.of_parameters, change.of_parameters)


def _with_laws(
    change: Changes, effects: Float[np.ndarray, "rows n"]
) -> dict[str, dict[str, float]]:
    """By parameter and law, the correlation of what the parameter changes with what the law's weights can change."""
    places = range(change.parameters.start, change.parameters.stop)
    return {
        name: {
            law: correlation_with(effects[:, place], effects[:, along])
            for law, along in change.places_along.items()
        }
        for name, place in zip(change.problem.modifiers.names, places, strict=True)
    }


def _taken(
    with_laws: Mapping[str, Mapping[str, float]],
    known: Mapping[str, Float[np.ndarray, " n_parameters"]],
    left: Float[np.ndarray, " n_parameters"],
) -> dict[str, tuple[str, ...]]:
    """By parameter of which much is ``left``, the laws that can take it, alone or together with other parameters.

    ``known`` is what would be left if a law were known; 0 is left of the other parameters.
    """
    found = {
        name: tuple(
            law
            for law, alike in laws.items()
            if left[i] > 0 and (alike > INDISTINGUISHABLE or known[law][i] < left[i] / 2)
        )
        for i, (name, laws) in enumerate(with_laws.items())
    }
    return {name: laws for name, laws in found.items() if laws}


class _Beside(NamedTuple):
    """What is not known, beside laws that may change, of numbers that all records have in common.

    Attributes:
        unknown: by name of a parameter, a parameter of records, or a state that starts somewhere, the deviation that is
            left of it, as a part of the prior one.
        bumps: by name, how the bumps of all laws change with that deviation.
        moves: how they change with all of the numbers, along independent directions.
    """

    unknown: dict[str, float]
    bumps: dict[str, Float[np.ndarray, " n_bumps"]]
    moves: Float[np.ndarray, "n n_bumps"]


def _beside_laws(
    change: Changes,
    effects: Float[np.ndarray, "rows n"],
    earlier: Float[np.ndarray, "rows_before n"],
) -> _Beside:
    """What is left unknown of parameters, and of what records or their starts have in common, as laws take its part.

    They can by bumps and along their own weights: a law that moves along its argument, as the voltage of a cell with
    the charge that it began with, changes by its slope, which bumps are too wide for. The starts of all records move
    together, and so does a parameter of theirs.
    """
    n = len(change.heights)
    own = _common_numbers(change, effects)
    names = (*change.problem.modifiers.names, *own)
    if not (n and names):
        return _Beside({}, {}, np.zeros((0, n)))
    places = [np.arange(n), *(np.r_[own] for own in change.places_along.values())]
    laws = np.concatenate(places)
    able = np.concatenate([effects[:, laws], earlier[:, laws], np.eye(len(laws)) / FREE])
    columns = np.zeros((len(able), len(names)))
    known = len(change.of_parameters)
    columns[: len(effects), :known] = effects[:, change.parameters]
    columns[len(effects) : len(effects) + len(earlier), :known] = earlier[:, change.parameters]
    columns[: len(effects), known:] = np.stack([*own.values()], axis=1) if own else 0.0
    left = columns - able @ np.linalg.lstsq(able, columns, rcond=None)[0]
    by_number = change.heights * np.linalg.lstsq(able[:, :n], columns, rcond=None)[0].T
    _, size, directions = np.linalg.svd(left, full_matrices=False)
    roots = directions / np.hypot(1, size)[:, None]
    unknown = np.linalg.norm(roots, axis=0)
    moves = roots @ by_number
    bumps = (roots.T @ moves) / unknown[:, None]
    return _Beside(
        dict(zip(names, unknown.tolist(), strict=True)), dict(zip(names, bumps, strict=True)), moves
    )


def _common_numbers(
    change: Changes, effects: Float[np.ndarray, "rows n"]
) -> dict[str, Float[np.ndarray, " rows"]]:
    """What one standard deviation changes that all records have in common of what each has for itself.

    By parameter of records, and by state whose start is not measured.
    """
    problem, states = change.problem, change.problem.system.states
    columns = iter(effects[:, change.own].T)
    tied = zip(problem.per_record.names, columns, strict=False)
    found = {name: column / np.sqrt(problem.records.count) for name, column in tied}
    if change.trainable.starts is not None and problem.start_prior is not None:
        scale = np.asarray(problem.start_prior.scale)
        with np.errstate(divide="ignore"):
            each = np.where(scale > 0, 1 / scale, 0.0)  # a start that is known does not move
        common = 1 / np.maximum(np.sqrt(np.sum(each**2, axis=0)), 1e-300)
        of = np.repeat(np.asarray(problem.records.of), len(problem.targets))
        found |= {
            state: column * common[i] * each[of, i]
            for i, (state, column) in enumerate(zip(states, columns, strict=False))
            if np.isnan(np.asarray(problem.first_states.given)[:, i]).any()
        }
    if change.trainable.states is None:
        return found
    moving = {state for state, column in found.items() if column.any()}
    return found | {s: c for s, c in zip(states, columns, strict=False) if s not in moving}


def _taken_by(
    beside: _Beside,
    names: Collection[str],
    least: float,
    places: Mapping[str, Int[np.ndarray, " n"]],
    variance: Float[np.ndarray, " n_common"],
) -> dict[str, tuple[str, ...]]:
    """By name of what is hardly known, the laws that change with it by much of what is not known of them."""
    found = {
        name: tuple(
            law
            for law, own in places.items()
            if np.linalg.norm(beside.bumps[name][own]) > SHARE * np.sqrt(np.sum(variance[own]))
        )
        for name in names
        if beside.unknown.get(name, 0.0) > least
    }
    return {name: laws for name, laws in found.items() if laws}


def _about(
    change: Changes,
    sigma: Float[np.ndarray, " n_parameters"],
    taken: Collection[str],
) -> tuple[str, ...]:
    """How well each parameter is known, one sentence each; `summary` speaks of those that a law can take."""
    problem = change.problem
    at_limit = problem.modifiers.at_limit(problem.changes(change.trainable), problem.unit)

    def one(name: str, sigma: float, prior: float) -> str:
        if name in at_limit:
            return f"{at_limit[name]} Its standard deviation cannot be given."
        if sigma > UNKNOWN * prior:
            return f"The data say nothing about '{name}'; leave it as it was, or measure what depends on it."
        deviation = problem.modifiers.written(name, sigma, ".2g", problem.unit(name))
        return f"'{name}' is known to ±{deviation} (one sigma)."

    priors = change.of_parameters.tolist()
    rows = zip(problem.modifiers.names, sigma.tolist(), priors, strict=True)
    return tuple(one(*row) for row in rows if row[0] in at_limit or row[0] not in taken)


def _as_prior(change: Changes, root: Float[np.ndarray, "n n"], alike: float) -> Prior:
    """What is known now, as the prior of a later training; ``root`` as of `Prior`."""
    problem, params = change.problem, change.params

    def one(name: str) -> LawPrior:
        bumped = change.bumped[name]
        points = bumped.points(POINTS_EACH * len(bumped.centres))
        rest = jnp.tile(bumped.beside, (len(points), 1))
        points = jnp.repeat(points, len(bumped.beside))
        heights = np.linalg.pinv(np.asarray(bumps_at(bumped, points, rest)))
        return LawPrior(points, rest, law_at(params[name], points, rest), jnp.asarray(heights))

    moved = problem.modifiers
    values = [float(params[n]) for n in moved.names]
    scales = [v if kind.unit else 1.0 for v, kind in zip(values, moved.kinds, strict=True)]
    laws = {n: one(n) for n in problem.networks}
    numbers = (jnp.asarray(a, float) for a in (values, scales, root, alike))
    return Prior(laws, moved.names, *numbers)


def _unexplained(problem: Problem, left: Float[np.ndarray, "N n_targets"]) -> dict[str, float]:
    """By target, what its residuals have beside white noise, relative to its deviation."""
    records = problem.records
    known = np.where(np.asarray(records.weight) > 0, left, np.nan)
    pieces = [known[records.rows_of(k)] for k in range(records.count)]
    return {
        name: unexplained([piece[:, i] for piece in pieces], float(records.sigma[i]))
        for i, name in enumerate(problem.targets)
    }


def _band(
    change: Changes,
    name: str,
    onward: Float[np.ndarray, " n_bumps"],
    covariance: Float[np.ndarray, "n_bumps n_bumps"],
    moves: Float[np.ndarray, "n n_bumps"],
) -> Band:
    """A law with its deviation: what the covariance says, or its ``moves`` with other numbers where these are more."""
    network, bumped = change.params[name], change.bumped[name]
    x = np.asarray(bumped.points(BAND_POINTS))
    others = change.seen[name][:, 1:]
    spread = others.std(axis=0)
    off = (others - others.mean(axis=0)) / np.where(spread > 0, spread, 1.0)
    rest = others[np.argmin(np.sum(off**2, axis=1))]
    shapes = np.asarray(bumps_at(bumped, x, rest))
    variance = np.einsum("pk,kl,pl->p", shapes, covariance, shapes)
    variance = np.maximum(variance, np.sum((shapes @ moves.T) ** 2, axis=1))
    variance += (shapes @ onward) ** 2
    kept = kept_promises(network)
    sign = np.sign(x) if "passive" in kept and "energy" not in kept else 0.0
    return Band(
        x,
        np.asarray(law_at(network, x, rest)),
        np.sqrt(np.maximum(variance, 0.0)),
        1.0 if "positive" in kept else sign,
        bounds_of(network),
        int("monotone" in kept),
        tuple(rest.tolist()),
    )
