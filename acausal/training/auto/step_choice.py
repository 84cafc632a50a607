"""The method and length of steps, by measurement: their error stays below a tenth of what the noise leaves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from acausal.data import Data
from acausal.simulation import for_fixed_steps, solver_named
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable
from acausal.training.options import FitOptions

ORDER = {"heun": 2, "rk4": 4, "kvaerno3": 3}
MANY = 10_000
"""Rows from which on a method of second order is tried, which takes half of the time."""

SHARE, LEAST = 0.1, 1e-3
"""The largest error, relative to the noise; and the least noise, relative to the targets, that is reckoned with."""

FINEST = 32
"""Steps between two samples at most."""


class StepChoice(NamedTuple):
    """How a training integrates.

    Attributes:
        solver: its name; ``None`` where the user has chosen.
        parts: steps from sample to sample.
        error: of the steps, relative to the targets' deviation; NaN where it was not measured.
    """

    solver: str | None
    parts: int = 1
    error: float = float("nan")

    def of(self, options: FitOptions, data: Mapping[str, Data]) -> FitOptions:
        """The options with these steps."""
        if self.solver is None:
            return options
        dt = options.dt if self.parts == 1 else _sample_time(data) / self.parts
        return replace(options, solver=self.solver, dt=dt)


def _sample_time(data: Mapping[str, Data]) -> float:
    return float(np.median(np.concatenate([np.diff(d.time) for d in data.values()])))


def tried_steps(options: FitOptions) -> Iterator[StepChoice]:
    """The steps with which a start is sought, until one explains something."""
    given = (options.solver, options.rtol, options.atol)
    if any(value is not None for value in given):
        yield StepChoice(None)
        return
    yield StepChoice("rk4")
    if options.dt is None:
        yield StepChoice("kvaerno3")


def chosen_steps(
    step: StepChoice,
    problem: Problem,
    trainable: Trainable,
    noise: float | None,
    options: FitOptions,
) -> StepChoice:
    """The steps whose error is small enough, for some state of the training."""
    if step.solver is None or options.dt is not None or not isinstance(problem.substeps, int):
        return step
    allowed = SHARE * max(noise or 0.0, LEAST)
    coarse = np.asarray(problem.simulate(trainable).y)
    fine = np.asarray(replace(problem, substeps=2 * problem.substeps).simulate(trainable).y)
    error = difference(problem, coarse, fine)
    if not np.isfinite(error):
        return step
    order = ORDER[step.solver]
    if error > allowed:
        parts = int(np.ceil((error / allowed) ** (1 / order)))
        parts = min(1 << (parts - 1).bit_length(), FINEST)
        return StepChoice(step.solver, parts, error / parts**order)
    if len(problem.records) >= MANY // 4 and step.solver == "rk4" and options.dt is None:
        heun = for_fixed_steps(solver_named("heun", fixed=False), problem.dtype)
        rough = difference(
            problem, np.asarray(replace(problem, solver=heun).simulate(trainable).y), fine
        )
        if rough <= allowed:
            return StepChoice("heun", 1, rough)
    return step._replace(error=error)


def finer_steps(
    options: FitOptions, data: Mapping[str, Data], error: float, loss: float
) -> FitOptions | None:
    """The options with finer steps, where those of a training err by more than they may; else ``None``.

    A law is often steeper than the linear one along which steps were chosen. Where very many were needed, they are
    implicit.

    Arguments:
        options: with the steps that were chosen. error: of these at the end of the training. loss: that it reached.
    """
    allowed = SHARE * max(loss, LEAST)
    solver = str(options.solver)
    if solver not in ORDER or not allowed < error < np.inf:
        return None
    usual = _sample_time(data)
    parts = 1 if options.dt is None else round(usual / options.dt)
    more = 2 * (error / allowed) ** (1 / ORDER[solver])
    finer = parts * (1 << (int(np.ceil(more)) - 1).bit_length())
    implicit = finer > FINEST
    better = "kvaerno3" if implicit else "rk4" if solver == "heun" else solver
    return replace(options, solver=better, dt=usual / (parts if implicit else finer))


def difference(problem: Problem, one: np.ndarray, other: np.ndarray) -> float:
    """The root mean square difference of predictions, as the loss counts it."""
    counts = np.asarray(problem.records.weight) > 0
    squares = np.where(counts, (one - other) / np.asarray(problem.records.sigma), 0.0) ** 2
    return float(np.sqrt(np.sum(squares.sum(axis=0) / np.maximum(counts.sum(axis=0), 1))))
