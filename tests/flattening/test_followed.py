"""Discrete variables that follow signals of other components: where these jump is an event; else it is refused."""

from collections.abc import Callable, Iterator
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac

Jump = Callable[[Any], Any]
END = 3.0


class Charged(ac.Component):
    """A state that nears 1, and a signal that follows from it or from time."""

    tau = ac.Parameter(1.0)
    x = ac.Variable(start=0.0, fixed=True)
    y = ac.Output()

    def __init__(self, jump: Jump) -> None:
        super().__init__()
        self.jump = jump

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.tau * ac.der(self.x), 1 - self.x)
        yield ac.Eq(self.y, self.jump(self.x))


class Follows(ac.Component):
    """A discrete variable equal to twice a signal, by way of another variable; its integral."""

    u = ac.Input()
    v = ac.Variable()
    n = ac.Discrete(0)
    z = ac.Variable(start=0.0, fixed=True)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.v, 2 * self.u)
        yield ac.Eq(self.n, self.v)
        yield ac.Eq(ac.der(self.z), self.n)


class Counts(ac.Component):
    """How often a signal has passed 1/2, and the integral of that."""

    u = ac.Input()
    n = ac.Discrete(0, kind="int")
    z = ac.Variable(start=0.0, fixed=True)

    def equations(self) -> Iterator[Any]:
        yield ac.When(self.u > 0.5, ac.Eq(self.n, ac.pre(self.n) + 1))
        yield ac.Eq(ac.der(self.z), self.n)


class Whole(ac.Component):
    """Each signal, and what follows it."""

    def __init__(self, *pairs: tuple[Jump, type[ac.Component]]) -> None:
        super().__init__()
        self.sources = [Charged(jump) for jump, _ in pairs]
        self.sinks = [kind() for _, kind in pairs]
        for source, sink in zip(self.sources, self.sinks, strict=True):
            self.connect(source.y, sink.u)


@pytest.mark.slow
def test_what_jumps_elsewhere_is_an_event_with_derivatives() -> None:
    system = ac.compile(
        Whole(
            (lambda x: ac.where(x > 0.5, 1, 0), Follows),
            (lambda x: ac.floor(4 * x), Follows),
            (lambda x: ac.where(x > 0.5, 1, 0, events=False), Counts),
            (lambda _: ac.where(ac.time > 0.7, 1, 0), Follows),
        )
    )
    names = [name for name in system.states if name.endswith(".z")]

    def last(tau: Any) -> Any:
        params = {f"sources[{i + 1}].tau": tau for i in range(3)}
        sol = ac.simulate(system, (0.0, END), params=params, rtol=1e-9, atol=1e-12)
        return jnp.stack([sol[name][-1] for name in names])

    z, by_tau = jax.jit(lambda tau: (last(tau), jax.jacfwd(last)(tau)))(1.0)
    quarters = -np.log(1 - np.arange(1, 4) / 4)
    half = quarters[1]
    np.testing.assert_allclose(
        z, [2 * (END - half), 2 * sum(END - quarters), END - half, 2 * (END - 0.7)], rtol=1e-7
    )
    np.testing.assert_allclose(
        by_tau, [-2 * half, -2 * sum(quarters), -half, 0], rtol=1e-6, atol=1e-9
    )


@pytest.mark.parametrize(
    ("jump", "by"),
    [
        (lambda x: x, "sources[1].x"),
        (lambda x: ac.where(x > 0.5, x, 0), "sources[1].x"),
        (lambda _: ac.sin(ac.time), "time"),
    ],
)
def test_what_changes_between_events_is_refused(jump: Jump, by: str) -> None:
    with pytest.raises(ac.StructureError) as caught:
        ac.compile(Whole((jump, Follows)))
    assert (
        f"'sinks[1].n' changes at events alone, but by sinks[1] (Follows: n = v) it would follow '{by}'"
        in str(caught.value)
    )


class Remembers(ac.Component):
    """A discrete variable of which only the value before an event is read; it may have another name."""

    u = ac.Input()
    n, m = ac.Discrete(0), ac.Discrete(0)
    x = ac.Variable(start=0.0, fixed=True)

    def __init__(self, *, named: bool) -> None:
        super().__init__()
        self.named = named
        if named:
            self.y = ac.Output()

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), 1)
        yield ac.Eq(self.n, 2 * self.x)
        yield ac.When(self.x > 1, ac.Eq(self.m, ac.pre(self.n)))
        if self.named:
            yield ac.Eq(self.y, self.n)


def test_what_is_only_remembered_need_not_follow() -> None:
    ac.compile(Remembers(named=False))
    with pytest.raises(ac.StructureError, match="it would follow 'x'"):
        ac.compile(Remembers(named=True))


def test_the_derivative_of_an_input_cannot_be_followed() -> None:
    class Rate(Follows):
        def equations(self) -> Iterator[Any]:
            yield ac.Eq(self.v, ac.der(self.u))
            yield ac.Eq(self.n, self.v)
            yield ac.Eq(ac.der(self.z), self.n)

    with pytest.raises(ac.StructureError, match=r"it would follow '(v|der\(u\))'"):
        ac.compile(Rate())


def test_an_input_that_is_followed_is_held() -> None:
    system = ac.compile(Follows())
    t, u = np.arange(0.0, END + 0.1, 0.5), np.arange(7.0)
    sol = ac.simulate(system, (0.0, END), inputs={"u": (t, u)})
    assert float(sol["z"][-1]) == pytest.approx(2 * 0.5 * sum(u[:-1]), rel=1e-12)
    for wrong in (lambda t: t, ac.Signal(t, u)):
        with pytest.raises(ac.DataError, match="A discrete variable follows input 'u'"):
            ac.simulate(system, (0.0, END), inputs={"u": wrong})
