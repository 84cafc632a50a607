"""Basic circuits with one operational amplifier (`Modelica.Electrical.Analog.Examples.OpAmps.OpAmpCircuits`).

Input ``p1``, output ``p2``, both against ``n1``, which is ``n2``. All but `Buffer` invert. Laws hold for an ideal
amplifier; the one here, ``opAmp``, has the gain ``V0`` and is bounded to the supply.
"""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .basic import Capacitor, Resistor
from .ideal_amplifiers import IdealizedOpAmpLimited
from .interfaces import FourPin, PositivePin

__modelica__ = "Modelica.Electrical.Analog.Examples.OpAmps.OpAmpCircuits"


class PartialOpAmp(FourPin):
    """Base of the circuits: the amplifier ``opAmp``, whose output is ``p2``; ``n1`` and ``n2`` are joined."""

    Vps = ac.Parameter(15.0, unit="V", doc="positive supply")
    Vns = ac.Parameter(-15.0, unit="V", doc="negative supply")
    V0 = ac.Parameter(15000.0, doc="no-load gain")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.opAmp = IdealizedOpAmpLimited(V0=self.V0, Vps=self.Vps, Vns=self.Vns, strict=False)
        self.connect(self.n1, self.n2)
        self.connect(self.opAmp.out, self.p2)


class _Inverting(PartialOpAmp):
    """The positive input of the amplifier is ``n1``."""

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.connect(self.n1, self.opAmp.in_p)


class Buffer(PartialOpAmp):
    """Amplifier that does not invert: ``v2 = k v1``."""

    ICON = icons.amplifier("1")

    k = ac.Parameter(1.0, min=0, doc="gain")
    R1 = ac.Parameter(1000.0, unit="Ohm", doc="resistance at the negative pins")
    R2 = ac.Parameter(lambda self: (self.k - 1) * self.R1, unit="Ohm", doc="resistance, computed")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.r1, self.r2 = Resistor(R=self.R1), Resistor(R=self.R2)
        self.connect(self.p1, self.opAmp.in_p)
        self.connect(self.opAmp.out, self.r2.p)
        self.connect(self.r2.n, self.r1.p, self.opAmp.in_n)
        self.connect(self.r1.n, self.n1)


class Gain(_Inverting):
    """Inverting amplifier: ``v2 = -k v1``."""

    ICON = icons.amplifier("−k")

    k = ac.Parameter(1.0, min=0, doc="gain")
    R1 = ac.Parameter(1000.0, unit="Ohm", doc="resistance at the input")
    R2 = ac.Parameter(lambda self: self.k * self.R1, unit="Ohm", doc="resistance, computed")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.r1, self.r2 = Resistor(R=self.R1), Resistor(R=self.R2)
        self.connect(self.p1, self.r1.p)
        self.connect(self.r1.n, self.r2.n, self.opAmp.in_n)
        self.connect(self.r2.p, self.opAmp.out)


class _TwoInputs(PartialOpAmp):
    """A circuit with a second input ``p1_2``: ``v1_2 = p1_2.v - n1.v`` [V], ``i1_2 = p1_2.i`` [A]."""

    p1_2 = PositivePin()
    v1_2 = ac.Variable(unit="V", doc="voltage from p1_2 to n1")
    i1_2 = ac.Variable(unit="A", doc="current into p1_2")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v1_2, self.p1_2.v - self.n1.v)
        yield ac.Eq(self.i1_2, self.p1_2.i)


class Add(_TwoInputs, _Inverting):
    """Inverting sum: ``v2 = -(k1 v1 + k2 v1_2)``."""

    ICON = icons.amplifier("Σ")

    k1 = ac.Parameter(1.0, min=0, doc="weight of the first input")
    k2 = ac.Parameter(1.0, min=0, doc="weight of the second input")
    R = ac.Parameter(1000.0, unit="Ohm", doc="resistance at the output")
    R1 = ac.Parameter(lambda self: self.R / self.k1, unit="Ohm", doc="resistance, computed")
    R2 = ac.Parameter(lambda self: self.R / self.k2, unit="Ohm", doc="resistance, computed")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.r1, self.r2, self.r = Resistor(R=self.R1), Resistor(R=self.R2), Resistor(R=self.R)
        self.connect(self.p1, self.r1.p)
        self.connect(self.p1_2, self.r2.p)
        self.connect(self.opAmp.in_n, self.r1.n, self.r2.n, self.r.n)
        self.connect(self.opAmp.out, self.r.p)


class Feedback(_TwoInputs):
    """Difference: ``v2 = -(v1 - v1_2)/k``; as in Modelica ``R3 = R1/k``, although it calls ``k`` the gain."""

    ICON = icons.amplifier("−")

    k = ac.Parameter(1.0, min=0, doc="inverse of the gain")
    R1 = ac.Parameter(1000.0, unit="Ohm", doc="resistance at the inputs")
    R3 = ac.Parameter(lambda self: self.R1 / self.k, unit="Ohm", doc="resistance, computed")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.r1, self.r2 = Resistor(R=self.R1), Resistor(R=self.R1)
        self.r3, self.r4 = Resistor(R=self.R3), Resistor(R=self.R3)
        self.connect(self.p1, self.r1.p)
        self.connect(self.opAmp.in_n, self.r1.n, self.r3.n)
        self.connect(self.opAmp.out, self.r3.p)
        self.connect(self.p1_2, self.r2.p)
        self.connect(self.opAmp.in_p, self.r2.n, self.r4.p)
        self.connect(self.n1, self.r4.n)


class Der(_Inverting):
    """Differentiator: ``v2 = -k/(2 pi f) der(v1)``; ``v`` [V] is the capacitor's voltage."""

    ICON = icons.amplifier("s")

    k = ac.Parameter(1.0, min=0, doc="gain at the frequency f")
    f = ac.Parameter(unit="Hz", doc="frequency")
    R = ac.Parameter(1000.0, unit="Ohm", doc="resistance at the output")
    C = ac.Parameter(
        lambda self: self.k / (2 * ac.pi * self.f * self.R), unit="F", doc="capacitance, computed"
    )
    v = ac.Variable(unit="V", doc="voltage of the capacitor")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.c, self.r = Capacitor(C=self.C), Resistor(R=self.R)
        self.connect(self.p1, self.c.p)
        self.connect(self.opAmp.in_n, self.c.n, self.r.n)
        self.connect(self.opAmp.out, self.r.p)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, self.c.v)


class Integrator(_Inverting):
    """Integrator: ``der(v2) = -2 pi f k v1``; ``v`` [V] is the capacitor's voltage."""

    ICON = icons.amplifier("∫")

    k = ac.Parameter(1.0, min=0, doc="gain at the frequency f")
    f = ac.Parameter(unit="Hz", doc="frequency")
    R = ac.Parameter(1000.0, unit="Ohm", doc="resistance at the input")
    C = ac.Parameter(
        lambda self: 1 / self.k / (2 * ac.pi * self.f * self.R),
        unit="F",
        doc="capacitance, computed",
    )
    v = ac.Variable(unit="V", doc="voltage of the capacitor")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.c, self.r = Capacitor(C=self.C), Resistor(R=self.R)
        self.connect(self.p1, self.r.p)
        self.connect(self.opAmp.in_n, self.r.n, self.c.n)
        self.connect(self.opAmp.out, self.c.p)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, self.c.v)


class FirstOrder(_Inverting):
    """Low pass: ``v2 + T der(v2) = -k v1``; ``v`` [V] is the capacitor's voltage."""

    ICON = icons.amplifier("T1")

    k = ac.Parameter(1.0, min=0, doc="gain")
    R1 = ac.Parameter(1000.0, unit="Ohm", doc="resistance at the input")
    R2 = ac.Parameter(lambda self: self.k * self.R1, unit="Ohm", doc="resistance, computed")
    T = ac.Parameter(unit="s", doc="time constant")
    C = ac.Parameter(lambda self: self.T / self.R2, unit="F", doc="capacitance, computed")
    v = ac.Variable(unit="V", doc="voltage of the capacitor")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.r1, self.r2 = Resistor(R=self.R1), Resistor(R=self.R2)
        self.c = Capacitor(C=self.C)
        self.connect(self.p1, self.r1.p)
        self.connect(self.opAmp.in_n, self.r1.n, self.r2.n, self.c.n)
        self.connect(self.opAmp.out, self.r2.p, self.c.p)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, self.c.v)


class Derivative(_Inverting):
    """High pass: ``v2 + T der(v2) = -k T der(v1)``; ``v`` [V] is the capacitor's voltage."""

    ICON = icons.amplifier("DT")

    k = ac.Parameter(1.0, min=0, doc="gain")
    R1 = ac.Parameter(1000.0, unit="Ohm", doc="resistance at the input")
    R2 = ac.Parameter(lambda self: self.k * self.R1, unit="Ohm", doc="resistance, computed")
    T = ac.Parameter(unit="s", doc="time constant")
    C = ac.Parameter(lambda self: self.T / self.R1, unit="F", doc="capacitance, computed")
    v = ac.Variable(unit="V", doc="voltage of the capacitor")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.r1, self.r2 = Resistor(R=self.R1), Resistor(R=self.R2)
        self.c = Capacitor(C=self.C)
        self.connect(self.p1, self.c.p)
        self.connect(self.c.n, self.r1.p)
        self.connect(self.opAmp.in_n, self.r1.n, self.r2.n)
        self.connect(self.opAmp.out, self.r2.p)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, self.c.v)


class PI(_Inverting):
    """Inverting PI controller: ``v2 = -k (v1 + 1/T integral of v1)``."""

    ICON = icons.amplifier("PI")

    k = ac.Parameter(1.0, min=0, doc="gain")
    R1 = ac.Parameter(1000.0, unit="Ohm", doc="resistance at the input")
    R2 = ac.Parameter(lambda self: self.k * self.R1, unit="Ohm", doc="resistance, computed")
    T = ac.Parameter(unit="s", doc="time constant")
    C = ac.Parameter(lambda self: self.T / self.k / self.R1, unit="F", doc="capacitance, computed")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.r1, self.r2 = Resistor(R=self.R1), Resistor(R=self.R2)
        self.c = Capacitor(C=self.C)
        self.connect(self.p1, self.r1.p)
        self.connect(self.opAmp.in_n, self.r1.n, self.r2.n)
        self.connect(self.r2.p, self.c.n)
        self.connect(self.opAmp.out, self.c.p)


class DifferentialAmplifierData(ac.Component):
    """A record: what source, differential amplifier and instrument of Modelica's example have as parameters."""

    ICON = icons.block("data")

    VSource = ac.Parameter(400.0, unit="V", doc="effective voltage of the source, line to line")
    fSource = ac.Parameter(50.0, unit="Hz", doc="frequency of the source")
    RLoad = ac.Parameter(10.0, unit="Ohm", doc="load of the source")
    RGround = ac.Parameter(100e3, unit="Ohm", doc="resistance to ground")
    V0 = ac.Parameter(10e3, doc="gain of the amplifier without feedback")
    VSupply = ac.Parameter(15.0, unit="V", doc="supply")
    k = ac.Parameter(100.0, doc="attenuation")
    R1 = ac.Parameter(100e3, unit="Ohm", doc="resistor 1")
    R2 = ac.Parameter(lambda self: self.R1, unit="Ohm", doc="resistor 2")
    R3 = ac.Parameter(lambda self: self.R1 / self.k, unit="Ohm", doc="resistor 3")
    R4 = ac.Parameter(lambda self: self.R3, unit="Ohm", doc="resistor 4")
    RInstrument = ac.Parameter(100e3, unit="Ohm", doc="input resistance of the instrument")
