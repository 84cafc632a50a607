"""Logical operations on several signals, edges, and a delay (`Modelica.Blocks.MathBoolean`)."""

from collections.abc import Iterator, Sequence
from functools import partial, reduce
from operator import and_, or_
from typing import Any

import acausal as ac
from acausal.components import icons

from . import logical, memory
from .conventions import TRUE, discrete_output, truth
from .interfaces import SISO, PartialBooleanMISO, Switching

__modelica__ = "Modelica.Blocks.MathBoolean"


class MultiSwitch(Switching):
    """The truth value in ``expr`` that belongs to the first input that is true.

    Without one, the previous output with ``use_pre_as_default``, else ``y_default``.
    """

    ICON = icons.marked(icons.SWITCHED, "n")

    use_pre_as_default = ac.Option(True, doc="whether the output is kept where no input is true")
    y_default = ac.Option(False, doc="output where no input is true, and before the start")
    y = discrete_output("y_default", kind="bool", doc="output signal, 1 or 0")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        default = ac.pre(self.y) if self.use_pre_as_default else int(self.y_default)
        yield ac.Eq(self.y, self._chosen(default))


class _Operation(PartialBooleanMISO):
    """A logical operation on all inputs."""

    def _holds(self, inputs: Sequence[Any]) -> Any:
        raise NotImplementedError

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, truth(self._holds([u > TRUE for u in self.u])))


class And(_Operation):
    """True where all inputs are true."""

    ICON = icons.truths(icons.block("and"), "u y")

    def _holds(self, inputs: Sequence[Any]) -> Any:
        return reduce(and_, inputs, True)


class Or(_Operation):
    """True where any input is true."""

    ICON = icons.truths(icons.block("or"), "u y")

    def _holds(self, inputs: Sequence[Any]) -> Any:
        return reduce(or_, inputs, False)


class Xor(_Operation):
    """True where exactly one input is true."""

    ICON = icons.truths(icons.block("xor"), "u y")

    def _holds(self, inputs: Sequence[Any]) -> Any:
        others = [[~u for u in inputs if u is not one] for one in inputs]
        return reduce(or_, map(partial(reduce, and_), others, inputs), False)


class Nand(And):
    """True where any input is false."""

    ICON = icons.truths(icons.block("nand"), "u y")

    def _holds(self, inputs: Sequence[Any]) -> Any:
        return negated(super()._holds(inputs))


class Nor(Or):
    """True where all inputs are false."""

    ICON = icons.truths(icons.block("nor"), "u y")

    def _holds(self, inputs: Sequence[Any]) -> Any:
        return negated(super()._holds(inputs))


class Not(logical.Not):
    """True where the input is false."""


class RisingEdge(memory.Edge):
    """True at the moment the input turns true."""

    ICON = icons.truths(icons.block("↑"), "u y")


class FallingEdge(memory.FallingEdge):
    """True at the moment the input turns false."""

    ICON = icons.truths(icons.block("↓"), "u y")


class ChangingEdge(memory.Change):
    """True at the moment the input changes."""

    ICON = icons.truths(icons.marked(icons.block("↕"), "m"), "u y")


class OnDelay(SISO):
    """The input, a rise ``delayTime`` [s] late, a fall at once."""

    ICON = icons.truths(icons.block("t →"), "u y")

    delayTime = ac.Parameter(unit="s", min=0, doc="delay of a rise")
    delaySignal = ac.Discrete(kind="bool", doc="whether a rise is waited for, or has come")
    t_next = ac.Discrete(unit="s", doc="when the output rises")

    def equations(self) -> Iterator[Any]:
        on = self.u > TRUE
        yield ac.When(
            ac.initial(),
            ac.Eq(self.delaySignal, truth(on)),
            ac.Eq(self.t_next, ac.time - 1),
            otherwise=ac.When(
                on,
                ac.Eq(self.delaySignal, 1),
                ac.Eq(self.t_next, ac.time + self.delayTime),
                otherwise=ac.When(
                    self.u <= TRUE,
                    ac.Eq(self.delaySignal, 0),
                    ac.Eq(self.t_next, ac.time - 1),
                ),
            ),
        )
        risen = (self.delaySignal > TRUE) & (ac.time >= self.t_next)
        yield ac.Eq(self.y, truth(risen, events=True))


def negated(condition: Any) -> Any:
    """The opposite of a condition or truth value."""
    return not condition if isinstance(condition, bool) else ~condition
