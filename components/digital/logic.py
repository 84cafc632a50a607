"""The nine values of a digital signal (IEEE 1164), as numbers."""

from typing import Any

import acausal as ac

LOGIC = ("'U'", "'X'", "'0'", "'1'", "'Z'", "'W'", "'L'", "'H'", "'-'")
"""Uninitialized, unknown, 0, 1, high impedance, weak unknown, weak 0, weak 1, don't care: as signals 1 ... 9."""

DigitalInput = ac.Input
DigitalOutput = ac.Output

U, X, ZERO, ONE = (LOGIC.index(value) + 1 for value in ("'U'", "'X'", "'0'", "'1'"))
"""The signals of the values that gates give."""


def signal(value: str) -> int:
    """The number of a value of `LOGIC`, with or without its quotes.

    Raises:
        DeclarationError: for what is none.
    """
    value = value if value in LOGIC else f"'{value}'"
    if value not in LOGIC:
        raise ac.DeclarationError(f"{value!r} is not one of {', '.join(LOGIC)}")
    return LOGIC.index(value) + 1


def is_zero(x: Any) -> Any:
    """Whether a signal is 0 or a weak 0: 3 or 7."""
    return abs(abs(x - 5) - 2) < 0.5


def is_one(x: Any) -> Any:
    """Whether a signal is 1 or a weak 1: 4 or 8."""
    return abs(abs(x - 6) - 2) < 0.5


def is_uninitialized(x: Any) -> Any:
    """Whether a signal is uninitialized: 1."""
    return x < 1.5
