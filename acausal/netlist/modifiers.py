"""Modifiers in a netlist: the entries of ``with`` are applied to a part."""

from __future__ import annotations

from collections.abc import Mapping
from inspect import signature
from typing import Any, cast, get_args

from acausal.errors import DeclarationError, is_whole, nearest, shortened
from acausal.modeling import (
    Component,
    Connector,
    Declaration,
    Eq,
    Input,
    Module,
    Option,
    Parameter,
    Variable,
    check_size,
    each,
)
from acausal.netlist.file import NetlistError, kind, within
from acausal.netlist.model import START_KEYS, arguments_of
from acausal.netlist.scope import IGNORED_KEYS, Scope


def is_structural(cls: Any, key: str) -> bool:
    """Whether a part must be made with that modifier: an option, a vector, an argument of its class."""
    declared = cls._declared.get(key)
    if isinstance(declared, Declaration):
        vector = isinstance(declared, Parameter) and declared.shape is not None
        return vector or isinstance(declared, Option)
    return declared is None and key in arguments_of(cls)


def is_count(cls: Any, key: str) -> bool:
    """Whether a number given for that modifier says how many of something a part has: it is a whole number."""
    declared = cls._declared.get(key)
    if isinstance(declared, Option):
        return is_whole(declared.default)
    kind = signature(cls.__init__).parameters.get(key)
    return kind is not None and int in (kind.annotation, *get_args(kind.annotation))


def make(
    scope: Scope, cls: Any, given: Mapping[str, Any], place: str, where: str, by: Any = None
) -> tuple[Any, dict[str, Any]]:
    """An instance of a class, with those of the modifiers that it must be made with; and these, as arguments.

    Arguments:
        place: of the modifiers, for messages; ``where``: of the part.
        by: what is called in place of the class, such as its constructor for an instance of a class derived from it.

    Raises:
        NetlistError: in one sentence, with the place.
    """
    arguments = {
        name: _argument(scope, cls._declared.get(name), raw, f"{place}.{shortened(name)}")
        for name, raw in given.items()
        if is_structural(cls, name)
    }
    for name, value in arguments.items():
        if isinstance(value, int | float) and is_count(cls, name):
            label = f"{cls.__name__} with {name}={value:g}"
            within(where, lambda n=int(value), label=label: check_size(n, label))
    return within(where, lambda: _made(cls, by or cls, arguments)), arguments


def _argument(scope: Scope, declared: Any, raw: Any, where: str) -> Any:
    match declared:
        case Option():
            return scope.option(declared, raw, where)
        case None:
            return scope.argument(raw, where)
        case _:
            return scope.value(raw, where)


def _made(cls: Any, by: Any, arguments: Mapping[str, Any]) -> Any:
    """An instance; an exception of its constructor becomes one sentence."""
    try:
        return by(**arguments)
    except DeclarationError:
        raise
    except Exception as error:  # a library's own code, with values that it was not written for
        reason = shortened(" ".join(str(error).split()), 120)
        raise DeclarationError(
            f"{cls.__name__} cannot be made with these modifiers ({reason})"
        ) from None


def modify(scope: Scope, part: Component, key: str, raw: Any, where: str) -> None:
    """Apply one modifier to a part; a mapping modifies the variables of a connector or the parts within.

    Raises:
        NetlistError: in one sentence, with the place.
    """
    if key in part._node.children:
        if not isinstance(raw, Mapping):
            raise NetlistError(
                f"{where} is a component; its modifiers are an object, not {kind(raw)}"
            )
        for name, inner in raw.items():
            modify(scope, part._node.children[key], name, inner, f"{where}.{shortened(name)}")
        return
    declared = part._node.declaration(key)
    match declared:
        case Connector():
            value = _connector(scope, raw, where)
        case Variable():
            value = _variable(scope, part, declared, raw, where)
        case Parameter():
            value = _parameter(scope, raw, where)
        case Option():
            value = scope.option(declared, raw, where)
        case Module():
            raise NetlistError(f"{where} is a network, which a file cannot hold; give it in Python")
        case None if key in part.UNUSED:
            if isinstance(raw, Mapping):
                scope.start(raw, where)  # checked, but there is nothing to start
            return
        case _:
            known = [*(n for n, _ in part._node.declarations()), *part._node.children]
            hint = nearest(key, known)
            raise NetlistError(f"{where}: {part._node.label} has no '{shortened(key)}'; {hint}")
    if value is not None:
        within(where, lambda: part.modify(**{key: value}))


def _connector(scope: Scope, raw: Any, where: str) -> Any:
    if not isinstance(raw, Mapping):
        raise NetlistError(f"{where} is a connector; modify its variables by an object")
    return {name: scope.start(v, f"{where}.{shortened(name)}") for name, v in raw.items()}


def _parameter(scope: Scope, raw: Any, where: str) -> Any:
    """The value of a parameter; if it has attributes, the value under "=", or None without one."""
    if not isinstance(raw, Mapping):
        return scope.value(raw, where)
    for key in raw:
        if key not in ("=", "start", "fixed", "nominal", *IGNORED_KEYS):
            raise NetlistError(
                f"{where}: unknown attribute '{shortened(key)}'; a parameter's value stands under '='"
            )
    if raw.get("fixed", True) is not True:
        rest = {key: raw[key] for key in ("start", "fixed") if key in raw}
        return scope.start(rest, where)
    given = raw.get("=", raw.get("start"))
    return None if given is None else scope.value(given, where)


def _variable(scope: Scope, part: Component, declared: Variable, raw: Any, where: str) -> Any:
    """The attributes of a variable; a value for it becomes one more equation of the model."""
    attributes = cast(Mapping[str, Any], raw) if isinstance(raw, Mapping) else {"=": raw}
    if "=" in attributes:
        _bind(scope, part, declared.name, attributes["="], where)
    rest = {k: v for k, v in attributes.items() if k != "="}
    start = scope.start(rest, where)
    if isinstance(rest.get("start"), bool) and declared.unit not in ("", "1"):
        raise NetlistError(
            f"{where}.start: a number in {declared.unit} is needed, not a truth value"
        )
    return start if any(k in START_KEYS for k in rest) else None


def _bind(scope: Scope, part: Component, key: str, raw: Any, where: str) -> None:
    if isinstance(part._node.declaration(key), Input):
        raise NetlistError(f"{where} is an input; connect a source to it")
    value = scope.value(raw, where)
    for equation in each([within(where, lambda: Eq(getattr(part, key), value))]):
        scope.bind(equation)
