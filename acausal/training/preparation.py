"""Prepare trainings of a model on its records: check the options, choose what was left open, build the problem."""

from __future__ import annotations

import time
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from acausal._jax import need_double_precision, need_known
from acausal.data import Data, RecordsLike, Stream, records_of
from acausal.errors import DataError, TrainingError, need_whole, shown
from acausal.modeling import names_in
from acausal.simulation import is_bdf
from acausal.training.auto.automatic import Automatic, automatic
from acausal.training.build_problem import build_problem
from acausal.training.objective.folds import LeftOut, without
from acausal.training.objective.held_out import hold_out, split
from acausal.training.objective.initial_state import check_records
from acausal.training.objective.prior import entry
from acausal.training.objective.problem import Problem
from acausal.training.options import FitOptions
from acausal.training.strategy import Segment, segments, stages
from acausal.training.streaming import look_at

if TYPE_CHECKING:
    from acausal.system import System


@dataclass(frozen=True, eq=False)
class Training:
    """Trainings of one model on its records that are ready to run, in one program.

    Attributes:
        problem: what is trained; parameters that are not trained are those of the first start.
        records: to train on, by name, in the model's units.
        held: what is held out and chooses the best state, if anything is.
        segments: what to do, one part after the other.
        options: how to train.
        seeds: one for each training; ``params``: the parameters where each starts.
        automatic: what was chosen from the data, with ``strategy="auto"``.
        seconds: what preparing took.
        arguments: those of `prepare`, by name. What follows from them is made again by a process that receives a
            training, because optimizers are closures, which cannot be pickled.
    """

    problem: Problem
    records: dict[str, Data]
    held: Problem | None
    segments: tuple[Segment, ...]
    options: FitOptions
    seeds: Sequence[int]
    params: Sequence[Mapping[str, Any]]
    automatic: Automatic | None
    seconds: float
    arguments: Mapping[str, Any]

    def __reduce__(self) -> tuple[Any, ...]:
        """As the arguments that it was prepared from; options of the process that displays and writes stay there."""
        here = {"executor": None, "progress": False, "checkpoint": None, "resume": False}
        sent = replace(self.arguments["options"], **here)
        return _prepared, ({**self.arguments, "options": sent},)

    def without(self, part: LeftOut) -> Training:
        """The training of a fold; its program is that of the others, because its trainers are."""
        own = without(self.problem, part)
        return replace(self, problem=own, segments=tuple(s.over(own) for s in self.segments))


def prepare(
    system: System,
    data: RecordsLike | Stream,
    targets: str | Sequence[str],
    options: FitOptions,
    *,
    seeds: Sequence[int],
    params: Sequence[Mapping[str, Any] | None],
) -> Training:
    """Check what is to be trained, and build the problem.

    Arguments:
        system, data, targets: as of `acausal.fit`.
        options: the same for all.
        seeds: one for each training.
        params: by training, what differs from the parameters that the model has for its seed, or its prior knows.

    Raises:
        DataError, TrainingError: as `acausal.fit` does.
    """
    began = time.perf_counter()
    by_name = [v for v in vars(options).values() if isinstance(v, Mapping)]
    need_known("A training", params, by_name, error=TrainingError)
    for given in params:
        if not isinstance(given, Mapping | None):
            raise DataError(f"params={shown(given)} are not parameters; give a mapping by name.")
    for seed in seeds:
        need_whole(seed, "seed", TrainingError)
    need_double_precision()
    starts = [
        {**entry(system.parameters(seed), options.prior), **(given or {})}
        for seed, given in zip(seeds, params, strict=True)
    ]
    if not is_bdf(options.solver):
        system = system.watching()
    given = data if isinstance(data, Stream) else records_of(data)
    arguments: dict[str, Any] = {
        "system": system, "data": given, "targets": targets, "options": options, "seeds": seeds, "params": params
    }  # fmt: skip
    names, streamed = names_in(targets, "targets"), None
    if isinstance(given, Stream):
        records, options, streamed = look_at(system, given, names, options)
    else:
        records = {n: record.for_system(system) for n, record in given.items()}
    kept = split(records, options.validation)
    check_records(options.x0, (*records, *(kept.held or {})))
    from_data = None
    if options.automatic:
        with warnings.catch_warnings():  # the problem of the training warns again
            warnings.simplefilter("ignore")
            from_data = automatic(system, kept.training, names, starts, options)
        options, starts = from_data.options, list(from_data.params)
    problem = build_problem(system, kept.training, names, dict(starts[0]), options, streamed)
    held = hold_out(problem, kept, options.x0)
    planned = stages(options) if from_data is None else from_data.stages
    plan = segments(problem, planned, options)
    seconds = time.perf_counter() - began
    return Training(
        problem, kept.training, held, plan, options, seeds, starts, from_data, seconds, arguments
    )


def _prepared(arguments: Mapping[str, Any]) -> Training:
    """The same in a process that has received the arguments; the one that sent them has warned already."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return prepare(**arguments)
