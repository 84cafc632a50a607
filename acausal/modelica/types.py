"""What a name of a class means for a component of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, is_dataclass
from typing import Any

from acausal.errors import nearest
from acausal.modelica.algorithms import REFUSED
from acausal.modelica.classes import ClassNode
from acausal.modelica.meanings import Native, Predefined, Prefix, Value, refused_package
from acausal.modelica.modifications import Bound, Given, given_in
from acausal.modelica.operators import Frame
from acausal.modelica.syntax import Declared, Expression, ModificationArgument
from acausal.modeling import Component, Connector, Input, Output

ATTRIBUTES = ("start", "fixed", "nominal", "stateSelect", "unit", "min", "max")
ENUMERATIONS = ("StateSelect", "AssertionLevel")
"""Predefined enumerations, whose values are texts."""
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
        causality: prefix that the type brings along.
        connection: of a record in a connector, ``flow`` or ``potential``: what its variables are.
        subscripts: of a type that is an array.
        record: of a library, with its default values.
        overconstrained: of a type with an ``equalityConstraint``, the class that defines it.
        full: the Modelica name of the class of a library.
    """

    native: Any = None
    node: ClassNode | None = None
    predefined: str = ""
    attributes: dict[str, Any] = field(default_factory=dict[str, Any])
    arguments: Sequence[tuple[ModificationArgument, ClassNode]] = ()
    causality: str = ""
    connection: str = ""
    subscripts: Sequence[tuple[Expression, ClassNode]] = ()
    record: Any = None
    overconstrained: ClassNode | None = None
    full: str = ""

    def sizes(
        self, subscripts: Sequence[Expression], frame: Frame
    ) -> list[tuple[Expression, Frame]]:
        """Those of a component with these subscripts, and then its type's, each with where it stands."""
        return [*((s, frame) for s in subscripts), *((s, Frame(n)) for s, n in self.subscripts)]

    @property
    def is_connector(self) -> bool:
        """Whether this is a connector with several variables, or a record in one."""
        if self.node is not None:
            return self.node.definition.kind == "connector" or bool(self.connection)
        return isinstance(self.native, type) and issubclass(self.native, Connector)


def type_of_declared(frame: Frame, declared: Declared) -> Type:
    """The type of a component.

    Raises:
        ModelicaError: for a name that means nothing, or what cannot be a component.
    """
    found, rest = frame.find(declared.type.words)
    if found is None and declared.type.text in ENUMERATIONS:
        return Type(predefined=declared.type.text)
    if found is None or rest:
        raise frame.node.unknown(declared.type)
    match found:
        case Predefined():
            if found.name in ("Clock", "ExternalObject"):
                hint = f"; {REFUSED[found.name]}" if found.name in REFUSED else ""
                raise frame.node.wrong(
                    declared.type.at, f"{found.name} is not supported{hint}", len(found.name)
                )
            return Type(predefined=found.name, attributes=found.attributes)
        case Native():
            return Type(native=found.cls, predefined=_signal_kind(found), full=found.name)
        case ClassNode():
            kind, word = found.definition.kind, declared.type.text
            if kind in ("package", "function"):
                reason = f"'{word}' is a {kind}, not a model"
                raise frame.node.wrong(declared.type.at, reason, len(word))
            reason = refused_package(found.full)
            if reason and found.definition.kind in ("model", "block", "class"):
                raise frame.node.wrong(declared.type.at, reason, len(declared.type.text))
            return type_of_class(found)
        case Value() if is_dataclass(found.value):
            return Type(predefined=declared.type.text, record=found.value)
        case Prefix() if any(lib.is_enumeration(found.full) for lib in frame.node.tree.libraries):
            return Type(predefined=declared.type.text)
        case Prefix():
            raise frame.node.unknown(declared.type)
        case _:
            word = declared.type.text
            raise frame.node.wrong(declared.type.at, f"'{word}' is not a class", len(word))


def type_of_class(node: ClassNode) -> Type:
    """What a component of a class of the text is."""
    view = node.view()
    if view.predefined is not None:
        return Type(
            predefined=view.predefined.name,
            attributes=view.predefined.attributes,
            arguments=view.attributes,
            causality=view.causality,
            subscripts=view.subscripts,
            overconstrained=node if is_overconstrained(node) else None,
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
    return Type(node=node, causality=view.causality)


def is_overconstrained(node: ClassNode) -> bool:
    """Whether connections of this record or type in a loop have more equations than it has independent values."""
    return node.member("equalityConstraint") is not None


def _signal_kind(native: Native) -> str:
    """The predefined type of a library's signal."""
    word = native.name.rpartition(".")[2]
    if native.cls not in (Input, Output):
        return ""
    return next((kind for kind in ("Boolean", "Integer") if word.startswith(kind)), "Real")


def attributes_of(found: Type, inner: Sequence[Given]) -> dict[str, Any]:
    """The attributes of a variable by name: from outside, the outermost first, and of its type.

    Raises:
        ModelicaError: for what is not an attribute.
    """
    stated: dict[str, Any] = {}
    of_type = given_in(found.arguments, Frame)
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
