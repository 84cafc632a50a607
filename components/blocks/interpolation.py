"""How tables of data are read and interpolated."""

from typing import Any

import numpy as np

import acausal as ac

from .table_files import from_file

SMOOTHNESS: dict[str, Any] = {
    "LinearSegments": "linear",
    "ConstantSegments": "previous",
    "ContinuousDerivative": "akima",
    "ModifiedContinuousDerivative": "modified-akima",
    "MonotoneContinuousDerivative1": "monotone",
    "MonotoneContinuousDerivative2": "steffen",
}
"""Kinds of smoothness -> interpolations of `acausal.Signal`."""

SPLINES = ("cubic", "akima", "modified-akima", "monotone", "steffen")
"""Interpolations of `acausal.Signal` with a continuous derivative."""

EXTRAPOLATION: dict[str, Any] = {
    "HoldLastPoint": "hold",
    "LastTwoPoints": "linear",
    "Periodic": "periodic",
    "NoExtrapolation": "hold",
}


def interpolant(
    points: Any, smoothness: str, extrapolation: str, what: str, _key: Any = None
) -> ac.Signal:
    """A signal through rows ``(t, y)``; a repeated time is a jump, a single row a constant.

    Where the first or last two rows have one time, there is no line to continue: the value is held.
    """
    points = np.asarray(points, dtype=float)
    if len(points) == 1:
        points = np.concatenate([points, points + np.array([1.0, 0.0])])
    ts = points[:, 0].copy()
    beyond: list[Any] = [
        "hold" if step == 0 and extrapolation == "LastTwoPoints" else EXTRAPOLATION[extrapolation]
        for step in (ts[1] - ts[0], ts[-1] - ts[-2])
    ]
    for i in np.flatnonzero(np.diff(ts) == 0)[::-1]:
        ts[i] = np.nextafter(min(ts[i], ts[i + 1]), -np.inf)
    kind = SMOOTHNESS[smoothness]
    return ac.Signal(ts, points[:, 1], kind, before_start=beyond[0], after_end=beyond[1], name=what)


def rows(component: Any) -> np.ndarray:
    """The table of a component as an array, of the form that its class states in ``FORM``.

    Raises:
        DeclarationError: if it has no such table, or the file none.
    """
    if component.tableOnFile:
        table = from_file(
            component.fileName, component.tableName, component.delimiter, component.nHeaderLines
        )
    else:
        table = component.table
    form, least = component.FORM
    try:
        found = np.asarray(table, dtype=float)
    except (TypeError, ValueError):
        raise ac.DeclarationError(f"{component._node.label}: {_fault(table)}") from None
    if table is None or found.ndim != 2 or np.less(found.shape, least).any():
        raise ac.DeclarationError(f"{component._node.label} needs table={form}, got {table!r:.80}")
    return found


def _fault(table: Any) -> str:
    """Why rows are no array of numbers."""
    lists = (list, tuple, np.ndarray)
    given: Any = table if isinstance(table, lists) else []
    lengths = [len(row) if isinstance(row, lists) else 0 for row in given]
    for number, length in enumerate(lengths, 1):
        if length != lengths[0]:
            return (
                f"the rows of table differ in length: row 1 has {lengths[0]} numbers, row {number} has {length}; "
                "give each row all of its columns"
            )
    return f"table holds something that is no number: {table!r:.80}"


def check_order(component: Any, values: np.ndarray, where: str, *, twice: bool) -> None:
    """Refuse arguments of a table that do not ascend.

    Arguments:
        where: names them, such as "the first column of table".
        twice: whether an argument may be there twice, as a jump.

    Raises:
        DeclarationError: that names the component and the place.
    """
    steps = np.diff(values)
    wrong = np.flatnonzero(steps < 0 if twice else steps <= 0)
    if len(wrong):
        i = int(wrong[0])
        raise ac.DeclarationError(
            f"{component._node.label}: {where} must ascend, but {values[i]:.9g} is followed by {values[i + 1]:.9g}; "
            "sort the table"
        )


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
