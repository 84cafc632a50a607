"""The picture of work and precision."""

from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

if TYPE_CHECKING:
    from benchmarks.stiff.work_precision import Curves

STYLES = {
    "auto": {"color": "#c2410c", "marker": "o", "label": 'acausal, solver="auto"'},
    "bdf": {"color": "#f59e0b", "marker": "s", "label": 'acausal, solver="bdf"', "ls": "--"},
    "CVODE": {"color": "#22303c", "marker": "^", "label": "CVODE, BDF (scikit-sundae)"},
    "Radau": {"color": "#7c8b99", "marker": "D", "label": "Radau (scipy)"},
}


def draw(curves: dict[str, Curves]) -> Figure:
    """A column for each problem: error over seconds, and error over right-hand sides."""
    figure, rows = plt.subplots(
        2, len(curves), figsize=(3 * len(curves), 6), squeeze=False, layout="constrained"
    )
    for i, (name, solvers) in enumerate(curves.items()):
        for solver, points in solvers.items():
            errors = [p.error for p in points]
            for ax, work in (
                (rows[0, i], [p.seconds for p in points]),
                (rows[1, i], [p.rates for p in points]),
            ):
                ax.loglog(work, errors, ms=4, lw=1.2, **STYLES[solver])
                ax.xaxis.set_minor_formatter(NullFormatter())
                ax.grid(alpha=0.25)
        rows[0, i].set_title(name, fontsize=10)
        rows[0, i].set_xlabel("seconds")
        rows[1, i].set_xlabel("right-hand sides")
    for row in rows:
        row[0].set_ylabel("relative error at the end")
    handles, labels = rows[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, frameon=False)
    return figure
