"""Starts of discrete variables: their values before the first event, fixed or not."""

import pytest

import acausal as ac


class Latch(ac.Component):
    """Counts how often a rising signal passes 1, from a given start on."""

    x = ac.Variable(start=0.5, fixed=True)
    n = ac.Discrete(0, kind="int")
    high = ac.Discrete(kind="bool")

    def equations(self):
        yield ac.Eq(self.high, self.x > 0.2)
        yield ac.Eq(ac.der(self.x), 1)
        yield ac.When(self.x > 1, ac.Eq(self.n, ac.pre(self.n) + 1))


@pytest.mark.cases(fast=1)
@pytest.mark.parametrize("fixed", [True, False])
def test_a_fixed_start_is_the_value_before_the_first_event(fixed):
    system = ac.compile(Latch(n=ac.Start(3, fixed=fixed), high=ac.Start(0, fixed=fixed)))
    found = ac.simulate(system, (0, 1), saveat=[0.0, 1.0])
    assert found["n"].tolist() == [3, 4]
    assert found["high"].tolist() == [1, 1]
    assert found["x"].tolist() == pytest.approx([0.5, 1.5])
