"""Transmission lines of lumped segments."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.thermal.interfaces import HeatPort_a

from .basic import Capacitor, Conductor, Ground, Inductor, Resistor
from .inductors import M_Transformer
from .interfaces import NegativePin, Pin, PositivePin

__modelica__ = "Modelica.Electrical.Analog.Lines"


class _Line(ac.Component):
    """A line from ``p1`` to ``p2`` of ``N`` segments, with the reference ``p3``.

    ``v13 = p1.v - p3.v``, ``v23 = p2.v - p3.v`` [V], ``i1 = p1.i``, ``i2 = p2.i`` [A].
    """

    p1 = Pin()
    p2 = Pin()
    p3 = Pin()
    heatPort = HeatPort_a(when="useHeatPort")
    N = ac.Option(1, min=1, doc="number of segments")
    length = ac.Parameter(unit="m", min=0, doc="length of the line")
    useHeatPort = ac.Option(False, doc="whether there is a heat port")
    T = ac.Parameter(293.15, unit="K", doc="temperature of the device without heat port")
    T_ref = ac.Parameter(300.15, unit="K", doc="reference temperature")
    v13 = ac.Variable(unit="V", doc="voltage from p1 to p3")
    v23 = ac.Variable(unit="V", doc="voltage from p2 to p3")
    i1 = ac.Variable(unit="A", doc="current into p1")
    i2 = ac.Variable(unit="A", doc="current into p2")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.v13, self.p1.v - self.p3.v)
        yield ac.Eq(self.v23, self.p2.v - self.p3.v)
        yield ac.Eq(self.i1, self.p1.i)
        yield ac.Eq(self.i2, self.p2.i)

    def _along(self, whole: Any) -> list[Any]:
        """What lies along the line, in ``N + 1`` parts: the first and the last are halves."""
        return [
            whole / (2 * self.N) if i in (0, self.N) else whole / self.N for i in range(self.N + 1)
        ]

    def _heated(self) -> dict[str, Any]:
        """Modifiers of all parts that depend on the temperature."""
        return {"T_ref": self.T_ref, "T": self.T, "useHeatPort": self.useHeatPort}

    def _heat(self, *parts: Resistor | Conductor) -> None:
        """Join the heat ports of parts with the line's own."""
        if self.useHeatPort:
            self.connect(self.heatPort, *(part.heatPort for part in parts))


class OLine(_Line):
    """Lossy line: ``N + 1`` parts with ``R`` and ``L`` in series, ``N`` nodes with ``C`` and ``G`` to ``p3``.

    From ``r`` [Ohm/m], ``l`` [H/m], ``g`` [S/m] and ``c`` [F/m] times ``length/N``; the first and the last
    ``R`` and ``L`` are halves. ``v`` are the voltages at the nodes, ``i`` the currents of the parts.
    ``R`` and ``G`` depend on the temperature by ``alpha_R`` and ``alpha_G``.
    """

    ICON = icons.LINE

    r = ac.Parameter(unit="Ohm/m", min=0, doc="resistance per length")
    l = ac.Parameter(unit="H/m", min=0, doc="inductance per length")
    g = ac.Parameter(unit="S/m", min=0, doc="conductance per length")
    c = ac.Parameter(unit="F/m", min=0, doc="capacitance per length")
    alpha_R = ac.Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    alpha_G = ac.Parameter(0.0, unit="1/K", doc="temperature coefficient of the conductance")
    v = ac.Variable(unit="V", shape="N", doc="voltages at the nodes")
    i = ac.Variable(unit="A", shape="_parts", doc="currents of the parts")

    @property
    def _parts(self) -> int:
        return self.N + 1

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        n, share = self.N, self.length / self.N
        heated = self._heated()
        resistances, inductances = (
            self._along(self.r * self.length),
            self._along(self.l * self.length),
        )
        self.R = [Resistor(R=r, alpha=self.alpha_R, **heated) for r in resistances]
        self.L = [Inductor(L=inductance) for inductance in inductances]
        self.C = [Capacitor(C=self.c * share) for _ in range(n)]
        self.G = [Conductor(G=self.g * share, alpha=self.alpha_G, **heated) for _ in range(n)]
        self.connect(self.p1, self.R[0].p)
        for resistor, inductor in zip(self.R, self.L, strict=True):
            self.connect(resistor.n, inductor.p)
        for i in range(n):
            self.connect(self.L[i].n, self.C[i].p, self.G[i].p, self.R[i + 1].p)
        self.connect(self.L[n].n, self.p2)
        self.connect(self.p3, *(part.n for part in (*self.C, *self.G)))
        self._heat(*self.R, *self.G)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        for voltage, part in zip(self.v, self.G, strict=True):
            yield ac.Eq(voltage, part.v)
        for current, part in zip(self.i, self.R, strict=True):
            yield ac.Eq(current, part.i)


class ULine(_Line):
    """Lossy RC line: ``N + 1`` resistors ``R`` in series, ``N`` nodes with ``C`` to ``p3``.

    From ``r`` [Ohm/m] and ``c`` [F/m] times ``length/N``; the first and the last ``R`` are halves. ``R``
    depends on the temperature by ``alpha``.
    """

    ICON = icons.marked(icons.LINE, "RC")

    r = ac.Parameter(unit="Ohm/m", min=0, doc="resistance per length")
    c = ac.Parameter(unit="F/m", min=0, doc="capacitance per length")
    alpha = ac.Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        n = self.N
        heated = self._heated()
        resistances = self._along(self.r * self.length)
        self.R = [Resistor(R=r, alpha=self.alpha, **heated) for r in resistances]
        self.C = [Capacitor(C=self.c * self.length / n) for _ in range(n)]
        self.connect(self.p1, self.R[0].p)
        for i in range(n):
            self.connect(self.R[i].n, self.C[i].p, self.R[i + 1].p)
        self.connect(self.R[n].n, self.p2)
        self.connect(self.p3, *(part.n for part in self.C))
        self._heat(*self.R)


class _Segment(ac.Component):
    """Resistors and coupled inductors of ``lines`` lines in series."""

    lines = ac.Option(3, doc="number of lines")
    alpha_R = ac.Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    useHeatPort = ac.Option(False, doc="whether there is a heat port")
    T = ac.Parameter(293.15, unit="K", doc="temperature of the device without heat port")
    T_ref = ac.Parameter(300.15, unit="K", doc="reference temperature")
    heatPort = HeatPort_a(when="useHeatPort")

    def __init__(self, resistances: list[Any], inductances: list[Any], **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.p = [PositivePin() for _ in range(self.lines)]
        self.n = [NegativePin() for _ in range(self.lines)]
        heated = {"T_ref": self.T_ref, "T": self.T, "useHeatPort": self.useHeatPort}
        self.R = [Resistor(R=r, alpha=self.alpha_R, **heated) for r in resistances]
        self.inductance = M_Transformer(N=self.lines, L=inductances)
        if self.useHeatPort:
            self.connect(self.heatPort, *(part.heatPort for part in self.R))


class _Shunted(_Segment):
    """A segment with a capacitor and a conductor between any two lines, and to ``refPin``."""

    alpha_G = ac.Parameter(0.0, unit="1/K", doc="temperature coefficient of the conductance")
    refPin = NegativePin()

    def __init__(
        self,
        resistances: list[Any],
        inductances: list[Any],
        capacitances: list[Any],
        conductances: list[Any],
        **modifiers: Any,
    ) -> None:
        super().__init__(resistances, inductances, **modifiers)
        heated = {"T_ref": self.T_ref, "T": self.T, "useHeatPort": self.useHeatPort}
        self.C = [Capacitor(C=c) for c in capacitances]
        self.G = [Conductor(G=g, alpha=self.alpha_G, **heated) for g in conductances]
        ends = self.inductance.n
        for j in range(self.lines):
            self.connect(self.p[j], self.R[j].p)
            self.connect(self.R[j].n, self.inductance.p[j])
            self.connect(ends[j], self.n[j])
        pairs = [(j, m) for j in range(self.lines) for m in range(j, self.lines)]
        for (j, m), capacitor, conductor in zip(pairs, self.C, self.G, strict=True):
            self.connect(ends[j], capacitor.p, conductor.p)
            self.connect(self.refPin if m == j else ends[m], capacitor.n, conductor.n)
        if self.useHeatPort:
            self.connect(self.heatPort, *(part.heatPort for part in self.G))


class _Last(_Segment):
    """The segment that ends a line: the inductors come first."""

    def __init__(self, resistances: list[Any], inductances: list[Any], **modifiers: Any) -> None:
        super().__init__(resistances, inductances, **modifiers)
        for j in range(self.lines):
            self.connect(self.p[j], self.inductance.p[j])
            self.connect(self.inductance.n[j], self.R[j].p)
            self.connect(self.R[j].n, self.n[j])


class M_OLine(ac.Component):  # noqa: N801 (Modelica's name)
    """``lines`` coupled lossy lines from ``p[j]`` to ``n[j]`` of ``N`` segments, at least two.

    Each segment, ``s_first`` and ``s[i]``, has resistors ``R``, coupled inductors ``inductance``, and a
    capacitor and a conductor between any two lines and from each line to ``refPin``, or to the ground
    with ``useInternalGround``. ``s_first`` has half of the resistances and inductances, ``s_last`` the
    other half. ``l``, ``g`` and ``c`` hold the upper triangles of symmetric matrices row by row; what
    they have on the diagonal lies between a line and the reference.
    """

    ICON = icons.marked(icons.LINE, "n")

    length = ac.Parameter(0.1, unit="m", min=0, doc="length of the line")
    N = ac.Option(5, min=2, doc="number of segments")
    lines = ac.Option(4, min=1, doc="number of lines")
    r = ac.Parameter(
        [4.76e5, 1.72e5, 1.72e5, 1.72e5], shape=":", unit="Ohm/m", doc="resistances per length"
    )
    l = ac.Parameter(
        [5.98e-7, 4.44e-7, 4.39e-7, 3.99e-7, 5.81e-7, 4.09e-7, 4.23e-7, 5.96e-7, 4.71e-7, 6.06e-7],
        shape=":",
        unit="H/m",
        doc="inductances per length",
    )
    g = ac.Parameter(
        [8.05e-6, 3.42e-5, 2.91e-5, 1.76e-6, 9.16e-6, 7.12e-6, 2.43e-5, 5.93e-6, 4.19e-5, 6.64e-6],
        shape=":",
        unit="S/m",
        doc="conductances per length",
    )
    c = ac.Parameter(
        [
            2.38e-11, 1.01e-10, 8.56e-11, 5.09e-12, 2.71e-11,
            2.09e-11, 7.16e-11, 1.83e-11, 1.23e-10, 2.07e-11,
        ],
        shape=":",
        unit="F/m",
        doc="capacitances per length",
    )  # fmt: skip
    useInternalGround = ac.Option(
        True, doc="whether the reference is grounded; else the pin refPin"
    )
    alpha_R = ac.Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    alpha_G = ac.Parameter(0.0, unit="1/K", doc="temperature coefficient of the conductance")
    useHeatPort = ac.Option(False, doc="whether there is a heat port")
    T = ac.Parameter(293.15, unit="K", doc="temperature of the device without heat port")
    T_ref = ac.Parameter(300.15, unit="K", doc="reference temperature")
    heatPort = HeatPort_a(when="useHeatPort")
    refPin = NegativePin(when="not useInternalGround")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self._check()
        whole, half = self.length / self.N, self.length / (2 * self.N)
        self.p = [PositivePin() for _ in range(self.lines)]
        self.n = [NegativePin() for _ in range(self.lines)]
        self.s_first = self._segment(half, whole)
        self.s = [self._segment(whole, whole) for _ in range(self.N - 1)]
        self.s_last = _Last(_scaled(self.r, half), _scaled(self.l, half), **self._common())
        chain = [self.s_first, *self.s, self.s_last]
        self.connect(self.p, self.s_first.p)
        for before, after in pairwise(chain):
            self.connect(before.n, after.p)
        self.connect(self.s_last.n, self.n)
        references = [segment.refPin for segment in (self.s_first, *self.s)]
        if self.useInternalGround:
            self.ground = Ground()
            self.connect(self.ground.p, *references)
        else:
            self.connect(self.refPin, *references)
        if self.useHeatPort:
            self.connect(self.heatPort, *(segment.heatPort for segment in chain))

    def _check(self) -> None:
        pairs = self.lines * (self.lines + 1) // 2
        for name, count in (("r", self.lines), ("l", pairs), ("g", pairs), ("c", pairs)):
            if len(getattr(self, name)) != count:
                raise ac.DeclarationError(
                    f"M_OLine with lines={self.lines} needs {count} values {name}, "
                    f"got {len(getattr(self, name))}"
                )

    def _common(self) -> dict[str, Any]:
        return {
            "lines": self.lines,
            "alpha_R": self.alpha_R,
            "useHeatPort": self.useHeatPort,
            "T": self.T,
            "T_ref": self.T_ref,
        }

    def _segment(self, series: Any, shunt: Any) -> _Shunted:
        return _Shunted(
            _scaled(self.r, series),
            _scaled(self.l, series),
            _scaled(self.c, shunt),
            _scaled(self.g, shunt),
            alpha_G=self.alpha_G,
            **self._common(),
        )


def _scaled(values: Any, factor: Any) -> list[Any]:
    return [value * factor for value in values]
