"""Limits, dead zones and an approximate delay."""

from collections.abc import Iterator
from itertools import accumulate
from operator import mul
from typing import Any

import acausal as ac
from acausal.components import icons

from .canonical import canonical_form
from .conventions import CROSSED, INIT, LIMITER_HOMOTOPY, VARIABLE_LIMITER_HOMOTOPY
from .interfaces import SISO, PartialStart

__modelica__ = "Modelica.Blocks.Nonlinear"


class Limiter(SISO):
    """``y = min(max(u, uMin), uMax)``; ``strict`` and ``homotopyType`` have no effect."""

    ICON = icons.LIMITER

    uMax = ac.Parameter(doc="upper limit")
    uMin = ac.Parameter(lambda self: -self.uMax, doc="lower limit")
    strict = ac.Option(False, doc="without effect")
    homotopyType = ac.Option("Linear", choices=LIMITER_HOMOTOPY, doc="without effect")

    def equations(self) -> Iterator[Any]:
        yield ac.Assert(self.uMin <= self.uMax, CROSSED)
        yield ac.Eq(self.y, ac.maximum(ac.minimum(self.u, self.uMax), self.uMin))


class VariableLimiter(SISO):
    """``y = min(max(u, limit2), limit1)`` with input signals as limits.

    ``strict``, ``homotopyType`` and ``ySimplified`` have no effect.
    """

    ICON = icons.marked(icons.LIMITER, "u")

    strict = ac.Option(False, doc="without effect")
    homotopyType = ac.Option("Linear", choices=VARIABLE_LIMITER_HOMOTOPY, doc="without effect")
    ySimplified = ac.Option(0.0, doc="without effect")
    limit1 = ac.Input(doc="upper limit")
    limit2 = ac.Input(doc="lower limit")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.maximum(ac.minimum(self.u, self.limit1), self.limit2))


class DeadZone(SISO):
    """``y = 0`` for ``uMin <= u <= uMax``, else how far ``u`` lies beyond."""

    ICON = icons.DEAD_ZONE

    uMax = ac.Parameter(doc="upper end of the dead zone")
    uMin = ac.Parameter(lambda self: -self.uMax, doc="lower end of the dead zone")

    def equations(self) -> Iterator[Any]:
        yield ac.Assert(self.uMin <= self.uMax, CROSSED)
        beyond = ac.maximum(self.u - self.uMax, 0) + ac.minimum(self.u - self.uMin, 0)
        yield ac.Eq(self.y, beyond)


class SlewRateLimiter(PartialStart, SISO):
    """Follows the input no faster than allowed: ``der(y) = min(max((u - y)/Td, Falling), Rising)``.

    ``SteadyState``: the output starts at the input, ``y = u``. ``strict`` has no effect.
    """

    ICON = icons.SLEW

    Rising = ac.Parameter(1.0, min=0, doc="greatest rate, in units of the signal per second")
    Falling = ac.Parameter(lambda self: -self.Rising, max=0, doc="least rate")
    Td = ac.Parameter(0.001, unit="s", min=0, doc="time constant of the derivative")
    initType = ac.Option("SteadyState", choices=INIT, doc="type of initialization")
    strict = ac.Option(False, doc="without effect")
    y = ac.Output(start="y_start", state="prefer", doc="output signal")

    def equations(self) -> Iterator[ac.Eq]:
        rate = (self.u - self.y) / self.Td
        limited = ac.minimum(ac.maximum(rate, self.Falling), self.Rising)
        yield ac.Eq(ac.der(self.y), limited)

    def initial_equations(self) -> Iterator[ac.Eq]:
        if self.initType == "SteadyState":
            yield ac.Eq(self.y, self.u)
        else:
            yield from super().initial_equations()


class PadeDelay(SISO):
    """Padé approximation of ``y(t) = u(t - delayTime)``, with denominator of order ``n``, numerator ``m``.

    The coefficients of ``s**k`` are ``c(k, m) (-delayTime)**k`` above and ``c(k, n) delayTime**k`` below, where
    ``c(k, p) = (n+m-k)! p!/((n+m)! k! (p-k)!)``. The states ``x`` are those of `TransferFunction`; they start
    at rest, so that ``y = u``. ``balance``, the scaling of the states, has no effect.
    """

    ICON = icons.block("delay")

    delayTime = ac.Parameter(unit="s", min=0, doc="delay of the output")
    n = ac.Option(1, min=1, doc="order of the denominator")
    m = ac.Option(None, doc="order of the numerator, at most n; n by default")
    balance = ac.Option(False, doc="without effect")
    x = ac.Variable(shape="n", doc="states in controller canonical form")

    def _coefficients(self, order: int, of: int, delay: Any) -> list[Any]:
        """Coefficients of a polynomial of that order, highest power first; ``of`` is the other's order."""
        ratios = [(order - k) / ((order + of - k) * (k + 1)) for k in range(order)]
        falling = accumulate(ratios, mul, initial=1.0)
        return [c * delay**k for k, c in enumerate(falling)][::-1]

    def equations(self) -> Iterator[Any]:
        m = self.n if self.m is None else self.m
        yield ac.Assert(1 <= m <= self.n, f"m={m} must lie between 1 and n={self.n}")
        above = self._coefficients(m, self.n, -self.delayTime)
        below = self._coefficients(self.n, m, self.delayTime)
        yield from canonical_form(self.u, self.y, self.x, above, below)

    def initial_equations(self) -> Iterator[ac.Eq]:
        for x in self.x:
            yield ac.Eq(ac.der(x), 0)
