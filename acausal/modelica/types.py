"""What a name of a class means for a component of it, and connectors that Modelica text defines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, is_dataclass
from typing import Any, cast

from acausal.errors import nearest
from acausal.modelica.classes import ClassNode, Entry, View
from acausal.modelica.functions import Interpreter
from acausal.modelica.meanings import Native, Predefined, Prefix, Value
from acausal.modelica.modifications import Bound, Given, given_by, modification
from acausal.modelica.operators import Frame
from acausal.modelica.syntax import Argument, Declared, Expression
from acausal.modeling import Component, Connector, Flow, Input, Output, Potential, Variable

ATTRIBUTES = ("start", "fixed", "nominal", "stateSelect", "unit", "min", "max")
IGNORED = ("displayUnit", "quantity", "unbounded")
"""Attributes that change no result."""


@dataclass(frozen=True, eq=False)
class Type:
    """What a component is declared as.

    Attributes:
        native: a class of a library: of a component, connector or signal.
        node: a class of the text, whose instance it becomes.
        predefined: ``Real``, ``Integer``, ``Boolean``, ``String`` or an enumeration, with ``attributes`` as values and
            ``arguments`` with the frame of each.
        causality, connection: prefixes that the type brings along.
        subscripts: of a type that is an array.
        record: of a library, with its default values.
    """

    native: Any = None
    node: ClassNode | None = None
    predefined: str = ""
    attributes: dict[str, Any] = field(default_factory=dict[str, Any])
    arguments: Sequence[tuple[Argument, ClassNode]] = ()
    causality: str = ""
    subscripts: Sequence[tuple[Expression, ClassNode]] = ()
    record: Any = None

    @property
    def is_connector(self) -> bool:
        """Whether this is a connector with several variables."""
        if self.node is not None:
            return self.node.definition.kind == "connector"
        return isinstance(self.native, type) and issubclass(self.native, Connector)


def type_of_declared(frame: Frame, declared: Declared) -> Type:
    """The type of a component.

    Raises:
        ModelicaError: for a name that means nothing, or what cannot be a component.
    """
    found, rest = frame.find(declared.type.words)
    if found is None or rest:
        raise frame.node.unknown(declared.type)
    match found:
        case Predefined():
            if found.name not in ("Real", "Integer", "Boolean", "String"):
                raise frame.node.wrong(declared.type.at, f"{found.name} is not supported")
            return Type(predefined=found.name, attributes=found.attributes)
        case Native():
            return Type(native=found.cls, predefined=_signal_kind(found))
        case ClassNode():
            return type_of_class(found)
        case Value() if is_dataclass(found.value):
            return Type(predefined=declared.type.text, record=found.value)
        case Prefix():
            raise frame.node.unknown(declared.type)
        case _:
            word = declared.type.text
            raise frame.node.wrong(declared.type.at, f"'{word}' is not a class", len(word))


def type_of_class(node: ClassNode) -> Type:
    """What a component of a class of the text is."""
    if node.definition.literals is not None:
        return Type(predefined=node.full)
    view = node.view()
    if view.predefined is not None:
        return Type(
            predefined=view.predefined.name,
            attributes=view.predefined.attributes,
            arguments=view.attributes,
            causality=view.causality,
            subscripts=view.subscripts,
        )
    signals = [n for n, _ in view.natives if n.cls in (Input, Output)]
    if signals and not view.entries:
        return Type(
            native=signals[0].cls,
            predefined=_signal_kind(signals[0]),
            arguments=view.natives[0][1],
            subscripts=view.subscripts,
        )
    if view.subscripts:
        raise node.wrong(node.definition.at, "a class that is an array of others is not supported")
    return Type(node=node)


def _signal_kind(native: Native) -> str:
    """The predefined type of a library's signal."""
    word = native.name.rpartition(".")[2]
    if native.cls not in (Input, Output):
        return ""
    return next((kind for kind in ("Boolean", "Integer") if word.startswith(kind)), "Real")


def connector_class(node: ClassNode) -> type[Connector]:
    """The Python class of a connector.

    Raises:
        ModelicaError: for a connector that is not made of potentials and flows.
    """
    if node.python is None:
        view = node.view()
        bases = tuple(n.cls for n, _ in view.natives) or (Connector,)
        declared = {name: _variable(entry) for name, entry in view.entries.items()}
        if node.definition.expandable:
            raise node.refused("expandable connectors are not supported")
        _check(node, view, declared)
        node.python = type(node.definition.name, bases, {**declared, "__module__": __name__})
    return cast("type[Connector]", node.python)


def _check(node: ClassNode, view: View, declared: dict[str, Variable]) -> None:
    flows = sum(isinstance(v, Flow) for v in declared.values())
    if not declared and not view.natives:
        raise node.refused("a connector without variables is not supported")
    if not view.natives and flows != len(declared) - flows:
        reason = f"a connector has as many flow variables as others, not {flows} and {len(declared) - flows}"
        raise node.refused(reason)


def _variable(entry: Entry) -> Variable:
    """A variable of a connector."""
    declared, frame = entry.declared, Frame(entry.node)
    found = type_of_declared(frame, declared)
    prefixes = declared.prefixes

    def refuse(what: str) -> Exception:
        return entry.wrong(f"{what} in a connector is not supported")

    if prefixes.connection == "stream":
        raise refuse("a stream variable")
    if found.predefined != "Real" or found.native is not None:
        raise refuse("what is not a Real")
    if prefixes.causality or found.causality:
        raise refuse("an input or output")
    if prefixes.variability:
        raise refuse(f"a {prefixes.variability}")
    sizes = [*((s, entry.node) for s in declared.subscripts), *found.subscripts]
    shape = tuple(
        Interpreter(f := Frame(n)).whole(Interpreter(f).value(s), "a size") for s, n in sizes
    )
    given = [g for a, n in entry.modifiers for g in given_by([a], Frame(n))]
    stated = attributes_of(found, modification(declared, given, frame).inner)
    unit = stated.get("unit", "")
    kind = Flow if prefixes.connection == "flow" else Potential
    return kind(
        unit=unit.value() if isinstance(unit, Bound) else unit,
        shape=shape or None,
        doc=declared.comment,
    )


def attributes_of(found: Type, inner: Sequence[Given]) -> dict[str, Any]:
    """The attributes of a variable by name: from outside, the outermost first, and of its type.

    Raises:
        ModelicaError: for what is not an attribute.
    """
    stated: dict[str, Any] = {}
    of_type = [g for a, n in found.arguments for g in given_by([a], Frame(n))]
    for one in (*inner, *of_type):
        if one.name not in (*ATTRIBUTES, *IGNORED):
            raise one.wrong(
                f"a {found.predefined} has no '{one.name}'; {nearest(one.name, ATTRIBUTES)}"
            )
        if one.modifier.value is not None and one.name in ATTRIBUTES:
            stated.setdefault(one.name, Bound(one.modifier.value, one.frame, one.index))
    return {**{k: v for k, v in found.attributes.items() if k in ATTRIBUTES}, **stated}


def is_component(cls: Any) -> bool:
    """Whether a class of a library is one of components."""
    return isinstance(cls, type) and issubclass(cls, Component)
