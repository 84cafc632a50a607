"""Plots over time: of signals, of predictions with bands, and of many variants of one signal."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING, cast

from jaxtyping import Float
from numpy import isnan, ndarray

from acausal.errors import DataError, listing
from acausal.reporting.plot import (
    TRUTH,
    Band,
    new_axes,
    one_axes,
    plot_band,
    several_axes,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def plot_over_time(
    time: Float[ndarray, " n"],
    curves: Mapping[str, Float[ndarray, " n"]],
    units: Mapping[str, str],
    *,
    axes: Sequence[Axes] | None = None,
    steps: Collection[str] = (),
) -> Figure:
    """Plot signals by name over time [s], with one diagram for each unit; an empty text stands for pure numbers.

    ``steps`` are the signals that keep each value until the next.

    Raises:
        DataError: for axes that are not one for each unit, or if there is nothing to plot.
    """
    if not curves:
        raise DataError("There is nothing to plot: the model has no states; name some variables.")
    groups: dict[str, list[str]] = {}
    for name in curves:
        groups.setdefault(units[name], []).append(name)
    size, n = (7.0, 1.0 + 2.0 * len(groups)), len(groups)
    wanted = f"one for each unit: {listing(unit or '1' for unit in groups)}"
    diagrams = several_axes(axes, size, n, wanted)
    for ax, (unit, members) in zip(diagrams, groups.items(), strict=True):
        for name in members:
            style = "steps-post" if name in steps else "default"
            ax.plot(time, curves[name], label=name, drawstyle=style)
        label = f"in {unit or '1'}"
        ax.set_ylabel(f"{members[0]} {label}" if len(members) == 1 else label)
        if len(members) > 1:
            ax.legend()
    diagrams[-1].set_xlabel("time in s")
    return cast("Figure", diagrams[0].figure)


def plot_predictions(
    time: Float[ndarray, " n"],
    measured: Float[ndarray, "n n_names"],
    predicted: Mapping[str, Band],
    units: Mapping[str, str],
) -> Figure:
    """Plot signals as measured (NaN where they are not) and as predicted with bands, one below another."""
    axes = new_axes((7.0, 1.0 + 2.0 * len(predicted)), len(predicted))
    for ax, (name, band), column in zip(axes, predicted.items(), measured.T, strict=True):
        if not isnan(column).all():
            ax.plot(time, column, ".", ms=3, color=TRUTH, label="measured")
        plot_band(ax, band, label="predicted")
        ax.set_ylabel(f"{name} in {units[name] or '1'}")
        ax.legend()
    axes[-1].set_xlabel("time in s")
    return cast("Figure", axes[0].figure)


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
    """Draw the lines of a signal over time [s], coloured by its level in each variant, with a colour bar.

    The labels are those of the signal and of the levels, with their units.
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
