"""Voltage sources. Time counts from ``startTime``, and ``offset`` is added to the signal."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from . import waveforms
from .interfaces import NegativePin, OnePort, PositivePin, VoltageSource

__modelica__ = "Modelica.Electrical.Analog.Sources"


class SignalVoltage(ac.Component):
    """A voltage given by a signal ``v`` [V]: ``v = p.v - n.v``, ``i = p.i`` [A]."""

    ICON = icons.SIGNAL_VOLTAGE

    p = PositivePin()
    n = NegativePin()
    v = ac.Input(unit="V", doc="voltage from p to n")
    i = ac.Variable(unit="A", doc="current from p to n")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.v, self.p.v - self.n.v)
        yield ac.Eq(0, self.p.i + self.n.i)
        yield ac.Eq(self.i, self.p.i)


class ConstantVoltage(OnePort):
    """``v = V``."""

    ICON = icons.VOLTAGE

    V = ac.Parameter(unit="V", doc="constant voltage")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, self.V)


class StepVoltage(waveforms.Step, waveforms.Voltage):
    """``v = offset``, from ``startTime`` on ``v = offset + V``."""

    ICON = icons.voltage("step")


class RampVoltage(waveforms.Ramp, waveforms.Voltage):
    """``v`` rises by ``V`` during ``duration`` [s] and stays there."""

    ICON = icons.voltage("ramp")


class SineVoltage(waveforms.Sine, waveforms.Voltage):
    """``v = offset + V sin(2 pi f t + phase)`` for ``t = time - startTime >= 0``, else ``offset``."""

    ICON = icons.voltage("sine")


class CosineVoltage(waveforms.Cosine, waveforms.Voltage):
    """``v = offset + V cos(2 pi f t + phase)`` for ``t = time - startTime >= 0``, else ``offset``."""

    ICON = icons.voltage("cosine")


class SineVoltageVariableFrequencyAndAmplitude(waveforms.VariableVoltage):
    """``v = offset + V sin(phi)``, ``der(phi) = 2 pi f``, with inputs ``V`` [V] and ``f`` [Hz].

    ``useConstantAmplitude`` and ``useConstantFrequency`` put parameters in their places.
    """

    ICON = icons.marked(icons.voltage("sine"), "f, V")

    def _wave(self) -> Any:
        return ac.sin(self.phi)


class CosineVoltageVariableFrequencyAndAmplitude(waveforms.VariableVoltage):
    """``v = offset + V cos(phi)``, ``der(phi) = 2 pi f``, with inputs ``V`` [V] and ``f`` [Hz].

    ``useConstantAmplitude`` and ``useConstantFrequency`` put parameters in their places.
    """

    ICON = icons.marked(icons.voltage("cosine"), "f, V")

    def _wave(self) -> Any:
        return ac.cos(self.phi)


class ExpSineVoltage(waveforms.ExpSine, waveforms.Voltage):
    """``v = offset + V exp(-damping t) sin(2 pi f t + phase)``, ``t = time - startTime``."""

    ICON = icons.voltage("damped")


class ExponentialsVoltage(waveforms.Exponentials, VoltageSource):
    """Rises towards ``vMax`` for ``riseTime`` [s], then falls, both exponentially.

    ``v = offset + vMax (1 - exp(-t/riseTimeConst))``; after ``riseTime`` the value reached decays with
    ``fallTimeConst``.
    """

    ICON = icons.voltage("exponential")

    vMax = ac.Parameter(unit="V", doc="voltage after an infinite rise")

    @property
    def _amplitude(self) -> Any:
        return self.vMax


class PulseVoltage(waveforms.Pulse, waveforms.Voltage):
    """``v = offset + V`` for the first ``width`` per cent of each ``period``, else ``offset``."""

    ICON = icons.voltage("pulse")


class SawToothVoltage(waveforms.SawTooth, waveforms.Voltage):
    """``v`` rises from ``offset`` by ``V`` in each ``period``."""

    ICON = icons.voltage("sawtooth")


class TrapezoidVoltage(waveforms.Trapezoid, waveforms.Voltage):
    """In each ``period``: ``rising``, at ``offset + V`` for ``width``, ``falling`` [s], then ``offset``."""

    ICON = icons.voltage("trapezoid")


class TableVoltage(waveforms.Table, VoltageSource):
    """``v`` by linear interpolation in the rows of ``table``: time [s], voltage [V]."""

    ICON = icons.voltage("table")


class SupplyVoltage(ac.Component):
    """Two constant voltages: ``Vps`` from ``ground`` to ``pin_p``, ``Vns`` from ``ground`` to ``pin_n``."""

    ICON = icons.SUPPLY

    Vps = ac.Parameter(15.0, unit="V", doc="positive supply")
    Vns = ac.Parameter(-15.0, unit="V", doc="negative supply")
    pin_p = PositivePin()
    pin_n = NegativePin()
    ground = NegativePin()

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.positiveSupply = ConstantVoltage(V=self.Vps)
        self.negativeSupply = ConstantVoltage(V=-self.Vns)
        self.connect(self.pin_p, self.positiveSupply.p)
        self.connect(self.positiveSupply.n, self.ground, self.negativeSupply.p)
        self.connect(self.negativeSupply.n, self.pin_n)


class DCPowerSupply(OnePort):
    """A supply of the laboratory: constant voltage, constant power, or constant current, whichever gives the least.

    Delivered is ``-i``, the least of ``(V0 - v)/Rcv``, ``P0/v`` and ``I0 - Gcc v``. It works for ``v > 0`` and takes
    hardly any current back.
    """

    ICON = icons.marked(icons.VOLTAGE, "DC")

    V0 = ac.Parameter(60.0, unit="V", min=0, doc="voltage without load")
    I0 = ac.Parameter(50.0, unit="A", min=0, doc="current of a short circuit")
    P0 = ac.Parameter(1200.0, unit="W", min=0, doc="greatest power")
    Rcv = ac.Parameter(1e-3, unit="Ohm", min=0, doc="inner resistance at constant voltage")
    Gcc = ac.Parameter(1e-3, unit="S", min=0, doc="inner conductance at constant current")
    iBack = ac.Option(1e-3, doc="without effect")
    v = ac.Variable(start="V0", unit="V", doc="voltage from p to n")
    P = ac.Variable(unit="W", doc="power, negative where it is delivered")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        by_voltage, by_current = (self.V0 - self.v) / self.Rcv, self.I0 - self.Gcc * self.v
        by_power = self.P0 / ac.maximum(self.v, self.P0 / (2 * self.I0))
        yield ac.Eq(self.i, -ac.minimum(ac.minimum(by_voltage, by_current), by_power))
        yield ac.Eq(self.P, self.v * self.i)
