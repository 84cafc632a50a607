"""Limits and dead zones."""

from collections.abc import Iterator

import acausal as ac

from .interfaces import SISO


class Limiter(SISO):
    """``y = min(max(u, uMin), uMax)``; ``strict`` and ``homotopyType`` have no effect."""

    uMax = ac.Parameter(doc="upper limit")
    uMin = ac.Parameter(lambda self: -self.uMax, doc="lower limit")
    strict = ac.Option(False, doc="without effect")
    homotopyType = ac.Option("Linear", doc="without effect")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.maximum(ac.minimum(self.u, self.uMax), self.uMin))


class VariableLimiter(SISO):
    """``y = min(max(u, limit2), limit1)`` with input signals as limits.

    ``strict``, ``homotopyType`` and ``ySimplified`` have no effect.
    """

    strict = ac.Option(False, doc="without effect")
    homotopyType = ac.Option("Linear", doc="without effect")
    ySimplified = ac.Option(0.0, doc="without effect")
    limit1 = ac.Input(doc="upper limit")
    limit2 = ac.Input(doc="lower limit")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.maximum(ac.minimum(self.u, self.limit1), self.limit2))


class DeadZone(SISO):
    """``y = 0`` for ``uMin <= u <= uMax``, else how far ``u`` lies beyond."""

    uMax = ac.Parameter(doc="upper end of the dead zone")
    uMin = ac.Parameter(lambda self: -self.uMax, doc="lower end of the dead zone")

    def equations(self) -> Iterator[ac.Eq]:
        beyond = ac.maximum(self.u - self.uMax, 0) + ac.minimum(self.u - self.uMin, 0)
        yield ac.Eq(self.y, beyond)
