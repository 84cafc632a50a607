"""Diodes with exponential characteristics, continued linearly so that they never overflow."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons, nature

from .interfaces import ConditionalHeatPort, OnePort
from .laws import exlin

__modelica__ = "Modelica.Electrical.Analog.Semiconductors"


class _TemperatureDependent(ConditionalHeatPort):
    """What ``useTemperatureDependency`` adds; it also brings the heat port unless ``useHeatPort`` is given."""

    useTemperatureDependency = ac.Option(False, doc="whether the law depends on the temperature")
    useHeatPort = ac.Option(
        None,
        choices=(None, False, True),
        doc="whether there is a heat port; by default as useTemperatureDependency",
    )

    @property
    def _heated(self) -> bool:
        return self.useTemperatureDependency if self.useHeatPort is None else self.useHeatPort


class Diode(OnePort, _TemperatureDependent):
    """Diode: ``i = id + v/R``, ``id = Ids (exp(v/Vt) - 1)``, linear beyond ``v/Vt = Maxexp``.

    With ``useTemperatureDependency`` ``id = Ids (exp(v/(N vt_t)) - 1)`` and
    ``i = id (T/TNOM)**(XTI/N) exp((T/TNOM - 1) EG/(N vt_t)) + v/R`` with ``T = T_heatPort`` and the
    thermal voltage ``vt_t = k T/q``. ``LossPower = v i``.
    """

    ICON = icons.DIODE

    Ids = ac.Parameter(1e-6, unit="A", doc="saturation current")
    Vt = ac.Parameter(0.04, unit="V", doc="thermal voltage (kT/qn) without temperature dependency")
    Maxexp = ac.Parameter(15.0, min=0, doc="exponent from which the characteristic is linear")
    R = ac.Parameter(1e8, unit="Ohm", doc="parallel resistance")
    EG = ac.Parameter(1.11, unit="V", doc="activation energy")
    N = ac.Parameter(1.0, doc="emission coefficient")
    TNOM = ac.Parameter(300.15, unit="K", min=0, doc="temperature at which parameters were taken")
    XTI = ac.Parameter(3.0, doc="temperature exponent of the saturation current")
    vt_t = ac.Variable(unit="V", doc="thermal voltage")
    id = ac.Variable(unit="A", doc="diode current")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        scale = self.N * self.vt_t if self.useTemperatureDependency else self.Vt
        current = self.id
        if self.useTemperatureDependency:
            ratio = self.T_heatPort / self.TNOM
            growth = ac.exp((ratio - 1) * self.EG / (self.N * self.vt_t))
            current = self.id * ratio ** (self.XTI / self.N) * growth
        yield ac.Eq(self.vt_t, nature.k * self.T_heatPort / nature.q)
        yield ac.Eq(self.id, self.Ids * (exlin(self.v / scale, self.Maxexp) - 1))
        yield ac.Eq(self.i, current + self.v / self.R)
        yield ac.Eq(self.LossPower, self.i * self.v)


class Diode2(OnePort, ConditionalHeatPort):
    """Diode with a series resistance and reverse breakdown: ``v = vd + Rs id``, ``i = id + Gp v``.

    With ``w = N Vt``: ``id = Ids (exp(vd/w) - 1)``, linear above ``vd = Vf + w``; below ``-Bv/2``
    ``id = -Ids (exp(-(vd + Bv)/w) + 1 - 2 exp(-Bv/(2 w)))``. With a heat port the thermal voltage is
    ``R T_heatPort/F`` instead of ``Vt``. ``LossPower = v i``. The breakdown is continued linearly above the
    exponent 100, where Modelica's overflows.
    """

    ICON = icons.marked(icons.DIODE, "2")

    Vf = ac.Parameter(0.7, unit="V", min=0, doc="forward voltage")
    Ids = ac.Parameter(1e-13, unit="A", doc="reverse saturation current")
    Rs = ac.Parameter(16.0, unit="Ohm", doc="series resistance")
    Vt = ac.Parameter(
        lambda self: nature.R * self.T / nature.F,
        unit="V",
        min=0,
        doc="thermal voltage (kT/q) without heat port",
    )
    N = ac.Parameter(1.0, doc="emission coefficient")
    Bv = ac.Parameter(100.0, unit="V", min=0, doc="reverse breakdown voltage")
    Gp = ac.Parameter(1e-6, unit="S", doc="parallel conductance")
    vd = ac.Variable(unit="V", doc="voltage across the diode without resistance")
    id = ac.Variable(unit="A", doc="diode current")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        hot = nature.R * self.T_heatPort / nature.F
        width = self.N * (hot if self.useHeatPort else self.Vt)
        reverse = exlin(-(self.vd + self.Bv) / width, 100) + 1 - 2 * ac.exp(-self.Bv / (2 * width))
        forward = exlin(self.vd / width, self.Vf / width + 1) - 1
        yield ac.Eq(self.id, self.Ids * ac.where(self.vd < -self.Bv / 2, -reverse, forward))
        yield ac.Eq(self.v, self.vd + self.id * self.Rs)
        yield ac.Eq(self.i, self.id + self.v * self.Gp)
        yield ac.Eq(self.LossPower, self.i * self.v)


class ZDiode(OnePort, ConditionalHeatPort):
    """Zener diode: ``i = Ids (exp(v/Vt) - 1) - Ibv exp(-(v + Bv)/(Nbv Vt)) + v/R``.

    Both exponentials are linear beyond ``Maxexp``. ``LossPower = v i``; the law does not depend on the
    temperature.
    """

    ICON = icons.ZENER

    Ids = ac.Parameter(1e-6, unit="A", doc="saturation current")
    Vt = ac.Parameter(0.04, unit="V", doc="thermal voltage (kT/qn)")
    Maxexp = ac.Parameter(30.0, min=0, doc="exponent from which the characteristic is linear")
    R = ac.Parameter(1e8, unit="Ohm", doc="parallel resistance")
    Bv = ac.Parameter(5.1, unit="V", doc="breakthrough voltage")
    Ibv = ac.Parameter(0.7, unit="A", doc="knee current of the breakthrough")
    Nbv = ac.Parameter(0.74, doc="emission coefficient of the breakthrough")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        forward = self.Ids * (exlin(self.v / self.Vt, self.Maxexp) - 1)
        reverse = self.Ibv * exlin(-(self.v + self.Bv) / (self.Nbv * self.Vt), self.Maxexp)
        yield ac.Eq(self.i, forward - reverse + self.v / self.R)
        yield ac.Eq(self.LossPower, self.v * self.i)
