"""Least and greatest values of a signal so far."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .conventions import SMALL, TRUE, changes, discrete_output, truth

__modelica__ = "Modelica.Blocks.Math"


class _Extrema(ac.Component):
    """Least and greatest value of ``u`` so far, and when they were reached."""

    u = ac.Input(doc="input signal")
    y_min = discrete_output(doc="least value so far")
    y_max = discrete_output(doc="greatest value so far")
    t_min = discrete_output(unit="s", doc="when the least value was reached")
    t_max = discrete_output(unit="s", doc="when the greatest value was reached")

    def _looking(self, now: Any) -> Iterator[ac.Eq]:
        """Look at the input at the start, and where a condition holds."""
        first = ac.initial() > TRUE
        for y, t, extreme in (
            (self.y_min, self.t_min, ac.minimum),
            (self.y_max, self.t_max, ac.maximum),
        ):
            found = ac.where(now, extreme(ac.pre(y), self.u), ac.pre(y))
            new = ac.change(y) & now
            yield ac.Eq(y, ac.where(first, self.u, found))
            yield ac.Eq(t, ac.where(first | new, ac.time, ac.pre(t)))


class SignalExtrema(_Extrema):
    """Least and greatest value at the start and every ``Ts`` [s] after it, and when they were reached."""

    ICON = icons.block("extrema")

    Ts = ac.Parameter(0.01, unit="s", min=SMALL, doc="time between two looks, greater than zero")
    t0 = ac.Discrete(unit="s", doc="start of the simulation")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.t0, ac.where(ac.initial(), ac.time, ac.pre(self.t0)))
        yield from self._looking(ac.sample(self.t0 + self.Ts, self.Ts) > TRUE)


class ContinuousSignalExtrema(_Extrema):
    """Least and greatest value, and when they were reached.

    An extremum is where the input crosses its own lag ``x`` with the time constant ``T`` [s], so it is found as much
    late.
    """

    ICON = icons.block("extr(t)")

    T = ac.Parameter(1e-6, unit="s", min=SMALL, doc="time constant of the lag, greater than zero")
    x = ac.Variable(state="always", doc="the input with a lag")
    above = ac.Discrete(kind="bool", doc="whether the input is above its lag")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), (self.u - self.x) / self.T)
        yield ac.Eq(self.above, truth(self.u > self.x))
        yield from self._looking(changes(self.above))

    def initial_equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.x, self.u)
