"""Small electrical and mechanical parts for the kernel's tests, independent of the library."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import acausal as ac


class Model(ac.Component):
    """An empty model, to which a test adds parts."""


def model(*connections: str, **parts: Any) -> ac.Component:
    """A model of named parts; a connection is ``"a.flange_b - b.flange_a"``."""
    made = Model()
    for name, part in parts.items():
        setattr(made, name, part)
    for line in connections:
        made.connect(*(endpoint(made, end.strip()) for end in line.split("-")))
    return made


def endpoint(component: ac.Component, path: str) -> Any:
    """The connector or signal of that dotted path; ``r[1]`` is the first of a list."""
    found: Any = component
    for name in path.split("."):
        attribute, _, index = name.partition("[")
        found = getattr(found, attribute)
        found = found[int(index[:-1]) - 1] if index else found
    return found


class Equations(ac.Component):
    """A component made of scalar variables and a function that yields its equations.

    ``Equations("x y", lambda s: [ac.Eq(ac.der(s.x), s.y), ...], k=2.0)``
    """

    def __init__(self, variables: str, stated: Any, inputs: str = "", **parameters: float) -> None:
        super().__init__()
        for name in inputs.split():
            setattr(self, name, ac.Input())
        for name in variables.split():
            setattr(self, name, ac.Variable())
        for name, value in parameters.items():
            setattr(self, name, ac.Parameter(value))
        self._stated = stated

    def equations(self) -> Iterator[ac.Eq]:
        yield from self._stated(self)


class Pendulum(Equations):
    """A unit pendulum in Cartesian coordinates; index 3."""

    def __init__(self, **starts: Any) -> None:
        super().__init__("x y v w f", _pendulum)
        self.modify(**starts)


def _pendulum(s: Any) -> Iterator[ac.Eq]:
    yield ac.Eq(ac.der(s.x), s.v)
    yield ac.Eq(ac.der(s.y), s.w)
    yield ac.Eq(ac.der(s.v), -s.f * s.x)
    yield ac.Eq(ac.der(s.w), -s.f * s.y - 9.81)
    yield ac.Eq(s.x**2 + s.y**2, 1)


# -- electrical ---------------------------------------------------------------------------------------


class Pin(ac.Connector):
    v = ac.Potential(unit="V")
    i = ac.Flow(unit="A")


class OnePort(ac.Component):
    """Current ``i`` from p to n, voltage ``v = p.v - n.v``."""

    p = Pin()
    n = Pin()
    v = ac.Variable(unit="V")
    i = ac.Variable(unit="A")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.v, self.p.v - self.n.v)
        yield ac.Eq(0, self.p.i + self.n.i)
        yield ac.Eq(self.i, self.p.i)


class Ground(ac.Component):
    p = Pin()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.p.v, 0)


class Resistor(OnePort):
    R = ac.Parameter(unit="Ohm", min=0)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, self.R * self.i)


class Capacitor(OnePort):
    C = ac.Parameter(unit="F", min=0)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.i, self.C * ac.der(self.v))


class Inductor(OnePort):
    L = ac.Parameter(unit="H", min=0)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, self.L * ac.der(self.i))


class Diode(OnePort):
    """``i = I_s (exp(v / V_t) - 1)``, with a mild default so that Newton's method has it easy."""

    I_s = ac.Parameter(0.1, unit="A")
    V_t = ac.Parameter(0.5, unit="V")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.i, self.I_s * (ac.exp(self.v / self.V_t) - 1))


class ConstantVoltage(OnePort):
    V = ac.Parameter(unit="V")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, self.V)


class SignalVoltage(OnePort):
    """The voltage is a signal."""

    v = ac.Input(unit="V")


class NonlinearResistor(OnePort):
    """``v`` follows from the current by a callable parameter."""

    law = ac.Module()

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, self.law(self.i))


# -- mechanical ---------------------------------------------------------------------------------------


class Flange(ac.Connector):
    s = ac.Potential(unit="m")
    f = ac.Flow(unit="N")


class TwoFlanges(ac.Component):
    flange_a = Flange()
    flange_b = Flange()


class Mass(TwoFlanges):
    m = ac.Parameter(unit="kg", min=0)
    L = ac.Parameter(0.0, unit="m")
    s = ac.Variable(unit="m", state="prefer")
    v = ac.Variable(unit="m/s", state="prefer")
    a = ac.Variable(unit="m/s2")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.flange_a.s, self.s - self.L / 2)
        yield ac.Eq(self.flange_b.s, self.s + self.L / 2)
        yield ac.Eq(self.v, ac.der(self.s))
        yield ac.Eq(self.a, ac.der(self.v))
        yield ac.Eq(self.m * self.a, self.flange_a.f + self.flange_b.f)


class SpringDamper(TwoFlanges):
    c = ac.Parameter(unit="N/m", min=0)
    d = ac.Parameter(unit="N.s/m", min=0)
    s_rel = ac.Variable(unit="m")
    v_rel = ac.Variable(unit="m/s")
    f = ac.Variable(unit="N")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.s_rel, self.flange_b.s - self.flange_a.s)
        yield ac.Eq(self.v_rel, ac.der(self.s_rel))
        yield ac.Eq(self.f, self.c * self.s_rel + self.d * self.v_rel)
        yield ac.Eq(self.flange_b.f, self.f)
        yield ac.Eq(self.flange_a.f, -self.f)


class Fixed(ac.Component):
    flange = Flange()
    s0 = ac.Parameter(0.0, unit="m")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.flange.s, self.s0)


class Position(ac.Component):
    """Moves its flange as the signal says; speed and acceleration follow by differentiation."""

    flange = Flange()
    s_ref = ac.Input(unit="m")
    s = ac.Variable(unit="m")
    v = ac.Variable(unit="m/s")
    a = ac.Variable(unit="m/s2")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.s, self.flange.s)
        yield ac.Eq(self.s, self.s_ref)
        yield ac.Eq(self.v, ac.der(self.s))
        yield ac.Eq(self.a, ac.der(self.v))


class Force(ac.Component):
    flange = Flange()
    f = ac.Input(unit="N")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.flange.f, -self.f)


class Lever(TwoFlanges):
    ratio = ac.Parameter(2.0)

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.flange_a.s, self.ratio * self.flange_b.s)
        yield ac.Eq(0, self.ratio * self.flange_a.f + self.flange_b.f)


class Sine(ac.Component):
    y = ac.Output()
    amplitude = ac.Parameter(1.0)
    omega = ac.Parameter(2.0)

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.amplitude * ac.sin(self.omega * ac.time))
