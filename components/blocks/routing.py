"""Signals put together, taken apart and passed on."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .interfaces import MIMO, MISO, SIMO, SISO, MIMOs

__modelica__ = "Modelica.Blocks.Routing"


class Replicator(SIMO):
    """``nout`` times the input: ``y[i] = u``."""

    ICON = icons.FAN_OUT

    def equations(self) -> Iterator[ac.Eq]:
        for y in self.y:
            yield ac.Eq(y, self.u)


IntegerReplicator = BooleanReplicator = Replicator


class RealPassThrough(SISO):
    """``y = u``."""

    ICON = icons.block("→")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.u)


IntegerPassThrough = BooleanPassThrough = RealPassThrough


class ExtractSignal(MIMO):
    """``y[i] = u[extract[i]]``; ``extract`` counts from 1 and is ``1, 2, ..., nout`` by default."""

    ICON = icons.block("[i, j]")

    nin = ac.Option(1, doc="number of inputs")
    nout = ac.Option(1, doc="number of outputs")
    extract = ac.Option(None, doc="which inputs are passed on")

    def equations(self) -> Iterator[ac.Eq]:
        extract = range(1, self.nout + 1) if self.extract is None else self.extract
        if len(extract) != self.nout or not all(1 <= i <= self.nin for i in extract):
            raise ac.DeclarationError(
                f"ExtractSignal: extract={self.extract} must name {self.nout} of {self.nin} inputs"
            )
        for y, i in zip(self.y, extract, strict=True):
            yield ac.Eq(y, self.u[int(i) - 1])


class Extractor(MISO):
    """``y = u[index]`` with an index signal that is rounded to an integer from 1 to ``nin``.

    Outside of that range the output is ``outOfRangeValue`` with ``allowOutOfRange``; without it that of the
    nearest input (Modelica stops there).
    """

    ICON = icons.block("[i]")

    allowOutOfRange = ac.Option(False, doc="whether the index may leave its range")
    outOfRangeValue = ac.Parameter(1e10, doc="output where it does")
    index = ac.Input(start=1.0, doc="number of the input that is passed on")

    def equations(self) -> Iterator[ac.Eq]:
        value: Any = self.u[-1]
        for i in range(self.nin - 1, 0, -1):
            value = ac.where(self.index < i + 0.5, self.u[i - 1], value)
        if self.allowOutOfRange:
            within = (self.index > 0.5) & (self.index < self.nin + 0.5)
            value = ac.where(within, value, self.outOfRangeValue)
        yield ac.Eq(self.y, value)


class Multiplex(MIMOs):
    """``n`` scalar inputs as one vector: ``y = u``."""

    ICON = icons.marked(icons.FAN_IN, "n")

    n = ac.Option(0, doc="number of inputs and of outputs")

    def equations(self) -> Iterator[ac.Eq]:
        for y, u in zip(self.y, self.u, strict=True):
            yield ac.Eq(y, u)


class DeMultiplex(Multiplex):
    """A vector as ``n`` scalar outputs: ``y = u``."""

    ICON = icons.marked(icons.FAN_OUT, "n")


class Multiplex2(ac.Component):
    """Vectors ``u1``, ``u2`` of ``n1``, ``n2`` signals as one: ``y = [u1; u2]``."""

    ICON = icons.marked(icons.FAN_IN, "2")

    n1 = ac.Option(1, doc="size of u1")
    n2 = ac.Option(1, doc="size of u2")
    u1 = ac.Input(shape="n1", doc="first input signals")
    u2 = ac.Input(shape="n2", doc="second input signals")
    y = ac.Output(shape="nout", doc="all of them")

    @property
    def _inputs(self) -> tuple[Any, ...]:
        """All inputs in order."""
        return (*self.u1, *self.u2)

    @property
    def nout(self) -> int:
        """Number of outputs."""
        return len(self._inputs)

    def equations(self) -> Iterator[ac.Eq]:
        for y, u in zip(self.y, self._inputs, strict=True):
            yield ac.Eq(y, u)


class Multiplex3(Multiplex2):
    """Vectors ``u1`` to ``u3`` as one."""

    ICON = icons.marked(icons.FAN_IN, "3")

    n3 = ac.Option(1, doc="size of u3")
    u3 = ac.Input(shape="n3", doc="third input signals")

    @property
    def _inputs(self) -> tuple[Any, ...]:
        return (*super()._inputs, *self.u3)


class Multiplex4(Multiplex3):
    """Vectors ``u1`` to ``u4`` as one."""

    ICON = icons.marked(icons.FAN_IN, "4")

    n4 = ac.Option(1, doc="size of u4")
    u4 = ac.Input(shape="n4", doc="fourth input signals")

    @property
    def _inputs(self) -> tuple[Any, ...]:
        return (*super()._inputs, *self.u4)


class Multiplex5(Multiplex4):
    """Vectors ``u1`` to ``u5`` as one."""

    ICON = icons.marked(icons.FAN_IN, "5")

    n5 = ac.Option(1, doc="size of u5")
    u5 = ac.Input(shape="n5", doc="fifth input signals")

    @property
    def _inputs(self) -> tuple[Any, ...]:
        return (*super()._inputs, *self.u5)


class Multiplex6(Multiplex5):
    """Vectors ``u1`` to ``u6`` as one."""

    ICON = icons.marked(icons.FAN_IN, "6")

    n6 = ac.Option(1, doc="size of u6")
    u6 = ac.Input(shape="n6", doc="sixth input signals")

    @property
    def _inputs(self) -> tuple[Any, ...]:
        return (*super()._inputs, *self.u6)


class DeMultiplex2(ac.Component):
    """A vector taken apart into ``y1``, ``y2`` of ``n1``, ``n2`` signals: ``[y1; y2] = u``."""

    ICON = icons.marked(icons.FAN_OUT, "2")

    n1 = ac.Option(1, doc="size of y1")
    n2 = ac.Option(1, doc="size of y2")
    u = ac.Input(shape="nin", doc="input signals")
    y1 = ac.Output(shape="n1", doc="the first of them")
    y2 = ac.Output(shape="n2", doc="the next")

    @property
    def _outputs(self) -> tuple[Any, ...]:
        """All outputs in order."""
        return (*self.y1, *self.y2)

    @property
    def nin(self) -> int:
        """Number of inputs."""
        return len(self._outputs)

    def equations(self) -> Iterator[ac.Eq]:
        for y, u in zip(self._outputs, self.u, strict=True):
            yield ac.Eq(y, u)


class DeMultiplex3(DeMultiplex2):
    """A vector taken apart into ``y1`` to ``y3``."""

    ICON = icons.marked(icons.FAN_OUT, "3")

    n3 = ac.Option(1, doc="size of y3")
    y3 = ac.Output(shape="n3", doc="the next")

    @property
    def _outputs(self) -> tuple[Any, ...]:
        return (*super()._outputs, *self.y3)


class DeMultiplex4(DeMultiplex3):
    """A vector taken apart into ``y1`` to ``y4``."""

    ICON = icons.marked(icons.FAN_OUT, "4")

    n4 = ac.Option(1, doc="size of y4")
    y4 = ac.Output(shape="n4", doc="the next")

    @property
    def _outputs(self) -> tuple[Any, ...]:
        return (*super()._outputs, *self.y4)


class DeMultiplex5(DeMultiplex4):
    """A vector taken apart into ``y1`` to ``y5``."""

    ICON = icons.marked(icons.FAN_OUT, "5")

    n5 = ac.Option(1, doc="size of y5")
    y5 = ac.Output(shape="n5", doc="the next")

    @property
    def _outputs(self) -> tuple[Any, ...]:
        return (*super()._outputs, *self.y5)


class DeMultiplex6(DeMultiplex5):
    """A vector taken apart into ``y1`` to ``y6``."""

    ICON = icons.marked(icons.FAN_OUT, "6")

    n6 = ac.Option(1, doc="size of y6")
    y6 = ac.Output(shape="n6", doc="the last")

    @property
    def _outputs(self) -> tuple[Any, ...]:
        return (*super()._outputs, *self.y6)
