"""Signal blocks of the planar library (`PlanarMechanics.Utilities.Blocks`)."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import blocks, icons

from .friction import s_form

__modelica__ = "PlanarMechanics.Utilities.Blocks"


class LimiterS(blocks.SISO):
    """A limiter with a smooth transition: ``y_min`` up to ``x_min``, ``y_max`` from ``x_max`` on, a cubic between."""

    ICON = icons.S_LIMITER

    x_min = ac.Parameter(0.0, doc="input up to which the output is y_min")
    x_max = ac.Parameter(1.0, doc="input from which on the output is y_max")
    y_min = ac.Parameter(0.0, doc="least output")
    y_max = ac.Parameter(1.0, doc="greatest output")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.y, s_form(self.u, self.x_min, self.x_max, self.y_min, self.y_max))


class SquaretimesSign(ac.Component):
    """``blockSize`` inputs squared with their signs kept: ``y = u |u|``."""

    ICON = icons.block("u|u|")

    blockSize = ac.Option(1, doc="number of inputs and of outputs")
    u = ac.Input(shape="blockSize", doc="input signals")
    y = ac.Output(shape="blockSize", doc="output signals")

    def equations(self) -> Iterator[ac.Eq]:
        for u, y in zip(self.u, self.y, strict=True):
            yield ac.Eq(y, u * ac.Abs(u))
