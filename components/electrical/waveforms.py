"""Signals of sources: which block, and under which names a voltage or current source has its parameters."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import blocks, icons
from acausal.components.blocks.conventions import SMALL

from .interfaces import CurrentSource, OnePort, VoltageSource


class Voltage(VoltageSource):
    """A voltage source with the amplitude ``V``."""

    V = ac.Parameter(unit="V", doc="amplitude")

    @property
    def _amplitude(self) -> Any:
        return self.V


class Current(CurrentSource):
    """A current source with the amplitude ``I``."""

    I = ac.Parameter(unit="A", doc="amplitude")

    @property
    def _amplitude(self) -> Any:
        return self.I


class Waveform(ac.Component):
    """The signal of a source: the parameters that it adds, and in ``_signal`` the block.

    It comes before the source among the bases; the source has the ``_amplitude``.
    """

    _amplitude: Any


class Step(Waveform):
    """A step at ``startTime``."""

    def _signal(self) -> ac.Component:
        return blocks.Step(height=self._amplitude)


class Ramp(Waveform):
    """A rise during ``duration``."""

    duration = ac.Parameter(unit="s", min=0, doc="duration of the ramp")

    def _signal(self) -> ac.Component:
        return blocks.Ramp(height=self._amplitude, duration=self.duration)


class Sine(Waveform):
    """A sine."""

    phase = ac.Parameter(0.0, unit="rad", doc="phase at startTime")
    f = ac.Parameter(unit="Hz", doc="frequency")

    def _signal(self) -> ac.Component:
        return blocks.Sine(amplitude=self._amplitude, f=self.f, phase=self.phase)


class Cosine(Waveform):
    """A cosine."""

    phase = ac.Parameter(0.0, unit="rad", doc="phase at startTime")
    f = ac.Parameter(unit="Hz", doc="frequency")

    def _signal(self) -> ac.Component:
        return blocks.Cosine(amplitude=self._amplitude, f=self.f, phase=self.phase)


class ExpSine(Waveform):
    """A sine that decays."""

    f = ac.Parameter(unit="Hz", doc="frequency")
    phase = ac.Parameter(0.0, unit="rad", doc="phase at startTime")
    damping = ac.Parameter(unit="1/s", doc="decay of the amplitude")

    def _signal(self) -> ac.Component:
        return blocks.ExpSine(
            amplitude=self._amplitude, f=self.f, phase=self.phase, damping=self.damping
        )


class Exponentials(Waveform):
    """An exponential rise and fall."""

    riseTime = ac.Parameter(unit="s", min=0, doc="rise time")
    riseTimeConst = ac.Parameter(unit="s", min=0, doc="time constant of the rise")
    fallTimeConst = ac.Parameter(unit="s", min=0, doc="time constant of the fall")

    def _signal(self) -> ac.Component:
        return blocks.Exponentials(
            outMax=self._amplitude,
            riseTime=self.riseTime,
            riseTimeConst=self.riseTimeConst,
            fallTimeConst=self.fallTimeConst,
        )


class Pulse(Waveform):
    """Pulses of ``width`` per cent of the ``period``."""

    width = ac.Parameter(min=0, max=100, doc="width of the pulse in per cent of the period")
    period = ac.Parameter(unit="s", min=SMALL, doc="duration of one period")

    def _signal(self) -> ac.Component:
        return blocks.Pulse(amplitude=self._amplitude, width=self.width, period=self.period)


class SawTooth(Waveform):
    """A rise in each ``period``."""

    period = ac.Parameter(unit="s", min=SMALL, doc="duration of one period")

    def _signal(self) -> ac.Component:
        return blocks.SawTooth(amplitude=self._amplitude, period=self.period)


class Trapezoid(Waveform):
    """A rise, a plateau and a fall in each ``period``."""

    rising = ac.Parameter(unit="s", min=0, doc="duration of the rise")
    width = ac.Parameter(unit="s", min=0, doc="duration at the amplitude")
    falling = ac.Parameter(unit="s", min=0, doc="duration of the fall")
    period = ac.Parameter(unit="s", min=SMALL, doc="duration of one period")
    nperiod = ac.Option(-1, doc="number of periods; endless if negative")

    forwarded = ("nperiod",)

    def _signal(self) -> ac.Component:
        return blocks.Trapezoid(
            amplitude=self._amplitude,
            rising=self.rising,
            width=self.width,
            falling=self.falling,
            period=self.period,
        )


class Table(Waveform):
    """Linear interpolation in rows of time and value."""

    table = ac.Option([[0, 0], [1, 1], [2, 4]], doc="rows of time [s] and value")

    forwarded = ("table",)

    def _signal(self) -> ac.Component:
        return blocks.TimeTable()


class VariableWave(OnePort):
    """A sine whose frequency ``f`` and amplitude are inputs: ``der(phi) = 2 pi f``.

    The start of ``phi`` is the initial phase.
    """

    useConstantAmplitude = ac.Option(False, doc="whether the amplitude is constantAmplitude")
    useConstantFrequency = ac.Option(False, doc="whether the frequency is constantFrequency")
    constantFrequency = ac.Parameter(1.0, unit="Hz", doc="frequency without input")
    f = ac.Input(unit="Hz", when="not useConstantFrequency", doc="frequency")
    phi = ac.Variable(unit="rad", doc="phase")

    @property
    def _source(self) -> Any:
        """The voltage or current."""
        raise NotImplementedError

    @property
    def _input(self) -> Any:
        """The input for the amplitude."""
        raise NotImplementedError

    def _wave(self) -> Any:
        """The function of the phase."""
        raise NotImplementedError

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        f = self.constantFrequency if self.useConstantFrequency else self.f
        amplitude = self.constantAmplitude if self.useConstantAmplitude else self._input
        yield ac.Eq(ac.der(self.phi), 2 * ac.pi * f)
        yield ac.Eq(self._source, self.offset + amplitude * self._wave())


class VariableVoltage(VariableWave):
    """A voltage with the amplitude ``V`` as input."""

    ICON = icons.voltage("sine")

    constantAmplitude = ac.Parameter(1.0, unit="V", doc="amplitude without input")
    offset = ac.Parameter(0.0, unit="V", doc="offset of the voltage")
    V = ac.Input(unit="V", when="not useConstantAmplitude", doc="amplitude")

    @property
    def _source(self) -> Any:
        return self.v

    @property
    def _input(self) -> Any:
        return self.V


class VariableCurrent(VariableWave):
    """A current with the amplitude ``I`` as input."""

    ICON = icons.current("sine")

    constantAmplitude = ac.Parameter(1.0, unit="A", doc="amplitude without input")
    offset = ac.Parameter(0.0, unit="A", doc="offset of the current")
    I = ac.Input(unit="A", when="not useConstantAmplitude", doc="amplitude")

    @property
    def _source(self) -> Any:
        return self.i

    @property
    def _input(self) -> Any:
        return self.I
