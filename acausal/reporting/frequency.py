"""Plots of linear models: frequency responses and step responses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import cycle
from typing import TYPE_CHECKING, cast

import numpy as np
from jaxtyping import Complex, Float
from numpy.typing import ArrayLike

from acausal.reporting.plot import GUIDE, LEARNED, one_axes, several_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def plot_bode(
    omega: ArrayLike,
    curves: Mapping[str, Complex[np.ndarray, " n"]],
    *,
    axes: Sequence[Axes] | None = None,
) -> Figure:
    """Draw magnitude [dB] and phase [degrees] of responses by label over the angular frequency [rad/s].

    Raises:
        DataError: for other than two axes; by default they are those of a new figure.
    """
    upper, lower = several_axes(axes, (7.0, 5.0), 2, "2, for magnitude and phase")
    for (label, response), color in zip(curves.items(), cycle(LEARNED), strict=False):
        with np.errstate(divide="ignore"):
            upper.semilogx(omega, 20 * np.log10(np.abs(response)), color=color, label=label)
        phase = np.unwrap(np.angle(response))
        lower.semilogx(omega, np.degrees(phase), color=color)
    upper.set_ylabel("magnitude in dB")
    lower.set(ylabel="phase in degrees", xlabel="angular frequency in rad/s")
    lower.locator_params("y", steps=[1, 1.5, 3, 4.5, 9, 10])
    for ax in (upper, lower):
        ax.grid(alpha=0.25, which="both")
    upper.legend(frameon=False)
    return cast("Figure", upper.figure)


def plot_nyquist(
    curves: Mapping[str, Complex[np.ndarray, " n"]], *, ax: Axes | None = None
) -> Figure:
    """Draw responses by label in the complex plane, for negative frequencies dashed, and mark the point -1."""
    ax = one_axes(ax, (6.0, 5.0))
    for (label, response), color in zip(curves.items(), cycle(LEARNED), strict=False):
        real, imaginary = np.real(response), np.imag(response)
        ax.plot(real, imaginary, color=color, label=label)
        ax.plot(real, -imaginary, color=color, ls="--", lw=0.9)
    ax.plot(-1, 0, "+", color=GUIDE, ms=10, mew=2)
    ax.axhline(0, color=GUIDE, lw=0.6)
    ax.axvline(0, color=GUIDE, lw=0.6)
    ax.set(xlabel="real part", ylabel="imaginary part")
    ax.grid(alpha=0.25)
    ax.legend(frameon=False)
    return cast("Figure", ax.figure)


def plot_steps(
    time: Float[np.ndarray, " n"],
    curves: Mapping[str, Mapping[str, Float[np.ndarray, " n"]]],
    *,
    axes: Sequence[Axes] | None = None,
) -> Figure:
    """Draw step responses by output and label over time [s], with a diagram for each output.

    Raises:
        DataError: for axes that are not one for each output; by default they are those of a new figure.
    """
    n = len(curves)
    diagrams = several_axes(axes, (7.0, 1.0 + 2.0 * n), n, f"{n}, for outputs")
    for ax, (output, responses) in zip(diagrams, curves.items(), strict=True):
        for (label, y), color in zip(responses.items(), cycle(LEARNED), strict=False):
            ax.plot(time, y, color=color, label=label)
        ax.set_ylabel(output)
        ax.grid(alpha=0.25)
        if len(responses) > 1:
            ax.legend(frameon=False)
    diagrams[-1].set_xlabel("time in s")
    return cast("Figure", diagrams[0].figure)
