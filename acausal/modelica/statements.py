"""Equations, algorithms and connections of the text, as statements of a component."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from typing import Any

import numpy as np

from acausal.modelica.algorithm_sections import AlgorithmReader
from acausal.modelica.connecting import ends_of
from acausal.modelica.modifications import Bound
from acausal.modelica.sections import SectionReader, collect, is_discrete
from acausal.modelica.syntax import Branches
from acausal.modelica.values import (
    as_array,
    elements,
    of,
    type_of,
)
from acausal.modeling import (
    Component,
    Connector,
    Eq,
    Input,
    Output,
    Previous,
    Start,
    When,
    references,
)
from acausal.netlist import attribute


def equations(build: Any) -> Iterator[Any]:
    """The equations and algorithms of a component, and those of variables that are given a value."""
    stated = [*_read(build, "equations", "algorithms")]
    for part, path, bound in build.bindings:
        stated += _bound(part, path, bound)
    for local, symbol in build.given_inwards:
        stated += SectionReader(build.frame(build.node)).pairs(local, symbol)
    for edge in build.edges:
        stated += SectionReader(build.frame(build.node)).related(edge)
    yield from _oriented(stated, build)


def _oriented(stated: list[Any], build: Any) -> Iterator[Any]:
    """The statements; an equation between two discrete variables gives the one that no other gives, here or above."""
    if not any(_gives_either(e) for e in stated):
        yield from stated
        return
    given = Counter(e.lhs for e in stated if isinstance(e, Eq) and is_discrete(e.lhs))
    given.update(
        e.lhs
        for when in stated
        if isinstance(when, When)
        for link in when.chain()
        for e in link.statements
        if isinstance(e, Eq)
    )
    component = build.component
    while (build := build.above) is not None:
        given.update(
            v for p, n, _ in build.bindings if p is component for v in elements(_target(p, n))
        )
    for one in stated:
        if _gives_either(one) and given[one.lhs] > 1 and not given[one.rhs]:
            given.update({one.lhs: -1, one.rhs: 1})
            one = Eq(one.rhs, one.lhs).stated_in(one.place)
        yield one


def _gives_either(one: Any) -> bool:
    return isinstance(one, Eq) and is_discrete(one.lhs) and is_discrete(one.rhs)


def initial_equations(build: Any) -> Iterator[Any]:
    """The initial equations and algorithms of a component, without those of `start`; starts that alone are fixed."""
    for name, fixed in build.fixed.items():
        given = as_array(build.component._node.modifiers[name].value)
        starts = np.broadcast_to(np.array(0 if given is None else given, dtype=object), fixed.shape)
        for place in zip(*np.nonzero(fixed), strict=True):
            yield Eq(as_array(getattr(build.component, name))[place], starts[place])
    for one in _read(build, "initial_equations", "initial_algorithms"):
        if not (isinstance(one.lhs, Previous) and (_jumps(one.rhs) or one.rhs.is_number)):
            yield one


def _read(build: Any, equations: str, algorithms: str) -> Iterator[Any]:
    """What the sections of two kinds state, in the order of the text."""
    for kind, stated, node in build.node.view().sections:
        if kind == equations == "initial_equations":
            for one in stated:
                if isinstance(one, Branches) and one.word == "when":
                    raise node.wrong(one.at, "'when' does not stand in initial equations")
        if kind == equations:
            reader = SectionReader(build.frame(node))
            yield from (_placed(one, node, reader.at) for one in reader.stated(stated))
        elif kind == algorithms:
            yield from AlgorithmReader(build.frame(node)).algorithm(stated)


def _placed(one: Any, node: Any, at: int) -> Any:
    """What is stated, with its line if it is an equation."""
    return one.stated_in(node.source.place(at)) if at and isinstance(one, Eq) else one


def connect(build: Any) -> None:
    """Make the connections of a component."""
    for kind, stated, node in build.node.view().sections:
        if kind == "equations":
            SectionReader(build.frame(node)).connections(stated)


def check(build: Any) -> None:
    """Read all that a component states, so that what is wrong is refused with its place.

    Inputs of parts that its equations give a value, as in ``block.u = 2*x``, are connected to outputs of its own. Those
    of its own that an equation gives a number, as nobody connects them, are connected to outputs around it.
    """
    component, node = build.component, build.component._node
    form, declared, own = _form_of(build), len(node.own_declarations), True
    if form is not None and form in build.node.checked:
        return
    stated = [s for s in equations(build) if isinstance(s, Eq)]
    started = start(component, stated, [*_read(build, "initial_equations", "initial_algorithms")])
    ends = {end for pair in node.connections for end in pair}
    symbols = [
        s for equation in stated for side in (equation.lhs, equation.rhs) for s in references(side)
    ]
    defaults = {s.lhs for s in stated if s.rhs.is_number}
    for symbol in dict.fromkeys(symbols):
        around = component if symbol.owner is not node else build.above and build.above.component
        given = isinstance(symbol.declaration, Input) and (
            around is component or symbol in defaults
        )
        if given and around and symbol not in ends:
            route = symbol.owner.route_from(around._node) or ()
            name = re.sub(r"\W+", "_", ".".join((*route, symbol.path)))
            setattr(around, f"{name}_given", Output(unit=symbol.declaration.unit))
            around.connect(getattr(around, f"{name}_given"), symbol)
            own = False
    alone = own and not (started or build.performs or build.decided or build.counted)
    if form is not None and alone and declared == len(node.own_declarations):
        build.node.checked.add(form)


def _form_of(build: Any) -> Any:
    """What decides what a component without parts states; None for others, which are read one by one."""
    node, made = build.component._node, build.made
    plain = all(isinstance(v, bool | int | float | str) for v in made.values())
    if node.children or build.outer or build.bindings or build.given_inwards or not plain:
        return None
    declared = [
        (name, type(d), getattr(d, "shape", None), getattr(d, "kind", None))
        for name, d in node.own_declarations.items()
    ]
    sizes = [(n, np.shape(v)) for n, v in node.modifiers.items() if isinstance(v, np.ndarray)]
    classes = [(name, id(cls)) for name, cls in build.classes.items()]
    return (*sorted(made.items()), *sorted(build.absent), *declared, *sizes, *classes)


def start(component: Component, stated: list[Eq], initial: list[Eq]) -> bool:
    """Give discrete variables the starts that follow from initial equations, through equations of two variables.

    Returns:
        Whether there are some.
    """
    values: dict[Any, float] = {
        e.lhs: float(e.rhs) for e in initial if _jumps(e.lhs) and e.rhs.is_number
    }
    same = [(e.lhs, e.rhs) for e in (*stated, *initial) if _jumps(e.lhs) and _jumps(e.rhs)]
    pairs = [*same, *((b, a) for a, b in same)]
    while new := {a: values[b] for a, b in pairs if b in values and a not in values}:
        values |= new
    for side in sorted(
        values, key=lambda s: isinstance(s, Previous)
    ):  # what is before the start counts
        reference = side.reference if isinstance(side, Previous) else side
        if reference.owner is component._node:
            _give_start(component, reference.path, values[side])
    return bool(values)


def _give_start(component: Component, path: str, value: float) -> None:
    """Give a discrete variable, or one element of an array of such, its start."""
    name, _, index = path[:-1].rpartition("[") if path.endswith("]") else (path, "", "")
    start: Any = value
    if index:
        stated = component._node.modifiers.get(name)
        known = stated.value if isinstance(stated, Start) and stated.value is not None else 0
        shape = np.shape(attribute(component, name))
        start = np.array(np.broadcast_to(np.asarray(known, dtype=object), shape))
        start[tuple(int(i) - 1 for i in index.split(","))] = value
        start = start.tolist()
    component.modify(**{name: Start(start)})


def _jumps(side: Any) -> bool:
    return isinstance(side, Previous) or is_discrete(side)


def assigned_at_events(node: Any) -> frozenset[str]:
    """The variables of a class that ``when`` gives values."""
    if "at_events" not in node.__dict__:
        found: set[str] = set()
        for _, stated, _ in node.view().sections:
            collect(stated, found, within=False)
        node.__dict__["at_events"] = frozenset(found)
    return node.__dict__["at_events"]


def fed_by_connections(build: Any) -> frozenset[str]:
    """The signals of a class that it connects, and that no equation gives a value."""
    connected, given = connected_or_given(build)
    return connected - given


def connected_or_given(build: Any) -> tuple[frozenset[str], frozenset[str]]:
    """The signals of a class that it connects, and the variables to which an equation gives a value."""
    node = build.node
    if "fed" not in node.__dict__:
        connected, given = set[str](), set[str]()
        for kind, stated, _ in node.view().sections:
            if kind in ("equations", "algorithms"):
                collect(stated, given, within=True)
                connected |= ends_of(stated)
        node.__dict__["fed"] = frozenset(connected), frozenset(given)
    return node.__dict__["fed"]


def _bound(part: Component, path: str, bound: Bound) -> Iterator[Eq]:
    reader = SectionReader(bound.frame)
    reader.at = bound.expression.at
    target, value = _target(part, path), bound.value()
    for one in elements(value):
        reader.need_type(type_of(elements(target)[0]) if np.size(target) else "", one)
    at = bound.expression.at
    yield from (_placed(one, bound.frame.node, at) for one in reader.pairs(target, value))


def _target(part: Component, path: str) -> Any:
    """The variable of a part that a modifier gives a value."""
    build = part.__dict__.get("_build")
    member = build.made.get(path) if build is not None else None
    owner, _, name = path.rpartition(".")
    connector = part._node.declaration(owner)
    if member is None and isinstance(connector, Connector):
        return of(connector._bind(part._node, owner), name)
    if member is None:
        member = of(part, path) if path.isidentifier() else as_array(attribute(part, path))
    return member
