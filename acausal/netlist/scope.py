"""The values of a netlist, read within one model: expressions, classes, options and starts."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, cast

import numpy as np
import sympy as sp

from acausal.errors import is_whole, shortened
from acausal.modeling import (
    STATE_SELECT,
    Eq,
    Option,
    Parameter,
    Reference,
    Start,
    check_nested,
    time,
)
from acausal.netlist import library
from acausal.netlist.file import NetlistError, kind, need_keys, within
from acausal.netlist.library import Library
from acausal.netlist.model import START_KEYS, Netlist, attribute
from acausal.netlist.parser import parse

IGNORED_KEYS = ("displayUnit", "unit", "quantity", "min", "max")
"""Attributes of a modifier that change no result."""


class Scope:
    """Reads the values of one model of a file.

    Arguments:
        model: whose names expressions see.
        libraries: whose classes, records and enumerations they see.
    """

    def __init__(self, model: Netlist, libraries: tuple[Library, ...]) -> None:
        self.model, self.libraries = model, libraries

    def lookup(self, name: str) -> Any:
        """The value of a name in an expression.

        Raises:
            KeyError: if there is none.
        """
        value = attribute(self.model, name)
        if value is not None:
            return value
        for known in self.libraries:
            value = known.constant(name)
            if value is not None:
                return value
        if name == "time":
            return time
        raise KeyError(name)

    def bind(self, equation: Eq) -> None:
        """Add the equation of a variable that the file gives a value."""
        self.model._file.bindings.append(equation)

    def find(self, name: Any, where: str) -> Any:
        """The class of that name."""
        if not isinstance(name, str):
            raise NetlistError(f"{where}: the name of a class is needed, not {kind(name)}")
        try:
            return library.find_class(self.libraries, name)
        except KeyError as error:
            hint = f"there is no class '{shortened(name)}'; {error.args[0]}"
            raise NetlistError(f"{where}: {hint}") from None

    def value(self, raw: Any, where: str) -> Any:
        """A number, truth value, list, or the value of an expression."""
        value = self._value(raw, where)
        if isinstance(value, list):
            within(where, lambda: check_nested(value, "the list"))
        return value

    def _value(self, raw: Any, where: str) -> Any:
        match raw:
            case bool() | int() | float():
                return raw
            case str():
                return within(where, lambda: parse(raw, self.lookup))
            case list():
                values = cast(list[Any], raw)
                return [self._value(v, f"{where}[{i}]") for i, v in enumerate(values)]
            case Mapping() if "=" in raw:
                return self._value(raw["="], where)
            case _:
                raise NetlistError(f"{where}: {kind(raw)} is not a value")

    def option(self, option: Option, raw: Any, where: str) -> Any:
        """The value of an option; one of its choices may be given without quotes."""
        if isinstance(raw, str) and raw in (option.choices or ()):
            return raw
        return _option_value(option, self.value(raw, where), where)

    def argument(self, raw: Any, where: str) -> Any:
        """An argument of a class: a class by its name, a value, or a list or an object of them."""
        if isinstance(raw, Mapping):
            each = cast(Mapping[str, Any], raw).items()
            return {n: self.argument(v, f"{where}.{shortened(n)}") for n, v in each}
        if isinstance(raw, list):
            items = cast(list[Any], raw)
            return [self.argument(item, f"{where}[{i}]") for i, item in enumerate(items)]
        if isinstance(raw, str):
            try:
                return library.find_class(self.libraries, raw)
            except KeyError:
                pass
        return self.value(raw, where)

    def start(self, raw: Any, where: str) -> Start:
        """The attributes of a variable."""
        if not isinstance(raw, Mapping):
            raise NetlistError(
                f'{where}: a variable\'s attributes are an object such as {{"start": 0}}, not {kind(raw)}'
            )
        values: dict[str, Any] = {}
        for key, given in cast(Mapping[str, Any], raw).items():
            if key in IGNORED_KEYS:
                continue
            need_keys([key], tuple(START_KEYS), where, "attribute")
            bare = key == "stateSelect" and given in STATE_SELECT
            value = given if bare else self.value(given, f"{where}.{key}")
            values[START_KEYS[key]] = _attribute(key, value, f"{where}.{key}")
        return within(where, lambda: Start(**values))


def _option_value(option: Option, value: Any, where: str) -> Any:
    """The value of an option: expressions of parameters are evaluated when the file is read."""
    if isinstance(value, list):
        return [_option_value(option, v, where) for v in cast(list[Any], value)]
    if isinstance(value, sp.Expr):
        value = evaluated(value, where, {})
    is_integer = isinstance(value, float) and value.is_integer()
    return int(value) if is_integer and is_whole(option.default) else value


def evaluated(expression: sp.Expr, where: str, values: dict[Any, Any]) -> float:
    """The number that parameters give; ``values`` are those known so far, None for one that is being evaluated."""
    for symbol in sorted(expression.free_symbols, key=str):
        if values.get(symbol) is not None:
            continue
        if not isinstance(symbol, Reference) or not isinstance(symbol.declaration, Parameter):
            raise NetlistError(
                f"{where}: '{symbol}' changes with time; a structural choice is fixed"
            )
        name, _, index = symbol.path.partition("[")
        given: Any = symbol.owner.modifiers.get(name, symbol.declaration.default)
        if index and np.ndim(given):
            given = np.asarray(given, dtype=object)[
                tuple(int(i) - 1 for i in index.removesuffix("]").split(","))
            ]
        if isinstance(given, sp.Expr) and symbol not in values:
            values[symbol] = None
            given = evaluated(given, where, values)
        if not isinstance(given, int | float):
            raise NetlistError(f"{where}: '{symbol}' has no number; a structural choice is fixed")
        values[symbol] = given
    return float(cast(Any, expression.xreplace(values)))


def _attribute(key: str, value: Any, where: str) -> Any:
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
