"""Modifiers: values, options, modules and starts are checked, and recorded in the component's node."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields
from typing import Any, cast

import numpy as np
import sympy as sp

from acausal.errors import DeclarationError, is_whole, nearest, shown
from acausal.modeling.budget import check_nested, check_size
from acausal.modeling.connector import Connector
from acausal.modeling.declarations import (
    Declaration,
    DependentParameter,
    InitialParameter,
    Module,
    Option,
    Parameter,
    Start,
    Variable,
    is_number,
)
from acausal.modeling.node import Node
from acausal.modeling.symbols import Eq, ModuleReference, Reference


def record_modifier(
    node: Node[Any], name: str, declared: Declaration | Connector, value: Any
) -> None:
    """Check a modifier, and record it in the node.

    Raises:
        DeclarationError: for a value of the wrong kind or range, or outside an option's choices.
    """
    where = f"{node.label}.{name}"
    match declared:
        case Connector():
            if not isinstance(value, Mapping):
                raise DeclarationError(f"{where} is a connector; modify its variables by a mapping")
            for key, start in cast(Mapping[str, Any], value).items():
                if key not in declared.declarations:
                    raise DeclarationError(
                        f"{where} has no '{key}': {nearest(key, declared.declarations)}"
                    )
                _merge_start(node, f"{name}.{key}", start_of(f"{where}.{key}", start))
        case Option():
            if isinstance(value, str) and f"'{value}'" in (declared.choices or ()):
                value = f"'{value}'"  # a name of Modelica that stands in quotes, such as '1'
            if declared.choices is not None and value not in declared.choices:
                choices = ", ".join(map(repr, declared.choices))
                raise DeclarationError(f"{where}={shown(value)} must be one of {choices}")
            if isinstance(declared.default, bool) and not isinstance(value, bool):
                raise DeclarationError(f"{where}={shown(value)}: True or False is needed")
            if is_whole(declared.default) and not is_whole(value):
                raise DeclarationError(f"{where}={shown(value)}: a whole number is needed")
            if declared.min is not None and int(value) < declared.min:
                raise DeclarationError(f"{where}={value} is out of range: at least {declared.min}")
            node.options[name] = value
        case Variable():
            _merge_start(node, name, start_of(where, value))
        case Module():
            if not callable(value) and not isinstance(value, ModuleReference):
                raise DeclarationError(
                    f"{where} needs a module or a function key -> module, got {shown(value)}"
                )
            node.modifiers[name] = value
        case Parameter() if is_open(value):
            _make_unknown(node, name, declared, value)
        case Parameter():
            node.modifiers[name] = value_of(where, declared, value)
            if declared.shape is not None:  # its size may have changed
                vars(node.component).pop(name, None)
                if name in node.own_declarations:
                    node.read(declared)
        case _:
            raise DeclarationError(f"{where} cannot be modified")


def _make_unknown(node: Node[Any], name: str, declared: Parameter, value: Start | sp.Expr) -> None:
    """Turn a parameter into an unknown: initialization determines it, or it depends on such a parameter."""
    unit, doc = declared.unit, declared.doc
    attributes = vars(node.component)
    attributes.pop(name, None)
    if isinstance(value, Start):
        guess = declared.default if value.value is None else value.value
        attributes[name] = node.declare(name, InitialParameter(0.0, unit=unit, doc=doc))
        _merge_start(node, name, start_of(f"{node.label}.{name}", Start(guess, fixed=False)))
    else:
        attributes[name] = node.declare(name, DependentParameter(unit=unit, doc=doc))
        owner = next(r.owner for r in value.free_symbols if isinstance(r, Reference))
        owner.bindings.append(Eq(attributes[name], value))
        node.modifiers[name] = value


def _merge_start(node: Node[Any], name: str, start: Start) -> None:
    """Record a variable's attributes; those that this modifier leaves open keep their earlier values."""
    earlier = node.modifiers.get(name, Start())
    node.modifiers[name] = Start(
        **{
            f.name: v if (v := getattr(start, f.name)) is not None else getattr(earlier, f.name)
            for f in fields(Start)
        }
    )


def start_of(where: str, value: Any) -> Start:
    """The start that a modifier gives: a `Start`, or a mapping of its attributes."""
    if isinstance(value, Start):
        try:
            elements = np.ravel(np.asarray(value.value, dtype=object))
        except TypeError:  # of one of JAX's keys
            elements = ["a key"]
        for element in elements:
            _check_start(where, element)
        return value
    if isinstance(value, Mapping):
        try:
            return start_of(where, Start(**value))
        except TypeError:
            raise DeclarationError(
                f"{where}: a start has value, fixed, nominal and state"
            ) from None
    raise DeclarationError(f"{where} is a variable; give its start as ac.Start({shown(value)})")


def _check_start(where: str, value: Any) -> None:
    """A start is a finite number or an expression of parameters."""
    if value is None:
        return
    if isinstance(value, sp.Expr) and not value.is_number:
        if _reads_parameters_alone(value):
            return
        raise DeclarationError(f"{where}: only parameters may stand in a start, got {value}")
    if isinstance(value, bool) or not is_number(value):
        raise DeclarationError(f"{where}: a start is a finite number, got {shown(value)}")


def _reads_parameters_alone(value: sp.Expr) -> bool:
    symbols = value.free_symbols
    return all(isinstance(r, Reference) and isinstance(r.declaration, Parameter) for r in symbols)


def is_open(value: Any) -> bool:
    """Whether initialization determines a parameter: by `Start(..., fixed=False)`, or through others of that kind."""
    if isinstance(value, Start):
        return value.fixed is False
    return isinstance(value, sp.Expr) and any(
        isinstance(r, Reference)
        and isinstance(r.declaration, InitialParameter | DependentParameter)
        for r in value.free_symbols
    )


def value_of(where: str, declaration: Parameter, value: Any) -> Any:
    """The value that a modifier gives: a finite number in range, an expression of parameters, or an array of these.

    The size of an array is checked when the model is flattened.
    """
    if declaration.shape is None:
        return _number(where, declaration, value)
    check_nested(value, where)
    values = np.asarray(value, dtype=object)
    check_size(values.size, where)
    checked = [_number(f"{where}[{i}]", declaration, v) for i, v in enumerate(values.flat, start=1)]
    result = np.empty(values.size, dtype=object)
    result[:] = checked
    return result.reshape(values.shape)


def _number(where: str, declaration: Parameter, value: Any) -> Any:
    if isinstance(value, sp.Expr) and not value.is_number:
        if not _reads_parameters_alone(value):
            raise DeclarationError(
                f"{where} = {value}: only parameters may stand in a parameter's value"
            )
        return value
    try:
        number = float("" if isinstance(value, str | bytes | bool) else value)
    except (TypeError, ValueError, OverflowError):
        raise DeclarationError(
            f"{where}={shown(value)}: a number or an expression of parameters is needed"
        ) from None
    if not math.isfinite(number):
        raise DeclarationError(f"{where}={number}: a finite number is needed")
    low, high = declaration.min, declaration.max
    if (low is not None and number < low) or (high is not None and number > high):
        bound = f"at least {low:g}" if low is not None and number < low else f"at most {high:g}"
        raise DeclarationError(
            f"{where}={number:g} is out of range: {bound} {declaration.unit}".rstrip()
        )
    return number
