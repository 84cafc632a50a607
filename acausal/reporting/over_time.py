"""Plots of signals over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, cast

from jaxtyping import Float
from numpy import ndarray

from acausal.reporting.drawing import new_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def plot_over_time(
    time: Float[ndarray, " n"],
    curves: Mapping[str, Float[ndarray, " n"]],
    units: Mapping[str, str],
    *,
    axes: Sequence[Axes] | None = None,
) -> Figure:
    """Plot signals over time, with one diagram for each unit.

    Arguments:
        time: in seconds.
        curves: the signals by name.
        units: their units by name; an empty text for pure numbers.
        axes: matplotlib axes, one for each unit; by default those of a new figure.

    Returns:
        The figure.
    """
    groups: dict[str, list[str]] = {}
    for name in curves:
        groups.setdefault(units[name], []).append(name)
    size = (7.0, 1.0 + 2.0 * len(groups))
    diagrams = new_axes(size, len(groups)) if axes is None else axes
    for ax, (unit, members) in zip(diagrams, groups.items(), strict=True):
        for name in members:
            ax.plot(time, curves[name], label=name)
        label = f"in {unit or '1'}"
        ax.set_ylabel(f"{members[0]} {label}" if len(members) == 1 else label)
        if len(members) > 1:
            ax.legend()
    diagrams[-1].set_xlabel("time in s")
    return cast("Figure", diagrams[0].figure)
