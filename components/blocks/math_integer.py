"""Sums, products, switches and counters of integers (`Modelica.Blocks.MathInteger`)."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from . import math
from .conventions import TRUE, discrete_output, rises, truth
from .interfaces import SISO, Switching

__modelica__ = "Modelica.Blocks.MathInteger"


class MultiSwitch(Switching):
    """The integer in ``expr`` that belongs to the first input that is true.

    Without one, the previous output with ``use_pre_as_default``, else ``y_default``.
    """

    ICON = icons.marked(icons.SWITCHED, "n")

    use_pre_as_default = ac.Option(True, doc="whether the output is kept where no input is true")
    y_default = ac.Parameter(0.0, doc="output where no input is true, and before the start")
    y = discrete_output("y_default", kind="int", doc="output signal")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        default = ac.pre(self.y) if self.use_pre_as_default else self.y_default
        yield ac.Eq(self.y, self._chosen(default))


class Sum(math.MultiSum):
    """``y = k[1] u[1] + ... + k[nu] u[nu]``."""

    ICON = icons.integers(icons.SUM, "u y")


class Product(math.MultiProduct):
    """``y = u[1] ... u[nu]``; 0 without inputs."""

    ICON = icons.integers(icons.PRODUCT, "u y")


class TriggeredAdd(SISO):
    """Adds ``u`` to the output where ``trigger`` turns true.

    With ``use_reset`` the output becomes ``y_start`` where ``reset`` turns true, or with ``use_set`` the input
    ``set``.
    """

    ICON = icons.block("+=")

    use_reset = ac.Option(False, doc="whether there is the input reset")
    use_set = ac.Option(False, doc="whether there is the input set")
    y_start = ac.Parameter(0.0, doc="initial value of the output")
    trigger = ac.Input(doc="when the input is added")
    reset = ac.Input(when="use_reset", doc="when the output is reset")
    set = ac.Input(when="use_set", doc="what it is reset to")
    y = discrete_output("y_start", kind="int", doc="output signal")
    triggered = ac.Discrete(kind="bool", doc="whether the trigger is true")
    resetting = ac.Discrete(kind="bool", when="use_reset", doc="whether the reset is true")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.triggered, truth(self.trigger > TRUE))
        before = ac.pre(self.y)
        added = ac.where(rises(self.triggered), before + self.u, before)
        if not self.use_reset:
            yield ac.Eq(self.y, added)
            return
        yield ac.Eq(self.resetting, truth(self.reset > TRUE))
        back = self.set if self.use_set else self.y_start
        both = (self.resetting > TRUE) & (rises(self.resetting) | rises(self.triggered))
        yield ac.Eq(self.y, ac.where(both, back, added))
