"""A small training that is interrupted in many ways; run as a program, it waits to be killed.

python -m tests.support.interrupted CHECKPOINT EPOCH_AT_WHICH_IT_WAITS [EPOCH_AT_WHICH_A_WRITING_NEVER_ENDS]
"""

import os
import signal
import sys
from pathlib import Path
from typing import Any

import optax

import acausal as ac
from tests.support.oscillator import learned, record

EPOCHS = (30, 20)

OPTIMIZER = optax.adam(0.01)  # one and the same, so that JAX compiles once


def train(**chosen: Any) -> ac.Fit:
    """Sequences, then L-BFGS over the whole record; a checkpoint whenever there is a chance."""
    defaults: dict[str, Any] = {
        "strategy": ("sequences", "whole_record"), "epochs": EPOCHS, "evaluate_every": 7,
        "sequence_length": 0.2, "batch_size": 3, "subsample": 0.5, "optimizer": OPTIMIZER,
        "modifiers": ["mass.m"], "regularizers": [ac.ZeroCrossing()],
        "checkpoint_every": 0.0, "progress": False,
    }  # fmt: skip
    return ac.fit(learned(), record(end=5.0), "mass.a", **(defaults | chosen))


def main(path: str, at: str, never: str = "-1") -> None:
    """Go on with the training; say how far it is after the checkpoint of an epoch, and wait."""
    replace = Path.replace

    def replace_or_die(part: Path, target: Path) -> Path:
        if done >= int(never) >= 0:
            os.kill(os.getpid(), signal.SIGKILL)
        return replace(part, target)

    done = 0
    Path.replace = replace_or_die  # type: ignore[method-assign]

    def say(progress: Any) -> None:
        nonlocal done
        done = progress.epoch
        if done >= int(at):
            print(done, flush=True)  # noqa: T201
            signal.pause()

    train(checkpoint=path, resume=True, observers=[say])


if __name__ == "__main__":
    main(*sys.argv[1:])
