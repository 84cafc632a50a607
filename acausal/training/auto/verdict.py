"""The verdict on a training: whether it explains the records down to their noise."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from acausal.errors import TrainingError, listing, percent
from acausal.networks import OffsetCorrected
from acausal.simulation import EXPLICIT, RK4
from acausal.training.auto.likely_causes import likely_causes
from acausal.training.auto.odd_records import odd_records
from acausal.training.auto.outliers import at_limits, outliers
from acausal.training.auto.sensitive import OFF, SENSITIVE, sensitivity
from acausal.training.auto.step_choice import allowed_error, difference
from acausal.training.objective.down_to_noise import is_down_to_noise
from acausal.training.objective.losses import LOSSES, noise_loss
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Simulated, Trainable
from acausal.training.trained_model import TrainedModel
from acausal.training.uncertainty.confidence import Band

SMALL = 0.01
"""A loss of less than this part of the targets' deviation is small, whatever the noise."""

LOOSE, STEEP, MOST_SEEN = 0.1, 0.06, (0.01, 0.99)
"""A law is hardly determined if two of its standard deviations are more than this part of its range, or the second part
where it is steep, anywhere in what its argument was seen at, rare values apart."""

NEAR, STILL = 0.01, 0.9
"""An argument of a law hardly changes where more than the second part of its values are within the first part of its
range about their median."""

TOGETHER = 0.99
"""Arguments of a law whose correlation is above this tell nothing apart."""

FAR_START = 2.0
"""A start that is found further off than so many standard deviations of its prior contradicts it."""

MEAN = 0.95
"""A loss of this part of the targets' deviation is no better than their mean."""


def step_error(problem: Problem, trainable: Trainable, simulated: Simulated) -> float | None:
    """How much twice as many steps change the predictions, as the loss counts it; ``None`` for adaptive steps."""
    if not isinstance(problem.solver, EXPLICIT) or problem.system.events is not None:
        return None
    fine = problem.finer().simulate(trainable)
    return difference(problem, np.asarray(simulated.y), np.asarray(fine.y))


class Verdict(NamedTuple):
    """Whether a fit is good, and why not.

    Attributes:
        good: whether it explains the records down to their noise and leaves nothing else, or less than one part in a
            hundred in all, and they determine its laws and parameters.
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
    simulated = problem.simulate(fit.trained)
    noise, level = noise_loss(problem.records, simulated.y), np.sqrt(len(problem.targets))
    share = fit.loss / level
    steps = fit.step_error is None or fit.step_error <= allowed_error(fit.loss)
    down = is_down_to_noise(problem.records, fit.loss, noise)
    good = explains(problem, fit.loss, noise)
    left = [] if fit.loss <= noise else list(_left(fit))
    if down:
        first = f"explains the record {'nearly ' * bool(left)}down to its noise."
    elif good:
        first = f"explains all but {percent(share)} of the targets; the noise is {percent(noise / level)}."
    elif not np.isfinite(fit.loss):
        first = "does not explain the record: the trained model diverges over it."
    elif share >= MEAN:
        first = f"does not explain the record: a loss of {fit.loss:.3g} is no better than the targets' means."
    else:
        first = (
            f"does not explain the record: it leaves {percent(share)} of the targets, "
            f"the noise is {percent(noise / level)}."
        )
    loose = [*_all_taken(problem), *_far_starts(fit), *(_hardly_determined(fit) if good else ())]
    good = good and not loose and (share <= SMALL or not left)
    suspect = list(outliers(problem, simulated))
    odd = () if good else odd_records(fit)
    limited = list(at_limits(problem, simulated))
    others = [*fit.misread, *odd, *suspect, *limited, *loose, *left]
    if (
        not (down or share <= SMALL)
        and np.isfinite(fit.loss)
        and steps
        and not suspect
        and (sentence := likely_causes(fit))
    ):
        others.append(sentence)
    bad = not good and np.isfinite(fit.loss)
    if fit.pieces:
        others.append(
            f"It was followed in {fit.pieces} pieces, each from a start of its own: over the whole, what a start or a "
            "law is off by grows too far."
        )
    if (
        not fit.pieces
        and bad
        and (times := sensitivity(problem, fit.trained, simulated)) > SENSITIVE
    ):
        others.append(
            f"The model is sensitive: starts that are off by {percent(OFF)} change the targets by "
            f"{percent(OFF * times)}, so even a law that is nearly right may leave the whole record. Judge its "
            "laws over shorter parts (data.between)."
        )
    elif not steps and not ((limited or fit.misread) and np.isfinite(fit.step_error or 0.0)):
        others += _smaller_steps(fit)  # not of laws that are steep since they follow what is wrong
    others += [f"{s}" for s in problem.modifiers.at_limit(fit.modifiers, problem.unit).values()]
    if fit.without_constant:
        others += _constants(fit)
    if fit.not_laws:
        names = ", ".join(fit.not_laws)
        others.append(
            f"{names}: trained from where it was, as its scales do not follow from the data: see that what goes in and "
            "comes out is of the size 1 (of neural elements: input_scale=, output_scale=)."
        )
    return Verdict(bool(good), fit.loss, noise, (first, *others, *_ranges(fit)))


def explains(problem: Problem, loss: float, noise: float) -> bool:
    """Whether a loss is down to that of the noise, or small; True of losses of other kinds."""
    if problem.loss is not LOSSES["nrmse"]:
        return True
    small = loss <= SMALL * np.sqrt(len(problem.targets))
    return bool(np.isfinite(loss) and (small or is_down_to_noise(problem.records, loss, noise)))


def _all_taken(problem: Problem) -> Iterator[str]:
    """Whether there are as many numbers to be found as samples."""
    starts, states = problem.start_prior, problem.system.states
    found = len(problem.modifiers.names) + len(problem.per_record.names) * problem.records.count
    found += 0 if starts is None else int((np.asarray(starts.scale) > 0).sum())
    # what is measured first and taken as the start is explained in any case
    seen = np.isfinite(np.asarray(problem.first_states.given)) & np.isin(states, problem.targets)
    found += int((seen & (True if starts is None else np.asarray(starts.scale) == 0)).sum())
    samples = int((np.asarray(problem.records.weight) > 0).sum())
    if not problem.networks and samples <= found:
        yield (
            f"{samples} samples are explained by as many numbers that were found, starts included: nothing is left to "
            "tell the noise by, and deviations mean nothing. Measure more."
        )


def _far_starts(fit: TrainedModel) -> Iterator[str]:
    """Starts that were found further off than they were taken to be."""
    prior, moves = fit.problem.start_prior, fit.trained.starts
    if prior is None or moves is None:
        return
    unmeasured = np.isnan(np.asarray(fit.problem.first_states.given))
    far = np.where(unmeasured, np.abs(np.asarray(moves)), 0.0).max(axis=0)
    for i in np.flatnonzero(far > FAR_START):
        name = fit.system.states[i]
        yield (
            f"'{name}' was found to start {far[i]:.2g} times as far from the model's start as it was taken to lie, "
            "which holds other numbers back: give its start (x0={...}), or leave it open (x0='fit')."
        )


def _hardly_determined(fit: TrainedModel) -> Iterator[str]:
    """Laws and parameters that could be quite different, for all that the records say."""
    if fit.settings.get("strategy") != "auto":
        return
    try:
        found = fit.confidence()
    except TrainingError:  # derivatives that are not finite, as at events
        return
    doubts = {n: text for n, band in found.laws.items() if (text := _doubt(fit, n, band))}
    yield from found.unknown_parameters()
    yield from found.unknown_starts(doubts)
    yield from doubts.values()


def _doubt(fit: TrainedModel, name: str, band: Band) -> str | None:
    """How a law could be quite different, in a sentence; ``None`` for one that is known well."""
    first, others = np.split(fit.arguments[name], [1], axis=1)
    near = np.all(np.abs(others - np.asarray(band.held)) <= others.std(axis=0), axis=1)
    low, high = np.quantile(first[near], MOST_SEEN)
    seen = (band.x >= low) & (band.x <= high)
    size = np.ptp(band.law[seen]) if seen.any() else 0.0
    if not size > 0:
        return None
    doubt = 2 * band.sigma / size
    even, over = seen & ~band.steep, doubt / np.where(band.steep, STEEP, LOOSE)
    if even.any() and (usual := float(np.median(doubt[even]))) > LOOSE:
        return (
            f"The record hardly determines {name}: it is known to {percent(usual)} of its range only "
            "(two standard deviations). Measure more, or where it matters more."
        )
    if not over[seen].max() > 1:
        return None
    k = int(np.argmax(np.where(seen, over, 0.0)))
    return (
        f"{name} is known to {percent(doubt[k])} of its range only near {band.x[k]:.3g} (two standard "
        f"deviations){', where it is steep' * bool(band.steep[k])}. Measure more there."
    )


def _smaller_steps(fit: TrainedModel) -> Iterator[str]:
    """What to do about steps that err by more than they may."""
    if fit.step_error is None:
        return
    if not np.isfinite(fit.step_error):
        yield "In steps of half the length the model diverges: take a smaller dt."
        return
    level = np.sqrt(len(fit.problem.targets))
    rk4 = "" if isinstance(fit.problem.solver, RK4) else ", or solver='rk4'"
    yield f"Its steps err by {percent(fit.step_error / level)} of the targets: take a smaller dt{rk4}."


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


def _constants(fit: TrainedModel) -> Iterator[str]:
    """What would determine the constants that nothing determines."""
    prior = fit.problem.start_prior
    missing = np.isnan(np.asarray(fit.problem.first_states.given))
    missing &= False if prior is None else np.asarray(prior.scale) > 0
    unknown = [n for n, column in zip(fit.system.states, missing.T, strict=True) if column.any()]
    remedy = (
        f"say where {listing(unknown)} starts (x0=...)"
        if unknown
        else "say which of several laws vanishes at zero (zero_crossing=...)"
    )
    zero = [n for n in fit.without_constant if isinstance(fit.params[n], OffsetCorrected)]
    kept = [n for n in fit.without_constant if n not in zero]
    for names, so in (
        (zero, "it is taken as zero at zero"),
        (kept, "what came out is one of many"),
    ):
        if names:
            yield f"No record determines the constant of {listing(names)}: {so}. To find it, {remedy}."


def _ranges(fit: TrainedModel) -> Iterator[str]:
    """Between what values laws were seen, and which of several arguments hardly changed."""
    for name, seen in fit.arguments.items():
        if not (seen.size and np.isfinite(seen).all()):
            continue
        ends, usual = np.stack([seen.min(axis=0), seen.max(axis=0)]), np.median(seen, axis=0)
        first, *others = (f"between {low:.3g} and {high:.3g}" for low, high in ends.T)
        more = (f", argument {i} {between}" for i, between in enumerate(others, 2))
        yield f"{name} was seen {first}{''.join(more)} only."
        still = np.mean(np.abs(seen - usual) <= NEAR * np.ptp(ends, axis=0), axis=0) > STILL
        with np.errstate(all="ignore"):
            alike = np.abs(np.atleast_2d(np.corrcoef(seen.T)))
        for i, j in np.argwhere(np.triu(alike, 1) > TOGETHER):
            yield (
                f"Arguments {i + 1} and {j + 1} of {name} went together: what {name} does where they do not is hardly "
                "known."
            )
        for i in np.flatnonzero(still) if others else ():
            yield (
                f"Argument {i + 1} of {name} was {usual[i]:.3g} nearly always: "
                f"what {name} does at other values is hardly known."
            )
