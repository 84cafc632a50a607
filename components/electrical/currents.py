"""Current sources. Time counts from ``startTime``, and ``offset`` is added to the signal."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from . import waveforms
from .interfaces import CurrentSource, NegativePin, OnePort, PositivePin

__modelica__ = "Modelica.Electrical.Analog.Sources"


class SignalCurrent(ac.Component):
    """A current given by a signal ``i`` [A]: ``i = p.i = -n.i``, ``v = p.v - n.v`` [V]."""

    ICON = icons.SIGNAL_CURRENT

    p = PositivePin()
    n = NegativePin()
    i = ac.Input(unit="A", doc="current from p to n")
    v = ac.Variable(unit="V", doc="voltage from p to n")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.v, self.p.v - self.n.v)
        yield ac.Eq(0, self.p.i + self.n.i)
        yield ac.Eq(self.i, self.p.i)


class ConstantCurrent(OnePort):
    """``i = I``."""

    ICON = icons.CURRENT

    I = ac.Parameter(unit="A", doc="constant current")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.i, self.I)


class StepCurrent(waveforms.Step, waveforms.Current):
    """``i = offset``, from ``startTime`` on ``i = offset + I``."""

    ICON = icons.current("step")


class RampCurrent(waveforms.Ramp, waveforms.Current):
    """``i`` rises by ``I`` during ``duration`` [s] and stays there."""

    ICON = icons.current("ramp")


class SineCurrent(waveforms.Sine, waveforms.Current):
    """``i = offset + I sin(2 pi f t + phase)`` for ``t = time - startTime >= 0``, else ``offset``."""

    ICON = icons.current("sine")


class CosineCurrent(waveforms.Cosine, waveforms.Current):
    """``i = offset + I cos(2 pi f t + phase)`` for ``t = time - startTime >= 0``, else ``offset``."""

    ICON = icons.current("cosine")


class SineCurrentVariableFrequencyAndAmplitude(waveforms.VariableCurrent):
    """``i = offset + I sin(phi)``, ``der(phi) = 2 pi f``, with inputs ``I`` [A] and ``f`` [Hz].

    ``useConstantAmplitude`` and ``useConstantFrequency`` put parameters in their places.
    """

    ICON = icons.marked(icons.current("sine"), "f, I")

    def _wave(self) -> Any:
        return ac.sin(self.phi)


class CosineCurrentVariableFrequencyAndAmplitude(waveforms.VariableCurrent):
    """``i = offset + I cos(phi)``, ``der(phi) = 2 pi f``, with inputs ``I`` [A] and ``f`` [Hz].

    ``useConstantAmplitude`` and ``useConstantFrequency`` put parameters in their places.
    """

    ICON = icons.marked(icons.current("cosine"), "f, I")

    def _wave(self) -> Any:
        return ac.cos(self.phi)


class ExpSineCurrent(waveforms.ExpSine, waveforms.Current):
    """``i = offset + I exp(-damping t) sin(2 pi f t + phase)``, ``t = time - startTime``."""

    ICON = icons.current("damped")


class ExponentialsCurrent(waveforms.Exponentials, CurrentSource):
    """Rises towards ``iMax`` for ``riseTime`` [s], then falls, both exponentially.

    ``i = offset + iMax (1 - exp(-t/riseTimeConst))``; after ``riseTime`` the value reached decays with
    ``fallTimeConst``.
    """

    ICON = icons.current("exponential")

    iMax = ac.Parameter(unit="A", doc="current after an infinite rise")

    @property
    def _amplitude(self) -> Any:
        return self.iMax


class PulseCurrent(waveforms.Pulse, waveforms.Current):
    """``i = offset + I`` for the first ``width`` per cent of each ``period``, else ``offset``."""

    ICON = icons.current("pulse")


class SawToothCurrent(waveforms.SawTooth, waveforms.Current):
    """``i`` rises from ``offset`` by ``I`` in each ``period``."""

    ICON = icons.current("sawtooth")


class TrapezoidCurrent(waveforms.Trapezoid, waveforms.Current):
    """In each ``period``: ``rising``, at ``offset + I`` for ``width``, ``falling`` [s], then ``offset``."""

    ICON = icons.current("trapezoid")


class TableCurrent(waveforms.Table, CurrentSource):
    """``i`` by linear interpolation in the rows of ``table``: time [s], current [A]."""

    ICON = icons.current("table")
