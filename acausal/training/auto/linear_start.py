"""A linear law in the place of every network: its order of magnitude by trials, then Gauss-Newton.

All trials of both are rows of one program: batches of `BATCH` points, each with its loss, gradient and Gauss-Newton
Hessian. A step of Gauss-Newton is tried with several dampings at once, from the best few points.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jax.flatten_util import ravel_pytree
from jaxtyping import Array, Float

from acausal._jax import compiled
from acausal.networks import Affine, BesideLinear, BesideQuadratic, LawShape, Scales
from acausal.training.objective.problem import Problem
from acausal.training.objective.start_sizes import resized
from acausal.training.objective.trainable import Trainable
from acausal.training.objective.whole_record import over_whole_record
from acausal.training.optimizers.gradients import with_gauss_newton_hessian

BATCH = 32
"""Points that are evaluated at once."""

SPREAD, BEST = 16, 4
"""Points from which Gauss-Newton begins, and from which it goes on."""

SIZES = tuple(10.0 ** (k / 2) for k in range(-18, 19))
"""Slopes and offsets that are tried, with both signs."""

ALONE = 0.9
"""Laws that leave more than this part of the targets, each alone, are tried in pairs: in series, they only act so."""

JOINT = 64
"""Combinations of the laws of several networks that are tried."""

ALIKE = 1e-4
"""Points whose losses differ by less than this part are taken as one: a very small law acts as none."""

LOOSE, LITTLE, LIKELY = 1.0, 0.01, 0.5
"""A constant is loose if its standard deviation is more than so much of its law, if the loss rises by less than this
part without it, and if the starts and parameters that go with it are as likely: within one standard deviation."""

TRIES = 8
"""Steps, searches for events included, that a row takes on average at most: one trial that runs from event to event
would hold up all others of its batch."""

UNSEEN = 1e-12
"""Curvature, relative to that of each number alone, below which the loss is flat apart from rounding."""

STEPS, ENOUGH = 15, 1e-3
"""Steps of Gauss-Newton at most; it ends when the loss falls by less than this part."""


def nothing(*inputs: Any) -> Array:
    """The network beside which a law is linear alone."""
    return jnp.zeros(())


def linear_module(shape: LawShape) -> BesideLinear | BesideQuadratic:
    """A linear law, or the energy of one, that is zero."""
    kind = BesideQuadratic if shape.energy else BesideLinear
    return kind(nothing, jnp.zeros(shape.inputs), None if shape.through_zero else jnp.zeros(()))


@dataclass(frozen=True, eq=False)
class LinearStart:
    """What linear laws explain of records.

    Attributes:
        laws: by network.
        sensitive: by network, the change of the law that changes the predictions as much as the error that is left:
            of the slope of each input, and of the offset.
        loss: over the records.
        problem, trainable: for what else is asked.
        hessian: of the loss, by all that is trained.
        loose: networks whose constant nothing determines; those of one input vanish at zero for that reason.
        title: what it is of.
    """

    laws: dict[str, Affine]
    sensitive: dict[str, Affine]
    loss: float
    problem: Problem
    trainable: Trainable
    hessian: Float[np.ndarray, "P P"]
    loose: tuple[str, ...] = ()
    title: str = "linear law"


def linear_start(
    problem: Problem, shapes: dict[str, LawShape], tries: int | None = TRIES
) -> LinearStart:
    """The linear laws that explain records best.

    Arguments:
        problem: with the `linear_module` of every network in ``shapes``; what else it trains is trained, too.
        shapes: by network, what linear laws may be like.
        tries: as of `Simulator`; where no trial does with so few, any number is allowed.
    """
    objective = replace(over_whole_record(problem), tries=tries)
    start, _ = ravel_pytree(objective.start())
    places = _places(objective, shapes)
    found = _Points(objective, len(start))
    base = np.asarray(start)
    best: dict[tuple[str, ...], list[np.ndarray]] = {}
    least = np.inf
    most = SPREAD if len(shapes) == 1 else 1
    for name in sorted(shapes, key=lambda n: not shapes[n].divides):
        own = _decades(base, places[name], shapes[name])
        losses = found.at(own)[0]
        kept: list[np.ndarray] = []
        for place in places[name]:  # the best points of every slope, and of the offset
            rows = [k for k, point in enumerate(own) if point[place] != base[place]]
            kept += [own[rows[k]] - base for k in _unlike(losses[rows], most)]
        best[name,] = kept
        least = min(least, losses.min())
        if shapes[name].divides and kept:
            base = base + kept[0]
            best[name,] = []
    if tries is not None and problem.system.events is not None and not np.isfinite(least):
        return linear_start(problem, shapes, None)
    if least > ALONE * np.sqrt(len(problem.targets)):
        for names in itertools.combinations(shapes, 2):
            own = _together(base, [places[n][0] for n in names])
            best[names] = [own[k] - base for k in _unlike(found.at(own)[0], BEST)]
    choices = [[np.zeros_like(base), *rows] for rows in best.values()]
    joint = [
        base + sum(rows, np.zeros_like(base))
        for rows in itertools.islice(itertools.product(*choices), JOINT)
    ]
    point, loss, hessian = _gauss_newton(found, joint, _rising(places, shapes))
    return _linear(objective, shapes, point, loss, hessian)


def with_constants_at_zero(
    start: LinearStart, shapes: dict[str, LawShape], scales: dict[str, Scales]
) -> LinearStart:
    """The same start with laws that vanish at zero, where neither records nor what is known of starts tell a constant.

    A current through a coil whose start is not measured does for a constant of the current beside it, and a force of
    one law for that of another one. So the constant is known less well than the law is large, and without it the loss
    and the starts are as good as with it. Laws of several inputs, at which zero says little, keep theirs.
    """
    given, objective, held, loose = start, start.problem, list[int](), list[str]()
    places = _places(objective, shapes)
    rising, rest = _rising(places, shapes), [n for n, s in shapes.items() if s.has_constant]
    if rest and np.isfinite(start.loss):
        objective, trainable = resized(objective, start.trainable)
        point = np.array(ravel_pytree(trainable)[0])
        point, loss, hessian = _gauss_newton(_Points(objective, len(point)), [point], rising)
        start = replace(_linear(objective, shapes, point, loss, hessian), title=start.title)
    while rest and np.isfinite(start.loss):
        known = _covariance(start, held)
        sigma = {n: _deviation(known, places[n], shapes[n], scales[n]) for n in rest}
        unknown = {n: s for n in rest if (s := sigma[n] / scales[n].output) >= LOOSE}
        if not unknown:
            break
        name = max(unknown, key=lambda n: (shapes[n].every == 1, unknown[n]))
        rest.remove(name)
        point = np.array(ravel_pytree(start.trainable)[0])
        trial = [*held, places[name][-1]]
        point[trial] = 0.0
        found = _Points(objective, len(point))
        point, loss, hessian = _gauss_newton(found, [point], rising, trial)
        again = replace(_linear(objective, shapes, point, loss, hessian), title=start.title)
        nats, rise = _nats(again) - _nats(start), loss / start.loss - 1
        if nats < LIKELY and rise < LITTLE:
            loose.append(name)
            if shapes[name].every == 1:
                held, start = trial, again
    return replace(start if held else given, loose=tuple(n for n in shapes if n in loose))


def _covariance(start: LinearStart, held: Sequence[int]) -> np.ndarray:
    """Of all that is trained, as the linear laws have it, with what is left as noise; zero for what is held."""
    free = np.setdiff1d(np.arange(len(start.hessian)), held)
    hessian = start.hessian[np.ix_(free, free)]
    unit = 1 / np.sqrt(np.maximum(np.diag(hessian), 1e-300))
    curvatures, axes = np.linalg.eigh(hessian * np.outer(unit, unit))
    inverse = axes / np.maximum(curvatures, UNSEEN) @ axes.T  # large where nothing is known
    found = np.zeros_like(start.hessian)
    found[np.ix_(free, free)] = (
        start.loss / _samples(start.problem) * inverse * np.outer(unit, unit)
    )
    return found


def _nats(start: LinearStart) -> float:
    """How unlikely is what is found, by what is known without data, apart from starts that are measured."""
    problem, moves = start.problem, start.trainable.starts
    nats = _samples(problem) * float(problem.log_prior(start.trainable))
    if moves is None:
        return nats
    measured = np.isfinite(np.asarray(problem.first_states.given))
    return nats - 0.5 * float(np.sum(np.asarray(moves)[measured] ** 2))


def _samples(problem: Problem) -> int:
    return int(np.sum(np.asarray(problem.records.weight) > 0))


def _deviation(
    covariance: np.ndarray, places: Sequence[int], shape: LawShape, scales: Scales
) -> float:
    """The standard deviation of a law in the middle of its range."""
    by = np.zeros(len(covariance))
    by[list(places)] = [*scales.centre[: shape.inputs], 1.0]
    return float(np.sqrt(max(by @ covariance @ by, 0.0)))


def _linear(
    objective: Problem,
    shapes: dict[str, LawShape],
    point: np.ndarray,
    loss: float,
    hessian: np.ndarray,
) -> LinearStart:
    """The laws at a point."""
    places = _places(objective, shapes)
    _, unravel = ravel_pytree(objective.start())
    diagonal = np.maximum(np.diag(hessian), 1e-300)
    moves = np.sqrt(max(loss, 1e-300) / diagonal) if np.isfinite(loss) else np.zeros(len(point))
    laws, sensitive = ({n: _law(v, places[n], shapes[n]) for n in shapes} for v in (point, moves))
    return LinearStart(laws, sensitive, loss, objective, unravel(jnp.asarray(point)), hessian)


def _unlike(losses: np.ndarray, most: int) -> list[int]:
    """The best points, so many at most, no two of which have one loss."""
    found: list[int] = []
    for k in np.argsort(losses):
        last = losses[found[-1]] if found else -np.inf
        if len(found) < most and np.isfinite(losses[k]) and losses[k] - last > ALIKE * losses[k]:
            found.append(int(k))
    return found


def _places(problem: Problem, shapes: dict[str, LawShape]) -> dict[str, list[int]]:
    """Where each network's slopes and offset are in the vector of all that is trained."""
    start = problem.start()
    size = ravel_pytree(start)[0].size
    _, unravel = ravel_pytree(start)
    rows = unravel(jnp.arange(size, dtype=float))
    return {
        n: np.concatenate([np.ravel(leaf) for leaf in jax.tree.leaves(rows.networks[n])])
        .astype(int)
        .tolist()
        for n in shapes
    }


def _law(point: np.ndarray, places: Sequence[int], shape: LawShape) -> Affine:
    values = [float(point[k]) for k in places]
    return Affine(tuple(values[: shape.inputs]), 0.0 if shape.through_zero else values[-1])


def _rising(places: dict[str, list[int]], shapes: dict[str, LawShape]) -> list[int]:
    """Places of what must not be negative: slopes of laws that rise, and constants of positive ones."""
    slopes = [k for n, shape in shapes.items() if shape.rising for k in places[n][: shape.inputs]]
    return slopes + [places[n][-1] for n, shape in shapes.items() if shape.positive]


def _decades(base: np.ndarray, places: Sequence[int], shape: LawShape) -> list[np.ndarray]:
    """Points that differ from another one by one slope, or the offset, of one law."""
    points: list[np.ndarray] = [base]
    for i, place in enumerate(places):
        signs = (1.0,) if shape.positive or (shape.rising and i < shape.inputs) else (1.0, -1.0)
        for value in itertools.product(SIZES, signs):
            point = base.copy()
            point[place] = value[0] * value[1]
            points.append(point)
    return points


def _together(base: np.ndarray, places: Sequence[int]) -> list[np.ndarray]:
    """Points that differ from another one by positive slopes of several laws, decade by decade."""
    points: list[np.ndarray] = []
    for values in itertools.product(SIZES[::2], repeat=len(places)):
        point = base.copy()
        point[list(places)] = values
        points.append(point)
    return points


class _Points:
    """Losses and their derivatives at points."""

    def __init__(self, objective: Problem, size: int) -> None:
        self.objective, self.size = objective, size
        self.batch = objective.draw(jax.random.key(0))

    def at(self, points: Sequence[np.ndarray]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Losses, infinite where the model diverges, gradients, Hessians."""
        batches = (points[k : k + BATCH] for k in range(0, len(points), BATCH))
        each = zip(*map(self._batch, batches), strict=True)
        loss, gradient, hessian = map(np.concatenate, each)
        return loss, gradient, hessian

    def _batch(self, points: Sequence[np.ndarray]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        count = len(points)
        filled = np.stack([*points, *[points[-1]] * (BATCH - count)])
        found = _evaluate(self.objective, self.batch, jnp.asarray(filled))
        loss, gradient, hessian = map(np.asarray, found)
        sound = np.isfinite(loss) & np.isfinite(gradient).all(axis=1)
        sound &= np.isfinite(hessian).all(axis=(1, 2))
        return np.where(sound, loss, np.inf)[:count], gradient[:count], hessian[:count]


@compiled
def _evaluate(
    objective: Problem, batch: Any, points: Float[Array, "n P"]
) -> tuple[Array, Array, Array]:
    """Losses, gradients and Hessians."""
    _, unravel = ravel_pytree(objective.start())

    def one(point: Float[Array, " P"]) -> tuple[Array, Array, Array]:
        found = with_gauss_newton_hessian(objective, unravel(point), batch)
        assert found.hessian is not None
        return found.total, ravel_pytree(found.gradient)[0], found.hessian

    return jax.vmap(one)(points)


def _gauss_newton(
    found: _Points, starts: list[np.ndarray], rising: list[int], held: Sequence[int] = ()
) -> tuple[np.ndarray, float, np.ndarray]:
    """The best point, its loss and Hessian."""
    loss, gradient, hessian = found.at(starts)
    chosen = _unlike(loss, SPREAD) or [0]
    known = [(loss[k], starts[k], gradient[k], hessian[k]) for k in chosen]
    dampings = np.geomspace(1e-6, 1e2, BATCH // BEST)
    for _ in range(STEPS):
        before = known[0][0]
        if not np.isfinite(before):
            break
        trials: list[np.ndarray] = []
        for loss, point, gradient, hessian in known:
            for damping in dampings:
                trial = (
                    point + _step(gradient, hessian, damping, held) if np.isfinite(loss) else point
                )
                trial[rising] = np.where(trial[rising] < 0, 0.1 * point[rising], trial[rising])
                trials.append(trial)
        loss, gradient, hessian = found.at(trials)
        for k in range(len(known)):
            own = slice(k * len(dampings), (k + 1) * len(dampings))
            j = int(np.argmin(loss[own])) + own.start
            if loss[j] < known[k][0]:
                known[k] = (loss[j], trials[j], gradient[j], hessian[j])
        chosen = _unlike(np.array([row[0] for row in known]), BEST) or [0]
        known = [known[k] for k in chosen]
        if known[0][0] > before * (1 - ENOUGH):
            break
    loss, point, _, hessian = known[0]
    return point, float(loss), hessian


def _step(
    gradient: np.ndarray, hessian: np.ndarray, damping: float, held: Sequence[int]
) -> np.ndarray:
    """Of Levenberg and Marquardt, damped relative to the Hessian's diagonal; zero for what is held."""
    diagonal = np.diag(hessian)
    unit = np.where(diagonal > 0, 1 / np.sqrt(np.where(diagonal > 0, diagonal, 1.0)), 0.0)
    unit[list(held)] = 0.0
    matrix = hessian * np.outer(unit, unit) + damping * np.eye(len(unit))
    return -unit * np.linalg.lstsq(matrix, unit * gradient, rcond=None)[0]
