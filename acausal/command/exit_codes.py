"""Exit codes: one for each kind of mistake, so that scripts can tell them apart."""

from __future__ import annotations

from acausal.errors import (
    AcausalError,
    DataError,
    ExportError,
    ModelError,
    SimulationError,
    TrainingError,
)

USAGE = 2
"""What argparse itself ends with."""
INTERRUPTED = 130
"""As shells count Ctrl-C."""
BROKEN_PIPE = 141
"""As shells count a reader that has gone, such as `head`."""


class UsageError(Exception):
    """Arguments that do not go together."""


KINDS: dict[type[BaseException], tuple[int, str, str]] = {
    UsageError: (USAGE, "usage", "the command was typed wrongly"),
    ModelError: (3, "model", "the model is wrong, or has no consistent start"),
    DataError: (4, "data", "data, inputs, parameters or a file do not fit"),
    SimulationError: (5, "simulation", "a simulation did not reach its end"),
    TrainingError: (6, "training", "a training could not start or go on"),
    ExportError: (7, "export", "the model cannot be written in this form"),
    AcausalError: (8, "installation", "something is missing, such as a package of an extra"),
    KeyboardInterrupt: (INTERRUPTED, "interrupted", "interrupted by Ctrl-C"),
}
"""Code, kind and meaning of each class of errors."""

EXIT_CODES = {
    0: "done",
    1: "an unexpected error, with a traceback: please report it",
    **{code: meaning for code, _, meaning in KINDS.values()},
}
"""What each exit code means."""


def kind_of(error: BaseException) -> tuple[int, str]:
    """The exit code and the kind of an error."""
    return next(found[:2] for cls, found in KINDS.items() if isinstance(error, cls))
