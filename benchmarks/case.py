"""A benchmark: a model of any size, and the same equations written by hand in JAX."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import acausal as ac

Values = Mapping[str, Any]
"""Arrays by name."""


@dataclass(frozen=True)
class Case:
    """What a benchmark measures.

    Attributes:
        title: what n counts.
        model: the model of size n.
        sizes: the sizes of a whole run.
        states: the states' names in the groups that the hand-written code takes them in.
        values: the hand-written code's parameters, those of the model.
        by_hand: rates of the states, grouped as they are, from states and parameters.
    """

    title: str
    model: Callable[[int], ac.Component]
    sizes: tuple[int, ...]
    states: Callable[[int], Mapping[str, list[str]]]
    values: Callable[[int], Values]
    by_hand: Callable[[Values, Values], Values]
