"""Wrong netlists: a sound document, wrongly changed in one place (or in two)."""

from __future__ import annotations

import copy
import json
import random
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import acausal as ac

from .outcome import Mutant
from .sound import PREFIX, SOUND, Document

NUMBERS: tuple[Any, ...] = (
    0,
    -1,
    0.5,
    1e-300,
    5e-324,
    1e300,
    1.7e308,
    -1e308,
    1e-12,
    -1e-12,
    2**63,
    10**30,
    1e16,
    -273.15,
    1e6,
)
MISFITS: tuple[Any, ...] = (
    None,
    True,
    False,
    [],
    {},
    [[]],
    [1, [2]],
    {"a": 1},
    {"=": []},
    {"=": {"=": 1}},
    [None],
    {"start": {}},
    {"fixed": "yes"},
    {"start": "abc", "fixed": True},
    [[1.0, 2.0], [3.0]],
    {"class": "x"},
    {"": 1},
)
BAD_EXPRESSIONS = (
    "",
    " ",
    "(",
    ")",
    "1 +",
    "* 2",
    "1 2",
    "2**",
    "a b",
    "'",
    '"',
    '"text',
    "{1,",
    "[1;",
    "if 1 then 2",
    "if true then 1",
    "nothing",
    "nothing.at.all",
    "f(",
    "sin(1, 2)",
    "sin()",
    "import os",
    "__import__('os')",
    "().__class__",
    "lambda: 1",
    "1/0",
    "0/0",
    "1/(1 - 1)",
    "log(0)",
    "log(-1)",
    "sqrt(-1)",
    "asin(2)",
    "0^(-1)",
    "9^9^9^9^9",
    "1e400",
    "1e-400 +",
    "exp(1000)",
    "10^400",
    "(-8)^(1/3)",
    "time",
    "der(1)",
    "1 = 1",
    "x := 1",
    "Modelica.Constants.nothing",
    "Types.Init.Nothing",
    "Media.Nothing()",
    "\u2212 1",
    "1\u00a0+",
    "\x00",
    "1;2",
    "a[1]",
    "1 < 2 < 3",
    "not 1",
    "true + 1",
    "{1, 2} + 1",
    "[1, 2; 3]",
    "max({})",
    "1e",
    "0x10",
    "1_000",
    "..1",
    "size(1)",
    "fill(0, 1e9)",
    "ones(1e9)",
    "1 //",
    "%",
    "$x",
    "\\",
    "\U0001f600",
    "noEvent(",
    "pre(1)",
    "sample(0, 1)",
)
BAD_NAMES = (
    "",
    " ",
    "a b",
    "1a",
    "a.b",
    "a-b",
    "connect",
    "modify",
    "equations",
    "__init__",
    "__class__",
    "_x",
    "a[0]",
    "a[7]",
    "a[-1]",
    "a[1][1]",
    "caf\u00e9",
    "\u03a9",
    "a\nb",
    "self",
    "a" * 5000,
    "[1]",
    "a[1",
    "a[1.5]",
    "a[99999999]",
    "\x00",
)
BAD_CLASSES: tuple[Any, ...] = (
    None,
    3,
    True,
    [],
    {},
    "",
    " ",
    ".",
    "..",
    "Modelica",
    "Modelica.Mechanics",
    "os.system",
    "builtins.eval",
    "acausal.System",
    "acausal.compile",
    "acausal.components.translational",
    "acausal.components.translational.ac",
    "acausal.components.translational.Flange_",
    "acausal.components.laws",
    "acausal.components.os.path",
    "acausal.components.electrical.interfaces.__builtins__",
    "subprocess.Popen",
    "tests.fuzz.sound.Built",
    "acausal.components.translational.Mass.__init__",
    "Modelica.Electrical.Analog.Lines.TLine2",
    "a" * 3000,
    "Modelica.Blocks.Logical.Nothing",
    "acausal.components.blocks.Sum.nin",
    "\u00e9t\u00e9.Mass",
)
BAD_UNITS: tuple[Any, ...] = (
    "Nwton",
    "N/",
    "/m",
    "m^",
    "kg m",
    3,
    None,
    [],
    "\u00b5\u00b5",
    "m.m.",
    "1/0",
    "(" * 50,
    "N*m*",
)
BAD_EQUATIONS: tuple[Any, ...] = (
    "",
    "=",
    "1 = 1",
    "1 = 2",
    "nothing = 1",
    "der() = 0",
    "der(1) = 0",
    "der(der(nothing)) = 0",
    3,
    None,
    [],
    {},
    "1",
    "a = b = c",
    "sqrt(-1) = 0",
    "1/0 = 1",
    "time = 1",
    "= 0",
    "der(x",
    "'x' = 1",
    True,
    "0 = 0",
    "\U0001f600 = 1",
)
JUNK = (
    "",
    " ",
    "null",
    "3",
    "[]",
    '"text"',
    "{",
    "}",
    "{]",
    "[1,2",
    "\x00",
    "{'a': 1}",
    "NaN",
    "{} {}",
    "\ufeff{}",
    "//x\n{}",
)


@dataclass(frozen=True)
class Wrong:
    """A changed document (or text), what was done, of which names a message must hold one, and whether it is wrong."""

    content: Any
    detail: str
    places: tuple[str, ...]
    certain: bool


Change = Callable[[random.Random, Document], Wrong]
CHANGES: dict[str, Change] = {}


def change(function: Change) -> Change:
    """Register a kind of change."""
    CHANGES[function.__name__] = function
    return function


# -- picking -----------------------------------------------------------------------------------------


def names(doc: Document) -> tuple[str, ...]:
    """All parts and parameters: a structural fault may show at any of them."""
    return (*doc["components"], *doc["parameters"], "connections[", "the model")


def pick_part(rng: random.Random, doc: Document) -> str:
    return rng.choice(sorted(doc["components"]))


def pick_modifier(rng: random.Random, doc: Document) -> tuple[str, str]:
    """A part and one of its modifiers."""
    pairs = [(n, k) for n, p in doc["components"].items() for k in p["with"]]
    return rng.choice(pairs)


def misspelt(rng: random.Random, name: str) -> str:
    """A name with a letter lost, doubled, exchanged, or in the other case."""
    i = rng.randrange(len(name))
    options = [
        name[:i] + name[i + 1 :],
        name[:i] + name[i] + name[i:],
        name[:i] + "q" + name[i + 1 :],
        name + "_",
    ]
    return rng.choice([o for o in options if o != name])


def set_modifier(rng: random.Random, doc: Document, value: Any, certain: bool) -> Wrong:
    name, key = pick_modifier(rng, doc)
    doc["components"][name]["with"][key] = value
    return Wrong(doc, f"{name}.{key} = {value!r:.80}", (name,), certain)


# -- values ------------------------------------------------------------------------------------------


@change
def number(rng: random.Random, doc: Document) -> Wrong:
    """Odd, but perhaps legitimate; what follows may be wrong anywhere."""
    name, key = pick_modifier(rng, doc)
    value = rng.choice(NUMBERS)
    doc["components"][name]["with"][key] = value
    return Wrong(doc, f"{name}.{key} = {value!r}", names(doc), False)


@change
def not_a_number(rng: random.Random, doc: Document) -> Wrong:
    return set_modifier(
        rng, doc, rng.choice([float("nan"), float("inf"), float("-inf"), 10**400, 10**4000]), True
    )


@change
def misfit(rng: random.Random, doc: Document) -> Wrong:
    """A value of another kind; a truth value fits an option, ``null`` and ``{}`` leave a default."""
    name, key = pick_modifier(rng, doc)
    value = rng.choice(MISFITS)
    certain = value not in (None, True, False, {}, [])
    doc["components"][name]["with"][key] = value
    return Wrong(doc, f"{name}.{key} = {value!r}", (name,), certain)


@change
def size(rng: random.Random, doc: Document) -> Wrong:
    """Sizes that no model has."""
    where = [
        (n, k)
        for n, p in doc["components"].items()
        for k in p["with"]
        if k in ("n", "nin", "width", "depth")
    ]
    value = rng.choice([-1, 0, 1.5, 10**9, 1e9, "2", "n", True, None, 10**6, -(10**9), [2], 1e300])
    if not where:
        part = {
            "class": PREFIX
            + rng.choice(("blocks.Replicator", "blocks.MultiSum", "blocks.LowpassButterworth"))
        }
        key = {"r": "nout", "m": "nu", "l": "n"}[part["class"].split(".")[-1][0].lower()]
        doc["components"]["extra"] = {
            **part,
            "with": {key: value, **({"f": 1.0} if key == "n" else {})},
        }
        return Wrong(doc, f"{part['class']}({key}={value})", (*names(doc), "extra"), False)
    name, key = rng.choice(where)
    doc["components"][name]["with"][key] = value
    return Wrong(doc, f"{name}.{key} = {value!r}", names(doc), False)


@change
def expression(rng: random.Random, doc: Document) -> Wrong:
    return set_modifier(rng, doc, rng.choice(BAD_EXPRESSIONS), False)


@change
def parameter_expression(rng: random.Random, doc: Document) -> Wrong:
    name, text = rng.choice(sorted(doc["parameters"])), rng.choice(BAD_EXPRESSIONS)
    doc["parameters"][name] = text
    return Wrong(doc, f"parameter {name} = {text!r}", names(doc), False)


@change
def long_expression(rng: random.Random, doc: Document) -> Wrong:
    """Deep or long, some of them beyond any limit."""
    n = rng.choice([30, 300, 3000, 30000])
    text = rng.choice(
        [
            "(" * n + "1" + ")" * n,
            "-" * n + "1",
            "+".join(["1"] * n),
            "sin(" * n + "1" + ")" * n,
            "2^" * n + "1",
            "{" * n + "1" + "}" * n,
            "if true then 1 else " * n + "1",
            "not " * n + "true",
            "1" * n,
        ]
    )
    name, key = pick_modifier(rng, doc)
    doc["components"][name]["with"][key] = text
    return Wrong(doc, f"{name}.{key} = {text:.30}... ({len(text)})", names(doc), False)


@change
def unknown_name(rng: random.Random, doc: Document) -> Wrong:
    inner = rng.choice(
        ["qqq", "qqq.x", "2*qqq", "sin(qqq)", "wall_.flange", f"{pick_part(rng, doc)}.qqq"]
    )
    return set_modifier(rng, doc, inner, True)


@change
def circle(rng: random.Random, doc: Document) -> Wrong:
    """Parameters that are given by each other."""
    n = rng.choice([1, 2, 3, 50])
    for i in range(n):
        doc["parameters"][f"p{i}"] = f"2*p{(i + 1) % n} + 1"
    return Wrong(doc, f"a circle of {n} parameters", ("p0", "p1"), True)


@change
def circle_of_parts(rng: random.Random, doc: Document) -> Wrong:
    pairs = [
        (n, k)
        for n, p in doc["components"].items()
        for k, v in p["with"].items()
        if isinstance(v, float)
    ]
    (a, x), (b, y) = rng.choice(pairs), rng.choice(pairs)
    doc["components"][a]["with"][x] = f"2*{b}.{y}"
    doc["components"][b]["with"][y] = f"{a}.{x} + 1"
    return Wrong(doc, f"{a}.{x} and {b}.{y} in a circle", (a, b), (a, x) != (b, y))


@change
def bound_to_a_variable(rng: random.Random, doc: Document) -> Wrong:
    variables = {
        "translational": "mass.s",
        "rotational": "motor.w",
        "electrical": "coil.i",
        "diodes": "diode.v",
        "thermal": "plate.T",
        "fluid": "pipe.T",
        "hydraulic": "upper.level",
        "magnetic": "coil.i",
        "blocks": "plant.y",
        "neural": "mass.v",
        "motor": "rotor.w",
    }
    here = {v for v in variables.values() if v.split(".")[0] in doc["components"]}
    return set_modifier(rng, doc, rng.choice(sorted(here)), False)


@change
def wrong_unit(rng: random.Random, doc: Document) -> Wrong:
    name = rng.choice(sorted(doc["parameters"]))
    unit = rng.choice(BAD_UNITS)
    doc["parameters"][name] = {"=": 1.0, "unit": unit}
    return Wrong(doc, f"parameter {name} in {unit!r}", names(doc), unit not in (None, "1/0"))


@change
def another_unit(rng: random.Random, doc: Document) -> Wrong:
    """A unit that exists, mostly not the one that is needed."""
    name = rng.choice(sorted(doc["parameters"]))
    unit = rng.choice(
        ["N", "kg", "V/A", "K", "m/s2", "Pa.s", "rad", "1", "degC", "bar", "%", "mol", "cd"]
    )
    doc["parameters"][name] = {"=": 1.0, "unit": unit}
    return Wrong(doc, f"parameter {name} in {unit!r}", names(doc), False)


@change
def parameter_attributes(rng: random.Random, doc: Document) -> Wrong:
    name = rng.choice(sorted(doc["parameters"]))
    entry = rng.choice(
        [
            {"=": 1.0, "uint": "m"},
            {"fixed": False},
            {"fixed": "no"},
            {"=": None},
            {"min": 5, "=": 1.0},
            {"max": "x", "=": 1},
            {"=": 1, "min": 3, "max": 2},
            {"start": []},
            {"=": 1.0, "": 2},
            [],
            {},
            {"fixed": False, "start": "nothing"},
            {"=": "nothing"},
            None,
            True,
            "",
            {"=": {}},
        ]
    )
    doc["parameters"][name] = entry
    return Wrong(doc, f"parameter {name} = {entry!r}", names(doc), False)


@change
def variable_attributes(rng: random.Random, doc: Document) -> Wrong:
    pairs = [
        (n, k)
        for n, p in doc["components"].items()
        for k, v in p["with"].items()
        if isinstance(v, dict)
    ]
    entry, certain = rng.choice(
        [
            ({"strat": 1.0}, True),
            ({"start": []}, True),
            ({"start": "nothing"}, True),
            ({"fixed": 1}, True),
            ({"nominal": 0}, False),
            ({"nominal": -1.0}, False),
            ({"start": 1e308, "fixed": True}, False),
            ({"start": 10**400, "fixed": True}, True),
            ({"min": "a"}, False),
            ({"stateSelect": "often"}, True),
            ("x", True),
            ({"start": None, "fixed": True}, False),
            ({"start": True}, True),
            ([1.0, 2.0], True),
            ({"unit": "q"}, False),  # changes no result; a file's units of variables are not read
            ({"=": 1.0, "start": 2.0}, False),
            ({"start": {"start": 1}}, True),
            ({"fixed": None}, False),
            ({"stateSelect": 3}, True),
        ]
    )
    if not pairs:
        return variable_value(rng, doc)
    name, key = rng.choice(pairs)
    doc["components"][name]["with"][key] = entry
    return Wrong(doc, f"{name}.{key} = {entry!r}", names(doc), certain)


@change
def variable_value(rng: random.Random, doc: Document) -> Wrong:
    """One equation too many."""
    name = pick_part(rng, doc)
    inner = rng.choice(
        [
            "s",
            "v",
            "f",
            "i",
            "T",
            "phi",
            "tau",
            "y",
            "u",
            "p",
            "port",
            "flange_a",
            "level",
            "Q_flow",
        ]
    )
    value = rng.choice([1.0, "time", f"{name}.{inner}", "1/time", {"=": 1.0}])
    doc["components"][name]["with"][inner] = value
    return Wrong(doc, f"{name}.{inner} = {value!r}", names(doc), False)


# -- names and classes -------------------------------------------------------------------------------


@change
def misspelt_class(rng: random.Random, doc: Document) -> Wrong:
    name = pick_part(rng, doc)
    entry = doc["components"][name]
    entry["class"] = misspelt(rng, entry["class"])
    return Wrong(doc, f"{name} of class {entry['class']}", (name,), True)


@change
def bad_class(rng: random.Random, doc: Document) -> Wrong:
    name, cls = pick_part(rng, doc), rng.choice(BAD_CLASSES)
    doc["components"][name]["class"] = cls
    return Wrong(doc, f"{name} of class {cls!r:.80}", (name,), True)


@change
def another_class(rng: random.Random, doc: Document) -> Wrong:
    """A class of any domain, with the modifiers and connections of the one before, or without its modifiers."""
    name = pick_part(rng, doc)
    other = SOUND[rng.choice(sorted(SOUND))]["components"]
    cls = other[rng.choice(sorted(other))]["class"]
    doc["components"][name]["class"] = cls
    if rng.random() < 0.5:
        doc["components"][name]["with"] = {}
    return Wrong(doc, f"{name} of class {cls}", names(doc), False)


@change
def misspelt_modifier(rng: random.Random, doc: Document) -> Wrong:
    name, key = pick_modifier(rng, doc)
    given = doc["components"][name]["with"]
    wrong = misspelt(rng, key)
    given[wrong] = given.pop(key)
    # A name with one letter more or less may be another of the class's own.
    return Wrong(doc, f"{name}.{wrong} for {key}", (name,), len(key) > 2)


@change
def modifier_of_a_part(rng: random.Random, doc: Document) -> Wrong:
    name = pick_part(rng, doc)
    key = rng.choice(
        [
            "equations",
            "connect",
            "__init__",
            "_node",
            "modify",
            "a.b",
            "",
            "x[1]",
            "qqq",
            "flange.s",
            "self",
        ]
    )
    doc["components"][name]["with"][key] = rng.choice([1.0, {"start": 1.0}, {"x": {"y": {"z": 1}}}])
    return Wrong(doc, f"{name}.{key}", (name,), True)


@change
def bad_name(rng: random.Random, doc: Document) -> Wrong:
    section, name = rng.choice(["components", "parameters"]), rng.choice(BAD_NAMES)
    value = doc[section][rng.choice(sorted(doc[section]))]
    doc[section][name] = copy.deepcopy(value)
    return Wrong(doc, f"{section}: {name!r:.60}", (name[:40], repr(name)[1:40], section), False)


@change
def renamed(rng: random.Random, doc: Document) -> Wrong:
    """A part under another name, so that its connections lead nowhere."""
    used = [
        n
        for n in sorted(doc["components"])
        if any(e.split(".")[0] == n for c in doc["connections"] for e in c)
    ]
    name = rng.choice(used)
    doc["components"][name + "x"] = doc["components"].pop(name)
    return Wrong(doc, f"{name} renamed", (name,), True)


@change
def dropped(rng: random.Random, doc: Document) -> Wrong:
    used = [
        n
        for n in sorted(doc["components"])
        if any(e.split(".")[0] == n for c in doc["connections"] for e in c)
    ]
    name = rng.choice(used)
    del doc["components"][name]
    return Wrong(doc, f"without {name}", (name,), True)


@change
def dropped_with_connections(rng: random.Random, doc: Document) -> Wrong:
    """A part taken out whole: a ground, a source, a storage."""
    name = pick_part(rng, doc)
    del doc["components"][name]
    doc["connections"] = [c for c in doc["connections"] if all(e.split(".")[0] != name for e in c)]
    return Wrong(doc, f"without {name} and its connections", names(doc), False)


@change
def twice(rng: random.Random, doc: Document) -> Wrong:
    """A part doubled, with its connections: two sources in parallel, two masses in one place."""
    name = pick_part(rng, doc)
    doc["components"]["twin"] = copy.deepcopy(doc["components"][name])
    for ends in list(doc["connections"]):
        doc["connections"].append(
            [e if e.split(".")[0] != name else "twin." + e.split(".", 1)[1] for e in ends]
        )
    return Wrong(doc, f"{name} doubled", names(doc), False)


@change
def parameter_like_a_part(rng: random.Random, doc: Document) -> Wrong:
    name = pick_part(rng, doc)
    doc["parameters"][name] = 1.0
    return Wrong(doc, f"a parameter {name}", (name,), True)


# -- keys and sections -------------------------------------------------------------------------------


@change
def missing_key(rng: random.Random, doc: Document) -> Wrong:
    if rng.random() < 0.5:
        section = rng.choice(sorted(doc))
        del doc[section]
        return Wrong(
            doc,
            f"without {section}",
            ("components", "connections", "parameters", "the model", *SOUND_NAMES),
            False,
        )
    name = pick_part(rng, doc)
    key = rng.choice(["class", "with"])
    del doc["components"][name][key]
    return Wrong(doc, f"{name} without {key}", names(doc), key == "class")


@change
def extra_key(rng: random.Random, doc: Document) -> Wrong:
    key = rng.choice(
        ["conections", "", "Components", "equations", "__class__", "classes", "x" * 1000]
    )
    if rng.random() < 0.5:
        doc[key] = rng.choice([[], {}, 1, None])
        return Wrong(doc, f"a section {key:.20}", ("unknown key", key[:20] or "''"), True)
    name = pick_part(rng, doc)
    doc["components"][name][key] = 1
    return Wrong(doc, f"{name} with {key:.20}", (name,), True)


@change
def wrong_section(rng: random.Random, doc: Document) -> Wrong:
    section = rng.choice(
        ["components", "connections", "parameters", "initial_equations", "connectors", "model"]
    )
    value = rng.choice([3, "text", True, [[]], [3], {"a": 3}, {"": {}}, [{}], None, [None], 1.5])
    places = (section, *names(doc))
    doc[section] = value
    return Wrong(doc, f"{section} = {value!r}", places, False)


@change
def wrong_part(rng: random.Random, doc: Document) -> Wrong:
    name = pick_part(rng, doc)
    value = rng.choice(
        [
            3,
            "text",
            [],
            None,
            True,
            {"components": 3},
            {"components": {}, "class": "x"},
            {"with": []},
            {},
        ]
    )
    doc["components"][name] = value
    return Wrong(doc, f"{name} = {value!r}", (name,), True)


@change
def wrong_with(rng: random.Random, doc: Document) -> Wrong:
    name, value = pick_part(rng, doc), rng.choice([3, "text", [], True, [1], "m=1"])
    doc["components"][name]["with"] = value
    return Wrong(doc, f"{name} with {value!r}", (name,), True)


# -- connections -------------------------------------------------------------------------------------


def reconnected(
    rng: random.Random, doc: Document, new: Callable[[list[str]], Any], certain: bool, what: str
) -> Wrong:
    i = rng.randrange(len(doc["connections"]))
    doc["connections"][i] = new(list(doc["connections"][i]))
    return Wrong(
        doc,
        f"{what}: {doc['connections'][i]!r:.100}",
        names(doc) if not certain else (f"connections[{i}]",),
        certain,
    )


@change
def misspelt_end(rng: random.Random, doc: Document) -> Wrong:
    side = rng.randrange(2)

    def new(ends: list[str]) -> list[str]:
        part, _, end = ends[side].partition(".")
        ends[side] = f"{part}.{misspelt(rng, end)}" if rng.random() < 0.5 else f"{part}qq.{end}"
        return ends

    # p and n, one letter each, may be misspelt into each other's place only by exchange, never by these changes
    return reconnected(rng, doc, new, True, "a misspelt end")


@change
def bad_pair(rng: random.Random, doc: Document) -> Wrong:
    pairs: list[Callable[[list[str]], Any]] = [
        lambda e: e[:1],
        lambda e: [],
        lambda e: [e[0], 3],
        lambda e: [e[0], None],
        lambda e: e[0],
        lambda e: {e[0]: e[1]},
        lambda e: [e],
        lambda e: [e[0], [e[1]]],
        lambda e: [e[0], e[0]],
        lambda e: [e[0], ""],
        lambda e: [e[0], "."],
        lambda e: [e[0], ".."],
        lambda e: [e[0], " " + e[1] + " x"],
        lambda e: 3,
        lambda e: None,
        lambda e: [e[0], e[1] + "[1]"],
        lambda e: [e[0], e[1] + "[0]"],
        lambda e: [e[0], e[1] + "."],
        lambda e: [e[0], "a" * 5000],
        lambda e: [e[0], e[1].split(".")[0]],
        lambda e: [e[0], e[1] + ".x.y.z"],
        lambda e: [e[0], e[1] + "[-1]"],
        lambda e: [e[0], e[1] + "[1"],
        lambda e: [e[0], "__class__"],
        lambda e: [e[0], e[1].split(".")[0] + ".__init__"],
        lambda e: [e[0], e[1].split(".")[0] + "._node"],
        lambda e: [e[0], e[1].split(".")[0] + ".equations"],
        lambda e: [e[0], True],
    ]
    return reconnected(rng, doc, rng.choice(pairs), True, "a bad pair")


@change
def missing_connection(rng: random.Random, doc: Document) -> Wrong:
    gone = doc["connections"].pop(rng.randrange(len(doc["connections"])))
    return Wrong(doc, f"without {gone}", names(doc), False)


@change
def extra_connection(rng: random.Random, doc: Document) -> Wrong:
    """Any two ends of the model: a short circuit, a second source, unlike domains; or sound."""
    ends = sorted({e for c in doc["connections"] for e in c})
    doc["connections"].append(rng.sample(ends, 2))
    return Wrong(doc, f"also {doc['connections'][-1]}", names(doc), False)


@change
def shuffled_ends(rng: random.Random, doc: Document) -> Wrong:
    """Two connections exchange an end."""
    i, j = rng.sample(range(len(doc["connections"])), 2)
    a, b = doc["connections"][i], doc["connections"][j]
    a[1], b[1] = b[1], a[1]
    return Wrong(doc, f"{a} and {b}", names(doc), False)


@change
def unlike(rng: random.Random, doc: Document) -> Wrong:
    """A connector of another domain."""
    heat = any(p["class"].startswith(PREFIX + "thermal") for p in doc["components"].values())
    doc["components"]["stranger"] = (
        {"class": f"{PREFIX}translational.Mass", "with": {"m": 1.0}}
        if heat or "blocks" in doc
        else {"class": f"{PREFIX}thermal.HeatCapacitor", "with": {"C": 1.0}}
    )
    end = "stranger.flange_a" if heat or "blocks" in doc else "stranger.port"
    i = rng.randrange(len(doc["connections"]))
    doc["connections"].append([doc["connections"][i][0], end])
    number_of = f"connections[{len(doc['connections']) - 1}]"
    if end == "stranger.flange_a" and doc["connections"][i][0].endswith(
        (".flange", "flange_a", "flange_b")
    ):
        return Wrong(doc, f"also {doc['connections'][-1]}", names(doc), False)
    return Wrong(doc, f"also {doc['connections'][-1]}", (number_of,), True)


# -- initial equations -------------------------------------------------------------------------------


@change
def initial_equation(rng: random.Random, doc: Document) -> Wrong:
    text = rng.choice(BAD_EQUATIONS)
    doc["initial_equations"] = [text]
    return Wrong(
        doc,
        f"initially {text!r}",
        ("initial_equations[0]", *names(doc)),
        text not in ("1 = 1", "0 = 0"),
    )


@change
def contradiction(rng: random.Random, doc: Document) -> Wrong:
    """A state that is fixed twice, at different values."""
    fixed = [
        f"{n}.{k}"
        for n, p in doc["components"].items()
        for k, v in p["with"].items()
        if isinstance(v, dict) and v.get("fixed")
    ]
    if not fixed:
        return initial_equation(rng, doc)
    name = rng.choice(fixed)
    doc["initial_equations"] = [f"{name} = 12.5"]
    return Wrong(doc, f"initially {name} = 12.5, besides its start", names(doc), True)


# -- nesting -----------------------------------------------------------------------------------------


@change
def nested(rng: random.Random, doc: Document) -> Wrong:
    """Subsystems in subsystems; beyond the limit they are refused."""
    depth = rng.choice([1, 5, 20, 60, 200])
    for _ in range(depth):
        doc = {"components": {"inner": doc}}
    return Wrong(
        doc, f"{depth} subsystems within each other", (*SOUND_NAMES, "nested", "deep"), False
    )


@change
def nested_values(rng: random.Random, doc: Document) -> Wrong:
    depth = rng.choice([10, 50, 99, 1000, 100_000])
    kind = rng.choices("[{", (0.7, 0.3), k=depth)
    deep = (
        "".join("[" if k == "[" else '{"x":' for k in kind)
        + "1"
        + "".join("]" if k == "[" else "}" for k in reversed(kind))
    )
    name, key = pick_modifier(rng, doc)
    doc["components"][name]["with"][key] = "@deep"
    return Wrong(
        json.dumps(doc).replace('"@deep"', deep),
        f"{name}.{key}: {depth} deep",
        (name, "nested"),
        True,
    )


@change
def sub_model(rng: random.Random, doc: Document) -> Wrong:
    """A sound model as a subsystem, wrongly connected or modified from outside."""
    name = pick_part(rng, doc)
    outer: Document = {
        "components": {
            "inner": doc,
            "probe": {"class": f"{PREFIX}translational.Mass", "with": {"m": 1.0}},
        }
    }
    what = rng.randrange(4)
    if what == 0:
        outer["connections"] = [[f"inner.{name}", "probe.flange_a"]]
    elif what == 1:
        outer["connections"] = [["inner", "probe.flange_a"]]
    elif what == 2:
        doc["with"] = {name: {"qqq": 1.0}}
    else:
        doc["connectors"] = {"out": {"class": f"{PREFIX}translational.Mass"}}
        outer["connections"] = [["inner.out", "probe.flange_a"]]
    return Wrong(outer, f"a subsystem, wrongly used ({what})", ("inner",), True)


# -- the file ----------------------------------------------------------------------------------------


@change
def truncated(rng: random.Random, doc: Document) -> Wrong:
    text = json.dumps(doc, indent=1)
    return Wrong(text[: rng.randrange(len(text) - 1)], "a truncated file", ("line ",), True)


@change
def junk(rng: random.Random, doc: Document) -> Wrong:
    text = rng.choice(JUNK)
    return Wrong(
        text,
        f"a file of {text!r}",
        ("line ", "an object", "finite", "netlist.json", "the model"),
        False,
    )


@change
def another_character(rng: random.Random, doc: Document) -> Wrong:
    """One character replaced; most are noticed, some change a name in both places."""
    text = json.dumps(doc, indent=1)
    for _ in range(rng.choice([1, 3, 10])):
        i = rng.randrange(len(text))
        text = text[:i] + rng.choice("{}[],:\"'aZ0 -.\n\\\u00e9") + text[i + 1 :]
    return Wrong(
        text,
        "some characters replaced",
        ("line ", "key", "components", "connections", "parameters", *names(doc)),
        False,
    )


@change
def bytes_of_another_kind(rng: random.Random, doc: Document) -> Wrong:
    data = json.dumps(doc).encode(rng.choice(["utf-16", "utf-32", "utf-8"]))
    data = (
        bytes(rng.randrange(256) if rng.random() < 0.01 else b for b in data)
        if rng.random() < 0.5
        else b"\xff" + data
    )
    return Wrong(data, "not UTF-8", ("netlist.json", "line ", *names(doc)), False)


@change
def twice_a_key(rng: random.Random, doc: Document) -> Wrong:
    name = pick_part(rng, doc)
    text = json.dumps(doc).replace(f'"{name}": {{', f'"{name}": {{"class": "x"}}, "{name}": {{', 1)
    return Wrong(text, f"{name} twice", (name,), True)


@change
def two_changes(rng: random.Random, doc: Document) -> Wrong:
    simple = [c for c in CHANGES.values() if c.__name__ not in COMPOSED]
    first = rng.choice(simple)(rng, doc)
    second = rng.choice(simple)
    try:
        other = second(rng, first.content)
    except (
        KeyError,
        TypeError,
        AttributeError,
        IndexError,
        ValueError,
    ):  # the first left nothing to change
        return first
    places = (*first.places, *other.places, *SOUND_NAMES)
    return Wrong(
        other.content, f"{first.detail}; {other.detail}", places, first.certain and other.certain
    )


COMPOSED = (
    "two_changes",
    "nested_values",
    "truncated",
    "junk",
    "another_character",
    "bytes_of_another_kind",
    "twice_a_key",
    "nested",
    "sub_model",
)
SOUND_NAMES = tuple(dict.fromkeys(n for d in SOUND.values() for n in names(d)))
WEIGHTED = [
    *CHANGES,
    *("number", "expression", "parameter_expression", "another_class", "extra_connection", "size")
    * 2,
]
"""The kinds, those of many variants more than once."""


def mutant(seed: int, folder: Path) -> Mutant:
    """The wrong netlist of a seed."""
    rng = random.Random(f"netlist {seed}")
    kind = WEIGHTED[seed % len(WEIGHTED)]
    domain = rng.choice(list(SOUND))
    wrong = CHANGES[kind](rng, copy.deepcopy(SOUND[domain]))

    def make() -> Any:
        path = folder / "netlist.json"
        if isinstance(wrong.content, bytes):
            path.write_bytes(wrong.content)
        else:
            text = wrong.content if isinstance(wrong.content, str) else json.dumps(wrong.content)
            path.write_text(text, encoding="utf-8")
        return ac.compile(ac.load(path))

    return Mutant(seed, domain, kind, wrong.detail, wrong.places, wrong.certain, make)
