"""Numbers for the page's script: JSON, in which long arrays are packed as integers."""

from __future__ import annotations

import base64
import json
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from jaxtyping import Float

LONG = 100
"""Longer arrays are packed: 65,534 levels between the least and the largest value, or 2³² − 2 of them for an axis."""

LESS = "\\u003c"
"""What stands for ``<`` in JSON, so that no text in it can end the element that it stands in."""


@dataclass(frozen=True)
class Raw:
    """JSON that is written already."""

    text: str


@dataclass(frozen=True)
class Pool:
    """Arrays as JSON, each once."""

    places: dict[tuple[bool, bytes], int] = field(default_factory=dict[tuple[bool, bytes], int])
    texts: list[str] = field(default_factory=list[str])

    def add(self, values: Float[np.ndarray, " n"] | None, *, fine: bool = False) -> int:
        """The number of an array, -1 for None; a ``fine`` one is kept to nine digits of its range instead of five."""
        if values is None:
            return -1
        values = np.asarray(values, float)
        key = fine, values.tobytes()
        if key not in self.places:
            self.places[key] = len(self.texts)
            short = len(values) <= LONG
            self.texts.append(numbers(values, 9 if fine else 6) if short else packed(values, fine))
        return self.places[key]

    def written(self) -> Raw:
        """All of them."""
        return Raw(f"[{','.join(self.texts)}]")


def numbers(values: Float[np.ndarray, " n"], digits: int) -> str:
    """Numbers as JSON with some significant digits; what is not finite is null."""
    texts = (f"{v:.{digits}g}" if finite else "null" for v, finite in _pairs(values))
    return f"[{','.join(texts)}]"


def _pairs(values: Float[np.ndarray, " n"]) -> Iterable[tuple[float, bool]]:
    return zip(values.tolist(), np.isfinite(values).tolist(), strict=True)


def packed(values: Float[np.ndarray, " n"], fine: bool) -> str:
    """An array as integers between its ends, in Base64; the largest integer stands for what is not finite."""
    kind = "<u4" if fine else "<u2"
    gap = int(np.iinfo(kind).max)
    finite = np.isfinite(values)
    known = values[finite]
    low, high = (float(known.min()), float(known.max())) if len(known) else (0.0, 0.0)
    span = high - low or 1.0
    share = (np.where(finite, values, low) - low) / span
    levels = np.where(finite, np.round(share * (gap - 1)), gap).astype(kind)
    text = base64.b64encode(levels.tobytes()).decode()
    return as_json({"low": low, "span": span, "gap": gap, "packed": text})


def as_json(value: Any) -> str:
    """JSON that may stand in a script element: numbers that are not finite are null, and no ``<`` occurs."""
    return _json(value).replace("<", LESS)


def _json(value: Any) -> str:
    match value:
        case Raw():
            return value.text
        case dict():
            pairs = value.items()  # pyright: ignore[reportUnknownVariableType]
            return f"{{{','.join(f'{json.dumps(str(k))}:{_json(v)}' for k, v in pairs)}}}"
        case list() | tuple():
            return f"[{','.join(map(_json, value))}]"
        case float():
            return f"{value:.12g}" if np.isfinite(value) else "null"
        case _:
            return json.dumps(value)
