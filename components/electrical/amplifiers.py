"""Operational amplifiers that are not ideal."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .interfaces import NegativePin, PositivePin

__modelica__ = "Modelica.Electrical.Analog.Basic"


class OpAmp(ac.Component):
    """Amplifier with a smooth characteristic between the potentials of ``VMin`` and ``VMax``.

    ``out.v = (VMax.v + VMin.v)/2 + a vin/(1 + a |2 vin/(VMax.v - VMin.v)|)`` with ``a = |Slope|`` and
    ``vin = in_p.v - in_n.v``. Current flows at ``out`` only.
    """

    ICON = icons.OP_AMP

    Slope = ac.Parameter(doc="slope of the characteristic at vin = 0")
    in_p = PositivePin()
    in_n = NegativePin()
    out = PositivePin()
    VMax = PositivePin()
    VMin = NegativePin()
    vin = ac.Variable(unit="V", doc="input voltage")

    def equations(self) -> Iterator[ac.Eq]:
        for pin in (self.in_p, self.in_n, self.VMax, self.VMin):
            yield ac.Eq(pin.i, 0)
        yield ac.Eq(self.vin, self.in_p.v - self.in_n.v)
        middle, half = (self.VMax.v + self.VMin.v) / 2, (self.VMax.v - self.VMin.v) / 2
        amplified = ac.Abs(self.Slope) * self.vin
        yield ac.Eq(self.out.v, middle + amplified / (1 + ac.Abs(amplified / half)))


class OpAmpDetailed(ac.Component):
    """Amplifier in five stages, each with its figures of a data sheet.

    - Input: ``p.v - m.v = v_vos + v_in`` with the offset ``v_vos = Vos``; bias currents
      ``I1 = Ib + Ios/2``, ``I2 = Ib - Ios/2`` and resistances ``Rcm`` at either pin;
      ``Rdm`` and ``Cin`` in parallel carry ``v_in``.
    - Frequency response: ``v_in`` through poles at ``fp2``, ``fp3``, ``fp4`` and a zero at ``fz``.
    - Gain: ``q_sum = 10**(Avd0/20) (q_fr3 + (v_3 + v_4)/(2 10**(CMRR/20)))``, bounded by the supply,
      through the pole at ``fp1``.
    - Slew rate: ``v_source`` follows with rates between ``-|sr_m|`` and ``|sr_p|`` and the delay ``Ts``.
    - Output: ``i_out = (v_out - v_source)/Rout``, bounded to ``-|Imaxso|`` ... ``|Imaxsi|``.

    Conelly, Choi: Macromodelling with SPICE, 1992. It starts with ``v_source = q_fp1``.
    """

    ICON = icons.marked(icons.OP_AMP, "…")

    Rdm = ac.Parameter(2e6, unit="Ohm", doc="input resistance, differential mode")
    Rcm = ac.Parameter(2e9, unit="Ohm", doc="input resistance, common mode")
    Cin = ac.Parameter(1.4e-12, unit="F", doc="input capacitance")
    Vos = ac.Parameter(1e-3, unit="V", doc="input offset voltage")
    Ib = ac.Parameter(80e-9, unit="A", doc="input bias current")
    Ios = ac.Parameter(20e-9, unit="A", doc="input offset current")
    vcp = ac.Parameter(0.0, unit="V", doc="correction of the limit by p_supply")
    vcm = ac.Parameter(0.0, unit="V", doc="correction of the limit by m_supply")
    Avd0 = ac.Parameter(106.0, doc="differential gain [dB]")
    CMRR = ac.Parameter(90.0, doc="common-mode rejection [dB]")
    fp1 = ac.Parameter(5.0, unit="Hz", doc="dominant pole")
    fp2 = ac.Parameter(2e6, unit="Hz", doc="pole")
    fp3 = ac.Parameter(20e6, unit="Hz", doc="pole")
    fp4 = ac.Parameter(100e6, unit="Hz", doc="pole")
    fz = ac.Parameter(5e6, unit="Hz", doc="zero")
    sr_p = ac.Parameter(0.5e6, unit="V/s", doc="slew rate of a rise")
    sr_m = ac.Parameter(0.5e6, unit="V/s", doc="slew rate of a fall")
    Rout = ac.Parameter(75.0, unit="Ohm", min=0, doc="output resistance")
    Imaxso = ac.Parameter(25e-3, unit="A", doc="greatest current out of the output")
    Imaxsi = ac.Parameter(25e-3, unit="A", doc="greatest current into the output")
    Ts = ac.Parameter(1.2e-6, unit="s", min=0, doc="delay of the slew rate stage")

    p = PositivePin()
    m = NegativePin()
    outp = PositivePin()
    p_supply = PositivePin()
    m_supply = NegativePin()
    v_pos = ac.Variable(unit="V", doc="positive supply")
    v_neg = ac.Variable(unit="V", doc="negative supply")
    v_vos = ac.Variable(unit="V", doc="offset voltage")
    v_3 = ac.Variable(unit="V", doc="potential behind the offset")
    v_in = ac.Variable(unit="V", doc="differential voltage")
    v_4 = ac.Variable(unit="V", doc="potential at m")
    i_vos = ac.Variable(unit="A", doc="current into p")
    i_3 = ac.Variable(unit="A", doc="common-mode current at p")
    i_r2 = ac.Variable(unit="A", doc="current through Rdm")
    i_c3 = ac.Variable(unit="A", doc="current through Cin")
    i_4 = ac.Variable(unit="A", doc="common-mode current at m")
    q_fr1 = ac.Variable(unit="V", doc="behind the pole fp2")
    q_fr2 = ac.Variable(unit="V", doc="behind the pole fp3 and the zero fz")
    q_fr3 = ac.Variable(unit="V", doc="behind the pole fp4")
    q_sum = ac.Variable(unit="V", doc="amplified voltage")
    q_sum_help = ac.Variable(unit="V", doc="amplified voltage, bounded")
    q_fp1 = ac.Variable(unit="V", doc="behind the pole fp1")
    v_source = ac.Variable(unit="V", doc="source of the output")
    x = ac.Variable(unit="V", doc="integral of the unbounded slew rate")
    v_out = ac.Variable(unit="V", doc="potential of the output")
    i_out = ac.Variable(unit="A", doc="current into the output")
    s = ac.Variable(unit="A", doc="position on the characteristic of the output")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.v_pos, self.p_supply.v)
        yield ac.Eq(self.v_neg, self.m_supply.v)
        yield ac.Eq(self.p_supply.i, 0)
        yield ac.Eq(self.m_supply.i, 0)
        yield from self._input()
        yield from self._response()
        yield from self._gain()
        yield from self._output()

    def initial_equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.v_source, self.q_fp1)
        yield ac.Eq(self.x, 0)

    def _input(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.p.i, self.i_vos)
        yield ac.Eq(self.m.i, self.i_4 - self.i_r2 - self.i_c3)
        yield ac.Eq(0, self.i_3 + self.i_r2 + self.i_c3 - self.i_vos)
        yield ac.Eq(self.p.v - self.m.v, self.v_vos + self.v_in)
        yield ac.Eq(self.v_4, self.m.v)
        yield ac.Eq(self.v_3, self.p.v - self.v_vos)
        yield ac.Eq(self.v_vos, self.Vos)
        yield ac.Eq(self.i_3, self.Ib + self.Ios / 2 + self.v_3 / self.Rcm)
        yield ac.Eq(self.v_in, self.Rdm * self.i_r2)
        yield ac.Eq(self.i_c3, self.Cin * ac.der(self.v_in))
        yield ac.Eq(self.i_4, self.Ib - self.Ios / 2 + self.v_4 / self.Rcm)

    def _response(self) -> Iterator[ac.Eq]:
        w2, w3, w4, wz = (2 * ac.pi * f for f in (self.fp2, self.fp3, self.fp4, self.fz))
        lead = self.q_fr1 + ac.der(self.q_fr1) / wz
        yield ac.Eq(ac.der(self.q_fr1), w2 * (self.v_in - self.q_fr1))
        yield ac.Eq(self.q_fr2 + ac.der(self.q_fr2) / w3, lead)
        yield ac.Eq(ac.der(self.q_fr3), w4 * (self.q_fr2 - self.q_fr3))

    def _gain(self) -> Iterator[ac.Eq]:
        gain = 10 ** (self.Avd0 / 20)
        common = gain / 10 ** (self.CMRR / 20) / 2
        high, low = self.v_pos - ac.Abs(self.vcp), self.v_neg + ac.Abs(self.vcm)
        above = (self.q_sum > high) & (self.q_fp1 >= high)
        below = (self.q_sum < low) & (self.q_fp1 <= low)
        bounded = ac.where(above, high, ac.where(below, low, self.q_sum))
        yield ac.Eq(self.q_sum, gain * self.q_fr3 + common * (self.v_3 + self.v_4))
        yield ac.Eq(self.q_sum_help, bounded)
        yield ac.Eq(ac.der(self.q_fp1), 2 * ac.pi * self.fp1 * (self.q_sum_help - self.q_fp1))

    def _output(self) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.x), (self.q_fp1 - self.v_source) / self.Ts)
        rate = _bounded(ac.der(self.x), -ac.Abs(self.sr_m), ac.Abs(self.sr_p))
        yield ac.Eq(ac.der(self.v_source), rate)
        yield ac.Eq(self.v_out, self.outp.v)
        yield ac.Eq(self.i_out, self.outp.i)
        # i_out and v_out both as functions of s, which is 0 where v_out = v_source: Newton's method starts there
        current = _bounded(self.s, -ac.Abs(self.Imaxso), ac.Abs(self.Imaxsi))
        yield ac.Eq(self.i_out, current)
        yield ac.Eq(self.v_out, self.v_source + self.Rout * (2 * self.s - current))


def _bounded(value: Any, low: Any, high: Any) -> Any:
    return ac.maximum(ac.minimum(value, high), low)
