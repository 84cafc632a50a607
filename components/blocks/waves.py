"""Sines, exponentials and what is made of them."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .conventions import INSTANT
from .interfaces import SO, SignalSource

__modelica__ = "Modelica.Blocks.Sources"


class _Wave(SignalSource):
    """A wave from ``startTime`` on; before, ``y = offset``, or if ``continuous`` its first value."""

    ICON = icons.SINE

    amplitude = ac.Parameter(1.0, doc="amplitude")
    f = ac.Parameter(unit="Hz", doc="frequency")
    phase = ac.Parameter(0.0, unit="rad", doc="phase at startTime")
    continuous = ac.Option(False, doc="whether to hold the first value before startTime")

    def _wave(self, shape: Any) -> ac.Eq:
        t = ac.time - self.startTime
        wave = self.amplitude * shape(2 * ac.pi * self.f * t + self.phase)
        before = self.amplitude * shape(self.phase) if self.continuous else 0
        return ac.Eq(self.y, self.offset + ac.where(t < 0, before, wave, events=None))


class Sine(_Wave):
    """``y = offset + amplitude sin(2 pi f (time - startTime) + phase)`` from ``startTime`` on."""

    def equations(self) -> Iterator[ac.Eq]:
        yield self._wave(ac.sin)


class Cosine(_Wave):
    """``y = offset + amplitude cos(2 pi f (time - startTime) + phase)`` from ``startTime`` on."""

    ICON = icons.COSINE

    def equations(self) -> Iterator[ac.Eq]:
        yield self._wave(ac.cos)


class _VariableWave(SO):
    """A wave whose ``amplitude`` and frequency ``f`` [Hz] are inputs: ``der(phi) = 2 pi f``."""

    ICON = icons.SINE

    useConstantAmplitude = ac.Option(False, doc="whether the amplitude is constantAmplitude")
    constantAmplitude = ac.Parameter(1.0, doc="amplitude without input")
    useConstantFrequency = ac.Option(False, doc="whether the frequency is constantFrequency")
    constantFrequency = ac.Parameter(1.0, unit="Hz", doc="frequency without input")
    offset = ac.Parameter(0.0, doc="offset of the output")
    amplitude = ac.Input(when="not useConstantAmplitude", doc="amplitude")
    f = ac.Input(unit="Hz", when="not useConstantFrequency", doc="frequency")
    phi = ac.Variable(unit="rad", doc="phase; its start is the initial phase")

    def equations(self) -> Iterator[ac.Eq]:
        f = self.constantFrequency if self.useConstantFrequency else self.f
        yield ac.Eq(ac.der(self.phi), 2 * ac.pi * f)
        yield ac.Eq(self.y, self.offset + self._amplitude * self._wave())

    @property
    def _amplitude(self) -> Any:
        return self.constantAmplitude if self.useConstantAmplitude else self.amplitude

    def _wave(self) -> Any:
        raise NotImplementedError


class SineVariableFrequencyAndAmplitude(_VariableWave):
    """``y = offset + amplitude sin(phi)``, ``der(phi) = 2 pi f``, with inputs ``amplitude``, ``f``."""

    ICON = icons.marked(icons.SINE, "f")

    def _wave(self) -> Any:
        return ac.sin(self.phi)


class CosineVariableFrequencyAndAmplitude(_VariableWave):
    """``y = offset + amplitude cos(phi)``, ``der(phi) = 2 pi f``, with inputs ``amplitude``, ``f``."""

    ICON = icons.marked(icons.COSINE, "f")

    def _wave(self) -> Any:
        return ac.cos(self.phi)


class Sinc(SignalSource):
    """``y = offset + amplitude sin(x)/x`` with ``x = 2 pi f (time - startTime)``."""

    ICON = icons.SINC

    amplitude = ac.Parameter(1.0, doc="amplitude")
    f = ac.Parameter(unit="Hz", doc="frequency")

    def equations(self) -> Iterator[ac.Eq]:
        t = ac.time - self.startTime
        x = 2 * ac.pi * ac.maximum(ac.Abs(self.f), INSTANT) * ac.maximum(t, INSTANT)
        sinc = self.amplitude * ac.sin(x) / x
        yield ac.Eq(self.y, self.offset + ac.where(t < 0, 0, sinc, events=None))


class ExpSine(SignalSource):
    """``y = offset + amplitude exp(-damping t) sin(2 pi f t + phase)``, ``t = time - startTime``."""

    ICON = icons.DAMPED

    amplitude = ac.Parameter(1.0, doc="amplitude")
    f = ac.Parameter(unit="Hz", doc="frequency")
    phase = ac.Parameter(0.0, unit="rad", doc="phase at startTime")
    damping = ac.Parameter(unit="1/s", doc="decay of the amplitude")

    def equations(self) -> Iterator[ac.Eq]:
        t = ac.maximum(ac.time - self.startTime, 0)
        sine = ac.sin(2 * ac.pi * self.f * t + self.phase)
        wave = self.amplitude * ac.exp(-self.damping * t) * sine
        before = ac.time < self.startTime
        yield ac.Eq(self.y, self.offset + ac.where(before, 0, wave, events=None))


class Exponentials(SignalSource):
    """Rises towards ``outMax`` for ``riseTime`` [s], then falls, both exponentially.

    ``outMax (1 - exp(-t/riseTimeConst))`` for ``t = time - startTime < riseTime``; after that the value
    reached decays with ``fallTimeConst`` (default: ``riseTimeConst``).
    """

    ICON = icons.DECAY

    outMax = ac.Parameter(1.0, doc="height for an infinite rise time")
    riseTime = ac.Parameter(unit="s", min=0, doc="rise time")
    riseTimeConst = ac.Parameter(0.1, unit="s", min=0, doc="time constant of the rise")
    fallTimeConst = ac.Parameter(
        lambda self: self.riseTimeConst, unit="s", min=0, doc="time constant of the fall"
    )

    def equations(self) -> Iterator[ac.Eq]:
        t = ac.maximum(ac.time - self.startTime, 0)
        rise, fall = (ac.maximum(T, INSTANT) for T in (self.riseTimeConst, self.fallTimeConst))
        risen = self.outMax * (1 - ac.exp(-ac.minimum(t, self.riseTime) / rise))
        fall = ac.exp(-ac.maximum(t - self.riseTime, 0) / fall)
        yield ac.Eq(self.y, self.offset + risen * fall)
