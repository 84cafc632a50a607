"""What plots with matplotlib share, which is installed on request: axes, colours; and learned functions and bands."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from itertools import cycle
from typing import TYPE_CHECKING, Any, Protocol

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Bool, Float
from numpy.typing import ArrayLike

from acausal.errors import AcausalError, DataError, need_package, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def new_axes(size: tuple[float, float], rows: int = 1) -> list[Axes]:
    """Axes one below another, with one time axis, in a figure, of a size in inches, that notebooks show once.

    Raises:
        AcausalError: if matplotlib is not installed.
    """
    plt = need_package("matplotlib.pyplot", "Drawing", "plot", AcausalError)
    figure, grid = plt.subplots(
        rows, 1, sharex=True, squeeze=False, figsize=size, layout="constrained"
    )
    figure._ipython_display_ = partial(_show_once, figure)  # pyright: ignore[reportAttributeAccessIssue]
    return list(grid[:, 0])


def _show_once(figure: Figure) -> None:
    """What a notebook asks first of a figure that it shows.

    A figure that is a cell's result is shown as such; notebooks show open figures at the end of a cell, too, so it is
    closed before.
    """
    import matplotlib as mpl
    from matplotlib import pyplot as plt

    if "inline" in mpl.get_backend():
        plt.close(figure)
    raise NotImplementedError  # IPython then asks for a picture


def one_axes(given: Any, size: tuple[float, float], argument: str = "ax") -> Axes:
    """The axes that are given, or those of a new figure; errors as of `need_axes`."""
    return new_axes(size)[0] if given is None else need_axes(given, argument)


def several_axes(given: Any, size: tuple[float, float], n: int, wanted: str) -> list[Axes]:
    """The axes that are given, or those of a new figure, one below another.

    Raises:
        DataError: if they are not ``n``; ``wanted`` says what to give.
    """
    if given is None:
        return new_axes(size, n)
    found = [
        need_axes(ax, "axes")
        for ax in (given if isinstance(given, list | tuple | np.ndarray) else [given])
    ]
    if len(found) != n:
        raise DataError(f"axes: there are {len(found)}; give {wanted}.")
    return found


def need_axes(given: Any, argument: str = "ax") -> Axes:
    """The axes; what nothing can be drawn on is refused.

    Raises:
        DataError: for it; it names the argument.
    """
    if isinstance(given, type) or not hasattr(given, "plot"):
        file = (
            " (to write a file: .save(path) of what is returned)" if isinstance(given, str) else ""
        )
        raise DataError(f"{argument}={shown(given)} is not axes; give one of matplotlib's{file}.")
    return given


TRUTH = "#22303c"
LEARNED = ("#1f77b4", "#d1603d", "#3d8c5a", "#8a5a9e", "#b8860b", "#417f8a")
"""Colours of learned curves, in turn."""
GUIDE = "#8795a1"
SIGMAS = 3.0
"""Learned functions are drawn over this many sigmas of their inputs."""


class InputStatistics(Protocol):
    """Mean and standard deviation of the arguments that a network was called with, such as `Fit.seen`."""

    @property
    def mean(self) -> Float[np.ndarray, " n_arguments"]:
        """Of every argument."""
        ...

    @property
    def sigma(self) -> Float[np.ndarray, " n_arguments"]:
        """The standard deviation."""
        ...


@dataclass(frozen=True, eq=False)
class Band:
    """A learned law over its first argument, or a prediction over time, with its standard deviation.

    Attributes:
        x: the argument or the time.
        law, sigma: mean and standard deviation there.
        sign: of the law where its promises settle it, 1 or −1; else 0. `bounds` are within it.
        limits: the least and the largest value that the law can have, likewise.
        rising: 1 for a law that never falls, −1 for one that never rises, else 0; neither do its `bounds` then.
        held: other arguments of a law, at values that were seen together, near their mean.
    """

    x: Float[np.ndarray, " points"]
    law: Float[np.ndarray, " points"]
    sigma: Float[np.ndarray, " points"]
    sign: Float[np.ndarray, " points"] | float = 0.0
    limits: tuple[float, float] = (-np.inf, np.inf)
    rising: int = 0
    held: tuple[float, ...] = ()

    @property
    def bounds(self) -> tuple[Float[np.ndarray, " points"], Float[np.ndarray, " points"]]:
        """Two standard deviations to either side, as far as the law's promises allow."""
        low, high = self.law - 2 * self.sigma, self.law + 2 * self.sigma
        low = np.where(self.sign > 0, np.maximum(low, 0.0), low)
        high = np.where(self.sign < 0, np.minimum(high, 0.0), high)
        if self.rising:  # what it reached before, it keeps
            along = slice(None, None, self.rising)
            low = np.maximum.accumulate(low[along])[along]
            high = np.minimum.accumulate(high[along][::-1])[::-1][along]
        return np.maximum(low, self.limits[0]), np.minimum(high, self.limits[1])

    @property
    def steep(self) -> Bool[np.ndarray, " points"]:
        """Where a law is steep: there points lie closer."""
        apart = np.gradient(self.x)
        return apart < 0.5 * apart.max()

    def times(self, factor: float) -> Band:
        """The band of a multiple."""
        side = int(np.sign(factor))
        low, high = sorted(factor * limit if factor else 0.0 for limit in self.limits)
        law, sigma = factor * self.law, abs(factor) * self.sigma
        return Band(
            self.x, law, sigma, side * self.sign, (low, high), side * self.rising, self.held
        )


def plot_learned(
    ax: Axes,
    functions: Mapping[str, Callable[..., Any]],
    seen: InputStatistics,
    *,
    truth: Callable[[Float[np.ndarray, " points"]], ArrayLike] | None = None,
    xlabel: str = "",
    ylabel: str = "",
) -> None:
    """Draw learned functions of one argument over their inputs in training.

    Vertical lines mark 1 sigma (dashed) and 2 sigma (solid) of the inputs in training; beyond 2 sigma, shaded,
    a function extrapolates.

    Arguments:
        functions: by label; scalar functions that JAX can map.
        seen: statistics of the argument in training.
        truth: the true function, where it is known.
    """
    mean, sigma = float(seen.mean[0]), float(seen.sigma[0])
    x = np.linspace(mean - SIGMAS * sigma, mean + SIGMAS * sigma, 601)
    if truth is not None:
        ax.plot(x, np.asarray(truth(x)), color=TRUTH, lw=2.4, alpha=0.55, label="truth")
    for (label, function), color in zip(functions.items(), cycle(LEARNED), strict=False):
        ax.plot(x, np.asarray(jax.vmap(function)(jnp.asarray(x))), color=color, lw=1.5, label=label)
    for side, edge in ((-1, x[0]), (1, x[-1])):
        ax.axvline(mean + side * sigma, color=GUIDE, lw=0.9, ls="--")
        ax.axvline(mean + 2 * side * sigma, color=GUIDE, lw=0.9)
        ax.axvspan(*sorted((mean + 2 * side * sigma, edge)), color=GUIDE, alpha=0.12, lw=0)
    ax.set_xlim(x[0], x[-1])
    ax.grid(alpha=0.25)
    ax.set(xlabel=xlabel, ylabel=ylabel)
    ax.legend(frameon=False)


def plot_band(ax: Axes, law: Band, *, color: str = LEARNED[0], label: str = "") -> None:
    """Draw a law with a band of two standard deviations to either side."""
    low, high = law.bounds
    ax.fill_between(law.x, low, high, color=color, alpha=0.2, lw=0)
    ax.plot(law.x, law.law, color=color, lw=1.6, label=label)
