"""Blocks that show a value in a diagram of Modelica (`Modelica.Blocks.Interaction.Show`): here they pass it on."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .conventions import truth_of

__modelica__ = "Modelica.Blocks.Interaction.Show"


class RealValue(ac.Component):
    """``showNumber`` is the input ``numberPort``, or without ``use_numberPort`` the ``number``.

    The number is given, or stated by an equation of the enclosing model.
    """

    ICON = icons.block("1.23")

    use_numberPort = ac.Option(True, doc="whether there is the input numberPort")
    significantDigits = ac.Option(2, doc="without effect")
    numberPort = ac.Input(when="use_numberPort", doc="what is shown")
    number = ac.Variable(when="not use_numberPort", doc="what is shown without the input")
    showNumber = ac.Output(doc="what is shown")

    def __init__(self, *, number: Any = None, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.given = number

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.showNumber, self.numberPort if self.use_numberPort else self.number)
        if self.given is not None and not self.use_numberPort:
            yield ac.Eq(self.number, self.given)


class IntegerValue(RealValue):
    """A `RealValue` for integers."""

    ICON = icons.integers(icons.block("123"), "numberPort")


class BooleanValue(ac.Component):
    """``showActive`` is the input ``activePort``, or without ``use_activePort`` the truth value ``active``.

    That is given, or stated by an equation of the enclosing model.
    """

    ICON = icons.truths(icons.block("true"), "activePort")

    use_activePort = ac.Option(True, doc="whether there is the input activePort")
    activePort = ac.Input(when="use_activePort", doc="what is shown")
    active = ac.Variable(when="not use_activePort", doc="what is shown without the input")
    showActive = ac.Output(doc="what is shown, 1 or 0")

    def __init__(self, *, active: Any = None, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.given = active

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.showActive, self.activePort if self.use_activePort else self.active)
        if self.given is not None and not self.use_activePort:
            yield ac.Eq(self.active, truth_of(self.given))
