"""What residuals look like: a parameter that is off, a wrong sign, unit or zero of a sensor, targets that come late.

Each such cause moves the predictions in a direction. What was trained has taken a part of that already, as far as it
can: laws, parameters and starts. So the residuals are compared with the rest of the direction, which is what the cause
would explain if it were trained beside them (R. Frisch, F. V. Waugh: Partial Time Regressions as Compared with
Individual Trends, Econometrica 1 (1933), 387-401).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from acausal.errors import listing, percent
from acausal.training.objective.input_gains import (
    gains,
    in_words,
    to_check,
    with_gain,
    with_held,
    with_offset,
)
from acausal.training.objective.start_prior import StartPrior
from acausal.training.trained_model import TrainedModel
from acausal.training.uncertainty.changes import changes
from acausal.training.uncertainty.laplace import by_record, residuals_and_jacobian
from acausal.training.uncertainty.record_elimination import untaken

LIKELY = 0.7
"""The residuals look like a cause if they follow it to this part."""

FAR = float(np.log(5))
"""A parameter that is off by a larger factor does not show by small changes."""

MOST = 2
"""So many causes of a kind are named."""

MOST_LATE = 0.25
"""Nothing comes later than by this part of a record."""

MOST_HELD = 2.0
"""An input that is held where it should be is so once, and not more often."""

STRAIGHT = 1e-6
"""A polygon bends where its rise from sample to sample changes by more than this part of its range,"""

FEWEST_BENDS, MOST_BENDS = 3, 0.5
"""at least so often, and at most at this part of the samples, if it comes from few samples or has steps."""

MOST_STARTS = 50
"""Of more states no starts are suspected, as each costs a simulation."""

AT_ONCE = 16
"""Parameters whose effects are computed at once."""


@dataclass(frozen=True, eq=False)
class Cause:
    """What residuals may come from: a parameter that is off by a factor.

    Attributes:
        names: of a parameter, an input, or targets.
        effect: how the predictions move by it: by a factor of e of a parameter, by once as much of an input, by a
            second of a delay.
        far: the largest size that shows by small changes.
    """

    names: tuple[str, ...]
    effect: Float[np.ndarray, "N n_targets"]
    far: float = FAR

    def sentence(self, size: float) -> str:
        """What it is, by its size."""
        sign = "-" if size < 0 else "+"
        return f"{self.names[0]} changed by {sign}{percent(abs(np.expm1(size)))}"

    def remedy(self, size: float) -> str:
        """What to do about it."""
        return f"if you do not know it so well, train it, too: modifiers=['{self.names[0]}']"


class Late(Cause):
    """Targets that come late."""

    def sentence(self, size: float) -> str:
        """By how much."""
        return f"{listing(self.names)} came {abs(size):.2g} s {'early' if size < 0 else 'late'}"

    def remedy(self, size: float) -> str:
        """A delay that is trained."""
        kind = f"ac.Delay({'min' if size < 0 else 'max'}={3 * size:.1g})"
        return f"train it: delays={{{', '.join(f'{name!r}: {kind}' for name in self.names)}}}"


class Gain(Cause):
    """An input that has another sign, unit or size than its record says."""

    def sentence(self, size: float) -> str:
        """Which of them."""
        return in_words(self.names[0], 1 + size)

    def remedy(self, size: float) -> str:
        """What to look at."""
        return to_check(1 + size)


class Held(Cause):
    """An input that was held from sample to sample, and is read along straight lines."""

    def sentence(self, size: float) -> str:
        """Which one."""
        return f"{self.names[0]} was held from sample to sample"

    def remedy(self, size: float) -> str:
        """How to read it so."""
        return f"read it so: interpolation={{'{self.names[0]}': 'previous'}}, of the data"


class OtherStart(Cause):
    """A state that is not measured, and did not start where it was taken to."""

    def sentence(self, size: float) -> str:
        """Which one."""
        return f"{self.names[0]} did not start where it was taken to"

    def remedy(self, size: float) -> str:
        """How to leave it open."""
        return "leave it open: x0='fit'"


@dataclass(frozen=True, eq=False)
class Offset(Cause):
    """An input or a target that counts from another zero; its effect is that of a unit more.

    Attributes:
        unit: its unit, behind a space, if it has one. sign: -1 where the record reads what its effect takes away.
    """

    unit: str = ""
    sign: int = 1

    def sentence(self, size: float) -> str:
        """How far its zero is off."""
        high = "high" if self.sign * size > 0 else "low"
        return f"{self.names[0]} read {abs(size):.2g}{self.unit} too {high}"

    def remedy(self, size: float) -> str:
        """What to look at."""
        return "check the zero of its sensor"


def likely_causes(fit: TrainedModel) -> str | None:
    """What the residuals of a fit look like, in a sentence; ``None`` if like nothing in particular."""
    problem = fit.problem
    if not all(map(len, fit.arguments.values())):
        return None  # a network that is never called takes nothing, and has no place to bump
    change = changes(problem, fit.trained, fit.arguments)
    left, jacobian = residuals_and_jacobian(problem, change)
    causes = [
        *_parameters(fit),
        *_inputs(fit),
        *_held(fit),
        *_offsets(fit),
        *_delays(fit),
        *_starts(fit),
    ]
    effects = np.stack([left, *(cause.effect for cause in causes)], axis=-1)
    counts = np.asarray(problem.records.weight) > 0
    size = np.sqrt(np.sum(left**2, axis=0) / np.maximum(np.sum(counts, axis=0), 1))
    unit = np.where(counts & (size > 0), 1 / np.where(size > 0, size, 1.0), 0.0)[..., None]
    taken, effects = ((a * unit).reshape(left.size, -1) for a in (jacobian, effects))
    if not (np.isfinite(taken).all() and np.isfinite(effects[:, 0]).all()):
        return None
    effects = np.where(np.isfinite(effects).all(axis=0), effects, 0.0)
    rest = untaken(by_record(change, taken), effects)
    squares = np.sum(rest**2, axis=0)
    along = rest[:, 0] @ rest
    with np.errstate(all="ignore"):
        sizes, shares = along / squares, np.abs(along) / np.sqrt(squares * squares[0])
    likely = {
        cause: float(sizes[k])
        for k in np.argsort(-np.nan_to_num(shares[1:])) + 1
        if shares[k] > LIKELY and abs(sizes[k]) < (cause := causes[k - 1]).far
    }
    if not likely:
        return None
    if any(isinstance(cause, Held) for cause in likely):  # which comes late by half a sample
        likely = {cause: size for cause, size in likely.items() if not isinstance(cause, Late)}
    kinds = [type(cause) for cause in likely]
    looks = " or ".join(
        f"{cause.sentence(size)} ({cause.remedy(size)})"
        for i, (cause, size) in enumerate(likely.items())
        if kinds[:i].count(kinds[i]) < MOST
    )
    return f"What is left looks as if {looks}."


def _parameters(fit: TrainedModel) -> Iterator[Cause]:
    """The parameters that were taken as known."""
    problem, trainable = fit.problem, fit.trained
    params, layout = problem.assemble(trainable), problem.system.layout
    names = [
        n
        for n in layout.names
        if n not in problem.modifiers.names
        and n in params
        and np.ndim(params[n]) == 0
        and float(params[n]) != 0
        and layout.why_not_free(n) is None
    ]

    def predicted(step: Float[Array, " n"]) -> Float[Array, "N n_targets"]:
        moves = {n: params[n] * jnp.exp(s) for n, s in zip(names, step, strict=True)}
        return problem.predict(trainable, {**params, **moves})

    yield from (Cause((n,), e) for n, e in zip(names, _effects(predicted, len(names)), strict=True))


def _inputs(fit: TrainedModel) -> Iterator[Cause]:
    """The inputs that are samples."""
    problem, trainable = fit.problem, fit.trained
    params, columns = problem.assemble(trainable), gains(problem)
    each = jnp.asarray(list(columns.values())).reshape(len(columns), len(problem.system.inputs))

    def predicted(step: Float[Array, " n"]) -> Float[Array, "N n_targets"]:
        return with_gain(problem, 1 + step @ each).predict(trainable, params)

    effects = _effects(predicted, len(columns))
    yield from (Gain((n,), e, np.inf) for n, e in zip(columns, effects, strict=True))


def _held(fit: TrainedModel) -> Iterator[Cause]:
    """The inputs that are straight between few samples, or constant but for steps."""
    problem, trainable = fit.problem, fit.trained
    params, columns = problem.assemble(trainable), gains(problem)
    samples = problem.records.steps.inputs
    if samples.coefficients is not None:
        return
    start, end = np.asarray(samples.start), np.asarray(samples.end)
    begins = np.asarray(problem.records.begins)
    before = None
    for name, own in columns.items():
        i, *others = np.flatnonzero(own).tolist()
        if others or problem.system.inputs[i] != name:  # what the model differentiates is smooth
            continue
        held = _from_knots(start[:, i], end[:, i], begins)
        if held is None:
            continue
        before = problem.predict(trainable, params) if before is None else before
        after = with_held(problem, i, jnp.asarray(held)).predict(trainable, params)
        yield Held((name,), np.asarray(after - before), MOST_HELD)


def _from_knots(
    start: Float[np.ndarray, " n"], end: Float[np.ndarray, " n"], begins: Bool[np.ndarray, " n"]
) -> Float[np.ndarray, " n"] | None:
    """The values of an input that is held from each bend of a polygon to the next; None for one that bends often."""
    slope = end - start
    bends = begins | (np.abs(np.diff(slope, prepend=np.nan)) > STRAIGHT * np.ptp(start))
    bends[0] = True
    if not slope.any() or not FEWEST_BENDS <= np.sum(bends & ~begins) <= MOST_BENDS * len(start):
        return None
    return start[np.maximum.accumulate(np.where(bends, np.arange(len(start)), 0))]


def _offsets(fit: TrainedModel) -> Iterator[Cause]:
    """The targets, and the inputs that are samples."""
    problem, trainable = fit.problem, fit.trained
    params, names = problem.assemble(trainable), tuple(gains(problem))
    known = list(problem.system.inputs)
    each = np.asarray([[n == other for other in known] for n in names], float)
    each = jnp.asarray(each.reshape(len(names), len(known)))
    unit = {n: f" {u}" if (u := problem.unit(n)) else "" for n in (*names, *problem.targets)}

    def predicted(step: Float[Array, " n"]) -> Float[Array, "N n_targets"]:
        return with_offset(problem, step @ each).predict(trainable, params)

    for name, effect in zip(names, _effects(predicted, len(names)), strict=True):
        yield Offset((name,), effect, np.inf, unit[name], sign=-1)
    shape = np.shape(problem.records.weight)
    for i, name in enumerate(problem.targets):
        effect = np.zeros(shape)
        effect[:, i] = 1
        yield Offset((name,), effect, np.inf, unit[name])


def _starts(fit: TrainedModel) -> Iterator[Cause]:
    """The states that are taken to start as the model does."""
    problem, trainable = fit.problem, fit.trained
    known = np.isfinite(np.asarray(problem.first_states.given))
    scale = 0 * known if problem.start_prior is None else np.asarray(problem.start_prior.scale)
    held = ~known & (scale == 0)
    places = np.flatnonzero(held.any(axis=0))
    if len(places) > MOST_STARTS:
        return
    names = [problem.system.states[i] for i in places]
    moved = np.where(held, problem.system.nominal, scale)
    freed = replace(problem, start_prior=StartPrior(jnp.asarray(moved)))
    params = problem.assemble(trainable)
    found = jnp.zeros(moved.shape) if trainable.starts is None else trainable.starts

    def predicted(step: Float[Array, " n"]) -> Float[Array, "N n_targets"]:
        starts = found.at[:, places].add(jnp.where(held[:, places], step, 0.0))
        return freed.predict(replace(trainable, starts=starts), params)

    for name, effect in zip(names, _effects(predicted, len(names)), strict=True):
        yield OtherStart((name,), effect, np.inf)


def _effects(predicted: Callable[[Array], Array], n: int) -> Float[np.ndarray, "n N n_targets"]:
    """How predictions move along each of n numbers, from zero."""

    def along(direction: Float[Array, " n"]) -> Float[Array, "N n_targets"]:
        return jax.jvp(predicted, (jnp.zeros(n),), (direction,))[1]

    run = jax.jit(lambda rows: jax.lax.map(along, rows, batch_size=AT_ONCE))
    return np.asarray(run(jnp.eye(n)) if n else [])


def _delays(fit: TrainedModel) -> Iterator[Cause]:
    """All targets, as after inputs that come late, and each alone, as behind a slow sensor."""
    problem, records = fit.problem, fit.problem.records
    y, t = np.asarray(problem.simulate(fit.trained).y), np.asarray(records.steps.t)
    ends = np.asarray(records.first)[1:]
    rate = np.concatenate(
        [
            np.gradient(one, time, axis=0) if len(time) > 1 else np.zeros_like(one)
            for one, time in zip(np.split(y, ends), np.split(t, ends), strict=True)
        ]
    )
    late = [n for n in problem.targets if n not in problem.timing.delays]
    columns = [[problem.targets.index(n)] for n in late]
    if len(problem.targets) == len(late) > 1:
        columns.append(list(range(len(late))))
    for some in columns:
        effect = np.zeros_like(rate)
        effect[:, some] = -rate[:, some]
        fastest = np.max(np.std(rate[:, some], axis=0) / np.asarray(records.sigma)[some])
        longest = MOST_LATE * max(float(np.ptp(own)) for own in np.split(t, ends))
        if fastest > 0:
            names = tuple(problem.targets[i] for i in some)
            yield Late(names, effect, min(float(1 / fastest), longest))
