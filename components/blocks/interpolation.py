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


def jumps(points: np.ndarray) -> list[float]:
    """Times at which a table ``(t, y, ...)`` has two rows."""
    ts = points[:, 0]
    return sorted(set(ts[1:][np.diff(ts) == 0].tolist()))


def corners(points: np.ndarray, smoothness: str, extrapolation: str) -> list[float]:
    """Times at which a table ``(t, y, ...)`` jumps or bends.

    Cubic interpolation bends at jumps only; constant one jumps at every row with another value.
    """
    found = set(jumps(points))
    ts, ys = points[:, 0], points[:, 1:]
    if smoothness == "ConstantSegments":
        found |= set(ts[1:][(np.diff(ys, axis=0) != 0).any(axis=1)].tolist())
    if smoothness == "LinearSegments" and len(ts) > 1:
        lengths = np.diff(ts)
        inside = lengths > 0
        slopes = np.diff(ys, axis=0)[inside] / lengths[inside, None]
        begins = ts[:-1][inside]
        if EXTRAPOLATION[extrapolation] == "hold":
            flat = np.zeros((1, ys.shape[1]))
            slopes = np.concatenate([flat, slopes, flat])
            begins = np.concatenate([begins, ts[-1:]])
        else:
            begins = begins[1:]
        bends = ~np.isclose(slopes[1:], slopes[:-1], rtol=1e-12, atol=0).all(axis=1)
        found |= set(begins[bends].tolist())
    return sorted(found)
