"""Plots of many variants of one signal."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from jaxtyping import Float
from numpy import ndarray

from acausal.reporting.axes import one_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FAINT, CLEAR = 0.25, 0.9
"""How opaque lines are: many of them, and a few."""

MANY = 50
"""So many lines are many."""


def plot_variants(
    time: Float[ndarray, " n"],
    lines: Float[ndarray, "variants n"],
    levels: Float[ndarray, " variants"],
    labels: tuple[str, str],
    *,
    ax: Axes | None = None,
) -> Figure:
    """Draw lines over time [s], coloured by a value each, with a colour bar.

    Arguments:
        time: in seconds.
        lines: the signal in all variants.
        levels: the value that colours each.
        labels: of the signal and of the values, with their units.
        ax: matplotlib axes; by default those of a new figure.
    """
    ax = one_axes(ax, (7.0, 3.5))
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    scale = ScalarMappable(Normalize(levels.min(), levels.max()), "viridis")
    alpha = FAINT if len(lines) > MANY else CLEAR
    for y, color in zip(lines, scale.to_rgba(levels), strict=True):
        ax.plot(time, y, color=color, lw=1.2, alpha=alpha)
    ax.set(xlabel="time in s", ylabel=labels[0])
    ax.grid(alpha=0.25)
    figure = cast("Figure", ax.figure)
    figure.colorbar(scale, ax=ax, label=labels[1])
    return figure
