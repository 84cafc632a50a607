"""Functions for equations that sympy lacks, or that need other derivatives than sympy's."""

from __future__ import annotations

from typing import Any

import sympy as sp

from acausal.modeling.symbols import ModuleCall, number_or_expression, time
from acausal.modeling.whole import floor as floor

maximum, minimum = sp.Max, sp.Min


class Abs(sp.Abs):
    """The absolute value of a real number (sympy's own expects complex ones, as in ``Abs(log(x))``)."""

    def _eval_derivative(self, s: Any) -> Any:  # pyright: ignore[reportIncompatibleMethodOverride]
        argument: Any = self.args[0]
        return sign(argument) * argument.diff(s)


class sign(sp.sign):  # noqa: N801 (a mathematician's name)
    """-1, 0 or 1; piecewise constant, so its derivative counts as zero."""

    def _eval_derivative(self, s: Any) -> Any:  # pyright: ignore[reportIncompatibleMethodOverride]
        return sp.S.Zero


class Prescribed(sp.Function):
    """``Prescribed(n, time, q, qd, ...)``: q's n-th derivative, which is the n-th of the signals after it."""

    def fdiff(self, argindex: int = 1) -> Any:
        """With respect to time the next signal, else zero."""
        parts: Any = self.args
        order, _, *signals = parts
        if argindex != 2:
            return sp.S.Zero
        last = order + 1 == len(signals) - 1
        return signals[-1] if last else Prescribed(order + 1, time, *signals)

    def _eval_is_real(self) -> bool:
        return True

    def _sympystr(self, printer: Any) -> str:
        parts: Any = self.args
        return printer._print(parts[2 + int(parts[0])])


def prescribed(q: Any, *derivatives: Any) -> Any:
    """The signal ``q``, whose time derivatives are not computed, but given as these signals."""
    signals = [number_or_expression(s, "an argument of prescribed(...)") for s in (q, *derivatives)]
    return Prescribed(0, time, *signals) if derivatives else q


COMPUTABLE: tuple[type, ...] = (
    ModuleCall,
    Prescribed,
    sp.Abs,
    sp.Heaviside,
    sp.Max,
    sp.Min,
    sp.Mod,
    sp.Piecewise,
    sp.acos,
    sp.asin,
    sp.asinh,
    sp.atan,
    sp.atan2,
    sp.ceiling,
    sp.cos,
    sp.cosh,
    sp.exp,
    sp.floor,
    sp.log,
    sp.sign,
    sp.sin,
    sp.sinh,
    sp.tan,
    sp.tanh,
)
"""All functions that may stand in an equation."""
