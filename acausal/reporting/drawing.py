"""matplotlib, which is installed on request: results are made and compared without it."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

from acausal.errors import AcausalError, DataError, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def pyplot() -> ModuleType:
    """`matplotlib.pyplot`, which keeps the figures that notebooks and windows show.

    Raises:
        AcausalError: if matplotlib is not installed.
    """
    try:
        from matplotlib import pyplot as plt
    except ModuleNotFoundError as error:
        raise _missing(error) from None
    return plt


def new_figure(size: tuple[float, float]) -> Figure:
    """A figure that no window shows, width and height in inches.

    Raises:
        AcausalError: if matplotlib is not installed.
    """
    try:
        from matplotlib.figure import Figure
    except ModuleNotFoundError as error:
        raise _missing(error) from None
    return Figure(figsize=size, layout="constrained")


def need_axes(given: Any, argument: str = "ax") -> Axes:
    """The axes; what nothing can be drawn on is refused.

    Raises:
        DataError: for it; it names the argument.
    """
    if isinstance(given, type) or not hasattr(given, "plot"):
        raise DataError(f"{argument}={shown(given)} is no axes; give one of matplotlib's.")
    return given


def _missing(error: ModuleNotFoundError) -> Exception:
    if (error.name or "").partition(".")[0] != "matplotlib":
        return error
    return AcausalError("Drawing needs matplotlib: pip install 'acausal[plot]'.")
