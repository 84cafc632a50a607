"""Profiles: the loss minimised again along one parameter, which shows whether and how well data determine it.

All points are trained side by side in one program: the parameter stays where it is put because derivatives by it are
zero, so that neither L-BFGS nor Gauss-Newton steps move it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from statistics import NormalDist
from typing import TYPE_CHECKING, Any, cast

import jax
import jax.numpy as jnp
import numpy as np
from jax.flatten_util import ravel_pytree
from jaxtyping import Array, Bool, Float

from acausal._jax import is_number, levenberg_marquardt
from acausal.errors import TrainingError, known_name, need_whole, shown
from acausal.reporting import LEARNED, TRUTH, one_axes
from acausal.training.member import stacked
from acausal.training.objective.modifiers import Bounded, Shift
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable
from acausal.training.objective.whole_record import gauss_newton, over_whole_record
from acausal.training.optimizers.gradients import with_gauss_newton_hessian, with_gradient
from acausal.training.optimizers.lbfgs import lbfgs
from acausal.training.optimizers.trainer import Trainer, advance, begin
from acausal.training.uncertainty.confidence import Confidence

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FEW = 60
"""Up to so many trained numbers, steps are those of Gauss and Newton; of more, of L-BFGS."""

UPDATES = {"gauss_newton": 30, "lbfgs": 120}
"""How many of them each point makes at most."""

LEFT = 0.02
"""Share of the way to a bound that points leave."""

LEVEL = 0.95
"""Of the interval of a profile."""

BETTER = 0.5
"""A profile has found another minimum if its log likelihood is higher than the fit's by more than this."""


NARROW = (6.0, 3.2)
"""Size of a figure, in inches."""

SHOWN = 4.0
"""Ratios are drawn up to so many times the bound."""


@dataclass(frozen=True, eq=False)
class Profile:
    """The loss along a parameter, with everything else trained again at each of its values.

    Attributes:
        name: the parameter; ``unit``: its unit.
        value: where the fit found it.
        values: where it was held.
        losses: what was minimised, with all penalties and priors; infinite where the model diverges.
        others: the values of the other trained parameters, by name.
        ratio: twice the log likelihood that is lost, compared with the best point: beyond the square of 1.96 a value
            is refused with 95 % confidence. Correlated residuals count for less than one each.
        converged: the points whose minimum was found; others may lie a little too high.
        level: of the interval.
    """

    name: str
    unit: str
    value: float
    values: Float[np.ndarray, " points"]
    losses: Float[np.ndarray, " points"]
    others: dict[str, Float[np.ndarray, " points"]]
    ratio: Float[np.ndarray, " points"]
    converged: Bool[np.ndarray, " points"]
    level: float = LEVEL

    @property
    def bound(self) -> float:
        """The largest ratio inside of the interval, that of χ² with one degree of freedom."""
        return NormalDist().inv_cdf((1 + self.level) / 2) ** 2

    @property
    def best(self) -> float:
        """The value with the lowest loss."""
        return float(self.values[np.argmin(self.ratio)])

    @property
    def interval(self) -> tuple[float, float]:
        """The values that the likelihood ratio does not refuse; infinite on a side where none is refused."""
        k = int(np.argmin(self.ratio))
        low = _crossing(self.values[k::-1], self.ratio[k::-1], self.bound)
        high = _crossing(self.values[k:], self.ratio[k:], self.bound)
        return (-math.inf if low is None else low, math.inf if high is None else high)

    @property
    def identifiable(self) -> bool:
        """Whether the data bound the parameter on both sides."""
        return all(map(math.isfinite, self.interval))

    def summary(self) -> str:
        """What this means, in a sentence or two."""
        low, high = self.interval
        sure = f"with {100 * self.level:g} % confidence"
        first, last = (self._written(v) for v in self.values[[0, -1]].tolist())
        if self.identifiable:
            found = f"'{self.name}' is identifiable: {sure} between {self._written(low)} and {self._written(high)}."
        elif math.isfinite(low):
            found = (
                f"'{self.name}' is bounded from below alone: {sure} above {self._written(low)}, "
                f"up to {last} at least."
            )
        elif math.isfinite(high):
            found = (
                f"'{self.name}' is bounded from above alone: {sure} below {self._written(high)}, "
                f"down to {first} at least."
            )
        else:
            found = (
                f"'{self.name}' is not identifiable: from {first} to {last} the other parameters and laws make up for "
                "it. Fix it, or measure more."
            )
        at = self.ratio[np.argmin(np.abs(self.values - self.value))]
        if at > 2 * BETTER:
            found += f" A lower loss than the fit's was found at {self._written(self.best)}: train again from there."
        return found

    def plot(self, axes: Any = None) -> Figure:
        """Plot the likelihood ratio over the parameter, with the bound of the interval.

        Arguments:
            axes: matplotlib axes; by default those of a new figure.

        Returns:
            The figure.
        """
        ax = one_axes(axes, NARROW, "axes")
        ax.plot(self.values, self.ratio, "o-", color=LEARNED[0], lw=1.2, ms=3)
        ax.axhline(self.bound, color=TRUTH, lw=0.9, ls=":")
        ax.axvline(self.value, color=TRUTH, lw=0.9, ls="--")
        finite = self.ratio[np.isfinite(self.ratio)]
        top = min(float(finite.max()), SHOWN * self.bound)
        ax.set_ylim(-0.05 * self.bound, 1.1 * max(top, self.bound))
        unit = "" if self.unit in ("", "1") else f" in {self.unit}"
        ax.set(xlabel=f"{self.name}{unit}", ylabel="likelihood ratio")
        ax.grid(alpha=0.25)
        return cast("Figure", ax.figure)

    def _written(self, value: float) -> str:
        return f"{value:.4g} {self.unit}".removesuffix(" 1").rstrip()

    def __repr__(self) -> str:
        return f"Profile of {len(self.values)} points: {self.summary()}"


def _crossing(
    values: Float[np.ndarray, " n"], ratio: Float[np.ndarray, " n"], bound: float
) -> float | None:
    """Where the ratio first exceeds the bound: between points its root, which is nearly straight, is interpolated."""
    beyond = np.flatnonzero(ratio > bound)
    if not len(beyond):
        return None
    k = int(beyond[0])
    if not np.isfinite(ratio[k]):
        return float(values[k])
    inner, outer, edge = np.sqrt(ratio[k - 1]), np.sqrt(ratio[k]), math.sqrt(bound)
    return float(values[k - 1] + (values[k] - values[k - 1]) * (edge - inner) / (outer - inner))


@dataclass(frozen=True)
class _HeldShift(Shift):
    """A parameter that stays where it is put, because all derivatives by it are zero."""

    def change(self, value: Float[Array, ""], delta: Float[Array, ""]) -> Float[Array, ""]:
        """That of `Shift`."""
        return super().change(value, jax.lax.stop_gradient(delta))


def profile(
    problem: Problem,
    trained: Trainable,
    sure: Confidence,
    name: str,
    points: int = 21,
    width: float = 3.0,
    level: float = LEVEL,
) -> Profile:
    """The profile of a trained parameter, see `Fit.profile`.

    Raises:
        TrainingError: for a parameter that was not trained, or numbers that do not fit.
    """
    _check(problem, name, points, width, level)
    params = problem.assemble(trained)
    value = float(params[name])
    values = _points(problem, sure, name, value, points, width)
    held, starts = _starts(problem, trained, params, name, values)
    trainer, updates = _trainer(starts[0])
    state = stacked([begin(trainer, start, jax.random.key(0)) for start in starts])
    state, _ = advance(held, trainer, state, jnp.asarray(updates))
    _, unravel = ravel_pytree(starts[0])
    losses = np.asarray(state.optimizer.value)

    def trained_values(flat: Float[Array, " n"]) -> dict[str, Array]:
        assembled = held.assemble(unravel(flat))
        return {n: jnp.asarray(assembled[n]) for n in problem.modifiers.names if n != name}

    others = jax.vmap(trained_values)(state.optimizer.point)
    return Profile(
        name,
        problem.system.unit(name),
        value,
        values,
        losses,
        {n: np.asarray(v) for n, v in others.items()},
        _ratio(problem, sure, losses),
        np.asarray(state.optimizer.converged),
        level,
    )


def _check(problem: Problem, name: str, points: int, width: float, level: float) -> None:
    names = problem.modifiers.names
    if not names:
        raise TrainingError(
            f"profile: {shown(name)} was not trained; no parameter was, see modifiers=."
        )
    known_name(name, names, "profile: no parameter was trained that is", TrainingError)
    if need_whole(points, "profile: points", TrainingError) < 5 or points % 2 == 0:
        raise TrainingError(f"profile: points={shown(points)}; give an odd number, 5 or more.")
    if not (is_number(width) and width > 0):
        raise TrainingError(f"profile: width={shown(width)}; give a number of standard deviations.")
    if not (is_number(level) and 0 < level < 1):
        raise TrainingError(f"profile: level={shown(level)}; give a number between 0 and 1.")


def _points(
    problem: Problem, sure: Confidence, name: str, value: float, points: int, width: float
) -> Float[np.ndarray, " points"]:
    """Values evenly to both sides of where the fit found it, inside of its bounds and of the same sign."""
    kind = problem.modifiers.kinds[problem.modifiers.names.index(name)]
    low, high = problem.system.layout.range_of(name)
    relative = bool(kind.unit)
    if isinstance(kind, Bounded):
        low, high = max(low, kind.low), min(high, kind.high)
    if relative:
        low, high = (max(low, 0.0), high) if value > 0 else (low, min(high, 0.0))
    reach = width * sure.parameters[name] * (abs(value) if relative else 1.0)
    ends = [
        math.copysign(min(reach, (1 - LEFT) * abs(bound - value)), bound - value)
        for bound in (low, high)
    ]
    half = np.linspace(0.0, 1.0, points // 2 + 1)
    return value + np.concatenate([ends[0] * half[:0:-1], ends[1] * half])


def _starts(
    problem: Problem,
    trained: Trainable,
    params: dict[str, Any],
    name: str,
    values: Float[np.ndarray, " points"],
) -> tuple[Problem, list[Trainable]]:
    """The problem over whole records in which the parameter stays where it is, and a start for each of its values."""
    moved = problem.modifiers
    i = moved.names.index(name)
    centre, scale = float(params[name]), float(np.ptp(values))
    kinds = (*moved.kinds[:i], _HeldShift(scale), *moved.kinds[i + 1 :])
    start = (*moved.values[:i], jnp.asarray(centre), *moved.values[i + 1 :])
    free = replace(
        problem,
        params={**problem.params, name: jnp.asarray(centre)},
        modifiers=replace(moved, kinds=kinds, values=start),
    )
    few = _size(trained) <= FEW
    whole = gauss_newton(free) if few else over_whole_record(free)
    entry = whole.entry(trained)
    starts = [
        replace(entry, modifiers={**entry.modifiers, name: jnp.asarray((v - centre) / scale)})
        for v in values.tolist()
    ]
    return whole, starts


def _size(trainable: Trainable) -> int:
    return sum(leaf.size for leaf in jax.tree.leaves(trainable))


def _nothing(objective: Any, trainable: Any) -> dict[str, Array]:
    return {}


def _trainer(start: Trainable) -> tuple[Trainer, int]:
    """How each point is trained, and the number of updates."""
    if _size(start) <= FEW:
        steps = Trainer(levenberg_marquardt(), math.inf, _nothing, with_gauss_newton_hessian)
        return steps, UPDATES["gauss_newton"]
    return Trainer(lbfgs(), math.inf, _nothing, with_gradient), UPDATES["lbfgs"]


def _ratio(
    problem: Problem, sure: Confidence, losses: Float[np.ndarray, " points"]
) -> Float[np.ndarray, " points"]:
    """Twice the log likelihood that each point loses."""
    counts = np.sum(np.asarray(problem.records.weight) > 0, axis=0)
    samples = float(np.sum(counts / np.array([sure.alike[n] for n in problem.targets])))
    with np.errstate(divide="ignore", invalid="ignore"):
        logarithm = losses if problem.counts_as_logarithm else np.log(losses)
    logarithm = np.where(np.isfinite(losses), logarithm, np.inf)
    if not np.isfinite(logarithm).any():
        raise TrainingError("profile: the model diverges wherever the parameter is held.")
    return np.asarray(2 * samples * (logarithm - logarithm.min()))
