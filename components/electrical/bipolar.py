"""Bipolar junction transistors after Ebers and Moll, with junction capacitances (Vlach 1983)."""

from collections.abc import Iterator
from typing import Any, ClassVar, NamedTuple

import acausal as ac
from acausal.components import icons, nature

from .diodes import _TemperatureDependent
from .interfaces import NegativePin, Pin
from .laws import exlin2

__modelica__ = "Modelica.Electrical.Analog.Semiconductors"


class _Junction(NamedTuple):
    """One of the two diodes: its variables, and what its law needs."""

    v: Any
    i: Any
    c: Any
    depletion: Any
    emission: Any
    conductance: Any
    transit: Any
    capacity: Any
    diffusion: Any
    exponent: Any


class _Bipolar(_TemperatureDependent):
    """The law of both transistors; with ``polarity`` -1 voltages and currents are mirrored.

    Each junction, from the base, has ``i = is_t (exp(v/w) - 1) + v G`` and the capacitance
    ``c = Tau is_t exp(v/w)/w + C (1 - v/Phi)**-M`` with ``w = N vt_t``; exponentials are linear
    outside of ``EMin`` ... ``EMax``, the power above 0. The substrate takes ``iS = -Ccs der(vcs)``.
    """

    ICON = icons.TRANSISTOR

    polarity: ClassVar[int] = 1

    C = Pin()
    B = Pin()
    E = Pin()
    S = NegativePin(when="useSubstrate")
    Bf = ac.Parameter(50.0, doc="forward beta")
    Br = ac.Parameter(0.1, doc="reverse beta")
    Is = ac.Parameter(1e-16, unit="A", doc="transport saturation current")
    Vak = ac.Parameter(0.02, unit="1/V", doc="inverse Early voltage")
    Tauf = ac.Parameter(0.12e-9, unit="s", doc="ideal forward transit time")
    Taur = ac.Parameter(5e-9, unit="s", doc="ideal reverse transit time")
    Ccs = ac.Parameter(1e-12, unit="F", doc="capacitance from collector to substrate")
    Cje = ac.Parameter(0.4e-12, unit="F", doc="zero bias depletion capacitance, base to emitter")
    Cjc = ac.Parameter(0.5e-12, unit="F", doc="zero bias depletion capacitance, base to collector")
    Phie = ac.Parameter(0.8, unit="V", doc="diffusion voltage, base to emitter")
    Me = ac.Parameter(0.4, doc="gradation exponent, base to emitter")
    Phic = ac.Parameter(0.8, unit="V", doc="diffusion voltage, base to collector")
    Mc = ac.Parameter(0.333, doc="gradation exponent, base to collector")
    Gbc = ac.Parameter(1e-15, unit="S", doc="conductance from base to collector")
    Gbe = ac.Parameter(1e-15, unit="S", doc="conductance from base to emitter")
    EMin = ac.Parameter(-100.0, doc="exponent below which the exponential is linear")
    EMax = ac.Parameter(40.0, doc="exponent above which the exponential is linear")
    Vt = ac.Parameter(0.02585, unit="V", doc="thermal voltage without temperature dependency")
    Tnom = ac.Parameter(300.15, unit="K", min=0, doc="temperature at which parameters were taken")
    XTI = ac.Parameter(3.0, doc="temperature exponent of Is")
    XTB = ac.Parameter(0.0, doc="temperature exponent of the betas")
    EG = ac.Parameter(1.11, unit="V", doc="energy gap for the temperature dependency of Is")
    NF = ac.Parameter(1.0, doc="forward current emission coefficient")
    NR = ac.Parameter(1.0, doc="reverse current emission coefficient")
    IC = ac.Parameter(0.0, unit="V", doc="initial voltage from collector to substrate, with UIC")
    UIC = ac.Option(False, doc="whether vcs starts at IC")
    useSubstrate = ac.Option(False, doc="whether there is a pin for the substrate; else grounded")
    vcs = ac.Variable(unit="V", doc="voltage from collector to substrate")
    qbk = ac.Variable(doc="relative majority carrier charge, inverse")
    Capcje = ac.Variable(unit="F", doc="depletion capacitance, base to emitter")
    Capcjc = ac.Variable(unit="F", doc="depletion capacitance, base to collector")
    is_t = ac.Variable(unit="A", doc="saturation current at the actual temperature")
    br_t = ac.Variable(doc="reverse beta at the actual temperature")
    bf_t = ac.Variable(doc="forward beta at the actual temperature")
    vt_t = ac.Variable(unit="V", doc="thermal voltage")
    hexp = ac.Variable(doc="exponent of the temperature dependency")
    htempexp = ac.Variable(doc="its exponential")
    vS = ac.Variable(unit="V", doc="potential of the substrate")
    iS = ac.Variable(unit="A", doc="current into the substrate")

    @property
    def _collector(self) -> tuple[Any, Any, Any]:
        """Voltage, current and capacitance between base and collector."""
        raise NotImplementedError

    @property
    def _emitter(self) -> tuple[Any, Any, Any]:
        """Voltage, current and capacitance between base and emitter."""
        raise NotImplementedError

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        bc = _Junction(
            *self._collector,
            self.Capcjc,
            self.NR,
            self.Gbc,
            self.Taur,
            self.Cjc,
            self.Phic,
            self.Mc,
        )
        be = _Junction(
            *self._emitter, self.Capcje, self.NF, self.Gbe, self.Tauf, self.Cje, self.Phie, self.Me
        )
        sign = self.polarity
        yield ac.Eq(bc.v, sign * (self.B.v - self.C.v))
        yield ac.Eq(be.v, sign * (self.B.v - self.E.v))
        yield from self._temperature()
        yield from self._junction(bc)
        yield from self._junction(be)
        yield ac.Eq(self.qbk, 1 - bc.v * self.Vak)
        transport = (be.i - bc.i) * self.qbk
        collector = transport - bc.i / self.br_t - bc.c * ac.der(bc.v)
        base = be.i / self.bf_t + bc.i / self.br_t + bc.c * ac.der(bc.v) + be.c * ac.der(be.v)
        yield ac.Eq(self.C.i, sign * collector - self.iS)
        yield ac.Eq(self.B.i, sign * base)
        yield ac.Eq(self.E.i, -self.B.i - self.C.i - self.iS)
        yield from self._substrate()
        forward = sign * (self.C.v - self.E.v)
        loss = bc.v * bc.i / self.br_t + be.v * be.i / self.bf_t + transport * forward
        yield ac.Eq(self.LossPower, loss)

    def initial_equations(self) -> Iterator[ac.Eq]:
        if self.UIC:
            yield ac.Eq(self.vcs, self.IC)

    def _temperature(self) -> Iterator[ac.Eq]:
        ratio = self.T_heatPort / self.Tnom
        hot = self.useTemperatureDependency
        yield ac.Eq(self.vt_t, nature.k * self.T_heatPort / nature.q if hot else self.Vt)
        yield ac.Eq(self.hexp, (ratio - 1) * self.EG / self.vt_t)
        yield ac.Eq(self.htempexp, exlin2(self.hexp, self.EMin, self.EMax))
        yield ac.Eq(self.is_t, self.Is * (ratio**self.XTI * self.htempexp if hot else 1))
        yield ac.Eq(self.br_t, self.Br * (ratio**self.XTB if hot else 1))
        yield ac.Eq(self.bf_t, self.Bf * (ratio**self.XTB if hot else 1))

    def _junction(self, j: _Junction) -> Iterator[ac.Eq]:
        width = j.emission * self.vt_t
        growth = exlin2(j.v / width, self.EMin, self.EMax)
        yield ac.Eq(j.i, self.is_t * (growth - 1) + j.v * j.conductance)
        yield ac.Eq(j.depletion, j.capacity * _powlin(j.v / j.diffusion, j.exponent))
        yield ac.Eq(j.c, j.transit * self.is_t / width * growth + j.depletion)

    def _substrate(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.vcs, self.C.v - self.vS)
        yield ac.Eq(self.iS, -self.Ccs * ac.der(self.vcs))
        yield ac.Eq(self.vS, self.S.v if self.useSubstrate else 0)
        if self.useSubstrate:
            yield ac.Eq(self.S.i, self.iS)


def _powlin(x: Any, exponent: Any) -> Any:
    """``(1 - x)**-exponent``, continued linearly above 0."""
    return (1 - ac.minimum(x, 0)) ** (-exponent) + exponent * ac.maximum(x, 0)


class NPN(_Bipolar):
    """NPN transistor with the pins ``C``, ``B``, ``E``, and with ``useSubstrate`` ``S``.

    ``C.i = (ibe - ibc) qbk - ibc/br_t - cbc der(vbc) - iS``,
    ``B.i = ibe/bf_t + ibc/br_t + cbc der(vbc) + cbe der(vbe)``, ``qbk = 1 - vbc Vak``;
    ``ibc = is_t (exp(vbc/(NR vt_t)) - 1) + Gbc vbc`` and ``ibe`` likewise;
    ``cbc = Taur is_t exp(vbc/(NR vt_t))/(NR vt_t) + Cjc (1 - vbc/Phic)**-Mc`` and ``cbe`` likewise;
    ``iS = -Ccs der(vcs)``. Exponentials are linear outside of ``EMin`` ... ``EMax``, powers above 0.
    With ``useTemperatureDependency`` ``vt_t = k T_heatPort/q``,
    ``is_t = Is (T_heatPort/Tnom)**XTI exp(hexp)`` with ``hexp = (T_heatPort/Tnom - 1) EG/vt_t``, and
    the betas go with ``(T_heatPort/Tnom)**XTB``.
    """

    ICON = icons.NPN

    vbc = ac.Variable(unit="V", doc="voltage from base to collector")
    vbe = ac.Variable(unit="V", doc="voltage from base to emitter")
    ibc = ac.Variable(unit="A", doc="diode current from base to collector")
    ibe = ac.Variable(unit="A", doc="diode current from base to emitter")
    cbc = ac.Variable(unit="F", doc="capacitance from base to collector")
    cbe = ac.Variable(unit="F", doc="capacitance from base to emitter")

    @property
    def _collector(self) -> tuple[Any, Any, Any]:
        return self.vbc, self.ibc, self.cbc

    @property
    def _emitter(self) -> tuple[Any, Any, Any]:
        return self.vbe, self.ibe, self.cbe


class PNP(_Bipolar):
    """PNP transistor: `NPN` with voltages and currents at the junctions and pins negated.

    ``vcb``, ``icb``, ``ccb`` and ``veb``, ``ieb``, ``ceb`` count from collector and emitter to the base.
    """

    ICON = icons.PNP

    polarity = -1

    vcb = ac.Variable(unit="V", doc="voltage from collector to base")
    veb = ac.Variable(unit="V", doc="voltage from emitter to base")
    icb = ac.Variable(unit="A", doc="diode current from collector to base")
    ieb = ac.Variable(unit="A", doc="diode current from emitter to base")
    ccb = ac.Variable(unit="F", doc="capacitance from collector to base")
    ceb = ac.Variable(unit="F", doc="capacitance from emitter to base")

    @property
    def _collector(self) -> tuple[Any, Any, Any]:
        return self.vcb, self.icb, self.ccb

    @property
    def _emitter(self) -> tuple[Any, Any, Any]:
        return self.veb, self.ieb, self.ceb
