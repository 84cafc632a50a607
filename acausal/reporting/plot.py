"""Plots of a training: learned functions and where to trust them, losses, and changes of parameters."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import cycle
from typing import TYPE_CHECKING, Any, Protocol

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Float
from numpy.typing import ArrayLike

if TYPE_CHECKING:
    from matplotlib.axes import Axes

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


class UncertainCurve(Protocol):
    """A curve with its standard deviation, such as `Confidence.laws`."""

    @property
    def x(self) -> Float[np.ndarray, " points"]:
        """The argument or the time."""
        ...

    @property
    def law(self) -> Float[np.ndarray, " points"]:
        """The curve."""
        ...

    @property
    def sigma(self) -> Float[np.ndarray, " points"]:
        """The standard deviation."""
        ...

    @property
    def bounds(self) -> tuple[Float[np.ndarray, " points"], Float[np.ndarray, " points"]]:
        """Two standard deviations to either side, as far as it can be there."""
        ...


class HistoryLike(Protocol):
    """What happened over the updates of a training, such as `Fit.history`; losses in rows (epochs done, loss)."""

    @property
    def epochs(self) -> int:
        """Updates done."""
        ...

    @property
    def loss(self) -> Float[np.ndarray, " epochs"]:
        """Of the batches."""
        ...

    @property
    def full_loss(self) -> Float[np.ndarray, "k 2"]:
        """Over the whole record."""
        ...

    @property
    def validation_loss(self) -> Float[np.ndarray, "k 2"]:
        """Of the held-out samples."""
        ...

    @property
    def modifiers(self) -> Mapping[str, Float[np.ndarray, " epochs"]]:
        """Changes of parameters, by parameter."""
        ...


class WithHistory(Protocol):
    """A result of a training, such as `Fit`."""

    @property
    def history(self) -> HistoryLike:
        """What happened."""
        ...


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
    plot_guides(ax, seen, x[0], x[-1])
    ax.set(xlabel=xlabel, ylabel=ylabel)
    ax.legend(frameon=False)


def plot_guides(ax: Axes, seen: InputStatistics, start: float, end: float) -> None:
    """Mark the range of a network's first argument in training on an axis from ``start`` to ``end``."""
    mean, sigma = float(seen.mean[0]), float(seen.sigma[0])
    for side, edge in ((-1, start), (1, end)):
        ax.axvline(mean + side * sigma, color=GUIDE, lw=0.9, ls="--")
        ax.axvline(mean + 2 * side * sigma, color=GUIDE, lw=0.9)
        ax.axvspan(*sorted((mean + 2 * side * sigma, edge)), color=GUIDE, alpha=0.12, lw=0)
    ax.set_xlim(start, end)
    ax.grid(alpha=0.25)


def plot_band(ax: Axes, law: UncertainCurve, *, color: str = LEARNED[0], label: str = "") -> None:
    """Draw a law with a band of two standard deviations to either side."""
    low, high = law.bounds
    ax.fill_between(law.x, low, high, color=color, alpha=0.2, lw=0)
    ax.plot(law.x, law.law, color=color, lw=1.6, label=label)


def plot_losses(
    ax: Axes, histories: Mapping[str, HistoryLike], *, levels: Mapping[str, float] | None = None
) -> None:
    """Draw losses over epochs: of the batches (thin), over the whole record (dots) and of held-out samples (squares).

    Arguments:
        histories: by label.
        levels: horizontal lines by label, such as a published loss.
    """
    if not any(np.any(h.loss <= 0) or np.any(h.full_loss[:, 1] <= 0) for h in histories.values()):
        ax.set_yscale("log")  # a logarithm of a likelihood may be negative
    for (label, history), color in zip(histories.items(), cycle(LEARNED), strict=False):
        ax.plot(np.arange(history.epochs), history.loss, color=color, lw=0.6, alpha=0.45)
        ax.plot(*history.full_loss.T, "o-", color=color, lw=1.2, ms=3, label=label)
        if len(history.validation_loss):
            kept = f"{label}, held out"
            ax.plot(*history.validation_loss.T, "s--", color=color, lw=1.2, ms=3, label=kept)
    for label, level in (levels or {}).items():
        ax.axhline(level, color=GUIDE, lw=1, ls=":")
        place = (1.0, level)
        ax.annotate(
            label, place, xycoords=("axes fraction", "data"), xytext=(4, 0), textcoords="offset points",
            va="center", fontsize=8, color=GUIDE, annotation_clip=False,
        )  # fmt: skip
    ax.set(xlabel="epoch", ylabel="loss")
    ax.grid(alpha=0.25, which="both")
    ax.legend(frameon=False)


def plot_modifiers(
    ax: Axes, fit: WithHistory, *, targets: Mapping[str, float] | None = None
) -> None:
    """Draw the changes of trained parameters over epochs, and their targets where these are known."""
    for (name, values), color in zip(fit.history.modifiers.items(), cycle(LEARNED), strict=False):
        ax.plot(values, color=color, lw=1.4, label=name)
        if targets is not None:
            ax.axhline(targets[name], color=color, lw=0.9, ls="--")
    ax.set(xlabel="epoch", ylabel="change")
    ax.grid(alpha=0.25)
    ax.legend(frameon=False)
