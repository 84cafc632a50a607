"""Wrong calls on a sound model: arguments of `simulate`, `fit`, the system, data and files, exchanged or senseless."""

from __future__ import annotations

import contextlib
import functools
import math
import random
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
import optax

import acausal as ac
from acausal.components import neural, rotational, thermal, translational as tl
from tests.support.parts import model

from .outcome import Mutant

Make = Callable[[], ac.Component]

DOMAINS: dict[str, tuple[Make, str, str, str, str]] = {
    "translational": (
        lambda: model(
            "wall.flange - spring.flange_a",
            "spring.flange_b - mass.flange_a",
            "mass.flange_b - push.flange",
            wall=tl.Fixed(),
            spring=tl.SpringDamper(c=20.0, d=1.0),
            mass=tl.Mass(m=1.0),
            push=tl.Force(),
        ),
        "push.f",
        "mass.s",
        "spring.c",
        "mass.v",
    ),
    "rotational": (
        lambda: model(
            "wall.flange - brake.flange_a",
            "brake.flange_b - wheel.flange_a",
            "wheel.flange_b - push.flange",
            wall=rotational.Fixed(),
            brake=rotational.SpringDamper(c=3.0, d=0.2),
            wheel=rotational.Inertia(J=0.5),
            push=rotational.Torque(),
        ),
        "push.tau",
        "wheel.phi",
        "brake.c",
        "wheel.w",
    ),
    "thermal": (
        lambda: model(
            "heater.port - plate.port",
            "plate.port - wall.port_a",
            "wall.port_b - room.port",
            "room.port - leak.port_a",
            "leak.port_b - sky.port",
            heater=thermal.PrescribedHeatFlow(),
            plate=thermal.HeatCapacitor(C=10.0, T=ac.Start(300.0)),
            wall=thermal.ThermalConductor(G=2.0),
            room=thermal.HeatCapacitor(C=30.0, T=ac.Start(290.0)),
            leak=thermal.ThermalConductor(G=1.0),
            sky=thermal.FixedTemperature(T=280.0),
        ),
        "heater.Q_flow",
        "plate.T",
        "wall.G",
        "room.T",
    ),
    "neural": (
        lambda: model(
            "wall.flange - damper.flange_a",
            "wall.flange - spring.flange_a",
            "spring.flange_b - mass.flange_a",
            "damper.flange_b - mass.flange_a",
            "mass.flange_b - push.flange",
            wall=tl.Fixed(),
            spring=tl.Spring(c=20.0),
            damper=neural.Resistance(width=3, depth=1),
            mass=tl.Mass(m=1.0),
            push=tl.Force(),
        ),
        "push.f",
        "mass.s",
        "spring.c",
        "mass.v",
    ),
}
"""By domain a model, and its input, first state, a parameter, second state."""

DT, N = 0.1, 21


@dataclass(frozen=True)
class Case:
    """A compiled model, and the names and the record of its signals."""

    system: ac.System
    input: str
    state: str
    parameter: str
    second: str
    data: ac.Data

    @property
    def t(self) -> Any:
        return self.data.time

    @property
    def record(self) -> dict[str, Any]:
        return {"time": self.t, **self.data.signals}


@functools.cache
def case(domain: str) -> Case:
    make, u, x, p, v = DOMAINS[domain]
    system = ac.compile(make())
    t = np.arange(N) * DT
    signals = {u: np.sin(t), x: 300 + np.cos(t), v: 290 - np.sin(t)}
    return Case(system, u, x, p, v, ac.Data(t, signals))


Call = Callable[[Case, Path], Any]
Entry = tuple[Call, bool, tuple[str, ...]]
CALLS: dict[str, dict[str, Entry]] = {}
"""By kind and by what is wrong: the call, whether it is certainly wrong, and of which texts a message holds one."""


class Oddity:
    """An object that nothing knows."""


def raises(error: Exception) -> Any:
    raise error


# -- simulate ----------------------------------------------------------------------------------------

NAN, INF = math.nan, math.inf


def simulated(**changed: Callable[[Case], Any]) -> Call:
    """A short simulation with some arguments changed."""

    def call(c: Case, folder: Path) -> Any:
        given: dict[str, Any] = {
            "t": (0.0, 1.0),
            "dt": DT,
            "solver": "heun",
            "inputs": {c.input: 0.5},
        }
        given |= {name: make(c) for name, make in changed.items()}
        given = {k: v for k, v in given.items() if v is not Oddity}
        t = given.pop("t")
        return np.asarray(ac.simulate(c.system, t, **given).x)

    return call


def options(
    name: str,
    wrong: dict[str, Callable[[Case], Any]],
    odd: dict[str, Callable[[Case], Any]] | None = None,
    says: tuple[str, ...] = (),
    **also: Callable[[Case], Any],
) -> None:
    """Register values of one argument of `simulate`: those that are certainly wrong, and others."""
    places = (name, *says)
    entries = CALLS.setdefault(f"simulate {name}", {})
    for certain, values in ((True, wrong), (False, odd or {})):
        for what, value in values.items():
            entries[what] = (simulated(**also, **{name: value}), certain, places)


def const(value: Any) -> Callable[[Case], Any]:
    return lambda c: value


options(
    "t",
    {
        k: const(v)
        for k, v in {
            "none": None,
            "one": (0,),
            "three": (0, 1, 2),
            "backwards": (1, 0),
            "empty": (1, 1),
            "nan": (0, NAN),
            "inf": (0, INF),
            "texts": ("a", "b"),
            "a text": "01",
            "complex": (0, 1j),
            "an array of two rows": np.zeros((2, 2)),
            "none inside": (0, None),
            "lists": ([0], [1, 2]),
            "an object": object(),
        }.items()
    },
    {
        "an end": const(1.0),
        "an array": const(np.array([0.0, 1.0])),
        "integers": const((0, 1)),
        "float32": const(np.float32([0, 1])),
        "a list": const([0, 1]),
        "huge": const((0.0, 1e300)),
        "tiny": const((0.0, 1e-300)),
    },
    ("span", "dt"),
)
options(
    "dt",
    {
        k: const(v)
        for k, v in {
            "zero": 0,
            "negative": -0.1,
            "nan": NAN,
            "inf": INF,
            "a text": "0.1",
            "complex": 0.1j,
            "an array": np.array([0.1, 0.2]),
            "larger than the span": 3.0,
            "no divisor": 0.3,
            "a list": [0.1],
            "an object": object(),
            "tiny": 1e-12,
            "denormal": 5e-324,
            "a function": len,
        }.items()
    },
    {
        "an integer": const(1),
        "float32": const(np.float32(0.5)),
        "true": const(True),
        "a 0-d array": const(np.asarray(0.1)),
        "a JAX scalar": lambda c: jnp.asarray(0.1),
    },
)
options(
    "saveat",
    {
        k: const(v)
        for k, v in {
            "none at all": [],
            "a text": "all",
            "texts": ["a"],
            "decreasing": [0.5, 0.1],
            "twice": [0.1, 0.1],
            "outside": [0.5, 2.0],
            "nan": [0.1, NAN],
            "two rows": [[0.1], [0.2]],
            "complex": [0.1j],
            "between steps": [0.05],
            "negative": [-0.1],
            "an object": object(),
            "none inside": [None],
            "a dict": {0.1: 1},
        }.items()
    },
    {
        "a number": const(0.5),
        "a tuple": const((0.1, 0.2)),
        "the end": const([1.0]),
        "a range": const(range(2)),
    },
)
options(
    "inputs",
    {
        "none": const(None),
        "empty": const({}),
        "unknown": lambda c: {c.input + "q": 1.0},
        "one more": lambda c: {c.input: 1.0, "q": 1.0},
        "nan": lambda c: {c.input: NAN},
        "a text": lambda c: {c.input: "one"},
        "no value": lambda c: {c.input: None},
        "complex": lambda c: {c.input: 1j},
        "too few samples": lambda c: {c.input: np.ones(3)},
        "two rows": lambda c: {c.input: np.ones((11, 2))},
        "nan in samples": lambda c: {c.input: np.full(11, NAN)},
        "times and samples of unlike length": lambda c: {c.input: ([0, 1], [1, 2, 3])},
        "times decrease": lambda c: {c.input: ([1, 0], [1, 2])},
        "three of a pair": lambda c: {c.input: ([0, 1], [1, 2], [3, 4])},
        "a function of two": lambda c: {c.input: lambda t, x: t},
        "a function of none": lambda c: {c.input: lambda: 1.0},
        "a function of text": lambda c: {c.input: lambda t: "x"},
        "a function of a vector": lambda c: {c.input: lambda t: jnp.ones(2)},
        "a function of none at all": lambda c: {c.input: lambda t: None},
        "nan by a function": lambda c: {c.input: lambda t: jnp.nan * t},
        "a state": lambda c: {c.state: 1.0, c.input: 1.0},
        "a number": const(3.0),
        "an object": lambda c: {c.input: Oddity()},
        "a set": lambda c: {c.input},
        "complex samples": lambda c: {c.input: np.ones(11) * 1j},
        "texts": lambda c: {c.input: ["a"] * 11},
        "a dict": lambda c: {c.input: {"t": 1}},
        "a text of a name": lambda c: c.input,
        "bytes": lambda c: {c.input: b"1"},
        "a short record": lambda c: {c.input: ([0.0, 0.5], [1.0, 2.0])},
        "a number as name": lambda c: {3: 1.0, c.input: 1.0},
        "a function that fails": lambda c: {c.input: lambda t: raises(KeyError("q"))},
        "complex by a function": lambda c: {c.input: lambda t: t * 1j},
    },
    {
        "a record of all": lambda c: c.data,
        "math": lambda c: {c.input: math.sin},
        "an if": lambda c: {c.input: lambda t: 1.0 if t > 0.5 else 0.0},
        "a class": lambda c: {c.input: float},
        "an integer": lambda c: {c.input: 1},
        "true": lambda c: {c.input: True},
        "a signal": lambda c: {c.input: ac.Signal([0, 1], [1, 2])},
        "a list": lambda c: {c.input: [1.0] * 11},
        "all as a list": const([1.0]),
        "all as an array": const(np.ones(1)),
        "integers": lambda c: {c.input: np.ones(11, int)},
        "a huge number": lambda c: {c.input: 1e300},
    },
    ("push", "heater", "Q_flow", "tau", "input", "has no", "q"),
)
options(
    "params",
    {
        "unknown": const({"q": 1.0}),
        "a text": lambda c: {c.parameter: "soft"},
        "nan": lambda c: {c.parameter: NAN},
        "inf": lambda c: {c.parameter: INF},
        "none": lambda c: {c.parameter: None},
        "an array": lambda c: {c.parameter: np.ones(3)},
        "complex": lambda c: {c.parameter: 1j},
        "a list": lambda c: [1.0],
        "a number": const(3.0),
        "a network for a number": lambda c: {c.parameter: jnp.tanh},
        "a state": lambda c: {c.state: 1.0},
        "an object": lambda c: {c.parameter: Oddity()},
        "a function": lambda c: lambda: 1,
        "a text of all": const("soft"),
        "an input": lambda c: {c.input: 1.0},
        "a number as name": const({3: 1.0}),
        "a matrix": lambda c: {c.parameter: jnp.ones((2, 2))},
    },
    {
        "empty": const({}),
        "none at all": const(None),
        "an integer": lambda c: {c.parameter: 2},
        "true": lambda c: {c.parameter: True},
        "packed": lambda c: c.system.pack(),
        "negative": lambda c: {c.parameter: -1.0},  # a conductance has no declared range
        "an array of one": lambda c: {c.parameter: np.ones(1)},
    },
    ("parameter", "spring", "brake", "wall", "3"),
)
options(
    "x0",
    {
        "unknown": const({"q": 1.0}),
        "a text": lambda c: {c.state: "x"},
        "nan": lambda c: {c.state: NAN},
        "inf": lambda c: {c.state: INF},
        "none": lambda c: {c.state: None},
        "too long": const(np.ones(7)),
        "a number": const(3.0),
        "an array inside": lambda c: {c.state: np.ones(3)},
        "complex": lambda c: {c.state: 1j},
        "an input": lambda c: {c.input: 1.0},
        "a parameter": lambda c: {c.parameter: 1.0},
        "a text of all": const("start"),
        "an object": const(object()),
        "nan in all": lambda c: np.full(len(c.system.states), NAN),
        "texts": lambda c: ["a"] * len(c.system.states),
        "a set": lambda c: {c.state},
        "complex in all": lambda c: np.ones(len(c.system.states)) * 1j,
        "two rows": lambda c: np.ones((2, len(c.system.states))),
    },
    {
        "empty": const({}),
        "a list": lambda c: [300.0] * len(c.system.states),
        "a tuple": lambda c: (300.0,) * len(c.system.states),
        "an integer": lambda c: {c.state: 300},
        "huge": lambda c: {c.state: 1e200},
    },
    ("state", "initial value", "mass", "wheel", "plate"),
)
options(
    "solver",
    {
        k: const(v)
        for k, v in {
            "unknown": "tsit6",
            "a number": 3,
            "none": None,
            "a class": diffrax.Heun,
            "an object": object(),
            "a list": ["heun"],
            "not one step": diffrax.LeapfrogMidpoint(),
            "no text": "",
            "a function": len,
            "stochastic": diffrax.EulerHeun(),
            "a dict": {"heun": 1},
            "symplectic": diffrax.SemiImplicitEuler(),
            "upper case": "HEUN",
            "bytes": b"heun",
            "an optimizer": optax.adam(1.0),
            "a controller": diffrax.PIDController(rtol=1e-3, atol=1e-3),
        }.items()
    },
    {
        "midpoint": const("midpoint"),
        "auto": const("auto"),
        "an instance": lambda c: diffrax.Midpoint(),
    },
    ("solver", "scheme", "fixed steps", "differential equations"),
)
NO_DT = {"dt": const(Oddity), "solver": const("tsit5")}
options(
    "rtol",
    {
        k: const(v)
        for k, v in {
            "an array of seven": np.full(7, 1e-6),
            "in rows": np.full((2, 2), 1e-6),
            "negative": -1e-6,
            "nan": NAN,
            "a text": "fine",
            "none": None,
            "complex": 1e-6j,
            "an object": object(),
            "a list": [1e-6] * 9,
        }.items()
    },
    {"zero": const(0.0), "one": const(1.0)},
    ("tolerance", "stopped"),
    **NO_DT,
)
options(
    "atol",
    {
        k: const(v)
        for k, v in {
            "negative": -1e-6,
            "nan": NAN,
            "a text": "fine",
            "complex": 1e-6j,
            "an object": object(),
            "a list": [1e-6] * 9,
            "zero": 0.0,
        }.items()
    },
    {
        "an array of one for each": lambda c: jnp.full(len(c.system.states), 1e-6),
        "none": const(None),
    },
    ("tolerance", "stopped"),
    **NO_DT,
)
options(
    "max_steps",
    {
        k: const(v)
        for k, v in {
            "zero": 0,
            "negative": -5,
            "a text": "many",
            "a fraction": 1.5,
            "one": 1,
            "nan": NAN,
            "an object": object(),
            "a list": [10],
        }.items()
    },
    {"none": const(None)},
    ("steps",),
    **NO_DT,
)
options(
    "adjoint",
    {
        k: const(v)
        for k, v in {
            "a text": "reverse",
            "a number": 3,
            "a class": diffrax.DirectAdjoint,
            "an object": object(),
        }.items()
    },
    {"direct": const(diffrax.DirectAdjoint())},
    **NO_DT,
)
options(
    "dtype",
    {
        k: const(v)
        for k, v in {
            "unknown": "banana",
            "integer": int,
            "complex": complex,
            "float16": np.float16,
            "an object": object(),
            "none at all": "",
            "a number": 3,
            "text": str,
            "truth": bool,
        }.items()
    },
    {"single": const("float32"), "none": const(None), "a type": const(float)},
    ("precision", "float"),
)
CALLS["simulate call"] = {
    "a model": (lambda c, f: ac.simulate(c.system.model, (0, 1)), True, ("simulate",)),
    "a class": (lambda c, f: ac.simulate(tl.Mass, (0, 1)), True, ("simulate",)),
    "none": (lambda c, f: ac.simulate(None, (0, 1)), True, ("simulate",)),
    "exchanged": (lambda c, f: ac.simulate((0, 1), c.system), True, ("simulate",)),
    "no time": (lambda c, f: ac.simulate(c.system), True, ("simulate",)),
    "dt by position": (lambda c, f: ac.simulate(c.system, (0, 1), 0.1), True, ("simulate",)),
    "an unknown keyword": (
        lambda c, f: ac.simulate(c.system, (0, 1), dtt=0.1),
        True,
        ("simulate",),
    ),
    "euler without dt": (
        lambda c, f: ac.simulate(c.system, (0, 1), solver="euler", inputs={c.input: 0.0}),
        True,
        ("dt", "error estimate"),
    ),
}

# -- the system --------------------------------------------------------------------------------------


def at(c: Case) -> tuple[Any, Any, Any, Any]:
    return 0.0, c.system.initial_state(), jnp.zeros(1), c.system.parameters()


def on_system(name: str, entries: dict[str, tuple[Call, bool]], *places: str) -> None:
    CALLS[name] = {what: (call, certain, places) for what, (call, certain) in entries.items()}


on_system(
    "system values",
    {
        "an unknown variable": (lambda c, f: c.system.observe("q", *at(c)), True),
        "a number as name": (lambda c, f: c.system.observe(3, *at(c)), True),
        "none as name": (lambda c, f: c.system.observe(None, *at(c)), True),
        "names within names": (lambda c, f: c.system.observe([[c.state]], *at(c)), True),
        "no text": (lambda c, f: c.system.observe("", *at(c)), True),
        "a derivative of nothing": (lambda c, f: c.system.observe("der(q)", *at(c)), True),
        "an unclosed derivative": (lambda c, f: c.system.observe(f"der({c.state}", *at(c)), True),
        "a tenth derivative": (
            lambda c, f: c.system.observe("der(" * 10 + c.state + ")" * 10, *at(c)),
            True,
        ),
        "a parameter": (lambda c, f: c.system.observe(c.parameter, *at(c)), True),
        "too few states": (lambda c, f: c.system.vector_field(0.0, [1.0], [0.0], {}), True),
        "no inputs": (lambda c, f: c.system.vector_field(0.0, at(c)[1], None, {}), True),
        "texts as states": (
            lambda c, f: c.system.vector_field(0.0, ["a"] * len(c.system.states), [0.0], {}),
            True,
        ),
        "none as states": (lambda c, f: c.system.vector_field(0.0, None, [0.0], {}), True),
        "a dict as states": (
            lambda c, f: c.system.vector_field(0.0, {c.state: 1.0}, [0.0], {}),
            True,
        ),
        "complex states": (lambda c, f: c.system.vector_field(0.0, at(c)[1] * 1j, [0.0], {}), True),
        "a text as time": (lambda c, f: c.system.vector_field("now", at(c)[1], [0.0], {}), True),
        "none as time": (lambda c, f: c.system.vector_field(None, at(c)[1], [0.0], {}), True),
        "none as parameters": (
            lambda c, f: c.system.vector_field(0.0, at(c)[1], [0.0], None),
            False,
        ),
        "a text as inputs": (lambda c, f: c.system.vector_field(0.0, at(c)[1], "u", {}), True),
        "the unit of nothing": (lambda c, f: c.system.unit("q"), True),
        "the unit of a number": (lambda c, f: c.system.unit(3), True),
        "an unknown parameter": (lambda c, f: c.system.pack({"q": 1.0}), True),
        "a text as key": (lambda c, f: c.system.parameters("seed"), True),
        "an object as key": (lambda c, f: c.system.parameters(Oddity()), True),
        "a vector as key": (lambda c, f: c.system.parameters(jnp.ones(2)), True),
        "many keys": (lambda c, f: c.system.parameters(jax.random.split(jax.random.key(0))), True),
        "an old key": (lambda c, f: c.system.parameters(jax.random.PRNGKey(0)), False),
        "a NumPy seed": (lambda c, f: c.system.parameters(np.int64(3)), False),
        "a huge seed": (lambda c, f: c.system.parameters(10**40), True),
        "a number as name of a parameter": (lambda c, f: c.system.pack({3: 1.0}), True),
        "two names and rates": (
            lambda c, f: c.system.vector_field_and_observe(3, *at(c)),
            True,
        ),
        "rates and an unknown name": (
            lambda c, f: c.system.vector_field_and_observe(["q"], *at(c)),
            True,
        ),
        "rates and one name": (
            lambda c, f: c.system.vector_field_and_observe(c.state, *at(c)),
            False,
        ),
        "two times": (
            lambda c, f: c.system.vector_field([0.0, 1.0], at(c)[1], [0.0], {}),
            True,
        ),
        "a parameter as an array": (
            lambda c, f: c.system.pack({c.parameter: np.ones(3)}),
            True,
        ),
        "the unit of none": (lambda c, f: c.system.unit(None), True),
        "the unit of a list": (lambda c, f: c.system.unit([c.state]), True),
        "explain nothing": (
            lambda c, f: c.system.explain_nonfinite(c.system.values(*at(c)), 3),
            True,
        ),
        "inputs in rows": (lambda c, f: c.system.input_values([[1.0]]), True),
        "an input of nan": (
            lambda c, f: c.system.input_values({c.input: NAN}),
            False,  # only put in order; nothing is computed
        ),
        "a fraction as key": (lambda c, f: c.system.parameters(1.5), True),
        "two rows of states": (
            lambda c, f: c.system.vector_field(
                0.0, jnp.zeros((3, len(c.system.states))), [0.0], {}
            ),
            True,
        ),
        "an unknown input": (lambda c, f: c.system.input_values({"q": 1.0}), True),
        "too many inputs": (lambda c, f: c.system.input_values([1.0, 2.0, 3.0]), True),
        "a text as input": (lambda c, f: c.system.input_values({c.input: "a"}), True),
        "texts as inputs": (lambda c, f: c.system.input_values("u"), True),
    },
    "variable",
    "parameter",
    "has no",
    "states",
    "inputs",
    "x",
    "u",
    "t",
    "key",
    "differentiate",
)
on_system(
    "initialize",
    {
        "an unknown state": (lambda c, f: c.system.initial_state(x0={"q": 1.0}), True),
        "steady nothing": (lambda c, f: c.system.initial_state(steady=["q"]), True),
        "steady of a number": (lambda c, f: c.system.initial_state(steady=3), True),
        "steady of a text": (lambda c, f: c.system.initial_state(steady="q"), True),
        "too many inputs": (lambda c, f: c.system.initial_state(inputs=[1.0, 2.0, 3.0]), True),
        "a text as inputs": (lambda c, f: c.system.initial_state(inputs="u"), True),
        "inputs unknown": (lambda c, f: c.system.initialize(inputs={"q": 1.0}, steady=True), True),
        "a text as time": (lambda c, f: c.system.initial_state(t0="now"), True),
        "nan as time": (lambda c, f: c.system.initial_state(t0=NAN), True),
        "nan as start": (lambda c, f: c.system.initialize(x0={c.state: NAN}), True),
        "none as start": (lambda c, f: c.system.initial_state(x0={c.state: None}), True),
        "all as an array": (lambda c, f: c.system.initialize(x0=np.zeros(7)), True),
        "parameters as a text": (lambda c, f: c.system.initial_state("params"), True),
        "inputs of nan": (lambda c, f: c.system.initialize(inputs=[NAN], steady=True), True),
        "parameters of nan": (
            lambda c, f: c.system.initialize({c.parameter: NAN}, steady=True),
            True,
        ),
        "all by position in a list of texts": (
            lambda c, f: c.system.initial_state(x0=["a"] * len(c.system.states)),
            True,
        ),
        "all nan": (
            lambda c, f: c.system.initial_state(x0=np.full(len(c.system.states), NAN)),
            True,
        ),
        "none as time": (lambda c, f: c.system.initial_state(t0=None), True),
        "two times": (lambda c, f: c.system.initial_state(t0=[0.0, 1.0]), True),
        "steady none": (lambda c, f: c.system.initial_state(steady=None), True),
        "steady of an object": (lambda c, f: c.system.initial_state(steady=Oddity()), True),
        "inputs of a vector": (
            lambda c, f: c.system.initial_state(inputs={c.input: [1.0, 2.0]}),
            True,
        ),
        "a number as start": (lambda c, f: c.system.initialize(x0=3), True),
        "a set as start": (lambda c, f: c.system.initial_state(x0={c.state}), True),
        "a number as name of a start": (lambda c, f: c.system.initial_state(x0={3: 1.0}), True),
        "a number as name of an input": (
            lambda c, f: c.system.initial_state(inputs={3: 1.0}),
            True,
        ),
        "inputs by name": (
            lambda c, f: c.system.initialize(inputs={c.input: 1.0}, steady=True),
            False,
        ),
        "an unknown keyword": (lambda c, f: c.system.initial_state(x=3), True),
        "complex inputs": (lambda c, f: c.system.initial_state(inputs=[1j], steady=True), True),
    },
    "x0",
    "inputs",
    "t0",
    "steady",
    "state",
    "input",
    "parameter",
    "params",
    "initial",
)


def result(c: Case) -> ac.Solution:
    return ac.simulate(c.system, (0.0, 1.0), dt=DT, solver="heun", inputs={c.input: 0.5})


on_system(
    "result",
    {
        "an unknown name": (lambda c, f: result(c)["q"], True),
        "a number": (lambda c, f: result(c)[3], True),
        "none": (lambda c, f: result(c)[None], True),
        "a slice": (lambda c, f: result(c)[1:3], True),
        "a list": (lambda c, f: result(c)[[c.state, "q"]], True),
        "an object": (lambda c, f: result(c)[object()], True),
        "a tuple": (lambda c, f: result(c)[c.state, 3], True),
        "an array": (lambda c, f: result(c)[np.zeros(2)], True),
        "to_dict of nothing": (lambda c, f: result(c).to_dict(["q"]), True),
        "to_csv in no folder": (lambda c, f: result(c).to_csv(f / "none" / "x.csv"), True),
        "plot of nothing": (lambda c, f: result(c).plot("q"), True),
        "np.str_": (lambda c, f: result(c)[np.str_(c.state)], False),
        "in": (lambda c, f: c.state in result(c), False),
        "to_dict of a number": (lambda c, f: result(c).to_dict(3), True),
        "to_dataframe of nothing": (lambda c, f: result(c).to_dataframe("q"), True),
        "to_csv of none": (lambda c, f: result(c).to_csv(None), True),
        "to_csv to a folder": (lambda c, f: result(c).to_csv(f), True),
        "to_csv of unknown names": (lambda c, f: result(c).to_csv(f / "r.csv", ["q"]), True),
        "plot on too many axes": (lambda c, f: result(c).plot(c.state, axes=[1, 2]), True),
        "plot on a number": (lambda c, f: result(c).plot(c.state, axes=3), True),
        "to_dict of a text": (lambda c, f: result(c).to_dict("q"), True),
        "to_csv of a number": (lambda c, f: result(c).to_csv(3.5), True),
        "plot of a number": (lambda c, f: result(c).plot(3), True),
        "plot on axes of text": (lambda c, f: result(c).plot(c.state, axes=["a"]), True),
    },
    "variable",
    "has no",
    "name",
    "none",
    "csv",
    "axes",
    "'q'",
)

# -- records -----------------------------------------------------------------------------------------

T = np.arange(5.0)
on_system(
    "data",
    {
        "an array of signals": (lambda c, f: ac.Data(T, np.ones(5)), True),
        "a text as time": (lambda c, f: ac.Data("t", {"a": T}), True),
        "times decrease": (lambda c, f: ac.Data(-T, {"a": T}), True),
        "nan in time": (lambda c, f: ac.Data([0, NAN, 2, 3, 4], {"a": T}), True),
        "nan in a signal": (lambda c, f: ac.Data(T, {"a": T * NAN}), True),
        "unlike lengths": (lambda c, f: ac.Data(T, {"a": T[:3]}), True),
        "two rows": (lambda c, f: ac.Data(T, {"a": np.ones((5, 2))}), True),
        "texts": (lambda c, f: ac.Data(T, {"a": ["x"] * 5}), True),
        "complex": (lambda c, f: ac.Data(T, {"a": T * 1j}), True),
        "unit of none": (lambda c, f: ac.Data(T, {"a": T}, {"b": "m"}), True),
        "an unknown unit": (lambda c, f: ac.Data(T, {"a": T}, {"a": "qq"}), False),
        "units as a text": (lambda c, f: ac.Data(T, {"a": T}, "m"), True),
        "an unknown interpolation": (
            lambda c, f: ac.Data(T, {"a": T}, interpolation="splines"),
            True,
        ),
        "interpolation of a number": (lambda c, f: ac.Data(T, {"a": T}, interpolation=3), True),
        "interpolation of none": (
            lambda c, f: ac.Data(T, {"a": T}, interpolation={"b": "linear"}),
            True,
        ),
        "none as signals": (lambda c, f: ac.Data(T, None), True),
        "a signal of none": (lambda c, f: ac.Data(T, {"a": None}), True),
        "one sample": (lambda c, f: ac.Data([0.0], {"a": [1.0]}), False),
        "no samples": (lambda c, f: ac.Data([], {"a": []}), True),
        "no file": (lambda c, f: ac.Data.from_csv(f / "none.csv"), True),
        "a number as file": (lambda c, f: ac.Data.from_csv(3.5), True),
        "a record of text": (lambda c, f: ac.Data.of("x"), True),
        "a mapping without time": (lambda c, f: ac.Data.of({"a": T}), True),
        "equal times": (lambda c, f: ac.Data(T * 0, {"a": T}), True),
        "a date as time": (lambda c, f: ac.Data(np.arange(5).astype("M8[D]"), {"a": T}), True),
        "an unknown unit of time": (
            lambda c, f: ac.Data(T, {"a": T}, {"time": "qq", "a": "m"}),
            True,
        ),
        "float32 times that coincide": (
            lambda c, f: ac.Data(np.float32(1e8) + np.arange(5, dtype=np.float32), {"a": T}),
            True,
        ),
        "a number as name": (lambda c, f: ac.Data(T, {3: T}), False),
        "between texts": (lambda c, f: c.data.between("a", "b"), True),
        "between nothing": (lambda c, f: c.data.between(None, None), True),
        "between nan": (lambda c, f: c.data.between(NAN, 1.0), True),
        "between exchanged": (lambda c, f: c.data.between(1.0, 0.0), True),
        "select a number": (lambda c, f: c.data.select(3), True),
        "select unknown": (lambda c, f: c.data.select("q"), True),
        "a signal of the record unknown": (lambda c, f: c.data.signal("q"), True),
        "a signal of the record of a number": (lambda c, f: c.data.signal(3), True),
        "a record by a number": (lambda c, f: c.data[3], True),
        "a record in units of no system": (lambda c, f: c.data.for_system(3), True),
        "a file without time": (
            lambda c, f: (f.joinpath("a.csv").write_text("a\n1\n"), ac.Data.from_csv(f / "a.csv")),
            True,
        ),
        "a file of binary": (
            lambda c, f: (
                f.joinpath("b.csv").write_bytes(bytes(range(256))),
                ac.Data.from_csv(f / "b.csv"),
            ),
            True,
        ),
        "a folder as file": (lambda c, f: ac.Data.from_csv(f), True),
        "units of numbers": (lambda c, f: ac.Data(T, {"a": T}, {"a": 3}), True),
        "a unit of time of a number": (
            lambda c, f: ac.Data(T, {"a": T}, {"time": 3, "a": "m"}),
            True,
        ),
        "a choice of a number": (lambda c, f: ac.Data(T, {"a": T}, after_end=3), True),
        "a choice by a list": (lambda c, f: ac.Data(T, {"a": T}, before_start=["hold"]), True),
        "rows of times": (lambda c, f: ac.Data(np.ones((2, 2)), {"a": T}), True),
        "a signal at a text": (lambda c, f: ac.Signal(T, T)("now"), True),
        "a signal at none": (lambda c, f: ac.Signal(T, T)(None), True),
        "interpolation of a list": (lambda c, f: ac.Signal(T, T, ["linear"]), True),
        "extrapolation of a number": (lambda c, f: ac.Signal(T, T, extrapolation=3), True),
        "before its start a number": (lambda c, f: ac.Signal(T, T, before_start=3), True),
        "a signal of unlike lengths": (lambda c, f: ac.Signal(T, T[:3]), True),
        "a signal of one": (lambda c, f: ac.Signal([0.0], [1.0]), True),
        "a signal of text": (lambda c, f: ac.Signal("a", "b"), True),
        "an unknown extrapolation": (lambda c, f: ac.Signal(T, T, extrapolation="q"), True),
        "band-limited and uneven": (lambda c, f: ac.Signal(T**2, T, "band-limited"), True),
        "a signal without values": (lambda c, f: ac.Signal(None, None), True),
        "complex times": (lambda c, f: ac.Signal(T * 1j, T), True),
        "complex values": (lambda c, f: ac.Signal(T, T * 1j), True),
    },
    "time",
    "'a'",
    "signal",
    "unit",
    "interpolation",
    "record",
    "none.csv",
    "file",
    "path",
    "mapping",
    "extrapolation",
    "samples",
    "3.5",
    "uniform",
    "name",
    "before_start",
    "after_end",
    "start=",
    "for_system",
    "t=",
)

# -- fit ---------------------------------------------------------------------------------------------


def fitted(
    data: Callable[[Case], Any] | None = None,
    targets: Callable[[Case], Any] | None = None,
    **changed: Callable[[Case], Any],
) -> Call:
    """A training of one update with some arguments changed."""

    def call(c: Case, folder: Path) -> Any:
        given: dict[str, Any] = {
            "modifiers": [c.parameter],
            "sequence_length": 0.5,
            "epochs": 1,
            "progress": False,
        }
        given |= {name: make(c) for name, make in changed.items()}
        record = data(c) if data else c.data
        with contextlib.chdir(folder):  # where a checkpoint without a folder is written
            fit = ac.fit(c.system, record, targets(c) if targets else [c.state], **given)
        return fit.params[c.parameter]

    return call


FIT: dict[str, dict[str, tuple[Any, bool]]] = {
    "train": {
        "unknown": (["q"], True),
        "a number": (3, True),
        "a text": ("q", True),
        "numbers": ([3], True),
        "none inside": ([None], True),
    },
    "modifiers": {
        "unknown": (["q"], True),
        "a number": (3, True),
        "a text": ("q", True),
        "numbers": ({"q": 3}, True),
        "none inside": ([None], True),
        "an object": (object(), True),
    },
    "gamma": {
        "zero": (0.0, True),
        "negative": (-1.0, True),
        "nan": (NAN, True),
        "a text": ("x", True),
        "none": (None, True),
        "above one": (5.0, False),
        "complex": (1j, True),
    },
    "loss": {
        "unknown": ("mse2", True),
        "a number": (3, True),
        "none": (None, True),
        "of none": (lambda: 0.0, True),
        "of text": (lambda p, m, s: "x", True),
        "of a vector": (lambda p, m, s: p[:, 0], True),
        "of nan": (lambda p, m, s: jnp.nan * jnp.sum(p), True),
    },
    "regularizers": {
        "a number": (3, True),
        "a text": ("x", True),
        "numbers": ([3], True),
        "of none": (lambda p, c: None, True),
        "of a vector": (lambda p, c: jnp.ones(2), True),
        "of one argument": (lambda p: 0.0, True),
    },
    "sequence_length": {
        "zero": (0.0, True),
        "negative": (-1.0, True),
        "nan": (NAN, True),
        "a text": ("x", True),
        "longer than the record": (50.0, True),
        "inf": (INF, True),
        "complex": (1j, True),
        "less than a sample": (1e-3, True),
    },
    "batch_size": {
        "zero": (0, True),
        "negative": (-1, True),
        "a fraction": (1.5, True),
        "a text": ("x", True),
        "none": (None, True),
        "nan": (NAN, True),
        "a list": ([1], True),
    },
    "subsample": {
        "zero": (0.0, True),
        "negative": (-1.0, True),
        "above one": (2.0, True),
        "nan": (NAN, True),
        "a text": ("x", True),
    },
    "strategy": {
        "unknown": ("q", True),
        "a number": (3, True),
        "none": (None, True),
        "empty": ((), True),
        "numbers": ([3], True),
    },
    "epochs": {
        "zero": (0, True),
        "negative": (-1, True),
        "a fraction": (1.5, True),
        "a text": ("x", True),
        "two for one": ((1, 2), True),
        "nan": (NAN, True),
        "empty": ((), True),
        "inf": (INF, True),
        "texts": (["a"], True),
    },
    "optimizer": {
        "a text": ("adam", True),
        "a number": (3, True),
        "a function": (optax.adam, True),
        "a class": (dict, True),
    },
    "dt": {
        "zero": (0.0, True),
        "negative": (-0.1, True),
        "no part": (0.03, True),
        "nan": (NAN, True),
        "a text": ("x", True),
        "too long": (5.0, True),
        "an object": (object(), True),
    },
    "solver": {
        "unknown": ("tsit6", True),
        "a number": (3, True),
        "none": (None, True),
        "a class": (diffrax.Heun, True),
        "multi-step": (diffrax.LeapfrogMidpoint(), True),
    },
    "x0": {
        "unknown": ("q", True),
        "a number": (3.0, True),
        "unknown names": ({"q": 1.0}, True),
        "nan": ({"mass.s": NAN}, True),
        "none": (None, True),
        "an array": (np.ones(7), True),
    },
    "dtype": {
        "unknown": ("banana", True),
        "integer": (int, True),
        "half": ("float16", True),
        "complex": (complex, True),
    },
    "devices": {
        "a text": ("gpu", True),
        "a number": (3, True),
        "empty": ([], True),
        "numbers": ([0], True),
    },
    "validation": {
        "zero": (0.0, True),
        "above one": (2.0, True),
        "negative": (-0.1, True),
        "a text": ("x", True),
        "nan": (NAN, True),
        "all": (1.0, True),
        "a list": ([0.1], True),
    },
    "evaluate_every": {
        "zero": (0, True),
        "negative": (-1, True),
        "a text": ("x", True),
        "a fraction": (1.5, True),
    },
    "patience": {
        "zero": (0, True),
        "negative": (-1, True),
        "a text": ("x", True),
        "nan": (NAN, True),
    },
    "observers": {"numbers": ([3], True), "a number": (3, True), "a text": ("x", True)},
    "checkpoint": {
        "no folder": ("/dev/null/x.safetensors", True),
        "a number": (3, True),
        "another kind": ("x.txt", False),
        "no text": ("", False),
    },
    "parameter_spread": {
        "unknown": ({"q": 1.0}, True),
        "nan": ({"mass.m": NAN}, True),
        "a number": (3, True),
        "a list": (["q"], True),
        "negative": ({"spring.c": -1.0}, False),
    },
    "params": {
        "unknown": ({"q": 1.0}, True),
        "a text": ("x", True),
        "a number": (3, True),
        "a list": ([1], True),
    },
    "seed": {
        "a text": ("x", True),
        "a fraction": (1.5, True),
        "none": (None, False),
        "an object": (object(), True),
    },
    "qqq": {"an unknown option": (1, True)},
}
for _option, _values in FIT.items():
    CALLS.setdefault("fit options", {}).update(
        {
            f"{_option}: {what}": (
                fitted(**{_option: const(value)}),
                certain,
                (
                    _option,
                    "regularizer",
                    "training",
                    "trained",
                    "record",
                    "has no",
                    "parameter",
                    "spread",
                    "sequence",
                    "network",
                    "solver",
                    "steps",
                    "checkpoint",
                    "scheme",
                    "folder",
                ),
            )
            for what, (value, certain) in _values.items()
        }
    )
CALLS["fit data"] = {
    f"{which}: {what}": (
        fitted(**{which: make}),
        True,
        (
            "record",
            "data",
            "target",
            "has no",
            "variable",
            "input",
            "time",
            "state",
            "measured",
            "'q'",
            "samples",
        ),
    )
    for which, entries in {
        "data": {
            "none": const(None),
            "a text": const("x"),
            "an array": const(np.ones(5)),
            "empty": const({}),
            "no inputs": lambda c: ac.Data(c.t, {c.state: np.ones(N)}),
            "only inputs": lambda c: ac.Data(c.t, {c.input: np.ones(N)}),
            "one sample": lambda c: ac.Data([0.0], {c.input: [1.0], c.state: [1.0]}),
            "another unit": lambda c: ac.Data(
                c.t, dict(c.data.signals), dict.fromkeys(c.data.signals, "cd")
            ),
            "nan": lambda c: {**c.record, c.state: np.full(N, NAN)},
            "no time": lambda c: dict(c.data.signals),
            "unlike lengths": lambda c: {**c.record, c.state: np.ones(3)},
            "a list of texts": const(["run 1", "run 2"]),
            "a solution": lambda c: result(c),
            "an unknown signal": lambda c: {**c.record, "q": np.ones(N)},
            "the system": lambda c: c.system,
        },
        "targets": {
            "none": const(None),
            "a number": const(3),
            "unknown": const(["q"]),
            "a text unknown": const("q"),
            "empty": const([]),
            "no text": const(""),
            "numbers": const([3]),
            "an input": lambda c: [c.input],
            "a parameter": lambda c: [c.parameter],
            "twice": lambda c: [c.state, c.state],
            "not measured": lambda c: [f"der({c.second})"],
            "none inside": const([None]),
        },
    }.items()
    for what, make in entries.items()
}
CALLS["fit call"] = {
    "a model": (lambda c, f: ac.fit(c.system.model, c.data, [c.state]), True, ("fit",)),
    "exchanged": (lambda c, f: ac.fit(c.data, c.system, [c.state]), True, ("fit",)),
    "no targets": (lambda c, f: ac.fit(c.system, c.data), True, ("fit",)),
    "nothing to train": (
        lambda c, f: ac.fit(case("thermal").system, case("thermal").data, ["plate.T"]),
        True,
        ("train",),
    ),
    "an ensemble of none": (
        lambda c, f: ac.ensemble(
            c.system, c.data, [c.state], members=0, epochs=1, modifiers=[c.parameter]
        ),
        True,
        ("member",),
    ),
    "an ensemble of text": (
        lambda c, f: ac.ensemble(
            c.system, c.data, [c.state], members="x", epochs=1, modifiers=[c.parameter]
        ),
        True,
        ("member",),
    ),
}

# -- everything else ---------------------------------------------------------------------------------

on_system(
    "files",
    {
        "load of nothing": (lambda c, f: ac.load(f / "none.json"), True),
        "load of a number": (lambda c, f: ac.load(3.5), True),
        "load of none": (lambda c, f: ac.load(None), True),
        "load of a folder": (lambda c, f: ac.load(f), True),
        "save of a system": (lambda c, f: ac.save(c.system, f / "a.json"), True),
        "save exchanged": (lambda c, f: ac.save(f / "a.json", c.system.model), True),
        "save in no folder": (
            lambda c, f: ac.save(case("thermal").system.model, f / "none" / "a.json"),
            True,
        ),
        "save of a class": (lambda c, f: ac.save(tl.Mass, f / "a.json"), True),
        "save to a number": (lambda c, f: ac.save(case("thermal").system.model, 3.5), True),
        "save to a folder": (lambda c, f: ac.save(case("thermal").system.model, f), True),
        "save with a library of text": (
            lambda c, f: ac.save(case("thermal").system.model, f / "s.json", "os"),
            True,
        ),
        "libraries of a module": (lambda c, f: ac.load(f / "none.json", libraries=tl), True),
        "load with a budget of text": (
            lambda c, f: (
                ac.save(case("thermal").system.model, f / "b.json"),
                ac.load(f / "b.json", budget="x"),
            ),
            True,
        ),
        "parameters to a number": (
            lambda c, f: ac.save_params(c.system.parameters(), 3.5),
            True,
        ),
        "parameters to a folder": (lambda c, f: ac.save_params(c.system.parameters(), f), True),
        "parameters of a model": (
            lambda c, f: ac.load_params(f / "none.safetensors", c.system.model),
            True,
        ),
        "a log in a number": (lambda c, f: ac.CsvLog(3.5), True),
        "a log in a folder": (lambda c, f: ac.CsvLog(f), True),
        "a TensorBoard in a number": (lambda c, f: ac.TensorBoardLog(3.5), True),
        "a cache in a number": (lambda c, f: ac.use_compilation_cache(3.5), True),
        "a cache in no folder": (lambda c, f: ac.use_compilation_cache("/dev/null/x"), True),
        "libraries of text": (lambda c, f: ac.load(f / "none.json", libraries=["os"]), True),
        "libraries of a number": (lambda c, f: ac.load(f / "none.json", libraries=3), True),
        "parameters exchanged": (
            lambda c, f: ac.save_params(f / "a.safetensors", c.system.parameters()),
            True,
        ),
        "parameters in no folder": (
            lambda c, f: ac.save_params(c.system.parameters(), f / "none" / "a.safetensors"),
            True,
        ),
        "parameters of text": (lambda c, f: ac.save_params("x", f / "a.safetensors"), True),
        "parameters of nothing": (
            lambda c, f: ac.load_params(f / "none.safetensors", c.system),
            True,
        ),
        "parameters of a number": (lambda c, f: ac.load_params(3.5, c.system), True),
        "parameters of a folder": (lambda c, f: ac.load_params(f, c.system), True),
        "parameters that are none": (
            lambda c, f: (
                f.joinpath("b.safetensors").write_bytes(b"junk" * 20),
                ac.load_params(f / "b.safetensors", c.system),
            ),
            True,
        ),
        "parameters of another model": (
            lambda c, f: (
                ac.save_params({"q": 1.0}, f / "c.safetensors"),
                ac.load_params(f / "c.safetensors", c.system),
            ),
            True,
        ),
        "no bytes": (
            lambda c, f: (
                f.joinpath("d.safetensors").write_bytes(b""),
                ac.load_params(f / "d.safetensors", c.system),
            ),
            True,
        ),
        "saved as text": (lambda c, f: ac.save_params({"a": "x"}, f / "e.safetensors"), False),
    },
    "save",
    "none",
    "load",
    "path",
    "file",
    "fuzz",
    "librar",
    "safetensors",
    "params",
    "Log",
    "cache",
    "compiled programs",
    "budget",
)
on_system(
    "analysis",
    {
        "linearize a model": (lambda c, f: ac.linearize(c.system.model), True),
        "linearize at text": (lambda c, f: ac.linearize(c.system, x="x"), True),
        "linearize with unknown outputs": (
            lambda c, f: ac.linearize(c.system, outputs=["q"]),
            True,
        ),
        "linearize with a keyword": (lambda c, f: ac.linearize(c.system, q=1), True),
        "linearize too short": (lambda c, f: ac.linearize(c.system, x=np.ones(7)), True),
        "linearize at nan": (
            lambda c, f: ac.linearize(c.system, np.full(len(c.system.states), NAN)),
            False,
        ),
        "a response of text": (lambda c, f: ac.linearize(c.system).frequency_response("x"), True),
        "linearize at a text of time": (lambda c, f: ac.linearize(c.system, t="now"), True),
        "linearize with parameters of a number": (
            lambda c, f: ac.linearize(c.system, params=3),
            True,
        ),
        "linearize with inputs of text": (lambda c, f: ac.linearize(c.system, inputs="u"), True),
        "a response of nan": (lambda c, f: ac.linearize(c.system).frequency_response(NAN), True),
        "a response of nothing": (lambda c, f: ac.linearize(c.system).frequency_response([]), True),
        "a response of none": (lambda c, f: ac.linearize(c.system).frequency_response(None), True),
        "a response in rows": (
            lambda c, f: ac.linearize(c.system).frequency_response(np.ones((2, 2))),
            True,
        ),
        "distill a number": (lambda c, f: ac.distill(3, 0, 1), True),
        "distill over nothing": (lambda c, f: ac.distill(jnp.tanh, None, None), True),
        "distill over texts": (lambda c, f: ac.distill(jnp.tanh, "a", "b"), True),
        "distill backwards": (lambda c, f: ac.distill(jnp.tanh, 1.0, 0.0), True),
        "distill to nan": (lambda c, f: ac.distill(jnp.tanh, 0.0, NAN), True),
        "distill in no terms": (lambda c, f: ac.distill(jnp.tanh, 0, 1, terms=0), True),
        "distill in text terms": (lambda c, f: ac.distill(jnp.tanh, 0, 1, terms="x"), True),
        "distill in a fraction of terms": (
            lambda c, f: ac.distill(jnp.tanh, 0, 1, terms=1.5),
            True,
        ),
        "distill among unknown": (lambda c, f: ac.distill(jnp.tanh, 0, 1, among=["q"]), True),
        "distill among a number": (lambda c, f: ac.distill(jnp.tanh, 0, 1, among=3), True),
        "distill to a text": (
            lambda c, f: ac.distill(jnp.tanh, 0, 1, terms=1, tolerance="x"),
            True,
        ),
        "distill a function of text": (lambda c, f: ac.distill(lambda x: "x", 0, 1), True),
        "a budget of text": (lambda c, f: ac.compile(c.system.model, budget="x"), True),
        "a budget of a number": (lambda c, f: ac.compile(c.system.model, budget=3), True),
        "a budget of nothing": (
            lambda c, f: ac.compile(c.system.model, budget=ac.Budget(0, 0)),
            True,
        ),
        "a diagram of nothing": (lambda c, f: ac.diagram(3), True),
        "compile text": (lambda c, f: ac.compile("x"), True),
        "compile twice": (lambda c, f: ac.compile(c.system), True),
        "remove the offset of text": (lambda c, f: ac.remove_offset("x"), True),
        "linearize outputs of a number": (lambda c, f: ac.linearize(c.system, outputs=3), True),
    },
    "linearize",
    "states",
    "variable",
    "x",
    "distill",
    "outputs",
    "diagram",
    "compile",
    "offset",
    "frequenc",
    "range",
    "operating",
    "t=",
    "inputs",
    "params",
    "budget",
    "ax=",
)
on_system(
    "networks",
    {
        "a law of width zero": (lambda c, f: ac.networks.Law(width=0)(jax.random.key(0)), True),
        "a law of text": (lambda c, f: ac.networks.Law(width="x")(jax.random.key(0)), True),
        "a law of no key": (lambda c, f: ac.networks.Law()(None), True),
        "a law without its second": (
            lambda c, f: ac.networks.Law(secondary=1)(jax.random.key(0))(1.0),
            True,
        ),
        "a law with too many": (lambda c, f: ac.networks.Law()(jax.random.key(0))(1.0, 2.0), True),
        "a law of an unknown promise": (lambda c, f: ac.networks.Law(promise="q"), True),
        "an activation unknown": (
            lambda c, f: ac.networks.Law(activation="q")(jax.random.key(0)),
            True,
        ),
        "a negative secondary": (
            lambda c, f: ac.networks.Law(secondary=-1)(jax.random.key(0)),
            True,
        ),
        "a scale of zero": (lambda c, f: ac.networks.Law(input_scale=0.0)(jax.random.key(0)), True),
        "a scale of nan": (lambda c, f: ac.networks.Law(output_scale=NAN)(jax.random.key(0)), True),
        "a scale of text": (
            lambda c, f: ac.networks.Law(output_scale="x")(jax.random.key(0)),
            True,
        ),
        "a bounded of text": (lambda c, f: ac.Bounded("a", "b"), False),
        "bounds exchanged": (lambda c, f: ac.Bounded(2.0, 1.0), False),
        "bounds of nan": (lambda c, f: ac.Bounded(NAN, 1.0), False),
        "a shift of nan": (lambda c, f: ac.Shift(NAN), False),
        "a shift of text": (lambda c, f: ac.Shift("x"), False),
        "a shift of zero": (lambda c, f: ac.Shift(0.0), False),
        "depth of a fraction": (lambda c, f: ac.networks.Law(depth=1.5)(jax.random.key(0)), True),
        "lbfgs of text": (lambda c, f: ac.lbfgs("x", "y"), True),
        "depth negative": (lambda c, f: ac.networks.Law(depth=-1)(jax.random.key(0)), True),
        "an energy of width zero": (
            lambda c, f: ac.networks.Energy(width=0)(jax.random.key(0)),
            True,
        ),
    },
    "Law",
    "width",
    "activation",
    "secondary",
    "scale",
    "Bounded",
    "bound",
    "Shift",
    "depth",
    "key",
    "lbfgs",
    "Energy",
    "law",
    "inputs",
    "network",
)


ALL = [(kind, what) for kind, entries in CALLS.items() for what in entries]


ORDER = random.Random("calls").sample(ALL, len(ALL))


def mutant(seed: int, folder: Path) -> Mutant:
    """The wrong call of a seed; seeds in a row go through all of them, and then again on another model."""
    again, place = divmod(seed, len(ALL))
    kind, what = ORDER[place]
    domain = list(DOMAINS)[(place + again) % len(DOMAINS)]
    call, certain, places = CALLS[kind][what]
    c = case(domain)
    return Mutant(
        seed,
        domain,
        kind,
        what,
        (*places, str(folder), c.input, c.state, c.parameter),
        certain,
        lambda: call(c, folder),
    )
