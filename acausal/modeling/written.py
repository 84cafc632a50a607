"""What an author wrote, as text: defaults, and declarations with those of their arguments that were given."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from functools import cache
from typing import Any

import sympy as sp

from acausal.errors import shortened


def default_text(default: Any) -> str:
    """A default as its author would write it; that of a function of the component is its formula."""
    if not callable(default) or isinstance(default, type):
        return shortened(" ".join(repr(default).split()))
    try:
        return shortened(default(_Names()))
    except Exception:  # any function of a user: one that needs more than names has no formula
        return "..."


class _Names:
    """A stand-in for a component, whose parameters are symbols."""

    def __getattr__(self, name: str) -> sp.Symbol:
        if name.startswith("_"):
            raise AttributeError(name)
        return sp.Symbol(name)


def call_text(made: object) -> str:
    """How an object is made, for its ``repr``: its class, and the arguments that differ from their defaults.

    Every argument must have an attribute of the same name.
    """
    given: list[str] = []
    for i, (name, kind, default) in enumerate(_arguments(type(made))):
        value = getattr(made, name, default)
        if (text := default_text(value)) != default_text(default):
            given.append(f"{name}={text}" if i or kind is inspect.Parameter.KEYWORD_ONLY else text)
    return f"{type(made).__name__}({', '.join(given)})"


@cache
def _arguments(cls: type) -> tuple[tuple[str, Any, Any], ...]:
    """Name, kind and default of the arguments of a class; where it passes others on, its base's follow."""
    return tuple(_walk(cls, set()))


def _walk(cls: type, seen: set[str]) -> Iterator[tuple[str, Any, Any]]:
    passes_on = False
    for parameter in list(inspect.signature(cls.__init__).parameters.values())[1:]:
        if parameter.kind in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL):
            passes_on = True
        elif parameter.name not in seen:
            seen.add(parameter.name)
            yield parameter.name, parameter.kind, parameter.default
    if passes_on:
        yield from _walk(cls.__mro__[1], seen)
