"""Random networks of physical components in several domains, for tests of the whole pipeline.

A `Network` is data: elements between numbered nodes. It shrinks well, and its `repr` is the model as one
would write it in a test.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from hypothesis import strategies as st

import acausal as ac
from acausal.components import electrical, neural, rotational, thermal, translational
from tests.support.parts import model

MODULES = {
    "tl": translational,
    "rot": rotational,
    "el": electrical,
    "th": thermal,
    "neural": neural,
}
FLOW = {"t": ("s", "f"), "r": ("phi", "tau"), "e": ("v", "i"), "h": ("T", "Q_flow")}
"""By domain the potential and the flow of its connectors."""
Read = Callable[..., Any]
"""From the name of a variable (and how often it is differentiated) or of a parameter to its value."""


@dataclass(frozen=True)
class Kind:
    """A class of components in a network.

    Attributes:
        module: where the class is; ``ends``: its connectors; ``where``: the domain of each, by first letter.
        values: parameters that are drawn; ``options``: what is set alike in all.
        power: what it stores per second and what it dissipates, together; None of a source.
        turned: the variables that change sign where its two ends are exchanged; None if it has a direction.
    """

    module: str
    ends: tuple[str, ...]
    where: str
    values: tuple[str, ...] = ()
    power: Callable[[Read], Any] | None = None
    turned: tuple[str, ...] | None = None
    options: dict[str, Any] = field(default_factory=dict)
    name: str = ""


def _lossless(_: Read) -> float:
    return 0.0


FLANGES, PINS, PORTS = ("flange_a", "flange_b"), ("p", "n"), ("port_a", "port_b")
FOUR = ("p1", "n1", "p2", "n2")

KINDS: dict[str, Kind] = {
    # translational
    "Mass": Kind("tl", FLANGES, "tt", ("m",), lambda g: g("m") * g("v") * g("a"), ()),
    "Bar": Kind("tl", FLANGES, "tt", ("m", "L"), lambda g: g("m") * g("v") * g("a"), name="Mass"),
    "Rod": Kind("tl", FLANGES, "tt", ("L",), _lossless),
    "Spring": Kind(
        "tl", FLANGES, "tt", ("c",), lambda g: g("c") * g("s_rel") * g("s_rel", 1), ("s_rel", "f")
    ),
    "Damper": Kind(
        "tl", FLANGES, "tt", ("d",), lambda g: g("d") * g("v_rel") ** 2, ("s_rel", "v_rel", "f")
    ),
    "SpringDamper": Kind(
        "tl",
        FLANGES,
        "tt",
        ("c", "d"),
        lambda g: (g("c") * g("s_rel") + g("d") * g("v_rel")) * g("v_rel"),
        ("s_rel", "v_rel", "f"),
    ),
    "Compliance": Kind("neural", FLANGES, "tt"),
    "Lever": Kind("tl", FLANGES, "tt", ("ratio",), _lossless, name="IdealGear"),
    "Fixed": Kind("tl", ("flange",), "t", ("s0",)),
    "Force": Kind("tl", ("flange",), "t"),
    "Force2": Kind("tl", FLANGES, "tt"),
    "Position": Kind("tl", ("flange",), "t", options={"exact": True}),
    "Speed": Kind("tl", ("flange",), "t", options={"exact": True}),
    "FilteredSpeed": Kind("tl", ("flange",), "t", ("f_crit",), name="Speed"),
    "Accelerate": Kind("tl", ("flange",), "t"),
    "SpeedSensor": Kind("tl", ("flange",), "t", (), _lossless),
    "ForceSensor": Kind("tl", FLANGES, "tt", (), _lossless),
    "RelSpeedSensor": Kind("tl", FLANGES, "tt", (), _lossless),
    # rotational
    "Inertia": Kind("rot", FLANGES, "rr", ("J",), lambda g: g("J") * g("w") * g("a"), ()),
    "RSpring": Kind(
        "rot",
        FLANGES,
        "rr",
        ("c",),
        lambda g: g("c") * g("phi_rel") * g("phi_rel", 1),
        ("phi_rel", "tau"),
        name="Spring",
    ),
    "RDamper": Kind(
        "rot",
        FLANGES,
        "rr",
        ("d",),
        lambda g: g("d") * g("w_rel") ** 2,
        ("phi_rel", "w_rel", "a_rel", "tau"),
        name="Damper",
    ),
    "RSpringDamper": Kind(
        "rot",
        FLANGES,
        "rr",
        ("c", "d"),
        lambda g: (g("c") * g("phi_rel") + g("d") * g("w_rel")) * g("w_rel"),
        ("phi_rel", "w_rel", "a_rel", "tau"),
        name="SpringDamper",
    ),
    "Disc": Kind("rot", FLANGES, "rr", ("deltaPhi",), _lossless),
    "IdealGear": Kind("rot", FLANGES, "rr", ("ratio",), _lossless),
    "SupportedGear": Kind(
        "rot",
        (*FLANGES, "support"),
        "rrr",
        ("ratio",),
        _lossless,
        options={"useSupport": True},
        name="IdealGear",
    ),
    "IdealPlanetary": Kind("rot", ("sun", "carrier", "ring"), "rrr", ("ratio",), _lossless),
    "RFixed": Kind("rot", ("flange",), "r", ("phi0",), name="Fixed"),
    "Torque": Kind("rot", ("flange",), "r"),
    "RSpeed": Kind("rot", ("flange",), "r", options={"exact": True}, name="Speed"),
    "RPosition": Kind("rot", ("flange",), "r", options={"exact": True}, name="Position"),
    "ConstantSpeed": Kind("rot", ("flange",), "r", ("w_fixed",)),
    "TorqueSensor": Kind("rot", FLANGES, "rr", (), _lossless),
    "IdealGearR2T": Kind("rot", ("flangeR", "flangeT"), "rt", ("ratio",), _lossless),
    # electrical
    "Resistor": Kind("el", PINS, "ee", ("R",), lambda g: g("R") * g("i") ** 2, ("v", "i")),
    "Conductor": Kind("el", PINS, "ee", ("G",), lambda g: g("G") * g("v") ** 2, ("v", "i")),
    "HotResistor": Kind(
        "el",
        (*PINS, "heatPort"),
        "eeh",
        ("R", "alpha"),
        _lossless,
        options={"useHeatPort": True},
        name="Resistor",
    ),
    "Capacitor": Kind("el", PINS, "ee", ("C",), lambda g: g("C") * g("v") * g("v", 1), ("v", "i")),
    "Inductor": Kind("el", PINS, "ee", ("L",), lambda g: g("L") * g("i") * g("i", 1), ("v", "i")),
    "Diode": Kind("el", PINS, "ee", ("R",), options={"Ids": 0.1, "Vt": 0.5}),
    "SaturatingInductor": Kind(
        "el",
        PINS,
        "ee",
        ("Inom",),
        lambda g: g("Psi", 1) * g("i"),
        ("v", "i", "Psi"),
        options={"Lnom": 1.5, "Lzer": 2.0, "Linf": 0.5},
    ),
    "Ground": Kind("el", ("p",), "e"),
    "ConstantVoltage": Kind("el", PINS, "ee", ("V",)),
    "ConstantCurrent": Kind("el", PINS, "ee", ("I",)),
    "SignalVoltage": Kind("el", PINS, "ee"),
    "SignalCurrent": Kind("el", PINS, "ee"),
    "Short": Kind("el", PINS, "ee", (), _lossless, ("v", "i")),
    "Idle": Kind("el", PINS, "ee", (), _lossless, ("v", "i")),
    "CurrentSensor": Kind("el", PINS, "ee", (), _lossless),
    "VoltageSensor": Kind("el", PINS, "ee", (), _lossless),
    "Gyrator": Kind("el", FOUR, "eeee", ("G1", "G2")),
    "IdealTransformer": Kind("el", FOUR, "eeee", ("n",), _lossless),
    "Transformer": Kind("el", FOUR, "eeee", ("M",), options={"L1": 5.0, "L2": 6.5}),
    "VCV": Kind("el", FOUR, "eeee", ("gain",)),
    "CCC": Kind("el", FOUR, "eeee", ("gain",)),
    "IdealOpAmp3Pin": Kind("el", ("in_p", "in_n", "out"), "eee"),
    "RotationalEMF": Kind("el", (*PINS, "flange"), "eer", ("k",), _lossless),
    "TranslationalEMF": Kind("el", (*PINS, "flange"), "eet", ("k",), _lossless),
    # thermal
    "HeatCapacitor": Kind("th", ("port",), "h", ("C",), lambda g: g("C") * g("der_T")),
    "ThermalConductor": Kind("th", PORTS, "hh", ("G",), _lossless, ("Q_flow", "dT")),
    "BodyRadiation": Kind(
        "th", PORTS, "hh", ("Gr",), _lossless, ("Q_flow", "dT"), options={"sigma": 0.1}
    ),
    "ThermalResistor": Kind("th", PORTS, "hh", ("R",), _lossless, ("Q_flow", "dT")),
    "FixedTemperature": Kind("th", ("port",), "h", ("T",)),
    "PrescribedTemperature": Kind("th", ("port",), "h"),
    "PrescribedHeatFlow": Kind("th", ("port",), "h"),
    "HeatFlowSensor": Kind("th", PORTS, "hh", (), _lossless),
}


@dataclass(frozen=True)
class Element:
    """A component, the nodes that its ends are joined to, and its parameters."""

    name: str
    kind: str
    nodes: tuple[int, ...]
    values: tuple[float, ...] = ()
    turned: bool = False

    @property
    def ends(self) -> tuple[str, ...]:
        """Its connectors, in the order of the nodes."""
        ends = KINDS[self.kind].ends
        return ends[::-1] if self.turned else ends

    @property
    def modifiers(self) -> dict[str, Any]:
        """Parameters and options."""
        kind = KINDS[self.kind]
        return {**dict(zip(kind.values, self.values, strict=True)), **kind.options}

    def make(self) -> ac.Component:
        """The component."""
        return self._class(**self.modifiers)

    @property
    def _class(self) -> Any:
        kind = KINDS[self.kind]
        return getattr(MODULES[kind.module], kind.name or self.kind)

    def __repr__(self) -> str:
        given = ", ".join(f"{k}={v!r}" for k, v in self.modifiers.items())
        return f"{self.name}={KINDS[self.kind].module}.{self._class.__name__}({given})"


@dataclass(frozen=True)
class Network:
    """Elements in order of declaration, and a seed for the order and direction of their connections."""

    elements: tuple[Element, ...]
    seed: int | None = None

    @property
    def joints(self) -> list[str]:
        """What is connected: ``"a.flange_b - b.flange_a"``; at every node a tree of connections."""
        nodes: dict[tuple[str, int], list[str]] = {}
        for element in sorted(self.elements, key=lambda e: e.name):
            where = KINDS[element.kind].where
            where = where[::-1] if element.turned else where
            for end, domain, node in zip(element.ends, where, element.nodes, strict=True):
                nodes.setdefault((domain, node), []).append(f"{element.name}.{end}")
        pairs = [(ends[0], other) for ends in nodes.values() for other in ends[1:]]
        if self.seed is not None:
            rng = random.Random(self.seed)
            pairs = []
            for ends in nodes.values():
                rng.shuffle(ends)
                pairs += [(ends[rng.randrange(i)], ends[i]) for i in range(1, len(ends))]
            rng.shuffle(pairs)
            pairs = [pair[:: rng.choice((1, -1))] for pair in pairs]
        return [" - ".join(pair) for pair in pairs]

    def make(self) -> ac.Component:
        """The model."""
        return model(*self.joints, **{e.name: e.make() for e in self.elements})

    def shuffled(self, seed: int) -> Network:
        """The same network, declared and connected in another order."""
        order = list(self.elements)
        random.Random(seed).shuffle(order)
        return Network(tuple(order), seed)

    def turned(self, names: Iterable[str]) -> Network:
        """The same network with some elements turned round."""
        chosen = set(names)
        turn = lambda e: replace(e, turned=not e.turned) if e.name in chosen else e  # noqa: E731
        return replace(self, elements=tuple(map(turn, self.elements)))

    def __repr__(self) -> str:
        lines = [*(repr(j) for j in self.joints), *map(repr, self.elements)]
        return "model(" + "".join(f"\n    {line}," for line in lines) + "\n)"


# -- strategies -------------------------------------------------------------------------------------------------

DOMAINS = {
    letter: [name for name, kind in KINDS.items() if set(kind.where) == {letter}] for letter in FLOW
}
COUPLED = [name for name, kind in KINDS.items() if len(set(kind.where)) > 1]
SETS = [*DOMAINS.values(), [*COUPLED, *(name for names in DOMAINS.values() for name in names)]]
REFERENCE = {"t": "Fixed", "r": "RFixed", "e": "Ground", "h": "FixedTemperature"}
TURNS_RATIO = (2.0, 0.5, 4.0)
"""Powers of two, so that the reciprocals are exact."""


def networks(max_elements: int, max_nodes: int, zeros: bool = False) -> st.SearchStrategy[Network]:
    """Any network: of one domain or of several, most of them with a reference in each, many of them ill posed.

    With ``zeros`` parameters may be zero.
    """
    numbers = st.integers(0, 48).map(lambda k: 1 + k / 16)
    values = st.one_of(numbers, st.just(0.0)) if zeros else numbers
    elements = st.sampled_from(SETS).flatmap(
        lambda names: st.lists(
            st.sampled_from(names).flatmap(lambda name: _element(name, max_nodes, values)),
            min_size=1,
            max_size=max_elements,
        )
    )
    return st.builds(_network, elements, st.sampled_from([True] * 9 + [False]))


def _element(
    kind: str, max_nodes: int, values: st.SearchStrategy[float]
) -> st.SearchStrategy[Element]:
    nodes = st.integers(0, max_nodes - 1)
    return st.builds(
        lambda nodes, values: Element("", kind, nodes, values),
        st.tuples(*(nodes for _ in KINDS[kind].ends)),
        st.tuples(
            *(st.sampled_from(TURNS_RATIO) if v == "n" else values for v in KINDS[kind].values)
        ),
    )


def _network(elements: Sequence[Element], with_references: bool) -> Network:
    """Elements with names; every node that takes heat from other domains stores it."""
    parts = list(elements)
    heated = {e.nodes[-1] for e in parts if e.kind == "HotResistor"}
    parts += [Element("", "HeatCapacitor", (node,), (1.0,)) for node in sorted(heated)]
    present = {letter for e in parts for letter in KINDS[e.kind].where}
    missing = [d for d, kind in REFERENCE.items() if all(e.kind != kind for e in parts)]
    if with_references:
        for domain in missing:
            if domain in present:
                kind = REFERENCE[domain]
                parts.append(Element("", kind, (0,), (1.0,) * len(KINDS[kind].values)))
    named = [replace(e, name=f"{e.kind[0].lower()}{i}") for i, e in enumerate(parts, 1)]
    return Network(tuple(named))
