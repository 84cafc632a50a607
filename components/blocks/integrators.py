"""Integrators and derivatives."""

from collections.abc import Callable, Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .conventions import CROSSED, INIT, TRUE
from .interfaces import SISO, PartialStart, PartialState

__modelica__ = "Modelica.Blocks.Continuous"


class _Resettable(SISO, PartialStart):
    """What integrators share: their output can be reset."""

    use_reset = ac.Option(False, doc="whether there is the input reset")
    use_set = ac.Option(False, doc="whether there is the input set")
    reset = ac.Input(when="use_reset", doc="when the output is reset")
    set = ac.Input(when="_has_set", doc="what it is reset to")
    y = ac.Output(start="y_start", state="_kind", doc="output signal")

    @property
    def _has_set(self) -> bool:
        return self.use_reset and self.use_set

    @property
    def _kind(self) -> str:
        return "always" if self.use_reset else "default"

    def _resetting(self, limited: Callable[[Any], Any]) -> Iterator[Any]:
        """The reset, to a limited value."""
        if self.use_reset:
            value = self.set if self.use_set else self.y_start
            yield ac.When(self.reset > TRUE, ac.Reinit(self.y, limited(value)))


class Integrator(_Resettable):
    """``der(y) = k u``, from ``y = y_start``.

    With ``use_reset`` the output becomes ``y_start`` where ``reset`` turns true, or with ``use_set`` the input
    ``set``.
    """

    ICON = icons.INTEGRATOR

    k = ac.Parameter(1.0, doc="gain")
    initType = ac.Option("InitialState", choices=INIT, doc="type of initialization")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.y), self.k * self.u)
        yield from self._resetting(lambda value: value)


class LimIntegrator(_Resettable):
    """Integrator that stops at limits: ``der(y) = k u``, but 0 where that leads out of them.

    ``outMin`` (default ``-outMax``) and ``outMax`` bound ``y``, also where it is reset as an `Integrator`'s;
    ``strict`` and ``limitsAtInit`` have no effect.
    """

    ICON = icons.marked(icons.INTEGRATOR, "lim")

    k = ac.Parameter(1.0, doc="gain")
    outMax = ac.Parameter(doc="upper limit")
    outMin = ac.Parameter(lambda self: -self.outMax, doc="lower limit")
    initType = ac.Option("InitialState", choices=INIT, doc="type of initialization")
    limitsAtInit = ac.Option(True, doc="without effect")
    strict = ac.Option(False, doc="without effect")

    def equations(self) -> Iterator[Any]:
        yield ac.Assert(self.outMin <= self.outMax, CROSSED)
        rate = self.k * self.u
        upwards = ac.where(self.y > self.outMax, ac.minimum(rate, 0), rate)
        yield ac.Eq(ac.der(self.y), ac.where(self.y < self.outMin, ac.maximum(rate, 0), upwards))
        yield from self._resetting(lambda v: ac.maximum(ac.minimum(v, self.outMax), self.outMin))


class Derivative(SISO, PartialState):
    """Approximate derivative ``k s/(T s + 1)``: ``y = k (u - x)/T``, ``der(x) = (u - x)/T``."""

    ICON = icons.DERIVATIVE

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

    ICON = icons.block("du/dt")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.der(self.u))
