"""Ideal elements; switches and operational amplifiers come from their own modules."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .interfaces import IdealSemiconductor, OnePort, TwoPort
from .laws import TRUE

__modelica__ = "Modelica.Electrical.Analog.Ideal"


class IdealDiode(IdealSemiconductor):
    """Ideal diode: it blocks where ``s < 0``, that is below ``Vknee``. See `IdealSemiconductor`."""

    ICON = icons.IDEAL_DIODE

    @property
    def _blocks(self) -> Any:
        return self.s < 0


class IdealThyristor(IdealSemiconductor):
    """Ideal thyristor: fired by the signal ``fire > 0.5`` above ``Vknee``, it conducts until ``s < 0``."""

    ICON = icons.IDEAL_THYRISTOR

    fire = ac.Input(kind="bool", doc="fires above 0.5 (Modelica: true)")

    @property
    def _blocks(self) -> Any:
        return (self.s < 0) | ((ac.pre(self.off) > TRUE) & (self.fire <= TRUE))


class IdealGTOThyristor(IdealSemiconductor):
    """Ideal switching transistor: it conducts above ``Vknee`` while the signal ``fire > 0.5``."""

    ICON = icons.GTO

    fire = ac.Input(kind="bool", doc="may conduct above 0.5 (Modelica: true)")

    @property
    def _blocks(self) -> Any:
        return (self.s < 0) | (self.fire <= TRUE)


class IdealTransformer(TwoPort):
    """Ideal transformer: ``v1 = n v2``, and ``i1 + i2/n = im1``, the magnetizing current.

    Without ``considerMagnetization`` ``im1 = 0``; with it ``v1 = der(psim1)``, ``psim1 = Lm1 im1``.
    """

    ICON = icons.marked(icons.TRANSFORMER, "n")

    n = ac.Parameter(doc="turns ratio, primary to secondary voltage")
    considerMagnetization = ac.Option(False, doc="whether there is a magnetizing current")
    Lm1 = ac.Parameter(
        unit="H", when="considerMagnetization", doc="magnetizing inductance, primary side"
    )
    im1 = ac.Variable(unit="A", doc="magnetizing current, primary side")
    psim1 = ac.Variable(unit="Wb", doc="flux linkage, primary side")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.im1, self.i1 + self.i2 / self.n)
        if self.considerMagnetization:
            yield ac.Eq(self.psim1, self.Lm1 * self.im1)
            yield ac.Eq(self.v1, ac.der(self.psim1))
        else:
            yield ac.Eq(self.psim1, 0)
            yield ac.Eq(self.im1, 0)
        yield ac.Eq(self.v1, self.n * self.v2)


class Idle(OnePort):
    """An interruption: ``i = 0``."""

    ICON = icons.IDLE

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.i, 0)


class Short(OnePort):
    """A short cut: ``v = 0``."""

    ICON = icons.SHORT

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, 0)
