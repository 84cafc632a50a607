"""The greatest integer not above a number: a function, and an integer whose jumps are events."""

from __future__ import annotations

from typing import Any

import sympy as sp

from acausal.modeling.symbols import number_or_expression


class floor(sp.floor):  # noqa: N801 (a mathematician's name)
    """The greatest integer not above the argument; piecewise constant, so its derivative counts as zero.

    ``floor(x, events=True)`` ends steps where it jumps; with ``events=None`` in models that have other events.
    """

    def __new__(cls, arg: Any, *, events: bool | None = False, **options: Any) -> Any:
        """The integer; a `Floored` if its jumps are events."""
        number = number_or_expression(arg, "the argument of floor(...)")
        if events is False or number.is_number:
            return super().__new__(cls, number, **options)
        return Floored(number, sp.Integer(events is True))

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Zero."""
        return sp.S.Zero


class Floored(sp.Function):
    """``Floored(number, always)``: the greatest integer not above a number, whose jumps are events.

    With ``always`` 0 they are events only in a model that has others, too.
    """

    nargs = 2

    def _eval_is_real(self) -> bool:
        return True

    def _sympystr(self, printer: Any) -> str:
        return printer._print(floor(self.args[0]))
