"""The progress of a training in a notebook: one output that is written anew, without widgets."""

from __future__ import annotations

import html
import sys
import time
from collections.abc import Callable
from typing import Any

from acausal.errors import cut_short
from acausal.training.reported import SHOWN, Progress, rate_of

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
