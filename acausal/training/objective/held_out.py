"""Held-out samples: they are never trained on, but show how well the model predicts."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from numbers import Real
from typing import Any, NamedTuple, TypeAlias, cast

import jax.numpy as jnp
import numpy as np

from acausal._jax import is_number
from acausal.data import Data, RecordsLike, records_of
from acausal.errors import DataError, known_name, listing, shown, warn
from acausal.training.objective.initial_state import InitialState, first_states
from acausal.training.objective.lay_out import lay_out, sample_time
from acausal.training.objective.problem import Problem
from acausal.training.objective.sequences import whole_records
from acausal.training.objective.start_modes import with_start_modes

Validation: TypeAlias = "float | str | Sequence[str] | RecordsLike | None"
"""What to hold out: the last part of every record, some of the records by name, other records, or nothing."""


class Split(NamedTuple):
    """Records to train on, and records with the held-out samples.

    Attributes:
        training: by name.
        held: by name; ``None`` without any.
        ends: by name, where the part to train on ends in ``held``; empty where all of ``held`` is held out.
    """

    training: dict[str, Data]
    held: dict[str, Data] | None
    ends: dict[str, float]


def split(data: dict[str, Data], validation: Validation) -> Split:
    """What to train on and what to hold out.

    Raises:
        DataError: for a fraction that leaves fewer than two samples for either, a name that is not a record, or if
            nothing is left to train on.
    """
    if validation is None:
        return Split(data, None, {})
    if isinstance(validation, float | int | Real):
        return _shared(data, validation)
    if names := named_records(validation, data):
        training = {n: d for n, d in data.items() if n not in names}
        return Split(training, {n: data[n] for n in names}, {})
    held = records_of(cast(RecordsLike, validation))
    for name, record in held.items():
        if same := next((n for n, d in data.items() if _are_alike(d, record)), None):
            warn(
                f"validation: '{name}' is the training's own record '{same}', which cannot show how well the model "
                "predicts: hold out another record, or a part of it, such as validation=0.2."
            )
    return Split(data, held, {})


def _are_alike(one: Data, other: Data) -> bool:
    """Whether two records have the same samples of the signals that both have."""
    shared = one.signals.keys() & other.signals.keys()
    return np.array_equal(one.time, other.time) and all(
        np.array_equal(one[n], other[n], equal_nan=True) for n in shared
    )


def named_records(validation: Validation, known: Collection[str]) -> tuple[str, ...]:
    """The records to hold out that are chosen by name, of those that are known; empty for another choice.

    Raises:
        DataError: for an empty list, a name that is not a record, or if nothing is left to train on.
    """
    chosen = [validation] if isinstance(validation, str) else validation
    if not isinstance(chosen, list | tuple) or not all(isinstance(n, str) for n in chosen):
        return ()
    if not chosen:
        raise DataError("validation=[] names nothing to hold out: leave it out, or name some.")
    names = tuple(
        known_name(name, known, "validation: there is no record")
        for name in cast(Sequence[str], chosen)
    )
    if len(set(names)) == len(known):
        raise DataError(f"validation={listing(names)} leaves no record to train on.")
    return names


def _shared(data: dict[str, Data], share: Any) -> Split:
    """The last part of every record is held out."""
    if not is_number(share):
        raise DataError(
            f"validation={shown(share)} is not a fraction; give a number between 0 and 1."
        )
    share, training, ends = float(share), {}, {}
    for name, record in data.items():
        first = len(record) - round(share * len(record))
        if not 2 <= first <= len(record) - 2:
            raise DataError(
                f"validation={share:g} of {len(record)} samples leaves {first} to train on; "
                "give a fraction between 0 and 1, or another record."
            )
        ends[name] = float(record.time[first - 1])
        training[name] = record.between(record.time[0], ends[name])
    return Split(training, data, ends)


def hold_out(problem: Problem, split: Split, x0: InitialState) -> Problem | None:
    """A problem in whose records only the held-out samples count, from the result of `split`.

    They decide which state of a training is best.

    The ends of records are predicted in one simulation from the records' starts. Other records start as ``x0`` says;
    where that is trained, from their own measured states.

    Raises:
        DataError: if the records lack signals for that.
    """
    if split.held is None:
        return None
    if not split.ends:
        held = {n: d.for_system(problem.system) for n, d in split.held.items()}
        choice = of_others(x0, held)
        other = over(problem, held, choice)
        return with_start_modes(other, other.over_other_records(problem.start()), held, choice)
    other = over(problem, split.held, "model")
    records = other.records
    ends = jnp.asarray(list(split.ends.values()))[records.of]
    weight = jnp.where((records.steps.t > ends)[:, None], records.weight, 0.0)
    return replace(
        other,
        records=replace(records, weight=weight, known=True),
        first_states=problem.first_states,
        start_prior=problem.start_prior,
        shooting=problem.shooting,
    )


def of_others(x0: InitialState, records: Mapping[str, Data]) -> InitialState:
    """The choice for held-out records; as for trained ones where nothing is said of them."""
    if isinstance(x0, str) or not any(isinstance(v, str | Mapping) for v in x0.values()):
        return x0
    chosen: Mapping[str, Any] = x0
    return {n: chosen.get(n, "fit") for n in records}


def over(
    problem: Problem, data: Mapping[str, Data], x0: InitialState, *, measured: bool = True
) -> Problem:
    """The same model over other records, in its units, with steps that are no longer.

    Errors stay relative to the standard deviations of the training's data. ``x0`` says where records start,
    ``measured`` whether the data need samples of every target.
    """
    system = problem.system
    starts = first_states(system, data, x0, trained=False)
    records, substeps = lay_out(
        system,
        data,
        problem.targets,
        problem.longest_step,
        problem.solver,
        problem.timing,
        states=False,
        measured=measured,
        even=sample_time(data.values()),
    )
    records = problem.weighting.apply(records)
    other = replace(
        problem,
        records=replace(
            records, sigma=problem.records.sigma, scale=problem.records.scale, known=False
        ),
        sequences=whole_records(records),
        first_states=starts,
        start_prior=None,
        shooting=None,
        substeps=substeps,
        mesh=None,
    )
    other.check_rest()
    return other
