"""MOS field-effect transistors without capacitances (Spiro 1990)."""

from collections.abc import Iterator
from typing import Any, ClassVar

import acausal as ac
from acausal.components import icons

from .diodes import _TemperatureDependent
from .interfaces import Pin

__modelica__ = "Modelica.Electrical.Analog.Semiconductors"


class _MOS(_TemperatureDependent):
    """The n-channel law; with ``polarity`` -1 all voltages and currents are mirrored.

    Between the higher ``ud`` and the lower ``us`` of the drain's and the source's potential,
    ``uds = ud - us``, flows ``id = v m (g - m/2) + uds/RDS`` with ``v = beta_t (W + dW)/(L + dL)``,
    ``g = max(K5 (G.v - us - vt_t + k2_t min(B.v - us, 0)), 0)`` and ``m = min(g, uds)``.
    With ``useTemperatureDependency`` ``beta_t = Beta (T_heatPort/Tnom)**-1.5``,
    ``vt_t = Vt (1 + kvt (T_heatPort - Tnom))`` and ``k2_t = K2 (1 + kk2 (T_heatPort - Tnom))``.
    Gate and bulk carry no current; ``LossPower = D.i (D.v - S.v)``.
    """

    ICON = icons.NMOS

    polarity: ClassVar[int] = 1

    D = Pin()
    G = Pin()
    S = Pin()
    B = Pin()
    W = ac.Parameter(20e-6, unit="m", doc="width")
    L = ac.Parameter(6e-6, unit="m", doc="length")
    Beta = ac.Parameter(unit="A/V2", doc="transconductance parameter")
    Vt = ac.Parameter(unit="V", doc="zero bias threshold voltage")
    K2 = ac.Parameter(doc="bulk threshold parameter")
    K5 = ac.Parameter(doc="reduction of the pinch-off region")
    dW = ac.Parameter(-2.5e-6, unit="m", doc="narrowing of the channel")
    dL = ac.Parameter(unit="m", doc="shortening of the channel")
    RDS = ac.Parameter(1e7, unit="Ohm", doc="resistance from drain to source, not zero")
    Tnom = ac.Parameter(300.15, unit="K", min=0, doc="temperature at which parameters were taken")
    kvt = ac.Parameter(unit="1/K", doc="temperature coefficient of Vt")
    kk2 = ac.Parameter(unit="1/K", doc="temperature coefficient of K2")

    @property
    def _actual(self) -> tuple[Any, Any, Any]:
        """``Beta``, ``Vt`` and ``K2`` at the actual temperature."""
        if not self.useTemperatureDependency:
            return self.Beta, self.Vt, self.K2
        above = self.T_heatPort - self.Tnom
        beta = self.Beta * (self.T_heatPort / self.Tnom) ** (-1.5)
        return beta, self.Vt * (1 + above * self.kvt), self.K2 * (1 + above * self.kk2)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        d, g, s, b = (self.polarity * pin.v for pin in (self.D, self.G, self.S, self.B))
        beta, vt, k2 = self._actual
        us = ac.minimum(d, s)
        uds = ac.Abs(d - s)
        gate = self.K5 * (g - us - self.polarity * vt + k2 * ac.minimum(b - us, 0))
        gate = ac.maximum(gate, 0)
        inner = ac.minimum(gate, uds)
        slope = beta * (self.W + self.dW) / (self.L + self.dL)
        current = slope * inner * (gate - inner / 2) + uds / self.RDS
        yield ac.Eq(self.D.i, self.polarity * ac.where(d < s, -1, 1) * current)
        yield ac.Eq(self.S.i, -self.D.i)
        yield ac.Eq(self.G.i, 0)
        yield ac.Eq(self.B.i, 0)
        yield ac.Eq(self.LossPower, self.D.i * (self.D.v - self.S.v))


class NMOS(_MOS):
    """N-channel MOS transistor with the pins ``D``, ``G``, ``S`` and ``B``.

    From the higher ``ud`` to the lower ``us`` of the drain's and the source's potential,
    ``uds = ud - us``, flows ``id = v m (g - m/2) + uds/RDS`` with ``v = Beta (W + dW)/(L + dL)``,
    ``g = max(K5 (G.v - us - Vt + K2 min(B.v - us, 0)), 0)`` and ``m = min(g, uds)``. With
    ``useTemperatureDependency`` ``Beta`` goes with ``(T_heatPort/Tnom)**-1.5``, ``Vt`` and ``K2`` with
    ``1 + kvt (T_heatPort - Tnom)`` and ``1 + kk2 (T_heatPort - Tnom)``. ``G.i = B.i = 0``,
    ``LossPower = D.i (D.v - S.v)``.
    """

    ICON = icons.NMOS

    Beta = ac.Parameter(0.041e-3, unit="A/V2", doc="transconductance parameter")
    Vt = ac.Parameter(0.8, unit="V", doc="zero bias threshold voltage")
    K2 = ac.Parameter(1.144, doc="bulk threshold parameter")
    K5 = ac.Parameter(0.7311, doc="reduction of the pinch-off region")
    dL = ac.Parameter(-1.5e-6, unit="m", doc="shortening of the channel")
    kvt = ac.Parameter(-6.96e-3, unit="1/K", doc="temperature coefficient of Vt")
    kk2 = ac.Parameter(6e-4, unit="1/K", doc="temperature coefficient of K2")


class PMOS(_MOS):
    """P-channel MOS transistor: `NMOS` with all voltages, currents and ``Vt`` negated."""

    ICON = icons.PMOS

    polarity = -1

    Beta = ac.Parameter(0.0105e-3, unit="A/V2", doc="transconductance parameter")
    Vt = ac.Parameter(-1.0, unit="V", doc="zero bias threshold voltage")
    K2 = ac.Parameter(0.41, doc="bulk threshold parameter")
    K5 = ac.Parameter(0.839, doc="reduction of the pinch-off region")
    dL = ac.Parameter(-2.1e-6, unit="m", doc="shortening of the channel")
    kvt = ac.Parameter(-2.9e-3, unit="1/K", doc="temperature coefficient of Vt")
    kk2 = ac.Parameter(6.2e-4, unit="1/K", doc="temperature coefficient of K2")
