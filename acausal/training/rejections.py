"""Rejected updates: when there are too many, a training ends with what is wrong and what helps."""

from __future__ import annotations

import numpy as np

from acausal.networks import output_scale
from acausal.simulation import Adaptive
from acausal.training.history import TrainingLog
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable

SHORTER_STEPS = (
    "Its steps are too long for the solver to be stable: "
    "take a smaller dt, an implicit solver (solver='kvaerno3'), or shorter sequences."
)
"""What helps where gradients explode."""

REJECTIONS = 50
"""A training ends after this many rejected updates in a row."""

RUN_AWAY = 1e3
"""A state has run away where it is larger than this many times its typical magnitude."""

MOST = 4
"""Networks whose scales a message tells."""


def too_many(log: TrainingLog, rejected: int, problem: Problem, tried: Trainable) -> str | None:
    """A sentence on updates that were rejected in a row, if there are too many of them; ``tried`` was the last one."""
    if rejected < REJECTIONS:
        return None
    first = log.epochs - rejected
    sequences = [d for d in log.divergences if d.epoch >= first and d.count]
    if sequences:
        what = f"the sequence from {sequences[0].place} diverges {_tried(problem)}"
        mend = (
            f"{_scales(problem)} Or start from better parameters (params=...), take shorter sequences "
            "(sequence_length=...), or a smaller dt."
        )
        if sequences[0].exploded:
            what = (
                f"the gradient of the sequence from {sequences[0].place} explodes {_tried(problem)}"
            )
            mend = SHORTER_STEPS
        if (clause := runaway(problem, tried)) is not None:
            what += f", and {clause}"
    else:
        what = "the gradient is not finite"
        mend = "Lower the optimizer's rate, or clip the gradient."
    return (
        f"{rejected} updates in a row were rejected from epoch {first} on: {what}. {mend.lstrip()}"
    )


def runaway(problem: Problem, tried: Trainable) -> str | None:
    """A clause on the first state that runs away in a simulation of the records, or None."""
    system, records = problem.system, problem.records
    x = np.asarray(problem.simulate(tried).x)
    known = [x[np.asarray(records.first)], *([] if records.x is None else [records.x])]
    sizes = [np.nan_to_num(np.abs(np.asarray(a))).max(axis=0) for a in known]
    typical = np.max([system.nominal, *sizes], axis=0)
    with np.errstate(invalid="ignore"):
        good = np.abs(x) < RUN_AWAY * typical
    if good.all():
        return None
    row = int(np.argmin(good.all(axis=1)))
    i = int(np.argmin(good[row]))
    name, value, unit = system.states[i], float(x[row, i]), system.unit(system.states[i])
    t, record = float(np.asarray(records.steps.t)[row]), int(np.asarray(records.of)[row])
    of = f" of '{records.names[record]}'" if records.count > 1 else ""
    far = f"runs away to {value:.3g} {unit}".rstrip() if np.isfinite(value) else "is not finite"
    return f"'{name}' {far} at t = {t:g} s{of}"


def _tried(problem: Problem) -> str:
    """The steps that were taken, in words."""
    solver = problem.solver
    if isinstance(solver, Adaptive):
        return f"in adaptive steps (rtol={solver.rtol:g})"
    return f"in steps of {problem.longest_step:.3g} s by {type(solver).__name__}"


def _scales(problem: Problem) -> str:
    """What to do about the scales of networks, which are a common cause; nothing without networks."""
    if not problem.networks:
        return ""
    nets = [(n, problem.params[n]) for n in problem.networks]
    present = ", ".join(
        f"{_written(getattr(net, 'input_scale', 1.0))} and {output_scale(net):g} of '{n}'"
        for n, net in nets[:MOST]
    )
    return (
        "Give networks the typical sizes of their arguments and results, input_scale= and output_scale=, which are "
        f"now {present}."
    )


def _written(scale: object) -> str:
    return f"{scale:g}" if isinstance(scale, float | int) else str(scale)
