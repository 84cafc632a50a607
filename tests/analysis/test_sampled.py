"""Sampled parts are held in what is derived at one instant: that is said."""

import warnings
from collections.abc import Iterator
from typing import Any

import pytest

import acausal as ac
from acausal.components import blocks


class Sampled(ac.Component):
    """A lag under a sampled integrator; the clock of the reference has no part in the loop."""

    loop = ac.Option(True)
    x = ac.Variable(start=0.0)
    u = ac.Discrete(0.0)
    r = ac.Discrete(1.0)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), self.u - self.x)
        yield ac.When(ac.sample(0.05, 0.5), ac.Eq(self.r, 2 - ac.pre(self.r)))
        error = self.r - (self.x if self.loop else 0)
        yield ac.When(ac.sample(0.1, 0.1), ac.Eq(self.u, ac.pre(self.u) + 0.2 * error))


@pytest.mark.slow
def test_what_a_sampled_law_takes_is_named() -> None:
    system = ac.compile(Sampled())
    for derived in (
        lambda: ac.operating_point(system),
        lambda: ac.linearize(system, outputs="x"),
        lambda: ac.simulate(system, 0.01, x0="steady"),
    ):
        with pytest.warns(UserWarning, match="'u' changes at the instants of clocks, and is held"):
            derived()


@pytest.mark.filterwarnings("ignore:operating_point")
def test_a_rest_is_one_before_the_clock_ticks() -> None:
    system = ac.compile(Sampled())
    for t in (0.0, 0.1):  # it ticks at 0.1 s
        point = ac.operating_point(system, x0={"u": 0.5}, t=t)
        assert (point["x"], point["u"]) == (pytest.approx(0.5), 0.5)


def test_clocks_that_follow_nothing_are_silent() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ac.linearize(ac.compile(Sampled(loop=False)), outputs="x")


def test_a_sampler_of_the_library_opens_its_loop() -> None:
    class Loop(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.one, self.error = blocks.Constant(k=1.0), blocks.Feedback()
            self.sampler = blocks.discrete.Sampler(samplePeriod=0.1)
            self.lag = blocks.FirstOrder(k=1.0, T=1.0)
            self.connect(self.one.y, self.error.u1)
            self.connect(self.error.y, self.sampler.u)
            self.connect(self.sampler.y, self.lag.u)
            self.connect(self.lag.y, self.error.u2)

    with pytest.warns(UserWarning, match=r"'sampler\.y' changes at the instants of clocks"):
        ac.open_loop(ac.compile(Loop()), "lag.u")
