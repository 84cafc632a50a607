"""A gallery of wrong models: each ends in one clear sentence with the place and the mend."""

import json
import math
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

import acausal as ac
from acausal.components import (
    blocks,
    electrical as el,
    fluid,
    magnetic,
    neural,
    rotational,
    thermal,
    translational as tl,
)
from tests.support.parts import Equations, Model, endpoint, model

Wrong = tuple[Callable[[], Any], type[Exception], tuple[str, ...]]

LIBRARIES = ("sympy", "networkx", "numpy", "jax", "jaxlib", "equinox", "diffrax", "scipy", "json")
"""Whose tracebacks must not be seen."""


def compiled(*connections: str, **parts: Any) -> ac.System:
    return ac.compile(model(*connections, **parts))


def joined(*ends: str, **parts: Any) -> None:
    """Connect the ends of parts, all at once."""
    whole = model(**parts)
    whole.connect(*(endpoint(whole, end) for end in ends))


def own(stated: Any, variables: str = "x", **attributes: Any) -> ac.System:
    return ac.compile(Equations(variables, stated, **attributes))


class Clipped(ac.Component):
    """One law twice, with a condition that is an event, and none for a force."""

    x, y, f = ac.Variable(start=1.0), ac.Variable(), ac.Variable()

    def __init__(self) -> None:
        super().__init__()
        self.part = Equations("x", lambda s: [ac.Eq(ac.der(s.x), -1)])

    def equations(self) -> Iterator[ac.Eq]:
        law = ac.where(self.part.x > 0.2, 1, self.x**2, events=True)
        yield from (ac.Eq(ac.der(self.x), -1), ac.Eq(self.y, law), ac.Eq(law - self.y, 0))


class Started(ac.Component):
    """One decaying variable with a fixed start and initial equations."""

    x = ac.Variable(start=5.0, fixed=True)

    def __init__(self, *stated: Callable[[Any], ac.Eq]) -> None:
        super().__init__()
        self.stated = stated

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.x), 1 - self.x)

    def initial_equations(self) -> Iterator[ac.Eq]:
        return (equation(self) for equation in self.stated)


class Lag(ac.Component):
    x = ac.Variable()
    T = ac.Parameter(1.0)
    u = ac.Input()
    net = ac.Module(lambda key: lambda x: x)

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.x), (self.u - self.net(self.x)) / self.T)


def names_twice() -> None:
    whole = Model()
    whole.mass = tl.Mass(m=1)
    whole.mass = tl.Mass(m=2)


def name_of_a_method() -> None:
    Model().connect = tl.Mass(m=1)  # type: ignore[method-assign]


def name_of_a_declaration() -> None:
    Lag().x = tl.Mass(m=1)  # type: ignore[assignment]


def part_of_two() -> None:
    mass = tl.Mass(m=1)
    model(a=mass)
    model(b=mass)


def part_of_a_class() -> None:
    class Shared(ac.Component):  # pyright: ignore[reportUnusedClass]
        mass = tl.Mass(m=1)


def part_of_itself() -> None:
    whole = Model()
    whole.inner = whole


def parameter_of_itself() -> None:
    whole = model(mass=tl.Mass(m=1))
    whole.mass.modify(m=2 * whole.mass.m)  # type: ignore[attr-defined]
    ac.compile(whole)


def parameters_in_a_circle() -> None:
    whole: Any = model(a=tl.Mass(m=1), b=tl.Mass(m=1))
    whole.a.modify(m=whole.b.m)
    whole.b.modify(m=2 * whole.a.m)
    ac.compile(whole)


def parameter_that_moves() -> None:
    whole: Any = model(mass=tl.Mass(m=1))
    whole.spring = tl.Spring(c=whole.mass.s)


def connected_to_a_stranger() -> None:
    whole: Any = model(mass=tl.Mass(m=1))
    whole.connect(whole.mass.flange_a, tl.Spring(c=1).flange_b)
    ac.compile(whole)


def stated_about_a_stranger() -> None:
    other = tl.Mass(m=1)
    own(lambda s: [ac.Eq(s.x, other.s)])


def starts_that_contradict() -> None:
    compiled(
        "a.flange_b - b.flange_a",
        a=tl.Mass(m=1, s=ac.Start(0.0, fixed=True)),
        b=tl.Mass(m=1, s=ac.Start(1.0, fixed=True)),
    ).initial_state()


def simulated(part: ac.Component, **given: Any) -> None:
    ac.simulate(compiled(part=part), (0.0, 1.0), dt=0.5, **given)


class Bump(tl.PartialCompliant):
    """A cubic spring, the unit of whose constant is the author's concern."""

    def __init__(self, unit: str) -> None:
        super().__init__()
        self.k = ac.Parameter(1.0, unit=unit)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, self.k * self.s_rel**3)


def mass_of_a_length() -> None:
    whole: Any = model(wall=tl.Fixed(s0=1), mass=tl.Mass(m=1))
    whole.mass.modify(m=whole.wall.s0)
    ac.compile(whole)


def start_at_a_mass() -> None:
    whole: Any = model(mass=tl.Mass(m=1))
    whole.mass.modify(s=ac.Start(whole.mass.m, fixed=True))
    ac.compile(whole)


class Vacuous(ac.Component):
    """States nothing about a part."""

    def __init__(self) -> None:
        super().__init__()
        self.mass = tl.Mass(m=1.0)

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.mass.s, self.mass.s)


def declared(declaration: Any) -> None:
    """Compile a model with one declaration more."""
    ac.compile(type("Part", (Lag,), {"q": declaration})())


GALLERY: dict[str, Wrong] = {
    # -- structure -------------------------------------------------------------------------------------
    "an unconnected flange": (
        lambda: compiled("a.flange_b - rod.flange_a", a=tl.Spring(c=1), rod=tl.Rod(L=1)),
        ac.StructureError,
        (
            "undetermined: 'rod.flange_b.s'",
            "rod.flange_b (unconnected: no flow)",
            "a connector left unconnected?",
        ),
    ),
    "unconnected flanges of a gear": (
        lambda: compiled(
            "p.sun - j.flange_a", p=rotational.IdealPlanetary(ratio=2), j=rotational.Inertia(J=1)
        ),
        ac.StructureError,
        ("undetermined: 'p.ring.phi'", "a connector left unconnected?"),
    ),
    "a missing ground": (
        lambda: compiled("v.p - r.p", "r.n - v.n", v=el.ConstantVoltage(V=1), r=el.Resistor(R=1)),
        ac.StructureError,
        ("undetermined: 'v.n.v'", "Is a Fixed (a ground, a reference) missing"),
    ),
    "a missing magnetic ground": (
        lambda: compiled(
            "v.port_p - r.port_p",
            "r.port_n - v.port_n",
            v=magnetic.ConstantMagneticPotentialDifference(V_m=1),
            r=magnetic.ConstantReluctance(R_m=1),
        ),
        ac.StructureError,
        ("undetermined: 'v.port_n.V_m'", "Is a Fixed (a ground, a reference) missing"),
    ),
    "a coolant circuit without a pressure": (
        lambda: compiled(
            "pump.flowPort_b - pipe.flowPort_a",
            "pipe.flowPort_b - pump.flowPort_a",
            pump=fluid.VolumeFlow(constantVolumeFlow=1),
            pipe=fluid.Pipe(m=1, V_flowLaminar=1, dpLaminar=1, V_flowNominal=2, dpNominal=3, h_g=0),
        ),
        ac.StructureError,
        ("undetermined: 'pump.flowPort_a.p'", "Is a Fixed (a ground, a reference) missing"),
    ),
    "two voltage sources in parallel": (
        lambda: compiled(
            "v.p - w.p",
            "v.n - w.n",
            "v.n - g.p",
            v=el.ConstantVoltage(V=1),
            w=el.ConstantVoltage(V=2),
            g=el.Ground(),
        ),
        ac.StructureError,
        (
            "overdetermined; redundant equations: 'w (ConstantVoltage: v = V)'",
            "'v (ConstantVoltage: v = V)'",
            "in parallel",
        ),
    ),
    "a law with an event stated twice": (
        lambda: compiled(clipped=Clipped()),
        ac.StructureError,
        ("undetermined: 'clipped.f'", "where(part.x > 0.2, 1, x**2)"),
    ),
    "two current sources in series": (
        lambda: compiled(
            "v.p - w.n",
            "v.n - g.p",
            "w.p - g.p",
            v=el.ConstantCurrent(I=1),
            w=el.ConstantCurrent(I=2),
            g=el.Ground(),
        ),
        ac.StructureError,
        (
            "overdetermined; redundant equations: 'w (ConstantCurrent: i = I)'",
            "'v (ConstantCurrent: i = I)'",
            "in series",
        ),
    ),
    "a voltage source in short circuit": (
        lambda: compiled("v.p - v.n", "v.n - g.p", v=el.ConstantVoltage(V=1), g=el.Ground()),
        ac.StructureError,
        (
            "undetermined: 'v.i'",
            "overdetermined; redundant equations: 'v (ConstantVoltage: v = V)'",
        ),
    ),
    "position sources at both ends of a rigid rod": (
        lambda: compiled(
            "a.flange - rod.flange_a",
            "rod.flange_b - b.flange",
            a=tl.Position(exact=True),
            b=tl.Position(exact=True),
            rod=tl.Rod(L=1),
        ),
        ac.StructureError,
        ("rod (Rod: flange_b.s = L/2 + s)", "rod (Rod: flange_a.s = -L/2 + s)", "joined rigidly"),
    ),
    "two speeds on one mass": (
        lambda: compiled(
            "a.flange - m.flange_a",
            "m.flange_b - b.flange",
            a=tl.Speed(exact=True),
            b=tl.Speed(exact=True),
            m=tl.Mass(m=1),
        ),
        ac.StructureError,
        ("overdetermined", "'b.v_ref'", "'a.v_ref'", "connect the input to a source, or remove"),
    ),
    "two fixed points joined rigidly": (
        lambda: compiled(
            "a.flange - rod.flange_a",
            "rod.flange_b - b.flange",
            a=tl.Fixed(),
            b=tl.Fixed(s0=1),
            rod=tl.Rod(L=2),
        ),
        ac.StructureError,
        ("'b (Fixed: flange.s = s0)'", "joined rigidly"),
    ),
    "two temperatures in one node": (
        lambda: compiled(
            "a.port - b.port", a=thermal.FixedTemperature(T=300), b=thermal.FixedTemperature(T=310)
        ),
        ac.StructureError,
        (
            "'b (FixedTemperature: port.T = T)'",
            "'a (FixedTemperature: port.T = T)'",
            "joined rigidly",
        ),
    ),
    "an equation too few": (
        lambda: own(lambda s: [ac.Eq(ac.der(s.x), s.y)], "x y"),
        ac.StructureError,
        ("1 equations for 2 unknowns", "an equation forgotten?"),
    ),
    "an equation too many": (
        lambda: own(lambda s: [ac.Eq(ac.der(s.x), 1), ac.Eq(s.x, 2)]),
        ac.StructureError,
        ("2 equations for 1 unknowns", "Equations: x = 2", "an equation stated twice?"),
    ),
    "an equation without an unknown": (
        lambda: own(lambda s: [ac.Eq(ac.der(s.x), 1), ac.Eq(1, 2)]),
        ac.StructureError,
        ("overdetermined; redundant equations: 'Equations: 1 = 2'",),
    ),
    "equations that contradict each other": (
        lambda: own(lambda s: [ac.Eq(s.x + s.y, 1), ac.Eq(2 * s.x + 2 * s.y, 3)], "x y"),
        ac.StructureError,
        ("undetermined: 'y'", "2*x + 2*y = 3", "together with: 'Equations: x + y = 1'"),
    ),
    "a mass of zero": (
        lambda: compiled("f.flange - m.flange_a", f=tl.ConstantForce(f_constant=1), m=tl.Mass(m=0)),
        ac.StructureError,
        (
            "'m.a' cannot be computed",
            "a*m = flange_a.f + flange_b.f",
            "'m.m'",
            "give another value",
        ),
    ),
    "a capacity of zero": (
        lambda: compiled(
            "q.port - c.port", q=thermal.FixedHeatFlow(Q_flow=1), c=thermal.HeatCapacitor(C=0)
        ),
        ac.StructureError,
        (
            "cannot be computed",
            "c (HeatCapacitor: C*der(T) = port.Q_flow)",
            "'c.C'",
            "give another value",
        ),
    ),
    # -- connections -----------------------------------------------------------------------------------
    "unlike connectors": (
        lambda: joined("m.flange_a", "c.port", m=tl.Mass(m=1), c=thermal.HeatCapacitor(C=1)),
        ac.ConnectionError,
        (
            "m.flange_a (Flange) and c.port (HeatPort)",
            "only connectors of one domain can be connected",
        ),
    ),
    "unlike connectors of one name": (
        lambda: joined("m.flange_a", "j.flange_a", m=tl.Mass(m=1), j=rotational.Inertia(J=1)),
        ac.ConnectionError,
        (
            "m.flange_a (Flange) and j.flange_a (Flange) carry s [m], f [N] and phi [rad], tau [N.m]",
        ),
    ),
    "a signal and a connector": (
        lambda: joined("m.flange_a", "one.y", m=tl.Mass(m=1), one=blocks.Constant(k=1)),
        ac.ConnectionError,
        ("m.flange_a (Flange) and one.y", "one is a signal"),
    ),
    "a connector connected to itself": (
        lambda: joined("m.flange_a", "m.flange_a", m=tl.Mass(m=1)),
        ac.ConnectionError,
        ("m.flange_a (Flange) is connected to itself",),
    ),
    "one end only": (
        lambda: joined("m.flange_a", m=tl.Mass(m=1)),
        ac.ConnectionError,
        ("connect needs at least two connectors, got 1",),
    ),
    "a component instead of its connector": (
        lambda: joined("m", "f.flange", m=tl.Mass(m=1), f=tl.Fixed()),
        ac.ConnectionError,
        ("Mass 'm' is not a connector",),
    ),
    "a parameter instead of a connector": (
        lambda: joined("m.m", "f.flange", m=tl.Mass(m=1), f=tl.Fixed()),
        ac.ConnectionError,
        ("m.m is not a connector",),
    ),
    "two sources of one signal": (
        lambda: compiled(
            "a.y - g.u",
            "b.y - g.u",
            a=blocks.Constant(k=1),
            b=blocks.Constant(k=2),
            g=blocks.Gain(k=1),
        ),
        ac.ConnectionError,
        ("'a.y' and 'b.y' feed one signal", "a signal has one source"),
    ),
    "vectors of unlike length": (
        lambda: joined(
            "p.y",
            "s.u",
            p=blocks.KinematicPTP(deltaq=[1, 2], qd_max=[1], qdd_max=[1]),
            s=blocks.Sum(nin=3),
        ),
        ac.ConnectionError,
        ("vectors differ in length: p.y has 2, s.u has 3",),
    ),
    "a vector and a signal": (
        lambda: joined(
            "p.y",
            "g.u",
            p=blocks.KinematicPTP(deltaq=[1, 2], qd_max=[1], qdd_max=[1]),
            g=blocks.Gain(k=1),
        ),
        ac.ConnectionError,
        ("p.y is a vector of 2, g.u is single", "connect one element"),
    ),
    "a support that an option leaves out": (
        lambda: joined(
            "g.support", "f.flange", g=rotational.IdealGear(ratio=1), f=rotational.Fixed()
        ),
        ac.DeclarationError,
        ("IdealGear 'g'.support exists only with useSupport=True",),
    ),
    "a connector of a part that is not there": (
        connected_to_a_stranger,
        ac.ConnectionError,
        (
            "flange_b (Flange) of Spring, which is not part of the model",
            "assign that component to an attribute",
        ),
    ),
    # -- names and parts -------------------------------------------------------------------------------
    "one name twice": (
        names_twice,
        ac.DeclarationError,
        ("Model has a 'mass' already", "choose another name"),
    ),
    "the name of a method": (
        name_of_a_method,
        ac.DeclarationError,
        ("'connect' is an attribute of class Model", "choose another name"),
    ),
    "the name of a variable": (
        name_of_a_declaration,
        ac.DeclarationError,
        ("Lag.x is a variable", "give its start as ac.Start"),
    ),
    "no name": (
        lambda: setattr(Model(), "left mass", tl.Mass(m=1)),
        ac.DeclarationError,
        ("'left mass' is not a name for a part", "letters, digits and underscores"),
    ),
    "one part of two models": (
        part_of_two,
        ac.DeclarationError,
        ("'b': this Mass is already 'a'", "make a second one"),
    ),
    "a part of itself": (
        part_of_itself,
        ac.DeclarationError,
        ("'inner': a component cannot contain itself",),
    ),
    "a part of a class": (
        part_of_a_class,
        ac.DeclarationError,
        ("Shared.mass: a part is made in __init__ (self.mass = ...)",),
    ),
    "a class instead of a model": (
        lambda: ac.compile(tl.Mass),  # type: ignore[arg-type]
        ac.ModelError,
        ("compile needs a model, not a class", "ac.compile(Mass())"),
    ),
    # -- modifiers -------------------------------------------------------------------------------------
    "an unknown modifier": (
        lambda: tl.SpringDamper(c=1, d=1, s_rel_0=2),
        ac.DeclarationError,
        ("SpringDamper has no 's_rel_0'", "did you mean 's_rel0'?"),
    ),
    "an unknown modifier of a part": (
        lambda: compiled(pid=blocks.LimPID(yMax=1, limitr={"uMax": 1})),
        ac.DeclarationError,
        ("LimPID 'pid' has no 'limitr'", "did you mean 'limiter'?"),
    ),
    "a parameter without a value": (
        lambda: compiled(mass=tl.Mass()),
        ac.DeclarationError,
        ("parameter without a value: 'mass.m'", "give it where the component is made (m=...)"),
    ),
    "a negative mass": (
        lambda: tl.Mass(m=-1),
        ac.DeclarationError,
        ("Mass.m=-1 is out of range: at least 0 kg",),
    ),
    "a text as mass": (
        lambda: tl.Mass(m="heavy"),
        ac.DeclarationError,
        ("Mass.m='heavy'", "a number or an expression of parameters is needed"),
    ),
    "a number that is none": (
        lambda: tl.Mass(m=math.nan),
        ac.DeclarationError,
        ("Mass.m=nan", "a finite number is needed"),
    ),
    "no choice of an option": (
        lambda: blocks.FirstOrder(T=1, initType="Steady"),
        ac.DeclarationError,
        ("FirstOrder.initType='Steady' must be one of 'NoInit', 'SteadyState'",),
    ),
    "a number as truth": (
        lambda: rotational.IdealGear(ratio=1, useSupport=1),
        ac.DeclarationError,
        ("IdealGear.useSupport=1", "True or False is needed"),
    ),
    "a number as start": (
        lambda: tl.Mass(m=1, s=0.5),
        ac.DeclarationError,
        ("Mass.s is a variable", "give its start as ac.Start(0.5)"),
    ),
    "a wrong priority of a state": (
        lambda: tl.Mass(m=1, s=ac.Start(state="sometimes")),  # type: ignore[arg-type]
        ac.DeclarationError,
        ("state='sometimes' must be one of never, avoid, default, prefer, always",),
    ),
    "a vector of wrong length": (
        lambda: compiled(part=blocks.CriticalDamping(f=1, n=3, x_start=[1, 2])),
        ac.DeclarationError,
        ("CriticalDamping 'part'.x_start needs 3 values, got 2",),
    ),
    "a parameter that gives itself": (
        parameter_of_itself,
        ac.DeclarationError,
        ("parameters are bound in a circle: 'mass.m'", "give one a number"),
    ),
    "parameters in a circle": (
        parameters_in_a_circle,
        ac.DeclarationError,
        ("parameters are bound in a circle", "'b.m'", "give one a number"),
    ),
    "a parameter given by a variable": (
        parameter_that_moves,
        ac.DeclarationError,
        ("Spring.c = s", "only parameters may stand in a parameter's value"),
    ),
    "a parameter of another model": (
        lambda: compiled(a=tl.Mass(m=2 * tl.Mass(m=1).m)),
        ac.DeclarationError,
        ("'a.m' refers to 'm' of Mass, which is not part of the model", "or give a number"),
    ),
    "a missing network": (
        lambda: compiled(part=Lag(net=None)),
        ac.DeclarationError,
        ("Lag.net needs a module or a function key -> module, got None",),
    ),
    "a number as network": (
        lambda: neural.Compliance(net=3),  # type: ignore[arg-type]
        ac.DeclarationError,
        ("Compliance.net needs a module or a function key -> module, got 3",),
    ),
    "a block that must remember": (
        lambda: blocks.FixedDelay(delayTime=1),
        ac.DeclarationError,
        ("FixedDelay needs the past of a signal, which acausal does not have yet",),
    ),
    # -- equations -------------------------------------------------------------------------------------
    "an expression instead of an equation": (
        lambda: own(lambda s: [s.x]),
        ac.DeclarationError,
        ("equations() yields x", "yield ac.Eq(left, right)"),
    ),
    "a comparison instead of an equation": (
        lambda: own(lambda s: [s.x == 1]),
        ac.DeclarationError,
        ("x == 1", "an equation is ac.Eq(left, right)"),
    ),
    "math in an equation": (
        lambda: own(lambda s: [ac.Eq(s.x, math.sin(s.x))]),
        ac.DeclarationError,
        ("its equations cannot be read", "of test_wrong_models.py", "use ac.sin, ac.where"),
    ),
    "numpy in an equation": (
        lambda: own(lambda s: [ac.Eq(s.x, np.sin(s.x))]),
        ac.DeclarationError,
        ("its equations cannot be read", "of test_wrong_models.py", "use ac.sin, ac.where"),
    ),
    "an if in an equation": (
        lambda: own(lambda s: [ac.Eq(s.x, 1 if s.x > 0 else 2)]),
        ac.DeclarationError,
        ("its equations cannot be read", "x > 0", "use ac.sin, ac.where"),
    ),
    "an infinite number in an equation": (
        lambda: own(lambda s: [ac.Eq(s.x, math.inf)]),
        ac.DeclarationError,
        ("right side is inf", "a finite number is needed"),
    ),
    "an undeclared symbol": (
        lambda: own(lambda s: [ac.Eq(s.x, sp.Symbol("z"))]),
        ac.DeclarationError,
        ("Equations: x = z", "'z' is not declared"),
    ),
    "an equation about another model": (
        stated_about_a_stranger,
        ac.DeclarationError,
        (
            "Equations: x = s",
            "'s' belongs to Mass, which is not part of Equations",
            "or connect instead",
        ),
    ),
    "a variable given by itself": (
        lambda: ac.compile(Vacuous()),
        ac.StructureError,
        ("redundant equations: 'Vacuous: mass.s = mass.s'",),
    ),
    "a list in an equation": (
        lambda: own(lambda s: [ac.Eq(s.x, [1, 2])]),
        ac.DeclarationError,
        ("Equations, line ", " of test_wrong_models.py: an equation's right side is list [1, 2]"),
    ),
    "a matrix in an equation": (
        lambda: own(lambda s: [ac.Eq(sp.Matrix([s.x, 1]), 0)]),
        ac.DeclarationError,
        ("an equation's left side is MutableDenseMatrix Matrix([ [x], [1]]); an expression or",),
    ),
    "a function of a list": (
        lambda: own(lambda s: [ac.Eq(ac.der(s.x), ac.floor([s.x]))]),
        ac.DeclarationError,
        ("floor(...) is list [x]", "of test_wrong_models.py"),
    ),
    "a function of a dict": (
        lambda: own(lambda s: [ac.Eq(ac.der(s.x), ac.sign({1: 2}))]),
        ac.DeclarationError,
        (
            "Equations, line ",
            "what sign(...) takes is dict {1: 2}; an expression or a number is needed",
        ),
    ),
    "a sine of a text": (
        lambda: own(lambda s: [ac.Eq(ac.der(s.x), ac.sin("x"))]),
        ac.DeclarationError,
        (
            "Equations, line ",
            "an argument of sin(...) is str 'x'; an expression or a number is needed",
        ),
    ),
    "a derivative of nothing": (
        lambda: own(lambda s: [ac.Eq(ac.der(None), 1)]),
        ac.DeclarationError,
        ("Equations, line ", "what der(...) differentiates is NoneType None"),
    ),
    "sympy's derivative": (
        lambda: own(lambda s: [ac.Eq(sp.Derivative(s.x, ac.time), 1)]),
        ac.DeclarationError,
        (
            "Equations, line ",
            "variables do not depend on time; a derivative in time is ac.der(...)",
        ),
    ),
    # -- declarations ----------------------------------------------------------------------------------
    "a condition on nothing": (
        lambda: declared(ac.Parameter(1.0, when="useQ")),
        ac.DeclarationError,
        ("Part: when='useQ' names no option; there are none to choose from.",),
    ),
    "a condition on itself": (
        lambda: declared(ac.Parameter(1.0, when="q")),
        ac.DeclarationError,
        ("Part: when='q' names no option",),
    ),
    "a number as unit": (
        lambda: declared(ac.Parameter(1.0, unit=3)),  # type: ignore[arg-type]
        ac.UnitError,
        ("3 is not a unit; a text is needed",),
    ),
    "a default that is no number": (
        lambda: declared(ac.Parameter(1j)),
        ac.DeclarationError,
        ("Part.q: its default 1j, min=None, max=None: numbers are needed",),
    ),
    "a default out of range": (
        lambda: declared(ac.Parameter(-1.0, min=0.0)),
        ac.DeclarationError,
        ("Part.q: its default -1 is not within 0 and inf",),
    ),
    "a default that cannot be computed": (
        lambda: declared(ac.Parameter(float)),
        ac.DeclarationError,
        ("Part.q: its default cannot be computed (float() argument",),
    ),
    "a start that is none": (
        lambda: declared(ac.Variable(start=math.nan)),
        ac.DeclarationError,
        ("'q' has start=nan; a finite number is needed",),
    ),
    "a nominal value of zero": (
        lambda: declared(ac.Variable(nominal=0.0)),
        ac.DeclarationError,
        ("'q' has nominal=0; a finite number, not zero, is needed",),
    ),
    "a start by an unknown name": (
        lambda: declared(ac.Variable(start="q_start")),
        ac.DeclarationError,
        ("Part.q: start='q_start' names nothing in the component",),
    ),
    "a start by a variable": (
        lambda: declared(ac.Variable(start="q")),
        ac.DeclarationError,
        ("'q' is given by 'q' of Part, which changes with time; only parameters may stand there",),
    ),
    "a start of three": (
        lambda: compiled(part=tl.Mass(m=1.0, s=ac.Start([1.0, 2.0, 3.0]))),
        ac.DeclarationError,
        ("'s' is one variable; its start is a number, not [1.0, 2.0, 3.0]",),
    ),
    "a shape that is no size": (
        lambda: declared(ac.Parameter(1.0, shape=1.5)),  # type: ignore[arg-type]
        ac.DeclarationError,
        ("Part.q: its size is a whole number, not 1.5",),
    ),
    "a shape by itself": (
        lambda: declared(ac.Parameter(1.0, shape="q")),
        ac.DeclarationError,
        ("Part.q: its size is a whole number, not 'q', which is Parameter",),
    ),
    "a number as module": (
        lambda: declared(ac.Module(3)),  # type: ignore[arg-type]
        ac.DeclarationError,
        ("Part.q is 3; a module or a function key -> module is needed",),
    ),
    "networks in a circle": (
        lambda: declared(ac.Module("q")),
        ac.DeclarationError,
        ("networks are given by each other in a circle: 'q'; give one a module",),
    ),
    "bytes": (
        lambda: tl.Mass(m=b"1"),
        ac.DeclarationError,
        ("Mass.m=b'1': a number or an expression of parameters is needed",),
    ),
    "a matrix as number": (
        lambda: tl.Mass(m=jnp.ones((2, 2))),
        ac.DeclarationError,
        ("Mass.m=Array([[1., 1.], [1., 1.]]", "a number or an expression of parameters is needed"),
    ),
    "limits of text": (
        lambda: neural.Compliance(limits="wide", extrapolation="linear"),
        ac.DeclarationError,
        ("Compliance: limits='wide'; give a number for both sides, or a pair of numbers",),
    ),
    "a huge integer": (
        lambda: tl.Mass(m=10**400),
        ac.DeclarationError,
        ("Mass.m=1000", "a number or an expression of parameters is needed"),
    ),
    "a fraction as number of signals": (
        lambda: blocks.Sum(nin=1.5),
        ac.DeclarationError,
        ("Sum.nin=1.5: a whole number is needed",),
    ),
    "a width of text": (
        lambda: compiled(part=neural.Compliance(width="wide")),
        ac.DeclarationError,
        ("Compliance.width='wide': a whole number is needed",),
    ),
    "fewer than no inputs": (
        lambda: neural.Compliance(secondary=-1),
        ac.DeclarationError,
        ("secondary=-1 are the further inputs of a network; give their names, or how many",),
    ),
    # -- units -----------------------------------------------------------------------------------------
    "a parameter in a wrong unit": (
        lambda: compiled(bump=Bump("N/m")),
        ac.UnitError,
        (
            "Bump 'bump': 'f = k*s_rel**3': 'f' is in N (force) but 'k*s_rel**3' in N.m2",
            "should 'k' be in N/m3?",
        ),
    ),
    "a unit without its dot": (
        lambda: compiled(bump=Bump("Nm-3")),
        ac.UnitError,
        ("Bump 'bump'.k: 'Nm-3' is not a unit; did you mean 'N.m-3'?",),
    ),
    "an unknown unit": (
        lambda: compiled(bump=Bump("Nwton")),
        ac.UnitError,
        ("Bump 'bump'.k: 'Nwton' is not a unit",),
    ),
    "a mass that is a length": (
        mass_of_a_length,
        ac.UnitError,
        ("'mass.m = wall.s0': 'mass.m' is in kg (mass) but 'wall.s0' in m (length)",),
    ),
    "a start at a mass": (
        start_at_a_mass,
        ac.UnitError,
        ("'mass.s = mass.m': 'mass.s' is in m (length) but 'mass.m' in kg (mass)",),
    ),
    "a force for a speed": (
        lambda: compiled("sensor.f - drive.v_ref", sensor=tl.ForceSensor(), drive=tl.Speed()),
        ac.UnitError,
        ("'sensor.f' in N (force) and 'drive.v_ref' in m/s (speed) are connected",),
    ),
    # -- initial time and simulation -------------------------------------------------------------------
    "fixed starts that contradict each other": (
        starts_that_contradict,
        ac.InitializationError,
        (
            "'b.s (fixed start) by 1'",
            "'a.s' cannot move",
            "fixed twice, or in conflict with a connection",
        ),
    ),
    "initial equations that contradict each other": (
        lambda: compiled(
            part=Started(lambda s: ac.Eq(s.x, 5), lambda s: ac.Eq(s.x, 2))
        ).initial_state(),
        ac.InitializationError,
        ("the initial conditions cannot all hold", "Started: x = 2"),
    ),
    "a steady state that does not start there": (
        lambda: compiled(part=Started(lambda s: ac.Eq(ac.der(s.x), 0))).initial_state(),
        ac.InitializationError,
        ("the initial conditions cannot all hold", "part (Started: der(x) = 0)"),
    ),
    "an initial value of what is not a state": (
        lambda: compiled(part=blocks.FirstOrder(T=1)).initial_state(x0={"part.u": 1}),
        ac.DataError,
        ("x0: 'part.u' is not a state",),
    ),
    "an initial value of a discrete variable": (
        lambda: compiled(part=blocks.Hysteresis(uLow=0, uHigh=1)).initial_state(x0={"part.y": 0.5}),
        ac.DataError,
        ("x0: 'part.y' is 0.5; give True or False.",),
    ),
    "a missing input": (
        lambda: simulated(blocks.FirstOrder(T=1)),
        ac.DataError,
        ("No value for the model's input 'part.u'", "give inputs={'part.u': ...}"),
    ),
    "an unknown input": (
        lambda: simulated(blocks.FirstOrder(T=1), inputs={"part.v": 1.0}),
        ac.DataError,
        ("The model has no input 'part.v'", "did you mean 'part.u'?"),
    ),
    "an unknown parameter": (
        lambda: simulated(blocks.FirstOrder(T=1), inputs={"part.u": 1.0}, params={"part.TT": 1.0}),
        ac.DataError,
        ("the model has no parameter 'part.TT'", "did you mean 'part.T'?"),
    ),
    "an unknown variable": (
        lambda: compiled(part=blocks.FirstOrder(T=1)).observe("part.yy", 0, [0.0], [0.0], {}),
        ac.ModelError,
        ("the model has no variable 'part.yy'", "did you mean 'part.y'?"),
    ),
    "an element counted from zero": (
        lambda: compiled(part=blocks.CriticalDamping(f=1, n=2)).observe(
            "part.x[0]", 0, [0.0] * 2, [0.0], {}
        ),
        ac.ModelError,
        ("elements are counted from 1, as in Modelica: 'part.x[1]'?",),
    ),
    "a root of a negative number": (
        lambda: simulated(Equations("x", lambda s: [ac.Eq(ac.der(s.x), ac.sqrt(s.x - 1))])),
        ac.SimulationError,
        (
            "broke down after t = 0 s",
            "'der(part.x)' = sqrt(x - 1) is nan: a division by zero, or a function outside",
        ),
    ),
    "data in a wrong unit": (
        lambda: simulated(
            tl.Speed(),
            inputs=ac.Data(np.linspace(0, 1, 3), {"part.v_ref": np.ones(3)}, {"part.v_ref": "kg"}),
        ),
        ac.DataError,
        ("'part.v_ref' is given in 'kg', which cannot become 'm/s'",),
    ),
}


def raised(action: Callable[[], Any]) -> Exception:
    """The exception that an action ends in."""
    with pytest.raises(Exception) as caught:  # noqa: PT011 (which one is told by the gallery)
        action()
    return caught.value


def check(error: Exception, kind: type[Exception], parts: tuple[str, ...]) -> None:
    """One sentence that says so, raised by acausal itself and by nothing else."""
    message = str(error)
    assert type(error) is kind, message
    for part in parts:
        assert part in message
    assert "\n" not in message
    assert len(message) < 600
    assert error.__cause__ is None
    assert error.__suppress_context__ or error.__context__ is None
    last = Path(traceback.extract_tb(error.__traceback__)[-1].filename)
    assert not any(f"/{name}/" in last.as_posix() for name in LIBRARIES)


@pytest.mark.parametrize("name", GALLERY)
def test_wrong_model(name: str) -> None:
    action, kind, parts = GALLERY[name]
    check(raised(action), kind, parts)


# -- wrong files -------------------------------------------------------------------------------------

TL = "Modelica.Mechanics.Translational.Components"


def netlist(**changed: Any) -> dict[str, Any]:
    """A sound model with some sections changed."""
    return {
        "components": {
            "fixed": {"class": f"{TL}.Fixed"},
            "spring": {"class": f"{TL}.Spring", "with": {"c": 100.0}},
            "mass": {"class": f"{TL}.Mass", "with": {"m": 1.0}},
        },
        "connections": [["fixed.flange", "spring.flange_a"], ["spring.flange_b", "mass.flange_a"]],
        **changed,
    }


def with_mass(**given: Any) -> dict[str, Any]:
    return {"components": {"mass": {"class": f"{TL}.Mass", "with": {"m": 1.0, **given}}}}


FILES: dict[str, tuple[Any, tuple[str, ...]]] = {
    "a misspelt class": (
        {"components": {"mass": {"class": f"{TL}.Mas"}}},
        ("components.mass.class: there is no class", f"did you mean '{TL}.Mass'?"),
    ),
    "a class in the wrong package": (
        {"components": {"mass": {"class": "Modelica.Mechanics.Translational.Mass"}}},
        ("components.mass.class: there is no class", f"did you mean '{TL}.Mass'?"),
    ),
    "a class that is not covered": (
        {"components": {"line": {"class": "Modelica.Electrical.Analog.Lines.TLine2"}}},
        ("components.line.class", "the library does not cover it yet"),
    ),
    "a class that needs the past": (
        {
            "components": {
                "c": {"class": "Modelica.Blocks.Nonlinear.FixedDelay", "with": {"delayTime": 1}}
            }
        },
        ("components.c: FixedDelay needs the past of a signal",),
    ),
    "a misspelt modifier": (
        with_mass(lenth=1.0),
        ("components.mass.with.lenth: Mass 'mass' has no 'lenth'",),
    ),
    "a misspelt attribute": (
        with_mass(s={"strat": 1.0}),
        ("components.mass.with.s: unknown attribute 'strat'; did you mean 'start'?",),
    ),
    "a misspelt section": (
        netlist(conections=[]),
        ("unknown key 'conections'; did you mean 'connections'?",),
    ),
    "a misspelt end": (
        netlist(connections=[["fixed.flange", "spring.flnge_a"]]),
        ("connections[0]: there is no 'spring.flnge_a'; did you mean 'spring.flange_a'?",),
    ),
    "an end of nothing": (
        netlist(connections=[["fixed.flange", "sprng.flange_a"]]),
        ("connections[0]: there is no 'sprng.flange_a'; did you mean 'spring'?",),
    ),
    "unlike connectors": (
        netlist(
            components={
                "mass": {"class": f"{TL}.Mass", "with": {"m": 1.0}},
                "c": {
                    "class": "Modelica.Thermal.HeatTransfer.Components.HeatCapacitor",
                    "with": {"C": 1.0},
                },
            },
            connections=[["mass.flange_a", "c.port"]],
        ),
        ("connections[0]: unlike connectors: mass.flange_a (Flange) and c.port (HeatPort)",),
    ),
    "a connection to itself": (
        netlist(connections=[["mass.flange_a", "mass.flange_a"]]),
        ("connections[0]: mass.flange_a (Flange) is connected to itself",),
    ),
    "a number out of range": (
        with_mass(m=-1.0),
        ("components.mass.with.m: Mass 'mass'.m=-1 is out of range: at least 0 kg",),
    ),
    "an unknown name": (
        with_mass(m="2*size"),
        ("components.mass.with.m: '2*size': 'size' is not known here",),
    ),
    "a division by zero": (
        with_mass(m="1/(2 - 2)"),
        ("components.mass.with.m: '1/(2 - 2)': divides by zero",),
    ),
    "a call": (
        with_mass(m="system('rm')"),
        ("components.mass.with.m", "''' is not allowed"),
    ),
    "an attribute": (
        with_mass(m="mass.__class__"),
        ("components.mass.with.m", "'mass.__class__' is not known here"),
    ),
    "parameters in a circle": (
        {"parameters": {"a": "2*b", "b": "a + 1"}},
        ("a -> b -> a: each is given by the next; give one of them a number",),
    ),
    "a parameter given by a variable": (
        netlist(
            components={
                **netlist()["components"],
                "rod": {"class": f"{TL}.Rod", "with": {"L": "mass.s"}},
            }
        ),
        ("components.rod.with.L", "only parameters may stand in a parameter's value"),
    ),
    "no choice of an option": (
        with_mass(stateSelect="StateSelect.often"),
        ("components.mass", "stateSelect='often' must be one of 'never', 'avoid'"),
    ),
    "an initial equation without an equals sign": (
        netlist(initial_equations=["mass.s - 1"]),
        ("initial_equations[0]: 'mass.s - 1': '=' expected, the end found",),
    ),
    "a truth value as temperature": (
        {
            "components": {
                "room": {
                    "class": "Modelica.Thermal.HeatTransfer.Components.HeatCapacitor",
                    "with": {"C": 1.0, "T": {"start": True}},
                }
            }
        },
        ("components.room.with.T.start: a number in K is needed, not a truth value",),
    ),
    "an initial equation of nothing": (
        netlist(initial_equations=["mas.s = 1"]),
        ("initial_equations[0]: 'mas.s = 1': 'mas.s' is not known here",),
    ),
    "a component and a parameter of one name": (
        netlist(parameters={"mass": 1.0}),
        ("'mass' is a parameter and a component",),
    ),
    "a missing comma": (
        '{"model": "x"\n "components": {}}',
        ("line 2, column 2: not JSON (Expecting ',' delimiter)",),
    ),
    "a number that is none": (
        '{"parameters": {"a": [1, NaN]}}',
        ("wrong.json: parameters.a[1]: NaN is not a finite number",),
    ),
    "a number that is too large": (
        '{"parameters": {"b": 1, "a": {"=": 1e999}}}',
        ("wrong.json: parameters.a.=: 1e999 is not a finite number",),
    ),
}


@pytest.mark.parametrize("name", FILES)
def test_wrong_file(name: str, tmp_path: Path) -> None:
    content, parts = FILES[name]
    path = tmp_path / "wrong.json"
    path.write_text(content if isinstance(content, str) else json.dumps(content), encoding="utf-8")
    error = raised(lambda: ac.load(path))
    check(error, ac.NetlistError, parts)
    assert str(error).startswith("wrong.json")


def test_the_gallery_is_large() -> None:
    assert len(GALLERY) + len(FILES) >= 90
