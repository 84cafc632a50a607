"""The page about a training: what was learned, how sure it is, and what is left over."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from acausal.reporting import Page, plot_band, plot_guides, plot_losses
from acausal.training.uncertainty.confidence import Band, Confidence
from acausal.training.uncertainty.residuals import Residuals

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from acausal.training.result import Fit

WIDE, NARROW = (9.0, 3.2), (6.0, 3.2)
"""Sizes of figures, in inches."""

MEASURED, AFTER, BEFORE, GUIDE = "#22303c", "#1f77b4", "#d1603d", "#8795a1"
STRETCH = 2000
"""Samples of the record that are shown closely."""

SHOWN = 50
"""Divergences that are listed."""


def write_page(fit: Fit, path: Path, title: str) -> Path:
    """Write the page about a training; returns its path."""
    page = Page(title, _summary(fit))
    losses = ("loss over the record", f"{fit.loss_before:.4g}", f"{fit.loss:.4g}")
    kept = fit.history.validation_loss[:1, 1]
    held = [("loss over what is held out", f"{b:.4g}", f"{fit.validation_loss:.4g}") for b in kept]
    page.table(("figure", "before", "after"), [losses, *held])
    page.figure(
        figure(WIDE, plot_losses, {"whole record": fit.history}),
        "The loss, update by update: of the batches (thin) and over the whole record.",
    )
    _trajectories(page, fit)
    if np.isfinite(fit.loss):
        _findings(page, fit)
    else:
        page.text(
            "The trained model diverges over the record; nothing can be said of what it has learned."
        )
    if fit.history.divergences:
        page.section("What diverged")
        page.text(f"{len(fit.history.divergences)} times; the first {SHOWN} at most:")
        page.table(("epoch", "what"), [(d.epoch, str(d)) for d in fit.history.divergences[:SHOWN]])
    return page.write(path)


def _findings(page: Page, fit: Fit) -> None:
    sure = fit.confidence()
    laws(page, fit, sure.laws)
    if fit.modifiers:
        _parameters(page, fit, sure)
    for sentence in sure.words():
        page.text(sentence)
    _leftovers(page, fit.residuals())


def _summary(fit: Fit) -> str:
    trained = ", ".join((*fit.seen, *fit.modifiers))
    end = ", ended by the user" if fit.interrupted else ""
    return (
        f"{trained} trained on {len(fit.problem.record)} samples of "
        f"{', '.join(fit.problem.targets)} in {fit.seconds:.3g} s, {fit.history.epochs} updates{end}."
    )


def figure(size: tuple[float, float], draw: Any, *what: Any) -> Figure:
    """A figure with one pair of axes, drawn by ``draw(axes, *what)``."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, layout="constrained")
    draw(figure.subplots(), *what)
    return figure


def stretch(samples: int) -> slice:
    """The rows in the middle of a record that are shown closely."""
    middle = samples // 2
    return slice(max(0, middle - STRETCH // 2), middle + STRETCH // 2)


def _trajectories(page: Page, fit: Fit) -> None:
    page.section("Measured and simulated")
    record = fit.problem.record
    t, y, before = np.asarray(record.steps.t), np.asarray(record.y), fit.predicted_before
    rows = stretch(len(t))
    low, high = y[rows].min(axis=0), y[rows].max(axis=0)
    room = 0.5 * (high - low) + 1e-12
    for i, name in enumerate(fit.problem.targets):

        def draw(ax: Axes, i: int = i, name: str = name) -> None:
            curves = {
                "measured": (y, MEASURED, 1.6, 0.5),
                "before training": (before, BEFORE, 0.9, 0.9),
                "after training": (fit.predicted, AFTER, 1.1, 1.0),
            }
            for label, (values, color, width, alpha) in curves.items():
                near = np.clip(values[rows, i], low[i] - 2 * room[i], high[i] + 2 * room[i])
                ax.plot(t[rows], near, color=color, lw=width, alpha=alpha, label=label)
            bottom, top = ax.get_ylim()
            ax.set_ylim(max(bottom, low[i] - room[i]), min(top, high[i] + room[i]))
            ax.set(xlabel="time [s]", ylabel=f"{name} [{fit.system.unit(name)}]")
            ax.grid(alpha=0.25)
            ax.legend(frameon=False, ncols=3, loc="lower right", bbox_to_anchor=(1, 1))

        page.figure(figure(WIDE, draw), f"A stretch of '{name}'.")


def laws(page: Page, fit: Fit, bands: Mapping[str, Band]) -> None:
    """Show learned laws by network with their bands, over what the networks have seen."""
    if not bands:
        return
    page.section("Learned laws")
    page.text(
        "The band is two standard deviations wide to either side. Dashed and solid lines mark one and two standard "
        "deviations of what the network has seen; in the shaded part it extrapolates. Ticks are samples."
    )
    for name, band in bands.items():

        def draw(ax: Axes, name: str = name, band: Band = band) -> None:
            plot_band(ax, band, color=AFTER)
            low, high = float(np.min(band.law)), float(np.max(band.law))
            room = 0.25 * (high - low) + 1e-12
            ax.set_ylim(low - room, high + room)
            plot_guides(ax, fit.seen[name], band.x[0], band.x[-1])
            samples = fit.samples(name)
            ax.plot(samples, np.full(len(samples), low - room), "|", color=MEASURED, alpha=0.25)
            ax.set(xlabel="argument", ylabel=name)

        page.figure(figure(NARROW, draw), f"The law of '{name}' and how sure it is.")


def _parameters(page: Page, fit: Fit, sure: Confidence) -> None:
    page.section("Trained parameters")
    told, units = fit.problem.modifiers.told, {n: fit.system.unit(n) for n in fit.modifiers}
    rows = [
        (n, f"{float(fit.params[n]):.6g} {units[n]}".removesuffix(" 1"),
         told(n, change, "+.3g", units[n]), told(n, sure.parameters[n], ".2g", units[n]))
        for n, change in fit.modifiers.items()
    ]  # fmt: skip
    page.table(("parameter", "value", "change", "one sigma"), rows)


def _leftovers(page: Page, found: tuple[Residuals, ...]) -> None:
    page.section("What is left over")
    for residuals in found:
        page.text(residuals.words())
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
