"""Declarations of predefined types: constants, parameters and variables of a component."""

from __future__ import annotations

from dataclasses import is_dataclass
from typing import Any

import numpy as np
import sympy as sp

from acausal.modelica import statements
from acausal.modelica.functions import Interpreter
from acausal.modelica.library_parts import ModifierValues, decide_nominal, grouped
from acausal.modelica.meanings import Literal
from acausal.modelica.modifications import Bound, Modification
from acausal.modelica.operators import Frame
from acausal.modelica.syntax import Whole
from acausal.modelica.types import Type, attributes_of
from acausal.modelica.values import array_of, each, elements, nested, type_of, with_fields
from acausal.modelica.views import Entry
from acausal.modeling import (
    Discrete,
    DiscreteOutput,
    InitialParameter,
    Input,
    Output,
    Parameter,
    Start,
    Variable,
)

KINDS: dict[str, Any] = {"Real": "real", "Boolean": "bool"}


def declare(
    build: Any,
    name: str,
    entry: Entry,
    found: Type,
    mod: Modification,
    sizes: list[tuple[Any, Frame]],
) -> None:
    """Declare a component of a predefined type.

    Raises:
        ModelicaError: for a value of another type, or one that is missing.
    """
    if found.record is not None:
        build.made[name] = _record(found, mod)
        return
    stated = attributes_of(found, mod.inner)
    build.types[name] = found.predefined
    variability = entry.declared.prefixes.variability or build.variability
    if variability in ("parameter", "constant"):
        _fixed(build, name, entry, found, mod, stated, sizes)
        return
    if found.predefined == "String":
        raise entry.wrong("a text that changes with time is not supported")
    shape = tuple(sizes_of(entry, mod.value, sizes))
    if 0 in shape:
        build.made[name] = np.empty(shape, dtype=object)
        return
    if found.native is not None and "unit" not in stated:
        stated["unit"] = ""
    declared = _variable(build, name, entry, found, mod, shape, _text(stated.pop("unit", "")))
    build.assign(name, entry, declared)
    start = {k: _value(v) for k, v in stated.items() if k not in ("min", "max")}
    decide_nominal(start)
    _need_start(found, stated.get("start"), start.get("start"), shape)
    if isinstance(start.get("start"), np.ndarray):
        start["start"] = each(lambda v: int(v) if isinstance(v, bool) else v, start["start"])
    if found.predefined != "Real" and not isinstance(declared, Discrete):
        start.pop("fixed", None)  # of its value before the start, which is that of its source
    fixed = start.get("fixed")
    if isinstance(fixed, np.ndarray) and not fixed.all():
        build.fixed[name], start["fixed"] = fixed, False
    for key in ("fixed", "stateSelect"):
        if isinstance(start.get(key), np.ndarray):
            start[key] = _common(entry, key, start[key])
    if start:
        scope = ModifierValues()
        build.component.modify(
            **{name: scope.start({k: nested(v) for k, v in start.items()}, name)}
        )
    if mod.value is not None:
        owner = mod.value.frame.build or build
        owner.bindings.append((build.component, name, mod.value))


def _need_start(found: Type, stated: Any, start: Any, shape: tuple[int, ...]) -> None:
    """Refuse a start of another type or size than its variable has."""
    if not isinstance(stated, Bound):
        return
    if isinstance(start, np.ndarray) and start.shape != shape:
        sizes = " and ".join(str(list(s)) for s in (shape, start.shape))
        raise stated.wrong(f"the variable and its start have the sizes {sizes}")
    if found.predefined in ("Real", "Integer") and any(
        isinstance(v, bool) for v in elements(start)
    ):
        raise stated.wrong(f"the start of this {found.predefined} is a number, not a Boolean")


def _record(found: Type, mod: Modification) -> Any:
    """A record of a library, with the fields that a modifier gives."""
    value = found.record if mod.value is None else mod.value.value()
    if not is_dataclass(value) and mod.value is not None:
        raise mod.value.wrong(f"a {found.predefined} is needed")
    given = {name: inner for name, (inner, _) in grouped(mod.inner).items()}
    return with_fields(value, {n: m.value.value() for n, m in given.items() if m.value is not None})


def _variable(
    build: Any,
    name: str,
    entry: Entry,
    found: Type,
    mod: Modification,
    shape: tuple[int, ...],
    unit: str,
) -> Variable:
    """The declaration of a variable."""
    prefixes, kind = entry.declared.prefixes, KINDS.get(found.predefined, "int")
    causality = prefixes.causality or found.causality
    if found.native is not None:
        causality = "input" if found.native is Input else "output"
    given: dict[str, Any] = {"unit": unit, "shape": shape or None, "doc": entry.declared.comment}
    fed = mod.value is None and name in statements.fed_by_connections(build)
    stated = frozenset[str]().union(*statements.connected_or_given(build))
    if prefixes.protected and causality == "input" and mod.value is None and name in stated:
        causality = "output"  # nothing reaches it from outside: it passes on what is within
    jumps = (
        kind != "real"
        or prefixes.variability == "discrete"
        or name in statements.assigned_at_events(build.node)
    ) and not (fed and causality == "output")
    if causality == "input" and mod.value is None:
        return Input(kind=kind, **given)
    if causality == "input":
        build.bound_inputs.add(name)
    if causality == "output":
        return DiscreteOutput(kind=kind, **given) if jumps else Output(**given)
    return Discrete(kind=kind, **given) if jumps else Variable(**given)


def _fixed(
    build: Any,
    name: str,
    entry: Entry,
    found: Type,
    mod: Modification,
    stated: dict[str, Any],
    sizes: list[tuple[Any, Frame]],
) -> None:
    """A constant or parameter: a number that may change later, or a value that decides what there is."""
    value, declared = mod.value, entry.declared
    constant = declared.prefixes.variability == "constant"
    real = found.predefined == "Real"
    if (
        real
        and not constant
        and _common(entry, "fixed", _value(stated.get("fixed", True))) is False
    ):
        if value is not None:
            raise value.wrong(
                f"'{name}' is found at the start (fixed=false); give its start, not its value"
            )
        shape = tuple(sizes_of(entry, None, sizes)) or None
        unit = _text(stated.get("unit", ""))
        build.assign(name, entry, InitialParameter(unit=unit, shape=shape, doc=declared.comment))
        if "start" in stated:
            build.component.modify(**{name: Start(nested(_value(stated["start"])))})
        return
    start = stated.get("start")
    value, given = value or (start if isinstance(start, Bound) else None), start
    given = given if value is None else value.value()
    if given is None and (constant or not real):
        raise entry.wrong(f"'{name}' has no value; give one")
    if constant and any(isinstance(v, sp.Basic) and v.free_symbols for v in elements(given)):
        raise entry.wrong(f"'{name}' is a constant, which depends on constants only")
    if given is not None:
        given = _checked(build, name, entry, found, given, value)
    known = sizes_of(entry, given, sizes)
    if known and given is not None:
        given = _spread(entry, name, given, known, value)
    elif isinstance(given, np.ndarray):
        raise entry.wrong(f"'{name}' is a single value, not an array")
    if constant or not real or 0 in known:
        build.made[name] = np.empty(known, dtype=object) if 0 in known else given
        return
    low, high = (_value(stated.get(k)) for k in ("min", "max"))
    folded = 0.0 if isinstance(given, int | float) and given == 0 else None
    parameter = Parameter(
        folded,
        unit=_text(stated.get("unit", "")),
        shape=tuple(known) or None,
        doc=declared.comment,
        min=low if isinstance(low, int | float) else None,
        max=high if isinstance(high, int | float) else None,
    )
    build.assign(name, entry, parameter)
    if given is not None and folded is None:
        build.component.modify(**{name: nested(given)})


def _checked(
    build: Any, name: str, entry: Entry, found: Type, given: Any, bound: Bound | None
) -> Any:
    """A value of the declared type; what decides a structure becomes a number."""
    frame = build.frame(entry.node) if bound is None else bound.frame
    interpreter = Interpreter(frame)
    interpreter.at = entry.declared.at if bound is None else bound.expression.at
    kind = found.predefined

    def one(value: Any) -> Any:
        if kind == "Real":
            return interpreter.number(value)
        if kind == "Integer":
            return interpreter.whole(value, f"'{name}'")
        if kind == "Boolean":
            return interpreter.known(interpreter.truth(value), f"'{name}'")
        if isinstance(value, str) and (kind == "String") is not isinstance(value, Literal):
            return value
        if isinstance(value, str) and kind != "String":  # of a library's enumeration
            return value
        raise interpreter.wrong(
            f"'{name}' is a {kind}, this is {type_of(value) or 'something else'}"
        )

    if isinstance(given, np.ndarray):
        return array_of([one(v) for v in elements(given)]).reshape(given.shape)
    return one(given)


def sizes_of(entry: Entry, value: Any, sizes: list[tuple[Any, Frame]]) -> list[int]:
    """The sizes of an array; those that are open follow from its value."""
    found: list[int] = []
    for place, (expression, frame) in enumerate(sizes):
        if not isinstance(expression, Whole):
            found.append(Interpreter(frame).size(expression))
            continue
        given = value.value() if isinstance(value, Bound) else value
        if not isinstance(given, np.ndarray) or place >= given.ndim:
            raise entry.wrong("the size of this array is not known; give it a value")
        found.append(given.shape[place])
    return found


def _common(entry: Entry, key: str, values: Any) -> Any:
    """The attribute that all elements of an array share."""
    first, *others = elements(values)
    if any(v != first for v in others):
        raise entry.wrong(f"'{key}' has to be the same for all elements of '{entry.declared.name}'")
    return first


def _spread(entry: Entry, name: str, given: Any, sizes: list[int], bound: Bound | None) -> Any:
    """An array of the declared size; a single value goes to all elements."""
    if isinstance(given, np.ndarray):
        if list(given.shape) != sizes:
            reason = f"'{name}' has the size {sizes}, its value has {list(given.shape)}"
            raise (bound or entry).wrong(reason)
        return given
    found = np.empty(sizes, dtype=object)
    found[...] = given
    return found


def _value(stated: Any) -> Any:
    """An attribute; values of enumerations are numbers while a model runs."""
    value = stated.value() if isinstance(stated, Bound) else stated
    return each(lambda v: v.number if isinstance(v, Literal) else v, value)


def _text(stated: Any) -> str:
    first, *others = elements(_value(stated))
    if isinstance(stated, Bound) and not isinstance(first, str):
        raise stated.wrong("a unit is a text")
    return first if all(v == first for v in others) else ""  # an array has one unit here, or none
