"""Sections of pages about trainings, from arrays with names and units: a page comes in, the section is added to it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple, Protocol

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

DIVERGENCES_SHOWN = 50
"""Divergences that are listed."""


class LearnedLaw(NamedTuple):
    """A learned law.

    Attributes:
        band: the law with its standard deviation.
        seen: statistics of the network's arguments.
        samples: some of the values that its first argument had.
        argument, result: names with units of the first argument and of the value.
    """

    band: UncertainCurve
    seen: InputStatistics
    samples: Float[np.ndarray, " n_samples"]
    argument: str = "argument"
    result: str = ""


class Correlated(Protocol):
    """Correlations of a target's residuals, such as `Residuals`."""

    @property
    def target(self) -> str:
        """Its name."""
        ...

    @property
    def own(self) -> Float[np.ndarray, " lags"]:
        """The autocorrelation, from lag 1 on."""
        ...

    @property
    def bound(self) -> float:
        """The size of an autocorrelation that chance reaches."""
        ...

    @property
    def inputs(self) -> Mapping[str, Float[np.ndarray, " lags"]]:
        """By input, the correlation with it, about lag 0."""
        ...

    @property
    def bounds(self) -> Mapping[str, float]:
        """The same bounds by input."""
        ...

    def summary(self) -> str:
        """What the correlations mean, as a sentence."""
        ...


class DivergedUpdate(Protocol):
    """Something that diverged in an update; its text describes it."""

    @property
    def epoch(self) -> int:
        """The update."""
        ...


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


def add_residuals(page: Page, found: Sequence[Correlated]) -> None:
    """Correlations of residuals with themselves and with inputs, target by target."""
    page.section("Residuals")
    for residuals in found:
        page.text(residuals.summary())
        rows = {"itself": (residuals.own, residuals.bound)}
        rows |= {n: (c, residuals.bounds[n]) for n, c in residuals.inputs.items()}

        def draw(ax: Axes, rows: Mapping[str, tuple[np.ndarray, float]] = rows) -> None:
            for label, (values, bound) in rows.items():
                lags = np.arange(len(values)) + (1 if label == "itself" else -(len(values) // 2))
                (line,) = ax.plot(lags, values, lw=1.1, label=f"with {label}")
                for side in (-bound, bound):
                    ax.plot(lags[[0, -1]], [side, side], color=line.get_color(), lw=0.9, ls=":")
            ax.set(xlabel="lag [samples]", ylabel="correlation")
            ax.grid(alpha=0.25)
            ax.legend(frameon=False)

        page.figure(
            figure(WIDE, draw),
            f"Correlations of the residuals of '{residuals.target}'; dotted, what chance reaches.",
        )


def add_divergences(page: Page, divergences: Sequence[DivergedUpdate]) -> None:
    """The divergences of a training, if there are any."""
    if not divergences:
        return
    page.section("What diverged")
    page.text(f"{len(divergences)} times; the first {DIVERGENCES_SHOWN} at most:")
    rows = [(d.epoch, str(d)) for d in divergences[:DIVERGENCES_SHOWN]]
    page.table(("epoch", "what"), rows)
