"""Models as data: JSON netlists of components, connections and parameters, read and written.

A class is named as in the Modelica Standard Library or by its Python path within a library; only classes of
registered libraries can be reached. Expressions go through `acausal.expressions`. A file cannot run code.

```json
{
  "model": "Oscillator",
  "parameters": {"c": 100.0},
  "components": {
    "spring": {"class": "Modelica.Mechanics.Translational.Components.Spring", "with": {"c": "c"}},
    "mass": {"class": "acausal.components.translational.Mass", "with": {"m": 1.0, "s": {"start": 0.1, "fixed": true}}}
  },
  "connections": [["spring.flange_b", "mass.flange_a"]],
  "initial_equations": ["mass.v = 0"]
}
```
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any, cast

import numpy as np
import sympy as sp

from acausal.component import Component, Connector
from acausal.errors import DeclarationError, ModelError, nearest
from acausal.expressions import parse, parse_equation, written
from acausal.library import Library, installed
from acausal.symbols import (
    Eq,
    Option,
    Parameter,
    Reference,
    Start,
    Variable,
    der,
    references,
)

MAX_BYTES = 100_000_000
MAX_DEPTH = 50
START_KEYS = {"start": "value", "fixed": "fixed", "nominal": "nominal", "stateSelect": "state"}
IGNORED_KEYS = ("displayUnit", "unit", "quantity", "min", "max")
"""Attributes of a modifier that change no result."""

IDENTIFIER = re.compile(r"[A-Za-z_]\w*")
EXPERIMENT = ("start_time", "stop_time", "compare", "unparsed", "description")
"""Keys of a document that are kept but mean nothing to the model."""


class NetlistError(ModelError):
    """A netlist file is malformed; the message begins with the place in it."""


class Netlist(Component):
    """A model read from a file: a component whose equations are those of the file.

    Attributes:
        document: the keys of the file that are not part of the model (times of an experiment, notes).
    """

    document: dict[str, Any]

    def __init__(self) -> None:
        super().__init__()
        self._title = "Netlist"
        self._initial: list[tuple[str, Eq]] = []
        self._steady: list[str] = []
        self._texts: dict[tuple[str, str], tuple[Any, Any]] = {}
        """(part, modifier) -> what the file says and the value it gave."""

    def equations(self) -> Iterator[Eq]:
        """Parameters that are found at the initial time stay as they are."""
        for name in self._steady:
            yield Eq(der(getattr(self, name)), 0)

    def initial_equations(self) -> Iterator[Eq]:
        """The initial equations of the file."""
        yield from (equation for _, equation in self._initial)


def load(path: str | Path, libraries: Sequence[ModuleType] = ()) -> Netlist:
    """Read a model from a JSON netlist.

    Arguments:
        libraries: further libraries of components besides the installed ones, see `acausal.library`.

    Raises:
        ModelError: in one sentence, with the line or field, for a file that cannot be read, a class or name
            that does not exist, an expression that is malformed.
    """
    path = Path(path)
    document = _read(path)
    return _Builder(_libraries(libraries)).model(document, path.name)


def save(model: Component, path: str | Path, libraries: Sequence[ModuleType] = ()) -> None:
    """Write a model as a JSON netlist; `load` gives the same model back.

    Parts whose class is in a library are written by its name; other composites as subsystems. What was read from
    a file and not changed is written as it stood there.

    Raises:
        ModelError: for a leaf component of no library, or a value that JSON cannot hold (a user's network).
    """
    document = _Writer(_libraries(libraries)).model(model)
    text = json.dumps(document, indent=1, ensure_ascii=False)
    Path(path).write_text(text + "\n", encoding="utf-8")


def _libraries(modules: Sequence[ModuleType]) -> tuple[Library, ...]:
    return (*installed(), *(Library(module) for module in modules))


# -- reading -----------------------------------------------------------------------------------------


def _read(path: Path) -> dict[str, Any]:
    try:
        if path.stat().st_size > MAX_BYTES:
            raise NetlistError(f"{path.name}: larger than {MAX_BYTES // 1_000_000} MB")
        document = json.loads(
            path.read_text(encoding="utf-8"),
            object_pairs_hook=_unique,
            parse_constant=_refuse_constant,
        )
    except OSError as error:
        raise NetlistError(f"{path}: cannot be read ({error.strerror})") from None
    except UnicodeDecodeError:
        raise NetlistError(f"{path.name}: not a text file in UTF-8") from None
    except RecursionError:
        raise NetlistError(f"{path.name}: nested too deeply") from None
    except json.JSONDecodeError as error:
        raise NetlistError(
            f"{path.name}, line {error.lineno}, column {error.colno}: {error.msg}"
        ) from None
    except ValueError as error:
        raise NetlistError(f"{path.name}: {error}") from None
    if not isinstance(document, dict):
        raise NetlistError(
            f"{path.name}: a model is an object {{...}}, not a {type(document).__name__}"
        )
    return cast(dict[str, Any], document)


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for name, value in pairs:
        if name in found:
            raise ValueError(f"'{name}' stands twice in one object")
        found[name] = value
    return found


def _refuse_constant(name: str) -> Any:
    raise ValueError(f"{name} is not a finite number")


class _Builder:
    """Makes the component tree of a document."""

    def __init__(self, libraries: tuple[Library, ...]) -> None:
        self.libraries = libraries

    def model(self, document: Mapping[str, Any], where: str, depth: int = 0) -> Netlist:
        if depth > MAX_DEPTH:
            raise NetlistError(f"{where}: subsystems nested more than {MAX_DEPTH} deep")
        known = (
            "model",
            "parameters",
            "connectors",
            "components",
            "connections",
            "initial_equations",
            *EXPERIMENT,
        )
        for key in document:
            if key not in known:
                raise NetlistError(f"{where}: unknown key '{key}'; {nearest(key, known)}")
        model = Netlist()
        model._title = str(document.get("model", "Netlist"))
        model.document = {k: document[k] for k in EXPERIMENT if k in document}
        lookup = self._lookup(model)
        for name, value in _object(document, "parameters", where).items():
            self._parameter(model, name, value, lookup, f"{where}: parameters.{name}")
        for name, kind in _object(document, "connectors", where).items():
            connector = self._find(kind, f"{where}: connectors.{name}")
            _assign(model, name, connector(), f"{where}: connectors.{name}")
        for name, entry in _object(document, "components", where).items():
            self._component(model, name, entry, f"{where}: components.{name}", depth)
        for name, entry in _object(document, "components", where).items():
            self._modify(
                model, name, entry.get("with", {}), lookup, f"{where}: components.{name}.with"
            )
        for number, pair in enumerate(_list(document, "connections", where)):
            self._connect(model, pair, f"{where}: connections[{number}]")
        for number, text in enumerate(_list(document, "initial_equations", where)):
            self._initial(model, text, lookup, f"{where}: initial_equations[{number}]")
        return model

    def _parameter(self, model: Netlist, name: str, raw: Any, lookup: Any, where: str) -> None:
        if isinstance(raw, Mapping) and raw.get("fixed") is False:
            _assign(
                model, name, Variable(start=float(raw.get("start", 0.0)), state="prefer"), where
            )
            model._steady.append(name)
        else:
            value = self._value(raw, lookup, where)
            if isinstance(value, int | float | sp.Expr) and not isinstance(value, bool):
                _assign(model, name, Parameter(), where)
                _within(where, lambda: model.modify(**{name: value}))
            else:
                _assign(model, name, value, where)
        model._texts["", name] = raw, model._modifiers.get(name)

    def _component(self, model: Netlist, name: str, entry: Any, where: str, depth: int) -> None:
        if not isinstance(entry, Mapping):
            raise NetlistError(
                f"{where}: a component is an object with a 'class', not {_kind(entry)}"
            )
        if "components" in entry:
            inner = {k: v for k, v in entry.items() if k != "with"}
            _assign(model, name, self.model(inner, where, depth + 1), where)
            return
        for key in entry:
            if key not in ("class", "with"):
                raise NetlistError(
                    f"{where}: unknown key '{key}'; {nearest(key, ('class', 'with'))}"
                )
        cls = self._find(entry.get("class"), f"{where}.class")
        given = entry.get("with", {})
        if not isinstance(given, Mapping):
            raise NetlistError(f"{where}.with: modifiers are an object, not {_kind(given)}")
        lookup = self._lookup(model)
        options: dict[str, Any] = {}
        for key, raw in given.items():
            declared = cls._declared.get(key)
            if isinstance(declared, Option) or (
                isinstance(declared, Parameter) and declared.shape is not None
            ):
                options[key] = self._value(raw, lookup, f"{where}.with.{key}")
        component = _within(where, lambda: cls(**options))
        _assign(model, name, component, where)

    def _modify(
        self, model: Netlist, name: str, given: Mapping[str, Any], lookup: Any, where: str
    ) -> None:
        component = model._children[name]
        for key, raw in given.items():
            declared = component._declared.get(key) or component._dynamic.get(key)
            if not isinstance(declared, Option) and not (
                isinstance(declared, Parameter) and declared.shape is not None
            ):
                value = self._modifier(declared, raw, lookup, f"{where}.{key}")
                _within(
                    f"{where}.{key}", lambda key=key, value=value: component.modify(**{key: value})
                )
            model._texts[name, key] = (
                raw,
                component._modifiers.get(key, component._options.get(key)),
            )

    def _modifier(self, declared: Any, raw: Any, lookup: Any, where: str) -> Any:
        """A modifier as `Component.modify` takes it."""
        if not isinstance(raw, Mapping):
            return self._value(raw, lookup, where)
        if isinstance(declared, Variable):
            values: dict[str, Any] = {}
            for key, value in raw.items():
                if key in START_KEYS:
                    read = self._value(value, lookup, f"{where}.{key}")
                    values[START_KEYS[key]] = float(read) if key == "nominal" else read
                elif key not in IGNORED_KEYS:
                    raise NetlistError(
                        f"{where}: unknown attribute '{key}'; {nearest(key, START_KEYS)}"
                    )
            return _within(where, lambda: Start(**values))
        if isinstance(declared, Parameter):
            if "=" not in raw:
                raise NetlistError(f'{where}: a parameter\'s value stands under "="')
            return self._value(raw["="], lookup, where)
        return {
            k: self._modifier(Variable() if _is_start(v) else None, v, lookup, f"{where}.{k}")
            for k, v in raw.items()
        }

    def _value(self, raw: Any, lookup: Any, where: str) -> Any:
        """A number, truth value, list, or the value of an expression; enumerations become their last word."""
        match raw:
            case bool() | None:
                return raw
            case int() | float():
                return _within(where, lambda: _number(raw))
            case str():
                return _within(where, lambda: parse(raw, lookup))
            case list():
                return [
                    self._value(v, lookup, f"{where}[{i}]")
                    for i, v in enumerate(cast(list[Any], raw))
                ]
            case Mapping() if "=" in raw:
                return self._value(raw["="], lookup, where)
            case _:
                raise NetlistError(f"{where}: {_kind(raw)} is no value")

    def _lookup(self, model: Netlist) -> Callable[[str], Any]:
        """Names as an expression of this model sees them."""

        def find(name: str) -> Any:
            value = _attribute(model, name)
            if value is not None:
                return value
            for library in self.libraries:
                value = library.constant(name)
                if value is not None:
                    return value
            raise KeyError(name)

        return find

    def _connect(self, model: Netlist, pair: Any, where: str) -> None:
        if not (
            isinstance(pair, list)
            and len(cast(list[Any], pair)) == 2
            and all(isinstance(p, str) for p in pair)
        ):
            raise NetlistError(f"{where}: a connection is a pair of names")
        ends: list[Any] = []
        for text in cast(list[str], pair):
            end = _attribute(model, text)
            if end is None:
                raise NetlistError(f"{where}: there is no '{text}'; {_hint(model, text)}")
            ends.append(end)
        _within(where, lambda: model.connect(*ends))

    def _initial(self, model: Netlist, text: Any, lookup: Any, where: str) -> None:
        if not isinstance(text, str):
            raise NetlistError(f"{where}: an equation is a text 'left = right'")
        left, right = _within(where, lambda: parse_equation(text, lookup))
        model._initial.append((text, _within(where, lambda: Eq(left, right))))

    def _find(self, name: Any, where: str) -> Any:
        if not isinstance(name, str):
            raise NetlistError(f"{where}: the name of a class is needed, not {_kind(name)}")
        for library in self.libraries:
            found = library.find(name)
            if found is not None:
                return found
        known = [n for library in self.libraries for n in library.modelica_names]
        raise NetlistError(
            f"{where}: there is no class '{name}'; {nearest(name, known)}"
            if known
            else f"{where}: no library of components is installed"
        )


def _attribute(model: Component, name: str) -> Any:
    """What a dotted name with indices (counted from 1) means in a model, or None."""
    value: Any = model
    for part in re.findall(r"[A-Za-z_]\w*|\[[\d,\s]+\]", name):
        if part.startswith("["):
            for index in part[1:-1].split(","):
                if not isinstance(value, Sequence) or not 1 <= int(index) <= len(
                    cast(Sequence[Any], value)
                ):
                    return None
                value = value[int(index) - 1]
        elif isinstance(value, Component):
            value = _read_attribute(value, part)
        elif isinstance(value, Connector) and part in value.declarations:
            value = getattr(value, part)
        else:
            return None
    return None if value is model else value


def _read_attribute(component: Component, name: str) -> Any:
    if name in component._children or name in component._declared or name in component.__dict__:
        if name.startswith("_"):
            return None
        return getattr(component, name)
    return None


def _hint(model: Component, text: str) -> str:
    head, _, tail = text.rpartition(".")
    owner = _attribute(model, head) if head else model
    if isinstance(owner, Component):
        return nearest(tail, [*(n for n, _ in owner._declarations()), *owner._children])
    return nearest(text.partition(".")[0], model._children)


def _within(where: str, action: Callable[[], Any]) -> Any:
    """Run an action; an error about the model begins with the place in the file."""
    try:
        return action()
    except NetlistError:
        raise
    except ModelError as error:
        raise NetlistError(f"{where}: {error}") from None


def _assign(model: Netlist, name: str, value: Any, where: str) -> None:
    if not IDENTIFIER.fullmatch(name) or name.startswith("_"):
        raise NetlistError(
            f"{where}: '{name[:80]}' is no name; letters, digits and underscores, beginning with a letter"
        )
    _within(where, lambda: setattr(model, name, value))


def _number(raw: int | float) -> int | float:
    if not np.isfinite(float(raw)) if abs(raw) < 1e300 else True:
        raise DeclarationError("not a finite number of reasonable size")
    return raw


def _is_start(value: Any) -> bool:
    return isinstance(value, Mapping) and any(k in START_KEYS for k in value)


def _object(document: Mapping[str, Any], key: str, where: str) -> Mapping[str, Any]:
    value = document.get(key, {})
    if not isinstance(value, Mapping):
        raise NetlistError(f"{where}: '{key}' is an object {{name: ...}}, not {_kind(value)}")
    return cast(Mapping[str, Any], value)


def _list(document: Mapping[str, Any], key: str, where: str) -> list[Any]:
    value = document.get(key, [])
    if not isinstance(value, list):
        raise NetlistError(f"{where}: '{key}' is a list, not {_kind(value)}")
    return cast(list[Any], value)


def _kind(value: Any) -> str:
    names = {
        dict: "an object",
        list: "a list",
        str: f"the text '{str(value)[:40]}'",
        type(None): "nothing",
    }
    return names.get(type(value), f"{value!r:.40}")


# -- writing -----------------------------------------------------------------------------------------


class _Writer:
    """Writes a component tree as a document."""

    def __init__(self, libraries: tuple[Library, ...]) -> None:
        self.libraries = libraries

    def model(self, model: Component) -> dict[str, Any]:
        """The document of a composite."""
        if type(model).equations not in (Component.equations, Netlist.equations):
            raise NetlistError(f"{model._label()} states equations of its own; put its class into a library")
        title = model._title if isinstance(model, Netlist) else type(model).__name__
        document: dict[str, Any] = {"model": title}
        if isinstance(model, Netlist):
            document |= {k: v for k, v in model.document.items() if k in ("start_time", "stop_time", "compare")}
        sections = {
            "parameters": self._parameters(model),
            "connectors": self._connectors(model),
            "components": {name: self._part(model, name, part) for name, part in model._children.items()},
            "connections": [[_path(model, end) for end in pair] for pair in model._connections],
            "initial_equations": self._initial(model),
        }
        document |= {key: section for key, section in sections.items() if section}
        if isinstance(model, Netlist):
            document |= {k: v for k, v in model.document.items() if k not in document}
        return document

    def _parameters(self, model: Component) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for name, declared in model._declarations():
            if isinstance(declared, Parameter):
                value = model._modifiers.get(name, declared.default)
                found[name] = self._text(model, "", name, value, value)
            elif isinstance(model, Netlist) and name in model._steady:
                found[name] = model._texts["", name][0]
        constants = model._texts.items() if isinstance(model, Netlist) else ()
        found |= {n: raw for (part, n), (raw, _) in constants if not part and n not in found}
        return found

    def _connectors(self, model: Component) -> dict[str, str]:
        return {
            name: self._class(type(declared), f"{model._label()}.{name}")
            for name, declared in model._declarations()
            if isinstance(declared, Connector)
        }

    def _part(self, model: Component, name: str, part: Component) -> dict[str, Any]:
        known = any(library.name_of(type(part)) for library in self.libraries)
        if isinstance(part, Netlist) or (not known and part._children):
            return self.model(part)
        entry: dict[str, Any] = {"class": self._class(type(part), part._label())}
        given = {**part._options, **part._modifiers}
        texts = model._texts if isinstance(model, Netlist) else {}
        order = [key for owner, key in texts if owner == name]
        modifiers: dict[str, Any] = {}
        for key in dict.fromkeys((*order, *given)):
            modifiers[key] = self._text(model, name, key, given.get(key), given.get(key))
        if modifiers:
            entry["with"] = modifiers
        return entry

    def _text(self, model: Component, part: str, key: str, value: Any, current: Any) -> Any:
        """A modifier as JSON: as it stood in the file where it is unchanged."""
        texts = model._texts if isinstance(model, Netlist) else {}
        if (part, key) in texts and texts[part, key][1] is current:
            return texts[part, key][0]
        return self._json(model, value, f"{part}.{key}".lstrip("."))

    def _json(self, model: Component, value: Any, where: str) -> Any:
        match value:
            case Start():
                pairs = ((k, getattr(value, v)) for k, v in START_KEYS.items())
                return {k: self._json(model, v, where) for k, v in pairs if v is not None}
            case np.ndarray():
                return self._json(model, value.tolist(), where)
            case list() | tuple():
                return [self._json(model, v, where) for v in cast(Sequence[Any], value)]
            case sp.Expr() if value.is_number:
                return float(value)
            case sp.Expr():
                names = {r: sp.Symbol(_path(model, r)) for r in references(value)}
                return written(value.xreplace(names))
            case None | bool() | int() | float() | str():
                return value
            case _:
                raise NetlistError(f"{model._label()}: {where} = {value!r:.60} cannot be written to a file")

    def _initial(self, model: Component) -> list[str]:
        if isinstance(model, Netlist):
            return [text for text, _ in model._initial]
        stated = list(model.initial_equations())
        if stated:
            raise NetlistError(f"{model._label()} states initial equations of its own; put its class into a library")
        return []

    def _class(self, cls: type, where: str) -> str:
        for library in self.libraries:
            name = library.name_of(cls)
            if name is not None:
                return name
        raise NetlistError(f"{where}: class {cls.__name__} is in no library; pass libraries=[...]")


def _path(model: Component, end: Any) -> str:
    """Dotted name of an endpoint or reference, seen from a model."""
    owner, local = (end.owner, end.path) if isinstance(end, Reference) else (end._owner, end._name)
    names = [local]
    while owner is not model and owner is not None:
        names.append(owner._name)
        owner = owner._parent
    return ".".join(reversed(names))
