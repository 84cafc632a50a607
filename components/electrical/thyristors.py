"""Thyristor and triac with a control voltage as their only memory, a state."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .ideal import IdealDiode
from .interfaces import ConditionalHeatPort, NegativePin, PositivePin
from .laws import exlin

__modelica__ = "Modelica.Electrical.Analog.Semiconductors"


class _Ratings(ConditionalHeatPort):
    """What a thyristor and a triac have in common."""

    VDRM = ac.Parameter(100.0, unit="V", min=0, doc="forward breakthrough voltage")
    VRRM = ac.Parameter(100.0, unit="V", min=0, doc="reverse breakthrough voltage")
    IDRM = ac.Parameter(0.1, unit="A", doc="saturation current, without effect")
    VTM = ac.Parameter(1.7, unit="V", doc="conducting voltage")
    IH = ac.Parameter(6e-3, unit="A", doc="holding current")
    ITM = ac.Parameter(25.0, unit="A", doc="conducting current")
    VGT = ac.Parameter(0.7, unit="V", doc="gate trigger voltage")
    IGT = ac.Parameter(5e-3, unit="A", doc="gate trigger current")
    TON = ac.Parameter(1e-6, unit="s", min=0, doc="switch on time")
    TOFF = ac.Parameter(15e-6, unit="s", min=0, doc="switch off time")
    Vt = ac.Parameter(0.04, unit="V", doc="thermal voltage (kT/qn)")
    Nbv = ac.Parameter(0.74, doc="emission coefficient of the reverse breakthrough")


_VON, _VOFF = 5.0, 1.5
"""Control voltages [V] above which a thyristor conducts, below which it blocks."""


class Thyristor(_Ratings):
    """Thyristor, of which a control voltage ``vControl`` [V], a state, says how far it conducts.

    ``Anode.i = vAK/r`` with ``r = Roff = VDRM**2/(VTM IH)`` for ``vControl < 1.5``,
    ``r = Ron = (VTM - 0.7 V)/ITM`` above 5, and in between smoothly by its logarithm; below ``vAK = -VRRM``
    ``Anode.i = -VRRM/Roff exp(-(vAK + VRRM)/(Nbv Vt))``. ``vControl`` follows ``vContot`` with the time constant
    1.87 ``TON`` upwards, 0.638 ``TOFF`` downwards; ``vContot`` is 5 V while ``Anode.i > IH`` or
    ``vAK > VDRM``, plus up to ``10 vAK`` while a gate current above 0.95 ``IGT`` flows. The exponential of
    the breakthrough is linear from the exponent 100, where Modelica's overflows.
    """

    ICON = icons.THYRISTOR

    Anode = PositivePin()
    Cathode = NegativePin()
    Gate = PositivePin()
    iGK = ac.Variable(unit="A", doc="gate current")
    vGK = ac.Variable(unit="V", doc="voltage from gate to cathode")
    vAK = ac.Variable(unit="V", doc="voltage from anode to cathode")
    vControl = ac.Variable(unit="V", doc="control voltage")
    vContot = ac.Variable(unit="V", doc="voltage that the control voltage follows")
    vConmain = ac.Variable(unit="V", doc="its part from the main circuit")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        anode, cathode, gate = self.Anode, self.Cathode, self.Gate
        yield ac.Eq(0, anode.i + gate.i + cathode.i)
        yield ac.Eq(self.vGK, gate.v - cathode.v)
        yield ac.Eq(self.vAK, anode.v - cathode.v)
        yield ac.Eq(self.iGK, gate.i)
        yield from self._control()
        yield ac.Eq(anode.i, self._current)
        power = anode.i * anode.v + cathode.i * cathode.v + gate.i * gate.v
        yield ac.Eq(self.LossPower, power)

    def _control(self) -> Iterator[ac.Eq]:
        low = self.VGT / self.IGT * self.iGK
        high = 0.65**2 / self.VGT + self.iGK * (self.VGT - 0.65) / self.IGT
        yield ac.Eq(self.vGK, ac.where(self.vGK < 0.65, low, high))
        share = ac.maximum(ac.minimum(1e4 * (self.iGK - 0.95 * self.IGT), 10), 0)
        on = (self.Anode.i > self.IH) | (self.vAK > self.VDRM)
        yield ac.Eq(self.vConmain, ac.where(on, _VON, 0))
        yield ac.Eq(self.vContot, self.vConmain + share * self.vAK)
        error = self.vContot - self.vControl
        delay = ac.where(error > 0, 1.87 * self.TON, 0.638 * self.TOFF)
        yield ac.Eq(ac.der(self.vControl), error / delay)

    @property
    def _current(self) -> Any:
        on = (self.VTM - 0.7) / self.ITM
        off = self.VDRM**2 / self.VTM / self.IH
        x = (2 * self.vControl - _VON - _VOFF) / (2 * (_VON - _VOFF))
        x = ac.maximum(ac.minimum(x, 0.5), -0.5)
        resistance = ac.sqrt(on * off) * (on / off) ** ((3 * x - 4 * x**3) / 2)
        breakthrough = exlin(-(self.vAK + self.VRRM) / (self.Nbv * self.Vt), 100)
        reverse = -self.VRRM / off * breakthrough
        return ac.where(self.vAK < -self.VRRM, reverse, self.vAK / resistance)


class SimpleTriac(_Ratings):
    """Two thyristors in opposite directions, each with an ideal diode before its gate.

    ``thyristor`` conducts from ``n`` to ``p``, ``thyristor1`` from ``p`` to ``n``; ``g`` is the gate.
    """

    ICON = icons.TRIAC

    n = NegativePin()
    p = PositivePin()
    g = PositivePin()

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        ratings = {name: getattr(self, name) for name in (*_RATINGS, "T")}
        self.thyristor = Thyristor(useHeatPort=self.useHeatPort, **ratings)
        self.thyristor1 = Thyristor(useHeatPort=self.useHeatPort, **ratings)
        self.idealDiode = IdealDiode()
        self.idealDiode1 = IdealDiode()
        self.connect(self.n, self.thyristor.Anode, self.thyristor1.Cathode)
        self.connect(self.p, self.thyristor1.Anode, self.thyristor.Cathode)
        self.connect(self.g, self.idealDiode.p, self.idealDiode1.p)
        self.connect(self.idealDiode.n, self.thyristor.Gate)
        self.connect(self.idealDiode1.n, self.thyristor1.Gate)
        if self.useHeatPort:
            self.connect(self.heatPort, self.thyristor.heatPort, self.thyristor1.heatPort)

    def equations(self) -> Iterator[ac.Eq]:
        n, p, g = self.n, self.p, self.g
        yield ac.Eq(self.T_heatPort, self.heatPort.T if self.useHeatPort else self.T)
        yield ac.Eq(self.LossPower, p.i * p.v + n.i * n.v + g.i * g.v)


_RATINGS = tuple(
    name for name, declared in vars(_Ratings).items() if isinstance(declared, ac.Parameter)
)
