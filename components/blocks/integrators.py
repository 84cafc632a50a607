"""Integrators and derivatives."""

from collections.abc import Iterator

import acausal as ac

from .conventions import INIT
from .interfaces import SISO, PartialStart, PartialState

__modelica__ = "Modelica.Blocks.Continuous"


class Integrator(SISO, PartialStart):
    """``der(y) = k u``, from ``y = y_start``. There is no reset: that needs events."""

    k = ac.Parameter(1.0, doc="gain")
    use_reset = ac.Option(False, choices=(False,), doc="reset is not available")
    use_set = ac.Option(False, choices=(False,), doc="reset is not available")
    initType = ac.Option("InitialState", choices=INIT, doc="type of initialization")
    y = ac.Output(start="y_start", doc="output signal")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.y), self.k * self.u)


class LimIntegrator(SISO, PartialStart):
    """Integrator that stops at limits: ``der(y) = k u``, but 0 where that leads out of them.

    ``outMin`` (default ``-outMax``) and ``outMax`` bound ``y``. There is no reset; ``strict`` and
    ``limitsAtInit`` have no effect.
    """

    k = ac.Parameter(1.0, doc="gain")
    outMax = ac.Parameter(doc="upper limit")
    outMin = ac.Parameter(lambda self: -self.outMax, doc="lower limit")
    use_reset = ac.Option(False, choices=(False,), doc="reset is not available")
    use_set = ac.Option(False, choices=(False,), doc="reset is not available")
    initType = ac.Option("InitialState", choices=INIT, doc="type of initialization")
    limitsAtInit = ac.Option(True, doc="without effect")
    strict = ac.Option(False, doc="without effect")
    y = ac.Output(start="y_start", doc="output signal")

    def equations(self) -> Iterator[ac.Eq]:
        rate = self.k * self.u
        upwards = ac.where(self.y > self.outMax, ac.minimum(rate, 0), rate)
        yield ac.Eq(ac.der(self.y), ac.where(self.y < self.outMin, ac.maximum(rate, 0), upwards))


class Derivative(SISO, PartialState):
    """Approximate derivative ``k s/(T s + 1)``: ``y = k (u - x)/T``, ``der(x) = (u - x)/T``."""

    k = ac.Parameter(1.0, doc="gain")
    T = ac.Parameter(0.01, unit="s", min=0, doc="time constant, greater than zero")
    initType = ac.Option("NoInit", choices=INIT, doc="type of initialization")
    x_start = ac.Parameter(0.0, doc="initial or guess value of the state")
    y_start = ac.Parameter(0.0, doc="initial value of the output")
    x = ac.Variable(start="x_start", doc="state: the input, delayed")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.x), (self.u - self.x) / self.T)
        yield ac.Eq(self.y, self.k * (self.u - self.x) / self.T)


class Der(SISO):
    """``y = der(u)``: the input must be differentiable in the model."""

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.der(self.u))
