"""Another part in the place of one."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, electrical as el, neural, translational as tl


class Suspension(ac.Component):
    def __init__(self, damper: ac.Component) -> None:
        super().__init__()
        self.spring, self.damper = tl.Spring(c=50.0), damper
        self.connect(self.spring.flange_a, self.damper.flange_a)


class Car(ac.Component):
    """The damper's upper end is connected two levels above it, and the wheel is one of a list."""

    def __init__(self, damper: ac.Component, wheel: ac.Component) -> None:
        super().__init__()
        self.ground, self.suspension, self.body = tl.Fixed(), Suspension(damper), tl.Mass(m=2.0)
        self.wheel = [tl.Mass(m=1.0), wheel]
        suspension = self.suspension
        self.connect(self.ground.flange, suspension.spring.flange_a)
        self.connect(suspension.spring.flange_b, suspension.damper.flange_b, self.body.flange_a)
        self.connect(self.body.flange_b, self.wheel[0].flange_a)
        self.connect(self.wheel[0].flange_b, self.wheel[1].flange_a)


def car() -> Car:
    return Car(tl.Damper(d=1.0), tl.Mass(m=1.0))


def test_a_model_with_another_part_is_that_made_with_it() -> None:
    model = car()
    found = model.replace("suspension.damper", tl.Damper(d=3.0)).replace("wheel[2]", tl.Mass(m=5.0))
    wanted = Car(tl.Damper(d=3.0), tl.Mass(m=5.0))
    one, other = ac.compile(found), ac.compile(wanted)
    assert str(one.equations) == str(other.equations)
    assert one.parameters() == other.parameters()
    x0 = {"body.s": 0.1, "body.v": 0.2}
    runs = [ac.simulate(s, (0, 1), dt=0.1, x0=x0).x for s in (one, other)]
    np.testing.assert_array_equal(runs[0], runs[1])
    assert ac.compile(model).parameters()["suspension.damper.d"] == 1.0
    assert found.wheel[1].m is not model.wheel[1].m


class Loop(ac.Component):
    def __init__(self) -> None:
        super().__init__()
        self.gain, self.lag = blocks.Gain(k=2.0), blocks.FirstOrder(T=1.0)
        self.connect(self.gain.y, self.lag.u)
        self.connect(self.lag.y, self.gain.u)


def test_signals_are_connected_again() -> None:
    system = ac.compile(Loop().replace("gain", neural.Characteristic()))
    assert "gain.net" in system.parameters()
    with pytest.raises(ac.ConnectionError, match=r"gain\.y is connected, and .* no 'y'"):
        Loop().replace("gain", tl.Mass(m=1.0))


def test_a_part_gives_way_to_a_network() -> None:
    system = ac.compile(car().replace("suspension.damper", neural.Resistance()))
    assert "suspension.damper.net" in system.parameters()
    assert "suspension.damper.d" not in system.parameters()


class Twice(ac.Component):
    def __init__(self) -> None:
        super().__init__()
        self.one, self.other = tl.Spring(c=2.0), tl.Spring(c=1.0)
        self.other.modify(c=2 * self.one.c)


TAKEN = tl.Damper()
Twice().taken = TAKEN


@pytest.mark.parametrize(
    ("model", "path", "part", "error", "words"),
    [
        (car, "suspension.dampr", tl.Damper, ac.DeclarationError, "no part 'dampr'.*'damper'"),
        (car, "wheels[2]", tl.Mass, ac.DeclarationError, r"no part 'wheels\[2\]'"),
        (
            car,
            "suspension.damper",
            el.Resistor,
            ac.ConnectionError,
            "damper.flange_a.*no 'flange_a'",
        ),
        (car, "suspension.damper", lambda: TAKEN, ac.DeclarationError, "in a model already"),
        (car, "suspension", tl.Damper, ac.ConnectionError, "no 'spring'"),
        (Twice, "one", tl.Spring, ac.DeclarationError, r"'other'.c depends on 'one.c'"),
    ],
)
def test_what_does_not_fit_is_refused(
    model: Callable[[], ac.Component],
    path: str,
    part: Callable[[], ac.Component],
    error: type[Exception],
    words: str,
) -> None:
    with pytest.raises(error, match=words):
        model().replace(path, part())
