"""Parts whose class is one of a library: made and modified as a netlist does, with values in place of texts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sp

from acausal.errors import ModelError
from acausal.modelica.functions import Interpreter
from acausal.modelica.meanings import Literal
from acausal.modelica.modifications import Given, Modification
from acausal.modelica.resources import found_file
from acausal.modelica.syntax import ArrayConstructor
from acausal.modelica.values import each, nested, of
from acausal.modeling import Component, Eq, Option, Variable, check_nested, element_name
from acausal.netlist import NetlistError, Scope, evaluated, is_structural, make, modify

RENAMED = {"freqHz": "f"}
"""Name of a parameter in version 3.2.3 of the Modelica Standard Library -> its name since 4.0.0."""


class ModifierValues(Scope):
    """The values of modifiers, which are evaluated already."""

    def __init__(self) -> None:
        """No model: expressions are looked up where they stand."""

    def value(self, raw: Any, where: str) -> Any:
        """The value itself; that of an object with attributes."""
        found = raw.get("=") if isinstance(raw, Mapping) else raw
        if isinstance(found, list):
            check_nested(found, "the list")
        return found

    def argument(self, raw: Any, where: str) -> Any:
        """The value itself."""
        return self.value(raw, where)

    def bind(self, equation: Eq) -> None:
        """Refuse an equation deep within a part of a library."""
        raise NetlistError(f"{equation.lhs}: give this variable its value by an equation")


def make_part(cls: Any, given: Sequence[Given], base: Any = None) -> Any:
    """An instance of a class of a library, with the modifiers that it must be made with.

    ``base`` is the constructor to call for an instance of a class that extends libraries' classes.
    """
    if base is not None:
        cls = next(c for c in cls.__mro__ if not hasattr(c, "_class"))
    raw: dict[str, Any] = {}
    first: Given | None = None
    stated = grouped(given, cls)
    for name, (mod, one) in stated.items():
        if is_structural(cls, name):
            first = first or one
            raw[name] = _structural(cls, name, mod)
        elif mod.value is not None and isinstance(mod.value.expression, ArrayConstructor):
            shape = getattr(cls._declared.get(name), "shape", None) or ()
            if len(shape) == 1 and isinstance(shape[0], str):  # an open size is that of the value
                raw.setdefault(shape[0], len(mod.value.expression.items))
    file = stated["fileName"] if raw.get("tableOnFile") and "fileName" in raw else None
    if file and file[0].value and isinstance(raw["fileName"], str):
        raw["fileName"] = found_file(raw["fileName"], file[0].value.frame, file[1].wrong)
    try:
        return make(ModifierValues(), cls, raw, cls.__name__, cls.__name__, base)[0]
    except ModelError as error:
        if first is None:
            raise
        raise first.wrong(str(error)) from None


def _structural(cls: Any, name: str, mod: Modification) -> Any:
    value, declared = _raw(mod), cls._declared.get(name)
    if isinstance(declared, Option) and isinstance(value, sp.Basic) and mod.value is not None:
        value = Interpreter(mod.value.frame).known(value, f"'{name}'")
    return value


def modify_part(build: Any, part: Component, given: Sequence[Given]) -> None:
    """Apply the other modifiers; a value for a variable becomes an equation of the class that states it."""
    cls = type(part)
    for name, (mod, one) in grouped(given, cls).items():
        declared = part._node.declaration(name)
        native = next(c for c in cls.__mro__ if not hasattr(c, "_class"))
        if is_structural(native, name):
            continue
        if isinstance(declared, Variable) and mod.value is not None:
            bind(build, part, name, mod)
            if not mod.inner:
                continue
        _placed(one, part, name, _raw(mod))


def modify_connector(build: Any, name: str, given: Sequence[Given]) -> None:
    """Apply modifiers to a connector of a component."""
    for variable, (mod, one) in grouped(given).items():
        if of(of_path(build, name), variable) is None:
            raise one.wrong(f"'{name}' has no '{variable}'")
        bind(build, build.component, f"{name}.{variable}", mod)
        if mod.inner:
            known = of(of_path(build, name), variable)
            _placed(one, build.component, name, dict(_element_values(variable, known, _raw(mod))))


def _element_values(name: str, variable: Any, raw: Any) -> Iterator[tuple[str, Any]]:
    """The attributes of a variable of a connector; of an array those of its elements."""
    if not isinstance(variable, np.ndarray):
        yield name, raw
        return
    for place in np.ndindex(variable.shape):
        yield element_name(name, place), {k: _at(v, place) for k, v in raw.items()}


def _at(value: Any, place: tuple[int, ...]) -> Any:
    for i in place:
        value = value[i] if isinstance(value, list) else value
    return value


def of_path(build: Any, name: str) -> Any:
    """The connector of a component by its name with indices."""
    return build.component._node.read(build.component._node.declaration(name))  # pyright: ignore[reportArgumentType]


def bind(build: Any, part: Component, path: str, mod: Modification) -> None:
    """Take the value of a variable as an equation, of the class in which its expression stands."""
    if mod.value is not None:
        owner: Any = mod.value.frame.build or build
        owner.bindings.append((part, path, mod.value))
        part._node.constants[f"given {path}"] = True
        mod.value = None


def grouped(given: Sequence[Given], cls: Any = None) -> dict[str, tuple[Modification, Given]]:
    """What each name gets, and the outermost argument for it; earlier names of a class's parameters become the present.

    Raises:
        ModelicaError: for a modifier of what is final, or a class that replaces one within a library's class.
    """
    found: dict[str, tuple[Modification, Given]] = {}
    for one in given:
        if one.redeclared is not None:
            raise one.wrong("a redeclaration within a class of the library is not supported")
        present = RENAMED.get(one.name, one.name)
        known = cls is not None and one.name not in cls._declared and present in cls._declared
        mod, first = found.setdefault(present if known else one.name, (Modification(), one))
        if one.final and first is not one:
            raise first.wrong(f"'{one.name}' is final")
        mod.add(one.modifier, one.frame, one.index)
    return found


def _raw(mod: Modification) -> Any:
    """The value of a modifier as a netlist has it: a value, or an object of attributes."""
    value = None if mod.value is None else nested(mod.value.value())
    if not mod.inner:
        return value
    rest = {name: _raw(inner) for name, (inner, _) in grouped(mod.inner).items()}
    decide_nominal(rest)
    if isinstance(rest.get("start"), Literal):
        rest["start"] = rest["start"].number
    return rest if value is None else {"=": value, **rest}


def decide_nominal(stated: dict[str, Any]) -> None:
    """Make a nominal value among attributes a number; one that parameters do not decide is left out."""

    def number(v: Any) -> Any:
        return evaluated(v, "a nominal value", {}) if isinstance(v, sp.Expr) else v

    try:
        stated["nominal"] = each(number, stated["nominal"])
    except (KeyError, ModelError, TypeError):
        stated.pop("nominal", None)


def _placed(one: Given, part: Component, name: str, raw: Any) -> None:
    try:
        modify(ModifierValues(), part, name, raw, name)
    except ModelError as error:
        raise one.wrong(str(error)) from None
