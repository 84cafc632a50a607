"""matplotlib, which is installed on request: results are made and compared without it."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from acausal.errors import AcausalError, DataError, need_package, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def new_axes(size: tuple[float, float], rows: int = 1) -> list[Axes]:
    """Axes one below another, with one time axis, in a figure that notebooks and windows show, once.

    Arguments:
        size: width and height of the figure, in inches.

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
