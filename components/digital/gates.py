"""Gates by the tables of IEEE 1164: a weak value counts as a strong one.

The output follows at the same instant, one round of the event later, as in Modelica: so gates in a loop remember.
"""

from collections.abc import Iterator, Sequence
from functools import reduce
from operator import and_, or_
from typing import Any

import acausal as ac
from acausal.components import icons

from .logic import ONE, ZERO, DigitalInput, DigitalOutput, U, X, is_one, is_uninitialized, is_zero

__modelica__ = "Modelica.Electrical.Digital.Basic"


def _any(conditions: Sequence[Any]) -> Any:
    return reduce(or_, conditions)


def _all(conditions: Sequence[Any]) -> Any:
    return reduce(and_, conditions)


class _Remembering(ac.Component):
    """What all gates share."""

    y = DigitalOutput(doc="output")
    auxiliary = ac.Discrete(U, kind="int", doc="what the output becomes")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.auxiliary, self._value())
        yield ac.Eq(self.y, ac.pre(self.auxiliary))

    def _value(self) -> Any:
        raise NotImplementedError


class Not(_Remembering):
    """1 for 0, 0 for 1, ``'U'`` for ``'U'``, else ``'X'``."""

    ICON = icons.block("not")

    x = DigitalInput(doc="input")

    def _value(self) -> Any:
        other = ac.where(is_uninitialized(self.x), U, X)
        known = ac.where(is_one(self.x), ZERO, other)
        return ac.where(is_zero(self.x), ONE, known)


class _Gate(_Remembering):
    """A gate with ``n`` inputs."""

    n = ac.Option(2, min=1, doc="number of inputs")
    x = DigitalInput(shape="n", doc="inputs")

    def _dominated(self, decides: Any, decided: int, otherwise: int) -> Any:
        """``decided`` if an input decides that; else ``otherwise``, unless an input is neither 0 nor 1."""
        rest = _all([is_zero(x) | is_one(x) for x in self.x])
        unknown = ac.where(_any([is_uninitialized(x) for x in self.x]), U, X)
        return ac.where(
            _any([decides(x) for x in self.x]), decided, ac.where(rest, otherwise, unknown)
        )

    def _parity(self, even: int, odd: int) -> Any:
        """By the number of inputs that are 1, unless one is neither 0 nor 1."""
        known = _all([is_zero(x) | is_one(x) for x in self.x])
        unknown = ac.where(_any([is_uninitialized(x) for x in self.x]), U, X)
        sign: Any = 1
        for x in self.x:
            sign = sign * ac.where(is_one(x), -1, 1)
        return ac.where(known, ac.where(sign > 0, even, odd), unknown)


class And(_Gate):
    """1 if all inputs are 1; 0 if one is 0."""

    ICON = icons.block("and")

    def _value(self) -> Any:
        return self._dominated(is_zero, ZERO, ONE)


class Nand(_Gate):
    """0 if all inputs are 1; 1 if one is 0."""

    ICON = icons.block("nand")

    def _value(self) -> Any:
        return self._dominated(is_zero, ONE, ZERO)


class Or(_Gate):
    """1 if an input is 1; 0 if all are 0."""

    ICON = icons.block("or")

    def _value(self) -> Any:
        return self._dominated(is_one, ONE, ZERO)


class Nor(_Gate):
    """0 if an input is 1; 1 if all are 0."""

    ICON = icons.block("nor")

    def _value(self) -> Any:
        return self._dominated(is_one, ZERO, ONE)


class Xor(_Gate):
    """1 if an odd number of inputs is 1."""

    ICON = icons.block("xor")

    def _value(self) -> Any:
        return self._parity(ZERO, ONE)


class Xnor(_Gate):
    """1 if an even number of inputs is 1."""

    ICON = icons.block("xnor")

    def _value(self) -> Any:
        return self._parity(ONE, ZERO)
