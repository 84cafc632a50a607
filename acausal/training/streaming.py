"""A stream as the data of a training: what needs whole records is refused, and every record is read once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from acausal.data import Data, Stream
from acausal.errors import TrainingError
from acausal.training.objective.held_out import named_records
from acausal.training.objective.streamed import Streamed, survey
from acausal.training.options import FitOptions

if TYPE_CHECKING:
    from acausal.system import System


def need_one_training(data: object, options: FitOptions, trainings: int) -> None:
    """Refuse several trainings of a stream in one program.

    Raises:
        TrainingError: for them.
    """
    if isinstance(data, Stream) and trainings > 1 and options.executor is None:
        raise TrainingError(
            "Several trainings in one program share their sequences in memory, which a stream has not: give "
            "executor=, so that each is trained on a worker."
        )


def look_at(
    system: System, stream: Stream, targets: Sequence[str], options: FitOptions
) -> tuple[dict[str, Data], FitOptions, Streamed]:
    """The beginnings of the records to train on, the options with held-out records in memory, and all else.

    Raises:
        DataError: for a record that cannot be trained on.
        TrainingError: for an option that needs whole records.
    """
    needs = _needs_whole_records(system, options)
    if needs is not None:
        raise TrainingError(
            f"{needs} needs whole records in memory, but a stream is trained with strategy='sequences' alone: give "
            "some of the records, such as [stream['run 7']], or dict(stream) to read all."
        )
    if names := named_records(options.validation, stream.sources):
        options = replace(options, validation={name: stream[name] for name in names})
    records, streamed = survey(system, stream.without(names), targets, options.dtype)
    if options.dt is not None and streamed.even is None:
        raise TrainingError(
            f"dt={options.dt:g} s divides the samples of records whose samples are evenly spaced, all alike; those "
            "of the stream are not: leave dt out, or resample them."
        )
    return records, options, streamed


def _needs_whole_records(system: System, options: FitOptions) -> str | None:
    """What is asked for that needs whole records, in words for a message."""
    others = [part for part in options.parts if part != "sequences"]
    if others:
        return f"strategy='{others[0]}'"
    if options.sequence_length is None:
        return "sequence_length=None"
    if options.delays or options.lags:
        return "delays=" if options.delays else "lags="
    if options.record_weights != "samples" or options.sample_weights:
        return "sample_weights=" if options.sample_weights else "record_weights="
    if isinstance(options.validation, float | int):
        return "validation= of a part"
    starts = [options.x0] if isinstance(options.x0, str) else list(options.x0.values())
    if "fit" in starts:
        return "x0='fit'"
    if not system.reduced.exact.all():
        return "a mechanism with closed loops"
    return None
