"""What may be given as a modifier: values of parameters and starts of variables, checked."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import sympy as sp

from acausal.errors import DeclarationError
from acausal.modeling.declarations import (
    DependentParameter,
    InitialParameter,
    Parameter,
    Reference,
    Start,
)


def start_of(where: str, value: Any) -> Start:
    """A start as given: a `Start`, or a mapping of its attributes."""
    if isinstance(value, Start):
        for element in np.ravel(np.asarray(value.value, dtype=object)):
            _check_start(where, element)
        return value
    if isinstance(value, Mapping):
        try:
            return start_of(where, Start(**value))
        except TypeError:
            raise DeclarationError(
                f"{where}: a start has value, fixed, nominal and state"
            ) from None
    raise DeclarationError(f"{where} is a variable; give its start as ac.Start({value!r})")


def _check_start(where: str, value: Any) -> None:
    """A start is a finite number or an expression of parameters."""
    if value is None:
        return
    if isinstance(value, sp.Expr) and not value.is_number:
        if all(
            isinstance(r, Reference) and isinstance(r.declaration, Parameter)
            for r in value.free_symbols
        ):
            return
        raise DeclarationError(f"{where}: only parameters may stand in a start, got {value}")
    if isinstance(value, str) or not _is_finite(value):
        raise DeclarationError(f"{where}: a start is a finite number, got {value!r}")


def _is_finite(value: Any) -> bool:
    try:
        return math.isfinite(float(value))
    except (TypeError, ValueError):
        return False


def is_open(value: Any) -> bool:
    """Whether a parameter is given as found at the initial time, or by an expression of such ones."""
    if isinstance(value, Start):
        return value.fixed is False
    return isinstance(value, sp.Expr) and any(
        isinstance(r, Reference)
        and isinstance(r.declaration, InitialParameter | DependentParameter)
        for r in value.free_symbols
    )


def value_of(where: str, declaration: Parameter, value: Any) -> Any:
    """A parameter's value as given: a finite number in range, an expression of parameters, or an array of these."""
    if declaration.shape is not None:
        return values_of(where, declaration, value)
    return _number(where, declaration, value)


def values_of(where: str, declaration: Parameter, value: Any) -> np.ndarray:
    """A vector or matrix of values; its size is checked when the sizes are settled."""
    values = np.asarray(value, dtype=object)
    checked = [_number(f"{where}[{i}]", declaration, v) for i, v in enumerate(values.flat, start=1)]
    result = np.empty(values.size, dtype=object)
    result[:] = checked
    return result.reshape(values.shape)


def _number(where: str, declaration: Parameter, value: Any) -> Any:
    if isinstance(value, sp.Expr) and not value.is_number:
        foreign = [r for r in value.free_symbols if not isinstance(r, Reference)]
        unsteady = [
            r
            for r in value.free_symbols
            if isinstance(r, Reference) and not isinstance(r.declaration, Parameter)
        ]
        if foreign or unsteady:
            raise DeclarationError(
                f"{where} = {value}: only parameters may stand in a parameter's value"
            )
        return value
    try:
        number = float("" if isinstance(value, str | bool) else value)
    except (TypeError, ValueError):
        raise DeclarationError(
            f"{where}={value!r}: a number or an expression of parameters is needed"
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
