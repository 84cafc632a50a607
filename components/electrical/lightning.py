"""Lightning impulses: the shapes of standards, from rise time and decay time."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from scipy.optimize import root

import acausal as ac
from acausal.components import blocks, icons

from . import waveforms

__modelica__ = "Modelica.Electrical.Analog.Sources"

_SHAPES = ("Heidler", "DoubleExp")


class LightningImpulse(blocks.SignalSource):
    """An impulse of the height ``amplitude`` by Heidler's function, or by two exponentials.

    ``y = offset + amplitude/eta s(time - startTime)`` with ``s(t) = r/(1 + r) exp(-t/tau2)``, ``r = (t/tau1)**m``, or
    ``s(t) = exp(-t/tau1) - exp(-t/tau2)``. A line through 10 and 90 per cent of the rise starts at zero and reaches the
    amplitude after ``T1`` [s]; ``T2`` [s] after that zero the output has fallen to a half. ``tau1``, ``tau2`` and
    ``eta`` follow from these, and are fixed when the source is made. Two exponentials need ``T1 < 0.2 T2``.
    """

    ICON = icons.LIGHTNING

    approximation = ac.Option("Heidler", choices=_SHAPES, doc="approximation of the impulse")
    amplitude = ac.Parameter(doc="height of the impulse")
    T1 = ac.Option(10e-6, doc="rise time in s")
    T2 = ac.Option(350e-6, doc="time in s until it has fallen to a half")
    m = ac.Option(5, doc="exponent of Heidler's function, 5 to 10")

    def equations(self) -> Iterator[ac.Eq]:
        T1, T2, m = float(self.T1), float(self.T2), int(self.m)
        if not 0 < T1 < T2 or (self.approximation == "DoubleExp" and T1 >= 0.2 * T2):
            raise ac.DeclarationError(
                f"{type(self).__name__}: T1={T1:g} and T2={T2:g} must be positive with T1 < T2, "
                "and T1 < 0.2*T2 for two exponentials"
            )
        tau1, tau2, eta = _constants(self.approximation, T1, T2, m)
        t = ac.maximum(ac.time - self.startTime, 0)
        shape = _shape(self.approximation, ac.exp, t, tau1, tau2, m)
        yield ac.Eq(self.y, self.offset + self.amplitude / eta * shape)


def _shape(kind: str, exp: Any, t: Any, tau1: Any, tau2: Any, m: int) -> Any:
    if kind == "DoubleExp":
        return exp(-t / tau1) - exp(-t / tau2)
    r = (t / tau1) ** m
    return r / (1 + r) * exp(-t / tau2)


def _constants(kind: str, T1: float, T2: float, m: int) -> tuple[float, float, float]:
    """Time constants and height of the shape.

    Unknowns are the logarithms of both time constants and of the times of 10 per cent and of the maximum, over T1.
    """
    double = kind == "DoubleExp"

    def shape(t: Any, tau1: Any, tau2: Any) -> Any:
        return _shape(kind, np.exp, t, tau1, tau2, m)

    def residuals(logarithms: Any) -> list[Any]:
        tau1, tau2, start, top = T1 * np.exp(logarithms)
        eta = shape(top, tau1, tau2)
        if double:
            flat = np.log(tau1 / tau2) + top / tau1 - top / tau2
        else:
            flat = np.log(m * tau2 / top) - np.log1p((top / tau1) ** m)
        at = lambda t: shape(t, tau1, tau2) / eta  # noqa: E731
        return [
            flat,
            np.log(at(start) / 0.1),
            np.log(at(start + 0.8 * T1) / 0.9),
            np.log(at(start - 0.1 * T1 + T2) / 0.5),
        ]

    if double:
        top = T2 * T1 / (T2 - T1) * np.log(T2 / T1)
        guess = np.array([1.4 * T2, T1 / 2.5, 0.05 * T1, top])
    else:
        top = T1 * (m * T2 / T1) ** (1 / (m + 1))
        guess = np.array([T1, T2, T1 / 2, top])
    found = root(residuals, np.log(guess / T1), tol=1e-13)
    if np.abs(found.fun).max() > 1e-9:
        raise ac.DeclarationError(f"no impulse of the kind {kind} has T1={T1:g} and T2={T2:g}")
    tau1, tau2, _, top = T1 * np.exp(found.x)
    return float(tau1), float(tau2), float(shape(top, tau1, tau2))


class _Lightning(waveforms.Waveform):
    """An impulse as of lightning."""

    approximation = ac.Option("Heidler", choices=_SHAPES, doc="approximation of the impulse")
    T1 = ac.Option(10e-6, doc="rise time in s")
    T2 = ac.Option(350e-6, doc="time in s until it has fallen to a half")
    m = ac.Option(5, doc="exponent of Heidler's function, 5 to 10")

    forwarded = ("approximation", "T1", "T2", "m")

    def _signal(self) -> ac.Component:
        return LightningImpulse(amplitude=self._amplitude)


class LightningImpulseVoltage(_Lightning, waveforms.Voltage):
    """``v`` is an impulse of the height ``V``, see `LightningImpulse`."""

    ICON = icons.voltage("lightning")


class LightningImpulseCurrent(_Lightning, waveforms.Current):
    """``i`` is an impulse of the height ``I``, see `LightningImpulse`."""

    ICON = icons.current("lightning")
