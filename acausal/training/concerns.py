"""What a user should know of a training that has ended: divergences, what did not move, what is out of range."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set

import jax
import numpy as np

from acausal._jax import compiled
from acausal.analysis import in_switches
from acausal.codegen import Values, failures
from acausal.errors import listing, percent
from acausal.simulation import EXPLICIT, long_steps
from acausal.training.happened import grazing
from acausal.training.member import Trained
from acausal.training.objective.down_to_noise import down_to
from acausal.training.objective.losses import LOSSES, noise_loss, nrmse
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Simulated, Trainable
from acausal.training.rejections import SHORTER_STEPS
from acausal.training.uncertainty.confidence import BAD

MUCH = 1.3
"""Noise is allowed to be so many times as large as it seems, or more where few samples tell it."""

EXACT = 1e-100
"""A loss at which a model follows its record to roundoff, so that nothing needs to change."""


def concerns(
    problem: Problem, start: Trainable, trained: Trained, *, whole: bool = False
) -> Iterator[str]:
    """Warnings about a training, one sentence each; ``whole``: whether it was to go on until records are explained."""
    diverged, epochs = trained.history.divergences, trained.history.epochs
    if diverged:
        yield (
            f"Something diverged in {len(diverged)} of {epochs} epochs and was left out "
            f"(fit.history.divergences); first, {diverged[0]}."
            + (f" {SHORTER_STEPS}" if any(d.exploded for d in diverged) else "")
        )
    if not np.isfinite(trained.best.loss):
        yield "The trained model diverges over the whole record: its loss is infinite."
    elif trained.best.epoch == 0 and (sentence := _long_steps(problem, trained)):
        yield f"Training found nothing better than its start. {sentence}"
    elif sentence := _unexplained(problem, trained.simulated, whole=whole):
        yield sentence
    if not problem.sequences.whole and (remembered := problem.system.remembered):
        yield (
            f"Sequences begin with the start values of {listing(remembered)}, whatever they are in the record: "
            "take whole records (sequence_length=None), or give them as inputs: "
            f"ac.compile(model, inputs={[remembered[0]]})."
        )
    if clause := grazing(problem.system, problem.records, trained.simulated.log):
        yield (
            f"The condition {clause}: there the gradient does not exist, or is huge, and training may not get past it. "
            "Leave this part of the record out, or start from other values."
        )
    yield from _not_as_asserted(problem, trained.best.trainable)
    unmoved = _unmoved(start, trained.last)
    exact = 0 <= trained.history.full_loss[0, 1] <= EXACT
    if unmoved and len(diverged) < epochs and not exact:
        has_events = problem.system.events is not None
        yield from _reasons(unmoved, in_switches(problem.system), has_events)
    if clause := _out_of_range(problem, trained.best.trainable):
        yield (
            f"After training, {clause}. Keep it in its range: modifiers={{...: ac.Bounded(low, high)}}."
        )
    changes = problem.changes(trained.best.trainable)
    yield from problem.modifiers.at_limit(changes, problem.unit).values()


def _not_as_asserted(problem: Problem, trained: Trainable) -> Iterator[str]:
    """What the model asserts of its parameters, and does not hold for those that were trained."""
    system = problem.system
    if system.flat.assertions:
        packed = problem.pack(problem.assemble(trained), trained).common
        yield from failures(system.flat, system.layout.by_number(np.asarray(packed.values)))


def _long_steps(problem: Problem, trained: Trained) -> str | None:
    """A sentence on steps that are too long for gradients, or None."""
    if not isinstance(problem.solver, EXPLICIT):
        return None
    packed = problem.system.pack(problem.model_params(trained.best.trainable))
    values = Values(problem.records.steps.t, trained.simulated.x, problem.inputs, packed)
    return long_steps(problem.system, values, problem.longest_step)


def _unexplained(problem: Problem, simulated: Simulated, *, whole: bool) -> str | None:
    """A sentence on a model that leaves much more of its records than their noise, or None.

    Arguments:
        whole: whether a model that follows them better than a constant is named, too; by the usual loss alone.
    """
    records, level = problem.records, float(np.sqrt(len(problem.targets)))
    # in standard deviations of the targets, added up over these
    error = float(compiled(nrmse)(simulated.y, records.y, records.sigma, records.weight))
    if error < level and not (whole and problem.loss is LOSSES["nrmse"]):
        return None
    noise = noise_loss(records, simulated.y)
    if error >= level:
        return (
            f"The trained model is no better than the targets' mean: its error is {error:.3g}, that of the mean "
            f"{level:.3g}, that of the noise about {noise:.2g} (in standard deviations, added up "
            "over targets). Do not use it: train longer, by another strategy, or from better parameters (params=...) "
            "and scales (input_scale=, output_scale=)."
        )
    much = max(MUCH, down_to(records))
    if error**2 <= (much * noise) ** 2 + (BAD * level) ** 2:
        return None
    return (
        f"The trained model does not explain the record: it leaves {percent(error / level)} of the targets, the noise "
        f"is {percent(noise / level)}. print(fit) says what is known of the cause."
    )


def _reasons(unmoved: Sequence[str], in_switches: Set[str], has_events: bool) -> Iterator[str]:
    """Why training did not move some networks and parameters."""
    switching = [n for n in unmoved if n in in_switches]
    others = [n for n in unmoved if n not in in_switches]
    if switching:
        yield (
            f"Training did not move {listing(switching)}: a switch (where, if, sign, floor) depends on it, and has "
            "no gradient. Smooth it (tanh in the place of sign), make it an event (ac.where(..., events=True), or for "
            "the library's ac.compile(model, events=True)), or leave it out (train=..., modifiers=...)."
        )
    if others and has_events:
        yield (
            f"Training did not move {listing(others)}: no target depends on it with the events that happen at the "
            "values where training began. Begin where the model switches as the data do (params=..., starts=...), fit "
            "a target that depends on it, or leave it out (train=..., modifiers=...)."
        )
    elif others:
        yield (
            f"Training did not move {listing(others)}: no target depends on it. "
            "Fit a target that does, or leave it out (train=..., modifiers=...)."
        )


def _out_of_range(problem: Problem, trained: Trainable) -> str | None:
    """A clause on trained parameters outside of their declared ranges."""
    params, moved = problem.assemble(trained), problem.modifiers.names
    layout = problem.system.layout
    return layout.out_of_range(
        np.asarray([float(params[n]) if n in moved else np.nan for n in layout.names])
    )


def _unmoved(start: Trainable, end: Trainable) -> list[str]:
    """The networks and parameters that have not changed by a single bit."""
    before, after = ({**t.networks, **t.modifiers} for t in (start, end))
    return [
        name
        for name, tree in before.items()
        if all(map(np.array_equal, jax.tree.leaves(tree), jax.tree.leaves(after[name])))
    ]
