"""Connectors that Modelica text defines: a Python class each, or connectors, records and signals in one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import numpy as np

from acausal.modelica.classes import ClassNode
from acausal.modelica.functions import Interpreter
from acausal.modelica.library_parts import modify_connector
from acausal.modelica.modifications import (
    Bound,
    Given,
    Modification,
    given_in,
    modification,
    redeclared_class,
)
from acausal.modelica.operators import Frame
from acausal.modelica.syntax import ClassDefinition
from acausal.modelica.types import Type, attributes_of, is_overconstrained, type_of_declared
from acausal.modelica.values import Bus, Record, Redundant, attribute_of, of
from acausal.modelica.variables import declare
from acausal.modelica.views import Entry
from acausal.modeling import Connector, Flow, Potential, Variable, element_name


def connector(build: Any, name: str, found: Type, inner: list[Given]) -> Any:
    """A connector of a component; one that has signals, parameters, records or connectors in it is a record of them.

    Their names are paths, such as ``plug.pin[1]``, so that each belongs to the component itself.
    """
    node = found.node
    if node is not None:
        classes = [g for g in inner if isinstance(g.redeclared, ClassDefinition)]
        node = node.with_classes({g.name: redeclared_class(g.redeclared, g.frame) for g in classes})
        inner = [g for g in inner if g not in classes]
    if node is not None and is_expandable(node):
        return bus(build, name, node, inner)
    if node is not None and (node.definition.kind != "connector" or _is_composite(node)):
        return _composite(build, name, found, node, inner)
    build.later.append(lambda: modify_connector(build, name, inner))
    return found.native() if node is None else connector_class(node)()


def is_expandable(node: ClassNode) -> bool:
    """Whether a connector, or one that it extends, is expandable."""
    bases = [node.base(clause) for clause in node.extends]
    return node.definition.expandable or any(
        isinstance(base, ClassNode) and is_expandable(base) for base in bases
    )


def bus(build: Any, name: str, node: ClassNode, given: Sequence[Given] = ()) -> Bus:
    """An expandable connector; of its declared members only those are there already that are expandable, too."""
    found, known = Bus(build, name), dict[str, Any]()
    for word, entry in node.view().entries.items():
        frame, inner = Frame(entry.node, None, known), _type(entry).node
        modifiers = given_in(entry.modifiers, lambda n: Frame(n, None, known))
        mod = modification(entry.declared, [*given, *modifiers], frame)
        if entry.declared.prefixes.variability and mod.value is not None:
            known[word] = mod.value.value()
        if inner is None or not is_expandable(inner):
            found.declared.add(word)
            continue
        sizes = [Interpreter(frame).size(s) for s in entry.declared.subscripts]
        if not sizes:
            found.fields[word] = bus(build, f"{name}.{word}", inner, mod.inner)
            continue
        elements = np.empty(sizes, dtype=object)
        for place in np.ndindex(*sizes):
            element = element_name(word, place)
            elements[place] = bus(build, f"{name}.{element}", inner, mod.inner)
            found.fields[element] = elements[place]
        found.arrays[word] = elements.tolist()
    return found


def _is_composite(node: ClassNode) -> bool:
    """Whether a connector consists of more than potentials and flows."""
    view = node.view()
    return bool(view.causality) or any(not _is_plain(entry) for entry in view.entries.values())


def _is_plain(entry: Entry) -> bool:
    prefixes, found = entry.declared.prefixes, _type(entry)
    causal = prefixes.causality or found.causality or prefixes.variability
    plain = found.predefined == "Real" and found.native is None and not causal
    return plain and found.overconstrained is None


def _type(entry: Entry) -> Type:
    return type_of_declared(Frame(entry.node), entry.declared)


def _composite(build: Any, name: str, whole: Type, node: ClassNode, given: list[Given]) -> Record:
    fields: dict[str, Any] = {}
    entries = node.view().entries
    plain = {n: e for n, e in entries.items() if not whole.causality and _is_plain(e)}
    others = [(n, e) for n, e in entries.items() if n not in plain]
    for word, entry in sorted(others, key=lambda item: not item[1].declared.prefixes.variability):
        frame, path = Frame(entry.node, None, fields), f"{name}.{word}"
        modifiers = given_in(entry.modifiers, lambda n: Frame(n, None, fields))
        mod = modification(entry.declared, [*given, *modifiers], frame)
        found = _part_of(whole, entry, mod, frame)
        sizes = found.sizes(entry.declared.subscripts, frame)
        if found.predefined:
            known = found.causality or entry.declared.prefixes.variability or found.native
            if not (known or found.overconstrained):
                raise entry.wrong(f"a {found.predefined} in a connector is an input or output")
            declare(build, path, entry, found, mod, sizes)
        else:
            known = [Interpreter(f).size(s) for s, f in sizes]
            parts = build.parts(path, entry, found, mod, known)
            build.assign(path, entry, parts)
        made = build.made[path]
        fields[word] = (
            Redundant(made, found.overconstrained, build) if found.overconstrained else made
        )
    if plain:
        own = [g for g in given if g.name in plain]
        cls = _class(node, plain, fields, whole.connection)
        build.later.append(lambda: modify_connector(build, name, own))
        fields[""] = build.component._node.declare(name, cls())
        fields |= {n: of(fields[""], n) for n in plain}
    if not whole.connection:
        _check(node)
    is_value = node.definition.kind == "record" or node.view().causality
    return Record(fields, node if is_value else None)


def _part_of(whole: Type, entry: Entry, mod: Modification, frame: Frame) -> Type:
    """The type of a member; of a record's members all are what the record is: potentials, flows, inputs or outputs."""
    declared, prefixes = entry.declared, entry.declared.prefixes
    if mod.redeclared is not None:
        declared, frame = mod.redeclared.redeclared, mod.redeclared.frame
    found = type_of_declared(frame, declared)
    causality = whole.causality or prefixes.causality or found.causality
    connection = whole.connection or prefixes.connection or "potential"
    if found.node is None or found.node.definition.kind != "record" or prefixes.variability:
        return replace(found, causality=causality)
    if is_overconstrained(found.node):
        return found
    return replace(found, causality=causality, connection="" if causality else connection)


def connector_class(node: ClassNode) -> type[Connector]:
    """The Python class of a connector.

    Raises:
        ModelicaError: for a connector that is not made of potentials and flows.
    """
    if node.python is None:
        node.python = _class(node, node.view().entries, {})
        _check(node)
    return cast("type[Connector]", node.python)


def _class(
    node: ClassNode, entries: Mapping[str, Entry], known: dict[str, Any], connection: str = ""
) -> type[Connector]:
    """The class of the potentials and flows of a connector; ``known`` has values of its parameters."""
    bases = tuple(n.cls for n, _ in node.view().natives) or (Connector,)
    declared = {name: _variable(entry, known, connection) for name, entry in entries.items()}
    own = {attribute_of(name): v for name, v in declared.items()}
    cls: Any = type(node.definition.name, bases, {**own, "__module__": __name__})
    for name, variable in declared.items():
        variable.name = name
    stated = cls.declarations.items()
    cls.declarations = {v.name + "".join(n.partition("[")[1:]): v for n, v in stated}
    return cls


def _check(node: ClassNode) -> None:
    view, kinds = node.view(), [*_connections(node, "")]
    if not view.entries and not view.natives:
        raise node.refused("a connector without variables is not supported")
    flows = kinds.count("flow")
    parts = [_type(entry).node for entry in view.entries.values()]
    if any(node is not None and is_overconstrained(node) for node in parts):
        return  # what such a record counts depends on its constraint
    if not view.natives and not view.causality and flows != len(kinds) - flows:
        reason = f"a connector has as many flow variables as others, not {flows} and {len(kinds) - flows}"
        raise node.refused(reason)


def _connections(node: ClassNode, outer: str) -> Iterator[str]:
    """``flow`` or nothing, for each real variable of a connector and of the records in it."""
    for entry in node.view().entries.values():
        prefixes, found = entry.declared.prefixes, _type(entry)
        connection = outer or prefixes.connection
        if _is_plain(entry):
            yield connection
            continue
        inner = None if prefixes.causality or prefixes.variability else found.node
        if inner is None or inner.definition.kind != "record" or is_overconstrained(inner):
            continue
        yield from _connections(inner, connection)


def _variable(entry: Entry, known: dict[str, Any], connection: str = "") -> Variable:
    """A potential or flow."""
    declared, frame = entry.declared, Frame(entry.node, None, known)
    prefixes = declared.prefixes
    if prefixes.connection == "stream":
        raise entry.wrong("a stream variable in a connector is not supported")
    mod = modification(declared, given_in(entry.modifiers, Frame), frame)
    if mod.redeclared is not None:
        declared, frame = mod.redeclared.redeclared, mod.redeclared.frame
    found = type_of_declared(frame, declared)
    sizes = found.sizes(declared.subscripts, frame)
    shape = tuple(Interpreter(f).size(s) for s, f in sizes)
    stated = attributes_of(found, mod.inner)
    unit = stated.get("unit", "")
    kind = Flow if "flow" in (connection, prefixes.connection) else Potential
    return kind(
        unit=unit.value() if isinstance(unit, Bound) else unit,
        shape=shape or None,
        doc=declared.comment,
    )
