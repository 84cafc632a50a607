"""Mean, variance and standard deviation of a signal since the start."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .interfaces import SISO

__modelica__ = "Modelica.Blocks.Math"


class ContinuousMean(SISO):
    """Mean of the input since ``t_0`` [s]: ``der(mu) = (u - mu)/(time - t_0)``, ``y = mu``.

    During the first ``t_eps`` [s] the output is the input. ``t_0``, Modelica's start time of the
    simulation, is a parameter here.
    """

    ICON = icons.block("mean(t)")

    t_eps = ac.Parameter(1e-7, unit="s", min=0, doc="averaging begins so long after t_0")
    t_0 = ac.Parameter(0.0, unit="s", doc="start time")
    mu = ac.Variable(doc="mean of the input", state="prefer")

    def equations(self) -> Iterator[ac.Eq]:
        begun = ac.time >= self.t_0 + self.t_eps
        elapsed = ac.maximum(ac.time - self.t_0, self.t_eps)
        yield ac.Eq(ac.der(self.mu), ac.where(begun, (self.u - self.mu) / elapsed, 0))
        yield ac.Eq(self.y, ac.where(begun, self.mu, self.u))

    def initial_equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.mu, self.u)


class Variance(SISO):
    """Variance of the input since ``t_0`` [s] about its mean ``mu``, as of `ContinuousMean`.

    ``der(var) = ((u - mu)**2 - var)/(time - t_0)``, ``y = max(var, 0)``; it is 0 during the first
    ``t_eps`` [s].
    """

    ICON = icons.block("σ²")

    t_eps = ac.Parameter(1e-7, unit="s", min=0, doc="averaging begins so long after t_0")
    t_0 = ac.Parameter(0.0, unit="s", doc="start time")
    mu = ac.Variable(doc="mean of the input", state="prefer")
    var = ac.Variable(fixed=True, doc="variance of the input", state="prefer")

    def equations(self) -> Iterator[ac.Eq]:
        begun = ac.time >= self.t_0 + self.t_eps
        elapsed = ac.maximum(ac.time - self.t_0, self.t_eps)
        deviation = self.u - self.mu
        yield ac.Eq(ac.der(self.mu), ac.where(begun, deviation / elapsed, 0))
        yield ac.Eq(ac.der(self.var), ac.where(begun, (deviation**2 - self.var) / elapsed, 0))
        yield from self._output(ac.where(begun, ac.maximum(self.var, 0), 0))

    def _output(self, variance: Any) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, variance)

    def initial_equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.mu, self.u)


class StandardDeviation(Variance):
    """Square root of the `Variance` of the input since ``t_0`` [s]."""

    ICON = icons.block("σ")

    def _output(self, variance: Any) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.sqrt(variance))
