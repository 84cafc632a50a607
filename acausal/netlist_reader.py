"""Read: a netlist document becomes a component tree.

Parameters and parts are made in the order in which they need each other, then modifiers, connections and initial
equations follow as they stand.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from graphlib import CycleError, TopologicalSorter
from typing import Any, cast

import sympy as sp

from acausal import library
from acausal.component import Component, Connector
from acausal.errors import DeclarationError, nearest, shortened
from acausal.expressions import parse, parse_equation
from acausal.library import Library
from acausal.netlist_file import (
    EXPERIMENT_KEYS,
    MODEL_KEYS,
    NetlistError,
    as_list,
    as_object,
    kind,
    within,
)
from acausal.netlist_model import START_KEYS, Netlist, arguments_of, attribute, hint, is_left_out
from acausal.symbols import (
    STATE_SELECT,
    Declaration,
    Eq,
    Input,
    Module,
    Option,
    Parameter,
    Reference,
    Start,
    Variable,
    time,
)

IGNORED_KEYS = ("displayUnit", "unit", "quantity", "min", "max")
"""Attributes of a modifier that change no result."""

NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)
PART = re.compile(r"([A-Za-z]\w*)(?:\[([1-9]\d{0,5})\])?", re.ASCII)
MENTION = re.compile(r"(?<![\w.])[A-Za-z]\w*", re.ASCII)

Lookup = Callable[[str], Any]


class Reader:
    """Makes the component tree of a document."""

    def __init__(self, libraries: tuple[Library, ...]) -> None:
        self.libraries = libraries

    def model(self, document: Mapping[str, Any], where: str) -> Netlist:
        """The model of a document.

        Raises:
            NetlistError: in one sentence, with the field.
        """
        _check_keys(document, where)
        model = Netlist()
        model._title = document.get("model", "")
        model._experiment = {k: document[k] for k in EXPERIMENT_KEYS if k in document}
        lookup = self._lookup(model)
        for name, entry in as_object(document, "connectors", where).items():
            self._connector(model, name, entry, f"{where}: connectors.{shortened(name)}")
        self._declare(model, document, lookup, where)
        for name, entry in as_object(document, "components", where).items():
            part = attribute(model, name)
            for key, raw in as_object(entry, "with", f"{where}: components.{name}").items():
                place = f"{where}: components.{name}.with.{shortened(key)}"
                self._modify(model, part, key, raw, lookup, place, made=True)
                model.remember(name, key, raw)
            if isinstance(part, Netlist):
                part.settle()
        for number, pair in enumerate(as_list(document, "connections", where)):
            self._connect(model, pair, f"{where}: connections[{number}]")
        for number, text in enumerate(as_list(document, "initial_equations", where)):
            self._initial(model, text, lookup, f"{where}: initial_equations[{number}]")
        statements = (*map(str, model._bindings), *(text for text, _ in model._initial))
        model._constants["equations of the file"] = statements  # what tells two such models apart
        return model

    # -- parameters and parts ------------------------------------------------------------------------

    def _declare(
        self, model: Netlist, document: Mapping[str, Any], lookup: Lookup, where: str
    ) -> None:
        """Make the parameters and the parts, each after those that it needs."""
        parameters = as_object(document, "parameters", where)
        parts = _grouped(as_object(document, "components", where), where)
        needs: dict[str, list[str]] = {}
        for name, raw in parameters.items():
            needs[name] = [n for n in _mentioned(raw) if n in parameters or n in parts]
        for name, entries in parts.items():
            if name in parameters:
                raise NetlistError(f"{where}: '{name}' is a parameter and a component")
            made_of = [raw for _, entry in entries for raw in self._structural(entry).values()]
            needs[name] = [n for n in _mentioned(made_of) if n in parameters or n in parts]
        try:
            order = list(TopologicalSorter(needs).static_order())
        except CycleError as error:
            circle = " -> ".join(shortened(n) for n in reversed(error.args[1]))
            raise NetlistError(
                f"{where}: {circle} go round in a circle; give one of them a number"
            ) from None
        for name in order:
            if name in parameters:
                place = f"{where}: parameters.{shortened(name)}"
                self._parameter(model, name, parameters[name], lookup, place)
            else:
                made = [self._part(model, *entry, lookup, where) for entry in parts[name]]
                alone = parts[name][0][0] == name
                place = f"{where}: components.{shortened(name)}"
                _assign(model, name, made[0] if alone else made, place)
        model._texts = {("", name): model._texts["", name] for name in parameters}
        keys = [key for entries in parts.values() for key, _ in entries]
        model._children = {key: model._children[key] for key in keys if key in model._children}
        declared = [*model._dynamic]
        model._dynamic = {
            n: model._dynamic[n] for n in dict.fromkeys((*parameters, *declared)) if n in declared
        }

    def _structural(self, entry: Any) -> Mapping[str, Any]:
        """The modifiers that a part is made with: options, vectors, arguments of its class."""
        if not isinstance(entry, Mapping) or not isinstance(entry.get("with", {}), Mapping):
            return {}
        if "components" in entry or not isinstance(entry.get("class"), str):
            return {}
        try:
            cls = library.find(self.libraries, entry["class"])
        except KeyError:
            return {}
        given = cast(Mapping[str, Any], entry.get("with", {}))
        return {key: raw for key, raw in given.items() if _is_structural(cls, key)}

    def _parameter(self, model: Netlist, name: str, raw: Any, lookup: Lookup, where: str) -> None:
        attributes = raw if isinstance(raw, Mapping) else {"=": raw}
        for key in attributes:
            if key not in ("=", "start", "fixed", *IGNORED_KEYS):
                raise NetlistError(
                    f"{where}: unknown attribute '{shortened(key)}'; {nearest(key, ('=', 'start', 'fixed'))}"
                )
        declared = {k: attributes[k] for k in ("unit", "min", "max") if k in attributes}
        if attributes.get("fixed", True) is False:
            start = self._value(attributes.get("start", 0.0), lookup, f"{where}.start")
            unit = declared.get("unit", "")
            _assign(model, name, Variable(start=0.0, unit=unit, state="prefer"), where)
            within(where, lambda: model.modify(**{name: Start(start)}))
            model._steady.append(name)
        else:
            given = attributes.get("=", attributes.get("start"))
            value = None if given is None else self._value(given, lookup, where)
            number = isinstance(value, int | float | sp.Expr) and not isinstance(value, bool)
            if number or value is None:
                within(where, lambda: _assign(model, name, Parameter(**declared), where))
                if number:
                    within(where, lambda: model.modify(**{name: value}))
            else:
                _assign(model, name, value, where)
        model.remember("", name, raw)

    def _part(self, model: Netlist, key: str, entry: Any, lookup: Lookup, where: str) -> Any:
        where = f"{where}: components.{shortened(key)}"
        if not isinstance(entry, Mapping):
            raise NetlistError(f"{where}: a component is an object with a 'class', not {kind(entry)}")
        entry = cast(Mapping[str, Any], entry)
        given = as_object(entry, "with", where)
        if "components" in entry:
            inner = self.model({k: v for k, v in entry.items() if k != "with"}, where)
            return inner
        for name in entry:
            if name not in ("class", "with"):
                raise NetlistError(
                    f"{where}: unknown key '{shortened(name)}'; {nearest(name, ('class', 'with'))}"
                )
        cls = self._find(entry.get("class"), f"{where}.class")
        if not issubclass(cls, Component):
            model._placed.append(key)
            return cls()
        arguments = {
            name: self._argument(cls, name, raw, lookup, f"{where}.with.{shortened(name)}")
            for name, raw in given.items()
            if _is_structural(cls, name)
        }
        model._made[key] = arguments
        return within(where, lambda: _make(cls, arguments))

    def _argument(self, cls: Any, name: str, raw: Any, lookup: Lookup, where: str) -> Any:
        declared = cls._declared.get(name)
        if isinstance(declared, Option):
            return self._option(declared, raw, lookup, where)
        if declared is None and isinstance(raw, str):
            try:
                return library.find(self.libraries, raw)
            except KeyError:
                pass
        return self._value(raw, lookup, where)

    def _option(self, declared: Option, raw: Any, lookup: Lookup, where: str) -> Any:
        """A structural choice; one of its choices may stand there as it is."""
        if isinstance(raw, str) and raw in (declared.choices or ()):
            return raw
        return _settled(declared, self._value(raw, lookup, where), where)

    def _connector(self, model: Netlist, name: str, entry: Any, where: str) -> None:
        attributes: Mapping[str, Any] = entry if isinstance(entry, Mapping) else {"class": entry}
        for key in attributes:
            if key not in ("class", "unit"):
                raise NetlistError(
                    f"{where}: unknown key '{shortened(key)}'; {nearest(key, ('class', 'unit'))}"
                )
        cls = self._find(attributes.get("class"), f"{where}.class")
        if issubclass(cls, Component):
            raise NetlistError(f"{where}: {cls.__name__} is a component, no connector")
        unit = {"unit": str(attributes["unit"])} if "unit" in attributes else {}
        if unit and issubclass(cls, Connector):
            raise NetlistError(f"{where}: only a signal is given a unit")
        _assign(model, name, cls(**unit), where)

    def _find(self, name: Any, where: str) -> Any:
        if not isinstance(name, str):
            raise NetlistError(f"{where}: the name of a class is needed, not {kind(name)}")
        try:
            return library.find(self.libraries, name)
        except KeyError as error:
            hint = f"there is no class '{shortened(name)}'; {error.args[0]}"
            raise NetlistError(f"{where}: {hint}") from None

    # -- modifiers -----------------------------------------------------------------------------------

    def _modify(
        self, model: Netlist, part: Any, key: str, raw: Any, lookup: Lookup, where: str, *, made: bool = False
    ) -> None:
        """Apply one modifier; ``made``: the part was made with its structural ones already."""
        if isinstance(part, Connector | Reference):
            raise NetlistError(f"{where}: a connector takes no modifiers here")
        if key in part._children:
            if not isinstance(raw, Mapping):
                raise NetlistError(f"{where} is a component; its modifiers are an object, not {kind(raw)}")
            for name, value in raw.items():
                place = f"{where}.{shortened(name)}"
                self._modify(model, part._children[key], name, value, lookup, place)
            return
        if made and _is_structural(type(part), key):
            return
        declared = part._declared.get(key) or part._dynamic.get(key)
        match declared:
            case Connector():
                if not isinstance(raw, Mapping):
                    raise NetlistError(f"{where} is a connector; modify its variables by an object")
                value: Any = {
                    n: self._start(v, lookup, f"{where}.{shortened(n)}") for n, v in raw.items()
                }
            case Variable():
                if not isinstance(raw, Mapping) or "=" in raw:
                    self._bind(model, part, key, raw, lookup, where)
                if not isinstance(raw, Mapping) or not any(k in START_KEYS for k in raw):
                    return
                value = self._start({k: v for k, v in raw.items() if k != "="}, lookup, where)
            case Parameter() if isinstance(raw, Mapping):
                value = self._parameter_value(raw, lookup, where)
                if value is None:
                    return
            case Module():
                raise NetlistError(f"{where} is a network; a file cannot hold one, give it in Python")
            case None:
                known = [*(n for n, _ in part._declarations()), *part._children]
                raise NetlistError(f"{where}: {part._label()} has no '{shortened(key)}'; {nearest(key, known)}")
            case Option():
                value = self._option(declared, raw, lookup, where)
            case _:
                value = self._value(raw, lookup, where)
        within(where, lambda: part.modify(**{key: value}))

    def _parameter_value(self, raw: Mapping[str, Any], lookup: Lookup, where: str) -> Any:
        """The value among a parameter's attributes, None where there is none."""
        for key in raw:
            if key not in ("=", "start", "fixed", "nominal", *IGNORED_KEYS):
                raise NetlistError(
                    f"{where}: unknown attribute '{shortened(key)}'; a parameter's value stands under '='"
                )
        if raw.get("fixed", True) is not True:
            raise NetlistError(
                f"{where}: only a parameter of the model itself can be left to the initialization (fixed=false)"
            )
        given = raw.get("=", raw.get("start"))
        return None if given is None else self._value(given, lookup, where)

    def _start(self, raw: Any, lookup: Lookup, where: str) -> Start:
        if not isinstance(raw, Mapping):
            raise NetlistError(f"{where}: a variable's attributes are an object, such as {{\"start\": 0}}")
        values: dict[str, Any] = {}
        for key, given in cast(Mapping[str, Any], raw).items():
            if key in IGNORED_KEYS:
                continue
            if key not in START_KEYS:
                raise NetlistError(
                    f"{where}: unknown attribute '{shortened(key)}'; {nearest(key, START_KEYS)}"
                )
            bare = key == "stateSelect" and given in STATE_SELECT
            value = given if bare else self._value(given, lookup, f"{where}.{key}")
            values[START_KEYS[key]] = _attribute_value(key, value, f"{where}.{key}")
        return within(where, lambda: Start(**values))

    def _bind(self, model: Netlist, part: Component, key: str, raw: Any, lookup: Lookup, where: str) -> None:
        """A variable that is given a value: one more equation of the model."""
        if isinstance(part._declared.get(key) or part._dynamic.get(key), Input):
            raise NetlistError(f"{where} is an input; connect a source to it")
        value = self._value(raw["="] if isinstance(raw, Mapping) else raw, lookup, where)
        variable = getattr(part, key)
        if isinstance(variable, Sequence) and isinstance(value, Sequence):
            pairs = list(zip(cast(Sequence[Any], variable), cast(Sequence[Any], value), strict=False))
        else:
            pairs = [(variable, value)]
        model._bindings += [within(where, lambda v=v, x=x: Eq(v, x)) for v, x in pairs]

    # -- values --------------------------------------------------------------------------------------

    def _value(self, raw: Any, lookup: Lookup, where: str) -> Any:
        """A number, truth value, list, or the value of an expression; enumerations become their last word."""
        match raw:
            case bool() | int() | float():
                return raw
            case str():
                return within(where, lambda: parse(raw, lookup))
            case list():
                values = cast(list[Any], raw)
                return [self._value(v, lookup, f"{where}[{i}]") for i, v in enumerate(values)]
            case Mapping() if "=" in raw:
                return self._value(raw["="], lookup, where)
            case _:
                raise NetlistError(f"{where}: {kind(raw)} is no value")

    def _lookup(self, model: Netlist) -> Lookup:
        """Names as an expression of this model sees them."""

        def find(name: str) -> Any:
            value = attribute(model, name)
            if value is not None:
                return value
            for known in self.libraries:
                value = known.constant(name)
                if value is not None:
                    return value
            if name == "time":
                return time
            raise KeyError(name)

        return find

    # -- connections and initial equations -----------------------------------------------------------

    def _connect(self, model: Netlist, pair: Any, where: str) -> None:
        ends = cast(list[Any], pair)
        if not (isinstance(pair, list) and len(ends) == 2 and all(isinstance(p, str) for p in ends)):
            raise NetlistError(f"{where}: a connection is a pair of names")
        count = len(model._connections)
        if not any(is_left_out(model, text) for text in ends):  # as in Modelica, such a connection falls away
            found = [attribute(model, text) for text in ends]
            for text, end in zip(ends, found, strict=True):
                if end is None:
                    raise NetlistError(f"{where}: there is no '{shortened(text)}'; {hint(model, text)}")
            within(where, lambda: model.connect(*found))
        model._wires.append((list(ends), len(model._connections) - count))

    def _initial(self, model: Netlist, text: Any, lookup: Lookup, where: str) -> None:
        if not isinstance(text, str):
            raise NetlistError(f"{where}: an equation is a text 'left = right', not {kind(text)}")
        left, right = within(where, lambda: parse_equation(text, lookup))
        model._initial.append((text, within(where, lambda: Eq(left, right))))


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


# -- checks ------------------------------------------------------------------------------------------


def _check_keys(document: Mapping[str, Any], where: str) -> None:
    known = (*MODEL_KEYS, *EXPERIMENT_KEYS)
    for key in document:
        if key not in known:
            raise NetlistError(f"{where}: unknown key '{shortened(key)}'; {nearest(key, known)}")
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
            raise NetlistError(f"{where}: components.{shortened(key)}: {_no_name(key)}")
        group = groups.setdefault(match[1], [])
        index = int(match[2]) if match[2] else None
        if index != (len(group) + 1 if match[2] else None) or (index is None and group):
            raise NetlistError(
                f"{where}: components.{shortened(key)}: elements of a list are named {match[1]}[1], "
                f"{match[1]}[2] and so on, one after the other"
            )
        group.append((key, entry))
    return groups


def _assign(model: Netlist, name: str, value: Any, where: str) -> None:
    if not NAME.fullmatch(name):
        raise NetlistError(f"{where}: {_no_name(name)}")
    within(where, lambda: model._claim(name))
    within(where, lambda: setattr(model, name, value))


def _no_name(name: str) -> str:
    return f"'{shortened(name)}' is no name; letters, digits and underscores, beginning with a letter"


def _make(cls: Any, arguments: Mapping[str, Any]) -> Any:
    """An instance; whatever a constructor does not like becomes a sentence."""
    try:
        return cls(**arguments)
    except DeclarationError:
        raise
    except Exception as error:  # a library's own code met values it was not written for
        reason = shortened(" ".join(str(error).split()), 120)
        raise DeclarationError(f"{cls.__name__} cannot be made with these modifiers ({reason})") from None


def _is_structural(cls: Any, key: str) -> bool:
    """Whether a part must be made with that modifier."""
    if not issubclass(cls, Component):
        return False
    declared = cls._declared.get(key)
    if isinstance(declared, Declaration):
        return isinstance(declared, Option) or (
            isinstance(declared, Parameter) and declared.shape is not None
        )
    return declared is None and key in arguments_of(cls)


def _settled(option: Option, value: Any, where: str) -> Any:
    """The value of a structural choice: expressions of parameters are reckoned here and now."""
    if isinstance(value, list):
        return [_settled(option, v, where) for v in cast(list[Any], value)]
    if isinstance(value, sp.Expr):
        value = _reckoned(value, where, set())
    whole = isinstance(option.default, int) and not isinstance(option.default, bool)
    return int(value) if whole and isinstance(value, float) and value.is_integer() else value


def _reckoned(expression: sp.Expr, where: str, open_names: set[str]) -> float:
    values: dict[sp.Symbol, Any] = {}
    for symbol in expression.free_symbols:
        if not isinstance(symbol, Reference) or not isinstance(symbol.declaration, Parameter):
            raise NetlistError(f"{where}: '{symbol}' changes with time, and this must be known before")
        given = symbol.owner._modifiers.get(symbol.path, symbol.declaration.default)
        if isinstance(given, sp.Expr) and symbol.name not in open_names:
            given = _reckoned(given, where, {*open_names, symbol.name})
        if not isinstance(given, int | float):
            raise NetlistError(f"{where}: '{symbol.path}' has no number, and this must be known before")
        values[symbol] = given
    return float(expression.subs(values))


def _attribute_value(key: str, value: Any, where: str) -> Any:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    match key:
        case "fixed" if not isinstance(value, bool):
            raise NetlistError(f"{where}: true or false is needed, not {kind(value)}")
        case "nominal" if not number:
            raise NetlistError(f"{where}: a number is needed, not {kind(value)}")
        case "stateSelect" if not isinstance(value, str):
            raise NetlistError(f"{where}: a StateSelect is needed, not {kind(value)}")
        case "start" if not number and not isinstance(value, list | sp.Expr | bool):
            raise NetlistError(f"{where}: a number or an expression is needed, not {kind(value)}")
        case _:
            return float(value) if isinstance(value, bool) and key == "start" else value
