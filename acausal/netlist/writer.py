"""Write: a component tree becomes a netlist document.

Whatever was read from a file and not changed is written as the file had it. A part whose class is in a library is
written as the name of the class and the modifiers that differ from a new instance; any other part as a subsystem.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, cast

import numpy as np
import sympy as sp

from acausal.errors import ModelError, shown
from acausal.modeling import (
    Component,
    Connector,
    InitialParameter,
    Input,
    Module,
    Option,
    Output,
    Parameter,
    Start,
    Variable,
    inherited,
    owner_and_name,
    references,
)
from acausal.netlist.file import EXPERIMENT_KEYS, NetlistError, within
from acausal.netlist.library import Library
from acausal.netlist.model import START_KEYS, FileRecord, Netlist, arguments_of, state
from acausal.netlist.printer import written

LEADING = ("start_time", "stop_time", "compare")
"""Keys of an experiment that come before the model."""


class Writer:
    """Writes a component tree as a document."""

    def __init__(self, libraries: tuple[Library, ...]) -> None:
        self.libraries = libraries

    def model(
        self, model: Component, stated: Mapping[str, Any] = MappingProxyType({})
    ) -> dict[str, Any]:
        """The document of a composite.

        Arguments:
            stated: modifiers of its parts that are already in the file of the enclosing model.

        Raises:
            NetlistError: in one sentence, for what a file cannot hold.
        """
        file, is_read = _file(model), isinstance(model, Netlist)
        if not is_read:
            _check_statements(model)
        experiment = file.experiment
        connectors = self._connectors(model)
        placed = {n: {"class": connectors.pop(n)} for n in file.placed}
        parts = {
            name: self._part(model, name, part, _inner(stated, name))
            for name, part in model._node.children.items()
        }
        sections = {
            "parameters": self._parameters(model),
            "connectors": connectors,
            "variables": self._variables(model),
            "components": {**placed, **parts},
            "connections": _connections(model),
            "equations": [text for text, _ in file.equations],
            "initial_equations": [text for text, _ in file.initial],
        }
        document: dict[str, Any] = {}
        if not is_read or model._node.title:
            document["model"] = model._node.title or type(model).__name__
        document |= {key: experiment[key] for key in LEADING if key in experiment}
        document |= {key: section for key, section in sections.items() if section}
        return document | {key: experiment[key] for key in EXPERIMENT_KEYS if key in experiment}

    def part(self, model: Component, name: str) -> dict[str, Any]:
        """The entry of one part: its class and modifiers."""
        return self._part(model, name, model._node.children[name], {})

    # -- declarations of a model ---------------------------------------------------------------------

    def _parameters(self, model: Component) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for (part, name), (raw, before) in _file(model).texts.items():
            if not part:
                kept = _same(before, state(model, name))
                found[name] = raw if kept else self._parameter(model, name)
        for name, declared in model._node.declarations():
            if isinstance(declared, Parameter | InitialParameter) and name not in found:
                found[name] = self._parameter(model, name)
        return found

    def _parameter(self, model: Component, name: str) -> Any:
        declared = model._node.declaration(name)
        if isinstance(declared, InitialParameter):
            guess = model._node.modifiers.get(name, Start()).value
            unit = {"unit": declared.unit} if declared.unit else {}
            start = self._json(model, declared.start if guess is None else guess, name)
            return {"start": start, "fixed": False, **unit}
        if not isinstance(declared, Parameter):
            return self._json(model, model._node.constants[name], name)
        value = model._node.modifiers.get(name, declared.default)
        if not lies_within(
            model, value
        ):  # given from outside: it is written with the enclosing model
            value = declared.default
        if callable(value) and not isinstance(value, sp.Expr):
            value = value(model)
        text = None if value is None else self._json(model, value, name)
        attributes = {
            key: given
            for key in ("unit", "min", "max")
            if (given := getattr(declared, key)) not in ("", None)
        }
        return (
            {"=": text, **attributes}
            if attributes and declared.shape is None and text is not None
            else text
        )

    def _variables(self, model: Component) -> dict[str, Any]:
        """The variables of the file, with the starts that they have now."""
        found: dict[str, Any] = {}
        for name, (raw, before) in _file(model).variables.items():
            start = model._node.modifiers.get(name)
            if _same(before, state(model, name)) or not isinstance(start, Start):
                found[name] = raw
            else:
                found[name] = {**raw, **self._start(model, start, f"{model._node.label}.{name}")}
        return found

    def _connectors(self, model: Component) -> dict[str, Any]:
        found, known = dict[str, Any](), _file(model).class_names
        for name, declared in model._node.declarations():
            where = f"{model._node.label}.{name}"
            if isinstance(declared, Connector):
                found[name] = self._class(type(declared), where, known.get(name))
            elif isinstance(declared, Input | Output) and declared.shape is None:
                role = Input if isinstance(declared, Input) else Output
                kind = self._class(role, where, known.get(name))
                found[name] = {"class": kind, "unit": declared.unit} if declared.unit else kind
            elif isinstance(declared, InitialParameter):
                pass  # a parameter of the file
            elif isinstance(declared, Variable | Module) and not isinstance(model, Netlist):
                raise NetlistError(
                    f"{where}: a file holds parts, parameters and scalar signals; "
                    f"put {type(model).__name__} into a library"
                )
        return found

    # -- parts ---------------------------------------------------------------------------------------

    def _part(
        self, model: Component, name: str, part: Component, stated: Mapping[str, Any]
    ) -> dict[str, Any]:
        texts = _file(model).texts
        cls = None if isinstance(part, Netlist) else self._public(type(part))
        if cls is not None:
            known = _file(model).class_names.get(name)
            entry: dict[str, Any] = {"class": self._class(cls, part._node.label, known)}
            changed = self._modifiers(model, part, cls, stated)
        elif part._node.children:
            kept = {
                key: raw
                for (owner, key), (raw, before) in texts.items()
                if owner == name and _same(before, state(part, key))
            }
            entry = self.model(part, {**stated, **kept})
            changed = {
                key: self._json(model, value, f"{part._node.label}.{key}")
                for key, value in part._node.modifiers.items()
                if not lies_within(part, value)
            }
        else:
            self._class(type(part), part._node.label)
            raise AssertionError
        given: dict[str, Any] = {}
        for key in dict.fromkeys((*(k for owner, k in texts if owner == name), *changed)):
            kept = (name, key) in texts and _same(texts[name, key][1], state(part, key))
            if kept:
                given[key] = texts[name, key][0]
            elif key in changed:
                given[key] = changed[key]
        if (spot := part._node.placement) is not None:
            turned = {"turned": spot.turned} if spot.turned else {}
            mirrored = {"mirrored": True} if spot.mirrored else {}
            entry = {**entry, "place": {"x": spot.x, "y": spot.y, **turned, **mirrored}}
        return {**entry, "with": given} if given else entry

    def _modifiers(
        self, model: Component, part: Component, cls: Any, stated: Mapping[str, Any]
    ) -> dict[str, Any]:
        """The modifiers that a new instance of the class needs to equal a part."""
        made = _file(model).arguments.get(part._node.name)
        arguments = made or self._arguments(part, cls)
        try:
            fresh = cls(**arguments)
        except Exception:  # an exception of the library's own code
            raise _unwritable(part) from None
        found = {
            key: self._json(model, value, f"{part._node.label}.{key}", cls._declared.get(key))
            for key, value in arguments.items()
            if not isinstance(cls._declared.get(key), Option) or value != cls._declared[key].default
        }
        return found | self._differences(model, part, fresh, (part, fresh), stated)

    def _arguments(self, part: Component, cls: Any) -> dict[str, Any]:
        """Arguments to make a part with: its options, vectors, and constants named as arguments of the class."""
        found = dict(part._node.options)
        for name, value in part._node.modifiers.items():
            declared = cls._declared.get(name)
            vector = isinstance(declared, Parameter) and declared.shape is not None
            if vector and not (_is_own(part, value) or _is_inherited(part, name, value)):
                found[name] = value
        for name, default in arguments_of(cls).items():
            value = part._node.constants.get(name, default)
            if _comparable(part, value) != _comparable(part, default):
                found[name] = value
        return found

    def _differences(
        self,
        model: Component,
        part: Component,
        fresh: Component,
        roots: tuple[Component, Component],
        stated: Mapping[str, Any],
    ) -> dict[str, Any]:
        """Modifiers that make a new part, and the parts within, equal to this one."""
        alike = [(n, type(c)) for n, c in part._node.children.items()] == [
            (n, type(c)) for n, c in fresh._node.children.items()
        ]
        constants = [
            _comparable(root, c._node.constants)
            for root, c in zip(roots, (part, fresh), strict=True)
        ]
        if (
            not alike
            or len(part._node.connections) != len(fresh._node.connections)
            or constants[0] != constants[1]
        ):
            raise _unwritable(part)
        found: dict[str, Any] = {}
        given = {**part._node.options, **part._node.modifiers}
        before = {**fresh._node.options, **fresh._node.modifiers}
        for key, value in given.items():
            if key in stated or key.partition(".")[0] in stated:
                continue
            if _is_inherited(part, key, value):
                continue
            if key in before and _comparable(roots[0], value) == _comparable(roots[1], before[key]):
                continue
            text = self._json(model, value, f"{part._node.label}.{key}", part._declared.get(key))
            connector, _, variable = key.partition(".")
            if variable:
                found.setdefault(connector, {})[variable] = text
            else:
                found[key] = text
        for name, child in part._node.children.items():
            inner = self._differences(
                model, child, fresh._node.children[name], roots, _inner(stated, name)
            )
            if inner:
                found[name] = inner
        return found

    def _public(self, cls: Any) -> Any:
        """The class, if it is in a library."""
        return cls if any(library.name_of(cls) for library in self.libraries) else None

    def _class(self, cls: type, where: str, known: str | None = None) -> str:
        """The name of a class; the one in the file, if it is still a name of that class."""
        for library in self.libraries:
            if known is not None and library.find(known) is cls:
                return known
            name = library.name_of(cls)
            if name is not None:
                return name
        raise NetlistError(f"{where}: class {cls.__name__} is in no library; pass libraries=[...]")

    # -- values --------------------------------------------------------------------------------------

    def _json(self, model: Component, value: Any, where: str, declared: Any = None) -> Any:
        match value:
            case bool() | int() | float():
                return value
            case str():
                choices = declared.choices if isinstance(declared, Option) else None
                return value if value in (choices or ()) else f'"{value}"'
            case Start():
                return self._start(model, value, where)
            case np.ndarray():
                return self._json(model, value.tolist(), where)
            case list() | tuple():
                return [self._json(model, v, where) for v in cast(Sequence[Any], value)]
            case sp.Expr() if value.is_number:
                return float(value)
            case sp.Expr():
                names = {r: sp.Symbol(_path(model, r, where), real=True) for r in references(value)}
                return within(where, lambda: written(value.xreplace(names)))
            case type():
                return self._class(value, where)
            case _ if isinstance(declared, Module):
                raise NetlistError(
                    f"{where}: a file cannot hold a network; save the model without it and give it after loading, "
                    f"by modify({where.rpartition('.')[2]}=...)"
                )
            case _:
                for library in self.libraries:
                    name = library.constant_name(value)
                    if name is not None:
                        return name
                raise NetlistError(f"{where}: a file cannot hold {shown(value)}")

    def _start(self, model: Component, start: Start, where: str) -> dict[str, Any]:
        given = {key: getattr(start, name) for key, name in START_KEYS.items()}
        state = {"stateSelect": f"StateSelect.{start.state}"} if start.state is not None else {}
        return {
            key: self._json(model, value, where)
            for key, value in given.items()
            if value is not None and key != "stateSelect"
        } | state


def _inner(stated: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    inner = stated.get(name, {})
    return cast(Mapping[str, Any], inner) if isinstance(inner, Mapping) else {}


def _file(model: Component) -> FileRecord:
    """What is known of the file of a model; nothing of one that was not read from one."""
    return model._file if isinstance(model, Netlist) else FileRecord()


def _check_statements(model: Component) -> None:
    for stated in (model.equations, model.initial_equations):
        if next(iter(stated()), None) is not None:
            raise NetlistError(
                f"{model._node.label} states equations of its own, which a file cannot hold; "
                "put its class into a library, or the equations into a part of a library"
            )


def _connections(model: Component) -> list[list[str]]:
    """The connections of the file, then those that were made since."""
    wires, where = _file(model).wires, model._node.label
    count = sum(made for _, made in wires)
    since = model._node.connections[count:]
    return [
        *(list(pair) for pair, _ in wires),
        *([_path(model, end, where) for end in pair] for pair in since),
    ]


def _path(model: Component, end: Any, where: str) -> str:
    """Dotted name of an endpoint or reference, seen from a model.

    Raises:
        NetlistError: if it lies outside of the model.
    """
    owner, local = owner_and_name(end)
    route = None if owner is None else owner.route_from(model._node)
    if route is None:
        raise NetlistError(f"{where} refers to '{local}', which is not part of {model._node.label}")
    return ".".join((*route, local))


def lies_within(model: Component, value: Any) -> bool:
    """Whether all references of a value lie within a model."""
    if isinstance(value, np.ndarray):
        return all(lies_within(model, v) for v in value.flat)
    if isinstance(value, list | tuple):
        return all(lies_within(model, v) for v in cast(Sequence[Any], value))
    if not isinstance(value, sp.Expr):
        return True
    return all(r.owner.route_from(model._node) is not None for r in references(value))


def _is_inherited(part: Component, name: str, value: Any) -> bool:
    """Whether the value is the one that a part takes from around it, so that a file need not give it."""
    outer = inherited(part, name) if name in part.OUTER else None
    return outer is not None and np.array_equal(np.ravel(value), np.ravel(outer))


def _is_own(part: Component, value: Any) -> bool:
    """Whether a value is computed from the part's own parameters: what its class makes, no argument of it."""
    found = [v for v in np.ravel(value) if isinstance(v, sp.Expr) and references(v)]
    return bool(found) and all(r.owner is part._node for v in found for r in references(v))


def _comparable(root: Component, value: Any) -> Any:
    """A value with names in the place of references, so that the values of equal parts are equal."""
    match value:
        case sp.Expr() if lies_within(root, value):
            names = {r: sp.Symbol(_path(root, r, "")) for r in references(value)}
            return value.xreplace(names)
        case list() | tuple() | np.ndarray():
            return [_comparable(root, v) for v in cast(Sequence[Any], value)]
        case dict():
            return {k: _comparable(root, v) for k, v in cast(dict[str, Any], value).items()}
        case _:
            return value


def _same(before: Sequence[Any], now: Sequence[Any]) -> bool:
    return len(before) == len(now) and all(a is b for a, b in zip(before, now, strict=True))


def _unwritable(part: Component) -> ModelError:
    return NetlistError(
        f"{part._node.label} was made with arguments that a file cannot hold; give modifiers instead, or take its "
        "class out of the library, so that it is written as a subsystem"
    )
