"""Sections of pages about trainings, from arrays with names and units: a page comes in, the section is added to it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from jaxtyping import Float

from acausal.reporting.drawing import new_figure
from acausal.reporting.html import Page
from acausal.reporting.plot import (
    InputStatistics,
    Losses,
    UncertainCurve,
    plot_band,
    plot_guides,
    plot_losses,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WIDE, NARROW = (9.0, 3.2), (6.0, 3.2)
"""Sizes of figures, in inches."""

MEASURED, AFTER, BEFORE = "#22303c", "#1f77b4", "#d1603d"
"""Colours of curves."""


class LearnedLaw(NamedTuple):
    """A learned law.

    Attributes:
        band: the law with its standard deviation.
        seen: statistics of the network's arguments.
        samples: some of the values that its first argument had.
        argument, result: names with units of the first argument and of the value.
        factor: by which the network's value was multiplied to give ``result``.
    """

    band: UncertainCurve
    seen: InputStatistics
    samples: Float[np.ndarray, " n_samples"]
    argument: str = "argument"
    result: str = ""
    factor: float = 1.0


def figure(size: tuple[float, float], draw: Callable[[Axes], None]) -> Figure:
    """A figure with one pair of axes."""
    drawn = new_figure(size)
    draw(drawn.subplots())
    return drawn


def add_losses(page: Page, histories: Mapping[str, Losses]) -> None:
    """The losses of trainings, by label."""
    page.figure(
        figure(WIDE, lambda ax: plot_losses(ax, histories)),
        "The losses, update by update: of the batches (thin) and over the whole record."
        if len(histories) > 1
        else "The loss, update by update: of the batches (thin) and over the whole record.",
    )


def add_laws(page: Page, laws: Mapping[str, LearnedLaw]) -> None:
    """Learned laws by network with their bands, over the arguments in training."""
    if not laws:
        return
    page.section("Learned laws")
    page.text(
        "The band is two standard deviations wide to either side. Dashed and solid lines mark one and two standard "
        "deviations of what the network has seen; in the shaded part it extrapolates. Ticks are samples."
    )
    for name, law in laws.items():

        def draw(ax: Axes, name: str = name, law: LearnedLaw = law) -> None:
            band, seen, samples = law[:3]
            plot_band(ax, band, color=AFTER)
            low, high = float(np.min(band.law)), float(np.max(band.law))
            room = 0.25 * (high - low) + 1e-12
            ax.set_ylim(low - room, high + room)
            plot_guides(ax, seen, band.x[0], band.x[-1])
            ax.plot(samples, np.full(len(samples), low - room), "|", color=MEASURED, alpha=0.25)
            ax.set(xlabel=law.argument, ylabel=law.result or name)

        page.figure(figure(NARROW, draw), f"The law of '{name}' and how sure it is.")


def add_parameters(
    page: Page, header: Sequence[str], rows: Sequence[Sequence[str]], remarks: Sequence[str] = ()
) -> None:
    """Trained parameters in a table, if there are any, and sentences about them and the laws."""
    if rows:
        page.section("Trained parameters")
        page.table(header, rows)
    for sentence in remarks:
        page.text(sentence)
