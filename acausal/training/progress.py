"""The progress of a training: what it reports, and its display in a terminal or a notebook."""

from __future__ import annotations

import html
import sys
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

from acausal.errors import cut_short
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
        events: how many happen in all records; ``None`` for a model without.
    """

    epoch: int
    epochs: int
    loss: float
    best: float
    seconds: float
    seconds_per_epoch: float
    divergences: tuple[Divergence, ...]
    events: int | None = None


def rate_of(progress: Progress) -> str:
    """The time of an update, in words."""
    seconds = progress.seconds_per_epoch
    return f"{seconds * 1e3:.3g} ms/epoch" if seconds < 1 else f"{seconds:.3g} s/epoch"


Observer = Callable[[Progress], None]


def after(observe: Observer, epochs: int, seconds: float) -> Observer:
    """An observer of a training that goes on after so many updates of another one, and its time."""

    def told(p: Progress) -> None:
        done, planned, time = epochs + p.epoch, epochs + p.epochs, seconds + p.seconds
        observe(replace(p, epoch=done, epochs=planned, seconds=time))

    return told


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
    with Bar(*columns, console=console) as live:
        task = live.add_task(
            "train", total=epochs, loss="...", best="...", rate="compiling", events=""
        )

        def update(progress: Progress) -> None:
            nonlocal shown
            for divergence in progress.divergences[: max(SHOWN - shown, 0)]:
                live.console.print(str(divergence), style="yellow")
            shown += len(progress.divergences)
            live.update(
                task,
                completed=progress.epoch,
                loss=f"{progress.loss:.4g}",
                best=f"{progress.best:.4g}",
                events="" if progress.events is None else f"  {progress.events} events",
                rate=rate_of(progress),
            )

        yield update


EVERY = 0.2
"""Seconds between two updates of the output."""


def in_notebook() -> bool:
    """Whether cells show HTML: in Jupyter, VS Code and the like, but not in a terminal."""
    ipython: Any = sys.modules.get("IPython")
    shell: Any = None if ipython is None else ipython.get_ipython()
    return shell is not None and getattr(shell, "kernel", None) is not None


class NotebookDisplay:
    """A bar with epoch, losses, rate and the time that is left.

    Arguments:
        epochs: that are planned.
        clock: seconds, for tests.
    """

    def __init__(self, epochs: int, clock: Callable[[], float] = time.monotonic) -> None:
        from IPython.display import HTML, display

        self._html, self._clock = HTML, clock
        self._epochs, self._shown_at = epochs, clock()
        self._last: Progress | None = None
        self._divergences: list[str] = []
        self._handle: Any = display(HTML(bar(0, epochs, "compiling ...")), display_id=True)

    def update(self, progress: Progress) -> None:
        """Show how far the training is, unless that was done a moment ago."""
        self._last = progress
        self._divergences += map(str, progress.divergences)
        if self._clock() - self._shown_at >= EVERY:
            self._show(progress, done=False)

    def close(self) -> None:
        """Show the last report."""
        if self._last is not None:
            self._show(self._last, done=True)

    def _show(self, progress: Progress, *, done: bool) -> None:
        self._shown_at = self._clock()
        self._handle.update(
            self._html(bar(progress.epoch, self._epochs, words(progress, done), self._divergences))
        )


def words(progress: Progress, done: bool) -> str:
    """A report as a line of text."""
    left = (progress.epochs - progress.epoch) * progress.seconds_per_epoch
    parts = [
        f"loss {progress.loss:.4g}",
        f"best {progress.best:.4g}",
        rate_of(progress),
        *([] if progress.events is None else [f"{progress.events} events"]),
        f"{_clock_time(progress.seconds)} so far" if not done else _clock_time(progress.seconds),
        *([] if done else [f"{_clock_time(left)} left"]),
    ]
    return ", ".join(parts)


def bar(epoch: int, epochs: int, text: str, divergences: list[str] | None = None) -> str:
    """HTML of a bar with a line of text; below it the first divergences."""
    lines = cut_short(divergences or [], SHOWN, html.escape)
    below = f'<div style="opacity:.75">{"<br>".join(lines)}</div>' if lines else ""
    return (
        '<div style="font:13px system-ui,sans-serif;font-variant-numeric:tabular-nums">'
        f'<progress value="{epoch}" max="{max(epochs, 1)}" style="width:16em;vertical-align:middle"></progress> '
        f"epoch {epoch}/{epochs}, {html.escape(text)}{below}</div>"
    )


def _clock_time(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
