"""Read: a netlist document becomes a component tree.

Parameters and parts are made in the order in which they depend on each other; modifiers, connections and initial
equations follow in the order of the file.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from graphlib import CycleError, TopologicalSorter
from typing import Any, cast

import sympy as sp

from acausal.errors import listing, shortened
from acausal.modeling import (
    KINDS,
    Component,
    Connector,
    Discrete,
    Eq,
    InitialParameter,
    Parameter,
    Placement,
    Start,
    Variable,
    inherit,
)
from acausal.netlist import library
from acausal.netlist.file import (
    EXPERIMENT_KEYS,
    MODEL_KEYS,
    NetlistError,
    as_list,
    as_object,
    kind,
    need_keys,
    within,
)
from acausal.netlist.library import Library
from acausal.netlist.model import (
    START_KEYS,
    Netlist,
    attribute,
    hint,
    is_left_out,
    state as state_of,
)
from acausal.netlist.modifiers import is_structural, make, modify
from acausal.netlist.parser import parse_equation
from acausal.netlist.scope import IGNORED_KEYS, Scope
from acausal.netlist.statements import parse_statement

PART = re.compile(r"([A-Za-z]\w*)(?:\[([1-9]\d{0,5})\])?", re.ASCII)
MENTION = re.compile(r"(?<![\w.])[A-Za-z]\w*", re.ASCII)


def build(document: Mapping[str, Any], where: str, libraries: tuple[Library, ...]) -> Netlist:
    """The model of a document.

    Raises:
        NetlistError: in one sentence, with the field.
    """
    _check_keys(document, where)
    model = Netlist()
    model._node.title = document.get("model", "")
    model._file.experiment = {k: document[k] for k in EXPERIMENT_KEYS if k in document}
    scope = Scope(model, libraries)
    for name, entry in as_object(document, "connectors", where).items():
        _connector(scope, name, entry, f"{where}: connectors.{shortened(name)}")
    _declare(scope, document, where)
    for name, entry in as_object(document, "variables", where).items():
        declare(scope, name, entry, f"{where}: variables.{shortened(name)}")
    for name, entry in as_object(document, "components", where).items():
        _modify(scope, name, entry, f"{where}: components.{shortened(name)}")
    for number, pair in enumerate(as_list(document, "connections", where)):
        _connect(model, pair, f"{where}: connections[{number}]")
    for number, text in enumerate(as_list(document, "equations", where)):
        state(scope, text, f"{where}: equations[{number}]")
    for number, text in enumerate(as_list(document, "initial_equations", where)):
        _initial(scope, text, f"{where}: initial_equations[{number}]")
    within(where, lambda: inherit(model))
    model.distinguish()
    return model


# -- parameters and parts ----------------------------------------------------------------------------


def _declare(scope: Scope, document: Mapping[str, Any], where: str) -> None:
    """Make the parameters and the parts, each after those that it depends on."""
    model = scope.model
    parameters = as_object(document, "parameters", where)
    parts = _grouped(as_object(document, "components", where), where)
    for name in _order(scope, parameters, parts, where):
        if name in parameters:
            _parameter(scope, name, parameters[name], f"{where}: parameters.{shortened(name)}")
            continue
        made = [
            _part(scope, key, entry, f"{where}: components.{shortened(key)}")
            for key, entry in parts[name]
        ]
        alone = parts[name][0][0] == name
        place = f"{where}: components.{shortened(name)}"
        assign(model, name, made[0] if alone else made, place)
    # Keep them in the order of the file.
    model._file.texts = {("", name): model._file.texts["", name] for name in parameters}
    keys = [key for entries in parts.values() for key, _ in entries]
    node = model._node
    node.children = {key: node.children[key] for key in keys if key in node.children}
    own = node.own_declarations
    node.own_declarations = {n: own[n] for n in dict.fromkeys((*parameters, *own)) if n in own}


def _order(
    scope: Scope,
    parameters: Mapping[str, Any],
    parts: Mapping[str, list[tuple[str, Any]]],
    where: str,
) -> list[str]:
    made_of = dict(parameters)
    for name, entries in parts.items():
        if name in parameters:
            raise NetlistError(f"{where}: '{name}' is a parameter and a component")
        made_of[name] = [raw for _, e in entries for raw in _structural(scope, e).values()]
    needs = {name: [n for n in _mentioned(raw) if n in made_of] for name, raw in made_of.items()}
    try:
        return list(TopologicalSorter(needs).static_order())
    except CycleError as error:
        circle = [shortened(name) for name in reversed(error.args[1])][:12]
        raise NetlistError(
            f"{where}: {' -> '.join(circle)}: each is given by the next; give one of them a number"
        ) from None


def _structural(scope: Scope, entry: Any) -> Mapping[str, Any]:
    """The modifiers that a part is made with."""
    if not isinstance(entry, Mapping) or "components" in entry:
        return {}
    name, given = entry.get("class"), entry.get("with", {})
    if not isinstance(name, str) or not isinstance(given, Mapping):
        return {}
    try:
        cls = library.find_class(scope.libraries, name)
    except KeyError:
        return {}
    if not issubclass(cls, Component):
        return {}
    return {key: raw for key, raw in given.items() if is_structural(cls, key)}


def _parameter(scope: Scope, name: str, raw: Any, where: str) -> None:
    """A parameter of the model; a list, truth value, text or record becomes a plain constant."""
    model = scope.model
    attributes = cast(Mapping[str, Any], raw) if isinstance(raw, Mapping) else {"=": raw}
    declared = _attributes(attributes, where)
    given = attributes.get("=", attributes.get("start"))
    value = None if given is None else scope.value(given, where)
    number = isinstance(value, int | float | sp.Expr) and not isinstance(value, bool)
    if attributes.get("fixed", True) is False:
        assign(model, name, InitialParameter(unit=declared.get("unit", "")), where)
        if value is not None:
            within(where, lambda: model.modify(**{name: Start(value)}))
    elif number or value is None:
        default = 0.0 if number and value == 0 else None  # a zero that nobody changes is folded
        assign(model, name, Parameter(default, **declared), where)
        if number and default is None:
            within(where, lambda: model.modify(**{name: value}))
    else:
        assign(model, name, value, where)
    model.remember("", name, raw)


def _attributes(given: Mapping[str, Any], where: str) -> dict[str, Any]:
    """Unit and bounds among the attributes of a parameter, all of which are checked."""
    known: dict[str, tuple[Any, str]] = {
        "unit": (str, "a text"),
        "min": (int | float, "a number"),
        "max": (int | float, "a number"),
    }
    for key, value in given.items():
        need_keys([key], ("=", "start", "fixed", *IGNORED_KEYS), where, "attribute")
        kinds, wanted = known.get(key, (object, ""))
        truth = isinstance(value, bool)
        if not isinstance(value, kinds) or (truth and key in known):
            raise NetlistError(f"{where}.{key}: {wanted} is needed, not {kind(value)}")
        if key == "fixed" and not truth:
            raise NetlistError(f"{where}.fixed: true or false is needed, not {kind(value)}")
    return {key: given[key] for key in known if key in given}


def _part(scope: Scope, key: str, entry: Any, where: str) -> Any:
    if not isinstance(entry, Mapping):
        raise NetlistError(f"{where}: a component is an object with a 'class', not {kind(entry)}")
    entry = cast(Mapping[str, Any], entry)
    given = as_object(entry, "with", where)
    if "components" in entry:
        inner = {k: v for k, v in entry.items() if k not in ("with", "place")}
        return _placed(build(inner, where, scope.libraries), entry, where)
    need_keys(entry, ("class", "with", "place"), where)
    cls = scope.find(entry.get("class"), f"{where}.class")
    scope.model._file.class_names[key] = entry["class"]
    if not issubclass(cls, Component):
        scope.model._file.placed.append(key)
        return cls()
    part, scope.model._file.arguments[key] = make(scope, cls, given, f"{where}.with", where)
    return _placed(part, entry, where)


def _placed(part: Component, entry: Mapping[str, Any], where: str) -> Component:
    """The part, on its place of the schematic if it has one."""
    if "place" in entry:
        given = as_object(entry, "place", where)
        need_keys(given, ("x", "y", "turned", "mirrored"), f"{where}.place")
        if not {"x", "y"} <= given.keys():
            raise NetlistError(f"{where}.place: x and y are needed")
        part._node.placement = within(f"{where}.place", lambda: Placement(**given))
    return part


def _connector(scope: Scope, name: str, entry: Any, where: str) -> None:
    attributes = cast(Mapping[str, Any], entry) if isinstance(entry, Mapping) else {"class": entry}
    need_keys(attributes, ("class", "unit"), where)
    cls = scope.find(attributes.get("class"), f"{where}.class")
    scope.model._file.class_names[name] = attributes["class"]
    if issubclass(cls, Component):
        raise NetlistError(f"{where}: {cls.__name__} is a component, not a connector")
    if "unit" not in attributes:
        assign(scope.model, name, cls(), where)
    elif issubclass(cls, Connector) or not isinstance(attributes["unit"], str):
        raise NetlistError(f"{where}: a unit is a text, and only a signal is given one")
    else:
        assign(scope.model, name, cls(unit=attributes["unit"]), where)


# -- modifiers, connections, initial equations ---------------------------------------------------------


def _modify(scope: Scope, name: str, entry: Mapping[str, Any], where: str) -> None:
    part = attribute(scope.model, name)
    for key, raw in as_object(entry, "with", where).items():
        place = f"{where}.with.{shortened(key)}"
        if not isinstance(part, Component):
            raise NetlistError(f"{place}: a connector takes no modifiers")
        if not is_structural(type(part), key):
            modify(scope, part, key, raw, place)
        scope.model.remember(name, key, raw)
    if isinstance(part, Netlist):
        part.remember_state()


def _connect(model: Netlist, pair: Any, where: str) -> None:
    ends = cast(list[Any], pair)
    if not (isinstance(pair, list) and len(ends) == 2 and all(isinstance(p, str) for p in ends)):
        raise NetlistError(f"{where}: a connection is a pair of names")
    count = len(model._node.connections)
    # A connection to a connector that an option leaves out is dropped, as in Modelica.
    if not any(is_left_out(model, text) for text in ends):
        found = [attribute(model, text) for text in ends]
        for text, end in zip(ends, found, strict=True):
            if end is None:
                raise NetlistError(f"{where}: there is no '{shortened(text)}'; {hint(model, text)}")
        within(where, lambda: model.connect(*found))
    model._file.wires.append((list(ends), len(model._node.connections) - count))


def _initial(scope: Scope, text: Any, where: str) -> None:
    if not isinstance(text, str):
        raise NetlistError(f"{where}: an equation is a text 'left = right', not {kind(text)}")
    left, right = within(where, lambda: parse_equation(text, scope.lookup))
    scope.model._file.initial.append((text, within(where, lambda: Eq(left, right))))


# -- names and checks --------------------------------------------------------------------------------


def _mentioned(raw: Any) -> list[str]:
    """Names that the expressions of a value begin with."""
    match raw:
        case str():
            return MENTION.findall(raw)
        case list():
            return [name for value in cast(list[Any], raw) for name in _mentioned(value)]
        case Mapping():
            return [name for value in raw.values() for name in _mentioned(value)]
        case _:
            return []


def _check_keys(document: Mapping[str, Any], where: str) -> None:
    need_keys(document, (*MODEL_KEYS, *EXPERIMENT_KEYS), where)
    for key in ("model", "description"):
        if not isinstance(document.get(key, ""), str):
            raise NetlistError(f"{where}: '{key}' is a text, not {kind(document[key])}")
    for key in ("start_time", "stop_time"):
        value = document.get(key, 0.0)
        if not isinstance(value, int | float) or isinstance(value, bool):
            raise NetlistError(f"{where}: '{key}' is a number, not {kind(value)}")
    for key in ("compare", "unparsed"):
        for value in as_list(document, key, where):
            if not isinstance(value, str):
                raise NetlistError(f"{where}: '{key}' lists texts, not {kind(value)}")


def _grouped(entries: Mapping[str, Any], where: str) -> dict[str, list[tuple[str, Any]]]:
    """Parts by name; ``m[1]``, ``m[2]`` and so on are one list ``m``."""
    groups: dict[str, list[tuple[str, Any]]] = {}
    for key, entry in entries.items():
        match = PART.fullmatch(key)
        if match is None:
            raise NetlistError(f"{where}: components.{shortened(key)}: {no_name(key)}")
        group = groups.setdefault(match[1], [])
        expected = f"{match[1]}[{len(group) + 1}]" if group or match[2] else key
        if key != expected:
            raise NetlistError(
                f"{where}: components.{shortened(key)}: elements of a list are named {match[1]}[1], "
                f"{match[1]}[2] and so on, one after the other"
            )
        group.append((key, entry))
    return groups


NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)


def declare(scope: Scope, name: str, raw: Any, where: str) -> None:
    """Declare a variable: its attributes, and under ``discrete`` its kind if it changes at events only.

    Raises:
        NetlistError: in one sentence, with the place.
    """
    if not isinstance(raw, Mapping):
        raise NetlistError(
            f'{where}: a variable is an object of its attributes, such as {{"start": 0}}, not {kind(raw)}'
        )
    given = cast(Mapping[str, Any], raw)
    need_keys(given, (*START_KEYS, "unit", "discrete"), where, "attribute")
    unit, of_kind = given.get("unit", ""), given.get("discrete")
    if not isinstance(unit, str):
        raise NetlistError(f"{where}.unit: a text is needed, not {kind(unit)}")
    if of_kind is None:
        variable = Variable(unit=unit)
    elif of_kind in KINDS:
        variable = Discrete(kind=of_kind, unit=unit)
    else:
        raise NetlistError(
            f"{where}.discrete: one of {listing(KINDS)} is needed, not {kind(of_kind)}"
        )
    assign(scope.model, name, variable, where)
    start = scope.start({k: v for k, v in given.items() if k in START_KEYS}, where)
    within(where, lambda: scope.model.modify(**{name: start}))
    scope.model._file.variables[name] = raw, state_of(scope.model, name)


def state(scope: Scope, text: Any, where: str) -> None:
    """Add an equation to the model, or what happens at an event.

    Raises:
        NetlistError: in one sentence, with the place.
    """
    if not isinstance(text, str):
        raise NetlistError(
            f"{where}: an equation is a text, 'left = right' or 'when ... then ... end when', not {kind(text)}"
        )
    found = within(where, lambda: parse_statement(text, scope.lookup))
    scope.model._file.equations.append((text, found))


def assign(model: Netlist, name: str, value: Any, where: str) -> None:
    """Give the model a parameter, variable, connector, part or constant."""
    if not NAME.fullmatch(name):
        raise NetlistError(f"{where}: {no_name(name)}")
    within(where, lambda: model._claim(name))
    within(where, lambda: setattr(model, name, value))


def no_name(name: str) -> str:
    """What to say of a name that is none."""
    return f"'{shortened(name)}' is not a name; letters, digits and underscores, beginning with a letter"
