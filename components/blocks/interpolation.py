"""How tables of data are read and interpolated."""

from typing import Any, Literal

import numpy as np

import acausal as ac

SMOOTHNESS: dict[str, Literal["linear", "previous", "cubic"]] = {
    "LinearSegments": "linear",
    "ConstantSegments": "previous",
    "ContinuousDerivative": "cubic",
}


EXTRAPOLATION: dict[str, Literal["hold", "linear", "periodic"]] = {
    "HoldLastPoint": "hold",
    "LastTwoPoints": "linear",
    "Periodic": "periodic",
    "NoExtrapolation": "hold",
}


def interpolant(
    points: Any, smoothness: str, extrapolation: str, what: str, _key: Any = None
) -> ac.Signal:
    """A signal through rows ``(t, y)``; a repeated time is a jump, a single row a constant."""
    points = np.asarray(points, dtype=float)
    if len(points) == 1:
        points = np.concatenate([points, points + np.array([1.0, 0.0])])
    ts = points[:, 0].copy()
    for i in np.flatnonzero(np.diff(ts) == 0)[::-1]:
        ts[i] = np.nextafter(min(ts[i], ts[i + 1]), -np.inf)
    return ac.Signal(
        ts, points[:, 1], SMOOTHNESS[smoothness], EXTRAPOLATION[extrapolation], name=what
    )


def rows(component: Any) -> np.ndarray:
    """A component's option ``table`` as an array with at least two columns.

    Raises:
        DeclarationError: if it is not such a table.
    """
    table = component.table
    if table is None or np.ndim(table) != 2 or np.shape(table)[1] < 2:
        raise ac.DeclarationError(
            f"{type(component).__name__} needs table=[[t, y, ...], ...], got {table!r}"
        )
    return np.asarray(table, dtype=float)
