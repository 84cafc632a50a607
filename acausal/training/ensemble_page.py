"""The page about an ensemble: what its members agree on."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from acausal.reporting import Page, plot_band, plot_losses
from acausal.training.page import AFTER, MEASURED, WIDE, figure, laws, stretch
from acausal.training.uncertainty.confidence import Band

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from acausal.training.ensemble import Ensemble


def write_ensemble_page(ensemble: Ensemble, path: Path, title: str) -> Path:
    """Write the page about an ensemble; returns its path."""
    fits, best = ensemble.fits, ensemble.best
    trained = ", ".join((*best.seen, *best.modifiers))
    page = Page(
        title,
        f"{trained} trained {len(fits)} times on {len(best.problem.record)} samples of "
        f"{', '.join(best.problem.targets)} in {best.seconds:.3g} s.",
    )
    rows = [
        (k, f"{fit.loss_before:.4g}", f"{fit.loss:.4g}", f"{fit.score:.4g}")
        for k, fit in enumerate(fits)
    ]
    page.table(("member", "loss before", "after", "of what decides"), rows)
    histories = {f"member {k}": fit.history for k, fit in enumerate(fits)}
    page.figure(
        figure(WIDE, plot_losses, histories),
        "The losses, update by update: of the batches (thin) and over the whole record.",
    )
    _predictions(page, ensemble)
    laws(page, best, ensemble.laws)
    if ensemble.modifiers:
        page.section("Trained parameters")
        changes = [
            (n, f"{mean:+.4g}", f"{sigma:.2g}") for n, (mean, sigma) in ensemble.modifiers.items()
        ]
        page.table(("parameter", "change", "standard deviation"), changes)
    return page.write(path)


def _predictions(page: Page, ensemble: Ensemble) -> None:
    page.section("Measured and simulated")
    best = ensemble.best
    measured = np.asarray(best.problem.record.y)
    for i, (name, band) in enumerate(ensemble.predicted.items()):
        rows = stretch(len(band.x))
        shown = Band(band.x[rows], band.law[rows], band.sigma[rows])

        def draw(
            ax: Axes, y: np.ndarray = measured[rows, i], shown: Band = shown, name: str = name
        ) -> None:
            ax.plot(shown.x, y, color=MEASURED, lw=1.6, alpha=0.5, label="measured")
            plot_band(ax, shown, color=AFTER, label="mean of the members")
            ax.set(xlabel="time [s]", ylabel=f"{name} [{best.system.unit(name)}]")
            ax.grid(alpha=0.25)
            ax.legend(frameon=False, ncols=2, loc="lower right", bbox_to_anchor=(1, 1))

        page.figure(figure(WIDE, draw), f"A stretch of '{name}', two standard deviations wide.")
