"""Inductors that saturate or are coupled."""

from collections.abc import Iterator
from math import pi
from typing import Any

import acausal as ac
from acausal.components import icons

from .interfaces import NegativePin, OnePort, PositivePin, TwoPort

__modelica__ = "Modelica.Electrical.Analog.Basic"


class SaturatingInductor(OnePort):
    """Inductor whose inductance falls from ``Lzer`` at no current to ``Linf`` at large currents.

    ``v = der(Psi)`` with the flux linkage ``Psi = Linf i + (Lzer - Linf) Ipar atan(i/Ipar)`` [Wb];
    ``Lact = Psi/i`` [H]. ``Ipar`` [A] follows from ``Lact = Lnom`` at ``i = Inom``; this needs
    ``Linf < Lnom < Lzer``. No hysteresis.
    """

    ICON = icons.SATURATING

    Inom = ac.Parameter(unit="A", min=0, doc="nominal current")
    Lnom = ac.Parameter(unit="H", min=0, doc="inductance at the nominal current")
    Lzer = ac.Parameter(unit="H", min=0, doc="inductance near zero current")
    Linf = ac.Parameter(unit="H", min=0, doc="inductance at large currents")
    Ipar = ac.Parameter(
        lambda self: self.Inom / ac.tan(_angle((self.Lnom - self.Linf) / (self.Lzer - self.Linf))),
        unit="A",
        doc="current that scales the saturation, computed",
    )
    Lact = ac.Variable(unit="H", doc="actual inductance")
    Psi = ac.Variable(unit="Wb", doc="flux linkage")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        above = self.Lzer - self.Linf
        ratio = ac.maximum(ac.Abs(self.i / self.Ipar), 1e-9)
        flux = self.Linf * self.i + above * self.Ipar * ac.atan(self.i / self.Ipar)
        yield ac.Eq(self.Lact, self.Linf + above * ac.atan(ratio) / ratio)
        yield ac.Eq(self.Psi, flux)
        yield ac.Eq(ac.der(flux), self.v)


def _angle(ratio: Any) -> Any:
    """The angle between 0 and pi/2 with ``angle/tan(angle) = ratio``.

    A formula good to 1 %, exact at both ends, then two steps of Halley's method: good to 1e-8.
    """
    slope = pi**2 / 12
    square = 2 * (1 - ratio) / (slope + ac.sqrt(slope**2 + 4 * (1 - slope) * (1 - ratio)))
    angle = pi / 2 * ac.sqrt(square)
    for _ in range(2):
        sin, cos = ac.sin(angle), ac.cos(angle)
        f = ratio * sin - angle * cos
        f1 = (ratio - 1) * cos + angle * sin
        f2 = (2 - ratio) * sin + angle * cos
        angle = angle - 2 * f * f1 / (2 * f1**2 - f * f2)
    return angle


class Transformer(TwoPort):
    """Two coupled inductors: ``v1 = L1 der(i1) + M der(i2)``, ``v2 = M der(i1) + L2 der(i2)``.

    ``dv = v1 - v2`` [V]. The coupling must not be perfect: ``L1 L2 > M**2``.
    """

    ICON = icons.TRANSFORMER

    L1 = ac.Parameter(unit="H", doc="primary inductance")
    L2 = ac.Parameter(unit="H", doc="secondary inductance")
    M = ac.Parameter(unit="H", doc="coupling inductance")
    dv = ac.Variable(unit="V", doc="difference of the primary and the secondary voltage")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.Assert(
            self.M**2 < self.L1 * self.L2, "the coupling must not be perfect, or more than that"
        )
        rate1, rate2 = ac.der(self.i1), ac.der(self.i2)
        yield ac.Eq(self.v1, self.L1 * rate1 + self.M * rate2)
        yield ac.Eq(self.dv, (self.L1 - self.M) * rate1 + (self.M - self.L2) * rate2)
        yield ac.Eq(self.v2, self.v1 - self.dv)


class M_Transformer(ac.Component):  # noqa: N801 (Modelica's name)
    """``N`` coupled inductors, each from ``p[j]`` to ``n[j]``: ``v = Lm der(i)``; the currents start at 0.

    ``L`` [H] holds the upper triangle of the symmetric matrix ``Lm`` row by row, ``N (N + 1)/2`` values.
    """

    ICON = icons.marked(icons.INDUCTOR, "n")

    N = ac.Option(3, min=1, doc="number of inductors")
    L = ac.Parameter(
        [1, 0.1, 0.2, 2, 0.3, 3], unit="H", shape=":", doc="inductances and coupling inductances"
    )
    v = ac.Variable(unit="V", shape="N", doc="voltages from p[j] to n[j]")
    i = ac.Variable(unit="A", shape="N", fixed=True, doc="currents from p[j] to n[j]")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        if len(self.L) != self.N * (self.N + 1) // 2:
            raise ac.DeclarationError(
                f"M_Transformer with N={self.N} needs {self.N * (self.N + 1) // 2} inductances L, "
                f"got {len(self.L)}"
            )
        self.p = [PositivePin() for _ in range(self.N)]
        self.n = [NegativePin() for _ in range(self.N)]

    def _inductance(self, row: int, column: int) -> Any:
        """Element of the matrix ``Lm``, counted from 0."""
        first, second = sorted((row, column))
        return self.L[first * self.N - first * (first + 1) // 2 + second]

    def equations(self) -> Iterator[ac.Eq]:
        rates = [ac.der(current) for current in self.i]
        for j in range(self.N):
            yield ac.Eq(self.v[j], self.p[j].v - self.n[j].v)
            yield ac.Eq(0, self.p[j].i + self.n[j].i)
            yield ac.Eq(self.i[j], self.p[j].i)
            induced = sum((self._inductance(j, m) * rates[m] for m in range(self.N)), start=0)
            yield ac.Eq(self.v[j], induced)
