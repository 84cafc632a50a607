"""Held-out samples: they are never trained on, but show how well the model predicts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from numbers import Real

import equinox as eqx
import numpy as np
from jaxtyping import Array, Float
from numpy.typing import ArrayLike

from acausal.data import Data
from acausal.errors import DataError
from acausal.training.objective.initial_state import InitialState, first_state
from acausal.training.objective.problem import Problem
from acausal.training.objective.record import Sequences, lay_out
from acausal.training.objective.trainable import Trainable

Validation = float | Data | Mapping[str, ArrayLike] | None
"""What to hold out: the last part of the record, another record, or nothing."""


class HeldOut(eqx.Module):
    """The held-out samples of a training.

    Attributes:
        problem: a record that ends with the held-out samples; the simulation runs through the samples before them.
        first: index of the first of them.
    """

    problem: Problem
    first: int = eqx.field(static=True)

    def loss(self, trainable: Trainable) -> Float[Array, ""]:
        """The loss over the held-out samples, in one simulation of their record."""
        predicted = self.problem.simulate(trainable).y
        return self.problem.compare(predicted, slice(self.first, None))


def split(data: Data, validation: Validation) -> tuple[Data, tuple[Data, int] | None]:
    """The record to train on; and the record that ends with the held-out samples, with the index of their first.

    Raises:
        DataError: for a fraction that leaves fewer than two samples for either.
    """
    if validation is None:
        return data, None
    if not isinstance(validation, float | int | Real):
        return data, (Data.of(validation), 0)
    share = float(validation)
    if not np.isfinite(share):
        raise DataError(f"validation={share} is not a fraction; give a number between 0 and 1.")
    first = len(data) - round(share * len(data))
    if not 2 <= first <= len(data) - 2:
        raise DataError(
            f"validation={share:g} of {len(data)} samples leaves {first} to train on; "
            "give a fraction between 0 and 1, or another record."
        )
    return data.between(data.time[0], data.time[first - 1]), (data, first)


def hold_out(problem: Problem, kept: tuple[Data, int] | None, x0: InitialState) -> HeldOut | None:
    """The held-out samples that decide which state of a training is best, from the result of `split`.

    The end of the record is predicted in one simulation from the record's start. Another record starts as ``x0``
    says; where that is trained, from its own measured states.

    Raises:
        DataError: if the record lacks signals for that.
    """
    if kept is None:
        return None
    data, first = kept
    if first:
        other = over(problem, data, problem.x0)
        return HeldOut(replace(other, shooting=problem.shooting), first)
    data = data.for_system(problem.system)
    start = first_state(problem.system, data, "data" if x0 == "fit" else x0)
    return HeldOut(over(problem, data, start), first)


def over(problem: Problem, data: Data, x0: Float[Array, " n_states"] | None) -> Problem:
    """The same model over another record as one sequence, with steps that are no longer.

    Arguments:
        problem: the training. Errors stay relative to the standard deviations of its data.
        data: the other record, in the model's units.
        x0: the state at its start; ``None`` for the model's start values.
    """
    record = lay_out(data, problem.system.inputs, problem.targets, None)
    longest = float(np.max(np.asarray(record.steps.h)))
    return replace(
        problem,
        records=(replace(record, sigma=problem.sigma),),
        sequences=Sequences(len(record), len(record), 1, None),
        x0=x0,
        shooting=None,
        substeps=max(1, int(np.ceil(longest / problem.longest_step - 1e-6))),
        mesh=None,
    )
