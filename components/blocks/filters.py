"""Analog filters of any order, as cascades of first and second order."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

import acausal as ac
from acausal.components import icons

from .conventions import INIT
from .interfaces import SISO
from .prototypes import CHARACTERISTICS, poles

__modelica__ = "Modelica.Blocks.Continuous"


_FILTER_TYPE = ("LowPass", "HighPass", "BandPass", "BandStop")


class _Pair(NamedTuple):
    """Conjugate poles ``a +- j b``; ``c`` scales the numerator ``c s`` of a band pass."""

    a: Any
    b: Any
    c: Any = 0

    @property
    def ku(self) -> Any:
        """Gain of the input: the section's gain at zero frequency is 1."""
        return (self.a**2 + self.b**2) / self.b


def _split(p: complex, width: Any, middle: Any, size: float) -> list[_Pair]:
    """The two pairs of poles that a prototype's pole becomes in a band; equal ones for a real pole.

    With ``q = p width`` they are ``middle`` times the roots of ``s**2 - q s + 1``.
    """
    x, y = p.real * width, p.imag * width
    difference = x**2 - y**2 - 4
    m = ac.sqrt((ac.sqrt(difference**2 + 4 * x**2 * y**2) - difference) / 2)
    shift = -x * y / m
    return [
        _Pair((x + shift) / 2 * middle, (m - y) / 2 * middle, size * width * middle),
        _Pair((x - shift) / 2 * middle, (m + y) / 2 * middle, size * width * middle),
    ]


class CriticalDamping(SISO):
    """``n`` equal lags in series with the cut-off frequency ``f`` [Hz].

    ``der(x[i]) = (x[i-1] - x[i]) w`` with ``x[0] = u``, ``y = x[n]``; ``w = 2 pi f/alpha``, where
    ``alpha = sqrt(2**(1/n) - 1)`` makes the amplitude -3 dB at ``f``, or 1 if not ``normalized``.
    """

    ICON = icons.marked(icons.LAG, "n")

    n = ac.Option(2, min=1, doc="order of the filter")
    f = ac.Parameter(unit="Hz", doc="cut-off frequency")
    normalized = ac.Option(True, doc="whether the amplitude at f is -3 dB")
    initType = ac.Option("NoInit", choices=INIT, doc="type of initialization")
    x_start = ac.Parameter(0.0, shape="n", doc="initial or guess values of the states")
    y_start = ac.Parameter(0.0, doc="initial value of the output")
    x = ac.Variable(shape="n", start="x_start", doc="states")

    def equations(self) -> Iterator[ac.Eq]:
        alpha = np.sqrt(2 ** (1 / len(self.x)) - 1) if self.normalized else 1
        w = 2 * ac.pi * self.f / alpha
        for before, x in zip((self.u, *self.x), self.x, strict=False):
            yield ac.Eq(ac.der(x), (before - x) * w)
        yield ac.Eq(self.y, self.x[-1])

    def initial_equations(self) -> Iterator[ac.Eq]:
        yield from _start(self.initType, self.x, self.x_start, self.y, self.y_start)


class LowpassButterworth(SISO):
    """Butterworth low pass of order ``n`` with the cut-off frequency ``f`` [Hz].

    Sections of second order, ``der(x1) = x2``, ``der(x2) = w**2 (z - x1) - 2 D w x2`` with
    ``w = 2 pi f``, then for an odd order ``der(xr) = w (z - xr)``; ``z`` is what comes from before.
    """

    ICON = icons.marked(icons.LOW_PASS, "n")

    n = ac.Option(2, min=1, doc="order of the filter")
    f = ac.Parameter(unit="Hz", doc="cut-off frequency")
    initType = ac.Option("NoInit", choices=INIT, doc="type of initialization")
    x1_start = ac.Parameter(
        0.0, shape="m", doc="initial or guess values of the outputs of sections"
    )
    x2_start = ac.Parameter(0.0, shape="m", doc="initial or guess values of their derivatives")
    xr_start = ac.Parameter(0.0, doc="initial or guess value of the real pole's state")
    y_start = ac.Parameter(0.0, doc="initial value of the output")
    x1 = ac.Variable(shape="m", start="x1_start", doc="outputs of the sections")
    x2 = ac.Variable(shape="m", start="x2_start", doc="their derivatives")
    xr = ac.Variable(start="xr_start", doc="state of the real pole; 0 for an even order")

    @property
    def m(self) -> int:
        """Number of sections of second order."""
        return int(self.n) // 2

    @property
    def _odd(self) -> bool:
        return int(self.n) % 2 == 1

    def equations(self) -> Iterator[ac.Eq]:
        w = 2 * ac.pi * self.f
        z = self.u
        for i, (x1, x2) in enumerate(zip(self.x1, self.x2, strict=True)):
            damping = -np.cos(np.pi * (0.5 + (i + 0.5) / int(self.n)))
            yield ac.Eq(ac.der(x1), x2)
            yield ac.Eq(ac.der(x2), w**2 * (z - x1) - 2 * damping * w * x2)
            z = x1
        yield ac.Eq(ac.der(self.xr), w * (z - self.xr)) if self._odd else ac.Eq(self.xr, 0)
        yield ac.Eq(self.y, self.xr if self._odd else z)

    def initial_equations(self) -> Iterator[ac.Eq]:
        real = [(self.xr, self.xr_start)] if self._odd else []
        sections = zip((*self.x1, *self.x2), (*self.x1_start, *self.x2_start), strict=True)
        match self.initType:
            case "SteadyState":
                yield from (ac.Eq(ac.der(x), 0) for x, _ in (*sections, *real))
            case "InitialState":
                yield from (ac.Eq(x, start) for x, start in (*sections, *real))
            case "InitialOutput":
                yield ac.Eq(self.y, self.y_start)
                yield from (ac.Eq(ac.der(x), 0) for x in self.x1)
                steady = self.x2 if self._odd else self.x2[:-1]
                yield from (ac.Eq(ac.der(x), 0) for x in steady)
            case _:
                pass


class Filter(SISO):
    """Low pass, high pass, band pass or band stop of any order.

    ``analogFilter``: ``CriticalDamping``, ``Bessel``, ``Butterworth`` or ``ChebyshevI`` with a ripple of
    ``A_ripple`` [dB]; ``filterType``: ``LowPass``, ``HighPass``, ``BandPass`` or ``BandStop``, from
    ``f_min`` to ``f_cut`` [Hz]. ``normalized`` makes the amplitude -3 dB at the cut-off. It is a cascade
    of poles ``r``: ``der(x) = r (x - z)``, and of conjugate pairs ``a +- j b``:
    ``der(x1) = a x1 - b x2 + (a**2 + b**2)/b z``, ``der(x2) = b x1 + a x2``; ``z`` comes from before.
    By default it starts in steady state. ``A_ripple`` is fixed when the filter is made.
    """

    ICON = icons.LOW_PASS

    analogFilter = ac.Option("CriticalDamping", choices=CHARACTERISTICS, doc="characteristic")
    filterType = ac.Option("LowPass", choices=_FILTER_TYPE, doc="type of the filter")
    order = ac.Option(2, doc="order of the low pass it is made from")
    f_cut = ac.Parameter(unit="Hz", min=0, doc="cut-off frequency")
    gain = ac.Parameter(1.0, doc="amplitude in the pass band")
    A_ripple = ac.Option(0.5, doc="ripple of the pass band of ChebyshevI in dB")
    f_min = ac.Parameter(0.0, unit="Hz", min=0, doc="lower end of the band")
    normalized = ac.Option(True, doc="whether the amplitude at f_cut is -3 dB")
    init = ac.Option("SteadyState", choices=INIT, doc="type of initialization")
    x_start = ac.Parameter(0.0, shape="nx", doc="initial or guess values of the states")
    y_start = ac.Parameter(0.0, doc="initial value of the output")
    u_nominal = ac.Parameter(1.0, min=0, doc="nominal value of the input, for scaling")
    x = ac.Variable(shape="nx", start="x_start", doc="states")

    @property
    def nx(self) -> int:
        """Number of states."""
        return int(self.order) * (1 if self.filterType in ("LowPass", "HighPass") else 2)

    def equations(self) -> Iterator[ac.Eq]:
        z = self.u / self.u_nominal
        states = iter(self.x)
        real, pairs = self._sections()
        for pole in real:
            x = next(states)
            yield ac.Eq(ac.der(x), pole * (x - z))
            z = x if self.filterType == "LowPass" else z - x
        for pair in pairs:
            x1, x2 = next(states), next(states)
            yield ac.Eq(ac.der(x1), pair.a * x1 - pair.b * x2 + pair.ku * z)
            yield ac.Eq(ac.der(x2), pair.b * x1 + pair.a * x2)
            z = self._output(pair, x1, x2, z)
        yield ac.Eq(self.y, self.gain * self.u_nominal * z)

    def initial_equations(self) -> Iterator[ac.Eq]:
        yield from _start(self.init, self.x, self.x_start, self.y, self.y_start)

    def _sections(self) -> tuple[list[Any], list[_Pair]]:
        """Real poles and pairs of poles: the prototype's, moved to the wanted frequencies."""
        ripple = float(self.A_ripple)
        real, pairs = poles(
            self.analogFilter, int(self.order), normalized=self.normalized, ripple=ripple
        )
        w = 2 * ac.pi * self.f_cut
        if self.filterType == "LowPass":
            return [p * w for p in real], [_Pair(p.real * w, p.imag * w) for p in pairs]
        if self.filterType == "HighPass":
            inverse = [1 / p.conjugate() for p in pairs]
            return [w / p for p in real], [_Pair(p.real * w, p.imag * w) for p in inverse]
        width = (self.f_cut - self.f_min) / ac.sqrt(self.f_min * self.f_cut)
        stop = self.filterType == "BandStop"
        found: list[_Pair] = []
        for p in (*real, *pairs):
            twins = _split(1 / np.conj(p) if stop else p, width, ac.sqrt(self._middle), abs(p))
            found += twins if p in pairs else twins[:1]
        return [], found

    @property
    def _middle(self) -> Any:
        """Square of the band's middle angular frequency."""
        return 4 * ac.pi**2 * self.f_min * self.f_cut

    def _output(self, pair: _Pair, x1: Any, x2: Any, z: Any) -> Any:
        """Output of a pair's section; numerators ``w**2``, ``s**2``, ``c s`` and ``s**2 + w**2``."""
        a, b, c = pair
        if self.filterType == "LowPass":
            return x2
        if self.filterType == "BandPass":
            return c / pair.ku * (x1 + a / b * x2)
        zero = 0 if self.filterType == "HighPass" else self._middle
        return z + 2 * a / pair.ku * x1 + (zero + a**2 - b**2) / (b * pair.ku) * x2


def _start(initType: str, x: Any, x_start: Any, y: Any, y_start: Any) -> Iterator[ac.Eq]:
    """Initial equations of a cascade with states ``x``."""
    match initType:
        case "SteadyState":
            yield from (ac.Eq(ac.der(state), 0) for state in x)
        case "InitialState":
            yield from (ac.Eq(state, start) for state, start in zip(x, x_start, strict=True))
        case "InitialOutput":
            yield ac.Eq(y, y_start)
            yield from (ac.Eq(ac.der(state), 0) for state in x[:-1])
        case _:
            pass
