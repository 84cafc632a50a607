"""One-ports as signals, so that a circuit can be cut there."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .interfaces import NegativePin, PositivePin

__modelica__ = "Modelica.Electrical.Analog.Basic"


class _Adaptor(ac.Component):
    """Two pins with ``v = pin_p.v - pin_n.v`` and ``i = pin_p.i = -pin_n.i``."""

    use_pder = ac.Option(True, doc="whether there is a signal for the derivative of the voltage")
    use_fder = ac.Option(True, doc="whether there is a signal for the derivative of the current")
    pin_p = PositivePin()
    pin_n = NegativePin()
    v = ac.Variable(unit="V", doc="voltage from pin_p to pin_n")
    i = ac.Variable(unit="A", doc="current from pin_p to pin_n")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.v, self.pin_p.v - self.pin_n.v)
        yield ac.Eq(self.i, self.pin_p.i)
        yield ac.Eq(0, self.pin_p.i + self.pin_n.i)


class GeneralCurrentToVoltageAdaptor(_Adaptor):
    """Current in, voltage out: ``i = f``, ``p = v``.

    With ``use_pder`` the output ``pder = der(v)``. With ``use_fder`` the input ``fder`` is taken for the
    derivative of ``f`` where the model needs it; without, ``f`` is differentiated. It holds no ground.
    """

    ICON = icons.block("i → v")

    f = ac.Input(unit="A", doc="current")
    fder = ac.Input(unit="A/s", when="use_fder", doc="derivative of the current")
    p = ac.Output(unit="V", doc="voltage")
    pder = ac.Output(unit="V/s", when="use_pder", doc="derivative of the voltage")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.p, self.v)
        yield ac.Eq(self.i, ac.prescribed(self.f, *([self.fder] if self.use_fder else [])))
        if self.use_pder:
            yield ac.Eq(self.pder, ac.der(self.p))


class GeneralVoltageToCurrentAdaptor(_Adaptor):
    """Voltage in, current out: ``v = p``, ``f = -i``, the current that drives what is connected.

    With ``use_fder`` the output ``fder = der(f)``. With ``use_pder`` the input ``pder`` is taken for the
    derivative of ``p`` where the model needs it; without, ``p`` is differentiated. It holds no ground.
    """

    ICON = icons.block("v → i")

    p = ac.Input(unit="V", doc="voltage")
    pder = ac.Input(unit="V/s", when="use_pder", doc="derivative of the voltage")
    f = ac.Output(unit="A", doc="current")
    fder = ac.Output(unit="A/s", when="use_fder", doc="derivative of the current")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, -self.i)
        yield ac.Eq(self.v, ac.prescribed(self.p, *([self.pder] if self.use_pder else [])))
        if self.use_fder:
            yield ac.Eq(self.fder, ac.der(self.f))
