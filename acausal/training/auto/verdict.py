"""The verdict on a training: whether it explains the records down to their noise."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from acausal.errors import listing
from acausal.simulation import EXPLICIT
from acausal.training.auto.step_choice import allowed_error, difference
from acausal.training.objective.losses import LOSSES, noise_loss
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Simulated, Trainable
from acausal.training.trained_model import TrainedModel

DOWN_TO = 1.15
"""A loss of up to so many times that of the noise is down to the noise,"""

SMALL = 0.01
"""and one of less than this part of the targets' deviation is small, whatever the noise."""

MEAN = 0.95
"""A loss of this part of the targets' deviation is no better than their mean."""


def step_error(problem: Problem, trainable: Trainable, simulated: Simulated) -> float | None:
    """How much twice as many steps change the predictions, as the loss counts it; ``None`` for adaptive steps."""
    if not isinstance(problem.solver, EXPLICIT) or problem.system.events is not None:
        return None
    fine = replace(problem, substeps=2 * problem.substeps).simulate(trainable)
    return difference(problem, np.asarray(simulated.y), np.asarray(fine.y))


class Verdict(NamedTuple):
    """Whether a fit is good, and why not.

    Attributes:
        good: whether it explains the records down to their noise, or leaves less than one part in a hundred.
        loss, noise: over the records, and what their noise alone leaves.
        sentences: what there is to say.
    """

    good: bool
    loss: float
    noise: float
    sentences: tuple[str, ...]

    def __str__(self) -> str:
        """All in one line."""
        return " ".join(self.sentences)


def verdict(fit: TrainedModel) -> Verdict | None:
    """The verdict on a fit; ``None`` where the loss is not a normalised root mean square."""
    problem = fit.problem
    if problem.loss is not LOSSES["nrmse"]:
        return None
    noise, level = noise_loss(problem.records), np.sqrt(len(problem.targets))
    share = fit.loss / level
    steps = fit.step_error is None or fit.step_error <= allowed_error(fit.loss)
    down = fit.loss <= DOWN_TO * noise
    good = bool(np.isfinite(fit.loss) and (down or share <= SMALL))
    if down:
        first = "explains the record down to its noise."
    elif good:
        first = f"explains all but {100 * share:.2g} % of the targets; the noise is {100 * noise / level:.2g} %."
    elif not np.isfinite(fit.loss):
        first = "does not explain the record: the trained model diverges over it."
    elif share >= MEAN:
        first = f"does not explain the record: a loss of {fit.loss:.3g} is no better than the targets' means."
    else:
        first = (
            f"does not explain the record: it leaves {100 * share:.2g} % of the targets, "
            f"the noise is {100 * noise / level:.2g} %."
        )
    others = [] if down else list(_left(fit))
    if not steps and fit.step_error is not None:
        others.append(
            f"Its steps err by {100 * fit.step_error / level:.2g} % of the targets: take a smaller dt."
        )
    others += [f"{s}" for s in problem.modifiers.at_limit(fit.modifiers, problem.unit).values()]
    if fit.without_constant:
        others.append(_constants(fit))
    if fit.not_laws:
        names = ", ".join(fit.not_laws)
        others.append(
            f"{names}: a module of your own, trained from where it was, with your scales."
        )
    return Verdict(good, fit.loss, noise, (first, *others, *_ranges(fit)))


def _left(fit: TrainedModel) -> Iterator[str]:
    """What residuals follow."""
    if not np.isfinite(fit.loss):
        return
    for each in fit.residuals():
        if drivers := each.drivers:
            most = max(drivers, key=lambda n: np.max(np.abs(each.inputs[n])))
            largest = float(np.max(np.abs(each.inputs[most])))
            yield f"The residuals of {each.target} follow {most}, up to a correlation of {largest:.2g}."
        elif each.bound < 1 and not each.is_white:
            largest = float(np.max(np.abs(each.own)))
            yield f"The residuals of {each.target} are not white, up to a correlation of {largest:.2g}."


def _constants(fit: TrainedModel) -> str:
    """What would determine the constants that nothing determines."""
    missing = np.isnan(np.asarray(fit.problem.first_states.given))
    unknown = [n for n, column in zip(fit.system.states, missing.T, strict=True) if column.any()]
    remedy = (
        f"say where {listing(unknown)} starts (x0=...)"
        if unknown
        else "say which of several laws vanishes at zero (zero_crossing=...)"
    )
    return (
        f"No record determines the constant of {listing(fit.without_constant)}: it is taken as zero at zero. "
        f"To find it, {remedy}."
    )


def _ranges(fit: TrainedModel) -> Iterator[str]:
    """Between what values laws were seen."""
    for name, seen in fit.arguments.items():
        if seen.size and np.isfinite(seen).all():
            low, high = seen[:, 0].min(), seen[:, 0].max()
            yield f"{name} was seen between {low:.3g} and {high:.3g} only."
