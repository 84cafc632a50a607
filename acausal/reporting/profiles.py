"""Profiles of parameters: how much likelihood is lost where they are held."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, cast

import numpy as np
from jaxtyping import Float

from acausal.reporting.axes import one_axes
from acausal.reporting.plot import LEARNED, TRUTH

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NARROW = (6.0, 3.2)
"""Size of a figure, in inches."""

SHOWN = 4.0
"""Ratios are drawn up to so many times the bound."""


class Profiled(Protocol):
    """The loss along a parameter, such as `acausal.Profile`."""

    @property
    def name(self) -> str:
        """The parameter."""
        ...

    @property
    def unit(self) -> str:
        """Its unit."""
        ...

    @property
    def value(self) -> float:
        """Where the fit found it."""
        ...

    @property
    def values(self) -> Float[np.ndarray, " points"]:
        """Where it was held."""
        ...

    @property
    def ratio(self) -> Float[np.ndarray, " points"]:
        """Twice the log likelihood that is lost there."""
        ...

    @property
    def bound(self) -> float:
        """The largest ratio inside of the interval."""
        ...

    def summary(self) -> str:
        """What this means, as a sentence."""
        ...


def plot_profile(profile: Profiled, axes: Any = None) -> Figure:
    """Plot the likelihood ratio over a parameter, with the bound of its interval.

    Arguments:
        profile: what to plot.
        axes: matplotlib axes; by default those of a new figure.
    """
    ax = one_axes(axes, NARROW, "axes")
    ax.plot(profile.values, profile.ratio, "o-", color=LEARNED[0], lw=1.2, ms=3)
    ax.axhline(profile.bound, color=TRUTH, lw=0.9, ls=":")
    ax.axvline(profile.value, color=TRUTH, lw=0.9, ls="--")
    finite = profile.ratio[np.isfinite(profile.ratio)]
    top = min(float(finite.max()), SHOWN * profile.bound)
    ax.set_ylim(-0.05 * profile.bound, 1.1 * max(top, profile.bound))
    unit = "" if profile.unit in ("", "1") else f" in {profile.unit}"
    ax.set(xlabel=f"{profile.name}{unit}", ylabel="likelihood ratio")
    ax.grid(alpha=0.25)
    return cast("Figure", ax.figure)
