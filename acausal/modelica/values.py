"""Values of expressions besides numbers: arrays, records, and what a condition leaves out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any, cast

import numpy as np
import sympy as sp

from acausal.modeling import Component, Connector, Input, Output, Reference, Variable, time
from acausal.netlist import member


class Absent:
    """A component that its condition leaves out."""


ABSENT = Absent()


class Record:
    """The value of a record, or a connector that consists of several.

    Attributes:
        fields: by name.
        node: the class of a record, whose operators apply to it.
    """

    def __init__(self, fields: dict[str, Any], node: Any = None) -> None:
        self.fields, self.node = fields, node

    def field(self, word: str) -> Any:
        """The field of that name; None if there is none."""
        return self.fields.get(word)


class Redundant(Record):
    """Variables of a connector whose type has an ``equalityConstraint``; ``value`` is what expressions see."""

    def __init__(self, value: Any, node: Any, build: Any) -> None:
        super().__init__({}, node)
        self.value, self.build = value, build


class Bus(Record):
    """An expandable connector.

    Attributes:
        build, name: of the component that it belongs to, and its name there.
        arrays: names of declared members that are arrays of expandable connectors, and these.
        declared: names of other members that its class declares.
        links: buses that it is connected to, each with the build of the class that states it.
        ends: member -> what is connected to it, see `acausal.modelica.expandable.BusEnd`.
    """

    def __init__(self, build: Any, name: str) -> None:
        super().__init__({})
        self.build, self.name = build, name
        self.arrays, self.declared = dict[str, Any](), set[str]()
        self.links: list[tuple[Any, Bus]] = []
        self.ends: dict[str, list[Any]] = {}

    def field(self, word: str) -> Any:
        """The member of that name, which may not be there yet."""
        return self.arrays.get(word) or self.fields.get(word, BusMember(self, word))

    def nested(self, word: str) -> Bus:
        """The member of that name, which is expandable, too."""
        return self.fields.setdefault(word, Bus(self.build, f"{self.name}.{word}"))


class BusMember(Record):
    """A member of an expandable connector that is not there yet."""

    def __init__(self, bus: Bus, name: str) -> None:
        super().__init__({})
        self.bus, self.name = bus, name

    def field(self, word: str) -> Any:
        """A member of this one, which is expandable, too."""
        return self.bus.nested(self.name).field(word)

    def element(self, index: Sequence[int]) -> Any:
        """An element; each is a member of its own."""
        return self.bus.field(f"{self.name}[{','.join(map(str, index))}]")


class FoundOnce(dict[Any, tuple[Any, Any]]):
    """What is found by keys, each with what it was made of; a copy of a model finds it again."""

    def __deepcopy__(self, memo: Any) -> FoundOnce:
        return FoundOnce()

    def of(self, key: Any, source: Any, make: Callable[[], Any]) -> Any:
        """The value of a key, made once for one source."""
        known = self.get(key)
        if known is None or known[0] is not source:
            known = self[key] = source, make()
        return known[1]

    def array(self, name: str, found: Any) -> Any:
        """An array of variables, made once of the list that the component has."""
        if not is_array(found):
            return found
        return self.of(name, found, lambda: as_array(found))


class FunctionValue:
    """A function as the argument of another one.

    Attributes:
        node: its class. named: those of its arguments that are given already.
    """

    def __init__(self, node: Any, named: dict[str, Any]) -> None:
        self.node, self.named = node, named


def is_array(value: Any) -> bool:
    """Whether this is an array of numbers, truth values or texts, or a list of parts."""
    return isinstance(value, np.ndarray | list | tuple)


def as_array(value: Any) -> Any:
    """Nested sequences of values as an array; parts and connectors stay in lists."""
    if not isinstance(value, list | tuple):
        return value
    first: Any = cast(Sequence[Any], value)
    while isinstance(first, list | tuple) and first:
        first = cast(Sequence[Any], first)[0]
    parts = isinstance(first, Record) and not is_record(first)
    if parts or isinstance(first, Component | Connector | Absent):
        return cast(Any, value)
    return array_of(cast(Sequence[Any], value))


def array_of(items: Sequence[Any]) -> np.ndarray[Any, Any]:
    """An array of elements, which may be arrays of one shape.

    Raises:
        ValueError: if their shapes differ.
    """
    parts = [array_of(cast(Sequence[Any], v)) if isinstance(v, list | tuple) else v for v in items]
    shapes = {v.shape if isinstance(v, np.ndarray) else () for v in parts}
    if len(shapes) > 1:
        raise ValueError("the elements of an array differ in size")
    shape = shapes.pop() if shapes else ()
    found = np.empty((len(parts), *shape), dtype=object)
    for i, part in enumerate(parts):
        found[i] = part
    return found


def shape_of(value: Any) -> tuple[int, ...]:
    """The sizes of an array, or of a list of parts."""
    sizes: list[int] = []
    while isinstance(value, list | tuple):
        sizes.append(len(cast(Sequence[Any], value)))
        value = cast(Sequence[Any], value)[0] if value else None
    return (*sizes, *(value.shape if isinstance(value, np.ndarray) else ()))


def identity(n: int) -> np.ndarray[Any, Any]:
    """The identity matrix."""
    return array_of([[int(i == j) for j in range(n)] for i in range(n)])


def each(function: Callable[..., Any], *values: Any) -> Any:
    """A function of scalars, applied to the elements of arrays; scalars go with every element.

    Raises:
        ValueError: if the shapes of the arrays differ.
    """
    shapes = {v.shape for v in values if isinstance(v, np.ndarray)}
    if not shapes:
        return function(*values)
    if len(shapes) > 1:
        sizes = " and ".join(str(list(s)) for s in sorted(shapes))
        raise ValueError(f"arrays of sizes {sizes} do not fit")
    (shape,) = shapes
    found = np.empty(shape, dtype=object)
    for place in np.ndindex(*shape):
        found[place] = function(*(v[place] if isinstance(v, np.ndarray) else v for v in values))
    return found


def mapped(function: Callable[[Any], Any], value: Any) -> Any:
    """A function of scalars, applied to the elements of arrays and to the fields of records."""
    if isinstance(value, Record):
        return Record({k: mapped(function, v) for k, v in value.fields.items()}, value.node)
    return each(lambda v: mapped(function, v) if isinstance(v, Record) else function(v), value)


def elements(value: Any) -> list[Any]:
    """The elements of an array, row by row; a scalar alone."""
    return list(value.flat) if isinstance(value, np.ndarray) else [value]


def nested(value: Any) -> Any:
    """An array as nested lists."""
    return value.tolist() if isinstance(value, np.ndarray) else value


def of(value: Any, word: str) -> Any:
    """A member of a part, connector or record; of a list the members of its elements. None if there is none."""
    match value:
        case Absent():
            return value
        case Record():
            return value.field(word)
        case np.ndarray() if is_record(value):
            return each(lambda v: of(v, word), value)
        case np.ndarray() if not value.size:
            return value  # of no parts
        case list() | tuple() if value:
            found = [of(v, word) for v in cast(Sequence[Any], value)]
            return None if any(v is None for v in found) else as_array(found)
        case Component():
            build = value.__dict__.get("_build")
            if build is not None and word in build.absent:
                return ABSENT
            declared = value._node.declaration(word)
            if declared is not None and not value._node.has(declared):
                return ABSENT
            if build is not None and word in build.made:
                return build.made[word]
            if build is not None and word in build.entries and word not in vars(value):
                return build.member(word)  # of a part that is not complete yet
            found = member(value, word)
            return build.kept.array(word, found) if build is not None else as_array(found)
        case Connector():
            return as_array(getattr(value, attribute_of(word))) if _has(value, word) else None
        case _ if is_dataclass(value) and not isinstance(value, type):
            return getattr(value, word, getattr(value, f"{word}_", None))
        case _:
            return None


def attribute_of(word: str) -> str:
    """The attribute of a connector for a variable; of a name that every connector has it is another one: ``rate_``."""
    return f"{word}_" if hasattr(Connector, word) else word


def _has(connector: Connector, word: str) -> bool:
    return isinstance(getattr(type(connector), attribute_of(word), None), Variable)


def type_of(value: Any) -> str:
    """``Real``, ``Integer``, ``Boolean``, ``String``, or an empty text where it is not known."""
    if isinstance(value, bool | sp.logic.boolalg.Boolean) and not isinstance(value, sp.Symbol):
        return "Boolean"
    if isinstance(value, str):
        return "String"
    if isinstance(value, Reference):
        component = getattr(value.owner, "component", None)
        build = None if component is None else component.__dict__.get("_build")
        return "" if build is None else build.types.get(without_index(value.path), "")
    if isinstance(value, sp.Expr) and (value.is_Add or value.is_Mul or value.is_Pow):
        return "Real"
    if value is time:
        return "Real"
    return "Integer" if isinstance(value, int) else "Real" if isinstance(value, float) else ""


def is_real(value: Any) -> bool:
    """Whether this is surely a Real and no Integer; a function of others may be either."""
    if isinstance(value, float):
        return not value.is_integer()
    if not isinstance(value, sp.Expr):
        return False
    if value.is_Add or value.is_Mul:
        return any(map(is_real, value.args))
    if value.is_Pow:
        return is_real(value.args[0]) or not (
            value.args[1].is_Integer and value.args[1].is_positive
        )
    if value.is_Number:
        return not float(value).is_integer()
    return (value is time or isinstance(value, Reference)) and type_of(value) == "Real"


def without_index(path: str) -> str:
    """The name of an array, of that of an element."""
    return path.rpartition("[")[0] if path.endswith("]") else path


def is_end(value: Any) -> bool:
    """Whether this part of a connector is connected by itself: a connector, a signal, or several."""
    if is_array(value):
        return any(is_end(v) for v in value)
    if isinstance(value, Redundant):
        return False
    signal = isinstance(value, Reference) and isinstance(value.declaration, Input | Output)
    return signal or isinstance(value, Connector | Record)


def as_record(value: Any) -> Any:
    """Parts that are records as values, lists of such as an array; others as they are."""
    if isinstance(value, Redundant):
        return value.value
    if isinstance(value, Record) and "" in value.fields and value.node is not None:
        return Record({k: as_record(v) for k, v in value.fields.items() if k}, value.node)
    if isinstance(value, np.ndarray):
        return each(as_record, value) if is_record(value) else value
    if is_array(value):
        found = [as_record(v) for v in cast(Sequence[Any], value)]
        return array_of(found) if found and all(map(is_record, found)) else value
    build = value.__dict__.get("_build") if isinstance(value, Component) else None
    if build is None or build.node.definition.kind != "record":
        return value
    return Record({name: as_record(of(value, name)) for name in build.entries}, build.node)


def is_record(value: Any) -> bool:
    """Whether this is the value of a record, or an array of such."""
    first = value.flat[0] if isinstance(value, np.ndarray) and value.size else value
    return isinstance(first, Record) and first.node is not None


def with_fields(record: Any, given: dict[str, Any]) -> Any:
    """A record of a library with other values; a name that Python reserves has a ``_`` behind it there.

    Raises:
        KeyError: for a field that it does not have.
    """
    known = [f.name for f in fields(record)]
    found = {f"{k}_" if f"{k}_" in known else k: v for k, v in given.items()}
    for key in found:
        if key not in known:
            raise KeyError(key)
    return replace(record, **found) if found else record
