"""The display of a training in a terminal or a notebook."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import contextmanager

from acausal.training.notebook_display import NotebookDisplay, in_notebook
from acausal.training.reported import SHOWN, Progress as Progress, rate_of

Observer = Callable[[Progress], None]


@contextmanager
def display(show: bool, epochs: int) -> Generator[Observer]:
    """A live line with epoch, loss, rate and remaining time; nothing where there is neither terminal nor notebook."""
    from rich.console import Console

    if show and in_notebook():
        shown_there = NotebookDisplay(epochs)
        try:
            yield shown_there.update
        finally:
            shown_there.close()
        return
    console = Console(stderr=True)
    if not (show and console.is_terminal):
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
        TextColumn(
            "loss {task.fields[loss]}  best {task.fields[best]}  {task.fields[rate]}{task.fields[events]}"
        ),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
    )
    shown = 0
    with Bar(*columns, console=console) as bar:
        task = bar.add_task(
            "train", total=epochs, loss="...", best="...", rate="compiling", events=""
        )

        def update(progress: Progress) -> None:
            nonlocal shown
            for divergence in progress.divergences[: max(SHOWN - shown, 0)]:
                bar.console.print(str(divergence), style="yellow")
            shown += len(progress.divergences)
            bar.update(
                task,
                completed=progress.epoch,
                loss=f"{progress.loss:.4g}",
                best=f"{progress.best:.4g}",
                events="" if progress.events is None else f"  {progress.events} events",
                rate=rate_of(progress),
            )

        yield update
