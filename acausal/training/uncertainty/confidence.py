"""Confidence: how well the record determines learned laws and parameters.

A law may change by small bumps over the range of its argument in training; trained parameters may change, too, and so
may what each record has for itself: a trained initial state, parameters of its own. The sensitivity of the whole
simulation to all of them gives the Fisher information, whose inverse is their covariance: a Laplace approximation in
the space of functions, independent of the number of weights of a network. It does not resolve details of a law that are
narrower than a bump: half a standard deviation of its input, less where the learned law is steep. Where the records ask
for another law, as after a training that has not come to its end, the band counts how far that is, too. The changes
keep what the law promises: zero at zero, odd or even, and bands stay where the sign is promised. Samples with
correlated residuals count for less than one each.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from acausal._jax import compiled, value_and_jacobian
from acausal.errors import TrainingError
from acausal.networks import bounds_of, kept_promises, law_at, output_scale
from acausal.training.objective.error_laws import LogLikelihood
from acausal.training.objective.prior import LawPrior, Prior
from acausal.training.objective.problem import Problem
from acausal.training.objective.records import Records
from acausal.training.objective.trainable import Trainable
from acausal.training.uncertainty.bumps import (
    Bumped,
    Network,
    bumped_law,
    bumps_at,
    split,
    with_changes,
)
from acausal.training.uncertainty.confidence_view import confidence_view
from acausal.training.uncertainty.record_elimination import RecordJacobian, posterior_covariance
from acausal.training.uncertainty.residuals import correlation_time, unexplained
from acausal.training.uncertainty.step_error import move, step_error
from acausal.training.uncertainty.tangents import correlation_with, law_directions

BAND_POINTS = 201
"""Points of a band over the argument of a law."""

INDISTINGUISHABLE = 0.98
"""The data can hardly distinguish two parameters with a correlation above this."""

TAKEN = 0.999
"""A law can take any part of a parameter if the effects of both have a correlation above this."""

UNKNOWN = 0.9
"""The data say nothing about a parameter whose standard deviation is above this part of the prior one."""

CORRELATED = 2.0
"""Residuals are called correlated if more samples than this are worth one independent sample."""

POINTS_EACH = 4
"""Points for each bump at which a later training compares a law with what is known."""

BAD = 0.05
"""Residuals are bad if they leave more than this part of a target unexplained beside noise."""

MOVED = 1.0
"""So many standard deviations are too much to move by the error of the integration's steps."""

LEVELS = np.linspace(0.0, 1.0, 41)
"""Quantiles of a law's argument at which its deviation is taken."""

LEAST_NOISE = 1e-12
"""The smallest noise that is considered possible, relative to a target's standard deviation."""


@dataclass(frozen=True, eq=False)
class Band:
    """A learned law over its first argument, or a prediction over time, with its standard deviation.

    Attributes:
        x: the argument or the time.
        law, sigma: mean and standard deviation there; other arguments of a law are held at their mean.
        sign: of the law where its promises settle it, 1 or −1; else 0. `bounds` are within it.
        limits: the least and the largest value that the law can have, likewise.
        rising: 1 for a law that never falls, −1 for one that never rises, else 0; neither do its `bounds` then.
    """

    x: Float[np.ndarray, " points"]
    law: Float[np.ndarray, " points"]
    sigma: Float[np.ndarray, " points"]
    sign: Float[np.ndarray, " points"] | float = 0.0
    limits: tuple[float, float] = (-np.inf, np.inf)
    rising: int = 0

    @property
    def bounds(self) -> tuple[Float[np.ndarray, " points"], Float[np.ndarray, " points"]]:
        """Two standard deviations to either side, as far as the law's promises allow."""
        low, high = self.law - 2 * self.sigma, self.law + 2 * self.sigma
        low = np.where(self.sign > 0, np.maximum(low, 0.0), low)
        high = np.where(self.sign < 0, np.minimum(high, 0.0), high)
        if self.rising:  # what it reached before, it keeps
            along = slice(None, None, self.rising)
            low = np.maximum.accumulate(low[along])[along]
            high = np.minimum.accumulate(high[along][::-1])[::-1][along]
        return np.maximum(low, self.limits[0]), np.minimum(high, self.limits[1])

    @property
    def steep(self) -> Bool[np.ndarray, " points"]:
        """Where a law is steep: there points lie closer."""
        apart = np.gradient(self.x)
        return apart < 0.5 * apart.max()

    def times(self, factor: float) -> Band:
        """The band of a multiple."""
        side = int(np.sign(factor))
        low, high = sorted(factor * limit if factor else 0.0 for limit in self.limits)
        law, sigma = factor * self.law, abs(factor) * self.sigma
        return Band(self.x, law, sigma, side * self.sign, (low, high), side * self.rising)


@dataclass(frozen=True, eq=False)
class Confidence:
    """How well a record determines laws and parameters.

    Attributes:
        laws: by network, the law and its standard deviation.
        parameters: by name, the standard deviation of trained parameters, relative to their values; absolute if
            their change in `Fit.modifiers` is absolute. That of the prior where a law can take any part of it.
        correlation: between the parameters, in their order.
        with_laws: by parameter and law, the multiple correlation of what the parameter changes with what the weights
            of the law's network can change: 1 where the law can take any part of the parameter.
        per_record: by parameter that differs between records, the standard deviation of each record's deviation from
            the common value.
        noise: standard deviation of the residuals, by target; as given to the loss, or as estimated by it.
        alike: by target, how many neighbouring residuals are worth one independent sample; 1 for white noise.
        unexplained: by target, what its residuals have beside white noise, relative to the target's deviation.
        step_move: by how many standard deviations the error of the integration's steps moves laws and parameters at
            most; the deviations do not count it.
        about: how well each parameter is known, one sentence each.
        prior: the same as the prior of a later training, which `acausal.fit` takes from ``prior=fit``.
    """

    laws: dict[str, Band]
    parameters: dict[str, float]
    correlation: Float[np.ndarray, "n_parameters n_parameters"]
    with_laws: dict[str, dict[str, float]]
    per_record: dict[str, Float[np.ndarray, " R"]]
    noise: dict[str, float]
    alike: dict[str, float]
    unexplained: dict[str, float]
    step_move: float
    about: tuple[str, ...]
    prior: Prior

    def _repr_html_(self) -> str:
        return confidence_view(self.parameters, self.laws, self.noise, self.alike, self.summary())

    def summary(self) -> list[str]:
        """What all this means, as a list of sentences."""
        names = list(self.parameters)
        confused = [
            f"The data can hardly tell '{names[i]}' from '{names[j]}' (correlation {self.correlation[i, j]:+.3f}): "
            "only a combination of the two is known well; fix one, or measure more."
            for i in range(len(names))
            for j in range(i)
            if abs(self.correlation[i, j]) > INDISTINGUISHABLE
        ]
        taken = [
            f"The data can hardly tell '{name}' from the law '{law}' (correlation {_digits(value)}), which can "
            "take any part of it: only the two together are known well; fix one, or measure more."
            for name, laws in self.with_laws.items()
            for law, value in laws.items()
            if value > TAKEN
        ]
        slow = [
            f"Residuals of '{n}' are correlated over {count:.0f} samples, which count as one here. If the "
            "model lacks something, it is further off than its deviations say: see fit.residuals()."
            for n, count in self.alike.items()
            if count > CORRELATED
        ]
        return [*self.about, *confused, *taken, *slow, *self._ignored()]

    def _ignored(self) -> list[str]:
        """What the deviations do not count."""
        bad = [
            f"The residuals of '{n}' leave {100 * left:.2g} % of it unexplained beside noise: the deviations tell "
            "how well the data determine a model that does not follow them, not how far it is from the truth."
            for n, left in self.unexplained.items()
            if left > BAD
        ]
        if self.step_move > MOVED:
            bad.append(
                f"The error of the integration's steps moves laws and parameters by up to {self.step_move:.2g} "
                "standard deviations, which do not count it: take a smaller dt, or solver='rk4'."
            )
        return bad

    def __repr__(self) -> str:
        return "\n".join(
            ("Confidence of " + ", ".join((*self.laws, *self.parameters)), *self.summary())
        )


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
    params = problem.assemble(trainable)
    names, laws = problem.modifiers.names, problem.networks
    bumped = {n: bumped_law(params[n], seen[n]) for n in laws}
    heights = [np.full(len(bumped[n].centres), _size(params[n], seen[n])) for n in laws]
    prior, own = _prior(problem, params), _own_deviations(problem, trainable)
    ways = [law_directions(params[n], seen[n]) if names else (0, None) for n in laws]
    deviations = np.concatenate([*heights, prior])
    count, alone = len(deviations), len(own)
    ends = np.cumsum([sum(map(len, heights)), len(names), alone]).tolist()
    bounds = np.cumsum([0, *(n for n, _ in ways)]).tolist()

    def changed(z: Float[Array, " n"]) -> tuple[Trainable, dict[str, Any]]:
        changes, own, along = jnp.split(scale * z, ends[1:])
        nets = {
            n: law if move is None else replace(law, net=move(along[a:b]))
            for (n, law), (_, move), (a, b) in zip(
                bumped.items(), ways, itertools.pairwise(bounds), strict=True
            )
        }
        new = with_changes(problem, params, nets, changes)
        return _moved(problem, trainable, own), new

    scale = jnp.asarray(np.concatenate([deviations, own, np.ones(bounds[-1])]))
    left, jacobian = _sensitivity(problem, changed, len(scale))
    if not (np.isfinite(left).all() and np.isfinite(jacobian).all()):
        raise TrainingError(
            "The trained model diverges over the record; its confidence cannot be computed."
        )
    counts = np.asarray(problem.records.weight) > 0
    n = np.maximum(counts.sum(axis=0), 1)
    noise, factor = _noise(problem, left)
    alike = _alike(problem.records, factor * left, counts)
    least = np.maximum(noise, LEAST_NOISE * np.asarray(problem.records.sigma)) * np.sqrt(alike)
    sensitivity = np.where(counts[:, :, None], jacobian * (factor / least)[:, :, None], 0.0)
    weighted = sensitivity[..., :count]
    along = sensitivity[..., count + alone :].reshape(left.size, bounds[-1])
    blocks = [
        RecordJacobian(*(s.reshape(w.shape[0] * w.shape[1], s.shape[-1]) for s in (w, o)))
        for w, o in zip(
            *(
                np.split(s, np.asarray(problem.records.first)[1:])
                for s in (weighted, sensitivity[..., count : count + alone])
            ),
            strict=True,
        )
    ]
    error = np.where(counts, step_error(problem, trainable) * (factor / least), 0.0)
    rest = np.where(counts, left * (factor / least), 0.0)
    onward = deviations * move(blocks, rest.ravel())[0]
    blocks += _earlier(problem, changed, len(scale), blocks[0])
    samples = float(np.sum(n / alike)) + sum(len(b.common) for b in blocks[problem.records.count :])
    found = posterior_covariance(blocks, samples)
    weighted = weighted.reshape(left.size, count)
    covariance = found.common * np.outer(deviations, deviations)
    between = covariance[ends[0] : ends[1], ends[0] : ends[1]]
    sigma = np.sqrt(np.diag(between))
    each = np.sqrt([np.diag(c) for c in found.own[: problem.records.count]]) * own
    with_laws = {
        name: {
            law: correlation_with(weighted[:, ends[0] + i], along[:, a:b])
            for law, (a, b) in zip(laws, itertools.pairwise(bounds), strict=True)
        }
        for i, name in enumerate(names)
    }
    taken = np.array([any(v > TAKEN for v in with_laws[n].values()) for n in names], dtype=bool)
    known = np.where(taken, np.maximum(sigma, prior), sigma)
    parts, _ = split(bumped, np.arange(count))
    bands = {
        n: _band(params[n], bumped[n], onward[own], covariance[np.ix_(own, own)], seen[n])
        for n, own in parts.items()
    }
    return Confidence(
        bands,
        dict(zip(names, known.tolist(), strict=True)),
        between / np.maximum(np.outer(sigma, sigma), 1e-300),
        with_laws,
        {n: each[:, i] for i, n in enumerate(problem.per_record.names)},
        dict(zip(problem.targets, noise.tolist(), strict=True)),
        dict(zip(problem.targets, alike.tolist(), strict=True)),
        _unexplained(problem, left),
        move(blocks[: problem.records.count], error.ravel())[1],
        _about(problem, trainable, sigma, prior, taken),
        _as_prior(
            problem, params, bumped, seen, found.root / deviations, float(n @ alike / n.sum())
        ),
    )


def _size(network: Network, seen: Float[np.ndarray, "n_calls n_arguments"]) -> float:
    """How much a law may change, as far as nothing else is known: by its scale, or by its own deviation."""
    law = np.asarray(law_at(network, np.quantile(seen[:, 0], LEVELS), seen[:, 1:].mean(axis=0)))
    return max(output_scale(network), float(np.std(law)))


def _unexplained(problem: Problem, left: Float[np.ndarray, "N n_targets"]) -> dict[str, float]:
    """By target, what its residuals have beside white noise, relative to its deviation."""
    records = problem.records
    known = np.where(np.asarray(records.weight) > 0, left, np.nan)
    pieces = [known[records.rows_of(k)] for k in range(records.count)]
    return {
        name: unexplained([piece[:, i] for piece in pieces], float(records.sigma[i]))
        for i, name in enumerate(problem.targets)
    }


def _earlier(
    problem: Problem,
    changed: Callable[[Float[Array, " n"]], tuple[Trainable, dict[str, Any]]],
    count: int,
    like: RecordJacobian,
) -> list[RecordJacobian]:
    """What the training knew before, as one more record; none if that is nothing."""
    if (prior := problem.prior) is None:
        return []
    jacobian = jax.jit(jax.jacfwd(lambda z: prior.misfit(changed(z)[1])))(jnp.zeros(count))
    rows = np.asarray(jacobian)[:, : like.common.shape[1]]
    return [RecordJacobian(rows, np.zeros((len(rows), like.own.shape[1])))]


def _as_prior(
    problem: Problem,
    params: dict[str, Any],
    bumped: dict[str, Bumped],
    seen: dict[str, Float[np.ndarray, "n_calls n_arguments"]],
    root: Float[np.ndarray, "n n"],
    alike: float,
) -> Prior:
    """What is known now, as the prior of a later training; ``root`` as of `Prior`."""

    def one(name: str) -> LawPrior:
        points = bumped[name].points(POINTS_EACH * len(bumped[name].centres))
        rest = jnp.asarray(seen[name][:, 1:].mean(axis=0))
        heights = np.linalg.pinv(np.asarray(bumps_at(bumped[name], points)))
        return LawPrior(points, rest, law_at(params[name], points, rest), jnp.asarray(heights))

    moved = problem.modifiers
    values = [float(params[n]) for n in moved.names]
    scales = [v if kind.unit else 1.0 for v, kind in zip(values, moved.kinds, strict=True)]
    laws = {n: one(n) for n in problem.networks}
    numbers = (jnp.asarray(a, float) for a in (values, scales, root, alike))
    return Prior(laws, moved.names, *numbers)


def _about(
    problem: Problem,
    trainable: Trainable,
    sigma: Float[np.ndarray, " n_parameters"],
    prior: Float[np.ndarray, " n_parameters"],
    taken: Bool[np.ndarray, " n_parameters"],
) -> tuple[str, ...]:
    """How well each parameter is known, one sentence each; `summary` speaks of those that a law can take."""
    at_limit = problem.modifiers.at_limit(problem.changes(trainable), problem.unit)

    def one(name: str, sigma: float, prior: float) -> str:
        if name in at_limit:
            return f"{at_limit[name]} Its standard deviation cannot be given."
        if sigma > UNKNOWN * prior:
            return f"The data say nothing about '{name}'; leave it as it was, or measure what depends on it."
        deviation = problem.modifiers.written(name, sigma, ".2g", problem.unit(name))
        return f"'{name}' is known to ±{deviation} (one sigma)."

    rows = zip(problem.modifiers.names, sigma.tolist(), prior.tolist(), strict=True)
    return tuple(
        one(*row)
        for row, is_taken in zip(rows, taken, strict=True)
        if row[0] in at_limit or not is_taken
    )


def _digits(correlation: float) -> str:
    """A correlation near 1 that does not read as 1 itself."""
    return f"{min(correlation, 0.9999):.4f}"


def _prior(problem: Problem, params: dict[str, Any]) -> Float[np.ndarray, " n_parameters"]:
    """The prior standard deviations of parameters: from where they began or ended, whichever is larger."""
    rows = zip(
        problem.modifiers.names, problem.modifiers.kinds, problem.modifiers.values, strict=True
    )
    return np.array(
        [max(kind.prior_deviation(float(v)) for v in (start, params[n])) for n, kind, start in rows]
    )


def _own_deviations(problem: Problem, trainable: Trainable) -> Float[np.ndarray, " n_own"]:
    """The prior standard deviations of what each record has for itself: its parameters, and a trained initial state."""
    found = (trainable.states, trainable.starts)
    states = sum(a.shape[1] for a in found if a is not None)
    return np.concatenate([np.asarray(problem.per_record.scale), np.ones(states)])


def _moved(problem: Problem, trainable: Trainable, own: Float[Array, " n_own"]) -> Trainable:
    """The same with other parameters and initial states of each record: the same change for all records.

    A record's predictions depend on its own alone, so that one direction gives the derivatives for all records.
    """
    names, scale = problem.per_record.names, problem.per_record.scale
    per_record = {n: trainable.per_record[n] + own[i] / scale[i] for i, n in enumerate(names)}
    states, starts = trainable.states, trainable.starts
    moves = own[len(names) :]
    if starts is not None:
        starts, moves = starts + moves[: starts.shape[1]], moves[starts.shape[1] :]
    if states is not None and problem.shooting is not None:
        all_first = len(states) == problem.records.count
        first = jnp.arange(len(states)) if all_first else problem.shooting.first
        states = states.at[first].add(moves)
    return replace(trainable, per_record=per_record, states=states, starts=starts)


def _noise(
    problem: Problem, left: Float[np.ndarray, "N n_targets"]
) -> tuple[Float[np.ndarray, " n_targets"], Float[np.ndarray, "N n_targets"]]:
    """The noise of every target, and the root of how much each residual counts: less for an outlier."""
    records = problem.records
    if not isinstance(problem.loss, LogLikelihood):
        count = np.maximum(np.sum(np.asarray(records.weight) > 0, axis=0), 1)
        return np.sqrt(np.sum(left**2, axis=0) / count), np.ones_like(left)
    found = problem.loss.levels(records.y - left, records.y, records.sigma, records.weight)
    return np.asarray(found), np.sqrt(problem.loss.law.weight(jnp.asarray(left) / found))


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


def _sensitivity(
    problem: Problem,
    changed: Callable[[Float[Array, " n"]], tuple[Trainable, dict[str, Any]]],
    count: int,
) -> tuple[Float[np.ndarray, "N n_targets"], Float[np.ndarray, "N n_targets n"]]:
    """The residuals, and the Jacobian of the predictions."""

    @compiled
    def run(problem: Problem) -> tuple[Array, Array]:
        def predicted(z: Float[Array, " n"]) -> Float[Array, "N n_targets"]:
            return problem.predict(*changed(z))

        at, jacobian = value_and_jacobian(predicted, jnp.zeros(count), axis=-1)
        return problem.residuals(at), jacobian

    left, jacobian = run(problem)
    return np.asarray(left), np.asarray(jacobian)


def _band(
    network: Network,
    bumped: Bumped,
    onward: Float[np.ndarray, " n_bumps"],
    covariance: Float[np.ndarray, "n_bumps n_bumps"],
    seen: Float[np.ndarray, "n_calls n_arguments"],
) -> Band:
    x = np.asarray(bumped.points(BAND_POINTS))
    rest = seen[:, 1:].mean(axis=0)
    shapes = np.asarray(bumps_at(bumped, x))
    variance = np.einsum("pk,kl,pl->p", shapes, covariance, shapes) + (shapes @ onward) ** 2
    kept = kept_promises(network)
    sign = np.sign(x) if "passive" in kept and "energy" not in kept else 0.0
    return Band(
        x,
        np.asarray(law_at(network, x, rest)),
        np.sqrt(np.maximum(variance, 0.0)),
        1.0 if "positive" in kept else sign,
        bounds_of(network),
        int("monotone" in kept),
    )
