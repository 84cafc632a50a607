"""Converters between voltages and digital signals, triggered by a digital signal."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.digital.logic import ONE, ZERO, DigitalInput, DigitalOutput, X, is_one

from .interfaces import NegativePin, PositivePin

__modelica__ = "Modelica.Electrical.Analog.Ideal"


class AD_Converter(ac.Component):  # noqa: N801 (Modelica's name)
    """The voltage ``u`` as a number of ``N`` bits ``y``, the least significant first, when ``trig`` turns 1.

    The number is ``(u - VRefLow)/(VRefHigh - VRefLow) (2**N - 1)``, rounded, and not below 0; what does not
    fit into ``N`` bits is left over in ``z``. The input has the resistance ``Rin``.
    """

    ICON = icons.block("A/D")

    N = ac.Option(8, min=1, doc="number of bits")
    VRefHigh = ac.Parameter(unit="V", doc="voltage of the greatest number")
    VRefLow = ac.Parameter(unit="V", doc="voltage of zero")
    Rin = ac.Parameter(unit="Ohm", doc="resistance of the input")
    p = PositivePin()
    n = NegativePin()
    trig = DigitalInput(doc="trigger")
    y = DigitalOutput(shape="N", doc="bits, '1' or '0'; 'X' before the first trigger")
    u = ac.Variable(unit="V", doc="voltage of the input")
    z = ac.Discrete(0, kind="int", doc="what does not fit into the bits")
    code = ac.Discrete(0, kind="int", doc="the number")
    bits = ac.Discrete(X, kind="int", shape="N", doc="the bits")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.p.v - self.n.v, self.u)
        yield ac.Eq(self.p.i * self.Rin, self.u)
        yield ac.Eq(self.p.i + self.n.i, 0)
        share = (self.u - self.VRefLow) / (self.VRefHigh - self.VRefLow)
        code = ac.floor(share * (2**self.N - 1) + 0.5)
        parts = [ac.floor(self.code / 2**k) for k in range(self.N + 1)]
        yield ac.When(
            is_one(self.trig),
            ac.Eq(self.code, ac.where(self.u > self.VRefLow, code, 0)),
            ac.Eq(self.z, parts[-1]),
            *(
                ac.Eq(bit, ac.where(low - 2 * high > 0.5, ONE, ZERO))
                for bit, low, high in zip(self.bits, parts[:-1], parts[1:], strict=True)
            ),
        )
        yield from (ac.Eq(y, bit) for y, bit in zip(self.y, self.bits, strict=True))


class DA_Converter(ac.Component):  # noqa: N801
    """The number ``y`` of ``N`` bits ``x`` as a voltage ``vout = Vref y/(2**N - 1)``, when ``trig`` turns 1.

    ``x[1]`` is the least significant bit. The output is an ideal voltage source.
    """

    ICON = icons.block("D/A")

    N = ac.Option(8, min=1, doc="number of bits")
    Vref = ac.Parameter(unit="V", doc="voltage of the greatest number")
    trig = DigitalInput(doc="trigger")
    x = DigitalInput(shape="N", doc="bits")
    p = PositivePin()
    n = NegativePin()
    vout = ac.Discrete(0.0, unit="V", doc="voltage of the output")
    y = ac.Discrete(0.0, doc="the number")

    def equations(self) -> Iterator[Any]:
        number = sum(2**k * ac.where(is_one(x), 1, 0) for k, x in enumerate(self.x))
        yield ac.When(
            is_one(self.trig),
            ac.Eq(self.y, number),
            ac.Eq(self.vout, self.y * self.Vref / (2**self.N - 1)),
        )
        yield ac.Eq(self.p.v, self.n.v + self.vout)
        yield ac.Eq(self.p.i + self.n.i, 0)
