"""Comparisons of variables by ``==`` and ``!=``, and what Python cannot decide."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import acausal as ac


class Counted(ac.Component):
    """A count that becomes 2 at 0.5 s, and a rate that depends on it."""

    x = ac.Variable(start=0.0, fixed=True)
    n = ac.Discrete(1, kind="int")
    seen = ac.Discrete(0, kind="bool")

    def __init__(self, holds: Callable[[Any], Any]) -> None:
        super().__init__()
        self.holds = holds

    def equations(self):
        yield ac.Eq(ac.der(self.x), ac.where(self.holds(self), 5.0, 7.0))
        yield ac.When(ac.sample(0.5, 10.0), ac.Eq(self.n, 2))
        yield ac.When(ac.pre(self.n) == 2, ac.Eq(self.seen, 1))


@pytest.mark.cases(fast=1, slow=3)
@pytest.mark.parametrize(
    ("holds", "end"),
    [
        (lambda m: m.n == 1, 6.0),
        (lambda m: 2 == m.n, 6.0),  # noqa: SIM300
        (lambda m: m.n != np.int32(1), 6.0),
        (lambda m: (m.n == 1) | (m.n == 2), 5.0),
        (lambda m: m.seen == False, 6.0),  # noqa: E712
        (lambda m: m.n == m.seen, 7.0),
        (lambda m: m.n != m.seen, 5.0),
    ],
)
def test_a_whole_number_equals_another(holds: Callable[[Any], Any], end: float) -> None:
    run = ac.simulate(ac.compile(Counted(holds)), (0.0, 1.0))
    assert float(run["x"][-1]) == pytest.approx(end, rel=1e-9)
    assert float(run["seen"][-1]) == 1


@pytest.mark.parametrize(
    ("holds", "sentence"),
    [
        (
            lambda m: m.x == 1,
            "x == 1: an equation is ac.Eq.left, right., and in a condition a real number",
        ),
        (lambda m: 2 * m.n == 2, r"the condition of where\(...\) is False already"),
        (lambda m: m.x == m.n, "x == n: an equation is ac.Eq.left, right."),
        (lambda m: m.n == m.seen + 1, "Whole numbers are variables of kind='int' or 'bool'"),
        (lambda m: not m.n, "Python asks whether n is true, but its value is not known yet"),
        (lambda m: m.n and m.x, "use &, | and ~ in place of and, or and not"),
        (lambda m: m.n in (1, 2), "cannot determine truth value"),
        (lambda m: m.n > 1 and m.x > 0, "cannot determine truth value"),
    ],
)
def test_what_python_cannot_decide_is_refused(holds: Callable[[Any], Any], sentence: str) -> None:
    with pytest.raises(ac.ModelError, match=sentence.replace("|", r"\|")):
        ac.compile(Counted(holds))
