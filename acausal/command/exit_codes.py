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


KINDS: dict[type[BaseException], tuple[int, str]] = {
    UsageError: (USAGE, "usage"),
    KeyboardInterrupt: (INTERRUPTED, "interrupted"),
    ModelError: (3, "model"),
    DataError: (4, "data"),
    SimulationError: (5, "simulation"),
    TrainingError: (6, "training"),
    ExportError: (7, "export"),
    AcausalError: (8, "installation"),
}
"""Code and kind of each class of errors."""

EXIT_CODES = {
    0: "done",
    1: "an unexpected error, with a traceback: please report it",
    USAGE: "the command was typed wrongly",
    3: "the model is wrong, or has no consistent start",
    4: "data, inputs, parameters or a file do not fit",
    5: "a simulation did not reach its end",
    6: "a training could not start or go on",
    7: "the model cannot be written in this form",
    8: "something is missing, such as a package of an extra",
    INTERRUPTED: "interrupted by Ctrl-C",
}
"""What each exit code means."""


def kind_of(error: BaseException) -> tuple[int, str]:
    """The exit code and the kind of an error."""
    return next(found for cls, found in KINDS.items() if isinstance(error, cls))
