"""The display of a training in a terminal or a notebook."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import contextmanager
from dataclasses import dataclass

from acausal.training.history import Divergence

SHOWN = 5
"""Divergences that are shown one by one; later ones are only counted."""


@dataclass(frozen=True)
class Progress:
    """How far a training is.

    Attributes:
        epoch, epochs: updates done, and planned.
        loss: of the last update's batch.
        best: the lowest loss over the whole record so far, or over what is held out.
        seconds: time since the start.
        seconds_per_epoch: of the latest updates.
        divergences: sequences that diverged since the last report.
    """

    epoch: int
    epochs: int
    loss: float
    best: float
    seconds: float
    seconds_per_epoch: float
    divergences: tuple[Divergence, ...]


Observer = Callable[[Progress], None]


@contextmanager
def display(show: bool, epochs: int) -> Generator[Observer]:
    """A live line with epoch, loss, rate and remaining time; nothing where there is no terminal."""
    from rich.console import Console

    console = Console(stderr=True)
    if not (show and (console.is_terminal or console.is_jupyter)):
        yield lambda progress: None
        return
    from rich.progress import (
        BarColumn,
        Progress as Bar,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    columns = (
        TextColumn("epoch {task.completed:>5.0f}/{task.total:.0f}"),
        BarColumn(),
        TextColumn("loss {task.fields[loss]}  best {task.fields[best]}  {task.fields[rate]}"),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
    )
    shown = 0
    with Bar(*columns, console=console) as bar:
        task = bar.add_task("train", total=epochs, loss="...", best="...", rate="compiling")

        def update(progress: Progress) -> None:
            nonlocal shown
            for divergence in progress.divergences[: max(SHOWN - shown, 0)]:
                bar.console.print(str(divergence), style="yellow")
            shown += len(progress.divergences)
            rate = progress.seconds_per_epoch
            bar.update(
                task,
                completed=progress.epoch,
                loss=f"{progress.loss:.4g}",
                best=f"{progress.best:.4g}",
                rate=f"{rate * 1e3:.3g} ms/epoch" if rate < 1 else f"{rate:.3g} s/epoch",
            )

        yield update
