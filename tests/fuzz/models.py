"""Wrong Python models: parts, connections, names, declarations and equations, wrongly used."""

from __future__ import annotations

import copy
import math
import random
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Any

import jax.numpy as jnp
import numpy as np
import sympy as sp

import acausal as ac
from acausal.components import electrical as el, neural, thermal, translational as tl
from tests.support.parts import endpoint

from .outcome import Mutant
from .sound import SOUND, Built, Document, argument, build, class_of, plain


class Oddity:
    """An object that nothing knows."""


WRONG_VALUES: dict[str, Callable[[], Any]] = {
    "a complex number": lambda: 1j,
    "an object": Oddity,
    "a text": lambda: "heavy",
    "no text": lambda: "",
    "bytes": lambda: b"1",
    "nan": lambda: math.nan,
    "inf": lambda: math.inf,
    "an array": lambda: np.ones(3),
    "a list": lambda: [1.0, 2.0, 3.0],
    "an empty list": list,
    "a set": lambda: {1.0},
    "a function": lambda: lambda x: x,
    "a symbol": lambda: sp.Symbol("z"),
    "the imaginary unit": lambda: sp.I,
    "infinity of sympy": lambda: sp.oo,
    "nan of sympy": lambda: sp.nan,
    "zoo": lambda: sp.zoo,
    "a component": lambda: tl.Mass(m=1.0),
    "a class": lambda: tl.Mass,
    "a type": lambda: float,
    "a relation": lambda: sp.Symbol("x") > 1,
    "a matrix": lambda: jnp.ones((2, 2)),
    "a huge integer": lambda: 10**400,
    "the time": lambda: ac.time,
    "a module": lambda: np,
    "a range": lambda: range(5),
    "nan of numpy": lambda: np.float32("nan"),
    "an equation": lambda: sp.Eq(sp.Symbol("x"), 1),
    "a dict": lambda: {"q": 1},
    "a date": lambda: np.datetime64("2020-01-01"),
    "an array of objects": lambda: np.array([None], object),
    "a parameter": lambda: ac.Parameter(1.0),
    "an ellipsis": lambda: ...,
    "not implemented": lambda: NotImplemented,
}
ODD_VALUES: dict[str, Callable[[], Any]] = {
    "zero": lambda: 0,
    "minus one": lambda: -1.0,
    "tiny": lambda: 5e-324,
    "huge": lambda: 1e300,
    "true": lambda: True,
    "a decimal": lambda: Decimal("1.5"),
    "a fraction": lambda: Fraction(1, 3),
    "float32": lambda: np.float32(2.0),
    "an integer": lambda: 3,
    "an array of one": lambda: np.ones(1),
    "an array of none": lambda: np.asarray(2.0),
    "a JAX scalar": lambda: jnp.asarray(2.0),
    "a rational": lambda: sp.Rational(1, 3),
    "nothing": lambda: None,
    "a large integer": lambda: 2**70,
    "small and negative": lambda: -1e-9,
    "the circle number": lambda: ac.pi,
    "a start": lambda: ac.Start(1.0),
    "an open start": lambda: ac.Start(1.0, fixed=False),
    "a fixed start": lambda: ac.Start(2.0, fixed=True),
    "int64": lambda: np.int64(2),
    "a root": lambda: sp.sqrt(2),
    "false": lambda: False,
    "a tuple": lambda: (1.0,),
    "an initial parameter": lambda: ac.InitialParameter(1.0),
    "a signal": lambda: ac.Signal([0.0, 1.0], [1.0, 2.0]),
}


@dataclass(frozen=True)
class Wrong:
    """How to make the model, what is wrong with it, of which names a message must hold one, and whether it is wrong."""

    make: Callable[[], Any]
    detail: str
    places: tuple[str, ...]
    certain: bool


Change = Callable[[random.Random, Document], Wrong]
CHANGES: dict[str, Change] = {}
OWN_PLACES = ("Own", "own")


def change(function: Change) -> Change:
    """Register a kind of change."""
    CHANGES[function.__name__] = function
    return function


def names(doc: Document) -> tuple[str, ...]:
    return (*doc["components"], "Built")


def built(doc: Document) -> ac.Component:
    return build(plain(doc), doc["connections"])


def compiled(doc: Document) -> Any:
    return ac.compile(built(doc))


def pick_modifier(rng: random.Random, doc: Document) -> tuple[str, str]:
    return rng.choice([(n, k) for n, p in doc["components"].items() for k in p["with"]])


def made_with(doc: Document, name: str, /, **given: Any) -> Any:
    """The model, one of whose parts has other arguments."""
    made, parts = Built(), plain(doc)
    for part, entry in parts.items():
        arguments = {k: argument(v) for k, v in entry["with"].items()} | (
            given if part == name else {}
        )
        setattr(made, part, class_of(entry["class"])(**arguments))
    for ends in doc["connections"]:
        made.connect(*(endpoint(made, end) for end in ends))
    return ac.compile(made)


# -- arguments ---------------------------------------------------------------------------------------


@change
def value_of_another_kind(rng: random.Random, doc: Document) -> Wrong:
    name, key = pick_modifier(rng, doc)
    what = rng.choice(list(WRONG_VALUES))
    cls = class_of(doc["components"][name]["class"])
    places = (name, cls.__name__, key)
    scalar = isinstance(plain(doc)[name]["with"][key], float)
    return Wrong(
        lambda: made_with(doc, name, **{key: WRONG_VALUES[what]()}),
        f"{name}.{key} is {what}",
        places,
        scalar,
    )


@change
def odd_value(rng: random.Random, doc: Document) -> Wrong:
    name, key = pick_modifier(rng, doc)
    what = rng.choice(list(ODD_VALUES))
    places = (*names(doc), class_of(doc["components"][name]["class"]).__name__)
    return Wrong(
        lambda: made_with(doc, name, **{key: ODD_VALUES[what]()}),
        f"{name}.{key} is {what}",
        places,
        False,
    )


@change
def unknown_argument(rng: random.Random, doc: Document) -> Wrong:
    name, key = pick_modifier(rng, doc)
    wrong = rng.choice(
        [
            key + "_",
            key[:-1] + "Q",
            "qqq",
            "self_",
            "equations",
            "flange",
            "_node",
            "name",
            "connect",
            key.upper() + "x",
        ]
    )
    cls = class_of(doc["components"][name]["class"]).__name__
    return Wrong(
        lambda: made_with(doc, name, **{wrong: 1.0}),
        f"{name}({wrong}=1.0)",
        (cls, name, wrong),
        True,
    )


@change
def positional(rng: random.Random, doc: Document) -> Wrong:
    name = rng.choice(sorted(doc["components"]))
    cls = class_of(doc["components"][name]["class"])
    values = rng.choice([(1.0,), (1.0, 2.0), ("m",), (tl.Mass,), (None,)])
    return Wrong(
        lambda: ac.compile(cls(*values)),
        f"{cls.__name__}{values}",
        (cls.__name__, "__init__"),
        True,
    )


@change
def swapped_arguments(rng: random.Random, doc: Document) -> Wrong:
    """Two arguments of a part, or of two parts, change places."""
    a, x = pick_modifier(rng, doc)
    b, y = pick_modifier(rng, doc)
    parts = plain(doc)
    given = parts[a]["with"], parts[b]["with"]
    given[0][x], given[1][y] = given[1][y], given[0][x]
    places = (
        *names(doc),
        class_of(parts[a]["class"]).__name__,
        class_of(parts[b]["class"]).__name__,
    )
    return Wrong(
        lambda: ac.compile(build(parts, doc["connections"])), f"{a}.{x} for {b}.{y}", places, False
    )


@change
def another_class(rng: random.Random, doc: Document) -> Wrong:
    name, keep = rng.choice(sorted(doc["components"])), rng.random() < 0.5
    other = SOUND[rng.choice(sorted(SOUND))]
    parts = plain(doc)
    replacement = plain(other)[rng.choice(sorted(other["components"]))]
    parts[name] = replacement if keep else {"class": replacement["class"], "with": {}}
    places = (*names(doc), class_of(replacement["class"]).__name__)
    return Wrong(
        lambda: ac.compile(build(parts, doc["connections"])),
        f"{name} of class {replacement['class']}",
        places,
        False,
    )


@change
def another_class_of_the_domain(rng: random.Random, doc: Document) -> Wrong:
    """Connectors may fit, so that the model gets as far as its equations."""
    name = rng.choice(sorted(doc["components"]))
    parts = plain(doc)
    library = parts[name]["class"].split(".")[2]
    module = __import__(f"acausal.components.{library}", fromlist=["x"])
    classes = sorted(
        n
        for n, c in vars(module).items()
        if isinstance(c, type) and issubclass(c, ac.Component) and "Partial" not in n
    )
    cls = rng.choice(classes)
    given = {
        k: rng.choice([0.5, 1.0, 2.0])
        for k, d in getattr(module, cls)._declared.items()
        if isinstance(d, ac.Parameter) and d.default is None and d.shape is None and d.when is None
    }
    parts[name] = {"class": f"acausal.components.{library}.{cls}", "with": given}
    places = (*names(doc), cls, "'u'", "'y'")
    return Wrong(
        lambda: ac.compile(build(parts, doc["connections"])),
        f"{name} of class {cls}({given})",
        places,
        False,
    )


@change
def wrong_modify(rng: random.Random, doc: Document) -> Wrong:
    name = rng.choice(sorted(doc["components"]))
    how = rng.choice(["qqq", "part", "number", "start", "nested", "connector", "none"])

    def make() -> Any:
        made = built(doc)
        given: Any = {
            "qqq": {"qqq": 1.0},
            "part": {name: 1.0},
            "number": {name: {"qqq": 2}},
            "start": {name: {"qqq": ac.Start(1.0)}},
            "nested": {name: {name: {name: 1}}},
            "connector": {name: {"flange_": {"s": 1}}},
            "none": {name: None},
        }[how]
        made.modify(**given)
        return ac.compile(made)

    return Wrong(make, f"modify ({how}) of {name}", ("Built", name), True)


# -- connections -------------------------------------------------------------------------------------

NO_ENDS: dict[str, Callable[[ac.Component, str], Any]] = {
    "a number": lambda m, p: 3,
    "a text": lambda m, p: p,
    "none": lambda m, p: None,
    "the part": lambda m, p: getattr(m, p),
    "the model": lambda m, p: m,
    "a class": lambda m, p: tl.Mass,
    "the class's connector": lambda m, p: tl.Mass.flange_a,
    "a stranger's": lambda m, p: tl.Mass(m=1.0).flange_a,
    "an empty list": lambda m, p: [],
    "a list of numbers": lambda m, p: [1, 2],
    "a new connector": lambda m, p: tl.Flange(),
    "a symbol": lambda m, p: sp.Symbol("x"),
    "the time": lambda m, p: ac.time,
    "a method": lambda m, p: getattr(m, p).equations,
    "a connector's class": lambda m, p: el.Pin,
    "an array": lambda m, p: np.zeros(2),
    "a dict": lambda m, p: {},
    "a function": lambda m, p: len,
    "a parameter": lambda m, p: ac.Parameter(1.0),
}


@change
def not_an_end(rng: random.Random, doc: Document) -> Wrong:
    what, name = rng.choice(list(NO_ENDS)), rng.choice(sorted(doc["components"]))
    ends = rng.choice(doc["connections"])

    def make() -> Any:
        made = built(doc)
        pair = [endpoint(made, ends[0]), NO_ENDS[what](made, name)]
        made.connect(*(pair if rng.random() < 0.5 else pair[::-1]))
        return ac.compile(made)

    places = (*names(doc), "connect", "connector", "connected", "Mass")
    return Wrong(make, f"{ends[0]} connected to {what}", places, True)


@change
def missing_connection(rng: random.Random, doc: Document) -> Wrong:
    gone = doc["connections"].pop(rng.randrange(len(doc["connections"])))
    return Wrong(lambda: compiled(doc), f"without {gone}", names(doc), False)


@change
def extra_connection(rng: random.Random, doc: Document) -> Wrong:
    ends = sorted({e for c in doc["connections"] for e in c})
    doc["connections"].append(rng.sample(ends, rng.choice([2, 2, 3])))
    return Wrong(lambda: compiled(doc), f"also {doc['connections'][-1]}", names(doc), False)


@change
def shuffled_connections(rng: random.Random, doc: Document) -> Wrong:
    ends = [e for c in doc["connections"] for e in c]
    i, j = rng.sample(range(len(ends)), 2)
    ends[i], ends[j] = ends[j], ends[i]
    doc["connections"] = [ends[k : k + 2] for k in range(0, len(ends), 2)]
    return Wrong(lambda: compiled(doc), f"{ends[i]} for {ends[j]}", names(doc), False)


@change
def connected_to_itself(rng: random.Random, doc: Document) -> Wrong:
    end = rng.choice([e for c in doc["connections"] for e in c])
    doc["connections"].append([end, end])
    return Wrong(lambda: compiled(doc), f"{end} to itself", (end,), True)


@change
def without_a_part(rng: random.Random, doc: Document) -> Wrong:
    name = rng.choice(sorted(doc["components"]))
    del doc["components"][name]
    doc["connections"] = [c for c in doc["connections"] if all(e.split(".")[0] != name for e in c)]
    return Wrong(lambda: compiled(doc), f"without {name}", names(doc), False)


@change
def doubled_part(rng: random.Random, doc: Document) -> Wrong:
    """In parallel with its twin, or in series through one end."""
    name = rng.choice(sorted(doc["components"]))
    doc["components"]["twin"] = copy.deepcopy(doc["components"][name])
    ends = [c for c in doc["connections"] if any(e.split(".")[0] == name for e in c)]
    for c in ends if rng.random() < 0.5 else ends[:1]:
        doc["connections"].append(
            [e if e.split(".")[0] != name else "twin." + e.split(".", 1)[1] for e in c]
        )
    return Wrong(lambda: compiled(doc), f"{name} doubled", names(doc), False)


@change
def unlike_domains(rng: random.Random, doc: Document) -> Wrong:
    end = rng.choice([e for c in doc["connections"] for e in c])
    thermally = end.endswith(("port", "port_a", "port_b", "heatPort"))

    def make() -> Any:
        made = built(doc)
        made.stranger = tl.Mass(m=1.0) if thermally else thermal.HeatCapacitor(C=1.0)
        made.connect(
            endpoint(made, end), made.stranger.flange_a if thermally else made.stranger.port
        )
        return ac.compile(made)

    return Wrong(make, f"{end} to another domain", (end,), True)


# -- names and the tree ------------------------------------------------------------------------------

TREES: dict[str, Callable[[Any, str], Any]] = {
    "one name twice": lambda m, p: setattr(m, p, tl.Mass(m=1.0)),
    "one part twice": lambda m, p: setattr(m, "again", getattr(m, p)),
    "in itself": lambda m, p: setattr(m, "inner", m),
    "in its part": lambda m, p: setattr(getattr(m, p), "outer", m),
    "a class": lambda m, p: ac.compile(type(m)),
    "no name": lambda m, p: setattr(m, "a b", tl.Mass(m=1.0)),
    "the name of a method": lambda m, p: setattr(m, "equations", tl.Mass(m=1.0)),
    "the name of the time": lambda m, p: setattr(m, "time", tl.Mass(m=1.0)),
    "the node": lambda m, p: setattr(m, "_node", tl.Mass(m=1.0)),
    "one in two lists": lambda m, p: setattr(m, "both", [getattr(m, p), getattr(m, p)]),
    "a mixed list": lambda m, p: (
        setattr(m, "mixed", [tl.Mass(m=1.0), 3]),
        m.connect(m.mixed[0].flange_a, m.mixed[1]),
    ),
    "a number's name": lambda m, p: setattr(m, "1st", tl.Mass(m=1.0)),
    "not a component": lambda m, p: ac.compile({"m": m}),
    "none": lambda m, p: ac.compile(None),
    "a list": lambda m, p: ac.compile([m]),
    "a system": lambda m, p: ac.compile(ac.compile(built(SOUND["thermal"]))),
    "an empty name": lambda m, p: setattr(m, "", tl.Mass(m=1.0)),
}


@change
def wrong_tree(rng: random.Random, doc: Document) -> Wrong:
    what, name = rng.choice(list(TREES)), rng.choice(sorted(doc["components"]))

    def make() -> Any:
        made = built(doc)
        TREES[what](made, name)
        return ac.compile(made)

    places = (*names(doc), "compile", "name", "again", "both", "contain", "flange_a")
    return Wrong(make, what, places, True)


# -- parameters that depend on each other ------------------------------------------------------------


def numbers(doc: Document) -> list[tuple[str, str]]:
    """Parts and their arguments that are numbers."""
    return [
        (n, k) for n, p in plain(doc).items() for k, v in p["with"].items() if isinstance(v, float)
    ]


BINDINGS: dict[str, tuple[Callable[[Any], Any], bool]] = {
    "itself doubled": (lambda p: 2 * p, True),
    "a variable": (lambda p: tl.Mass(m=1.0).s, True),
    "another model's": (lambda p: 2 * tl.Mass(m=1.0).m, True),
    "a symbol": (lambda p: sp.Symbol("q"), True),
    "the time": (lambda p: ac.time, True),
    "a derivative": (lambda p: ac.der(tl.Mass(m=1.0).s), True),
    "a division by zero": (lambda p: p / 0, True),
    "a list of it": (lambda p: [p], True),
    "a relation": (lambda p: p > 0, True),
    "a text of it": (str, True),
    "an imaginary multiple": (lambda p: sp.I, True),
}


@change
def wrong_binding(rng: random.Random, doc: Document) -> Wrong:
    what = rng.choice(list(BINDINGS))
    part, key = rng.choice(numbers(doc))

    def make() -> Any:
        made = built(doc)
        owner = getattr(made, part)
        owner.modify(**{key: BINDINGS[what][0](getattr(owner, key))})
        return ac.compile(made)

    return Wrong(make, f"{part}.{key} bound to {what}", (part, key), BINDINGS[what][1])


@change
def bound_across(rng: random.Random, doc: Document) -> Wrong:
    """A parameter given by another part's: sound if the units agree, and wrong in a circle."""
    (a, x), (b, y) = rng.choice(numbers(doc)), rng.choice(numbers(doc))
    factor, both = rng.choice([1, 2.0, -1, 0, 1e300]), rng.random() < 0.3

    def make() -> Any:
        made: Any = built(doc)
        getattr(made, a).modify(**{x: factor * getattr(getattr(made, b), y)})
        if both:
            getattr(made, b).modify(**{y: 1 + getattr(getattr(made, a), x)})
        return ac.compile(made)

    return Wrong(
        make, f"{a}.{x} = {factor}*{b}.{y}" + (", and back" if both else ""), names(doc), False
    )


# -- declarations ------------------------------------------------------------------------------------


class Own(ac.Component):
    """A component of one's own; a mutant gives its declarations and equations."""

    x = ac.Variable(start=1.0, fixed=True)
    y = ac.Variable()
    k = ac.Parameter(2.0)
    u = ac.Input()
    net = ac.Module(lambda key: lambda x: jnp.tanh(x))

    def __init__(
        self, stated: Callable[[Any], Any], initial: Callable[[Any], Any] | None = None
    ) -> None:
        super().__init__()
        self.stated, self.initial = stated, initial

    def equations(self) -> Iterable[ac.Eq]:
        return self.stated(self)

    def initial_equations(self) -> Iterable[ac.Eq]:
        return self.initial(self) if self.initial else ()


def raises(error: Exception) -> Any:
    raise error


def rates(s: Any) -> list[Any]:
    return [ac.Eq(ac.der(s.x), -s.k * s.x + s.u), ac.Eq(s.y, 2 * s.x)]


E, der = ac.Eq, ac.der
WRONG_EQUATIONS: dict[str, Callable[[Any], Any]] = {
    "nothing": lambda s: None,
    "a number": lambda s: 3,
    "a text": lambda s: "x = 1",
    "one equation": lambda s: E(der(s.x), 1),
    "expressions": lambda s: [s.x, s.y],
    "truth values": lambda s: [True, s.x == 1],
    "a list of lists": lambda s: [[E(s.y, 1), E(der(s.x), 1)]],
    "equations of sympy": lambda s: [sp.Eq(s.x, s.y), sp.Eq(s.y, 1)],
    "too few": lambda s: [E(der(s.x), s.y)],
    "too many": lambda s: [*rates(s), E(s.x, 3)],
    "none at all": lambda s: [],
    "one twice": lambda s: [rates(s)[0], rates(s)[0]],
    "the same divided": lambda s: [E(s.x, s.y), E(2 * s.x, 2 * s.y)],
    "a contradiction": lambda s: [E(s.x, s.y + 1), E(s.x, s.y)],
    "1 = 2": lambda s: [*rates(s), E(1, 2)],
    "math": lambda s: [E(der(s.x), math.sin(s.x)), E(s.y, 1)],
    "numpy": lambda s: [E(der(s.x), np.exp(s.x)), E(s.y, 1)],
    "jax": lambda s: [E(der(s.x), jnp.exp(s.x)), E(s.y, 1)],
    "an if": lambda s: [E(der(s.x), 1 if s.x > 0 else -1), E(s.y, 1)],
    "a symbol": lambda s: [E(der(s.x), sp.Symbol("q")), E(s.y, 1)],
    "nan": lambda s: [E(der(s.x), math.nan), E(s.y, 1)],
    "inf": lambda s: [E(der(s.x), math.inf), E(s.y, 1)],
    "infinity of sympy": lambda s: [E(der(s.x), sp.oo), E(s.y, 1)],
    "zoo": lambda s: [E(der(s.x), sp.zoo * s.x), E(s.y, 1)],
    "the imaginary unit": lambda s: [E(der(s.x), sp.I * s.x), E(s.y, 1)],
    "a complex number": lambda s: [E(der(s.x), 1j), E(s.y, 1)],
    "a text inside": lambda s: [E(der(s.x), "x"), E(s.y, 1)],
    "none inside": lambda s: [E(der(s.x), None), E(s.y, 1)],
    "a list inside": lambda s: [E(der(s.x), [1, 2]), E(s.y, 1)],
    "an array inside": lambda s: [E(der(s.x), np.ones(2)), E(s.y, 1)],
    "a division by zero": lambda s: [E(der(s.x), s.x / 0), E(s.y, 1)],
    "Python's division by zero": lambda s: [E(der(s.x), 1 / 0), E(s.y, 1)],
    "a stranger": lambda s: [E(der(s.x), tl.Mass(m=1.0).s), E(s.y, 1)],
    "an integral": lambda s: [E(der(s.x), sp.Integral(s.x, s.x)), E(s.y, 1)],
    "sympy's derivative": lambda s: [E(sp.Derivative(s.x, ac.time), 1), E(s.y, 1)],
    "a derivative of a number": lambda s: [E(der(1), 1), E(s.y, 1)],
    "a derivative of a parameter": lambda s: [E(der(s.k), s.x), E(s.y, 1)],
    "a derivative of a sum": lambda s: [E(der(s.x + s.y), 1)],
    "a derivative of the time": lambda s: [E(der(ac.time), s.x)],
    "a derivative of text": lambda s: [E(der("x"), 1)],
    "a derivative of none": lambda s: [E(der(None), 1)],
    "an unknown function": lambda s: [E(der(s.x), sp.Function("f")(s.x)), E(s.y, 1)],
    "a gamma function": lambda s: [E(der(s.x), sp.gamma(s.x)), E(s.y, 1)],
    "a sum of sympy": lambda s: [
        E(der(s.x), sp.Sum(sp.Symbol("i"), (sp.Symbol("i"), 1, 3))),
        E(s.y, 1),
    ],
    "a network of two": lambda s: [E(der(s.x), s.net(s.x, s.y)), E(s.y, 1)],
    "a network of none": lambda s: [E(der(s.x), s.net()), E(s.y, 1)],
    "the network itself": lambda s: [E(der(s.x), s.net), E(s.y, 1)],
    "a network of a text": lambda s: [E(der(s.x), s.net("x")), E(s.y, 1)],
    "an unknown attribute": lambda s: [E(der(s.x), s.nothing), E(s.y, 1)],
    "a component": lambda s: [E(der(s.x), s), E(s.y, 1)],
    "a class": lambda s: [E(der(s.x), Own), E(s.y, 1)],
    "an exception": lambda s: raises(RuntimeError("of the author")),
    "a key error": lambda s: raises(KeyError("x")),
    "a generator that fails": lambda s: (raises(ValueError("late")) for _ in range(2)),
    "one side only": lambda s: [E(s.x), E(s.y, 1)],
    "three sides": lambda s: [E(s.x, s.y, 1)],
    "an equation of equations": lambda s: [E(E(s.x, 1), E(s.y, 2))],
    "a comparison as value": lambda s: [E(der(s.x), s.x > 1), E(s.y, 1)],
    "a negated comparison": lambda s: [E(der(s.x), ~(s.x > 1)), E(s.y, 1)],
    "a where of three": lambda s: [E(der(s.x), ac.where(s.x, 1)), E(s.y, 1)],
    "a where of numbers": lambda s: [E(der(s.x), ac.where(3, s.x, 1)), E(s.y, 1)],
    "a sine of two": lambda s: [E(der(s.x), ac.sin(s.x, 1)), E(s.y, 1)],
    "a sine of text": lambda s: [E(der(s.x), ac.sin("x")), E(s.y, 1)],
    "a maximum of none": lambda s: [E(der(s.x), ac.maximum()), E(s.y, 1)],
    "a maximum of a list": lambda s: [E(der(s.x), ac.maximum([s.x, 1])), E(s.y, 1)],
    "an equation for the input": lambda s: [*rates(s), E(s.u, 1)],
    "a dict": lambda s: {"x": 1},
    "a set": lambda s: {E(der(s.x), 1), 3},
    "x = x": lambda s: [E(s.x, s.x), E(s.y, 1)],
    "0 = 0": lambda s: [E(0, 0), E(der(s.x), 1), E(s.y, s.y)],
    "no real solution": lambda s: [E(der(s.x), s.y), E(s.y**2, -1 - s.x**2)],
    "a root of a negative": lambda s: [E(der(s.x), ac.sqrt(-1 - s.x**2)), E(s.y, 1)],
    "a log of zero": lambda s: [E(der(s.x), ac.log(s.x - s.x)), E(s.y, 1)],
    "one over zero": lambda s: [E(der(s.x), 1 / (s.x - 1)), E(s.y, 1)],
    "nan that reaches no state": lambda s: [E(der(s.x), -s.x), E(s.y, ac.sqrt(-s.x))],
    "matrix": lambda s: [E(sp.Matrix([s.x, s.y]), sp.Matrix([1, 2]))],
    "a huge power": lambda s: [E(der(s.x), s.x ** (10**6)), E(s.y, 1)],
    "a tower": lambda s: [E(der(s.x), s.x ** (s.x ** (s.x**1e300))), E(s.y, 1)],
    "an overflow": lambda s: [E(der(s.x), ac.exp(1e4 * s.x)), E(s.y, 1)],
    "a conjugate": lambda s: [E(der(s.x), sp.conjugate(s.x)), E(s.y, 1)],
    "a floor of a list": lambda s: [E(der(s.x), ac.floor([s.x])), E(s.y, 1)],
    "a dirac": lambda s: [E(der(s.x), sp.DiracDelta(s.x)), E(s.y, 1)],
}
PERHAPS = {
    "a negated comparison",
    "a comparison as value",
    "sympy's derivative",
    "a derivative of a sum",
    "equations of sympy",
    "an equation for the input",
    "1 = 2",
    "a gamma function",
    "a huge power",
    "a tower",
    "a conjugate",
    "a where of numbers",
    "a maximum of none",
    "a sum of sympy",
    "a derivative of the time",
    "a maximum of a list",
    "0 = 0",
}
"""Equations that a version of acausal may understand: only what comes of them counts."""


@change
def equations(rng: random.Random, doc: Document) -> Wrong:
    what = rng.choice(list(WRONG_EQUATIONS))

    def make() -> Any:
        made = built(doc)
        made.own = Own(WRONG_EQUATIONS[what])
        return ac.compile(made)

    return Wrong(make, f"equations: {what}", OWN_PLACES, what not in PERHAPS)


INITIAL: dict[str, Callable[[Any], Any]] = {
    "two values": lambda s: [E(s.x, 2), E(s.x, 3)],
    "not its start": lambda s: [E(s.x, 2)],
    "a text": lambda s: ["x = 1"],
    "none": lambda s: None,
    "a number": lambda s: 3,
    "an expression": lambda s: [s.x],
    "a stranger": lambda s: [E(s.x, tl.Mass(m=1.0).m)],
    "a symbol": lambda s: [E(s.x, sp.Symbol("q"))],
    "no solution": lambda s: [E(s.y**2, -1)],
    "nan": lambda s: [E(s.y, math.nan)],
    "1 = 2": lambda s: [E(1, 2)],
    "a log": lambda s: [E(ac.log(-1 - s.x**2), 1)],
    "an exception": lambda s: raises(RuntimeError("early")),
}


@change
def initial_equations(rng: random.Random, doc: Document) -> Wrong:
    what = rng.choice(list(INITIAL))

    def make() -> Any:
        made = built(doc)
        made.own = Own(rates, INITIAL[what])
        return ac.compile(made)

    return Wrong(make, f"initial equations: {what}", OWN_PLACES, True)


DECLARATIONS: dict[str, tuple[Callable[[], Any], bool]] = {
    "a text as default": (lambda: ac.Parameter("x"), True),
    "nan as default": (lambda: ac.Parameter(math.nan), True),
    "a list as default": (lambda: ac.Parameter([1, 2]), True),
    "an unknown unit": (lambda: ac.Parameter(1.0, unit="Nwton"), True),
    "a number as unit": (lambda: ac.Parameter(1.0, unit=3), True),
    "none as unit": (lambda: ac.Parameter(1.0, unit=None), True),
    "bounds exchanged": (lambda: ac.Parameter(1.0, min=2, max=0), True),
    "a default out of bounds": (lambda: ac.Parameter(-1.0, min=0), True),
    "a text as bound": (lambda: ac.Parameter(1.0, min="a"), True),
    "nan as bound": (lambda: ac.Parameter(1.0, min=math.nan), False),
    "a shape of texts": (lambda: ac.Parameter(1.0, shape="q"), True),
    "a negative shape": (lambda: ac.Parameter(1.0, shape=-1), True),
    "a fractional shape": (lambda: ac.Parameter(1.0, shape=1.5), True),
    "an unknown condition": (lambda: ac.Parameter(1.0, when="q"), True),
    "a number as condition": (lambda: ac.Parameter(1.0, when=3), True),
    "an unknown keyword": (lambda: ac.Parameter(1.0, uint="m"), True),
    "two defaults": (lambda: ac.Parameter(1.0, 2.0), True),
    "a start of text": (lambda: ac.Variable(start="q"), True),
    "a start of nan": (lambda: ac.Variable(start=math.nan), True),
    "a start of a list": (lambda: ac.Variable(start=[1, 2]), True),
    "fixed by a number": (lambda: ac.Variable(fixed=3), False),
    "fixed by a text": (lambda: ac.Variable(fixed="q"), True),
    "nominal zero": (lambda: ac.Variable(nominal=0.0), False),
    "nominal negative": (lambda: ac.Variable(nominal=-1.0), False),
    "nominal nan": (lambda: ac.Variable(nominal=math.nan), True),
    "nominal of a text": (lambda: ac.Variable(nominal="q"), True),
    "an unknown state": (lambda: ac.Variable(state="sometimes"), True),
    "a number as state": (lambda: ac.Variable(state=3), True),
    "an option outside its choices": (lambda: ac.Option(3, choices=(1, 2)), False),
    "a number as network": (lambda: ac.Module(3), True),
    "no network": (lambda: ac.Module(), True),
    "a network of a text": (lambda: ac.Module("q"), True),
    "a class": (lambda: ac.Parameter, False),
    "a complex default": (lambda: ac.Parameter(1j), True),
    "a default of a component": (lambda: ac.Parameter(tl.Mass(m=1.0)), True),
    "a default of a class": (lambda: ac.Parameter(float), True),
    "a unit of brackets": (lambda: ac.Variable(unit="((("), True),
    "a network that fails": (
        lambda: ac.Module(lambda key: raises(RuntimeError("no weights"))),
        False,
    ),
    "a start of infinity": (lambda: ac.Variable(start=math.inf), True),
    "a variable's shape of zero": (lambda: ac.Variable(shape=0), False),
    "a start of a complex": (lambda: ac.Variable(start=1j), True),
    "a unit of a variable 3": (lambda: ac.Variable(unit=3), True),
}


@change
def declarations(rng: random.Random, doc: Document) -> Wrong:
    what = rng.choice(list(DECLARATIONS))
    made, certain = DECLARATIONS[what]

    def make() -> Any:
        declared = made()

        def stated(s: Any) -> list[Any]:
            used = (
                [E(s.q, 1)] if isinstance(declared, ac.Variable) and declared.shape is None else []
            )
            value = s.q if isinstance(declared, ac.Parameter) and declared.shape is None else 1
            value = s.q(s.x) if isinstance(declared, ac.Module) else value
            return [E(der(s.x), value), E(s.y, 1), *used]

        cls = type("Own", (Own,), {"q": declared})
        whole = built(doc)
        whole.own = cls(stated)
        return ac.compile(whole)

    return Wrong(make, f"declared: {what}", (*OWN_PLACES, "q", "Parameter", "Variable"), certain)


NEURAL: dict[str, tuple[Callable[[], Any], bool]] = {
    "width zero": (lambda: neural.Compliance(width=0), True),
    "width negative": (lambda: neural.Compliance(width=-3), True),
    "width of text": (lambda: neural.Compliance(width="wide"), True),
    "width fractional": (lambda: neural.Compliance(width=1.5), True),
    "depth negative": (lambda: neural.Compliance(depth=-1), True),
    "an unknown activation": (lambda: neural.Compliance(activation="relux"), True),
    "a scale of zero": (lambda: neural.Compliance(input_scale=0.0), True),
    "a scale of nan": (lambda: neural.Compliance(output_scale=math.nan), True),
    "a scale of text": (lambda: neural.Compliance(input_scale="x"), True),
    "an unknown crossing": (lambda: neural.Compliance(zero_crossing="q"), True),
    "a number as connector": (lambda: neural.Compliance(3), True),
    "a component as connector": (lambda: neural.Resistance(tl.Mass), True),
    "an instance as connector": (lambda: neural.Resistance(tl.Flange()), True),
    "limits exchanged": (
        lambda: neural.Compliance(limits=(1.0, -1.0), extrapolation="linear"),
        True,
    ),
    "limits of text": (lambda: neural.Compliance(limits="x", extrapolation="linear"), True),
    "an unknown extrapolation": (lambda: neural.Compliance(extrapolation="q"), True),
    "a floor without a promise": (lambda: neural.Resistance(floor=1.0), False),
    "a negative floor": (lambda: neural.Compliance(monotone=True, floor=-1.0), True),
    "a floor of nan": (lambda: neural.Compliance(monotone=True, floor=math.nan), True),
    "promises of another": (lambda: neural.Resistance(convex=True), True),
    "passive with a network": (
        lambda: neural.Compliance(passive=True, net=lambda key: jnp.tanh),
        True,
    ),
    "scales of two": (lambda: neural.Compliance(input_scale=[1.0, 2.0]), True),
    "a secondary of none": (lambda: neural.Compliance(secondary=None), True),
    "a negative secondary": (lambda: neural.Resistance(secondary=-1), True),
    "a network of two results": (
        lambda: neural.Compliance(net=lambda key: lambda x: jnp.stack([x, x])),
        True,
    ),
    "a network of two arguments": (lambda: neural.Compliance(net=lambda key: lambda x, y: x), True),
    "a network that raises": (
        lambda: neural.Compliance(net=lambda key: lambda x: raises(RuntimeError("within"))),
        True,
    ),
    "a network of nan": (lambda: neural.Compliance(net=lambda key: lambda x: x * jnp.nan), True),
    "a network of numpy": (
        lambda: neural.Compliance(net=lambda key: lambda x: np.float64(math.tanh(x))),
        True,
    ),
    "a network of text": (lambda: neural.Compliance(net=lambda key: lambda x: "x"), True),
    "odd of text": (lambda: neural.Compliance(odd="yes"), True),
    "a network of complex": (lambda: neural.Compliance(net=lambda key: lambda x: x * 1j), True),
}


@change
def neural_options(rng: random.Random, doc: Document) -> Wrong:
    what = rng.choice(list(NEURAL))
    make_element, certain = NEURAL[what]

    def make() -> Any:
        made: Any = build(plain(SOUND["neural"]), SOUND["neural"]["connections"])
        made.extra = make_element()
        made.connect(made.wall.flange, made.extra.flange_a)
        made.connect(made.mass.flange_a, made.extra.flange_b)
        return ac.compile(made)

    return Wrong(
        make,
        f"a neural element: {what}",
        ("extra", "Compliance", "Resistance", "'net'", "secondary"),
        certain,
    )


def mutant(seed: int) -> Mutant:
    """The wrong Python model of a seed."""
    rng = random.Random(f"model {seed}")
    kind = WEIGHTED[seed % len(WEIGHTED)]
    domain = rng.choice(list(SOUND))
    wrong = CHANGES[kind](rng, copy.deepcopy(SOUND[domain]))
    return Mutant(seed, domain, kind, wrong.detail, wrong.places, wrong.certain, wrong.make)


WEIGHTED = [
    *CHANGES,
    "equations",
    "equations",
    "equations",
    "declarations",
    "another_class_of_the_domain",
    "odd_value",
    "value_of_another_kind",
    "neural_options",
    "extra_connection",
]
"""The kinds, those of many variants more than once."""
