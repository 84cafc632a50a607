"""What blocks share: truth values as numbers, how a state starts, how short an instant is, when a period began."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import acausal as ac

TRUE = 0.5
"""All signals are real. One that stands for a truth value is true above this: blocks give 1 or 0."""


INIT = ("NoInit", "SteadyState", "InitialState", "InitialOutput")
"""How a block with states starts: the choices of ``initType``, as in `Modelica.Blocks.Types.Init`."""


CROSSED = "the lower limit lies above the upper one; give both, or exchange them"
"""What it means that limits are not in order."""

LIMITER_HOMOTOPY = ("NoHomotopy", "Linear", "UpperLimit", "LowerLimit")
VARIABLE_LIMITER_HOMOTOPY = ("NoHomotopy", "Linear", "Fixed")
"""The choices of ``homotopyType``, as in `Modelica.Blocks.Types`."""


INSTANT = 1e-15
"""Shortest duration [s]: it stands for a duration of zero in a quotient."""


SMALL = 1e-60
"""Least value of what must be positive, as `Modelica.Constants.small`."""


def part_of(elapsed: Any, duration: Any) -> Any:
    """How much of a duration has elapsed, from 0 to 1; a duration of zero is over in an `INSTANT`."""
    return ac.maximum(ac.minimum(elapsed / ac.maximum(duration, INSTANT), 1), 0)


def truth(condition: Any, *, events: bool | None = False) -> Any:
    """1 where a condition holds, else 0.

    Literal by default: signals that are truth values change at events only. ``events`` as in `acausal.where`.
    """
    return ac.where(condition, 1, 0, events=events)


def truth_of(value: Any) -> Any:
    """A number for a truth value that a user gives: True or False, a condition, or a variable that is 1 or 0."""
    return int(value) if isinstance(value, bool) else ac.where(value, 1, 0, events=None)


def rises(held: Any) -> Any:
    """Whether a discrete truth value has just become 1, not counting the start."""
    return ac.edge(held) & ~(ac.initial() > TRUE)


def changes(held: Any) -> Any:
    """Whether a discrete variable has just changed, not counting the start."""
    return ac.change(held) & ~(ac.initial() > TRUE)


class Period(NamedTuple):
    """Where time lies in a periodic signal.

    Attributes:
        count: periods since the start, a whole number. begin: when the present one began, in seconds.
        elapsed: time since then.
    """

    count: Any
    begin: Any
    elapsed: Any


def period_at(start: Any, period: Any) -> Period:
    """The present period, counted from a start, both in seconds.

    In a model that has events, every period begins with one; in others this is a formula.
    """
    count = ac.floor((ac.time - start) / period, events=None)
    begin = start + count * period
    return Period(count, begin, ac.time - begin)


def first_true(signals: Sequence[Any], values: Sequence[Any], otherwise: Any) -> Any:
    """The value that belongs to the first signal that is true."""
    for signal, value in zip(reversed(signals), reversed(values), strict=True):
        otherwise = ac.where(signal > TRUE, value, otherwise)
    return otherwise


def discrete_output(
    start: Any = 0.0, *, kind: Any = "real", shape: Any = None, unit: str = "", doc: str = ""
) -> Any:
    """The declaration of an output that changes at events only."""
    return _DiscreteOutput(start, kind=kind, shape=shape, unit=unit, doc=doc)


class _DiscreteOutput(ac.Discrete, ac.Output):
    """An output signal that is a discrete variable."""
